//! What every written file says of its origin: program and version, the version of its format, the figure with
//! its quality and parameters, seed and chatter policy.
//!
//! It is put into a file when the file is written, and none of the digests that pin data and drawings sees it:
//! another version of the program does not make a figure another one. It holds no time and no machine, so that
//! files are the same bytes wherever they are made.
//!
//! | file | place |
//! | --- | --- |
//! | JSON | the member `provenance` |
//! | CSV | the first line, which begins with `# provenance: ` |
//! | SVG | the first element, `<metadata id="provenance">` |
//! | PNG | the `tEXt` chunks `provenance` and `Software`, in front of the image |
//! | `claims.json`, an array | the member `provenance` of each claim |
//! | `index.html` | `<meta name="provenance">` |

mod png;

use std::path::Path;

pub use bouncing_disk::{Format, Provenance, StorageError};
use serde::Serialize;
use serde_json::Value;

pub use self::png::{from_png, in_png, without_png};
use crate::experiment::{Quality, RegisteredExperiment};
use crate::json;

/// The format of `ID.json`, `ID.csv`, `ID.svg` and `ID.png`.
pub const FIGURE: Format = Format { name: "bouncing-disk figure", version: 1, oldest: 1 };
/// The format of the claims in `claims.json`.
pub const CLAIM: Format = Format { name: "bouncing-disk claim", version: 1, oldest: 1 };
/// The format of `index.html`.
pub const GALLERY: Format = Format { name: "bouncing-disk gallery", version: 1, oldest: 1 };
/// The format of `ID.cache-key`.
pub const CACHE_KEY: Format = Format { name: "bouncing-disk cache key", version: 1, oldest: 1 };
/// The format of `docs/figures/digests.json`.
pub const DIGESTS: Format = Format { name: "bouncing-disk digests", version: 1, oldest: 1 };

/// The format of the files in `data/performance`.
pub const PERFORMANCE: Format = Format { name: "bouncing-disk performance", version: 1, oldest: 1 };

/// The member of JSON, and the name elsewhere.
const NAME: &str = "provenance";
/// What the first line of a table begins with.
const BEFORE_IN_CSV: &str = "# provenance: ";
/// What is around it in a drawing.
const BEFORE_IN_SVG: &str = "<metadata id=\"provenance\">";
const AFTER_IN_SVG: &str = "</metadata>\n";

