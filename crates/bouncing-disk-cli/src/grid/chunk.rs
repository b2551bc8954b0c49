//! The file of a part of the rows, and how the parts are put together.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::{Format, Provenance, regular_file};
use serde_json::{Value, json};

use super::GridJob;
use crate::arguments::Chunk;
use crate::failure::Failure;
use crate::output::json::Data;
use crate::output::report::{PROGRAM, Report, VERSION, stored, value};

/// The format of such a file.
const CHUNK: Format = Format { name: "bouncing-disk chunk", version: 2, oldest: 2 };

/// The largest file of a part that is read (bytes).
const LARGEST: u64 = 1 << 34;

/// The fields of the file of a part: it says what it belongs to, and has digests of the job and of its rows.
pub(super) fn fields<J: GridJob>(
    job: &J,
    chunk: Chunk,
    range: Range<usize>,
    rows: &[J::Row],
) -> Result<Vec<(&'static str, Data)>, Failure> {
    let job_value = value(job)?;
    let provenance = Provenance::new(CHUNK)
        .written_by(PROGRAM, VERSION)
        .with("command", J::COMMAND)?
        .with("job", &job_value)?;
    let rows = value(rows)?;
    Ok(vec![
        ("provenance", stored(&provenance)?),
        ("job_digest", json!(digest(&job_value)).into()),
        ("chunk", json!({ "index": chunk.index, "count": chunk.count }).into()),
        ("first_row", json!(range.start).into()),
        ("end_row", json!(range.end).into()),
        ("rows_digest", json!(rows_digest(chunk, &range, &rows)).into()),
        ("rows", rows.into()),
    ])
}

/// The digest of rows with their place, so that those of two parts cannot be changed for each other.
fn rows_digest(chunk: Chunk, range: &Range<usize>, rows: &Value) -> String {
    let place = json!([chunk.index, chunk.count, range.start, range.end]).to_string();
    Digest::of((place + &rows.to_string()).as_bytes()).to_string()
}

/// The digest of a value as compact JSON, whose keys are sorted.
fn digest(value: &Value) -> String {
    Digest::of(value.to_string().as_bytes()).to_string()
}

/// A part that was read.
#[derive(Debug)]
pub(crate) struct Part {
    /// The name of its file, for messages.
    name: String,
    /// The command that it is a part of.
    pub(crate) command: String,
    job: Value,
    version: String,
    chunk: Chunk,
    range: Range<usize>,
    rows: Vec<Value>,
}

