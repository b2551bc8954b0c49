//! `bouncing-disk design`: the hand motion that tosses best.

use bouncing_disk::System;
use bouncing_disk::toss::{
    InitialSpin, OverFriction, TossConstraints, TossDesign, TossObjective, best_toss, toss_trajectory,
};

use super::prelude::*;
use super::toss::{MOST_INSTANTS, SPINS, instants, picture, quantities, samples, write_table};

/// The quantities that a toss can maximise.
const OBJECTIVES: Words<TossObjective> = &[
    ("airborne-speed", "The airborne rotary speed (rad/s)", TossObjective::AirborneSpeed),
    ("efficiency", "The efficiency of Sec. III A", TossObjective::Efficiency),
    ("turns", "Turns until the dough is back at the height at which it left", TossObjective::TurnsPerToss),
];

/// How the objective is taken over a range of friction.
const OVER: Words<OverFriction> =
    &[("worst", "Its least value", OverFriction::Worst), ("mean", "Its mean", OverFriction::Mean)];

/// The hand motion that tosses best, under constraints
#[derive(Debug, Args)]
#[command(after_help = "\
Frequency, amplitude angle and phase lag of the hand are chosen, the stroke is given, and the dough is that of the system, \
whose platform is not used. Units are SI. In .csv and pictures there is the motion of the best toss at the middle of \
the range of friction. See docs/numerics/design.md and `TossConstraints` of the library.

Examples:
  bouncing-disk design
  bouncing-disk design --friction 0.5:0.7 --angular-frequency 10:16 --objective turns --highest-flight 0.5")]
pub(crate) struct DesignArgs {
    #[command(flatten)]
    system: SystemArgs,
    /// Stroke c (m): half the length of the path of the hand at the contact radius
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "METRES", default_value_t = TossConstraints::pizza_toss().stroke)]
    stroke: f64,
    /// Coefficient of friction; that of the dough unless given
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "LOW:HIGH", value_parser = interval)]
    friction: Option<[f64; 2]>,
    /// Angular frequency (rad/s); 15, that of Table I, unless given
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "LOW:HIGH", value_parser = interval)]
    angular_frequency: Option<[f64; 2]>,
    /// Phase lag of the twist (rad); half a circle unless given
    #[arg(help_heading = OWN, long, value_name = "LOW:HIGH", allow_hyphen_values = true, value_parser = interval)]
    phase_lag: Option<[f64; 2]>,
    /// The highest that the dough may fly above the place where it leaves the hand (m)
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "METRES")]
    highest_flight: Option<f64>,
    /// The quantity that the toss maximises
    #[arg(help_heading = OWN, long, value_name = "WHAT", default_value = "airborne-speed", value_parser = one_of(OBJECTIVES))]
    objective: TossObjective,
    /// How that is taken over the range of friction
    #[arg(help_heading = OWN, long, value_name = "HOW", default_value = "worst", value_parser = one_of(OVER))]
    over_friction: OverFriction,
    /// How the dough turns at the start
    #[arg(help_heading = OWN, long, value_name = "SPIN", default_value = "absolute-rest", value_parser = one_of(SPINS))]
    spin: InitialSpin,
    /// Instants of the motion in a file, at most a million; 40 in each period of the platform unless given,
    /// and 400 at least
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=MOST_INSTANTS))]
    samples: Option<u32>,
    #[command(flatten)]
    output: OutputArgs,
}

impl DesignArgs {
    fn constraints(&self, system: &System) -> TossConstraints {
        let paper = TossConstraints::pizza_toss();
        let dough = system.disk().parameters();
        TossConstraints {
            dough,
            initial: self.spin,
            stroke: self.stroke,
            friction: self.friction.unwrap_or([dough.friction; 2]),
            angular_frequency: self.angular_frequency.unwrap_or(paper.angular_frequency),
            phase_lag: self.phase_lag.unwrap_or(paper.phase_lag),
            highest_flight: self.highest_flight,
            objective: self.objective,
            over_friction: self.over_friction,
        }
    }
}

pub(crate) fn run(args: &DesignArgs, context: Context) -> Result<()> {
    let Some(system) = args.system.begin(&args.output, true, context)? else { return Ok(()) };
    let constraints = args.constraints(&system);
    let design = best_toss(&constraints, &context.watch("design"))?;
    let system = design.system()?;
    let trajectory = toss_trajectory(&system, constraints.initial)?;
    let periods = trajectory.end().since(&trajectory.start()).periods;
    let samples = samples(&system, trajectory.uniform(instants(args.samples, periods) as usize));
    let report = Report {
        provenance: provenance("bouncing-disk design", &json!({ "constraints": constraints }))?,
        text: list(&design, &system).to_text(),
        table: write_table(&samples),
        data: vec![("design", stored(&design)?), ("motion", json::list(|| samples.iter()))],
        figure: Some(Box::new(|| picture(&samples, None))),
    };
    report.deliver(&args.output, context)
}

fn list(design: &TossDesign, system: &System) -> Quantities {
    let mut list = Quantities::default();
    list.push("angular_frequency", design.hand.angular_frequency, "rad/s");
    list.push("amplitude_angle", design.hand.amplitude_angle, "rad");
    list.push("phase_lag", design.hand.phase_lag, "rad");
    list.push("amplitude", system.platform().amplitude(), "m");
    list.push("twist_amplitude", system.platform().twist_amplitude(), "rad");
    let (name, unit) = match design.constraints.objective {
        TossObjective::AirborneSpeed => ("objective_airborne_speed", "rad/s"),
        TossObjective::Efficiency => ("objective_efficiency", "1"),
        TossObjective::TurnsPerToss => ("objective_turns", "turns"),
        _ => ("objective", "1"),
    };
    list.push(name, design.value, unit);
    list.push("flight_height", design.flight_height, "m");
    list.push("turns", design.turns, "1");
    list.push("hidden_gain_at_most", design.certificate.hidden_gain, unit);
    list.append(quantities(system, &design.toss));
    list
}