/// Of a file that this version of the experiments writes.
pub fn new(format: Format) -> Provenance {
    Provenance::new(format).written_by(env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"))
}

/// Of a figure in a quality, with its parameters as the gallery shows them. Where it has several seeds, the first
/// is *the* seed, and all of them are among the parameters by what is drawn with them.
///
/// # Errors
///
/// None that is known: names and texts can be stored.
pub fn of_figure(
    entry: &dyn RegisteredExperiment,
    quality: Quality,
    values: &[(String, String)],
) -> Result<Provenance, StorageError> {
    of(FIGURE, entry, quality)?.with("values", values)
}

/// Of the claims of a figure. The values of its parameters are in `ID.json`.
///
/// # Errors
///
/// None that is known.
pub fn of_claims(entry: &dyn RegisteredExperiment, quality: Quality) -> Result<Provenance, StorageError> {
    of(CLAIM, entry, quality)
}

fn of(
    format: Format,
    entry: &dyn RegisteredExperiment,
    quality: Quality,
) -> Result<Provenance, StorageError> {
    let mut provenance = new(format).with("figure", entry.id())?.with("quality", &quality)?;
    let seeds = entry.seeds();
    if let Some((_, first)) = seeds.first() {
        provenance = provenance.with_seed(*first);
    }
    if seeds.len() > 1 {
        provenance = provenance.with("seeds", &seeds)?;
    }
    if let Some(policy) = entry.chatter_policy() {
        provenance = provenance.with_chatter_policy(policy);
    }
    Ok(provenance)
}

/// The text of JSON on one line; provenance holds names, texts and finite numbers only, so that it has one.
fn text(provenance: &impl Serialize) -> String {
    serde_json::to_string(provenance).unwrap_or_default()
}

/// Refuses what was written in a newer format, by name. A file that says nothing of its origin, or whose origin is
/// another program's, is judged by whoever reads the rest of it.
///
/// # Errors
///
/// [`StorageError::NewerFormat`].
pub fn refuse_newer(format: Format, stored: Option<&Value>, file: &str) -> Result<(), StorageError> {
    match stored.map(|stored| Provenance::read(format, stored, Path::new(file))) {
        Some(Err(error @ StorageError::NewerFormat { .. })) => Err(error),
        _ => Ok(()),
    }
}

/// A table that says where it comes from.
pub fn in_csv(provenance: &Provenance, table: &str) -> String {
    format!("{BEFORE_IN_CSV}{}\n{table}", text(provenance))
}

/// What a table says of its origin, if anything.
pub fn from_csv(table: &str) -> Option<Value> {
    let (line, _) = table.strip_prefix(BEFORE_IN_CSV)?.split_once('\n')?;
    serde_json::from_str(line).ok()
}

/// A drawing that says where it comes from.
pub fn in_svg(provenance: &Provenance, drawing: &str) -> String {
    let Some((head, rest)) = drawing.split_once('\n') else { return drawing.to_owned() };
    let text = text(provenance).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    format!("{head}\n{BEFORE_IN_SVG}{text}{AFTER_IN_SVG}{rest}")
}

/// What a drawing says of its origin, if anything, and the drawing without it.
fn split_svg(drawing: &str) -> Option<(Value, String)> {
    let (head, rest) = drawing.split_once('\n')?;
    let (text, rest) = rest.strip_prefix(BEFORE_IN_SVG)?.split_once(AFTER_IN_SVG)?;
    let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    Some((serde_json::from_str(&text).ok()?, format!("{head}\n{rest}")))
}

/// What a drawing says of its origin, if anything.
pub fn from_svg(drawing: &str) -> Option<Value> {
    split_svg(drawing).map(|(stored, _)| stored)
}

/// The drawing alone, for digests.
pub fn without_svg(drawing: Vec<u8>) -> Vec<u8> {
    match std::str::from_utf8(&drawing).ok().and_then(split_svg) {
        Some((_, alone)) => alone.into_bytes(),
        None => drawing,
    }
}

/// JSON without what it says of its origin, for digests.
pub fn without_json(bytes: Vec<u8>) -> Vec<u8> {
    let Ok(mut value) = json::read::<Value>(&bytes) else { return bytes };
    let removed = value.as_object_mut().and_then(|members| members.remove(NAME));
    match removed.map(|_| json::to_text(&value)) {
        Some(Ok(text)) => text.into_bytes(),
        _ => bytes,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::testing::demo_entries;

    fn provenance() -> Provenance {
        let values = [("ε <of> & \"all\"".to_owned(), "0.5\n".to_owned())];
        of_figure(&*demo_entries()[0], Quality::Draft, &values).expect("storable")
    }

    #[test]
    fn a_figure_says_what_was_computed() {
        let stored = json!(provenance());
        assert_eq!(stored["program"], "bouncing-disk-experiments");
        assert_eq!(stored["version"], env!("CARGO_PKG_VERSION"));
        assert_eq!(stored["format_version"], FIGURE.version);
        let expected = json!({
            "figure": "demo",
            "quality": "draft",
            "seeds": [["points", 3], ["others", 4]],
            "values": [["ε <of> & \"all\"", "0.5\n"]],
        });
        assert_eq!(stored["parameters"], expected);
        assert_eq!((&stored["seed"], &stored["chatter_policy"]), (&json!(3), &json!("Complete")));
        // Without seed or policy, too, both are there.
        let none = json!(of_claims(&*demo_entries()[1], Quality::Paper).expect("storable"));
        assert!(none.as_object().is_some_and(|members| members.len() == 7) && none["seed"].is_null());
    }

    #[test]
    fn tables_and_drawings_give_it_back_and_are_what_they_were_without() {
        let provenance = provenance();
        let table = in_csv(&provenance, "a,b\n1,2\n");
        assert_eq!(from_csv(&table), Some(json!(provenance)));
        assert_eq!(table.lines().skip(1).collect::<Vec<_>>(), ["a,b", "1,2"]);
        assert_eq!(from_csv("a,b\n1,2\n"), None);
        let drawing = "<svg>\n<rect/>\n<metadata id=\"provenance\">mine</metadata>\n</svg>\n";
        let with = in_svg(&provenance, drawing);
        assert_eq!(from_svg(&with), Some(json!(provenance)));
        assert_eq!(without_svg(with.into_bytes()), drawing.as_bytes());
        assert_eq!((from_svg(drawing), without_svg(drawing.into())), (None, drawing.into()));
        let data = json!({"id": "demo", "data": [-0.0, 1e-8, 0.1 + 0.2, u64::MAX]});
        let mut with = data.clone();
        with[NAME] = json!(provenance);
        let bytes = |value| json::to_text(value).expect("writes").into_bytes();
        assert_eq!(without_json(bytes(&with)), bytes(&data));
        assert_eq!(without_json(b"[1".to_vec()), b"[1");
    }

    #[test]
    fn only_a_newer_format_of_ours_is_refused() {
        let newer = json!(new(Format { version: 2, ..FIGURE }));
        let error = refuse_newer(FIGURE, Some(&newer), "fig06.json").expect_err("newer").to_string();
        assert!(
            error.starts_with("\"fig06.json\" has version 2 of the format \"bouncing-disk figure\""),
            "{error}"
        );
        assert!(error.contains("bouncing-disk-experiments 0."), "{error}");
        for stored in
            [None, Some(json!(provenance())), Some(json!("words")), Some(json!({"format_version": 9}))]
        {
            assert!(refuse_newer(FIGURE, stored.as_ref(), "fig06.json").is_ok(), "{stored:?}");
        }
    }
}
