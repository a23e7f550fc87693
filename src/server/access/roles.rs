//! Roles, and the role that each call needs.
//!
//! The table role × call is not written down in the server: it is read from the option `required_role` of the protos,
//! in the descriptor set that reflection serves. A call without the option is refused to all callers.

use prost_reflect::{DescriptorPool, Value};
use sinew_wire::DESCRIPTOR_SET;
use sinew_wire::pb;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Full name of the option.
const OPTION: &str = "sinew.v1.required_role";

/// A role; as `sinew.v1.Role`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Watches a world.
    Viewer,
    /// Applies loads, pushes and forces.
    Perturber,
    /// Drives figures.
    Driver,
    /// Runs the scene.
    Director,
    /// Ends the world and grants roles in it.
    Owner,
    /// Is authenticated.
    Member,
    /// Creates worlds and clips.
    Creator,
}

impl Role {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Viewer,
        Self::Perturber,
        Self::Driver,
        Self::Director,
        Self::Owner,
        Self::Member,
        Self::Creator,
    ];

    /// Its name in claims, settings and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Viewer => "viewer",
            Self::Perturber => "perturber",
            Self::Driver => "driver",
            Self::Director => "director",
            Self::Owner => "owner",
            Self::Member => "member",
            Self::Creator => "creator",
        }
    }

    /// The role with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|r| r.name() == name)
    }

    /// From the wire.
    pub fn from_wire(role: pb::Role) -> Option<Self> {
        Some(match role {
            pb::Role::Unspecified => return None,
            pb::Role::Viewer => Self::Viewer,
            pb::Role::Perturber => Self::Perturber,
            pb::Role::Driver => Self::Driver,
            pb::Role::Director => Self::Director,
            pb::Role::Owner => Self::Owner,
            pb::Role::Member => Self::Member,
            pb::Role::Creator => Self::Creator,
        })
    }

    /// To the wire.
    pub fn to_wire(self) -> pb::Role {
        match self {
            Self::Viewer => pb::Role::Viewer,
            Self::Perturber => pb::Role::Perturber,
            Self::Driver => pb::Role::Driver,
            Self::Director => pb::Role::Director,
            Self::Owner => pb::Role::Owner,
            Self::Member => pb::Role::Member,
            Self::Creator => pb::Role::Creator,
        }
    }

    /// Whether it holds in a world; the others hold for the server.
    pub fn is_of_world(self) -> bool {
        !matches!(self, Self::Member | Self::Creator)
    }

    /// Itself and the roles that it contains.
    fn closed(self) -> Roles {
        let contained: &[Self] = match self {
            Self::Viewer | Self::Member => &[],
            Self::Perturber | Self::Driver => &[Self::Viewer],
            Self::Director => &[Self::Viewer, Self::Perturber, Self::Driver],
            Self::Owner => &[Self::Viewer, Self::Perturber, Self::Driver, Self::Director],
            Self::Creator => &[Self::Member],
        };
        let all = contained.iter().chain([&self]);
        Roles(all.fold(0, |bits, r| bits | 1 << *r as u8))
    }
}

/// A set of roles, with all that they contain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Roles(u8);

impl Roles {
    /// Every role.
    pub const EVERY: Self = Self(0x7f);

    /// Whether the role is among them.
    pub fn contain(self, role: Role) -> bool {
        self.0 & (1 << role as u8) != 0
    }

    /// The union of both sets.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether the set is empty.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The roles one by one.
    pub fn iter(self) -> impl Iterator<Item = Role> {
        Role::ALL.into_iter().filter(move |r| self.contain(*r))
    }
}

impl FromIterator<Role> for Roles {
    fn from_iter<I: IntoIterator<Item = Role>>(roles: I) -> Self {
        roles
            .into_iter()
            .fold(Self::default(), |all, r| all.and(r.closed()))
    }
}

/// The requirement of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Open to all callers: health, and the schema.
    Open,
    /// This role.
    Needs(Role),
    /// Refused to all callers, because it states no requirement.
    Never,
    /// There is no such call.
    Unknown,
}

/// Packages whose calls are open: load balancers ask for health, and the schema is public.
const OPEN: [&str; 2] = ["/grpc.health.v1.", "/grpc.reflection."];

static TABLE: LazyLock<HashMap<String, Rule>> = LazyLock::new(|| table().into_iter().collect());

/// Path and rule of every call in the descriptor set.
pub fn table() -> Vec<(String, Rule)> {
    let pool = DescriptorPool::decode(DESCRIPTOR_SET).expect("the embedded descriptor set is one");
    let option = pool.get_extension_by_name(OPTION);
    let services: Vec<_> = pool.services().collect();
    let methods = services.iter().flat_map(|service| {
        service.methods().map(|method| {
            let path = format!("/{}/{}", service.full_name(), method.name());
            (path, method)
        })
    });
    methods
        .map(|(path, method)| {
            let role = option.as_ref().and_then(|option| {
                let options = method.options();
                match options.get_extension(option).as_ref() {
                    Value::EnumNumber(n) => pb::Role::try_from(*n).ok().and_then(Role::from_wire),
                    _ => None,
                }
            });
            (path, role.map_or(Rule::Never, Rule::Needs))
        })
        .collect()
}

/// Paths of all calls of the protos.
pub fn paths() -> impl Iterator<Item = &'static str> {
    TABLE.keys().map(String::as_str)
}

/// The path, if it belongs to a call of the protos.
pub fn known(path: &str) -> Option<&'static str> {
    TABLE.get_key_value(path).map(|(known, _)| known.as_str())
}

/// The rule of a call.
pub fn rule(path: &str) -> Rule {
    match TABLE.get(path) {
        Some(rule) => *rule,
        None if OPEN.iter().any(|prefix| path.starts_with(prefix)) => Rule::Open,
        None => Rule::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_call_says_which_role_it_needs() {
        let table = table();
        assert!(table.len() >= 45, "{}", table.len());
        for (path, rule) in table {
            assert!(
                matches!(rule, Rule::Needs(_)),
                "{path} has no required_role"
            );
        }
        assert_eq!(
            rule("/sinew.v1.WorldService/DeleteWorld"),
            Rule::Needs(Role::Owner)
        );
        assert_eq!(rule("/sinew.v1.WorldService/Unknown"), Rule::Unknown);
        assert_eq!(rule("/grpc.health.v1.Health/Check"), Rule::Open);
    }

    #[test]
    fn roles_contain_those_below_them() {
        let of = |role: Role| Roles::from_iter([role]);
        assert!(of(Role::Owner).contain(Role::Driver) && !of(Role::Owner).contain(Role::Creator));
        assert!(
            of(Role::Driver).contain(Role::Viewer) && !of(Role::Driver).contain(Role::Perturber)
        );
        assert!(
            of(Role::Creator).contain(Role::Member) && !of(Role::Creator).contain(Role::Viewer)
        );
        assert!(Role::ALL.iter().all(|r| Roles::EVERY.contain(*r)));
        for role in Role::ALL {
            assert_eq!(Role::named(role.name()), Some(role));
            assert_eq!(Role::from_wire(role.to_wire()), Some(role));
        }
    }
}
