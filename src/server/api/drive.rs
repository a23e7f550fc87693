//! Live desired motion: the stream and its unary twin enter the world in the same way.

use super::permit::{Ending, Permit};
use super::{Api, HeldPlace, refusal};
use crate::access::caller::Caller;
use crate::ingest::mailbox::{DriverId, Mailbox};
use crate::tick::command::CommandOrigin;
use crate::worlds::WorldHandle;
use sinew_wire::convert::motion;
use sinew_wire::pb::{self, drive_figures_request::Message};
use sinew_wire::status::Fault;
use sinew_wire::types::DriveOpen;
use std::pin::pin;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Response, Status, Streaming};

/// Feedback to a driver.
pub type Feedbacks = ReceiverStream<Result<pb::DriveFiguresResponse, Status>>;

/// Time that the header may take to arrive after the stream was opened.
const HEADER_TIME: Duration = Duration::from_secs(10);
/// Interval of feedback.
const FEEDBACK_EVERY: Duration = Duration::from_millis(100);
/// Longest time for which feedback that is due waits for the driver's next message: no timer has to wake for it then,
/// and the next message does not arrive while the world is being asked.
const FEEDBACK_SLACK: Duration = Duration::from_millis(20);
/// How long the reason for the end of a stream waits for a driver that does not read.
const LAST_WORD: Duration = Duration::from_secs(5);
/// Name of a pusher that gives none.
const PUSHER: &str = "push";
/// Feedback that waits for a driver that does not read; more is left out.
const FEEDBACK_QUEUE: usize = 16;

/// The driver's commands come before those that end its drive.
fn origin(driver: &DriverId) -> CommandOrigin {
    CommandOrigin {
        client: driver.to_string().into(),
        sequence: 0,
    }
}

/// The drive that a header names; its driver may still be nameless.
fn id(open: &DriveOpen) -> DriverId {
    DriverId {
        principal: open.who.principal.clone(),
        name: open.driver.as_str().into(),
    }
}

/// The world of a header, for a caller that may drive all of its figures.
fn enter(api: &Api, caller: &Caller, open: &DriveOpen) -> Result<Arc<WorldHandle>, Fault> {
    let figures: Vec<&str> = open.figures.iter().map(String::as_str).collect();
    api.enter_for(caller, &open.world, &figures)
}

/// A batch by a unary call. Only the first one of a drive waits for the world.
pub(super) async fn push(
    api: &Api,
    caller: &Caller,
    r: pb::PushMotionRequest,
) -> Result<pb::PushMotionResponse, Fault> {
    let header = r
        .header
        .ok_or_else(|| Fault::invalid("header", "must be given"))?;
    let mut open = motion::drive_open("header", &header, caller.principal())?;
    if open.driver.is_empty() {
        PUSHER.clone_into(&mut open.driver);
    }
    let raw = r.batch.unwrap_or_default();
    let handle = enter(api, caller, &open)?;
    let known = handle.mailboxes.of(&id(&open), &open.figures);
    // Tokens other than those it was opened with cause the leases to be checked again.
    let known = known.filter(|m| m.tokens() == open.who.tokens);
    if let Some(mailbox) = &known {
        mailbox.admit(motion::postures(&raw), Instant::now())?;
    }
    let batch = motion::batch("batch", &raw, &open.figures)?;
    let mailbox = match known.filter(|m| m.ended().is_none()) {
        Some(mailbox) => mailbox,
        None => opened(&handle, open, None).await?,
    };
    // A drive that is just ending refuses the batch like one that has ended.
    mailbox.deliver(None, batch, Instant::now())?;
    Ok(pb::PushMotionResponse {
        feedback: Some(motion::feedback_out(&mailbox.feedback())),
    })
}

async fn opened(
    handle: &WorldHandle,
    open: DriveOpen,
    stream: Option<u64>,
) -> Result<Arc<Mailbox>, Fault> {
    handle
        .call(origin(&id(&open)), move |s| s.open_drive(&open, stream))
        .await
}

