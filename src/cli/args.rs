//! Arguments that several commands share, and the formats of `--load`, `--push`, `--constrain`, `--obstacle` and
//! `--then`.

mod body;
mod constraint;
mod control;
mod credentials;
mod follow;
mod load;
mod obstacle;
mod push;
mod recording;
mod spec;
mod strength_file;
mod then;

pub use body::{BodyArgs, BodyNameParser, describe, short_name};
pub use constraint::ConstraintSpec;
pub use control::{ControllerArg, PaperOptions, PresetArg, StepperArg};
pub use credentials::CredentialArgs;
pub use follow::{FollowArg, HelpArgs, LiveHelpArgs};
pub use load::LoadSpec;
pub use obstacle::ObstacleSpec;
pub use push::PushSpec;
pub use recording::{FileArgs, RecordingArgs, UpArg, check_tempo};
pub use spec::SpecError;
pub use strength_file::StrengthFile;
pub use then::ThenSpec;
