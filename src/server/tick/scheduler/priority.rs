//! The system priority of the threads of ticks: as high as the system allows.

use std::fmt;

/// Priority of a thread, the highest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum WorkerPriority {
    /// First in, first out, before all threads without real-time priority.
    Fifo,
    /// A larger part of the processor, and sooner.
    Nice,
    /// Like any other thread.
    Plain,
}

impl WorkerPriority {
    /// By its name in the setting `tick_priority`.
    pub fn by_name(name: &str) -> Option<Self> {
        [Self::Fifo, Self::Nice, Self::Plain]
            .into_iter()
            .find(|p| p.to_string() == name)
    }
}

impl fmt::Display for WorkerPriority {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fifo => "fifo",
            Self::Nice => "nice",
            Self::Plain => "plain",
        })
    }
}

/// The duty of a thread of this module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Duty {
    /// Watches over the others.
    Watch,
    /// Ticks that take little time.
    Short,
    /// Ticks that take long, and ticks without a clock. Never in real time: they could keep the network from being
    /// served.
    Long,
}

#[cfg(target_os = "linux")]
mod linux {
    use super::{Duty, WorkerPriority};
    use std::num::NonZeroU64;
    use thread_priority::{
        NormalThreadSchedulePolicy, RealtimeThreadSchedulePolicy, ThreadPriority,
        ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
        thread_schedule_policy,
    };

    /// A thread, for others that change its priority while it lives.
    #[derive(Clone, Copy, Debug)]
    pub(in super::super) struct Id {
        posix: thread_priority::ThreadId,
        system: rustix::process::Pid,
    }

    impl Id {
        /// This thread.
        pub fn own() -> Self {
            Self {
                posix: thread_native_id(),
                system: rustix::thread::gettid(),
            }
        }
    }

    const FIFO: ThreadSchedulePolicy =
        ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);

    const OTHER: ThreadSchedulePolicy =
        ThreadSchedulePolicy::Normal(NormalThreadSchedulePolicy::Other);

    fn fifo(duty: Duty) -> bool {
        let level = match duty {
            Duty::Watch => 51_u8,
            Duty::Short => 50,
            Duty::Long => return false,
        };
        let level = ThreadPriority::try_from(level);
        level.is_ok_and(|l| set_thread_priority_and_policy(thread_native_id(), l, FIFO).is_ok())
    }

    /// Raises the priority of this thread as far as allowed, but no further than `most`. Returns the resulting
    /// priority.
    pub(in super::super) fn raise(duty: Duty, most: WorkerPriority) -> WorkerPriority {
        // Makes waits end on time, not up to 50 µs later.
        if let Err(e) = rustix::thread::set_current_timer_slack(NonZeroU64::new(1)) {
            tracing::debug!("the timers of a thread stay coarse: {e}");
        }
        if most == WorkerPriority::Fifo && fifo(duty) {
            return WorkerPriority::Fifo;
        }
        let own = Some(rustix::thread::gettid());
        // Threads inherit the priority of the thread that starts them.
        if let Ok(ThreadSchedulePolicy::Realtime(_)) = thread_schedule_policy() {
            let done =
                set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, OTHER);
            tracing::debug!(?done, "a thread is in real time no more");
            let _ = rustix::process::setpriority_process(own, 0); // lowering is always allowed
        }
        let level = if duty == Duty::Long { -5 } else { -10 };
        if most <= WorkerPriority::Nice && rustix::process::setpriority_process(own, level).is_ok()
        {
            return WorkerPriority::Nice;
        }
        WorkerPriority::Plain
    }

    /// Gives the lowest priority to a thread that is still alive: it does not end its work and must not keep others
    /// from theirs.
    pub(in super::super) fn lower(id: Id, had: WorkerPriority) {
        const IDLE: ThreadSchedulePolicy =
            ThreadSchedulePolicy::Normal(NormalThreadSchedulePolicy::Idle);
        if had == WorkerPriority::Fifo
            && let Err(e) = set_thread_priority_and_policy(id.posix, ThreadPriority::Min, IDLE)
        {
            tracing::debug!("a thread that hangs keeps its priority: {e:?}");
        }
        if let Err(e) = rustix::process::setpriority_process(Some(id.system), 19) {
            tracing::debug!("a thread that hangs keeps its priority: {e}");
        }
    }
}

#[cfg(target_os = "linux")]
pub(super) use linux::{Id, lower, raise};

#[cfg(not(target_os = "linux"))]
mod other {
    use super::{Duty, WorkerPriority};

    /// A thread.
    #[derive(Clone, Copy, Debug)]
    pub(in super::super) struct Id;

    impl Id {
        /// This thread.
        pub fn own() -> Self {
            Self
        }
    }

    /// Threads keep their priority.
    pub(in super::super) fn raise(_: Duty, _: WorkerPriority) -> WorkerPriority {
        WorkerPriority::Plain
    }

    /// Threads keep their priority.
    pub(in super::super) fn lower(_: Id, _: WorkerPriority) {}
}

#[cfg(not(target_os = "linux"))]
pub(super) use other::{Id, lower, raise};
