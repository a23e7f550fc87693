//! Arguments of `sinew run`.

use crate::args::{
    BodyArgs, ConstraintSpec, ControllerArg, FileArgs, LiveHelpArgs, LoadSpec, ObstacleSpec,
    PaperOptions, PresetArg, PushSpec, StepperArg, StrengthFile, ThenSpec,
};
use anyhow::Result;
use sinew_evaluate::strip::View;
use sinew_physics::body::Body;
use sinew_physics::body::topology::DOF_COUNT;
use sinew_physics::figure::StrengthScale;
use sinew_physics::motion::Clip;
use sinew_physics::world::WorldParams;
use std::path::PathBuf;

/// Camera view of a strip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum ViewArg {
    /// From the right side.
    Side,
    /// From the front.
    Front,
    /// From the front and right, from a little above.
    #[default]
    ThreeQuarter,
}

impl From<ViewArg> for View {
    fn from(arg: ViewArg) -> Self {
        match arg {
            ViewArg::Side => Self::Side,
            ViewArg::Front => Self::Front,
            ViewArg::ThreeQuarter => Self::ThreeQuarter,
        }
    }
}

/// Simulates motions and reports how closely the figure tracks them.
#[derive(Clone, Debug, clap::Args)]
pub struct RunArgs {
    /// Motions: BVH files or builtin:NAME (idle, lift, crate, squat, wave, step, walk). Each is simulated in a world of
    /// its own.
    #[arg(required = true, value_name = "CLIP")]
    pub clips: Vec<String>,
    /// Body of the figure.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Unit and axes of the files.
    #[command(flatten)]
    pub file: FileArgs,
    /// Factor on the strength of every joint, 0.01 to 100.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub strength: f64,
    /// Percentile of strength in the population of that sex, age and size, 5 to 95.
    #[arg(long, value_name = "P", default_value_t = 50.0)]
    pub percentile: f64,
    /// Fraction of its strength that the figure may use, 0 to 1.
    #[arg(long, value_name = "E", default_value_t = 1.0)]
    pub effort: f64,
    /// Strength of the person as `sinew strength` writes it (`sinew.v1.StrengthScale` as JSON), instead of the three
    /// options above.
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["strength", "percentile", "effort"])]
    pub strength_file: Option<PathBuf>,
    /// Time scale of muscle fatigue: seconds of fatigue per simulated second, 0 to 1000; 0: no fatigue.
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    pub fatigue: f64,
    /// Assist: external wrench towards the target pose of the pelvis, 0 (off) to 1; not physical, reported as assist_*.
    #[arg(long, value_name = "A", default_value_t = 0.0)]
    pub assist: f64,
    /// Help while the motion is being lost.
    #[command(flatten)]
    pub help: LiveHelpArgs,
    /// Load held by one or two segments; for example 3@r_hand, 8@l_hand+r_hand or 3@r_hand@1..2.5 (repeatable). With
    /// 3@r_hand+auto the other hand helps while one arm is too weak for it; with 3@r_hand+always as long as it is free.
    #[arg(
        long,
        value_name = "KG@SEGMENT[+SEGMENT|+auto|+always][@T0..T1]",
        allow_hyphen_values = true
    )]
    pub load: Vec<LoadSpec>,
    /// Grip strength of one hand, N: a load that needs more slips; unlimited unless given.
    #[arg(long, value_name = "N", default_value_t = f64::INFINITY)]
    pub grip: f64,
    /// Push on a segment: impulse in N·s, start in s, direction in world axes; for example 20@chest@1.5:1,0,0
    /// (repeatable).
    #[arg(long, value_name = "NS@SEGMENT@T:x,y,z", allow_hyphen_values = true)]
    pub push: Vec<PushSpec>,
    /// Target position, m, of a segment or of the centre of mass (com); repeatable. r_hand@0.4,-0.25,1.1; from 1 s to 3
    /// s r_hand@0.4,-0.25,1.1@1..3; with a rotation r_hand@0.4,-0.25,1.1:0,-0.7,0,0.714; y axis only com@_,0.08,_.
    #[arg(
        long,
        value_name = "PART@x,y,z[@T0..T1][:qx,qy,qz,qw]",
        allow_hyphen_values = true
    )]
    pub constrain: Vec<ConstraintSpec>,
    /// Obstacle in contact with the figure (repeatable): a seat box:0.4,0.5,0.45@-0.3,0,0.225, a thrown ball
    /// sphere:0.11@2,0,1.2:5kg:-5,0,1, a wall plane:-1,0,0@0.6,0,0. SHAPE:SIZE is box:LX,LY,LZ (edges, m), sphere:R,
    /// capsule:R,L (upright; L between the centres of its ends) or plane:nx,ny,nz (normal).
    #[arg(
        long,
        value_name = "SHAPE:SIZE@x,y,z[,yaw°][:KGkg][:vx,vy,vz]",
        allow_hyphen_values = true
    )]
    pub obstacle: Vec<ObstacleSpec>,
    /// Duration of a push, s.
    #[arg(long, value_name = "S", default_value_t = 0.2)]
    pub push_duration: f64,
    /// Controller that computes the torques.
    #[arg(long, value_enum, default_value_t)]
    pub controller: ControllerArg,
    /// Stepper that moves the body.
    #[arg(long, value_enum, default_value_t)]
    pub stepper: StepperArg,
    /// Take a protective step when the capture point leaves the support polygon (modern controller).
    #[arg(
        long, value_name = "BOOL", default_value_t = true, num_args = 0..=1, require_equals = true,
        default_missing_value = "true", action = clap::ArgAction::Set
    )]
    pub protective_steps: bool,
    /// Keep limbs out of the body and of each other (torque stepper).
    #[arg(long)]
    pub self_contact: bool,
    /// Ticks per second; 60 unless the preset sets another rate.
    #[arg(long, value_name = "HZ")]
    pub rate: Option<f64>,
    /// Physics steps per tick.
    #[arg(long, value_name = "N", default_value_t = WorldParams::default().substeps)]
    pub substeps: u32,
    /// Duration of the run, s; that of the motion unless given.
    #[arg(long, value_name = "S")]
    pub duration: Option<f64>,
    /// Repeat the motion until the end of --duration.
    #[arg(long = "loop", requires = "duration")]
    pub looped: bool,
    /// Play another clip from T seconds on (repeatable): turn.bvh@5. A walking figure changes over at a step where both
    /// clips are alike, or else stops first; a standing figure begins at once.
    #[arg(long, value_name = "CLIP@T", requires = "duration")]
    pub then: Vec<ThenSpec>,
    /// Begin and end standing: add the steps that lead into the first frame and out of the last one.
    #[arg(long, conflicts_with = "looped")]
    pub standing: bool,
    /// Keep recorded runs. Otherwise, without help, runs are turned into walks, slower and with shorter steps, which
    /// measured strength can do.
    #[arg(long)]
    pub keep_runs: bool,
    /// Playback speed relative to the recording, 0.5 to 2; steps and balance are prepared for it. Built-in motions keep
    /// their speed.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub tempo: f64,
    /// Prints the report as JSON on standard output (a list for several clips), and nothing else there.
    #[arg(long)]
    pub json: bool,
    /// Ends with exit code 3 if a figure fell or its state diverged.
    #[arg(long)]
    pub fail_on_fall: bool,
    /// Writes the report as JSON (a list for several clips).
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// Writes the simulated motion: BVH, or CSV with angles, torques and torque limits. With several clips, -CLIP is
    /// added to the name: out-walk.bvh.
    #[arg(long, value_name = "FILE.bvh|.csv")]
    pub out: Option<PathBuf>,
    /// Draws evenly spaced frames side by side. With several clips, -CLIP is added to the name: strip-walk.png.
    #[arg(long, value_name = "FILE.svg|.png")]
    pub strip: Option<PathBuf>,
    /// Number of frames in the strip.
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub strip_frames: usize,
    /// Camera view of the strip.
    #[arg(long, value_enum, default_value_t)]
    pub view: ViewArg,
    /// Number of clips simulated at the same time.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: usize,
    // Last: its heading is that of all options after it.
    /// Options of the paper's controller.
    #[command(flatten)]
    pub paper: PaperOptions,
}

