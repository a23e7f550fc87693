//! Streams of long work: its progress, and at the end its result. The work is given up when the stream ends.

use super::permit::Permit;
use super::{refusal, stopped};
use crate::access::caller::Caller;
use crate::workers::Turn;
use prost::Message as _;
use sinew_wire::pb;
use sinew_wire::status::Fault;
use std::future::{Future, pending};
use std::time::{Duration, Instant};
use tokio::sync::mpsc::error::TrySendError;
use tokio::sync::{mpsc, watch};
use tokio_stream::wrappers::ReceiverStream;
use tonic::Status;

/// Messages to a client.
pub(super) type Messages<M> = ReceiverStream<Result<M, Status>>;

/// Messages that wait for a client that reads slowly.
const QUEUE: usize = 4;
/// How long the last message waits for a client that does not read.
pub(super) const LAST_WORD: Duration = Duration::from_secs(30);
/// Bytes of frames, and time, after which a message of a stream is sent.
pub(super) const PART: (usize, Duration) = (64 * 1024, Duration::from_millis(100));
/// How long work waits for a client that does not read before it is given up: usually, and while others wait for its
/// place.
const PATIENCE: [Duration; 2] = [Duration::from_secs(30), Duration::from_secs(1)];
/// How often it checks whether the client has read.
const LOOK: Duration = Duration::from_millis(5);

/// Approximate bytes of a frame in memory. A frame that shows little takes many times more memory than bytes on the
/// wire.
pub(super) fn memory(frame: &pb::WorldFrame) -> usize {
    let figures = frame.figures.len() * size_of::<pb::FigureFrame>();
    size_of::<pb::WorldFrame>() + figures + frame.encoded_len()
}

/// The channel for messages of work.
pub(super) type MessageSender<M> = mpsc::Sender<Result<M, Status>>;

/// Sends a message of work that has a turn, when the client has room for it.
///
/// # Errors
/// The client is gone, or does not read.
#[allow(
    clippy::disallowed_methods,
    reason = "a worker waits, which makes room for others meanwhile"
)]
pub(super) fn hand_over<M>(out: &MessageSender<M>, message: M, turn: &Turn) -> Result<(), Fault> {
    let mut message = Ok(message);
    let begun = Instant::now();
    loop {
        message = match out.try_send(message) {
            Ok(()) => return Ok(()),
            Err(TrySendError::Closed(_)) => return Err(Turn::gone()),
            Err(TrySendError::Full(message)) => message,
        };
        if turn.stop() {
            return Err(Turn::gone());
        }
        let waited = begun.elapsed();
        let [long, short] = PATIENCE;
        if waited > long || waited > short && turn.is_wanted() {
            let seconds = waited.as_secs();
            return Err(Fault::Aborted {
                reason: "SLOW_READER",
                message: format!("what was sent was not read for {seconds} s"),
            });
        }
        std::thread::sleep(LOOK);
    }
}

/// A stream of long work.
pub(super) struct LongStream<P, L> {
    /// The caller that opened it.
    pub caller: Caller,
    /// Ends the stream together with the caller's role in a world.
    pub permit: Option<Permit>,
    /// Progress of the work.
    pub told: watch::Receiver<Option<f64>>,
    /// Makes a message of the progress; `None` if the work itself sends such messages.
    pub progress: Option<P>,
    /// Makes the last message.
    pub last: L,
}

impl<P, L> LongStream<P, L> {
    /// Does the work.
    pub(super) fn run<M, T>(
        self,
        work: impl Future<Output = Result<T, Fault>> + Send + 'static,
        stopping: watch::Receiver<bool>,
    ) -> Messages<M>
    where
        M: Send + 'static,
        T: Send + 'static,
        P: Fn(f64) -> M + Send + 'static,
        L: FnOnce(T) -> M + Send + 'static,
    {
        self.run_with(|_| work, stopping)
    }

    /// Does work that sends messages of its own.
    pub(super) fn run_with<M, T, W>(
        mut self,
        work: impl FnOnce(MessageSender<M>) -> W,
        mut stopping: watch::Receiver<bool>,
    ) -> Messages<M>
    where
        M: Send + 'static,
        T: Send + 'static,
        P: Fn(f64) -> M + Send + 'static,
        L: FnOnce(T) -> M + Send + 'static,
        W: Future<Output = Result<T, Fault>> + Send + 'static,
    {
        let (out, messages) = mpsc::channel(QUEUE);
        let work = work(out.clone());
        tokio::spawn(async move {
            let mut work = Box::pin(work);
            let end = self.caller.expires_at();
            let expired = async {
                match end {
                    Some(end) => tokio::time::sleep_until(end.into()).await,
                    None => pending().await,
                }
            };
            let mut permit = self.permit.take();
            let ended = async {
                match &mut permit {
                    Some(permit) => permit.ended().await,
                    None => pending().await,
                }
            };
            tokio::pin!(expired, ended);
            let done = loop {
                tokio::select! {
                    done = &mut work => break done,
                    changed = self.told.changed() => {
                        if changed.is_err() {
                            break (&mut work).await; // it is about to end
                        }
                        let share = *self.told.borrow_and_update();
                        if let (Some(message), Some(share)) = (&self.progress, share) {
                            // A slow reader gets fewer messages.
                            let _ = out.try_send(Ok(message(share)));
                        }
                    }
                    () = out.closed() => return,
                    () = stopped(&mut stopping) => break Err(Fault::Draining),
                    () = &mut expired => break Err(Caller::expired()),
                    fault = &mut ended => break Err(fault),
                }
            };
            drop(work);
            let last = done.map(self.last).map_err(refusal);
            // A client that is gone, or does not read, gets no last message.
            let _ = out.send_timeout(last, LAST_WORD).await;
        });
        ReceiverStream::new(messages)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workers::Pool;

    #[tokio::test(flavor = "multi_thread")]
    async fn who_does_not_read_gives_way_to_others() {
        let pool = Pool::new("piece of work", "max_waiting_work", 1, 64);
        let mut unread = Vec::new();
        for n in 0..12 {
            let (out, messages) = mpsc::channel(1);
            unread.push(messages);
            let pool = pool.clone();
            tokio::spawn(async move {
                let stalled = move |turn: &Turn| {
                    hand_over(&out, 1, turn)?;
                    hand_over(&out, 2, turn)
                };
                pool.run(&format!("{n}").into(), stalled).await
            });
        }
        let full = async {
            while unread.iter().filter(|m| m.len() == 1).count() < 8 {
                tokio::time::sleep(LOOK).await;
            }
        };
        let [long, _] = PATIENCE;
        tokio::time::timeout(long / 2, full).await.unwrap();
        let client = "other".into();
        let other = pool.run(&client, |_| Ok(7));
        let other = tokio::time::timeout(long / 2, other).await;
        assert_eq!(other.expect("it has its turn").unwrap(), 7);
    }
}