/// A stream of batches.
pub(super) async fn stream(
    api: &Api,
    caller: Caller,
    mut inbound: Streaming<pb::DriveFiguresRequest>,
) -> Result<Response<Feedbacks>, Status> {
    let place = api.drivers.take(caller.client.clone()).map_err(refusal)?;
    let first = tokio::time::timeout(HEADER_TIME, inbound.message())
        .await
        .map_err(|_| refusal(Fault::invalid("header", "did not come within 10 s")))??;
    let Some(Message::Header(header)) = first.and_then(|m| m.message) else {
        return Err(refusal(Fault::invalid(
            "header",
            "must be the first message",
        )));
    };
    let open = motion::drive_open("header", &header, caller.principal()).map_err(refusal)?;
    let handle = enter(api, &caller, &open).map_err(refusal)?;
    let permit = Permit::new(api, &handle, &caller, &open.figures);
    let connection = api.next_stream();
    let mailbox = opened(&handle, open, Some(connection))
        .await
        .map_err(refusal)?;
    let (out, feedbacks) = mpsc::channel(FEEDBACK_QUEUE);
    let session = Session {
        handle,
        mailbox,
        connection,
        out,
        ended: false,
        _place: place,
    };
    tokio::spawn(session.run(inbound, permit.ending(api.stopping.clone())));
    Ok(Response::new(ReceiverStream::new(feedbacks)))
}

struct Session {
    handle: Arc<WorldHandle>,
    mailbox: Arc<Mailbox>,
    connection: u64,
    out: mpsc::Sender<Result<pb::DriveFiguresResponse, Status>>,
    ended: bool,
    _place: HeldPlace,
}

impl Session {
    async fn run(mut self, mut inbound: Streaming<pb::DriveFiguresRequest>, mut ending: Ending) {
        let mut due = Instant::now();
        let mut timer = pin!(tokio::time::sleep(Duration::ZERO));
        let lost = loop {
            let taken = tokio::select! {
                message = inbound.message() => match message {
                    Ok(Some(m)) => self.take(m),
                    Ok(None) => break false,
                    // A refused message says why. A broken connection has no reason of ours.
                    Err(status) if !status.details().is_empty() => {
                        let _ = self.out.try_send(Err(status));
                        break false;
                    }
                    Err(_) => break true,
                },
                () = &mut timer => Ok(()),
                fault = &mut ending => Err(fault),
            };
            let step = match taken {
                Ok(()) if due <= Instant::now() => {
                    let told = self.feedback().await;
                    due = (due + FEEDBACK_EVERY).max(Instant::now());
                    timer.as_mut().reset((due + FEEDBACK_SLACK).into());
                    told
                }
                taken => taken.map(|()| true),
            };
            match step {
                Ok(true) => {}
                Ok(false) => break true, // the feedback has no reader any more: the connection is gone
                Err(fault) => {
                    // A reader whose queue is full gets the reason as soon as there is room.
                    let (out, status) = (self.out.clone(), refusal(fault));
                    if let Err(mpsc::error::TrySendError::Full(last)) = out.try_send(Err(status)) {
                        tokio::spawn(tokio::time::timeout(LAST_WORD, async move {
                            let _ = out.send(last).await; // it may be gone
                        }));
                    }
                    break false;
                }
            }
        };
        if !lost {
            // Every message has been taken: acknowledge that before the figures are given back.
            let _ = self.feedback().await;
        }
        self.close(lost);
    }

    /// Checks a batch and leaves it for the next tick. A batch that comes too fast is dropped and counted.
    fn take(&mut self, m: pb::DriveFiguresRequest) -> Result<(), Fault> {
        let Some(Message::Batch(b)) = m.message else {
            return Err(Fault::invalid(
                "message",
                "must be a batch after the header",
            ));
        };
        let now = Instant::now();
        if self.mailbox.admit(motion::postures(&b), now).is_ok() {
            let batch = motion::batch("batch", &b, self.mailbox.figures())?;
            self.mailbox.deliver(Some(self.connection), batch, now)?;
        }
        Ok(())
    }

    /// Sends feedback to the driver; true to continue.
    async fn feedback(&mut self) -> Result<bool, Fault> {
        let (driver, connection) = (self.mailbox.driver().clone(), self.connection);
        let feedback = match self
            .handle
            .call(origin(&driver.clone()), move |s| {
                s.feedback(&driver, connection)
            })
            .await
        {
            Ok(f) => f,
            Err(Fault::Exhausted { .. }) => return Ok(true), // next time
            // The drive is gone: its mailbox knows why.
            Err(fault) => return Err(self.mailbox.ended().unwrap_or(fault)),
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
        let (driver, connection) = (self.mailbox.driver().clone(), self.connection);
        // After everything that this driver has queued.
        let last = CommandOrigin {
            client: driver.to_string().into(),
            sequence: i64::MAX,
        };
        if self
            .handle
            .send(last.clone(), move |s| {
                s.close_drive(&driver, connection, kept)
            })
            .is_err_and(|f| matches!(f, Fault::Exhausted { .. }))
        {
            let (handle, driver) = (self.handle.clone(), self.mailbox.driver().clone());
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
