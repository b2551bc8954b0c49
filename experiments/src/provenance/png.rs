//! Provenance in the text chunks of a PNG file.

use bouncing_disk::Provenance;
use serde_json::Value;

use super::{NAME, text};

/// Where chunks may begin: after the signature (8 bytes) and the header (25 bytes).
const AFTER_HEADER: usize = 33;
const TEXT: &[u8; 4] = b"tEXt";
/// The keyword of PNG for who wrote a file.
const SOFTWARE: &str = "Software";

/// A picture that says where it comes from. The image itself stays the same bytes.
pub fn in_png(provenance: &Provenance, picture: &[u8]) -> Vec<u8> {
    let Some((head, rest)) = picture.split_at_checked(AFTER_HEADER) else { return picture.to_vec() };
    let program = format!("{} {}", provenance.program(), provenance.version());
    [head, &text_chunk(SOFTWARE, &program), &text_chunk(NAME, &text(provenance)), rest].concat()
}

/// What a picture says of its origin, if anything.
pub fn from_png(picture: &[u8]) -> Option<Value> {
    let of_provenance = |chunk: &Chunk<'_>| chunk.keyword() == Some(NAME.as_bytes());
    let chunk = chunks(picture).find(of_provenance)?;
    serde_json::from_slice(chunk.data.get(NAME.len() + 1..)?).ok()
}

/// The picture alone, for digests.
pub fn without_png(picture: &[u8]) -> Vec<u8> {
    let Some((head, _)) = picture.split_at_checked(AFTER_HEADER) else { return picture.to_vec() };
    let ours = |chunk: &Chunk<'_>| {
        chunk.keyword().is_some_and(|own| own == NAME.as_bytes() || own == SOFTWARE.as_bytes())
    };
    let mut alone = head.to_vec();
    let mut end = AFTER_HEADER;
    for chunk in chunks(picture) {
        end += chunk.bytes.len();
        if !ours(&chunk) {
            alone.extend(chunk.bytes);
        }
    }
    // What is no chunk stays, so that a malformed file does not look like another.
    alone.extend(picture.get(end..).unwrap_or_default());
    alone
}

struct Chunk<'a> {
    kind: &'a [u8],
    data: &'a [u8],
    /// With length and check sum.
    bytes: &'a [u8],
}

impl Chunk<'_> {
    /// The keyword of a text.
    fn keyword(&self) -> Option<&[u8]> {
        let text = (self.kind == TEXT).then_some(self.data)?;
        text.split(|byte| *byte == 0).next()
    }
}

/// The chunks after the header.
fn chunks(picture: &[u8]) -> impl Iterator<Item = Chunk<'_>> {
    let mut rest = picture.get(AFTER_HEADER..).unwrap_or_default();
    std::iter::from_fn(move || {
        let length = u32::from_be_bytes(rest.first_chunk().copied()?);
        let whole = usize::try_from(length).ok()?.checked_add(12)?;
        let (bytes, after) = rest.split_at_checked(whole)?;
        rest = after;
        Some(Chunk { kind: bytes.get(4..8)?, data: bytes.get(8..whole - 4)?, bytes })
    })
}

/// A chunk of text in ASCII: other letters as JSON escapes them.
fn text_chunk(keyword: &str, text: &str) -> Vec<u8> {
    let mut escaped = String::new();
    for letter in text.chars() {
        if letter.is_ascii() {
            escaped.push(letter);
        } else {
            let mut units = [0; 2];
            letter
                .encode_utf16(&mut units)
                .iter()
                .for_each(|unit| escaped.push_str(&format!("\\u{unit:04x}")));
        }
    }
    let checked = [TEXT, keyword.as_bytes(), &[0], escaped.as_bytes()].concat();
    let length = u32::try_from(checked.len() - TEXT.len()).unwrap_or_default();
    let sum = crc32fast::hash(&checked);
    [&length.to_be_bytes(), checked.as_slice(), &sum.to_be_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use bouncing_disk_plot::Figure;
    use serde_json::json;

    use super::super::{FIGURE, new};
    use super::*;

    #[test]
    fn the_picture_gives_it_back_and_is_the_same_without() {
        let picture = Figure::new(10.0, 10.0).to_png().expect("draws");
        let provenance = new(FIGURE).with("τ 𝛼", "Γ < 1").expect("storable");
        let with = in_png(&provenance, &picture);
        assert_eq!(from_png(&with), Some(json!(provenance)));
        assert!(with.windows(34).any(|text| text == b"Software\0bouncing-disk-experiments"));
        assert_eq!(without_png(&with), picture);
        assert_eq!((from_png(&picture), without_png(&picture)), (None, picture.clone()));
        // A reader that checks every sum takes it.
        let mut broken = with.clone();
        broken[50] ^= 1;
        assert!(Figure::new(1.0, 1.0).to_png().is_ok() && decodes(&with) && !decodes(&broken));
        for length in [0, 20, 33, 40, 60, with.len() - 1] {
            assert!(without_png(&with[..length]).len() <= length);
        }
    }

    /// Whether every chunk has the check sum of its content, up to the end.
    fn decodes(picture: &[u8]) -> bool {
        let sums = chunks(picture).all(|chunk| {
            let (checked, sum) = chunk.bytes[4..].split_at(chunk.bytes.len() - 8);
            crc32fast::hash(checked).to_be_bytes() == sum
        });
        sums && chunks(picture).last().is_some_and(|chunk| chunk.kind == b"IEND")
    }
}
