//! Types of time: one for each axis on which the times of a desired motion are counted.
//!
//! The axes differ in their zero and in the clock that moves them, so a time on one axis is none on another. Each
//! conversion stands in one function. A drawing of all axes is in `docs/tick.md#time-axes`.
//!
//! Footstep tracking ([`crate::track`]) counts in the time of the plan that it follows, which is that of a clip or that
//! of a stream, in plain seconds: there is only one axis within a plan.

/// Declares types for times on different axes, in seconds. A time plus or minus a number of seconds is a time on the
/// same axis, and the difference of two times on one axis is a number of seconds. They are stored as plain numbers.
///
/// The crate that uses it needs `serde`.
///
/// ```
/// sinew_physics::time_axes! {
///     /// Time since the beginning of the day.
///     pub struct DayTime;
/// }
/// let noon = DayTime(43_200.0);
/// assert_eq!((noon + 60.0) - noon, 60.0);
/// ```
#[macro_export]
macro_rules! time_axes {
    ($($(#[$doc:meta])* pub struct $name:ident;)+) => {$(
        $(#[$doc])*
        #[derive(
            Clone, Copy, Debug, Default, PartialEq, PartialOrd, ::serde::Serialize, ::serde::Deserialize,
        )]
        #[serde(transparent)]
        pub struct $name(
            /// Seconds.
            pub f64,
        );

        impl $name {
            /// Whether it is neither infinite nor NaN.
            #[must_use]
            pub fn is_finite(self) -> bool {
                self.0.is_finite()
            }

            /// The later one of two times, by the rules of [`f64::max`].
            #[must_use]
            pub fn max(self, other: Self) -> Self {
                Self(self.0.max(other.0))
            }

            /// The earlier one of two times, by the rules of [`f64::min`].
            #[must_use]
            pub fn min(self, other: Self) -> Self {
                Self(self.0.min(other.0))
            }
        }

        impl ::core::ops::Add<f64> for $name {
            type Output = Self;
            fn add(self, seconds: f64) -> Self {
                Self(self.0 + seconds)
            }
        }

        impl ::core::ops::Sub<f64> for $name {
            type Output = Self;
            fn sub(self, seconds: f64) -> Self {
                Self(self.0 - seconds)
            }
        }

        impl ::core::ops::Sub for $name {
            type Output = f64;
            fn sub(self, other: Self) -> f64 {
                self.0 - other.0
            }
        }
    )+};
}

time_axes! {
    /// Simulated time since the world began, s. It stands still while the clock of the world does.
    pub struct WorldTime;

    /// Time within a clip, s: 0 is the first frame, and the lead-in comes before.
    pub struct MotionTime;

    /// Time within a prepared stream, s: 0 is the first sample.
    pub struct StreamTime;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_in_seconds_and_shifts_a_time() {
        let t = WorldTime(1.5);
        assert_eq!((t + 0.25, t - 0.25), (WorldTime(1.75), WorldTime(1.25)));
        assert_eq!(t - WorldTime(1.0), 0.5);
        assert_eq!((t.max(WorldTime(f64::NAN)), t.min(t + 1.0)), (t, t));
        assert!(t > t - 1.0 && t.partial_cmp(&WorldTime(f64::NAN)).is_none());
        assert!(t.is_finite() && !WorldTime(f64::NAN).is_finite());
    }
}
