//! The bundled fonts: STIX Two, which resembles the journal's typeface. System fonts are never used, so a
//! picture is the same on every machine.

use std::sync::{Arc, OnceLock};

use resvg::usvg::fontdb;
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};

const REGULAR: &[u8] = include_bytes!("../assets/fonts/STIXTwoText-Regular.ttf");
const ITALIC: &[u8] = include_bytes!("../assets/fonts/STIXTwoText-Italic.ttf");
/// Relations and arrows, which the text fonts lack.
const MATH: &[u8] = include_bytes!("../assets/fonts/STIXTwoMath-Regular.ttf");

/// The family of all text.
pub(crate) const FAMILY: &str = "STIX Two Text";
/// The families named in an SVG, for programs that show it with their own fonts.
pub(crate) const FAMILIES: &str =
    "'STIX Two Text','STIX Two Math',STIXGeneral,'Times New Roman','Liberation Serif',serif";

/// The shape of letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum FontStyle {
    /// Upright.
    Roman,
    /// Italic, for variables.
    Italic,
}

/// The fonts for the renderer.
pub(crate) fn database() -> Arc<fontdb::Database> {
    static DATABASE: OnceLock<Arc<fontdb::Database>> = OnceLock::new();
    let database = DATABASE.get_or_init(|| {
        let mut database = fontdb::Database::new();
        for font in [REGULAR, ITALIC, MATH] {
            database.load_font_data(font.to_vec());
        }
        database.set_serif_family(FAMILY);
        Arc::new(database)
    });
    Arc::clone(database)
}

/// The width of a character in units of the font size; `None` if no bundled font has it.
pub(crate) fn advance(character: char, style: FontStyle) -> Option<f64> {
    let font = match style {
        FontStyle::Roman => REGULAR,
        FontStyle::Italic => ITALIC,
    };
    let advance = advance_in(font, character).or_else(|| advance_in(MATH, character))?;
    // Combining marks sit on the letter before them.
    Some(if ('\u{300}'..='\u{36f}').contains(&character) { 0.0 } else { advance })
}

fn advance_in(data: &[u8], character: char) -> Option<f64> {
    let font = FontRef::new(data).ok()?;
    let glyph = font.charmap().map(character)?;
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    metrics.advance_width(glyph).map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_three_fonts_are_loaded() {
        assert_eq!(database().len(), 3);
    }

    #[test]
    fn the_fonts_have_every_character_that_labels_use() {
        let used = "0123456789 αβγδεζηθικλμνξπρστυφϕχψωΓΔΘΛΞΠΣΦΨΩ×±−°≤≥≈≠∞·→←↔⟨⟩∂√∝∼≪≫′–—…()[]{}|/=+<>%\u{307}\u{308}\u{2009}";
        for character in used.chars() {
            for style in [FontStyle::Roman, FontStyle::Italic] {
                assert!(advance(character, style).is_some(), "{character:?} {style:?}");
            }
        }
        assert!(advance('漢', FontStyle::Roman).is_none());
    }

    #[test]
    fn widths_are_in_units_of_the_font_size() {
        let width = advance('0', FontStyle::Roman).expect("a digit");
        assert!((0.4..0.6).contains(&width), "{width}");
        assert!(advance('\u{307}', FontStyle::Italic).expect("dot above") < 1e-9);
    }
}
