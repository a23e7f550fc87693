//! The controllers of a workspace and their modes: the only place that knows them by name.

use crate::control::mode::{MotorsMode, WholeBodyMode};
use crate::control::{Controller, Mode, Modern, MotorsAlone};
use crate::paper::Paper;
use crate::paper::mode::PaperMode;
use crate::setup::ControllerKind;

/// The mode of a controller.
pub(in crate::figure) fn mode(kind: ControllerKind) -> &'static dyn Mode {
    match kind {
        ControllerKind::Paper => &PaperMode,
        ControllerKind::Modern => &WholeBodyMode,
        ControllerKind::Motors => &MotorsMode,
    }
}

/// The controllers, one of which is in charge.
#[derive(Debug)]
pub(in crate::figure) struct Controllers {
    pub paper: Box<Paper>,
    pub modern: Box<Modern>,
    pub motors: MotorsAlone,
}

impl Default for Controllers {
    fn default() -> Self {
        Self {
            paper: Box::default(),
            modern: Box::new(Modern::new(1.0)),
            motors: MotorsAlone::default(),
        }
    }
}

impl Controllers {
    /// The controller of a kind.
    pub fn get(&self, kind: ControllerKind) -> &dyn Controller {
        match kind {
            ControllerKind::Paper => &*self.paper,
            ControllerKind::Modern => &*self.modern,
            ControllerKind::Motors => &self.motors,
        }
    }

    /// The controller of a kind, ready to decide.
    pub fn get_mut(&mut self, kind: ControllerKind) -> &mut dyn Controller {
        match kind {
            ControllerKind::Paper => &mut *self.paper,
            ControllerKind::Modern => &mut *self.modern,
            ControllerKind::Motors => &mut self.motors,
        }
    }
}
