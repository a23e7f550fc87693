//! Files that do not contain the position of the figure.

use crate::reading::file::{File, bare, lower_soles, motion, range};
use sinew_physics::body::Body;

#[test]
fn a_squat_without_root_positions_stands_on_the_floor() {
    let body = Body::adult_man();
    let postures = motion(&body, "squat");
    let r = File::new(&body, &postures)
        .without_positions()
        .read(&body, &bare());
    assert!(
        r.report
            .warnings
            .iter()
            .any(|w| w.contains("no root positions")),
        "{:?}",
        r.report.warnings
    );
    let (low, high) = range(lower_soles(&body, &r.clip));
    assert!(low > -0.01 && high < 0.01, "soles from {low} m to {high} m");
    let both = (0..r.clip.len())
        .filter(|i| r.clip.planted(*i) == [true; 2])
        .count();
    assert!(
        both as f64 > 0.95 * r.clip.len() as f64,
        "{both} of {}",
        r.clip.len()
    );
    for i in (0..r.clip.len()).step_by(10) {
        let off = r.clip.posture(i).root_position.z - postures[i].root_position.z;
        assert!(off.abs() < 0.03, "sample {i}: pelvis {off} m off");
    }
}

#[test]
fn a_walk_without_a_way_along_the_floor_gets_there() {
    let body = Body::adult_man();
    let postures = motion(&body, "walk");
    let way = postures.last().unwrap().root_position - postures[0].root_position;
    let file = File::new(&body, &postures);
    let mut in_place = file.clone();
    for row in &mut in_place.rows {
        (row[0], row[2]) = (0.0, 0.0);
    }
    for (what, file) in [
        ("in place", in_place),
        ("no positions", file.without_positions()),
    ] {
        let r = file.read(&body, &bare());
        assert!(
            r.report
                .warnings
                .iter()
                .any(|w| w.contains("from the planted feet")),
            "{what}"
        );
        let n = r.clip.len();
        let got = r.clip.posture(n - 1).root_position - r.clip.posture(0).root_position;
        assert!(
            (got.x - way.x).abs() < 0.05 * way.x,
            "{what}: {} m of {} m",
            got.x,
            way.x
        );
        assert!(got.y.abs() < 0.1, "{what}: {} m aside", got.y);
        let stands = (0..n).filter(|i| r.clip.planted(*i) != [false; 2]).count();
        assert!(
            stands as f64 > 0.95 * n as f64,
            "{what}: {stands} of {n} samples on a foot"
        );
    }
}

#[test]
fn a_file_with_root_positions_is_not_suspected() {
    let body = Body::adult_man();
    for name in ["idle", "walk", "squat"] {
        let r = File::new(&body, &motion(&body, name)).read(&body, &bare());
        assert_eq!(r.report.warnings, [] as [String; 0], "{name}");
    }
}
