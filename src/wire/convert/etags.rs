//! Etags (AIP-154): they identify the version that a client has read, so that it does not overwrite a later change by
//! another client.
//!
//! An etag is a hash of the configuration as it is sent, so it needs no memory of its own: equal settings have equal
//! etags, even after a restart of the server or in a restored world.

use super::super::pb;
use super::super::status::Fault;
use super::shortened;
use xxhash_rust::xxh3::xxh3_64;

fn hash(message: &impl prost::Message) -> String {
    format!("{:016x}", xxh3_64(&message.encode_to_vec()))
}

/// The etag of the settings of a world.
pub fn world(w: &pb::World) -> String {
    hash(&pb::World {
        state: 0,
        tick: 0,
        time_s: 0.0,
        figure_count: 0,
        epoch: 0,
        create_time: None,
        failure: String::new(),
        etag: String::new(),
        ..w.clone()
    })
}

/// The etag of the settings of a figure. It leaves out the remaining time of constraints, which changes by itself.
pub fn figure(f: &pb::Figure) -> String {
    let mut set = pb::Figure {
        status: None,
        etag: String::new(),
        ..f.clone()
    };
    for c in &mut set.constraints {
        c.duration_s = 0.0;
    }
    hash(&set)
}

/// The etag of the settings of an obstacle. It leaves out the motion of one that is not fixed, which changes by itself.
pub fn obstacle(o: &pb::Obstacle) -> String {
    let fixed = o.mobility == i32::from(pb::ObstacleMobility::Fixed);
    hash(&pb::Obstacle {
        pose: o.pose.filter(|_| fixed),
        velocity_mps: None,
        angular_velocity_rad_s: None,
        etag: String::new(),
        ..o.clone()
    })
}

/// The etag of a grant.
pub fn grant(g: &pb::Grant) -> String {
    hash(&pb::Grant {
        create_time: None,
        etag: String::new(),
        ..g.clone()
    })
}

/// Checks the etag of a request, if it has one, against the present one.
///
/// # Errors
/// They differ.
pub fn check(name: &str, sent: &str, now: impl FnOnce() -> String) -> Result<(), Fault> {
    if sent.is_empty() || sent == now() {
        return Ok(());
    }
    Err(Fault::Aborted {
        reason: "ETAG_MISMATCH",
        message: format!(
            "{name} has changed: its etag is not {:?} any more; read it again",
            shortened(sent)
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_change_an_etag_and_what_goes_on_by_itself_does_not() {
        let w = pb::World {
            name: "worlds/a".into(),
            speed: 1.0,
            ..Default::default()
        };
        let later = pb::World {
            tick: 7,
            time_s: 0.1,
            figure_count: 2,
            state: 1,
            etag: world(&w),
            ..w.clone()
        };
        assert_eq!(world(&w), world(&later));
        let faster = pb::World {
            speed: 2.0,
            ..w.clone()
        };
        assert_ne!(world(&w), world(&faster));

        let mut o = pb::Obstacle {
            name: "worlds/a/obstacles/b".into(),
            mobility: pb::ObstacleMobility::Free.into(),
            mass_kg: 1.0,
            ..Default::default()
        };
        let moved = |o: &pb::Obstacle| pb::Obstacle {
            pose: Some(pb::Pose::default()),
            ..o.clone()
        };
        assert_eq!(obstacle(&o), obstacle(&moved(&o)));
        o.mobility = pb::ObstacleMobility::Fixed.into();
        assert_ne!(obstacle(&o), obstacle(&moved(&o)));
    }

    #[test]
    fn a_stale_etag_is_refused_and_none_is_not_checked() {
        check("worlds/a", "", || unreachable!()).unwrap();
        check("worlds/a", "1", || "1".into()).unwrap();
        let refused = check("worlds/a", "1", || "2".into()).unwrap_err();
        assert_eq!(refused.reason(), "ETAG_MISMATCH");
    }
}
