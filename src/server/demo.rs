//! The demo world: people of different builds lift the same crate.

use super::BoxError;
use super::app::App;
use super::library::Manner;
use super::tick::command::CommandOrigin;
use super::worlds::Persisted;
use sinew_wire::convert;
use sinew_wire::pb;
use sinew_wire::types::{ControlKey, Place, Playback};
use std::sync::Arc;

/// The built-in motion that everyone plays.
const MOTION: &str = "crate";
/// Mass of the crate at first, kg: everyone can lift it.
const CRATE_KG: f64 = 4.0;
/// Name, body and place to the left, m.
const PEOPLE: [(&str, &str, f64); 3] = [
    ("man", "adult-man", 1.25),
    ("woman", "adult-woman", 0.0),
    ("child", "child", -1.15),
];

/// Creates the world `demo` and returns its figures: of man, woman and child, those for which this build has bodies.
///
/// # Errors
/// The world exists already, or a limit of the configuration is too small for it.
pub async fn create(app: &Arc<App>) -> Result<Vec<&'static str>, BoxError> {
    let settings = convert::world::settings(None)?;
    let world = app.worlds.create(
        Some("demo".into()),
        settings,
        false,
        ("demo".into(), Vec::new()),
    )?;
    // It is created again at each start, so it is not stored.
    world.stored.send_replace(Persisted::Never);
    let mut present = Vec::new();
    for (name, body, y) in PEOPLE {
        if convert::body::by_id(body).is_none() {
            continue;
        }
        let settings = convert::figure::settings(
            "figure",
            Some(&pb::Figure {
                body: format!("bodies/{body}"),
                controller: pb::Controller::Modern.into(),
                placement: Some(pb::Placement {
                    y_m: y,
                    ..Default::default()
                }),
                ..Default::default()
            }),
        )?;
        let built = app.bodies.get("figure.profile", &settings.body)?;
        let clip = app.clips.prepared(
            MOTION,
            &settings.body.id,
            &built,
            Manner::recorded(true),
            &|| false,
        )?;
        let playback = Playback {
            speed: 1.0,
            looped: true,
            start: None,
            reset: true,
            max_help: 0.0,
            place: Some(Place {
                y,
                ..Place::default()
            }),
        };
        let crate_in_hands = convert::perturbation::batch(&[pb::Perturbation {
            figure_id: name.to_owned(),
            kind: Some(pb::perturbation::Kind::Load(pb::Load {
                segment: "l_hand".to_owned(),
                second_segment: "r_hand".to_owned(),
                mass_kg: CRATE_KG,
                ..Default::default()
            })),
            ..Default::default()
        }])?;
        let who = ControlKey {
            principal: "demo".into(),
            tokens: Vec::new(),
        };
        let origin = CommandOrigin {
            client: "demo".into(),
            sequence: 0,
        };
        world
            .call(origin, move |s| {
                s.create_figure(Some(name.to_owned()), settings, built)?;
                s.play(name, MOTION, (clip, &[]), playback, &who)?;
                s.perturb(&crate_in_hands, None)
            })
            .await?;
        present.push(name);
    }
    Ok(present)
}
