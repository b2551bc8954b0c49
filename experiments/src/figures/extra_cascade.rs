//! Beyond the paper: the doubling cascade to many digits, and Feigenbaum's constants from it.

use bouncing_disk::core::Unobserved;
use bouncing_disk::core::numerics::double_double::DoubleDouble;
use bouncing_disk::core::orbits::{FeigenbaumEstimate, doubling_cascade, feigenbaum_estimates};
use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Legend, Line, Marker, Panel, Rect, Scatter, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::shared::map_in_parallel;
use crate::progress::Progress;

/// Feigenbaum's constants δ and α (K. Briggs, Math. Comp. 57, 435 (1991)).
const PUBLISHED: [f64; 2] = [4.669_201_609_102_99, 2.502_907_875_095_892_7];

/// ε besides that of Fig. 6, and the colours of all three.
const OTHER_RESTITUTIONS: [&str; 2] = ["0.1", "0.8"];
const COLOURS: [Colour; 3] = [Colour::BLACK, Colour::BLUE, Colour::VERMILION];

/// The least distances of forcings and of constants that the picture shows; smaller ones are drawn here.
const LEAST: f64 = 1e-17;
const LEAST_DEVIATION: f64 = 1e-12;

/// The doubling cascade.
#[derive(Debug)]
pub struct ExtraCascade;

/// The data of the doubling cascade; the first one is that of Fig. 6.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraCascadeData(Vec<Cascade>);

/// The cascade of one restitution.
#[derive(Debug, Serialize, Deserialize)]
struct Cascade {
    /// ε, the decimal number itself.
    restitution: String,
    doublings: Vec<Doubling>,
    /// From the seventh doubling on, δ and α.
    estimates: Vec<(usize, [Estimate; 2])>,
}

/// One doubling in double-doubles, and in doubles.
#[derive(Debug, Serialize, Deserialize)]
struct Doubling {
    /// Γ_n with 25 decimals.
    axial_forcing: String,
    /// Γ_∞ − Γ_n, the last one by δ.
    to_limit: f64,
    /// The error that the cascade in doubles states, and the true one.
    stated_error_in_doubles: f64,
    error_in_doubles: f64,
}

/// A constant: the plain ratio, extrapolated with its error, and extrapolated in doubles.
#[derive(Debug, Serialize, Deserialize)]
struct Estimate {
    ratio: f64,
    value: f64,
    error: f64,
    value_in_doubles: f64,
}

impl Experiment for ExtraCascade {
    type Data = ExtraCascadeData;
    const ID: &'static str = "extra-cascade";
    const TITLE: &'static str = "The doubling cascade";

