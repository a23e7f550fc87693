//! Measures of reports whose content is known.

use super::*;
use sinew_physics::body::topology::R_HAND;
use sinew_physics::figure::ContactPoint;
use sinew_physics::motion::Target;
use sinew_physics::strength::MuscleScale;

/// A figure at rest in the zero pose with an ordinary report; tests change the part that they examine.
struct Stand {
    body: Body,
    links: Links,
    strength: Strength,
    scale: MuscleScale,
    target: TargetPair,
    report: TickReport,
    state: State,
}

impl Stand {
    fn new() -> Self {
        let body = Body::adult_man();
        let still = Target::still(Posture::default());
        let mut report = TickReport::empty(&State::default(), 0, 0);
        report.joints.torque_lower = [-1.0; DOF_COUNT];
        report.joints.torque_upper = [1.0; DOF_COUNT];
        Self {
            links: Links::new(&body),
            strength: Strength::for_body(&body),
            scale: MuscleScale::default(),
            target: TargetPair {
                now: still.clone(),
                next: still,
            },
            report,
            state: State::default(),
            body,
        }
    }

    fn metrics(&self) -> Metrics {
        Metrics::new(60.0, &self.state.posture)
    }

    fn tick(&self) -> Tick<'_> {
        Tick {
            body: &self.body,
            links: &self.links,
            target: &self.target,
            report: &self.report,
            state: &self.state,
            strength: (&self.strength, &self.scale),
            gravity: 0.0,
        }
    }
}

#[test]
fn perfect_rest_measures_zero() {
    let stand = Stand::new();
    let mut m = stand.metrics();
    for _ in 0..120 {
        m.observe(stand.tick(), 10.0);
    }
    let r = m.finish(0xfeed);
    assert_eq!((r.ticks, r.fell_at_s, r.margin_min_m), (120, None, None));
    assert_eq!(
        [
            r.tracking_joint_rms_deg,
            r.tracking_joint_max_deg,
            r.tracking_mpjpe_root_mm,
            r.tracking_mpjpe_global_mm
        ],
        [0.0; 4]
    );
    assert_eq!(
        [
            r.dynamics_residual_max,
            r.root_wrench_unexplained_max_n,
            r.foot_slip_mm_per_s
        ],
        [0.0; 3]
    );
    assert_eq!(r.state_hash, "000000000000feed");
    assert_eq!([r.us_per_tick_p50, r.us_per_tick_p99], [10.0; 2]);
    assert_eq!(r.longest_saturated(), None);
}

#[test]
fn tracking_measures_stop_with_the_fall() {
    let mut stand = Stand::new();
    let mut m = stand.metrics();
    stand.report.joints.joint_error = [1f64.to_radians(); DOF_COUNT];
    stand.target.next.posture.root_position.x = 0.1;
    stand.report.balance.margin = Some(0.02);
    for _ in 0..59 {
        m.observe(stand.tick(), 1.0);
    }
    stand.report.flags.set(Flags::FALLEN);
    m.observe(stand.tick(), 1.0);
    stand.report.joints.joint_error = [1.0; DOF_COUNT];
    stand.report.balance.margin = Some(-1.0);
    stand.report.penetration = 0.003;
    m.observe(stand.tick(), 1.0);
    let r = m.finish(0);
    assert_eq!(r.fell_at_s, Some(1.0));
    assert!(
        (r.tracking_joint_rms_deg - 1.0).abs() < 1e-12
            && (r.tracking_joint_max_deg - 1.0).abs() < 1e-12
    );
    assert!(
        (r.tracking_mpjpe_global_mm - 100.0).abs() < 1e-9,
        "the whole figure is 100 mm off"
    );
    assert!(
        r.tracking_mpjpe_root_mm < 1e-9,
        "seen from the pelvis nothing is off"
    );
    assert_eq!(r.margin_min_m, Some(0.02));
    assert_eq!(r.penetration_max_mm, 3.0, "physics is measured to the end");
}

