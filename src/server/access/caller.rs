//! The caller and its permissions.

use super::roles::{Role, Roles, Rule};
use crate::shares::ClientKey;
use sinew_wire::status::Fault;
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

/// Name of every caller on a server without authentication.
pub const ANONYMOUS: &str = "anonymous";
/// A grant to this principal is a grant to every authenticated caller.
pub const EVERYONE: &str = "*";

/// Claims of a token or of the settings about a principal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Claims {
    /// Roles, for the server and in the worlds that are named.
    pub roles: Roles,
    /// Names of worlds and clips to which the roles apply, each with `*` at its end for any ending; `None`: all.
    pub names: Option<Vec<String>>,
}

impl Claims {
    /// Whether the names include this world or clip.
    pub fn name(&self, id: &str) -> bool {
        let matches = |pattern: &String| match pattern.strip_suffix('*') {
            Some(start) => id.starts_with(start),
            None => id == pattern,
        };
        self.names
            .as_ref()
            .is_none_or(|names| names.iter().any(matches))
    }

    /// Roles in a world of this name.
    pub fn roles_in(&self, id: &str) -> Roles {
        if self.name(id) {
            self.roles
        } else {
            Roles::default()
        }
    }
}

/// An identity.
#[derive(Clone, Debug)]
pub struct Identity {
    /// `user:{sub}`, `cert:{name}` or `anonymous`.
    pub principal: Arc<str>,
    /// Its permissions without any grant.
    pub claims: Arc<Claims>,
    /// Time at which it has to prove itself again.
    pub expires: Option<SystemTime>,
}

impl Identity {
    /// Every caller on a server without authentication: owner of everything.
    pub fn anonymous() -> Self {
        Self {
            principal: ANONYMOUS.into(),
            claims: Arc::new(Claims {
                roles: Roles::EVERY,
                names: None,
            }),
            expires: None,
        }
    }

    /// Whether it is anonymous.
    pub fn is_anonymous(&self) -> bool {
        &*self.principal == ANONYMOUS
    }
}

/// The caller of a call.
#[derive(Clone, Debug)]
pub struct Caller {
    /// Its identity.
    pub identity: Identity,
    /// The client whose share of common resources this uses: the principal, or for anonymous callers the address.
    pub client: ClientKey,
    /// The key that orders its commands among those of others: the principal, or for anonymous callers the connection.
    pub order: Arc<str>,
    /// The rule of the call.
    pub rule: Rule,
    /// Name of the call, for messages.
    pub call: Arc<str>,
}

impl Caller {
    /// Name of the principal.
    pub fn principal(&self) -> &Arc<str> {
        &self.identity.principal
    }

    /// Checks the part of the rule that needs no world.
    ///
    /// # Errors
    /// A role for the server is missing, or the call is refused to all callers.
    pub fn check_server(&self) -> Result<(), Fault> {
        match self.rule {
            Rule::Never => Err(Fault::Denied {
                reason: "CALL_WITHOUT_ROLE",
                message: format!(
                    "{} does not say which role it needs, so it is refused",
                    self.call
                ),
                facts: vec![],
            }),
            Rule::Needs(Role::Creator) if !self.may_create() => Err(self.denied(Role::Creator, "")),
            // Roles in a world are checked with the world; every caller here is authenticated.
            Rule::Needs(_) | Rule::Open | Rule::Unknown => Ok(()),
        }
    }

    /// Whether it may create worlds and clips.
    fn may_create(&self) -> bool {
        let roles = self.identity.claims.roles;
        // A caller whose token owns worlds may create those named in the token.
        roles.contain(Role::Creator) || roles.contain(Role::Owner)
    }

    /// Checks that a new world or clip may have this name; `None`: one that the server chooses.
    ///
    /// # Errors
    /// The token names others.
    pub fn check_new_name(&self, field: &str, id: Option<&str>) -> Result<(), Fault> {
        let claims = &self.identity.claims;
        let Some(names) = &claims.names else {
            return Ok(());
        };
        if id.is_some_and(|id| claims.name(id)) {
            return Ok(());
        }
        Err(Fault::Denied {
            reason: "NAME_NOT_GRANTED",
            message: format!(
                "{field}: {} may create what is named {}",
                self.identity.principal,
                names.join(", ")
            ),
            facts: vec![("field", field.to_owned())],
        })
    }

    /// Checks that its token, not a grant, gives it a role in a world.
    ///
    /// # Errors
    /// It does not.
    pub fn check_claim(&self, role: Role, world: &str) -> Result<(), Fault> {
        if self.identity.claims.roles_in(world).contain(role) {
            return Ok(());
        }
        Err(self.denied(role, &format!("worlds/{world}")))
    }

    /// The fault of a missing role; `place`: the world in which it is missing, empty for the server.
    pub fn denied(&self, role: Role, place: &str) -> Fault {
        let place = if place.is_empty() {
            String::new()
        } else {
            format!(" for {place}")
        };
        Fault::Denied {
            reason: "ROLE_REQUIRED",
            message: format!(
                "{} needs the role {}{place}, which {} does not have",
                self.call,
                role.name(),
                self.identity.principal
            ),
            facts: vec![
                ("required_role", role.name().to_owned()),
                ("principal", self.identity.principal.to_string()),
            ],
        }
    }

    /// Time until the proof of identity expires; `None`: never.
    pub fn expires_in(&self) -> Option<Duration> {
        let left = |at: SystemTime| at.duration_since(SystemTime::now()).unwrap_or_default();
        self.identity.expires.map(left)
    }

    /// Time at which the proof of identity expires.
    pub fn expires_at(&self) -> Option<Instant> {
        self.expires_in()
            .and_then(|left| Instant::now().checked_add(left))
    }

    /// The end of a stream whose caller has to prove itself again.
    pub fn expired() -> Fault {
        Fault::Unauthenticated {
            reason: "TOKEN_EXPIRED",
            message: "the token has expired: come again with a new one".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_name_worlds_by_their_beginning() {
        let claims = |names: Option<&[&str]>| Claims {
            roles: [Role::Driver].into_iter().collect(),
            names: names.map(|n| n.iter().map(|n| (*n).to_owned()).collect()),
        };
        let studio = claims(Some(&["studio-a-*", "lobby"]));
        assert!(studio.roles_in("studio-a-stage").contain(Role::Viewer));
        assert!(studio.roles_in("lobby").contain(Role::Driver));
        for other in ["studio-b-stage", "studio-a", "lobby-2", "", "*"] {
            assert!(studio.roles_in(other).is_empty(), "{other}");
        }
        assert!(!claims(None).roles_in("any").is_empty());
        assert!(claims(Some(&[])).roles_in("any").is_empty());
    }
}
