//! Arguments that several commands share, and the small languages of `--load`, `--push`, `--constrain`, `--obstacle` and `--then`.

mod body;
mod constraint;
mod control;
mod load;
mod obstacle;
mod push;
mod recording;
mod spec;
mod then;

pub use body::{BodyArgs, BodyKind, person_name, sex_name};
pub use constraint::ConstraintSpec;
pub use control::{
    ControllerArg, MetricArg, PaperOptions, PresetArg, PriorityArg, ShareArg, StepperArg,
};
pub use load::LoadSpec;
pub use obstacle::ObstacleSpec;
pub use push::PushSpec;
pub use recording::RecordingArgs;
pub use spec::SpecError;
pub use then::ThenSpec;
