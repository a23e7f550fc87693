//! The convex kernel of `docs/equations.md`, 14: one semi-smooth Newton method for the simulator's substep and for the
//! modern controller.
//!
//! Minimise ½ xᵀA x − bᵀx + Σ motors(x_j) + Σ limits(aᵀx) + Σ cones(J_k x + c_k) over x ∈ R⁴⁵. The simulator reads x as
//! velocity and A as inertia; the controller reads x as the price of the dynamics. Every iterate respects strength and
//! friction.

pub(crate) mod cone;
pub mod dense;
pub(crate) mod interior;
pub mod limits;
pub mod newton;
pub mod projection;
pub mod rows;
pub mod slides;
pub mod sparse;
pub mod wrench;

pub use dense::DenseSystem;
pub use interior::Interior;
pub use limits::{LimitRow, LimitRows, Tissue, collect_limits};
pub use newton::{ConvexProblem, Motors, NewtonWorkspace, SolveOutcome, StopRule, minimise};
pub use rows::ContactRows;
pub use slides::Slides;
pub use sparse::SparseSystem;
pub use wrench::{BallForce, RootWrench};

#[cfg(test)]
mod tests;
