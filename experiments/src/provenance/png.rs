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
    use std::io::Cursor;

    use bouncing_disk_plot::Figure;
    use png::{DecodeOptions, Decoder};
    use serde_json::json;

    use super::super::{FIGURE, new};
    use super::*;

    fn picture() -> Vec<u8> {
        Figure::new(10.0, 10.0).to_png().expect("draws")
    }

    fn provenance() -> Provenance {
        new(FIGURE).with("τ 𝛼", "Γ < 1").expect("storable")
    }

    /// Keyword and content of each.
    type Texts = Vec<(String, String)>;

    /// The pixels and the texts, as a reader of others has them that takes no wrong check sum.
    fn decoded(file: &[u8]) -> Result<(Vec<u8>, Texts), png::DecodingError> {
        let mut options = DecodeOptions::default();
        options.set_ignore_checksums(false);
        options.set_skip_ancillary_crc_failures(false);
        let mut reader = Decoder::new_with_options(Cursor::new(file), options).read_info()?;
        let mut pixels = vec![0; reader.output_buffer_size().unwrap_or_default()];
        reader.next_frame(&mut pixels)?;
        reader.finish()?;
        let texts = &reader.info().uncompressed_latin1_text;
        Ok((pixels, texts.iter().map(|text| (text.keyword.clone(), text.text.clone())).collect()))
    }

    /// Where the two chunks in front of the image end, by the lengths that a file gives.
    fn ends_of_texts(with: &[u8]) -> [usize; 2] {
        let after = |start: usize| {
            let length: [u8; 4] = with[start..start + 4].try_into().expect("four bytes");
            start + 12 + u32::from_be_bytes(length) as usize
        };
        let first = after(AFTER_HEADER);
        [first, after(first)]
    }

    #[test]
    fn the_picture_gives_it_back_and_is_the_same_without() {
        let picture = picture();
        let with = in_png(&provenance(), &picture);
        assert_eq!(from_png(&with), Some(json!(provenance())));
        assert_eq!(without_png(&with), picture);
        assert_eq!((from_png(&picture), without_png(&picture)), (None, picture.clone()));
        // Provenance that is there is not the picture's.
        assert_eq!(without_png(&in_png(&provenance(), &with)), picture);
    }

    #[test]
    fn another_reader_takes_it_and_sees_the_same_picture() {
        let picture = picture();
        let with = in_png(&provenance(), &picture);
        let (pixels, texts) = decoded(&with).expect("is whole");
        let (expected, none) = decoded(&picture).expect("is whole");
        assert!(pixels == expected && pixels.iter().any(|byte| *byte != 0), "other pixels");
        assert!(none.is_empty(), "{none:?}");
        let [software, origin] = texts.try_into().expect("two texts");
        let program = format!("bouncing-disk-experiments {}", env!("CARGO_PKG_VERSION"));
        assert_eq!(software, ("Software".to_owned(), program));
        assert_eq!(origin.0, "provenance");
        assert!(origin.1.is_ascii(), "{}", origin.1);
        assert_eq!(serde_json::from_str::<Value>(&origin.1).ok(), Some(json!(provenance())));
    }

    /// Any bit of the two chunks behind their lengths, that of kind, text and check sum.
    #[test]
    fn another_reader_notices_each_changed_bit() {
        let with = in_png(&provenance(), &picture());
        let [first, second] = ends_of_texts(&with);
        for place in (AFTER_HEADER + 4..first).chain(first + 4..second) {
            let mut broken = with.clone();
            broken[place] ^= 1;
            assert!(decoded(&broken).is_err(), "{place}");
        }
    }

    /// A file that ends too early loses the chunks of ours that are whole, and nothing else.
    #[test]
    fn what_is_cut_off_does_not_look_like_the_picture() {
        let picture = picture();
        let with = in_png(&provenance(), &picture);
        let [first, second] = ends_of_texts(&with);
        assert_eq!(with.len() - picture.len(), second - AFTER_HEADER);
        for length in 0..with.len() {
            let cut = &with[..length];
            let kept = match length {
                _ if length < first => cut.to_vec(),
                _ if length < second => [&cut[..AFTER_HEADER], &cut[first..]].concat(),
                _ => picture[..length - (second - AFTER_HEADER)].to_vec(),
            };
            assert!(without_png(cut) == kept, "{length}");
            assert_eq!(from_png(cut).is_some(), length >= second, "{length}");
        }
    }
}
