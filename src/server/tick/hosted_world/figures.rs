//! Figures of a world: members, their settings and their description.

use super::HostedWorld;
use crate::engine;
use crate::tick::scene::{Member, SceneInput};
use sinew_physics::body::Body;
use sinew_wire::status::Fault;
use sinew_wire::types::{
    ControlKey, EventKind, FigureInfo, FigureSettings, FigureUpdate, Follows, Place,
};
use std::sync::Arc;

impl HostedWorld {
    pub(super) fn member(&self, figure: &str) -> Result<usize, Fault> {
        self.scene
            .members()
            .iter()
            .position(|m| m.id == figure)
            .ok_or_else(|| {
                Fault::not_found("figure", format!("worlds/{}/figures/{figure}", self.id))
            })
    }

    /// Checks that figures exist.
    pub fn check_figures(&self, figures: &[String]) -> Result<(), Fault> {
        figures.iter().try_for_each(|f| self.member(f).map(|_| ()))
    }

    pub(super) fn figure_info(&self, m: &Member) -> FigureInfo {
        let f = self.scene.figure(m.key);
        // Only the name of the most recently requested clip is kept: the figure plays it, or comes to a stand for it.
        let (next_clip, clip) = match f.next_clip() {
            Some(_) => (m.clip.clone(), None),
            None => (None, m.clip.clone()),
        };
        FigureInfo {
            world: self.id.to_string(),
            id: m.id.clone(),
            settings: m.settings.clone(),
            clip,
            next_clip,
            driver: self
                .drives
                .iter()
                .find(|d| d.has(&m.id))
                .map(|d| d.id.name.to_string()),
            index: m.index,
            constraints: engine::constraints(f, self.scene.world().time()),
            follows: engine::follows(f),
        }
    }

    /// One figure.
    pub fn figure(&self, figure: &str) -> Result<FigureInfo, Fault> {
        Ok(self.figure_info(&self.scene.members()[self.member(figure)?]))
    }

    /// All figures, in the order of creation.
    pub fn figures(&self) -> Vec<FigureInfo> {
        self.scene
            .members()
            .iter()
            .map(|m| self.figure_info(m))
            .collect()
    }

    pub(super) fn roster_changed(&mut self) {
        self.roster_version += 1;
        self.changed = true;
        self.roster = self.scene.roster();
    }

    /// The name of a new figure, or a free one if none is given; there must be room for it.
    fn new_figure_id(&self, id: Option<String>) -> Result<String, Fault> {
        self.working()?;
        if self.scene.members().len() as u64 >= self.limits.figures {
            return Err(Fault::Exhausted {
                limit: "max_figures_per_world",
                value: self.limits.figures,
                message: format!("one more figure in world {:?}", &*self.id),
                retry: None,
            });
        }
        Ok(match id {
            Some(id) if self.member(&id).is_ok() => {
                return Err(Fault::Exists {
                    kind: "figure",
                    name: format!("worlds/{}/figures/{id}", self.id),
                });
            }
            Some(id) => id,
            None => (self.scene.next_index() + 1..)
                .map(|n| format!("figure-{n}"))
                .find(|id| self.member(id).is_err())
                .expect("there is a free number"),
        })
    }

    /// The figure that [`Self::create_figure`] would add. The physics has checked its settings before
    /// ([`engine::check_figure`]).
    pub fn would_create_figure(
        &self,
        id: Option<String>,
        settings: FigureSettings,
    ) -> Result<FigureInfo, Fault> {
        let id = self.new_figure_id(id)?;
        self.budget.add_figure(&self.account)?;
        self.budget.remove_figure(&self.account);
        Ok(FigureInfo {
            world: self.id.to_string(),
            id,
            constraints: settings.constraints.clone(),
            settings,
            clip: None,
            next_clip: None,
            driver: None,
            index: self.scene.next_index(),
            follows: Follows::default(),
        })
    }

