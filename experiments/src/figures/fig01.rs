//! Fig. 1: the displacement variables of the bouncing-disk system.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};

use bouncing_disk::Event;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::core::numerics::elementary::{atan2, sin, sin_cos};
use bouncing_disk::toss::{InitialSpin, toss_trajectory};
use bouncing_disk_plot::{
    Anchor, Camera, Colour, DOUBLE_COLUMN, Dash, Drawing, Figure, Path, Rect, Stroke, TextStyle,
};
use glam::DVec3;
use serde::Serialize;

use super::shared::cylinder::{Cylinder, HandPath, Look, arc, circle, curve, faint, polar};
use super::shared::toss::TossCase;
use crate::claims::paper::TableOne;
use crate::experiment::{ExperimentError, Paper, named};

/// Fig. 1.
pub(crate) fn fig01(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let (quality, progress) = (fig.quality, fig.progress);
    progress.start(1, "toss");
    let table_i = crate::claims::paper::table_one()?;
    let case = TossCase::from(&table_i).at_lag(PHASE_LAG);
    let system = case.system()?;
    let scales = system.scales();
    let trajectory = toss_trajectory(&system, InitialSpin::AbsoluteRest)?;
    let flight = trajectory.records().iter().find(|record| matches!(record.event, Event::Impact { .. }));
    let Some(flight) = flight else {
        let peak_acceleration = system.peak_acceleration();
        return Err(ExperimentError::model(bouncing_disk::Error::NeverLeaves { peak_acceleration }));
    };
    let instant = flight.evaluate(system.dimensionless(), SHARE_OF_FLIGHT);
    let disk = scales.state(&instant.disk);
    let platform = system.platform();
    let path = HandPath::new(platform, quality.choose(120, 720))?;
    progress.advance(1);
    let data = &Fig01Data {
        phase_lag_rad: PHASE_LAG,
        contact_radius_m: case.contact_radius_m,
        disk_radius_m: SQRT_2 * case.gyration_radius_m,
        amplitude_m: platform.amplitude(),
        twist_amplitude_rad: platform.twist_amplitude(),
        phase_rad: instant.time.phase.angle(),
        platform_height_m: platform.height(instant.time.phase),
        platform_angle_rad: platform.angle(instant.time.phase),
        disk_height_m: disk.height,
        disk_angle_rad: disk.angle,
        path,
        table_i,
    };
    fig.caption(format!(
        "The displacement variables of the bouncing-disk system and of pizza tossing, (a) and (c) drawn in perspective and to \
         scale from a computed toss. (a) The disk (x, α) above the oscillating platform (s, β) at the phase τ = {:.3} \
         rad, {:.0} % of its flight after the separation: x = {:.3} m, s = {:.3} m, α = {:.2} rad, β = {:.2} rad. \
         Heights are measured from the platform's mean height, angles from the line on which the \
         platform's mark lies when β = 0; the disk's mark lay over it at the start. (b) A sketch, not to scale: a dough above \
         the hand that tosses it, with the same four variables. (c) The path of a point of the platform at the contact radius a_e, Eq. (1): a \
         closed curve on the surface of a cylinder, with the amplitudes A and a_e Φ; the dot is the point at the \
         instant of (a), the arrows show the sense of the motion, what lies behind the cylinder is dotted. \
         Parameters of Table I except for θ = −π/4, chosen here because the path for θ = 0 encloses no area; the \
         radius of disk and platform, √2 a_g, is that of a uniform disk, their thickness is not to scale.",
        data.phase_rad,
        100.0 * SHARE_OF_FLIGHT,
        data.disk_height_m,
        data.platform_height_m,
        data.disk_angle_rad,
        data.platform_angle_rad,
    ));
    fig.parameters(parameters(data));
    fig.draw(draw(data)?);
    fig.data(data)
}

fn parameters(data: &Fig01Data) -> Vec<(String, String)> {
    let table = &data.table_i;
    named([
        ("phase lag θ", format!("{:.2}π (Table I: {})", data.phase_lag_rad / PI, table.phase_lag_rad)),
        ("amplitude angle φ_L", format!("{} rad", table.amplitude_angle_rad.value)),
        ("stroke c", format!("{} m", table.stroke_m.value)),
        ("angular frequency ω", format!("{} rad/s", table.angular_frequency_rad_per_s.value)),
        ("contact radius a_e", format!("{} m", table.contact_radius_m.value)),
        ("radius of gyration a_g", format!("{} m", table.gyration_radius_m.value)),
        ("friction μ", table.friction.value.to_string()),
        ("start", "lowest point of the hand, dough at rest".to_owned()),
    ])
}

