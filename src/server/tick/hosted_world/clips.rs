//! The beginning and end of clips, for viewers of events.

use super::{HostedWorld, PlayingClip};
use crate::engine;
use crate::tick::scene::Member;
use sinew_wire::types::EventKind;

impl HostedWorld {
    /// The clip that a figure plays now.
    fn plays(&self, m: &Member) -> Option<PlayingClip> {
        let id = m.clip.as_ref()?;
        let world = self.scene.world();
        let since = engine::playing_since(world.figure(m.key)?, world.time())?;
        Some((id.clone(), since))
    }

    /// Notes the clips that figures play as announced: after a restored state none of them is news.
    pub(super) fn note_clips(&mut self) {
        let members = self.scene.members().iter();
        let told = members.filter_map(|m| Some((m.key, self.plays(m)?)));
        self.told = told.collect();
    }

    /// Announces clips that have begun or ended since the last call.
    pub(super) fn tell_clips(&mut self) {
        let members = self.scene.members();
        // Removed figures are announced elsewhere.
        self.told
            .retain(|key, _| members.iter().any(|m| m.key == *key));
        for i in 0..self.scene.members().len() {
            let m = &self.scene.members()[i];
            let since = match &m.clip {
                Some(_) => {
                    engine::playing_since(self.scene.figure(m.key), self.scene.world().time())
                }
                None => None,
            };
            let same = match (self.told.get(&m.key), since) {
                (None, None) => true,
                (Some((id, told)), Some(since)) => *told == since && Some(id) == m.clip.as_ref(),
                _ => false,
            };
            if same {
                continue;
            }
            let (figure, key) = (m.id.clone(), m.key);
            let begun = self.plays(m);
            let ended = match &begun {
                Some(begun) => self.told.insert(key, begun.clone()),
                None => self.told.remove(&key),
            };
            if let Some((id, _)) = ended {
                self.event(&figure, EventKind::ClipEnded(id));
            }
            if let Some((id, _)) = begun {
                self.event(&figure, EventKind::ClipBegan(id));
            }
        }
    }
}