    /// Adds a figure.
    pub fn create_figure(
        &mut self,
        id: Option<String>,
        settings: FigureSettings,
        body: Arc<Body>,
    ) -> Result<FigureInfo, Fault> {
        let id = self.new_figure_id(id)?;
        self.budget.add_figure(&self.account)?;
        let added = self.scene.apply(SceneInput::AddFigure {
            id: id.clone(),
            settings: Box::new(settings),
            body: Some(body),
        });
        if let Err(fault) = added {
            self.budget.remove_figure(&self.account);
            return Err(fault);
        }
        self.roster_changed();
        self.event(&id, EventKind::FigureAdded);
        self.figure(&id)
    }

    /// The figure as [`Self::update_figure`] would leave it with these settings, which were checked before
    /// ([`engine::check_figure`]).
    pub fn would_update_figure(
        &self,
        figure: &str,
        settings: FigureSettings,
        who: Option<&ControlKey>,
    ) -> Result<FigureInfo, Fault> {
        self.working()?;
        let now = self.figure(figure)?;
        who.map_or(Ok(()), |who| self.may_adjust(figure, who))?;
        Ok(FigureInfo {
            constraints: settings.constraints.clone(),
            settings,
            ..now
        })
    }

    /// Changes strength, controller or name. `who`: a driver, which is refused if others control the figure; `None`: a
    /// director.
    pub fn update_figure(
        &mut self,
        figure: &str,
        u: FigureUpdate,
        who: Option<&ControlKey>,
    ) -> Result<FigureInfo, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        who.map_or(Ok(()), |who| self.may_adjust(figure, who))?;
        let key = self.scene.members()[i].key;
        self.scene
            .apply(SceneInput::UpdateFigure(key, Box::new(u)))?;
        self.figure(figure)
    }

    /// Removes a figure.
    pub fn delete_figure(&mut self, figure: &str) -> Result<(), Fault> {
        let i = self.member(figure)?;
        let key = self.scene.members()[i].key;
        self.scene.apply(SceneInput::RemoveFigure(key))?;
        self.budget.remove_figure(&self.account);
        self.take_from_driver(figure);
        self.leases.forget(figure);
        self.roster_changed();
        self.event(figure, EventKind::FigureRemoved);
        Ok(())
    }

    /// Ends the drive of a removed figure, and tells its driver if it was the last one.
    fn take_from_driver(&mut self, figure: &str) {
        let name = format!("worlds/{}/figures/{figure}", self.id);
        let Some(i) = self.drives.iter().position(|d| d.has(figure)) else {
            return;
        };
        let drive = &mut self.drives[i];
        for slot in drive.slots.iter_mut().filter(|s| s.figure == figure) {
            slot.player = None;
        }
        let ended = format!("{}: the figure was removed", drive.id.name);
        if drive.slots.iter().all(|s| s.player.is_none()) {
            let drive = self.drives.remove(i);
            drive.mailbox.close(Fault::not_found("figure", name));
            self.mailboxes.remove(&drive.id);
        }
        self.event(figure, EventKind::DriveEnded(ended));
    }

    /// Puts a figure back to standing still, without loads.
    pub fn reset_figure(
        &mut self,
        figure: &str,
        place: Option<Place>,
        who: &ControlKey,
    ) -> Result<FigureInfo, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        self.may_direct(figure, who)?;
        let key = self.scene.members()[i].key;
        self.end_undriven(key);
        self.scene.apply(SceneInput::ResetFigure(key, place))?;
        self.shares.forget(key);
        self.changed = true;
        self.figure(figure)
    }

    /// Makes the physics lose a figure that is still shown, which breaks the world.
    #[cfg(test)]
    pub(in crate::tick) fn forget_in_physics(&mut self, figure: &str) {
        let i = self.member(figure).expect("it is there");
        let key = self.scene.members()[i].key;
        self.scene.forget_in_physics(key);
        self.changed = true;
    }
}
