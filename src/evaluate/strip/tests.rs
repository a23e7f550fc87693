use super::*;
use sinew_physics::body::topology::L_UPPER_ARM;
use sinew_physics::body::{DOF_COUNT, Posture, SEGMENT_COUNT};
use sinew_physics::math::Vec3;

#[test]
fn panels_are_evenly_spaced_and_include_both_ends() {
    assert_eq!(evenly_spaced(100, 4), [0, 33, 66, 99]);
    assert_eq!(evenly_spaced(3, 8), [0, 1, 2]);
    assert_eq!(evenly_spaced(1, 8), [0]);
    assert_eq!(evenly_spaced(0, 8), [0]);
}

fn frame(body: &Body) -> StripFrame {
    let mut posture = Posture::default();
    posture.root_position.z = body.standing_root_height();
    let mut contact = [(Vec3::zero(), Vec3::zero()); SEGMENT_COUNT];
    contact[12] = (Vec3::zero(), Vec3::Z * 400.0);
    let mut utilisation = [0.0; DOF_COUNT];
    utilisation[10] = 1.0;
    StripFrame {
        time_s: 0.5,
        posture,
        desired: posture,
        things: Vec::new(),
        contact,
        help: Vec3::zero(),
        com: posture.root_position,
        zmp: Some(Vec3::zero()),
        polygon: vec![[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]],
        utilisation,
        loads: vec![(9, Vec3::zero(), 5.0)],
        fallen: false,
        frozen: false,
    }
}

/// Vertices of every solid of a drawing.
fn solids(drawing: &Drawing) -> Vec<&Vec<[f64; 3]>> {
    drawing
        .items
        .iter()
        .filter_map(|item| match item {
            DrawnItem::Solid { vertices, .. } => Some(vertices),
            _ => None,
        })
        .collect()
}

#[test]
fn every_view_shows_all_segments_inside_the_picture() {
    let body = Body::adult_man();
    let frames = [frame(&body), frame(&body)];
    for view in [View::Side, View::Front, View::ThreeQuarter] {
        let options = StripOptions {
            view,
            title: "a < b & c".to_owned(),
            ..StripOptions::default()
        };
        let drawing = draw(&body, &frames, &options);
        let solids = solids(&drawing);
        assert_eq!(
            solids.len(),
            2 * (SEGMENT_COUNT + 1),
            "{view:?}: segments and the load"
        );
        for v in solids.into_iter().flatten() {
            let inside = v[0] > 0.0 && v[0] < drawing.width && v[1] > 0.0 && v[1] < drawing.height;
            assert!(inside, "{view:?}: {v:?}");
        }
        {
            let text = svg::write(&drawing);
            assert!(text.contains("a &lt; b &amp; c") && text.contains("0.50 s"));
            assert!(text.starts_with("<svg ") && text.ends_with("</svg>\n"));
        }
    }
}

#[test]
fn help_is_drawn_and_explained_where_there_is_some() {
    let body = Body::adult_man();
    let drawn = |help: Vec3| {
        let frame = StripFrame {
            help,
            ..frame(&body)
        };
        let drawing = draw(&body, &[frame], &StripOptions::default());
        svg::write(&drawing)
    };
    let arrows = |text: &str| text.matches("#5b2bc4").count();
    let (with, without) = (drawn(Vec3::Z * 200.0), drawn(Vec3::zero()));
    let explained = |text: &str| text.contains(">\nhelp\n<");
    assert!(explained(&with) && !explained(&without));
    // Shaft and head, in the panel and in the legend.
    assert_eq!(arrows(&with) - arrows(&without), 4);
}

#[test]
fn left_arm_is_on_the_right_from_the_front_and_behind_from_the_right_side() {
    let body = Body::adult_man();
    let arms = |view: View| {
        let drawing = draw(
            &body,
            &[frame(&body)],
            &StripOptions {
                view,
                ..StripOptions::default()
            },
        );
        let mean = |v: &[[f64; 3]]| {
            [0, 1, 2].map(|i| v.iter().map(|p| p[i]).sum::<f64>() / v.len() as f64)
        };
        let solids = solids(&drawing);
        let left = L_UPPER_ARM.index();
        (mean(solids[left]), mean(solids[left + 3]))
    };
    let (left, right) = arms(View::Front);
    assert!(left[0] > right[0]);
    let (left, right) = arms(View::Side);
    assert!(right[2] > left[2]);
}

#[test]
fn picture_file_has_the_size_of_the_drawing_and_shows_the_figure() {
    let body = Body::adult_man();
    let drawing = draw(&body, &[frame(&body)], &StripOptions::default());
    let file = raster::png(&drawing).expect("a small picture");
    let mut reader = png::Decoder::new(std::io::Cursor::new(file))
        .read_info()
        .expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
    let info = reader.next_frame(&mut pixels).expect("one frame");
    assert_eq!(
        (info.width, info.height),
        (drawing.width.ceil() as u32, drawing.height.ceil() as u32)
    );
    let colourful = pixels
        .chunks_exact(3)
        .filter(|p| p[0].abs_diff(p[2]) > 60)
        .count();
    assert!(
        colourful > 3000,
        "blue and orange limbs cover {colourful} pixels"
    );
}
