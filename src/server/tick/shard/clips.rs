//! When clips begin and end, for those who watch events.

use super::{Member, Shard};
use crate::server::engine;
use crate::wire::types::EventKind;

/// A clip that plays: its id, and the world time of its start, s.
pub(super) type Playing = (String, f64);

impl Shard {
    /// The start of the clip that a figure plays now.
    fn plays(&self, m: &Member) -> Option<f64> {
        m.clip.as_ref()?;
        let figure = self.world.figure(m.key)?;
        engine::playing_since(figure, self.world.time())
    }

    /// What figures play, as it was told last: after a restored state nothing is news.
    pub(super) fn note_clips(&mut self) {
        for i in 0..self.members.len() {
            let since = self.plays(&self.members[i]);
            let m = &mut self.members[i];
            m.told = since.and_then(|since| Some((m.clip.clone()?, since)));
        }
    }

    /// Tells of clips that have begun or ended since the last call.
    pub(super) fn tell_clips(&mut self) {
        for i in 0..self.members.len() {
            let since = self.plays(&self.members[i]);
            let m = &mut self.members[i];
            let same = match (&m.told, since) {
                (None, None) => true,
                (Some((id, told)), Some(since)) => *told == since && Some(id) == m.clip.as_ref(),
                _ => false,
            };
            if same {
                continue;
            }
            let figure = m.id.clone();
            let begun = since.and_then(|since| Some((m.clip.clone()?, since)));
            let ended = std::mem::replace(&mut m.told, begun.clone());
            if let Some((id, _)) = ended {
                self.event(&figure, EventKind::ClipEnded(id));
            }
            if let Some((id, _)) = begun {
                self.event(&figure, EventKind::ClipBegan(id));
            }
        }
    }
}