impl Part {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Failure::Usage`] names the file, and says what is wrong with it.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let refuse = |why: &str| Failure::usage(format!("{name}: {why}"));
        let bytes = regular_file::read(path, LARGEST)
            .map_err(|error| refuse(&format!("it cannot be read: {error}")))?;
        let mut stored: Value = serde_json::from_slice(&bytes)
            .map_err(|error| refuse(&format!("it is no whole chunk: {error}")))?;
        let provenance = Provenance::read(CHUNK, &stored["provenance"], path)?;
        let parameter = |name: &str| provenance.parameters().get(name).cloned().unwrap_or_default();
        let (command, job) = (parameter("command"), parameter("job"));
        let rows = stored["rows"].take();
        let count = |value: &Value| value.as_u64().and_then(|whole| usize::try_from(whole).ok());
        let (index, of) = (count(&stored["chunk"]["index"]), count(&stored["chunk"]["count"]));
        let (first, end) = (count(&stored["first_row"]), count(&stored["end_row"]));
        let (Some(index), Some(of), Some(first), Some(end)) = (index, of, first, end) else {
            return Err(refuse("it does not say which part it is"));
        };
        let (chunk, range) = (Chunk { index, count: of }, first..end);
        for (what, found) in
            [("job_digest", digest(&job)), ("rows_digest", rows_digest(chunk, &range, &rows))]
        {
            if stored[what] != json!(found) {
                return Err(refuse(&format!("it is damaged: its {what} is not that of its content")));
            }
        }
        let Value::Array(rows) = rows else { return Err(refuse("it has no rows")) };
        if index == 0 || index > of || first.checked_add(rows.len()) != Some(end) {
            return Err(refuse(&format!(
                "it does not fit together: chunk {index} of {of}, rows {first} to {end}, and {} of them",
                rows.len()
            )));
        }
        Ok(Self {
            command: command.as_str().unwrap_or_default().to_owned(),
            job,
            version: provenance.version().to_owned(),
            chunk,
            range,
            rows,
            name,
        })
    }
}

/// The result of all parts, which are those of one job of this type.
///
/// # Errors
/// [`Failure::Usage`] names the parts that are missing, doubled or foreign; those of the library.
pub(crate) fn merged<J: GridJob>(
    parts: Vec<Part>,
    observer: &dyn bouncing_disk::Observer,
) -> Result<Report, Failure> {
    let parts = sorted(parts)?;
    let Some(first) = parts.first() else { return Err(Failure::usage("there are no chunks")) };
    let unreadable =
        |name: &str, error: &serde_json::Error| Failure::usage(format!("{name}: it cannot be read: {error}"));
    let job: J =
        serde_json::from_value(first.job.clone()).map_err(|error| unreadable(&first.name, &error))?;
    let total = job.rows();
    let mut rows = Vec::new();
    for part in parts {
        let expected = part.chunk.rows(total);
        if part.range != expected {
            let Range { start, end } = part.range;
            return Err(Failure::usage(format!(
                "{}: it has the rows {start} to {end}, where its part of {total} has {} to {}",
                part.name, expected.start, expected.end
            )));
        }
        for row in part.rows {
            rows.push(serde_json::from_value(row).map_err(|error| unreadable(&part.name, &error))?);
        }
    }
    let prepared = job.prepare(observer)?;
    job.report(prepared, rows)
}

/// The parts in their order, if they are all parts of one job, each once.
fn sorted(parts: Vec<Part>) -> Result<Vec<Part>, Failure> {
    let mut by_index: BTreeMap<usize, Part> = BTreeMap::new();
    let mut first: Option<(String, Value, String, String, usize)> = None;
    for part in parts {
        let own = (
            part.name.clone(),
            part.job.clone(),
            part.command.clone(),
            part.version.clone(),
            part.chunk.count,
        );
        let (name, job, command, version, count) = first.get_or_insert(own);
        let foreign = |what: &str, found: &str, expected: &str| {
            Failure::usage(format!(
                "{} is of another computation: its {what} is {found}, where {name} has {expected}",
                part.name
            ))
        };
        if part.command != *command {
            return Err(foreign("command", &part.command, command));
        }
        if part.version != *version {
            return Err(foreign("version of the program", &part.version, version));
        }
        if let Some((what, found, expected)) = difference(&part.job, job, "job") {
            return Err(foreign(&what, &found, &expected));
        }
        if part.chunk.count != *count {
            return Err(foreign("number of chunks", &part.chunk.count.to_string(), &count.to_string()));
        }
        let (index, name) = (part.chunk.index, part.name.clone());
        if let Some(other) = by_index.insert(index, part) {
            return Err(Failure::usage(format!("chunk {index} is there twice: {} and {name}", other.name)));
        }
    }
    let count = first.map_or(0, |(.., count)| count);
    let missing = count - by_index.len();
    if missing > 0 {
        let absent = (1..=count).filter(|index| !by_index.contains_key(index)).take(20);
        let shown: Vec<_> = absent.map(|index| format!("{index}/{count}")).collect();
        let more = missing - shown.len();
        let shown = shown.join(", ");
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        return Err(Failure::usage(format!("chunks are missing: {shown}{more}")));
    }
    Ok(by_index.into_values().collect())
}

/// Where two values differ first, with what they have there.
fn difference(found: &Value, expected: &Value, path: &str) -> Option<(String, String, String)> {
    if let (Value::Object(one), Value::Object(other)) = (found, expected) {
        let names = one.keys().chain(other.keys());
        return names.into_iter().find_map(|name| {
            let none = Value::Null;
            let (one, other) = (one.get(name).unwrap_or(&none), other.get(name).unwrap_or(&none));
            difference(one, other, &format!("{path}.{name}"))
        });
    }
    let short = |value: &Value| value.to_string().chars().take(80).collect::<String>();
    (found != expected).then(|| (path.to_owned(), short(found), short(expected)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(index: usize, count: usize, job: Value) -> Part {
        let chunk = Chunk { index, count };
        Part {
            name: format!("part-{index}.json"),
            command: "test".to_owned(),
            job,
            version: "1".to_owned(),
            chunk,
            range: 0..0,
            rows: Vec::new(),
        }
    }

    fn refused(parts: Vec<Part>) -> String {
        let Err(Failure::Usage(text)) = sorted(parts) else { panic!("accepted") };
        text
    }

    #[test]
    fn parts_are_sorted_and_what_does_not_fit_is_named() {
        let job = || json!({"a": 1, "b": {"c": 0.5}});
        let sorted = sorted(vec![part(3, 3, job()), part(1, 3, job()), part(2, 3, job())]).unwrap();
        assert_eq!(sorted.iter().map(|part| part.chunk.index).collect::<Vec<_>>(), [1, 2, 3]);
        assert_eq!(refused(vec![part(1, 3, job())]), "chunks are missing: 2/3, 3/3");
        let twice = refused(vec![part(1, 2, job()), part(2, 2, job()), part(1, 2, job())]);
        assert_eq!(twice, "chunk 1 is there twice: part-1.json and part-1.json");
        let foreign = refused(vec![part(1, 2, job()), part(2, 2, json!({"a": 1, "b": {"c": 0.6}}))]);
        assert_eq!(
            foreign,
            "part-2.json is of another computation: its job.b.c is 0.6, where part-1.json has 0.5"
        );
        assert!(refused(vec![part(1, 2, job()), part(2, 3, job())]).contains("its number of chunks is 3"));
        assert!(refused(vec![part(1, 100, job())]).ends_with("and 79 more"));
    }
}
