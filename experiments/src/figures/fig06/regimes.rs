//! The statements of the paper about chattering and the merging of the attractors in Fig. 6.

use super::data::{BestLag, Chatter, Fig06Data, Shadow, Slice};
use super::rotation::{extent, period_ones};
use crate::claims::judging::trend;
use crate::claims::{self as claim, Cases, Claim, catalogue};
use crate::figures::shared::numbers::occupied_arc;

pub(super) fn claims(data: &Fig06Data) -> Vec<Claim> {
    let mut claims = chattering(data);
    claims.extend([rest(data), complexity(data)]);
    claims.extend(decay(data));
    claims.extend(merged(data));
    claims.extend(speeds(data));
    claims
}

/// Whether two Γ of the same list are the same.
fn same(one: f64, other: f64) -> bool {
    one.to_bits() == other.to_bits()
}

/// The slices of the followed attractor beyond the last doubling that are not periodic.
fn chaotic(data: &Fig06Data) -> Vec<&Slice> {
    let accumulation = data.doublings.last().copied().unwrap_or(f64::NAN);
    let beyond = data.followed.iter().filter(|slice| slice.axial_forcing > accumulation);
    beyond.filter(|slice| slice.period.is_none()).collect()
}

fn arc(slice: &Slice) -> f64 {
    occupied_arc(slice.impact_phase_cycles.iter().copied()).unwrap_or_default()
}

/// The changes where the attractors merge.
fn merged(data: &Fig06Data) -> Vec<Claim> {
    let crisis = data.merging.axial_forcing();
    let beyond = |forcing: f64| forcing > crisis;
    let after = || data.chattering.iter().filter(|slice| beyond(slice.axial_forcing));
    let low = data.basin_axial_forcings[2];
    let low_cycles = || data.chattering.iter().filter(|slice| slice.axial_forcing <= low);
    let longest_low = low_cycles().filter_map(|slice| slice.platform_periods).max();
    let periods: Vec<u64> = after().filter_map(|slice| slice.platform_periods).collect();
    let shortest = periods.iter().min().copied().unwrap_or_default();
    let comes_to_rest = |followed: &Slice| {
        data.chattering.iter().any(|slice| same(slice.axial_forcing, followed.axial_forcing))
    };
    let alone: Vec<&Slice> = data.followed.iter().filter(|slice| !comes_to_rest(slice)).collect();
    let periodic = alone.iter().filter(|slice| slice.period.is_some()).count();
    let (first_alone, last_alone) = extent(alone.iter().map(|slice| slice.axial_forcing));
    vec![
        Claim::printed_statement(
            "section4.coexistence",
            claim::all(&data.followed, comes_to_rest),
            format!(
                "at {} of {} values of Γ with a followed attractor a disk from rest does not come to rest again and there is no chattering orbit: Γ = \
                 {first_alone:.4} to {last_alone:.4}, at {periodic} of them beside a periodic orbit",
                alone.len(),
                data.followed.len(),
            ),
        )
        .cause("a disk from rest that never rests again"),
        widening(data),
        Claim::printed_statement(
            "section4.longer_cycles",
            claim::all(&periods, |own| longest_low.is_some_and(|low| *own > low)),
            format!(
                "cycles of the chattering orbit up to Γ = {low} take at most {} periods of the platform, those beyond the merging at least {shortest}",
                longest_low.unwrap_or_default(),
            ),
        ),
        shadow(data),
    ]
}

/// The widening at the merging, just after against just before.
fn widening(data: &Fig06Data) -> Claim {
    let explored = &data.explored;
    let (before, after) = (&explored.before, &explored.after);
    // The widening of the attractor on the whole way from the doublings to the crisis.
    let chaotic = chaotic(data);
    let (narrowest, widest) = extent(chaotic.iter().map(|slice| arc(slice)));
    let (slowest, fastest) =
        extent(chaotic.iter().map(|slice| slice.normalised_impact_speed.iter().copied().fold(0.0, f64::max)));
    let sudden = after.arc_cycles - before.arc_cycles > widest - narrowest
        && after.largest_speed - before.largest_speed > fastest - slowest;
    Claim::printed_statement(
        "section4.sudden_widening",
        claim::all(Some(sudden).filter(|_| !chaotic.is_empty()), |sudden| sudden),
        format!(
            "the orbit on the attractor occupies {:.3} of a period and speeds up to {:.3} just before the crisis, {:.3} and {:.3} just after it; from the doublings to the \
             crisis its arc grew from {narrowest:.3} to {widest:.3} and its largest speed from {slowest:.3} to {fastest:.3} only",
            before.arc_cycles, before.largest_speed, after.arc_cycles, after.largest_speed,
        ),
    )
}

