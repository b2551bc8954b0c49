//! Fig. 1: the displacement variables of the bouncing-disk system.

mod scene;

use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::toss::{InitialSpin, toss_trajectory};
use bouncing_disk::{Event, Platform};
use bouncing_disk_plot::{Anchor, Camera, Colour, DOUBLE_COLUMN, Dash, Drawing, Figure, Path, Rect, Stroke};
use glam::DVec3;

use self::scene::{AZIMUTH, DISTANCE, ELEVATION, LEFT, Scene, letter, thin};
use super::shared::cylinder::{Cylinder, HandPath, arc, curve, polar};
use super::shared::toss::TossCase;
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper};

/// Phase lag of the motion shown. Table I has 0, for which the path of a point is a mere arc.
const PHASE_LAG: f64 = -FRAC_PI_4;

/// The instant shown, as a share of the flight.
const SHARE_OF_FLIGHT: f64 = 0.18;

/// Fig. 1.
pub(crate) fn fig01(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let table = paper::table_one()?;
    let case = TossCase::from(&table).at_lag(PHASE_LAG);
    let system = case.system()?;
    let trajectory = toss_trajectory(&system, InitialSpin::AbsoluteRest)?;
    let flight = trajectory.records().iter().find(|record| matches!(record.event, Event::Impact { .. }));
    let Some(flight) = flight else {
        let peak_acceleration = system.peak_acceleration();
        return Err(ExperimentError::model(bouncing_disk::Error::NeverLeaves { peak_acceleration }));
    };
    let instant = flight.evaluate(system.dimensionless(), SHARE_OF_FLIGHT);
    let phase = instant.time.phase;
    let disk = system.scales().state(&instant.disk);
    let hand = system.platform();
    let path = HandPath::new(hand, fig.quality.choose(120, 720))?;
    let scene = Scene {
        camera: Camera::around(DVec3::ZERO, AZIMUTH, ELEVATION, DISTANCE * case.stroke_m),
        // A uniform disk with Table I's radius of gyration.
        radius: SQRT_2 * case.gyration_radius_m,
        low: -1.3 * hand.amplitude(),
        platform: (hand.height(phase), hand.angle(phase)),
        disk: (disk.height, disk.angle),
    };
    fig.record("table_i", &table)?;
    fig.record("phase_lag_rad", &PHASE_LAG)?;
    fig.record("contact_radius_m", &case.contact_radius_m)?;
    fig.record("disk_radius_m", &scene.radius)?;
    fig.record("amplitude_m", &hand.amplitude())?;
    fig.record("twist_amplitude_rad", &hand.twist_amplitude())?;
    fig.record("phase_rad", &phase.angle())?;
    fig.record("platform_height_m", &scene.platform.0)?;
    fig.record("platform_angle_rad", &scene.platform.1)?;
    fig.record("disk_height_m", &disk.height)?;
    fig.record("disk_angle_rad", &disk.angle)?;
    fig.record("path", &path)?;

    fig.caption(format!(
        "Displacement variables of the bouncing disk and of pizza tossing. (a) Disk (x, α) above the platform (s, β), {:.0} % into \
         the flight of a computed toss (τ = {:.3} rad; x, s = {:.3}, {:.3} m; α, β = {:.2}, {:.2} rad). (b) Dough and hand, a \
         sketch. (c) Path of a point of the platform at the radius a_e, Eq. (1); dot: the instant of (a); dotted: behind the \
         cylinder. Table I except for θ = −π/4, because the path for θ = 0 encloses no area.",
        100.0 * SHARE_OF_FLIGHT,
        phase.angle(),
        disk.height,
        scene.platform.0,
        disk.angle,
        scene.platform.1,
    ));
    fig.parameter("phase lag θ", format!("{:.2}π (Table I: {})", PHASE_LAG / PI, table.phase_lag_rad));
    fig.parameter("amplitude angle φ_L", format!("{} rad", case.amplitude_angle_rad));
    fig.parameter("stroke c", format!("{} m", case.stroke_m));
    fig.parameter("angular frequency ω", format!("{} rad/s", case.angular_frequency_rad_per_s));
    fig.parameter("contact radius a_e", format!("{} m", case.contact_radius_m));
    fig.parameter("radius of gyration a_g", format!("{} m", case.gyration_radius_m));
    fig.parameter("friction μ", case.friction);
    fig.parameter("start", "lowest point of the hand, dough at rest");

    let high = HEIGHT - 8.0;
    fig.draw(
        Figure::new(WIDTH, HEIGHT)
            .drawing(scene.system(Rect::new(4.0, 4.0, 172.0, high)))
            .drawing(scene.sketch(Rect::new(191.0, 4.0, 184.0, high)))
            .drawing(trace(
                &scene,
                hand,
                case.contact_radius_m,
                &path,
                Rect::new(380.0, 4.0, WIDTH - 384.0, high),
            )),
    );
    Ok(())
}

