//! A simulation without a world, assembled step by step.

use super::Client;
use sinew_wire::pb;
use tonic::Status;

/// A clip tracked by one figure, with the events that affect it. Everything left out has its default.
#[derive(Clone, Debug)]
pub struct Simulation {
    request: pb::SimulateClipRequest,
}

impl Simulation {
    /// A stored or built-in clip, `clips/{clip}`.
    pub fn of_clip(name: &str) -> Self {
        Self::of(pb::simulate_clip_request::Source::Clip(name.to_owned()))
    }

    /// The content of a BVH file.
    pub fn of_bvh(data: Vec<u8>) -> Self {
        let source = pb::BvhSource {
            data: data.into(),
            ..Default::default()
        };
        Self::of(pb::simulate_clip_request::Source::Bvh(source))
    }

    fn of(source: pb::simulate_clip_request::Source) -> Self {
        let request = pb::SimulateClipRequest {
            source: Some(source),
            ..Default::default()
        };
        Self { request }
    }

    /// Body, strength, controller and stepper of the figure.
    #[must_use]
    pub fn figure(mut self, figure: pb::Figure) -> Self {
        self.request.figure = Some(figure);
        self
    }

    /// A load of `mass_kg` at the palm or centre of `segment`, from `start_s` (s) on.
    #[must_use]
    pub fn load(self, segment: &str, mass_kg: f64, start_s: f64) -> Self {
        let load = pb::Load {
            segment: segment.to_owned(),
            mass_kg,
            ..Default::default()
        };
        self.happens(start_s, pb::perturbation::Kind::Load(load))
    }

    /// An impulse (N·s, world axes) on `segment` at `start_s` (s).
    #[must_use]
    pub fn push(self, segment: &str, impulse: [f64; 3], start_s: f64) -> Self {
        let [x, y, z] = impulse;
        let impulse = pb::Impulse {
            segment: segment.to_owned(),
            impulse_newton_seconds: Some(pb::Vector3 { x, y, z }),
            ..Default::default()
        };
        self.happens(start_s, pb::perturbation::Kind::Impulse(impulse))
    }

    /// Anything that can happen to a figure, at `start_s` (s).
    #[must_use]
    pub fn happens(mut self, start_s: f64, kind: pb::perturbation::Kind) -> Self {
        let perturbation = Some(pb::Perturbation {
            kind: Some(kind),
            ..Default::default()
        });
        self.request.perturbations.push(pb::TimedPerturbation {
            start_s,
            perturbation,
        });
        self
    }

    /// Asks for one frame per `divisor` ticks, with these fields of `FigureFrame`, in double precision.
    #[must_use]
    pub fn frames(mut self, divisor: i32, fields: &[&str]) -> Self {
        let paths = fields.iter().map(|&f| f.to_owned()).collect();
        self.request.view = Some(pb::View {
            fields: Some(prost_types::FieldMask { paths }),
            encoding: pb::Encoding::Double.into(),
            rate_divisor: divisor,
            ..Default::default()
        });
        self
    }
}

impl From<Simulation> for pb::SimulateClipRequest {
    fn from(simulation: Simulation) -> Self {
        simulation.request
    }
}

impl Client {
    /// Runs a simulation on the server, as fast as it computes.
    ///
    /// # Errors
    /// Those of the server, for example that there is no such clip.
    pub async fn simulate(
        &self,
        simulation: impl Into<pb::SimulateClipRequest>,
    ) -> Result<pb::SimulateClipResponse, Status> {
        let answer = self.simulations().simulate_clip(simulation.into()).await?;
        Ok(answer.into_inner())
    }

    /// The body `bodies/{body}`: segments, joints and degrees of freedom in the order of frames, without surfaces.
    ///
    /// # Errors
    /// Those of the server, for example when there is no body of that name.
    pub async fn body(&self, name: &str) -> Result<pb::Body, Status> {
        let request = pb::GetBodyRequest {
            name: name.to_owned(),
            ..Default::default()
        };
        let answer = self.bodies().get_body(request).await?.into_inner();
        Ok(answer.body.unwrap_or_default())
    }
}
