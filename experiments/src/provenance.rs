//! The origin that every written file states: program and version, the version of its format, the figure with
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
//! | PNG | the `tEXt` chunks `provenance` and `Software`, in front of the image |
//! | `claims.json`, an array | the member `provenance` of each claim |
//! | `index.html` | `<meta name="provenance">` |

use std::path::Path;

pub use bouncing_disk::store::{Format, Provenance, StorageError};
use serde_json::Value;

/// The format of `ID.json`, `ID.svg` and `ID.png`.
pub const FIGURE: Format = Format { name: "bouncing-disk figure", version: 1, oldest: 1 };
/// The format of the claims in `claims.json`.
pub const CLAIM: Format = Format { name: "bouncing-disk claim", version: 1, oldest: 1 };
/// The format of `index.html`.
pub const GALLERY: Format = Format { name: "bouncing-disk gallery", version: 1, oldest: 1 };
/// The format of `ID.cache-key`.
pub const CACHE_KEY: Format = Format { name: "bouncing-disk cache key", version: 1, oldest: 1 };
/// The format of `digests.json`; version 1 had the digests of pictures with what they say of their origin
/// taken out.
pub const DIGESTS: Format = Format { name: "bouncing-disk digests", version: 2, oldest: 2 };
/// The format of the files in `data/performance`.
pub const PERFORMANCE: Format = Format { name: "bouncing-disk performance", version: 1, oldest: 1 };

/// Where chunks of a PNG file may begin: after the signature (8 bytes) and the header (25 bytes).
const AFTER_HEADER: usize = 33;

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

/// A picture that says where it comes from. The image itself stays the same bytes.
pub fn in_png(provenance: &Provenance, picture: &[u8]) -> Vec<u8> {
    let Some((head, rest)) = picture.split_at_checked(AFTER_HEADER) else { return picture.to_vec() };
    let program = format!("{} {}", provenance.program(), provenance.version());
    [head, &text_chunk("Software", &program), &text_chunk("provenance", &text(provenance)), rest].concat()
}

/// A chunk of text in ASCII: other letters as JSON escapes them.
fn text_chunk(keyword: &str, text: &str) -> Vec<u8> {
    let escape = |letter: char| match letter.is_ascii() {
        true => letter.to_string(),
        false => letter.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect(),
    };
    let escaped: String = text.chars().map(escape).collect();
    let kind = b"tEXt";
    let checked = [kind, keyword.as_bytes(), &[0], escaped.as_bytes()].concat();
    let length = u32::try_from(checked.len() - kind.len()).unwrap_or_default();
    let sum = crc32fast::hash(&checked);
    [&length.to_be_bytes(), checked.as_slice(), &sum.to_be_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// A reader of others, which takes no wrong check sum, finds texts and pixels.
    #[test]
    fn another_reader_of_png_takes_it_and_sees_the_same_picture() {
        let provenance = new(FIGURE).with("τ 𝛼", "Γ < 1").expect("storable");
        let picture = bouncing_disk_plot::Figure::new(10.0, 10.0).to_png().expect("draws");
        let decoded = |file: &[u8]| {
            let mut options = png::DecodeOptions::default();
            options.set_ignore_checksums(false);
            options.set_skip_ancillary_crc_failures(false);
            let file = std::io::Cursor::new(file);
            let mut reader = png::Decoder::new_with_options(file, options).read_info().expect("is whole");
            let mut pixels = vec![0; reader.output_buffer_size().unwrap_or_default()];
            reader.next_frame(&mut pixels).expect("is whole");
            reader.finish().expect("is whole");
            let texts = reader.info().uncompressed_latin1_text.iter();
            (pixels, texts.map(|text| (text.keyword.clone(), text.text.clone())).collect::<Vec<_>>())
        };
        let (pixels, texts) = decoded(&in_png(&provenance, &picture));
        assert!(pixels == decoded(&picture).0 && pixels.iter().any(|byte| *byte != 0), "other pixels");
        let [software, origin] = texts.try_into().expect("two texts");
        let program = format!("bouncing-disk-experiments {}", env!("CARGO_PKG_VERSION"));
        assert_eq!(software, ("Software".to_owned(), program));
        assert!(origin.0 == "provenance" && origin.1.is_ascii(), "{}", origin.1);
        assert_eq!(serde_json::from_str::<Value>(&origin.1).ok(), Some(json!(provenance)));
    }

    #[test]
    fn drawings_hold_it_and_only_a_newer_format_of_ours_is_refused() {
        let provenance = new(FIGURE).with("ε <of> & \"all\"", "0.5\n").expect("storable");
        let drawing = in_svg(&provenance, "<svg>\n<rect/>\n</svg>\n");
        assert!(
            drawing.starts_with("<svg>\n<metadata id=\"provenance\">{")
                && drawing.contains("&lt;of&gt; &amp; ")
        );
        assert!(drawing.ends_with("}</metadata>\n<rect/>\n</svg>\n"), "{drawing}");
        let newer = json!(new(Format { version: 2, ..FIGURE }));
        let error = refuse_newer(FIGURE, Some(&newer), "fig06.json").expect_err("newer").to_string();
        assert!(
            error.starts_with("\"fig06.json\" has version 2 of the format \"bouncing-disk figure\""),
            "{error}"
        );
        for stored in
            [None, Some(json!(provenance)), Some(json!("words")), Some(json!({"format_version": 9}))]
        {
            assert!(refuse_newer(FIGURE, stored.as_ref(), "fig06.json").is_ok(), "{stored:?}");
        }
    }
}
