//! Composes a strip: camera, ground tile, shadow, ghost, body and marks of every panel, then the legend.

use super::drawing::{Drawing, DrawnItem, Rgba, TextAnchor};
use super::frame::{StripFrame, StripOptions, View};
use super::things::{Thing, ThingKind};
use crate::pose::{SegmentPose, segment_poses};
use sinew_physics::body::topology::{DOF_COUNT, DOF_SEGMENT, SEGMENT_NAMES};
use sinew_physics::body::{Body, Mesh, Posture, SEGMENT_COUNT};
use sinew_physics::math::Vec3;
use sinew_physics::math::polygon::hull;
use sinew_physics::motion::GRAVITY;

const BACKGROUND: Rgba = Rgba::hex(0xfb_fbf9);
const GROUND: Rgba = Rgba::hex(0xec_ebe6);
const GRID: Rgba = Rgba::hex(0xdd_dbd4);
const SHADOW: Rgba = Rgba::hex(0xd6_d4cd);
const GHOST: Rgba = Rgba::hex(0xbf_cddd);
const LEFT: Rgba = Rgba::hex(0x4f_93dd);
const RIGHT: Rgba = Rgba::hex(0xf0_9345);
const TRUNK: Rgba = Rgba::hex(0xbd_c2cb);
const LOAD: Rgba = Rgba::hex(0x8a_6a4f);
const OBSTACLE: Rgba = Rgba::hex(0xa8_9f8d);
const OTHER: Rgba = Rgba::hex(0x8f_b59a);
const FORCE: Rgba = Rgba::hex(0x1f_8f55);
const HELP: Rgba = Rgba::hex(0x5b_2bc4);
const COM: Rgba = Rgba::hex(0x22_262c);
const ZMP: Rgba = Rgba::hex(0xb1_2d9a);
const LIMIT: Rgba = Rgba::hex(0xd0_1f2e);
const NEAR_LIMIT: Rgba = Rgba::hex(0xe0_a100);
const INK: Rgba = Rgba::hex(0x33_373d);
const FAINT: Rgba = Rgba::hex(0x77_7c84);

/// Share of the strength above which a joint is marked as near its limit.
const NEAR: f64 = 0.8;
/// A force of the body's weight is drawn this long, m.
const WEIGHT_LENGTH: f64 = 0.45;
/// Impacts reach many times the weight; their arrows end here, m.
const LONGEST_FORCE: f64 = 1.0;
/// Half depth of a ground tile, m.
const TILE_DEPTH: f64 = 0.5;
/// A ghost farther off than this is not drawn: after a fall the desired motion walks on alone, m.
const GHOST_RANGE: f64 = 1.5;
/// A thing whose nearest corner is farther from the figure than the first is not drawn; a panel widens for things up to
/// the second, m.
const THING_RANGE: f64 = 1.3;
const THING_WIDTH: f64 = 1.6;
/// The same for the parts of another figure: the picture is about the interaction of the two, until they have
/// separated.
const OTHER_RANGE: f64 = 3.5;
const OTHER_WIDTH: f64 = 3.5;
/// Surface of a limb without a mesh, m.
const BARE_RADIUS: f64 = 0.04;

/// An orthographic camera: right, up and towards the viewer, world axes.
#[derive(Clone, Copy)]
struct Camera {
    right: Vec3,
    up: Vec3,
    near: Vec3,
}

impl Camera {
    /// Looks at a figure with the given heading (rad about z).
    fn new(view: View, heading: f64) -> Self {
        let (azimuth, elevation) = match view {
            View::Side => (-90f64, 9f64),
            View::Front => (0.0, 9.0),
            View::ThreeQuarter => (-38.0, 14.0),
        };
        let (sa, ca) = (azimuth.to_radians() + heading).sin_cos();
        let (se, ce) = elevation.to_radians().sin_cos();
        let near = Vec3 {
            x: ce * ca,
            y: ce * sa,
            z: se,
        };
        let right = Vec3 {
            x: -sa,
            y: ca,
            z: 0.0,
        };
        Self {
            right,
            up: near.cross(right),
            near,
        }
    }
}

