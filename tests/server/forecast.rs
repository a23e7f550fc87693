//! Stored clips come with a forecast.

use crate::support::TestServer;
use sinew_physics::body::{Body, Posture};
use sinew_physics::motion::builtin::builtin;
use sinew_physics::motion::write_bvh;
use sinew_wire::pb;

/// A built-in motion as a recording, changed by `place`, which gets the time in s.
fn recording(name: &str, seconds: f64, place: impl Fn(f64, &mut Posture)) -> Vec<u8> {
    let body = Body::adult_man();
    let clip = builtin(&body, name).unwrap();
    let postures: Vec<Posture> = (0..(seconds * 60.0) as usize)
        .map(|i| {
            let t = i as f64 / 60.0;
            let mut posture = clip.sample(t).posture;
            place(t, &mut posture);
            posture
        })
        .collect();
    write_bvh(&body, &postures, 60.0).into()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stored_clip_has_a_forecast_with_its_reason() {
    let server = TestServer::start().await;
    let stored = async |id: &str, data: Vec<u8>| {
        let request = pb::CreateClipRequest {
            clip_id: id.into(),
            source: Some(pb::create_clip_request::Source::Bvh(pb::BvhSource {
                data: data.into(),
                options: None,
            })),
            ..Default::default()
        };
        let created = server.client.motions().create_clip(request).await.unwrap();
        created.into_inner().clip.unwrap()
    };
    let squat = stored("squats", recording("squat", 4.0, |_, _| {})).await;
    let forecast = squat.forecast.clone().unwrap();
    assert_eq!(forecast.verdict(), pb::ForecastVerdict::Follows);
    assert!(
        forecast.demand <= 1.0 && forecast.strength_peak_ratio > 0.1,
        "{forecast:?}"
    );
    assert!(
        forecast.reason.contains("times the strength of the"),
        "{forecast:?}"
    );

    // Stands, rises by a metre within half a second, and stays there.
    let rise = |t: f64, p: &mut Posture| {
        let u = ((t - 1.0) / 0.5).clamp(0.0, 1.0);
        p.root_position.z += u * u * (3.0 - 2.0 * u);
    };
    let floats = stored("floats", recording("idle", 4.0, rise)).await;
    let forecast = floats.forecast.unwrap();
    assert_eq!(
        forecast.verdict(),
        pb::ForecastVerdict::Cannot,
        "{forecast:?}"
    );
    assert!(
        forecast.lacking_force_peak_weights > 0.8 && forecast.flight_s > 1.0,
        "{forecast:?}"
    );
    assert!(forecast.reason.contains("weights"), "{forecast:?}");

    // It is kept with the clip; lists and built-in clips do without.
    let get = |name: &str| pb::GetClipRequest { name: name.into() };
    let kept = server
        .client
        .motions()
        .get_clip(get("clips/squats"))
        .await
        .unwrap();
    assert_eq!(kept.into_inner().clip.unwrap().forecast, squat.forecast);
    let builtin = server
        .client
        .motions()
        .get_clip(get("clips/walk"))
        .await
        .unwrap();
    assert_eq!(builtin.into_inner().clip.unwrap().forecast, None);
    let all = server
        .client
        .motions()
        .list_clips(pb::ListClipsRequest::default())
        .await
        .unwrap();
    assert!(all.into_inner().clips.iter().all(|c| c.forecast.is_none()));
    server.stop().await;
}
