//! Live desired motion: the stream and its unary twin take the same way into the world.

use super::{Api, Place, refusal, stopped};
use crate::server::tick::command::Origin;
use crate::server::worlds::WorldHandle;
use crate::wire::convert::motion;
use crate::wire::pb::{self, drive_figures_request::Message};
use crate::wire::status::Fault;
use crate::wire::types::{Feedback, MotionSample};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{mpsc, watch};
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Response, Status, Streaming};

/// What a driver is told, as it comes.
pub type Feedbacks = ReceiverStream<Result<pb::DriveFiguresResponse, Status>>;

/// Time for the header to come after the stream was opened.
const HEADER_TIME: Duration = Duration::from_secs(10);
/// Interval of feedback.
const FEEDBACK_EVERY: Duration = Duration::from_millis(100);
/// Feedback that waits for a driver who does not read; more is left out.
const FEEDBACK_QUEUE: usize = 16;

fn origin(driver: &str, batch: &[MotionSample]) -> Origin {
    Origin {
        client: driver.into(),
        sequence: batch.first().map_or(0, |s| s.sequence),
    }
}

/// A batch by a unary call.
pub(super) async fn push(
    api: &Api,
    r: pb::PushMotionRequest,
) -> Result<pb::PushMotionResponse, Fault> {
    let header = r
        .header
        .ok_or_else(|| Fault::invalid("header", "must be given"))?;
    let open = motion::drive_open("header", &header)?;
    let batch = motion::batch("batch", &r.batch.unwrap_or_default(), &open.figures)?;
    let handle = api.worlds.get(&open.world)?;
    let feedback = handle
        .call(origin(&open.driver, &batch), move |s| {
            let driver = s.open_drive(&open, None)?;
            if !s.drive(&driver, None, batch)? {
                return Err(Fault::Exhausted {
                    limit: "batches_per_second",
                    value: crate::server::ingest::admission::BATCHES_PER_SECOND as u64,
                    message: "send fewer, larger batches".into(),
                    retry: Some(Duration::from_millis(100)),
                });
            }
            s.feedback(&driver, None)
        })
        .await?;
    Ok(pb::PushMotionResponse {
        feedback: Some(motion::feedback_out(&feedback)),
    })
}

/// A stream of batches.
pub(super) async fn stream(
    api: &Api,
    mut inbound: Streaming<pb::DriveFiguresRequest>,
) -> Result<Response<Feedbacks>, Status> {
    let place = api.drivers.take().map_err(refusal)?;
    let first = tokio::time::timeout(HEADER_TIME, inbound.message())
        .await
        .map_err(|_| refusal(Fault::invalid("header", "did not come within 10 s")))??;
    let Some(Message::Header(header)) = first.and_then(|m| m.message) else {
        return Err(refusal(Fault::invalid(
            "header",
            "must be the first message",
        )));
    };
    let open = motion::drive_open("header", &header).map_err(refusal)?;
    let handle = api.worlds.get(&open.world).map_err(refusal)?;
    let connection = api.next_stream();
    let figures = open.figures.clone();
    let driver = handle
        .call(origin(&open.driver, &[]), move |s| {
            s.open_drive(&open, Some(connection))
        })
        .await
        .map_err(refusal)?;
    let (out, feedbacks) = mpsc::channel(FEEDBACK_QUEUE);
    let session = Session {
        handle,
        driver,
        figures,
        connection,
        out,
        refused: 0,
        ended: false,
        _place: place,
    };
    tokio::spawn(session.run(inbound, api.stopping.clone()));
    Ok(Response::new(ReceiverStream::new(feedbacks)))
}

struct Session {
    handle: Arc<WorldHandle>,
    driver: String,
    figures: Vec<String>,
    connection: u64,
    out: mpsc::Sender<Result<pb::DriveFiguresResponse, Status>>,
    refused: u64,
    ended: bool,
    _place: Place,
}

