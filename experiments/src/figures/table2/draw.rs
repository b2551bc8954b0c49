//! The drawing of Table II.

use bouncing_disk_plot::{Figure, Label, ruled_table};

use super::data::Table2Data;

pub(super) fn draw(data: &Table2Data) -> Figure {
    let header = [
        "input",
        "value",
        r"effect on $\dot{\alpha}_f$ (rad/s)",
        "at the upper end",
        "at the lower end",
        "printed",
    ]
    .map(Label::new);
    let mut rows: Vec<Vec<Label>> = Vec::new();
    for effect in &data.effects {
        // As many decimals as the printed entry, and one or two more.
        let decimals = if effect.printed_rad_per_s < 1.0 { 4 } else { 2 };
        let unit = if effect.unit.is_empty() { String::new() } else { format!(" {}", effect.unit) };
        rows.push(vec![
            Label::new(&effect.label),
            Label::plain(&format!("{} ± {}{unit}", effect.value, effect.uncertainty)),
            Label::plain(&format!("± {:.decimals$}", effect.central_rad_per_s.abs())),
            Label::plain(&signed(effect.upper_rad_per_s, decimals)),
            Label::plain(&signed(effect.lower_rad_per_s, decimals)),
            Label::plain(&format!("± {}", effect.printed_rad_per_s)),
        ]);
    }
    rows.push(vec![
        Label::new(r"$\dot{\alpha}_f$"),
        Label::plain(&format!("{:.2} rad/s", data.airborne_speed_rad_per_s)),
        Label::plain(&format!("± {:.2} (root sum of squares)", data.combined.root_sum_of_squares_rad_per_s)),
        Label::plain(""),
        Label::plain(""),
        Label::plain(&data.section.predicted_airborne_speed_rad_per_s),
    ]);
    ruled_table(&header, &rows)
}

fn signed(value: f64, decimals: usize) -> String {
    format!("{value:+.decimals$}").replace('-', "−")
}