fn draw(data: &Fig01Data) -> Result<Figure, ExperimentError> {
    let high = HEIGHT - 8.0;
    Ok(Figure::new(WIDTH, HEIGHT)
        .drawing(system(data, Rect::new(4.0, 4.0, 172.0, high)))
        .drawing(sketch(data, Rect::new(191.0, 4.0, 184.0, high)))
        .drawing(path(data, Rect::new(380.0, 4.0, WIDTH - 384.0, high))))
}

/// The data of Fig. 1: the toss of Table I with another phase lag, and one instant of it.
#[derive(Debug, Serialize)]
pub(crate) struct Fig01Data {
    table_i: TableOne,
    phase_lag_rad: f64,
    contact_radius_m: f64,
    /// The radius of a uniform disk with Table I's radius of gyration.
    disk_radius_m: f64,
    amplitude_m: f64,
    twist_amplitude_rad: f64,
    phase_rad: f64,
    platform_height_m: f64,
    platform_angle_rad: f64,
    disk_height_m: f64,
    disk_angle_rad: f64,
    path: HandPath,
}

/// Phase lag of the motion shown. Table I has 0, for which the path of a point is a mere arc.
const PHASE_LAG: f64 = -FRAC_PI_4;

/// The instant shown, as a share of the flight.
const SHARE_OF_FLIGHT: f64 = 0.18;

const WIDTH: f64 = DOUBLE_COLUMN;
const HEIGHT: f64 = 236.0;
/// Azimuth and elevation of the eye (rad) and its distance in stroke lengths.
const AZIMUTH: f64 = 0.8;
const ELEVATION: f64 = 0.42;
const DISTANCE: f64 = 9.0;
/// Thickness of disk and platform over their radius.
const THICKNESS: f64 = 0.12;
/// Where the arcs of the angles are drawn, over the disk's radius.
const ANGLE_ARC: f64 = 0.82;
/// Where the sketched fingers point (rad): to the left of the picture.
const FINGERS: f64 = AZIMUTH - FRAC_PI_2 - 0.2;

fn camera(data: &Fig01Data) -> Camera {
    Camera::around(DVec3::ZERO, AZIMUTH, ELEVATION, DISTANCE * data.table_i.stroke_m.value)
}

fn thin() -> Stroke {
    Stroke::new(Colour::DARK_GREY, 0.6)
}

fn small(anchor: Anchor, colour: Colour) -> TextStyle {
    TextStyle::new(anchor).size(8.0).colour(colour)
}

fn line(camera: &Camera, from: DVec3, to: DVec3) -> Path {
    Path::through([camera.project(from), camera.project(to)])
}

/// A disk with its upper face at `height`, the line of angle 0 and a mark at `angle`.
fn turned(
    drawing: Drawing,
    camera: &Camera,
    radius: f64,
    height: f64,
    angle: f64,
    colour: Colour,
) -> Drawing {
    let body = Cylinder { radius, bottom: height - THICKNESS * radius, top: height };
    let look = Look {
        side: colour.mixed(Colour::WHITE, 0.45),
        face: colour.mixed(Colour::WHITE, 0.80),
        opacity: 1.0,
        edge: Stroke::new(colour.mixed(Colour::BLACK, 0.25), 0.8),
        through: false,
    };
    let drawing = body.drawn(drawing, camera, &look);
    let centre = DVec3::new(0.0, 0.0, height);
    let mark = polar(radius, angle, height);
    let swept = arc(camera, ANGLE_ARC * radius, (0.0, angle), height);
    drawing
        .stroke(line(camera, centre, polar(radius, 0.0, height)), thin().dashed(Dash::Dashed))
        .stroke(line(camera, centre, mark), Stroke::new(colour, 1.2))
        .arrow(swept, Stroke::new(Colour::BLACK, 0.9))
}

/// The heights s and x, at the left of the outline, from the platform's mean height.
fn heights(mut drawing: Drawing, camera: &Camera, data: &Fig01Data) -> Drawing {
    let radius = data.disk_radius_m;
    let left = AZIMUTH - FRAC_PI_2;
    for (distance, height, name) in [(1.30, data.platform_height_m, "$s$"), (1.62, data.disk_height_m, "$x$")]
    {
        let foot = camera.project(polar(distance * radius, left, 0.0));
        let head = (foot.0, camera.project(polar(distance * radius, left, height)).1);
        let edge = camera.project(polar(1.02 * radius, left, height));
        let past = (foot.0 - 0.06 * radius, edge.1);
        drawing = drawing
            .stroke(Path::through([edge, past]), thin())
            .arrow([foot, head], Stroke::new(Colour::BLACK, 0.9))
            .text((head.0 - 0.09 * radius, 0.5 * (foot.1 + head.1)), Anchor::RightCentre, name);
    }
    let far = camera.project(polar(1.75 * radius, left, 0.0));
    let near = camera.project(polar(radius, left, 0.0));
    drawing.stroke(Path::through([near, far]), thin())
}