#[test]
fn slip_is_the_speed_of_loaded_foot_points() {
    for (force, segment, expected) in [
        (10.0, L_FOOT, 60.0),
        (4.0, L_FOOT, 0.0),
        (10.0, R_HAND, 0.0),
    ] {
        let mut stand = Stand::new();
        let mut m = stand.metrics();
        stand.report.contacts = vec![ContactPoint {
            segment,
            vertex: 0,
            position: Vec3::zero(),
            force: Vec3::Z * force,
        }];
        for _ in 0..10 {
            stand.state.posture.root_position.x += 0.6e-3;
            stand.state.posture.root_position.y += 0.8e-3;
            stand.state.posture.root_position.z += 5e-3;
            m.observe(stand.tick(), 1.0);
        }
        let slip = m.finish(0).foot_slip_mm_per_s;
        assert!(
            (slip - expected).abs() < 1e-9,
            "{force} N on {}: {slip}",
            segment.name()
        );
    }
}

#[test]
fn utilisation_is_measured_against_the_strength_of_the_body() {
    let mut stand = Stand::new();
    let zero = [0.0; DOF_COUNT];
    let (mut lower, mut upper) = (zero, zero);
    stand.scale = MuscleScale([[0.5; 2]; DOF_COUNT]);
    stand
        .strength
        .range(&zero, &zero, &stand.scale, &mut lower, &mut upper);
    stand.report.audit.torque[3] = 0.25 * upper[3];
    stand.report.audit.torque[4] = lower[4];
    stand.report.audit.torque[5] = 1.5 * upper[5];
    stand.report.joints.saturated = 1 << 7;
    let mut m = stand.metrics();
    m.observe(stand.tick(), 1.0);
    let r = m.finish(0);
    assert_eq!(
        [
            r.utilisation_max[3],
            r.utilisation_max[4],
            r.max_utilisation
        ],
        [0.25, 1.0, 1.5]
    );
    assert!(
        (r.over_limit_max - 0.5).abs() < 1e-12,
        "excess is found without the solver's word"
    );
    let saturated: Vec<usize> = (0..DOF_COUNT).filter(|d| r.saturated_s[*d] > 0.0).collect();
    assert_eq!(saturated, [4, 5, 7]);
    assert!((r.saturated_s[4] - 1.0 / 60.0).abs() < 1e-15);
    assert!(
        r.dynamics_residual_max > 0.9,
        "torques without motion break the equations of motion"
    );
}

#[test]
fn non_finite_and_frozen_ticks_are_counted_and_measure_nothing() {
    let mut stand = Stand::new();
    let mut m = stand.metrics();
    stand.report.joints.joint_error[2] = f64::NAN;
    m.observe(stand.tick(), 1.0);
    stand.report.joints.joint_error[2] = 1.0;
    stand.report.flags.set(Flags::QUARANTINED);
    m.observe(stand.tick(), 1.0);
    let r = m.finish(0);
    assert_eq!(
        (r.non_finite_ticks, r.quarantined_at_s),
        (1, Some(2.0 / 60.0))
    );
    assert_eq!(r.tracking_joint_rms_deg, 0.0);
}

#[test]
fn events_are_kept_up_to_the_bound_and_then_counted() {
    let stand = Stand::new();
    let mut m = stand.metrics();
    m.observe(stand.tick(), 1.0);
    for _ in 0..MAX_EVENTS + 5 {
        m.event(RunEvent {
            kind: "saturated",
            dof: Some("waist_flexion"),
            ..RunEvent::default()
        });
    }
    let r = m.finish(0);
    assert_eq!((r.events.len(), r.events_dropped), (MAX_EVENTS, 5));
    assert_eq!(r.events[0].time_s, 1.0 / 60.0);
}

#[test]
fn percentiles_are_nearest_ranks() {
    let times: Vec<f32> = (1..=200).map(|t| t as f32).collect();
    assert_eq!(
        [
            percentile(&times, 0.5),
            percentile(&times, 0.99),
            percentile(&[], 0.5)
        ],
        [100.0, 198.0, 0.0]
    );
}