/// A panel: camera, its centre on the ground, and the place of that centre in the picture.
struct PanelPlace {
    camera: Camera,
    centre: Vec3,
    origin: [f64; 2],
    scale: f64,
}

impl PanelPlace {
    fn to_screen(&self, p: Vec3) -> [f64; 3] {
        let d = p - self.centre;
        let (x, y, z) = (
            d.dot(self.camera.right),
            d.dot(self.camera.up),
            d.dot(self.camera.near),
        );
        [
            self.origin[0] + x * self.scale,
            self.origin[1] - y * self.scale,
            z * self.scale,
        ]
    }
    fn flat(&self, p: Vec3) -> [f64; 2] {
        let [x, y, _] = self.to_screen(p);
        [x, y]
    }
}

/// Surface of every segment with smooth normals, segment frame.
struct Skin {
    mesh: Mesh,
    normals: Vec<Vec3>,
}

impl Skin {
    fn new(mesh: Mesh) -> Self {
        let mut normals = vec![Vec3::zero(); mesh.vertices.len()];
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
            let n = (b - a).cross(c - a); // weighted by area
            for i in t {
                normals[*i as usize] += n;
            }
        }
        for n in &mut normals {
            *n = n.normalized_or(Vec3::Z);
        }
        Self { mesh, normals }
    }

    /// A ball.
    fn ball(centre: Vec3, radius: f64) -> Self {
        let (rings, sectors) = (8u32, 16u32);
        let mut mesh = Mesh::default();
        for i in 0..=rings {
            let (st, ct) = (std::f64::consts::PI * f64::from(i) / f64::from(rings)).sin_cos();
            for j in 0..sectors {
                let (sp, cp) =
                    (std::f64::consts::TAU * f64::from(j) / f64::from(sectors)).sin_cos();
                mesh.vertices.push(
                    centre
                        + Vec3 {
                            x: st * cp,
                            y: st * sp,
                            z: ct,
                        } * radius,
                );
            }
        }
        for i in 0..rings {
            for j in 0..sectors {
                let at = |i: u32, j: u32| i * sectors + j % sectors;
                mesh.triangles
                    .push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                mesh.triangles
                    .push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        let normals = mesh
            .vertices
            .iter()
            .map(|v| (*v - centre).normalized_or(Vec3::Z))
            .collect();
        Self { mesh, normals }
    }

    /// The segment's own surface; a chain of balls from joint to tip if it has none.
    fn of(body: &Body, s: usize) -> Self {
        let segment = &body.segments[s];
        if !segment.mesh.triangles.is_empty() {
            return Self::new(segment.mesh.clone());
        }
        let mut out = Self {
            mesh: Mesh::default(),
            normals: Vec::new(),
        };
        for i in 0..=8 {
            let ball = Self::ball(segment.tip * (f64::from(i) / 8.0), BARE_RADIUS);
            let first = out.mesh.vertices.len() as u32;
            out.mesh.vertices.extend(ball.mesh.vertices);
            out.mesh
                .triangles
                .extend(ball.mesh.triangles.iter().map(|t| t.map(|v| v + first)));
            out.normals.extend(ball.normals);
        }
        out
    }
}

pub(super) fn draw(body: &Body, frames: &[StripFrame], options: &StripOptions) -> Drawing {
    let heading = frames.first().map_or(0.0, |f| {
        let forward = f.posture.root_rotation.rotate(Vec3::X);
        forward.y.atan2(forward.x)
    });
    let camera = Camera::new(options.view, heading);
    let skins: Vec<Skin> = (0..SEGMENT_COUNT).map(|s| Skin::of(body, s)).collect();
    let scale = options.scale;
    let extents: Vec<[f64; 3]> = frames
        .iter()
        .map(|f| extent(body, &skins, f, camera))
        .collect();
    let top = extents.iter().map(|e| e[2]).fold(1.0, f64::max);
    let head_room = 46.0;
    let tile_drop = TILE_DEPTH * camera.near.z * scale;
    let ground_y = head_room + 14.0 + top * scale;
    let label_y = ground_y + tile_drop + 22.0;
    let mut items = Vec::new();
    let mut x = 16.0;
    for (frame, [left, right, _]) in frames.iter().zip(&extents) {
        let place = PanelPlace {
            camera,
            centre: ground_below(frame.posture.root_position),
            origin: [x + left * scale, ground_y],
            scale,
        };
        panel(
            &mut items,
            body,
            &skins,
            frame,
            &place,
            [-left + 0.02, right - 0.02],
        );
        label(
            &mut items,
            frame,
            [place.origin[0] + (right - left) / 2.0 * scale, label_y],
        );
        x += (left + right) * scale;
    }
    let legend_y = label_y + 42.0;
    let helped = frames.iter().any(|f| f.help != Vec3::zero());
    let legend_end = legend(&mut items, [20.0, legend_y], helped);
    items.push(DrawnItem::Text {
        at: [20.0, 30.0],
        size: 20.0,
        anchor: TextAnchor::Start,
        colour: INK,
        text: options.title.clone(),
    });
    Drawing {
        width: (x + 16.0).max(legend_end),
        height: legend_y + 18.0,
        background: BACKGROUND,
        items,
    }
}

fn ground_below(p: Vec3) -> Vec3 {
    Vec3 { z: 0.0, ..p }
}

fn shows_ghost(frame: &StripFrame) -> bool {
    (frame.desired.root_position - frame.posture.root_position).norm() < GHOST_RANGE
}

/// Reach of a panel to the left, to the right and up of its centre, m.
fn extent(body: &Body, skins: &[Skin], frame: &StripFrame, camera: Camera) -> [f64; 3] {
    let centre = ground_below(frame.posture.root_position);
    let mut out = [0.36, 0.36, 0.0f64];
    let mut reach = |p: Vec3, margin: f64| {
        let d = p - centre;
        let (x, y) = (d.dot(camera.right), d.dot(camera.up));
        out = [
            out[0].max(margin - x),
            out[1].max(x + margin),
            out[2].max(y),
        ];
    };
    let mut postures = vec![&frame.posture];
    if shows_ghost(frame) {
        postures.push(&frame.desired);
    }
    for posture in postures {
        for (pose, skin) in segment_poses(&body.joint_offset, posture).iter().zip(skins) {
            for v in &skin.mesh.vertices {
                reach(pose.point(*v), 0.06);
            }
        }
    }
    for t in near(frame) {
        let (_, width) = reach_of(t);
        for v in &t.mesh.vertices {
            let d = t.pose.point(*v) - centre;
            let (x, y) = (d.dot(camera.right), d.dot(camera.up));
            out[0] = out[0].max((0.06 - x).min(width));
            out[1] = out[1].max((0.06 + x).min(width));
            if x.abs() < width {
                out[2] = out[2].max(y.min(THING_RANGE));
            }
        }
    }
    out
}

/// Largest distance at which a thing is drawn, and the distance by which a panel widens for it, m.
fn reach_of(thing: &Thing) -> (f64, f64) {
    match thing.kind {
        ThingKind::Obstacle => (THING_RANGE, THING_WIDTH),
        ThingKind::Other(_) => (OTHER_RANGE, OTHER_WIDTH),
    }
}

/// Things near the figure.
fn near(frame: &StripFrame) -> impl Iterator<Item = &Thing> {
    let at = frame.posture.root_position;
    frame.things.iter().filter(move |t| {
        let (range, _) = reach_of(t);
        let mut corners = t.mesh.vertices.iter();
        corners.any(|v| (t.pose.point(*v) - at).norm() < range)
    })
}

/// Draws the things in front of the figure, or those behind it.
fn things(items: &mut Vec<DrawnItem>, frame: &StripFrame, place: &PanelPlace, front: bool) {
    for t in near(frame) {
        let middle = t.mesh.vertices.iter().fold(Vec3::zero(), |m, v| m + *v)
            * (1.0 / t.mesh.vertices.len().max(1) as f64);
        let d = t.pose.point(middle) - frame.posture.root_position;
        if (d.dot(place.camera.near) > 0.0) == front {
            let colour = match t.kind {
                ThingKind::Obstacle => OBSTACLE,
                ThingKind::Other(_) => OTHER,
            };
            let skin = Skin::new(t.mesh.clone());
            items.push(solid(&skin, &t.pose, colour, place));
        }
    }
}

fn panel(
    items: &mut Vec<DrawnItem>,
    body: &Body,
    skins: &[Skin],
    frame: &StripFrame,
    place: &PanelPlace,
    sides: [f64; 2],
) {
    let poses = segment_poses(&body.joint_offset, &frame.posture);
    tile(items, place, sides);
    for (pose, skin) in poses.iter().zip(skins) {
        let shadow: Vec<[f64; 2]> = skin
            .mesh
            .vertices
            .iter()
            .map(|v| place.flat(ground_below(pose.point(*v))))
            .collect();
        items.push(DrawnItem::Polygon {
            points: hull(&shadow),
            fill: SHADOW,
            stroke: None,
        });
    }
    if frame.polygon.len() > 2 {
        let points = frame
            .polygon
            .iter()
            .map(|p| {
                place.flat(Vec3 {
                    x: p[0],
                    y: p[1],
                    z: 0.0,
                })
            })
            .collect();
        items.push(DrawnItem::Polygon {
            points,
            fill: FORCE.alpha(46),
            stroke: Some((FORCE.alpha(150), 1.2)),
        });
    }
    if shows_ghost(frame) {
        ghost(items, body, skins, &frame.desired, place);
    }
    things(items, frame, place, false);
    for s in 0..SEGMENT_COUNT {
        items.push(solid(&skins[s], &poses[s], segment_colour(s), place));
    }
    things(items, frame, place, true);
    for (s, point, mass) in &frame.loads {
        // As large as a ball of twice the density of water.
        let radius = (mass / 2000.0 * 0.75 / std::f64::consts::PI).cbrt();
        items.push(solid(&Skin::ball(*point, radius), &poses[*s], LOAD, place));
    }
    marks(items, body, frame, &poses, place);
}

/// The ground under one panel with lines every half metre of the world.
fn tile(items: &mut Vec<DrawnItem>, place: &PanelPlace, sides: [f64; 2]) {
    let right = place.camera.right;
    let towards = Vec3 {
        x: right.y,
        y: -right.x,
        z: 0.0,
    }; // horizontal, to the viewer
    let at = |x: f64, y: f64| place.flat(place.centre + right * x + towards * y);
    let depth = [-TILE_DEPTH, TILE_DEPTH];
    items.push(DrawnItem::Polygon {
        points: vec![
            at(sides[0], depth[0]),
            at(sides[1], depth[0]),
            at(sides[1], depth[1]),
            at(sides[0], depth[1]),
        ],
        fill: GROUND,
        stroke: None,
    });
    for axis in [Vec3::X, Vec3::Y] {
        let c = place.centre.dot(axis);
        for k in ((c - 4.0) * 2.0).floor() as i64..=((c + 4.0) * 2.0).ceil() as i64 {
            // The line {p: p·axis = k/2} in tile coordinates, clipped to the tile.
            let foot = axis * (k as f64 / 2.0 - c);
            let along = Vec3::Z.cross(axis);
            let start = [foot.dot(right), foot.dot(towards)];
            let step = [along.dot(right), along.dot(towards)];
            let (mut from, mut to) = (-4.0f64, 4.0f64);
            for (i, range) in [sides, depth].iter().enumerate() {
                if step[i].abs() < 1e-9 {
                    if start[i] < range[0] || start[i] > range[1] {
                        to = from;
                    }
                    continue;
                }
                let (a, b) = (
                    (range[0] - start[i]) / step[i],
                    (range[1] - start[i]) / step[i],
                );
                from = from.max(a.min(b));
                to = to.min(a.max(b));
            }
            if from < to {
                let p = |u: f64| at(start[0] + u * step[0], start[1] + u * step[1]);
                items.push(DrawnItem::Line {
                    from: p(from),
                    to: p(to),
                    width: 1.0,
                    colour: GRID,
                });
            }
        }
    }
}

/// The desired posture as one pale silhouette.
fn ghost(
    items: &mut Vec<DrawnItem>,
    body: &Body,
    skins: &[Skin],
    desired: &Posture,
    place: &PanelPlace,
) {
    let poses = segment_poses(&body.joint_offset, desired);
    for (pose, skin) in poses.iter().zip(skins) {
        let flat: Vec<[f64; 2]> = skin
            .mesh
            .vertices
            .iter()
            .map(|v| place.flat(pose.point(*v)))
            .collect();
        items.push(DrawnItem::Polygon {
            points: hull(&flat),
            fill: GHOST,
            stroke: Some((GHOST, 2.5)),
        });
    }
}

fn segment_colour(s: usize) -> Rgba {
    match SEGMENT_NAMES[s].as_bytes() {
        [b'l', b'_', ..] => LEFT,
        [b'r', b'_', ..] => RIGHT,
        _ => TRUNK,
    }
}

fn solid(skin: &Skin, pose: &SegmentPose, colour: Rgba, place: &PanelPlace) -> DrawnItem {
    let Camera { right, up, near } = place.camera;
    let to_light = (right * -0.45 + up * 0.6 + near * 0.66).normalized_or(Vec3::Z);
    let vertices: Vec<[f64; 3]> = skin
        .mesh
        .vertices
        .iter()
        .map(|v| place.to_screen(pose.point(*v)))
        .collect();
    let flat: Vec<[f64; 2]> = vertices.iter().map(|v| [v[0], v[1]]).collect();
    let light = skin
        .normals
        .iter()
        .map(|n| {
            let n = pose.rotation.rotate(*n);
            // Ambient, sky from above, key light, and a darker rim that separates limbs from each other.
            let rim = n.dot(near).clamp(0.0, 1.0).sqrt();
            (0.56 + 0.1 * n.z + 0.5 * n.dot(to_light).max(0.0)) * (0.66 + 0.34 * rim)
        })
        .collect();
    DrawnItem::Solid {
        outline: hull(&flat),
        vertices,
        light,
        triangles: skin.mesh.triangles.clone(),
        colour,
    }
}

/// Forces, centre of mass, zero-moment point, and joints near the limit of their strength.
fn marks(
    items: &mut Vec<DrawnItem>,
    body: &Body,
    frame: &StripFrame,
    poses: &[SegmentPose; SEGMENT_COUNT],
    place: &PanelPlace,
) {
    let weight = body.profile.mass * GRAVITY;
    let mut force = |point: Vec3, force: Vec3, colour: Rgba| {
        let length = force * (WEIGHT_LENGTH / weight);
        let n = length.norm();
        if n > 0.01 {
            let length = length * (LONGEST_FORCE / n).min(1.0);
            let ends = [point, point + length].map(|p| place.flat(p));
            arrow(items, ends, colour);
        }
    };
    for (point, f) in frame.contact {
        force(point, f, FORCE);
    }
    force(poses[0].position, frame.help, HELP);
    let com = place.flat(frame.com);
    items.push(DrawnItem::Line {
        from: com,
        to: place.flat(ground_below(frame.com)),
        width: 1.0,
        colour: COM.alpha(110),
    });
    if let Some(zmp) = frame.zmp {
        let d = zmp - place.centre;
        // The zero-moment point of a tipping figure can be far away.
        if d.norm() < 1.0 {
            cross(items, place.flat(zmp));
        }
    }
    items.push(com_mark(com));
    let mut used = [0.0f64; SEGMENT_COUNT];
    for d in 0..DOF_COUNT {
        used[DOF_SEGMENT[d]] = used[DOF_SEGMENT[d]].max(frame.utilisation[d]);
    }
    for s in 1..SEGMENT_COUNT {
        if used[s] >= NEAR {
            items.push(ring(place.flat(poses[s].position), used[s] >= 0.999));
        }
    }
}

fn com_mark(at: [f64; 2]) -> DrawnItem {
    DrawnItem::Circle {
        centre: at,
        radius: 4.5,
        fill: Rgba::hex(0xff_ffff),
        stroke: Some((COM, 2.0)),
    }
}

fn cross(items: &mut Vec<DrawnItem>, at: [f64; 2]) {
    for (dx, dy) in [(4.0, 4.0), (4.0, -4.0)] {
        let (from, to) = ([at[0] - dx, at[1] - dy], [at[0] + dx, at[1] + dy]);
        items.push(DrawnItem::Line {
            from,
            to,
            width: 2.4,
            colour: ZMP,
        });
    }
}

fn ring(at: [f64; 2], at_limit: bool) -> DrawnItem {
    let colour = if at_limit { LIMIT } else { NEAR_LIMIT };
    DrawnItem::Circle {
        centre: at,
        radius: 6.5,
        fill: colour.alpha(0),
        stroke: Some((colour, 2.6)),
    }
}

fn arrow(items: &mut Vec<DrawnItem>, [from, to]: [[f64; 2]; 2], colour: Rgba) {
    let d = [to[0] - from[0], to[1] - from[1]];
    let n = d[0].hypot(d[1]).max(1e-9);
    let u = [d[0] / n, d[1] / n];
    let head = n.min(9.0);
    let base = [to[0] - u[0] * head, to[1] - u[1] * head];
    items.push(DrawnItem::Line {
        from,
        to: base,
        width: 2.6,
        colour,
    });
    let side = [-u[1] * head * 0.42, u[0] * head * 0.42];
    items.push(DrawnItem::Polygon {
        points: vec![
            to,
            [base[0] + side[0], base[1] + side[1]],
            [base[0] - side[0], base[1] - side[1]],
        ],
        fill: colour,
        stroke: None,
    });
}

fn label(items: &mut Vec<DrawnItem>, frame: &StripFrame, at: [f64; 2]) {
    let (text, colour) = if frame.frozen {
        (format!("{:.2} s, frozen", frame.time_s), LIMIT)
    } else if frame.fallen {
        (format!("{:.2} s, fallen", frame.time_s), LIMIT)
    } else {
        (format!("{:.2} s", frame.time_s), INK)
    };
    items.push(DrawnItem::Text {
        at,
        size: 16.0,
        anchor: TextAnchor::Middle,
        colour,
        text,
    });
}

/// Explains the marks, also of help if there is any; returns the x at which it ends.
fn legend(items: &mut Vec<DrawnItem>, at: [f64; 2], helped: bool) -> f64 {
    let mut x = at[0];
    let y = at[1] - 4.0;
    let entries: [(&str, &dyn Fn(&mut Vec<DrawnItem>, f64)); 9] = [
        ("left", &|i, x| i.push(swatch(x, y, LEFT))),
        ("right", &|i, x| i.push(swatch(x, y, RIGHT))),
        ("desired", &|i, x| i.push(swatch(x, y, GHOST))),
        ("contact force", &|i, x| {
            arrow(i, [[x, y + 7.0], [x, y - 8.0]], FORCE)
        }),
        ("help", &|i, x| arrow(i, [[x, y + 7.0], [x, y - 8.0]], HELP)),
        ("centre of mass", &|i, x| i.push(com_mark([x, y]))),
        ("zero-moment point", &|i, x| cross(i, [x, y])),
        ("joint above 80 % of its strength", &|i, x| {
            i.push(ring([x, y], false))
        }),
        ("at its limit", &|i, x| i.push(ring([x, y], true))),
    ];
    for (text, mark) in entries.iter().filter(|(text, _)| helped || *text != "help") {
        mark(items, x + 7.0);
        items.push(DrawnItem::Text {
            at: [x + 20.0, at[1]],
            size: 13.0,
            anchor: TextAnchor::Start,
            colour: FAINT,
            text: (*text).to_owned(),
        });
        // Wide enough for the proportional fonts of SVG viewers too.
        x += 20.0 + text.chars().count() as f64 * 6.9 + 20.0;
    }
    x
}

fn swatch(x: f64, y: f64, colour: Rgba) -> DrawnItem {
    DrawnItem::Circle {
        centre: [x, y],
        radius: 6.0,
        fill: colour,
        stroke: None,
    }
}