/// The orbits beyond the merging follow the chaotic saddle that the attractor has become, each at its own Γ.
fn shadow(data: &Fig06Data) -> Claim {
    let shadows = &data.explored.shadows;
    let (least, most) = extent(shadows.iter().map(|of| of.share_near));
    let count = shadows.len().max(1) as f64;
    let mean = shadows.iter().map(|of| of.share_near).sum::<f64>() / count;
    let plane = shadows.iter().map(|of| of.share_of_plane).sum::<f64>() / count;
    let follows = |of: &Shadow| of.share_near > of.share_of_plane;
    Claim::printed_statement(
        "section4.orbits_shadow_attractor",
        claim::all(shadows, follows),
        format!(
            "of the impacts of a disk from rest {least:.3} to {most:.3} lie within a hundredth or two of the chaotic saddle at the same Γ, on the mean {mean:.3} over {} values of Γ, of \
             the plane {plane:.3}. So on the mean they follow it, but at {} of the values, where a cycle has few impacts, the share is not above that of the plane",
            shadows.len(),
            shadows.iter().filter(|of| !follows(of)).count(),
        ),
    )
    .cause("short cycles beyond the merging")
}

/// The effect of chaos, and of the regime beyond the merging, on the speed.
fn speeds(data: &Fig06Data) -> Vec<Claim> {
    let last = data.doublings.last().copied().unwrap_or(f64::NAN);
    let best = |chosen: &dyn Fn(&BestLag) -> bool| -> Vec<BestLag> {
        data.best_lags.iter().copied().filter(|of| chosen(of)).collect()
    };
    let ones = best(&|of| of.followed && of.period == Some(1));
    let chaotic = best(&|of| of.followed && of.period.is_none() && of.axial_forcing > last);
    let merged = best(&|of| !of.followed);
    let extent_of = |bests: &[BestLag]| extent(bests.iter().map(|of| of.speed));
    let (slowest_one, _) = extent_of(&ones);
    let words = |bests: &[BestLag]| {
        let (low, high) = extent_of(bests);
        format!("{low:.3} to {high:.3} ωΦ ({} cases: Γ, and Γ_T of (c) and (d))", bests.len())
    };
    let slower = |bests: &[BestLag]| {
        let judged = claim::all(bests, |of| of.speed < slowest_one);
        judged.filter(|_| !ones.is_empty())
    };
    let decides = &data.one_impact_decides;
    let at_maximum: Vec<&BestLag> =
        decides.found.iter().filter(|of| of.speed >= super::explored::AT_MAXIMUM).collect();
    let chaos = Cases::of(data.lyapunov_exponents.iter().map(|(_, growth)| *growth > 0.0));
    vec![
        Claim::printed_statement(
            "section4.route_to_chaos",
            chaos,
            format!(
                "beyond the doublings the Lyapunov exponent is positive at {} values of Γ",
                chaos.words()
            ),
        ),
        Claim::printed_statement(
            "section4.chaos_reduces_speed",
            slower(&chaotic),
            format!(
                "at the best phase lag the mean speed is {} in the chaotic range, and {} in period 1, where only the steps of {}° keep it below ωΦ",
                words(&chaotic),
                words(&ones),
                super::explored::LAG_STEP_DEG,
            ),
        ),
        Claim::printed_statement(
            "section4.merged_below_maximum",
            slower(&merged).map(|slower| slower && at_maximum.is_empty()),
            format!(
                "at the best phase lag the mean speed of a disk from rest is {} beyond the merging; where one impact of its cycle has more than half of the impulse, a motor \
                 comes near to ωΦ, and reaches it to rounding at {} of {} values of Γ",
                words(&merged),
                at_maximum.len(),
                decides.tried,
            ),
        ),
    ]
}