const WIDTH: f64 = DOUBLE_COLUMN;
const HEIGHT: f64 = 236.0;
/// The path of a point of the platform.
fn trace(scene: &Scene, hand: &Platform, radius: f64, path: &HandPath, area: Rect) -> Drawing {
    let camera = &scene.camera;
    let (amplitude, twist) = (hand.amplitude(), hand.twist_amplitude());
    let cylinder = Cylinder { radius, bottom: -1.45 * amplitude, top: 1.25 * amplitude };
    let centre = |height: f64| camera.project(DVec3::new(0.0, 0.0, height));
    let on = |angle: f64, height: f64| camera.project(polar(radius, angle, height));
    let mut drawing = Drawing::with_equal_scales(
        area,
        (-1.7 * radius, 1.35 * radius),
        (centre(cylinder.bottom).1 - 0.5 * radius, centre(cylinder.top).1 + 0.5 * radius),
    );
    drawing = cylinder.of_glass(drawing, camera, 0.55, thin());
    // Amplitudes.
    let low = -1.2 * amplitude;
    let swept = arc(camera, radius, (0.0, twist), low);
    let back = swept.iter().rev().copied().collect::<Vec<_>>();
    let limit = Path::through([on(twist, low), on(twist, 0.55 * amplitude)]);
    let below = on(0.5 * twist, low);
    drawing = drawing
        .stroke(limit, thin().dashed(Dash::Dashed))
        .arrow(swept, Stroke::default())
        .arrow(back, Stroke::default())
        .text((below.0, below.1 - 0.13 * radius), Anchor::Centre, r"$a_e\Phi$");
    let side = |height: f64| camera.project(polar(1.22 * radius, LEFT, height));
    for height in [0.0, amplitude] {
        let to = side(height);
        drawing = drawing.stroke(Path::through([on(LEFT, height), (to.0 - 0.05 * radius, to.1)]), thin());
    }
    let (foot, head) = (side(0.0), side(amplitude));
    let beside = (foot.0 - 0.09 * radius, 0.5 * (foot.1 + head.1));
    let spoke = AZIMUTH + 0.9;
    let beside_spoke = camera.project(polar(0.6 * radius, spoke + 0.5, cylinder.top));
    drawing = drawing
        .double_arrow(foot, head, Stroke::default())
        .text(beside, Anchor::RightCentre, "$A$")
        .arrow([centre(cylinder.top), on(spoke, cylinder.top)], Stroke::new(Colour::BLACK, 0.8))
        .text(beside_spoke, Anchor::Centre, "$a_e$");
    let stroke = Stroke::new(Colour::BLUE, 1.5);
    drawing = curve(drawing, cylinder.runs(camera, path.points()), stroke);
    for share in [0.14, 0.64] {
        let runs = cylinder.runs(camera, path.before(share, 3));
        for run in runs.into_iter().filter(|run| run.in_view) {
            drawing = drawing.arrow_with_head(run.points, stroke, 8.0);
        }
    }
    let (height, angle) = scene.platform;
    let point = on(angle, height);
    let (size, off) = (0.045 * radius, 0.10 * radius);
    drawing = drawing.ellipse(point, (size, size), Colour::BLUE.mixed(Colour::BLACK, 0.4)).text(
        (point.0 + off, point.1 + off),
        Anchor::LeftCentre,
        r"$(a_e\beta, s)$",
    );
    letter(drawing, area, "(c)")
}
