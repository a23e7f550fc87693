//! Tunable numbers: each is declared once, in the `params` module of its part, with unit, range and source.
//!
//! A parameter is a constant, so it costs nothing in a tick. The list of all of them makes `docs/parameters.md`.

/// A tunable number with its documentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Param {
    /// Name of the constant.
    pub name: &'static str,
    /// Its description, from its doc comment.
    pub what: &'static str,
    /// Its value, in its unit.
    pub value: f64,
    /// SI unit; `1` for ratios, `samples` or `rounds` for counts.
    pub unit: &'static str,
    /// Smallest and largest value for which the code that uses it still makes sense.
    pub range: [f64; 2],
    /// Publication, measurement, derivation, or the command of the repository that shows its effect.
    pub source: &'static str,
}

/// Declares constants of a `params` module, and `ALL`, the list of them.
///
/// ```ignore
/// params! {
///     /// A sole lower than this touches the floor.
///     TOUCH_HEIGHT: f64 = 0.004, "m", 0.001..=0.02, "docs/locomotion.md#contact";
/// }
/// ```
macro_rules! params {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident: $type:ty = $value:expr, $unit:literal, $min:literal..=$max:literal, $source:literal;
    )+) => {
        $($(#[doc = $doc])+ pub(crate) const $name: $type = $value;)+

        /// All parameters declared here, in order.
        pub const ALL: &[$crate::params::Param] = &[$($crate::params::Param {
            name: stringify!($name),
            what: concat!($($doc),+),
            value: $value as f64,
            unit: $unit,
            range: [$min as f64, $max as f64],
            source: $source,
        }),+];
    };
}
pub(crate) use params;

#[cfg(test)]
mod tests {
    params! {
        /// A length.
        LENGTH: f64 = 0.5, "m", 0.1..=1.0, "a test";
        /// A count, of rounds.
        ROUNDS: usize = 3, "rounds", 1..=10, "a test";
    }

    #[test]
    fn a_parameter_is_a_constant_and_an_entry_of_the_list() {
        assert_eq!((LENGTH, ROUNDS), (0.5, 3));
        let said: Vec<_> = ALL
            .iter()
            .map(|p| (p.name, p.what.trim(), p.value, p.range))
            .collect();
        assert_eq!(
            said,
            [
                ("LENGTH", "A length.", 0.5, [0.1, 1.0]),
                ("ROUNDS", "A count, of rounds.", 3.0, [1.0, 10.0])
            ]
        );
    }

    /// A parameter that is in no list is missing from docs/parameters.md, and nothing checks its range.
    #[test]
    fn every_module_of_parameters_is_in_the_list_of_its_part() {
        use crate::{figure, get_up, plan, retarget, track};
        type Groups = Vec<(&'static str, &'static [super::Param])>;
        let parts: [(&str, Groups); 5] = [
            (
                include_str!("retarget/params.rs"),
                retarget::params::groups().to_vec(),
            ),
            (
                include_str!("plan/params.rs"),
                plan::params::groups().to_vec(),
            ),
            (
                include_str!("track/params.rs"),
                track::params::groups().to_vec(),
            ),
            (
                include_str!("get_up/params.rs"),
                get_up::params::groups().to_vec(),
            ),
            (
                include_str!("figure/params.rs"),
                figure::params::groups().to_vec(),
            ),
        ];
        for (source, groups) in parts {
            let declared = source.lines().filter_map(|l| l.strip_prefix("pub mod "));
            let declared: Vec<_> = declared.filter_map(|l| l.strip_suffix(" {")).collect();
            let listed: Vec<_> = groups.iter().map(|g| g.0).collect();
            assert_eq!(listed, declared);
        }
    }
}
