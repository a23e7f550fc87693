//! What is done to a world between ticks.

use super::shard::Shard;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

/// Who asks and in which order: commands that meet in one tick are carried out by (client, sequence), so that a replay
/// is exact.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Origin {
    /// Who asks.
    pub client: Arc<str>,
    /// Number of the request at that client.
    pub sequence: i64,
}

/// A change of a world or a question to it, carried out by its thread at the start of a tick.
pub struct Command {
    /// Who asks.
    pub origin: Origin,
    /// What is done.
    pub action: Box<dyn FnOnce(&mut Shard) + Send>,
}

/// Commands on their way into ticks. Those that a tick has no time for are the first of the next one.
pub struct Inbox {
    queue: Receiver<Command>,
    most: usize,
    ready: VecDeque<Command>,
}

impl Inbox {
    /// Commands of `queue`, which holds `most`; at most as many again are ready for a tick.
    pub fn new(queue: Receiver<Command>, most: usize) -> Self {
        Self {
            queue,
            most,
            ready: VecDeque::new(),
        }
    }

    /// Waits, then takes what has come; with `eager` one command ends the wait. While it waits for a deadline, commands
    /// stay in the queue, so that its limit holds. False when there will be no more.
    #[allow(
        clippy::disallowed_methods,
        reason = "the tick loop waits for its absolute deadline"
    )]
    pub fn wait(&mut self, wait: Duration, eager: bool) -> bool {
        let mut fresh = Vec::new();
        if !eager {
            std::thread::sleep(wait);
        } else if self.ready.is_empty() && !wait.is_zero() {
            match self.queue.recv_timeout(wait) {
                Ok(command) => fresh.push(command),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return false,
            }
        }
        let mut more = true;
        while self.ready.len() + fresh.len() < self.most {
            match self.queue.try_recv() {
                Ok(command) => fresh.push(command),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => {
                    more = false;
                    break;
                }
            }
        }
        // Stable: those of one client and sequence stay in the order of arrival.
        fresh.sort_by(|a, b| a.origin.cmp(&b.origin));
        self.ready.extend(fresh);
        more || !self.ready.is_empty()
    }

    /// The next command.
    pub fn take(&mut self) -> Option<Command> {
        self.ready.pop_front()
    }

    /// Commands that wait for the next tick.
    pub fn left(&self) -> usize {
        self.ready.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::sync_channel;

    fn command(client: &str, sequence: i64) -> Command {
        Command {
            origin: Origin {
                client: client.into(),
                sequence,
            },
            action: Box::new(|_| ()),
        }
    }

    fn taken(inbox: &mut Inbox) -> Option<(String, i64)> {
        let c = inbox.take()?;
        Some((c.origin.client.to_string(), c.origin.sequence))
    }

    #[test]
    fn commands_of_a_round_are_ordered_and_those_left_over_come_first() {
        let (send, queue) = sync_channel(8);
        let mut inbox = Inbox::new(queue, 8);
        for (client, sequence) in [("b", 2), ("a", 9), ("b", 1)] {
            send.send(command(client, sequence)).unwrap();
        }
        assert!(inbox.wait(Duration::ZERO, true));
        assert_eq!(taken(&mut inbox), Some(("a".into(), 9)));
        send.send(command("a", 0)).unwrap();
        drop(send);
        assert!(inbox.wait(Duration::ZERO, false), "there are some left");
        let rest: Vec<_> = std::iter::from_fn(|| taken(&mut inbox)).collect();
        assert_eq!(
            rest,
            [("b".into(), 1), ("b".into(), 2), ("a".into(), 0)],
            "what came later does not push in"
        );
        assert!(!inbox.wait(Duration::ZERO, true));
    }

    #[test]
    fn a_flood_fills_the_queue_and_nothing_else() {
        let (send, queue) = sync_channel(8);
        let mut inbox = Inbox::new(queue, 8);
        let mut sent = 0;
        for _ in 0..100 {
            while send.try_send(command("a", 0)).is_ok() {
                sent += 1;
            }
            assert!(inbox.wait(Duration::ZERO, false));
        }
        assert_eq!((sent, inbox.left()), (16, 8));
    }
}
