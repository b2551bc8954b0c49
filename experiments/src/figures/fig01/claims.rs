//! What the paper says about Fig. 1, compared with the data.

use super::data::Fig01Data;
use crate::claim::Claim;

/// Two lengths that should be one agree within this share of the stroke: a hundred roundings.
const ROUNDING: f64 = 100.0 * f64::EPSILON;

pub(super) fn claims(data: &Fig01Data) -> Vec<Claim> {
    let gap = data.path.closing_gap(data.contact_radius_m);
    let area = data.path.enclosed_area(data.contact_radius_m);
    let stroke = data.table_i.stroke_m.value;
    let motion = Claim::printed_statement(
        "section1.platform_motion",
        (!data.path.phase_rad.is_empty()).then_some(data.equation_fault <= ROUNDING),
        format!(
            "largest difference of the platform's height and angle from Eq. (1) at {} phases, over the amplitudes: {:.1e}",
            data.path.phase_rad.len(),
            data.equation_fault
        ),
    );
    let curve = Claim::printed_statement(
        "section1.closed_curves",
        gap.map(|gap| gap <= ROUNDING * stroke && area.abs() > ROUNDING * stroke * stroke),
        format!(
            "after one period the point is {:.1e} m from where it was; on the unrolled cylinder of radius a_e \
             its path encloses {:.4} m²",
            gap.unwrap_or(f64::NAN),
            area.abs()
        ),
    );
    vec![motion, curve]
}