    fn caption(_: &ExtraCascadeData) -> String {
        "The cascade that starts from the period-1 orbit, in numbers of two doubles (31 digits). (a) Distances Γ_∞ − Γ_n of the \
         doublings from their limit, and the true errors of Γ_n in doubles (crosses) with their stated bound (dotted). (b) \
         Distance of the ratios δ_n = (Γ_(n−1) − Γ_(n−2))/(Γ_n − Γ_(n−1)) from Feigenbaum's δ (open), of the extrapolated values \
         (filled), and of those from doubles (crosses); bars reach up to the stated error. (c) The same for α, from the widths \
         of the orbits."
            .to_owned()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraCascadeData, ExperimentError> {
        let count = quality.choose(11, 13);
        let of_fig6 = paper::section_four()?.restitution.to_string();
        let restitutions: Vec<&str> = std::iter::once(of_fig6.as_str()).chain(OTHER_RESTITUTIONS).collect();
        progress.start(restitutions.len() as u64, "cascades");
        let cascades = map_in_parallel(&restitutions, |restitution| {
            let cascade = cascade(restitution, count);
            progress.advance(1);
            Ok(cascade?)
        });
        Ok(ExtraCascadeData(cascades?))
    }

    fn draw(data: &ExtraCascadeData) -> Result<Figure, ExperimentError> {
        let areas = [40.0, 212.0, 384.0].map(|left| Rect::new(left, 12.0, 116.0, 170.0));
        Ok(Figure::new(DOUBLE_COLUMN, 220.0).panels([
            distances(&data.0, areas[0]),
            constants(&data.0, areas[1], 0).letter_in("b", Corner::TopRight),
            constants(&data.0, areas[2], 1).letter_in("c", Corner::TopRight),
        ]))
    }
}

fn cascade(restitution: &str, count: usize) -> Result<Cascade, bouncing_disk::core::Error> {
    let exact: DoubleDouble = restitution.parse()?;
    let found = doubling_cascade(exact, count, &Unobserved)?.complete()?;
    let in_doubles = doubling_cascade(exact.high(), count, &Unobserved)?.complete()?;
    let separation = |index: usize| (found[index].axial_forcing - found[index - 1].axial_forcing).high();
    let mut to_limit = separation(count - 1) / (PUBLISHED[0] - 1.0);
    let mut doublings = Vec::new();
    for index in (0..count).rev() {
        let error = DoubleDouble::from(in_doubles[index].axial_forcing) - found[index].axial_forcing;
        doublings.push(Doubling {
            axial_forcing: format!("{:.25}", found[index].axial_forcing),
            to_limit,
            stated_error_in_doubles: in_doubles[index].forcing_error,
            error_in_doubles: error.high().abs(),
        });
        to_limit += if index > 0 { separation(index) } else { 0.0 };
    }
    doublings.reverse();
    let both = |(extended, own): (FeigenbaumEstimate, FeigenbaumEstimate)| {
        let delta = Estimate {
            ratio: extended.forcing_ratio,
            value: extended.delta,
            error: extended.delta_error,
            value_in_doubles: own.delta,
        };
        let alpha = Estimate {
            ratio: extended.width_ratio,
            value: extended.alpha,
            error: extended.alpha_error,
            value_in_doubles: own.alpha,
        };
        (extended.number, [delta, alpha])
    };
    let estimates = feigenbaum_estimates(&found).into_iter().zip(feigenbaum_estimates(&in_doubles));
    Ok(Cascade { restitution: restitution.to_owned(), doublings, estimates: estimates.map(both).collect() })
}

fn numbers(from: f64) -> Axis {
    Axis::linear(from, 13.7).label("$n$").ticks(Ticks::every(2.0).minor(2))
}

fn distances(cascades: &[Cascade], area: Rect) -> Panel {
    let mut panel = Panel::new(area)
        .x(numbers(0.3))
        .y(Axis::log(LEAST, 1.0).label(r"$\Gamma_\infty - \Gamma_n$"))
        .letter_in("a", Corner::TopRight)
        .legend(Legend::at(Corner::TopRight).without_frame().inset(18.0));
    for (cascade, colour) in cascades.iter().zip(COLOURS) {
        let name = format!(r"$\epsilon = {}$", cascade.restitution);
        let of = |value: fn(&Doubling) -> f64| {
            (1..)
                .map(f64::from)
                .zip(cascade.doublings.iter().map(|own| value(own).max(LEAST)))
                .collect::<Vec<_>>()
        };
        let distances = of(|own| own.to_limit);
        let stated = Line::new(of(|own| own.stated_error_in_doubles)).width(0.7).dash(Dash::Dotted);
        let errors = Scatter::new(of(|own| own.error_in_doubles)).marker(Marker::Cross).size(3.0).width(0.6);
        panel = panel
            .layer(Line::new(distances.clone()).colour(colour).width(0.5))
            .layer(Scatter::new(distances).size(3.0).colour(colour).name(name.as_str()))
            .layer(stated.colour(colour))
            .layer(errors.colour(colour));
    }
    panel
}

/// The distances of one constant from what is published.
fn constants(cascades: &[Cascade], area: Rect, which: usize) -> Panel {
    let off = |value: f64| (value - PUBLISHED[which]).abs().max(LEAST_DEVIATION);
    let label = [r"distance from $\delta$", r"distance from $\alpha$"][which];
    let mut panel = Panel::new(area).x(numbers(6.3)).y(Axis::log(LEAST_DEVIATION, 1.0).label(label));
    for (index, (cascade, colour)) in cascades.iter().zip(COLOURS).enumerate() {
        // Beside each other.
        let of = |value: fn(&Estimate) -> f64| {
            let place = |number: usize| number as f64 + 0.18 * (index as f64 - 1.0);
            let points = cascade.estimates.iter().map(move |(n, own)| (place(*n), value(&own[which])));
            points.collect::<Vec<_>>()
        };
        let deviations = |value| of(value).into_iter().map(|(x, value)| (x, off(value))).collect::<Vec<_>>();
        for ((x, value), (_, error)) in deviations(|own| own.value).into_iter().zip(of(|own| own.error)) {
            panel = panel.layer(Line::new([(x, value), (x, error)]).colour(colour).width(0.5));
        }
        let open = Scatter::new(deviations(|own| own.ratio)).marker(Marker::Circle).size(2.8).width(0.6);
        let crosses =
            Scatter::new(deviations(|own| own.value_in_doubles)).marker(Marker::Cross).size(3.0).width(0.6);
        panel = panel
            .layer(open.colour(colour))
            .layer(Scatter::new(deviations(|own| own.value)).size(2.8).colour(colour))
            .layer(crosses.colour(colour));
    }
    panel
}
