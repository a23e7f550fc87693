//! Changes of a world between ticks.

use super::hosted_world::HostedWorld;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The sender of a command and its order: commands in the same tick run by (client, sequence), so that a replay is
/// exact.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CommandOrigin {
    /// The client that sends it.
    pub client: Arc<str>,
    /// Number of the request from that client.
    pub sequence: i64,
}

/// A change of a world or a question to it, executed by its thread at the start of a tick.
pub struct WorldCommand {
    /// The sender.
    pub origin: CommandOrigin,
    /// The change.
    pub action: Box<dyn FnOnce(&mut HostedWorld) + Send>,
}

/// Why a command was not accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The queue is full.
    Full,
    /// The world has ended, or its tick does not end.
    Closed,
}

/// Commands that wait for a world. It takes memory only while some are waiting.
#[derive(Debug)]
pub struct CommandQueue {
    waiting: Mutex<QueuedCommands>,
    most: usize,
}

#[derive(Default)]
struct QueuedCommands {
    commands: VecDeque<WorldCommand>,
    closed: bool,
}

impl std::fmt::Debug for QueuedCommands {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} commands", self.commands.len())
    }
}

impl CommandQueue {
    /// An empty queue that holds `most`.
    pub fn new(most: usize) -> Self {
        Self {
            waiting: Mutex::default(),
            most,
        }
    }

    fn waiting(&self) -> MutexGuard<'_, QueuedCommands> {
        // Commands are added and taken whole.
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a command.
    ///
    /// # Errors
    /// There is no room, or the world has ended.
    pub fn push(&self, command: WorldCommand) -> Result<(), Refusal> {
        let mut waiting = self.waiting();
        if waiting.closed {
            return Err(Refusal::Closed);
        }
        if waiting.commands.len() >= self.most {
            return Err(Refusal::Full);
        }
        waiting.commands.push_back(command);
        Ok(())
    }

    /// Accepts no more commands. Waiting ones are dropped, which also tells callers that wait for an answer.
    pub fn close(&self) {
        let mut waiting = self.waiting();
        waiting.closed = true;
        let dropped = std::mem::take(&mut waiting.commands);
        drop(waiting);
        drop(dropped);
    }
}

/// Commands on their way into ticks. Those that a tick has no time for come first in the next one.
pub struct Inbox {
    queue: Arc<CommandQueue>,
    ready: VecDeque<WorldCommand>,
}

impl Inbox {
    /// Commands of `queue`; at most as many again as it holds are ready for a tick.
    pub fn new(queue: Arc<CommandQueue>) -> Self {
        Self {
            queue,
            ready: VecDeque::new(),
        }
    }

    /// Takes the commands that have arrived. Returns whether more may come.
    pub fn fetch(&mut self) -> bool {
        let mut waiting = self.queue.waiting();
        let room = self.queue.most - self.ready.len();
        let many = waiting.commands.len().min(room);
        let mut fresh: Vec<WorldCommand> = waiting.commands.drain(..many).collect();
        if waiting.commands.is_empty() {
            waiting.commands = VecDeque::new();
        }
        let more = !waiting.closed;
        drop(waiting);
        // The sort is stable: commands of one client and sequence stay in the order of arrival.
        fresh.sort_by(|a, b| a.origin.cmp(&b.origin));
        self.ready.extend(fresh);
        more || !self.ready.is_empty()
    }

    /// The next command.
    pub fn take(&mut self) -> Option<WorldCommand> {
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

    fn command(client: &str, sequence: i64) -> WorldCommand {
        WorldCommand {
            origin: CommandOrigin {
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
        let queue = Arc::new(CommandQueue::new(8));
        let mut inbox = Inbox::new(queue.clone());
        for (client, sequence) in [("b", 2), ("a", 9), ("b", 1)] {
            queue.push(command(client, sequence)).unwrap();
        }
        assert!(inbox.fetch());
        assert_eq!(taken(&mut inbox), Some(("a".into(), 9)));
        queue.push(command("a", 0)).unwrap();
        assert!(inbox.fetch());
        queue.close();
        assert!(inbox.fetch(), "there are some left");
        let rest: Vec<_> = std::iter::from_fn(|| taken(&mut inbox)).collect();
        assert_eq!(
            rest,
            [("b".into(), 1), ("b".into(), 2), ("a".into(), 0)],
            "what came later does not push in"
        );
        assert!(!inbox.fetch());
        assert_eq!(queue.push(command("a", 1)), Err(Refusal::Closed));
    }

    #[test]
    fn a_flood_fills_the_queue_and_nothing_else() {
        let queue = Arc::new(CommandQueue::new(8));
        let mut inbox = Inbox::new(queue.clone());
        let mut sent = 0;
        for _ in 0..100 {
            while queue.push(command("a", 0)).is_ok() {
                sent += 1;
            }
            assert_eq!(queue.push(command("a", 0)), Err(Refusal::Full));
            assert!(inbox.fetch());
        }
        assert_eq!((sent, inbox.left()), (16, 8));
    }
}
