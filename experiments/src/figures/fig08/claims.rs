//! A check of the preloads of Fig. 8: the paper states no number about it.

use super::data::Fig08Data;
use crate::claim::Claim;

const ID: &str = "fig08";

pub(super) fn claims(data: &Fig08Data) -> Vec<Claim> {
    let milli = |newton: f64| 1e3 * newton;
    let [low, high] = data.preload_accelerations_m_per_s2;
    let [least, most] = data.preload_acceleration_range_m_per_s2;
    let [light, heavy] = data.ball_weights_n;
    let [low_density, high_density] = data.steel_densities_kg_per_m3;
    let weight = format!(
        "the ball weighs {:.1} mN with a density of {} kg/m³, an assumption since the paper prints neither; {:.0} to {:.0} mN \
         from {low_density} to {high_density} kg/m³",
        milli(data.ball_weight_n),
        data.steel_density_kg_per_m3,
        milli(light),
        milli(heavy)
    );
    let [least_preload, most_preload] = data.preloads_n;
    vec![Claim::statement(
        ID,
        "this work",
        "the measured preloads, read in mN, are below the weight of the ball, and their g lies in the simulated range",
        least_preload < most_preload && most_preload < light && least <= low && high <= most,
        format!(
            "{weight}. Preloads of {:.0} to {:.0} mN over the mass are g = {low:.2} to {high:.2} m/s², simulated are \
                 {least} to {most} m/s². The printed unit, mNm, is that of a torque",
            milli(least_preload),
            milli(most_preload)
        ),
    )]
}
