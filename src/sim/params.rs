//! Tunable numbers: each is declared once, in the `params` module of its part, with unit, range and source.
//!
//! A parameter is a constant, so it costs nothing in a tick. [`crate::parameters`] lists them all, and the command
//! `sinew parameters` prints them.

/// A tunable number and what is known about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Param {
    /// Name of the constant.
    pub name: &'static str,
    /// Its documentation.
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

/// The tunable numbers of one subject.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParamGroup {
    /// Part of the physics that declares them.
    pub part: &'static str,
    /// Their module within `params` of that part.
    pub name: &'static str,
    /// The numbers, in the order of their declaration.
    pub all: &'static [Param],
}

impl ParamGroup {
    /// Path of the module that declares the numbers, within this crate.
    pub fn module(&self) -> String {
        format!("{}::params::{}", self.part, self.name)
    }
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

        /// Everything that is declared here, in order.
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

    /// A group that is missing in the list is neither printed nor checked.
    #[test]
    fn every_module_of_parameters_is_in_the_list_of_its_part() {
        use crate::{control, figure, get_up, paper, plan, reference, stepper, track};
        type Groups = Vec<(&'static str, &'static [super::Param])>;
        let parts: [(&str, Groups); 8] = [
            (
                include_str!("reference/params.rs"),
                reference::params::groups().to_vec(),
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
                include_str!("control/params.rs"),
                control::params::groups().to_vec(),
            ),
            (
                include_str!("stepper/params.rs"),
                stepper::params::groups().to_vec(),
            ),
            (
                include_str!("paper/params.rs"),
                paper::params::groups().to_vec(),
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

    #[test]
    fn every_parameter_has_a_unit_a_text_a_source_and_a_value_in_its_range() {
        let mut names = std::collections::BTreeSet::new();
        for group in crate::parameters() {
            for p in group.all {
                let at = format!("{} {}", group.module(), p.name);
                let [low, high] = p.range;
                assert!(low < high, "{at}: {low} to {high} is no range");
                assert!(
                    low <= p.value && p.value <= high,
                    "{at}: {} is outside {low} to {high}",
                    p.value
                );
                assert!(
                    ![p.unit, p.what.trim(), p.source].contains(&""),
                    "{at}: unit, text or source is missing"
                );
                assert!(names.insert(at.clone()), "{at}: declared twice");
            }
        }
    }
}