/// A disk at rest and the period-1 orbit.
fn rest(data: &Fig06Data) -> Claim {
    let ones: Vec<&Slice> = period_ones(data).into_iter().map(|(slice, _)| slice).collect();
    let chatters =
        |one: &&&Slice| data.chattering.iter().any(|slice| same(slice.axial_forcing, one.axial_forcing));
    Claim::printed_statement(
        "section4.rest_never_reaches_period_one",
        claim::all(&ones, |one| chatters(&one)),
        format!(
            "at {} of {} values of Γ with an attracting period-1 orbit a disk that leaves the platform from rest comes to rest on it again, and then for ever \
             in the same way",
            ones.iter().filter(chatters).count(),
            ones.len()
        ),
    )
}

/// Two times of rest (periods) that differ by less than this are one: the paper's cut leaves out what a disk
/// of the cut's speed does.
const SAME_REST: f64 = 1.0e-4;

/// How the chattering sequences of a disk from rest end.
fn decay(data: &Fig06Data) -> [Claim; 2] {
    let chatters = &data.chatters;
    let sum = |pairs: fn(&Chatter) -> Cases| chatters.iter().map(pairs).sum::<Cases>();
    let (slower, shorter) = (sum(|of| of.slower), sum(|of| of.shorter));
    let off = |of: &Chatter| (of.cut_at_cycles - of.rests_at_cycles).abs();
    let (_, worst) = extent(chatters.iter().map(off));
    [
        Claim::printed_statement(
            "section4.chattering_decays",
            slower
                .tried
                .min(shorter.tried)
                .gt(&0)
                .then(|| [slower, shorter].iter().all(|pairs| 2 * pairs.holding > pairs.tried)),
            format!(
                "of all pairs of impacts in the last flights of less than half a period, at {} values of Γ, the later one is slower in {} and its flight shorter in {}",
                chatters.len(),
                slower.words(),
                shorter.words(),
            ),
        ),
        Claim::printed_statement(
            "section4.rest_in_finite_time",
            claim::any(chatters, |of| off(of) < SAME_REST),
            format!(
                "the infinitely many flights of a chattering sequence have a finite sum, which the program computes; the paper's cut differs from it by {worst:.0e} of a period at most, at {} values of Γ",
                chatters.len(),
            ),
        ),
    ]
}

/// Whether the chattering orbits become more complex with Γ: of two orbits the one at the higher Γ mostly has
/// the longer cycle.
fn complexity(data: &Fig06Data) -> Claim {
    // By rising Γ.
    let cycles: Vec<(f64, u64)> = data
        .chattering
        .iter()
        .filter_map(|slice| Some((slice.axial_forcing, slice.platform_periods?)))
        .collect();
    let pairs = trend(cycles.iter().map(|(forcing, periods)| (*forcing, *periods as f64)), 1.0);
    Claim::printed_statement(
        "section4.chattering_grows_complex",
        pairs,
        format!(
            "of all pairs of Γ with cycles of different length the higher Γ has the longer one in {}",
            pairs.words()
        ),
    )
}

fn chattering(data: &Fig06Data) -> Vec<Claim> {
    let merging = &data.merging;
    let single = &data.single_tosses;
    let printed_end =
        catalogue::number("section4.single_tosses_end", 0).map_or(f64::NAN, |printed| printed.value);
    let periods = single.periods_beyond.map_or("no".to_owned(), |low| format!("{low} or more"));
    vec![
        Claim::printed("section4.merging", merging.axial_forcing()).note(format!(
            "bisection on the survival of {} orbits of the followed attractor for {} impacts; uncertainty {:.0e}. Bisection can only err \
             upwards, by the time an orbit takes to find a new gap",
            merging.starts,
            merging.impacts,
            merging.uncertainty(),
        )),
        Claim::printed_statement(
            "section4.single_tosses_end",
            claim::all([(single.first_other, printed_end)], |(other, end)| other >= end),
            format!(
                "the disk comes to rest once in every period up to Γ = {:.6} only; from there to {printed_end} it does so \
                 at {:.0} % of the Γ, and a cycle takes {periods} periods where it comes to rest at all",
                single.last,
                100.0 * single.share_beyond,
            ),
        )
        .cause("single tosses end at Γ = 0.5085"),
    ]
}
