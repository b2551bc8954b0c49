//! What the paper says about chattering and the merging of the attractors in Fig. 6.

use super::data::{Fig06Data, Slice};
use super::rotation::{extent, period_ones, width};
use super::statements::ID;
use crate::claim::Claim;
use crate::ledger;

pub(super) fn claims(data: &Fig06Data) -> Vec<Claim> {
    let mut claims = chattering(data);
    claims.extend(merged(data));
    claims
}

/// What changes where the attractors merge.
fn merged(data: &Fig06Data) -> Vec<Claim> {
    let crisis = data.merging.axial_forcing();
    let accumulation = data.doublings.last().copied().unwrap_or(f64::NAN);
    let chaotic: Vec<&Slice> = data
        .followed
        .iter()
        .filter(|slice| slice.axial_forcing > accumulation && slice.period.is_none())
        .collect();
    let (_, fastest) =
        extent(chaotic.iter().flat_map(|slice| [slice.linear_mean.abs(), slice.semielliptical_mean.abs()]));
    let (_, of_period_one) =
        extent(period_ones(data).iter().map(|(slice, _)| slice.linear_mean.max(slice.semielliptical_mean)));
    let largest_speed = |slices: &mut dyn Iterator<Item = &Slice>| {
        extent(slices.flat_map(|slice| slice.normalised_impact_speed.iter().copied())).1
    };
    let phases = |slices: &mut dyn Iterator<Item = &Slice>| {
        let widths: Vec<f64> = slices.map(|slice| width(&slice.impact_phase_cycles)).collect();
        widths.iter().sum::<f64>() / widths.len() as f64
    };
    let before = || chaotic.iter().copied();
    let after = || data.chattering.iter().filter(|slice| slice.axial_forcing > crisis);
    let (phases_before, phases_after) = (phases(&mut before()), phases(&mut after()));
    let (speed_before, speed_after) = (largest_speed(&mut before()), largest_speed(&mut after()));
    let low = data.basin_axial_forcings[2];
    let low_cycles = data.chattering.iter().filter(|slice| slice.axial_forcing <= low);
    let longest_low = low_cycles.filter_map(|slice| slice.period).max().unwrap_or_default();
    let mut cycles: Vec<usize> = after().filter_map(|slice| slice.period).collect();
    cycles.sort_unstable();
    let median = cycles.get(cycles.len() / 2).copied().unwrap_or_default();
    let coexisting = data
        .followed
        .iter()
        .filter(|followed| {
            // Both come from the same list of forcings.
            let same = |forcing: f64| forcing.to_bits() == followed.axial_forcing.to_bits();
            data.chattering.iter().any(|slice| same(slice.axial_forcing))
        })
        .count();
    vec![
        Claim::printed_statement(
            "section4.coexistence",
            coexisting > 0,
            format!(
                "at {coexisting} of {} values of Γ with a followed attractor a disk from rest chatters",
                data.followed.len()
            ),
        ),
        Claim::printed_statement(
            "section4.chaos_reduces_speed",
            fastest < of_period_one,
            format!(
                "mean speeds in the chaotic range are at most {fastest:.3} ωΦ, in period 1 up to {of_period_one:.3} ωΦ"
            ),
        ),
        Claim::printed_statement(
            "section4.sudden_widening",
            phases_after > phases_before && speed_after > speed_before,
            format!(
                "impacts extend over {phases_before:.3} of a period on the mean in the chaotic range before the merging and \
                 over {phases_after:.3} after it; |w_A Γ/(ωA)| up to {speed_before:.3} before and {speed_after:.3} after"
            ),
        ),
        Claim::printed_statement(
            "section4.longer_cycles",
            median > longest_low,
            format!(
                "cycles of the chattering orbit up to Γ = {low} have at most {longest_low} impacts; beyond the merging the \
                 median is {median} ({} cycles)",
                cycles.len()
            ),
        ),
    ]
}

fn chattering(data: &Fig06Data) -> Vec<Claim> {
    let merging = &data.merging;
    let single = &data.single_tosses;
    let policies = &data.policies;
    let printed_end =
        ledger::number("section4.single_tosses_end", 0).map_or(f64::NAN, |printed| printed.value);
    let beyond: Vec<f64> =
        data.not_chattering.iter().copied().filter(|forcing| *forcing > merging.axial_forcing()).collect();
    let cycles = || data.chattering.iter().filter_map(|slice| slice.period);
    let (shortest, longest) = (cycles().min().unwrap_or_default(), cycles().max().unwrap_or_default());
    let periods = single.periods_beyond.map_or("no".to_owned(), |(low, high)| format!("{low} to {high}"));
    vec![
        Claim::printed("section4.merging", merging.axial_forcing()).note(format!(
            "bisection on the survival of {} orbits of the followed attractor for {} impacts: {:.7} survived, {:.7} lost; \
             with a tenth of the impacts the crisis comes out at {:.7}; uncertainty {:.0e}. Bisection can only err \
             upwards, by the time an orbit takes to find a new gap",
            merging.starts,
            merging.impacts,
            merging.survived,
            merging.lost,
            0.5 * (merging.survived_in_a_tenth + merging.lost_in_a_tenth),
            merging.uncertainty(),
        )),
        Claim::printed_statement(
            "section4.single_tosses_end",
            single.first_other >= printed_end,
            format!(
                "the disk comes to rest once in every period up to Γ = {:.6} only; from there to {printed_end} it does so \
                 at {:.0} % of the Γ, and a cycle takes {periods} periods where it comes to rest at all",
                single.last,
                100.0 * single.share_beyond,
            ),
        ),
        Claim::printed_statement(
            "section4.chattering_is_periodic",
            data.chattering.iter().all(|slice| slice.period.is_some()),
            format!(
                "at {} values of Γ the disk comes to rest again, after {shortest} to {longest} impacts. After every rest it \
                 leaves in the same vertical state, so the vertical motion repeats; a long cycle depends on its rounding. At \
                 {} further values a disk from rest does not come to rest again within 20000 impacts: it ends on an attractor \
                 that bounces",
                data.chattering.len(),
                data.not_chattering.len(),
            ),
        ),
        Claim::statement(
            ID,
            "Sec. IV B",
            "beyond the merging a disk from rest chatters at every Γ of the diagram",
            beyond.is_empty(),
            match (beyond.first(), beyond.last()) {
                (Some(first), Some(last)) => format!(
                    "at {} values of Γ from {first:.4} to {last:.4} it ends on another attractor; the basin of the chattering \
                     orbit does not fill the phase space there",
                    beyond.len(),
                ),
                _ => "holds".to_owned(),
            },
        ),
        Claim::statement(
            ID,
            "Sec. IV A",
            "cutting the chattering short does not change the chattering orbits",
            policies.different_cycles == 0,
            format!(
                "at {} of {} values of Γ the cycle has another length when the infinite sequence is summed{}; where the \
                 rotation repeats from cycle to cycle under both the mean speeds differ by at most {:.1e} ωΦ in (c) ({} values) and \
                 {:.1e} ωΦ in (d) ({} values). A statement of this work, not of the paper",
                policies.different_cycles,
                policies.compared,
                policies.first_different.map_or(String::new(), |forcing| format!(" (first at Γ = {forcing:.4})")),
                policies.largest_difference_linear,
                policies.settled_linear,
                policies.largest_difference_semielliptical,
                policies.settled_semielliptical,
            ),
        ),
    ]
}
