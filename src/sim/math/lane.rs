//! The scalar of the kernels: one `f64`, or eight of them side by side.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number of one figure (`f64`) or of eight figures in lock-step ([`F64x8`]).
///
/// Every operation acts on each lane separately with IEEE rounding, so lane `k` of a batched kernel carries exactly the
/// bits that the scalar kernel computes for figure `k`.
pub trait Lane:
    Copy
    + Clone
    + Default
    + std::fmt::Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + Send
    + Sync
    + 'static
{
    /// Number of figures that one value holds.
    const LANES: usize;
    /// The same number in every lane.
    fn splat(x: f64) -> Self;
    /// Number of lane `k` (`k < LANES`).
    fn lane(self, k: usize) -> f64;
    /// Replaces the number of lane `k`.
    fn set_lane(&mut self, k: usize, x: f64);
    /// Square root per lane.
    fn sqrt(self) -> Self;
    /// Absolute value per lane.
    fn abs(self) -> Self;
    /// Larger of two per lane (`b` where `a` is NaN).
    fn max(self, b: Self) -> Self;
    /// Smaller of two per lane (`b` where `a` is NaN).
    fn min(self, b: Self) -> Self;
    /// Nearest integer per lane, ties to even.
    fn round_even(self) -> Self;
    /// `t` where `self < b`, else `f`, per lane.
    fn select_lt(self, b: Self, t: Self, f: Self) -> Self;
    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::splat(1.0)
    }
}

/// Adding and subtracting 1.5·2⁵² rounds to the nearest integer under round-to-nearest-even, for |x| < 2⁵¹.
const ROUND_MAGIC: f64 = 6_755_399_441_055_744.0;

impl Lane for f64 {
    const LANES: usize = 1;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn set_lane(&mut self, _: usize, x: f64) {
        *self = x;
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        if self > b { self } else { b }
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        if self < b { self } else { b }
    }
    #[inline(always)]
    fn round_even(self) -> Self {
        (self + ROUND_MAGIC) - ROUND_MAGIC
    }
    #[inline(always)]
    fn select_lt(self, b: Self, t: Self, f: Self) -> Self {
        if self < b { t } else { f }
    }
}

/// Eight `f64` of eight figures; plain array arithmetic that the compiler turns into AVX-512, AVX2 or SSE2 registers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct F64x8(pub [f64; 8]);

impl Default for F64x8 {
    fn default() -> Self {
        Self([0.0; 8])
    }
}

macro_rules! lanewise {
    ($trait:ident, $f:ident, $op:tt) => {
        impl $trait for F64x8 {
            type Output = Self;
            #[inline(always)]
            fn $f(self, b: Self) -> Self {
                let mut r = [0.0; 8];
                for k in 0..8 {
                    r[k] = self.0[k] $op b.0[k];
                }
                Self(r)
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl Neg for F64x8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::map(self, |x| -x)
    }
}
impl AddAssign for F64x8 {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}
impl SubAssign for F64x8 {
    #[inline(always)]
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}
impl MulAssign for F64x8 {
    #[inline(always)]
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl F64x8 {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut r = [0.0; 8];
        for k in 0..8 {
            r[k] = f(self.0[k]);
        }
        Self(r)
    }
    #[inline(always)]
    fn zip(self, b: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut r = [0.0; 8];
        for k in 0..8 {
            r[k] = f(self.0[k], b.0[k]);
        }
        Self(r)
    }
}

impl Lane for F64x8 {
    const LANES: usize = 8;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; 8])
    }
    #[inline(always)]
    fn lane(self, k: usize) -> f64 {
        self.0[k]
    }
    #[inline(always)]
    fn set_lane(&mut self, k: usize, x: f64) {
        self.0[k] = x;
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        self.zip(b, <f64 as Lane>::max)
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        self.zip(b, <f64 as Lane>::min)
    }
    #[inline(always)]
    fn round_even(self) -> Self {
        self.map(<f64 as Lane>::round_even)
    }
    #[inline(always)]
    fn select_lt(self, b: Self, t: Self, f: Self) -> Self {
        let mut r = [0.0; 8];
        for k in 0..8 {
            r[k] = if self.0[k] < b.0[k] { t.0[k] } else { f.0[k] };
        }
        Self(r)
    }
}