/// The range of a drawing of disk and platform, or of dough and hand.
fn framed(data: &Fig01Data, camera: &Camera, area: Rect, across: (f64, f64)) -> (Drawing, f64, f64) {
    let radius = data.disk_radius_m;
    let (low, high) = (-1.3 * data.amplitude_m, data.disk_height_m + 0.75 * radius);
    let up = |height: f64| camera.project(DVec3::new(0.0, 0.0, height)).1;
    let range = (across.0 * radius, across.1 * radius);
    (Drawing::with_equal_scales(area, range, (up(low), up(high))), low, high)
}

fn system(data: &Fig01Data, area: Rect) -> Drawing {
    let camera = camera(data);
    let radius = data.disk_radius_m;
    let thickness = THICKNESS * radius;
    let (mut drawing, low, high) = framed(data, &camera, area, (-1.85, 1.25));
    let axis = |height: f64| DVec3::new(0.0, 0.0, height);
    let chain = thin().dashed(Dash::DashDotted);
    drawing = drawing.stroke(line(&camera, axis(low), axis(data.platform_height_m)), chain);
    drawing = drawing.stroke(circle(&camera, radius, 0.0), faint(Stroke::new(Colour::BLACK, 1.0)));
    drawing = turned(drawing, &camera, radius, data.platform_height_m, data.platform_angle_rad, Colour::BLUE);
    let bottom = data.disk_height_m;
    drawing = drawing.stroke(line(&camera, axis(data.platform_height_m), axis(bottom)), chain);
    // The height x is that of the disk's lower face.
    drawing = turned(drawing, &camera, radius, bottom + thickness, data.disk_angle_rad, Colour::VERMILION);
    drawing = drawing.stroke(line(&camera, axis(bottom + thickness), axis(high)), chain);
    drawing = heights(drawing, &camera, data);
    for (height, angle, name) in [
        (data.platform_height_m, data.platform_angle_rad, r"$\beta$"),
        (bottom + thickness, data.disk_angle_rad, r"$\alpha$"),
    ] {
        let place = camera.project(polar(0.56 * radius, 0.5 * angle, height));
        drawing = drawing.text(place, Anchor::Centre, name);
    }
    let name = |height: f64| camera.project(polar(1.08 * radius, AZIMUTH + FRAC_PI_2, height));
    let words = |drawing: Drawing, at: (f64, f64), text: &str, colour: Colour| {
        drawing.text(at, small(Anchor::LeftCentre, colour.mixed(Colour::BLACK, 0.25)), text)
    };
    drawing = words(drawing, name(bottom + 0.5 * thickness), "disk", Colour::VERMILION);
    drawing = words(drawing, name(data.platform_height_m), "platform", Colour::BLUE);
    letter(drawing, area, "(a)")
}

/// A closed outline in a horizontal plane, as it appears.
fn outline(camera: &Camera, points: impl IntoIterator<Item = (f64, f64)>, height: f64) -> Path {
    Path::through(points.into_iter().map(|(radius, angle)| camera.project(polar(radius, angle, height))))
        .close()
}

/// The rim of the sketched dough: a circle with a few bulges, of which one point in a hundred is drawn.
fn rim(radius: f64, turned: f64) -> impl Iterator<Item = (f64, f64)> {
    (0..100).map(move |step| {
        let angle = std::f64::consts::TAU * f64::from(step) / 100.0;
        (radius * (1.0 + 0.035 * sin(3.0 * angle + 0.4) + 0.02 * sin(5.0 * angle)), angle + turned)
    })
}

/// The parts of the sketched hand, from end to end with a half width, in radii of the dough: along the
/// fingers and across.
const HAND: [[f64; 5]; 7] = [
    [-1.75, 0.00, -0.45, 0.00, 0.24],
    [-0.42, 0.00, 0.05, 0.00, 0.46],
    [0.20, 0.36, 0.62, 0.50, 0.10],
    [0.25, 0.13, 0.86, 0.19, 0.11],
    [0.25, -0.12, 0.88, -0.14, 0.11],
    [0.20, -0.35, 0.72, -0.45, 0.10],
    [-0.40, 0.38, 0.02, 0.78, 0.12],
];

