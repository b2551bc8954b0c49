//! The origin that every written file but a picture of pixels states: program and version, the version of its format, the figure with
//! its quality and parameters, seed and chatter policy.
//!
//! It is put into a file when the file is written, and none of the digests that pin data and drawings sees
//! it: another version of the program does not make a figure another one. It holds no time and no machine, so
//! that files are the same bytes wherever they are made.
//!
//! | file | place |
//! | --- | --- |
//! | JSON | the member `provenance` |
//! | SVG | the first element, `<metadata id="provenance">` |
//! | `claims.json`, an array | the member `provenance` of each claim |
//! | `index.html` | `<meta name="provenance">` |

use std::path::Path;

pub use bouncing_disk::store::{Format, Provenance, StorageError};
use serde_json::Value;

/// The format of `ID.json` and `ID.svg`; version 1 had no claims.
pub const FIGURE: Format = Format { name: "bouncing-disk figure", version: 2, oldest: 2 };
/// The format of the claims in `claims.json`.
pub const CLAIM: Format = Format { name: "bouncing-disk claim", version: 1, oldest: 1 };
/// The format of `index.html`.
pub const GALLERY: Format = Format { name: "bouncing-disk gallery", version: 1, oldest: 1 };
/// The format of `digests.json`; version 1 had the digests of pictures with what they say of their origin
/// taken out.
pub const DIGESTS: Format = Format { name: "bouncing-disk digests", version: 2, oldest: 2 };

/// The origin of a claim of a figure with this origin: without the values of all parameters.
pub(crate) fn of_claim(figure: &Provenance) -> Result<Provenance, StorageError> {
    let mut claim = new(CLAIM);
    for (name, value) in figure.parameters().iter().filter(|(name, _)| *name != "values") {
        claim = claim.with(name, value)?;
    }
    if let Some(seed) = figure.seed() {
        claim = claim.with_seed(seed);
    }
    Ok(match figure.chatter_policy() {
        Some(policy) => claim.with_chatter_policy(policy),
        None => claim,
    })
}

/// Of a file that this version of the experiments writes.
pub fn new(format: Format) -> Provenance {
    Provenance::new(format).written_by(env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"))
}

/// The text of JSON on one line; provenance holds names, texts and finite numbers only, so that it has one.
pub(crate) fn text(provenance: &Provenance) -> String {
    serde_json::to_string(provenance).unwrap_or_default()
}

/// Refuses what was written in a newer format, by name. A file that says nothing of its origin, or whose
/// origin is another program's, is judged by whoever reads the rest of it.
pub fn refuse_newer(format: Format, stored: Option<&Value>, file: &str) -> Result<(), StorageError> {
    match stored.map(|stored| Provenance::read(format, stored, Path::new(file))) {
        Some(Err(error @ StorageError::NewerFormat { .. })) => Err(error),
        _ => Ok(()),
    }
}

/// A drawing that says where it comes from.
pub fn in_svg(provenance: &Provenance, drawing: &str) -> String {
    let Some((head, rest)) = drawing.split_once('\n') else { return drawing.to_owned() };
    let text = text(provenance).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    format!("{head}\n<metadata id=\"provenance\">{text}</metadata>\n{rest}")
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn drawings_hold_it_and_only_a_newer_format_of_ours_is_refused() {
        let provenance = new(FIGURE).with("ε <of> & \"all\"", "0.5\n").expect("storable");
        let drawing = in_svg(&provenance, "<svg>\n<rect/>\n</svg>\n");
        assert!(
            drawing.starts_with("<svg>\n<metadata id=\"provenance\">{")
                && drawing.contains("&lt;of&gt; &amp; ")
        );
        assert!(drawing.ends_with("}</metadata>\n<rect/>\n</svg>\n"), "{drawing}");
        let newer = json!(new(Format { version: 3, ..FIGURE }));
        let error = refuse_newer(FIGURE, Some(&newer), "fig06.json").expect_err("newer").to_string();
        assert!(
            error.starts_with("\"fig06.json\" has version 3 of the format \"bouncing-disk figure\""),
            "{error}"
        );
        for stored in
            [None, Some(json!(provenance)), Some(json!("words")), Some(json!({"format_version": 9}))]
        {
            assert!(refuse_newer(FIGURE, stored.as_ref(), "fig06.json").is_ok(), "{stored:?}");
        }
    }
}