impl Session {
    async fn run(
        mut self,
        mut inbound: Streaming<pb::DriveFiguresRequest>,
        mut stopping: watch::Receiver<bool>,
    ) {
        let mut closed = self.handle.closed.clone();
        let mut timer = tokio::time::interval(FEEDBACK_EVERY);
        timer.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
        let lost = loop {
            let step = tokio::select! {
                message = inbound.message() => match message {
                    Ok(Some(m)) => self.take(m),
                    Ok(None) => break false,
                    // A message that was refused says why; a connection that broke says nothing of ours.
                    Err(status) if !status.details().is_empty() => {
                        let _ = self.out.try_send(Err(status));
                        break false;
                    }
                    Err(_) => break true,
                },
                _ = timer.tick() => self.feedback().await,
                // An error means that the world's thread is gone, which says the same.
                _ = closed.changed() => Err(Fault::not_found("world", format!("worlds/{}", self.handle.id))),
                () = stopped(&mut stopping) => Err(Fault::Draining),
            };
            match step {
                Ok(true) => {}
                Ok(false) => break true, // nobody reads the feedback: the connection is gone
                Err(fault) => {
                    // The reader may have a full queue; it learns of the end in any case.
                    let _ = self.out.try_send(Err(refusal(fault)));
                    break false;
                }
            }
        };
        if !lost {
            // Everything that was sent has been taken: say so before the figures are given back.
            let _ = self.feedback().await;
        }
        self.close(lost);
    }

    /// Checks a batch and queues it; true to go on.
    fn take(&mut self, m: pb::DriveFiguresRequest) -> Result<bool, Fault> {
        let Some(Message::Batch(b)) = m.message else {
            return Err(Fault::invalid(
                "message",
                "must be a batch after the header",
            ));
        };
        let batch = motion::batch("batch", &b, &self.figures)?;
        let (driver, connection, refused) = (self.driver.clone(), self.connection, self.refused);
        let sent = self.handle.send(origin(&self.driver, &batch), move |s| {
            s.refused(&driver, refused);
            // A fenced stream learns so from its next feedback.
            let _ = s.drive(&driver, Some(connection), batch);
        });
        match sent {
            Ok(()) => self.refused = 0,
            Err(Fault::Exhausted { .. }) => self.refused += 1,
            Err(gone) => return Err(gone),
        }
        Ok(true)
    }

    /// Tells the driver; true to go on.
    async fn feedback(&mut self) -> Result<bool, Fault> {
        let (driver, connection) = (self.driver.clone(), self.connection);
        let feedback: Feedback = match self
            .handle
            .call(origin(&self.driver, &[]), move |s| {
                s.feedback(&driver, Some(connection))
            })
            .await
        {
            Ok(f) => f,
            Err(Fault::Exhausted { .. }) => return Ok(true), // next time
            Err(fault) => return Err(fault),
        };
        let message = pb::DriveFiguresResponse {
            feedback: Some(motion::feedback_out(&feedback)),
        };
        Ok(match self.out.try_send(Ok(message)) {
            Ok(()) | Err(mpsc::error::TrySendError::Full(_)) => true,
            Err(mpsc::error::TrySendError::Closed(_)) => false,
        })
    }

    fn close(&mut self, kept: bool) {
        if std::mem::replace(&mut self.ended, true) {
            return;
        }
        let (driver, connection) = (self.driver.clone(), self.connection);
        // After everything that this driver has queued.
        let last = Origin {
            client: self.driver.as_str().into(),
            sequence: i64::MAX,
        };
        if self
            .handle
            .send(last.clone(), move |s| {
                s.close_drive(&driver, connection, kept)
            })
            .is_err_and(|f| matches!(f, Fault::Exhausted { .. }))
        {
            let (handle, driver) = (self.handle.clone(), self.driver.clone());
            tokio::spawn(async move {
                // The queue is full for now; the figures must be given back all the same.
                loop {
                    tokio::time::sleep(Duration::from_millis(50)).await;
                    let driver = driver.clone();
                    let sent = handle.send(last.clone(), move |s| {
                        s.close_drive(&driver, connection, kept);
                    });
                    if !matches!(sent, Err(Fault::Exhausted { .. })) {
                        return;
                    }
                }
            });
        }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // The task was ended from outside: the driver may come back.
        self.close(true);
    }
}