/// A rounded bar in a horizontal plane.
fn bar(camera: &Camera, radius: f64, part: [f64; 5], turned: f64, height: f64) -> Path {
    let [x, y, to_x, to_y, half] = part;
    let along = atan2(to_y - y, to_x - x);
    let end = |centre: (f64, f64), from: f64| {
        (0..=24).map(move |step| {
            let angle = from + std::f64::consts::PI * f64::from(step) / 24.0;
            let (sine, cosine) = sin_cos(angle);
            (centre.0 + half * cosine, centre.1 + half * sine)
        })
    };
    let points = end((to_x, to_y), along - FRAC_PI_2).chain(end((x, y), along + FRAC_PI_2));
    outline(camera, points.map(|(x, y)| (radius * (x * x + y * y).sqrt(), turned + atan2(y, x))), height)
}

/// The dough above the hand, from plain shapes, at the heights and angles of (a).
fn sketch(data: &Fig01Data, area: Rect) -> Drawing {
    let camera = camera(data);
    let radius = data.disk_radius_m;
    let (mut drawing, low, high) = framed(data, &camera, area, (-1.80, 1.60));
    let axis = |height: f64| DVec3::new(0.0, 0.0, height);
    let chain = thin().dashed(Dash::DashDotted);
    let (palm, bottom) = (data.platform_height_m, data.disk_height_m);
    let top = bottom + THICKNESS * radius;
    drawing = drawing
        .stroke(line(&camera, axis(low), axis(palm)), chain)
        .stroke(circle(&camera, radius, 0.0), faint(Stroke::new(Colour::BLACK, 1.0)));
    let skin = Colour::ORANGE.mixed(Colour::WHITE, 0.72);
    let edge = Colour::ORANGE.mixed(Colour::BLACK, 0.45);
    let fingers = FINGERS + data.platform_angle_rad;
    let parts = HAND.map(|part| bar(&camera, radius, part, fingers, palm));
    // The outline of the hand is what its parts leave of their own outlines.
    for part in &parts {
        drawing = drawing.stroke(part.clone(), Stroke::new(edge, 1.8));
    }
    for part in parts {
        drawing = drawing.fill(part, skin, 1.0);
    }
    let angle = |drawing: Drawing, height: f64, angle: f64, colour: Colour, name: &str| {
        let place = camera.project(polar(0.56 * radius, 0.5 * angle, height));
        drawing
            .stroke(line(&camera, axis(height), polar(radius, 0.0, height)), thin().dashed(Dash::Dashed))
            .stroke(line(&camera, axis(height), polar(radius, angle, height)), Stroke::new(colour, 1.2))
            .arrow(arc(&camera, ANGLE_ARC * radius, (0.0, angle), height), Stroke::new(Colour::BLACK, 0.9))
            .text(place, Anchor::Centre, name)
    };
    drawing = angle(drawing, palm, data.platform_angle_rad, edge, r"$\beta$");
    drawing = drawing.stroke(line(&camera, axis(palm), axis(bottom)), chain);
    // The dough: its rim at several heights gives the side.
    let dough = Colour::rgb(222, 190, 130);
    let rim_edge = Stroke::new(dough.mixed(Colour::BLACK, 0.45), 0.9);
    drawing = drawing.stroke(outline(&camera, rim(radius, data.disk_angle_rad), bottom), rim_edge);
    for layer in 0..=8 {
        let height = bottom + (top - bottom) * f64::from(layer) / 8.0;
        drawing = drawing.fill(outline(&camera, rim(radius, data.disk_angle_rad), height), dough, 1.0);
    }
    let face = outline(&camera, rim(radius, data.disk_angle_rad), top);
    drawing = drawing.fill(face.clone(), dough.mixed(Colour::WHITE, 0.55), 1.0).stroke(face, rim_edge);
    drawing = angle(drawing, top, data.disk_angle_rad, dough.mixed(Colour::BLACK, 0.45), r"$\alpha$");
    drawing = drawing.stroke(line(&camera, axis(top), axis(high)), chain);
    drawing = heights(drawing, &camera, data);
    let right =
        |distance: f64, height: f64| camera.project(polar(distance * radius, AZIMUTH + FRAC_PI_2, height));
    let dark = |colour: Colour| colour.mixed(Colour::BLACK, 0.45);
    let beside = right(1.10, bottom + 0.5 * THICKNESS * radius);
    let under = right(0.95, palm - 0.45 * radius);
    let foot = drawing.local((area.left + 0.62 * area.width, area.bottom() - 4.0));
    drawing = drawing
        .text(beside, small(Anchor::LeftCentre, dark(dough)), "dough")
        .text(under, small(Anchor::LeftCentre, edge), "hand")
        .text(foot, small(Anchor::Left, Colour::DARK_GREY), "(sketch)");
    letter(drawing, area, "(b)")
}

