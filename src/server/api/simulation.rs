//! `SimulationService`.

use super::{Api, answer, caller, client};
use crate::server::engine;
use crate::server::library::Manner;
use crate::server::simulate::{self, Limits};
use crate::sim::plan::cycle;
use crate::wire::convert::simulation::{self, Source};
use crate::wire::pb::{self, simulation_service_server::SimulationService};
use std::sync::Arc;
use tonic::{Request, Response, Status};

#[tonic::async_trait]
impl SimulationService for Api {
    async fn simulate_clip(
        &self,
        request: Request<pb::SimulateClipRequest>,
    ) -> Result<Response<pb::SimulateClipResponse>, Status> {
        let result = async {
            let limits = Limits {
                seconds: self.config.max_simulation_s,
                bytes: self.config.max_response_bytes,
            };
            let client = client(&request);
            let caller = caller(&request)?.clone();
            let (source, settings) = simulation::settings(
                request.into_inner(),
                self.config.max_clip_bytes,
                limits.seconds,
            )?;
            if let Source::Clip(id) = &source {
                super::clips::seen(self, &caller, id)?; // an unknown name does not wait for its turn
            }
            let app = self.0.clone();
            self.simulations
                .run(&client, move |turn| {
                    let stop = || turn.stop();
                    let body_id = settings.figure.body.id.clone();
                    let body = app.bodies.get("figure.profile", &settings.figure.body)?;
                    let (clip, report) = match source {
                        Source::Clip(id) => {
                            let manner = Manner::recorded(settings.looped);
                            (
                                app.clips.prepared(&id, &body_id, &body, manner, &stop)?,
                                None,
                            )
                        }
                        Source::File(file) => {
                            let (clip, report) =
                                engine::prepare("bvh", "upload", &file, &body, 1.0, &stop)?;
                            let clip = Arc::new(clip);
                            let repeats = settings.looped.then(|| cycle(&body, &clip)).flatten();
                            (repeats.map_or(clip, Arc::new), report)
                        }
                    };
                    let out = simulate::run(&settings, &body, clip, limits, turn)?;
                    Ok(simulation::response(
                        &out.summary,
                        out.frames,
                        &out.events,
                        report.as_ref(),
                    ))
                })
                .await
        };
        answer(result.await)
    }
}