impl RunArgs {
    pub(super) fn rate_hz(&self) -> f64 {
        self.rate.unwrap_or(match self.paper.preset {
            Some(PresetArg::Paper2000) => 30.0,
            None => WorldParams::default().rate_hz,
        })
    }

    pub(super) fn controller_kind(&self) -> ControllerArg {
        match self.paper.preset {
            Some(PresetArg::Paper2000) => ControllerArg::Paper,
            None => self.controller,
        }
    }

    pub(super) fn stepper_kind(&self) -> StepperArg {
        match self.paper.preset {
            Some(PresetArg::Paper2000) => StepperArg::Kinematic,
            None => self.stepper,
        }
    }

    /// Time of the clip at which the run begins, s.
    pub(super) fn first(&self, clip: &Clip) -> f64 {
        if self.standing { -clip.lead_in() } else { 0.0 }
    }

    /// Duration of the run of a clip, s.
    pub(super) fn seconds(&self, clip: &Clip) -> f64 {
        let ends = if self.standing {
            clip.lead_in() + clip.lead_out()
        } else {
            0.0
        };
        self.duration.unwrap_or_else(|| clip.duration() + ends)
    }

    /// Strength from the options, or from the file.
    pub(super) fn strength_scale(&self) -> Result<StrengthScale> {
        match &self.strength_file {
            Some(path) => StrengthFile::read(path),
            None => Ok(StrengthScale {
                all: self.strength,
                percentile: self.percentile,
                effort: self.effort,
                ..StrengthScale::default()
            }),
        }
    }

    /// The body; the preset removes the armature of its joints.
    pub(super) fn build_body(&self) -> Result<Body> {
        let mut body = self.body.build()?;
        if self.paper.preset.is_some() {
            body.armature = [0.0; DOF_COUNT];
        }
        Ok(body)
    }
}