/// A letter in the upper left corner of a drawing of which only the area is known.
fn letter(drawing: Drawing, area: Rect, text: &str) -> Drawing {
    let corner = drawing.local((area.left + 2.0, area.top + 6.0));
    drawing.text(corner, Anchor::LeftCentre, text)
}

fn path(data: &Fig01Data, area: Rect) -> Drawing {
    let camera = camera(data);
    let (radius, amplitude) = (data.contact_radius_m, data.amplitude_m);
    let cylinder = Cylinder { radius, bottom: -1.45 * amplitude, top: 1.25 * amplitude };
    let height_of = |height: f64| camera.project(DVec3::new(0.0, 0.0, height)).1;
    let mut drawing = Drawing::with_equal_scales(
        area,
        (-1.7 * radius, 1.35 * radius),
        (height_of(cylinder.bottom) - 0.5 * radius, height_of(cylinder.top) + 0.5 * radius),
    );
    let look = Look {
        side: Colour::PALE_GREY,
        face: Colour::WHITE,
        opacity: 0.55,
        edge: Stroke::new(Colour::GREY, 0.7),
        through: true,
    };
    drawing = cylinder.drawn(drawing, &camera, &look);
    let on = |angle: f64, height: f64| camera.project(polar(radius, angle, height));
    // Mean height and the line of β = 0.
    let around = cylinder.runs(&camera, (0..=360).map(|step| (AZIMUTH + f64::from(step).to_radians(), 0.0)));
    drawing = curve(drawing, around, thin());
    let upright = thin().dashed(Dash::DashDotted);
    drawing = drawing.stroke(Path::through([on(0.0, cylinder.bottom), on(0.0, cylinder.top)]), upright);
    // Amplitudes.
    let twist = data.twist_amplitude_rad;
    let low = -1.2 * amplitude;
    let mut swept = arc(&camera, radius, (0.0, twist), low);
    let limit = thin().dashed(Dash::Dashed);
    drawing = drawing
        .stroke(Path::through([on(twist, low), on(twist, 0.55 * amplitude)]), limit)
        .arrow(swept.clone(), Stroke::default());
    swept.reverse();
    let below = on(0.5 * twist, low);
    drawing = drawing.arrow(swept, Stroke::default()).text(
        (below.0, below.1 - 0.13 * radius),
        Anchor::Centre,
        r"$a_e\Phi$",
    );
    let side = |height: f64| camera.project(polar(1.22 * radius, AZIMUTH - FRAC_PI_2, height));
    let rim = |height: f64| camera.project(polar(radius, AZIMUTH - FRAC_PI_2, height));
    for height in [0.0, amplitude] {
        let (from, to) = (rim(height), side(height));
        drawing = drawing.stroke(Path::through([from, (to.0 - 0.05 * radius, to.1)]), thin());
    }
    let (foot, head) = (side(0.0), side(amplitude));
    drawing = drawing.double_arrow(foot, head, Stroke::default()).text(
        (foot.0 - 0.09 * radius, 0.5 * (foot.1 + head.1)),
        Anchor::RightCentre,
        "$A$",
    );
    let top = cylinder.top;
    let spoke = AZIMUTH + 0.9;
    let centre = camera.project(DVec3::new(0.0, 0.0, top));
    drawing = drawing.arrow([centre, on(spoke, top)], Stroke::new(Colour::BLACK, 0.8)).text(
        {
            let place = camera.project(polar(0.6 * radius, spoke + 0.5, top));
            (place.0, place.1)
        },
        Anchor::Centre,
        "$a_e$",
    );
    let stroke = Stroke::new(Colour::BLUE, 1.5);
    drawing = curve(drawing, cylinder.runs(&camera, data.path.points()), stroke);
    for share in [0.14, 0.64] {
        let seen = cylinder.runs(&camera, data.path.before(share, 3));
        for run in seen.into_iter().filter(|run| run.in_view) {
            drawing = drawing.arrow_with_head(run.points, stroke, 8.0);
        }
    }
    let point = on(data.platform_angle_rad, data.platform_height_m);
    let size = 0.045 * radius;
    let dot = Colour::BLUE.mixed(Colour::BLACK, 0.4);
    drawing = drawing.ellipse(point, (size, size), dot).text(
        (point.0 + 0.10 * radius, point.1 + 0.10 * radius),
        Anchor::LeftCentre,
        r"$(a_e\beta, s)$",
    );
    letter(drawing, area, "(c)")
}
