//! Clips and their rehearsals: written to disk, and brought back.

use super::described::DescribedClip;
use super::{Persistence, Writing, storage};
use crate::app::App;
use crate::durable::store::{CheckpointStore, ClipRecord, RehearsalRecord};
use crate::library::NewClip;
use crate::rehearsals::Rehearsed;
use bytes::Bytes;
use prost::Message;
use sinew_wire::convert::{body, motion};
use sinew_wire::pb;
use sinew_wire::status::Fault;
use sinew_wire::types::{ClipInfo, FollowSettings};
use std::sync::Arc;

impl Persistence {
    /// Begins to write a clip to disk: the request that created it and the resulting clip. Later changes under its name
    /// are written later.
    ///
    /// # Errors
    /// It cannot be written now.
    pub fn clip_created(
        &self,
        clip: &ClipInfo,
        request: pb::CreateClipRequest,
    ) -> Result<Writing, Fault> {
        let described = DescribedClip {
            clip: Some(motion::clip_out(clip, false)),
            owner: clip.owner.as_deref().map(str::to_owned),
        };
        let mut record = ClipRecord {
            name: clip.id.clone(),
            description: described.encode_to_vec().into(),
            content: Bytes::new(),
        };
        let written = self.keeper.hand_in(move |store| {
            record.content = request.encode_to_vec().into(); // large, so no lock is held here
            store.put_clip(&record)
        });
        written.map(Writing).map_err(storage)
    }

    /// Begins to forget a clip. Later changes under its name are written later.
    ///
    /// # Errors
    /// It cannot be written now.
    pub fn clip_deleted(&self, name: &str) -> Result<Writing, Fault> {
        let name = name.to_owned();
        let done = self.keeper.hand_in(move |store| store.delete_clip(&name));
        done.map(Writing).map_err(storage)
    }

    /// Writes a rehearsal of a clip to disk, replacing others.
    ///
    /// # Errors
    /// It could not be written.
    pub async fn rehearsed(
        &self,
        clip: &str,
        found: &Arc<Rehearsed>,
        instead_of: &[Arc<Rehearsed>],
    ) -> Result<(), Fault> {
        let (clip, found) = (clip.to_owned(), Arc::clone(found));
        let figure = found.figure();
        let gone: Vec<String> = instead_of.iter().map(|r| r.figure()).collect();
        let write = move |store: &mut dyn CheckpointStore| {
            store.put_rehearsal(&RehearsalRecord {
                clip: clip.clone(),
                figure: figure.clone(),
                content: found.to_bytes().into(),
            })?;
            for other in gone.iter().filter(|other| **other != figure) {
                store.delete_rehearsal(&clip, other)?;
            }
            Ok(())
        };
        self.on_disk(write).await
    }

    /// Forgets a rehearsal of a clip.
    ///
    /// # Errors
    /// It could not be done.
    pub async fn forget_rehearsal(&self, clip: &str, found: &Rehearsed) -> Result<(), Fault> {
        let (clip, figure) = (clip.to_owned(), found.figure());
        self.on_disk(move |store| store.delete_rehearsal(&clip, &figure))
            .await
    }
}

/// Brings clips back, and begins to compute the parts of them that are not stored. Returns their number.
pub(super) fn restore(app: &Arc<App>, all: &[ClipRecord]) -> usize {
    let mut count = 0;
    for clip in all {
        match restore_one(app, clip) {
            Ok(()) => {
                count += 1;
                complete(app, clip.name.clone());
            }
            Err(why) => tracing::error!(clip = clip.name, %why, "clip is not brought back"),
        }
    }
    count
}

fn restore_one(app: &App, clip: &ClipRecord) -> Result<(), Fault> {
    let unreadable = |e: prost::DecodeError| Fault::Internal(e.to_string());
    let described = DescribedClip::decode(clip.description.clone()).map_err(unreadable)?;
    let shown = described.clip.unwrap_or_default();
    let request = pb::CreateClipRequest::decode(clip.content.clone()).map_err(unreadable)?;
    let follow = motion::follow_update("", request.follow, request.max_help_weights)?;
    let follow = FollowSettings::default().changed(follow);
    let source = motion::clip_source(request.source, app.config.max_clip_bytes, follow)?;
    let reference = body::reference("body", &request.body, "profile", None)?;
    let new = NewClip {
        id: Some(clip.name.clone()),
        display_name: shown.display_name.clone(),
        owner: described.owner.map(Into::into),
        follow,
    };
    app.clips.restore(new, &shown, &reference, source)
}

/// Computes the parts of a clip that are not stored: how its file was understood, and the forecast.
fn complete(app: &Arc<App>, name: String) {
    let app = app.clone();
    tokio::spawn(async move {
        let library = app.clone();
        let id = name.clone();
        let turns = "stored".into();
        let done = app.conversions.run(&turns, move |turn| {
            let reference = library.clips.info(&id)?.body;
            let reference =
                body::by_id(&reference).ok_or_else(|| Fault::not_found("body", reference))?;
            let built = library.bodies.get("body", &reference)?;
            library.clips.complete(&id, &built, &|| turn.stop())
        });
        if let Err(why) = done.await {
            tracing::debug!(clip = name, %why, "the report of a clip is not there");
        }
    });
}

/// Brings rehearsals back, the oldest first. Unusable ones are reported.
pub(super) fn restore_rehearsals(app: &App, all: &[RehearsalRecord]) {
    let left_out = |clip: &str, why: Fault| {
        tracing::error!(clip, %why, "a rehearsal is not brought back: the clip has to be rehearsed again");
    };
    let mut whole = Vec::new();
    for record in all {
        match Rehearsed::from_bytes(&record.content) {
            Ok(found) => whole.push((&*record.clip, Arc::new(found))),
            Err(why) => left_out(&record.clip, why),
        }
    }
    whole.sort_by_key(|(_, found)| found.found_ms);
    for (clip, found) in whole {
        let kept = app.clips.score(clip);
        let kept = kept.and_then(|score| app.clips.keep_rehearsed(&score, &found));
        if let Err(why) = kept {
            left_out(clip, why);
        }
    }
}
