//! The desired motion of a figure: its source, the activity that it is part of, and the plans that lead from one motion
//! to the next.

pub(in crate::figure) mod activity;
pub mod clip_playback;
pub(in crate::figure) mod exit;
pub mod following;
pub(in crate::figure) mod get_up;
pub mod plan_task;
pub mod rehearsal_playback;
pub mod rehearsed;
pub mod source;
pub(in crate::figure) mod stream_entry;
pub mod tasks;
