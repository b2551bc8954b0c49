//! Computations of many rows: in one go, in parts on several machines that are put together again, or with a
//! journal from which they resume.
//!
//! A row is computed the same, to the last bit, whatever others are computed with it. So the result does not
//! depend on how the rows were divided.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};

use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::core::sweep::PartialResults;
use bouncing_disk::store::{Format, JOURNAL, Journal, Provenance};
use bouncing_disk::{Observer, regular_file};
use clap::Args;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::context::{Context, Watcher};
use crate::failure::Failure;
use crate::interrupt;
use crate::output::files::{Kind, check_place};
use crate::output::json::{self, Data};
use crate::output::report::{PROGRAM, VERSION, value};
use crate::output::{OutputArgs, Report, stored};

/// The first rows are so many times fewer than the most that are computed together.
const FIRST_SHARE: usize = 256;

/// How long rows are computed together: as much is lost by an interruption.
const SHORT: Duration = Duration::from_millis(300);
const LONG: Duration = Duration::from_millis(1_200);

/// How the rows of a grid are computed.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Long computations")]
pub(crate) struct GridArgs {
    /// Computes the I-th of N parts of the rows and writes it to --out FILE.json; `bouncing-disk merge` puts
    /// all parts together
    #[arg(long, value_name = "I/N", allow_hyphen_values = true)]
    chunk: Option<Chunk>,
    /// Keeps finished rows in a file: the same command resumes where it was stopped or killed
    #[arg(long, value_name = "FILE")]
    journal: Option<PathBuf>,
}

/// A part of the rows of a grid, `2/10` on the command line: the second of ten.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct Chunk {
    /// From 1.
    index: usize,
    count: usize,
}

impl FromStr for Chunk {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let whole = |text: &str| text.trim().parse::<usize>().ok();
        let parts = text.split_once('/').and_then(|(index, count)| Some((whole(index)?, whole(count)?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("a chunk is I/N, from 1/N to N/N".to_owned()),
        }
    }
}

impl Chunk {
    /// The rows of this part of so many.
    fn rows(self, rows: usize) -> Range<usize> {
        let upto = |parts: usize| (rows as u128 * parts as u128 / self.count as u128) as usize;
        upto(self.index - 1)..upto(self.index)
    }
}

/// A computation of many rows. Stored, it has all that its rows depend on.
pub(crate) trait GridJob: Serialize + DeserializeOwned {
    /// The command, as it is written on the line.
    const COMMAND: &'static str;

    /// The result of a row.
    type Row: Serialize + DeserializeOwned;

    /// Computed once, for all rows.
    type Prepared;

    /// Number of rows.
    fn rows(&self) -> usize;

    /// Most rows that are computed together: they are kept, or begun again, together.
    fn together(&self) -> usize;

    /// Checks the job, and computes what all rows need.
    fn prepare(&self, observer: &dyn Observer) -> Result<Self::Prepared, Failure>;

    /// Computes rows.
    fn compute(
        &self,
        prepared: &Self::Prepared,
        rows: Range<usize>,
        observer: &dyn Observer,
    ) -> Result<Vec<Self::Row>, Failure>;

    /// The result of all rows.
    fn report(self, prepared: Self::Prepared, rows: Vec<Self::Row>) -> Result<Report, Failure>;
}

/// Computes a job, or its part, and delivers the result; `inputs` are the files that the job was read
/// from.
pub(crate) fn run<J: GridJob>(
    job: J,
    inputs: &[&Path],
    grid: &GridArgs,
    output: &OutputArgs,
    context: Context,
) -> Result<(), Failure> {
    let journal = grid.journal.as_deref();
    output.check(true, inputs, journal)?;
    if let Some(path) = journal {
        check_place(path).map_err(|failure| failure.in_context("--journal"))?;
    }
    if grid.chunk.is_some() && !matches!(&output.out[..], [target] if target.kind == Kind::Json) {
        return Err(Failure::usage("--chunk needs one --out FILE.json for its part"));
    }
    let rows = job.rows();
    let range = grid.chunk.map_or(0..rows, |chunk| chunk.rows(rows));
    let watcher = context.watch(J::COMMAND);
    let prepared = job.prepare(&watcher)?;
    let computed = compute_all(&job, &prepared, range.clone(), journal, watcher)?;
    match grid.chunk {
        Some(chunk) => {
            let fields = chunk_fields(&job, chunk, range, &computed)?;
            let fields = fields.iter().map(|(name, data)| (*name, data));
            output.out[0].write(output.force, context.quiet, |to| json::write(to, fields))
        }
        None => job.report(prepared, computed)?.deliver(output, context.quiet),
    }
}

/// Whether there is room for `count` <= `limit` things of so many bytes each, in which all rows end: better
/// refused now than after a day of computing.
///
/// # Errors
/// The core's [`TooLarge`](bouncing_disk::core::Error::TooLarge) names the number and the limit.
pub(crate) fn check_room(what: &'static str, count: u64, limit: u64, bytes: u64) -> Result<(), Failure> {
    let fits = |bytes: u64| {
        usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
    };
    if count <= limit && count.checked_mul(bytes).is_some_and(fits) {
        return Ok(());
    }
    Err(bouncing_disk::core::Error::TooLarge { what, count, limit }.into())
}

/// Computes the rows of a range that its journal, if there is one, does not have.
fn compute_all<J: GridJob>(
    job: &J,
    prepared: &J::Prepared,
    range: Range<usize>,
    path: Option<&Path>,
    watcher: Watcher,
) -> Result<Vec<J::Row>, Failure> {
    let items = range.len();
    let (mut journal, mut finished) = match path {
        None => (None, PartialResults::new(items)),
        Some(path) => {
            let key = Provenance::new(JOURNAL)
                .written_by(PROGRAM, VERSION)
                .with("command", J::COMMAND)?
                .with("job", job)?
                .with("rows", &[range.start, range.end])?;
            let (journal, finished) = Journal::open(path, &key, items)?;
            (Some(journal), finished)
        }
    };
    let open = finished.open(items)?;
    let mut left = &open[..];
    let most = job.together().max(1);
    let mut together = (most / FIRST_SHARE).max(1);
    while let Some(first) = left.first() {
        // Rows that follow each other, as far as they are open.
        let run = left.iter().zip(*first..).take_while(|(index, next)| *index == next).count();
        let count = run.min(together);
        let began = Instant::now();
        let rows = range.start + first..range.start + first + count;
        let computed = if interrupt::came() {
            Err(Failure::Interrupted(String::new()))
        } else {
            job.compute(prepared, rows, &watcher.part(items - left.len(), count, items))
        };
        let computed = computed.map_err(|failure| match failure {
            Failure::Interrupted(_) => interrupted(path, finished.done(), items),
            other => other,
        })?;
        if let Some(journal) = &mut journal {
            for (index, row) in (*first..).zip(&computed) {
                journal.append(index, row)?;
            }
            journal.sync()?;
        }
        finished.extend((*first..).zip(computed));
        left = &left[count..];
        // No row depends on what is computed with it.
        match began.elapsed() {
            fast if fast < SHORT => together = (2 * together).min(most),
            slow if slow > LONG => together = (together / 2).max(1),
            _ => {}
        }
    }
    Ok(finished.into_results()?)
}

/// Says which rows are kept, and how to resume.
fn interrupted(journal: Option<&Path>, done: u64, items: usize) -> Failure {
    Failure::Interrupted(match journal {
        Some(path) => format!(
            "interrupted: {done} of {items} rows are kept in {}; the same command resumes from there",
            path.display()
        ),
        None => format!(
            "interrupted after {done} of {items} rows; nothing is kept. With --journal FILE the same command resumes \
             where it was"
        ),
    })
}

/// The format of the file of a part.
const CHUNK: Format = Format { name: "bouncing-disk chunk", version: 2, oldest: 2 };

/// The largest file of a part that is read (bytes).
const LARGEST: u64 = 1 << 34;

/// The fields of the file of a part: it says what it belongs to, and has digests of the job and of its rows.
fn chunk_fields<J: GridJob>(
    job: &J,
    chunk: Chunk,
    range: Range<usize>,
    rows: &[J::Row],
) -> Result<Vec<(&'static str, Data)>, Failure> {
    let job = value(job)?;
    let provenance =
        Provenance::new(CHUNK).written_by(PROGRAM, VERSION).with("command", J::COMMAND)?.with("job", &job)?;
    let rows = value(rows)?;
    Ok(vec![
        ("provenance", stored(&provenance)?),
        ("job_digest", json!(digest(&job.to_string())).into()),
        ("chunk", stored(&chunk)?),
        ("first_row", json!(range.start).into()),
        ("end_row", json!(range.end).into()),
        ("rows_digest", json!(rows_digest(chunk, &range, &rows.to_string())).into()),
        ("rows", rows.into()),
    ])
}

/// The digest of compact JSON, whose keys are sorted.
fn digest(text: &str) -> String {
    Digest::of(text.as_bytes()).to_string()
}

/// The digest of rows with their place, so that those of two parts cannot be changed for each other.
fn rows_digest(chunk: Chunk, range: &Range<usize>, rows: &str) -> String {
    digest(&(json!([chunk.index, chunk.count, range.start, range.end]).to_string() + rows))
}

/// The file of a part, beside its provenance.
#[derive(Deserialize)]
struct ChunkFile {
    job_digest: String,
    chunk: Chunk,
    first_row: usize,
    end_row: usize,
    rows_digest: String,
    rows: Value,
}

/// A part that was read.
#[derive(Debug)]
pub(crate) struct Part {
    /// The name of its file, for messages.
    name: String,
    provenance: Provenance,
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
        let broken = |error: serde_json::Error| refuse(&format!("it is no whole chunk: {error}"));
        let bytes = regular_file::read(path, LARGEST)
            .map_err(|error| refuse(&format!("it cannot be read: {error}")))?;
        let stored: Value = serde_json::from_slice(&bytes).map_err(broken)?;
        let provenance = Provenance::read(CHUNK, &stored["provenance"], path)?;
        // Its rows would pass for results of this version.
        if provenance.version() != VERSION {
            let theirs = provenance.version();
            return Err(refuse(&format!(
                "it is of version {theirs} of the program, which this version, {VERSION}, does not continue; merge it with {theirs}"
            )));
        }
        let file: ChunkFile = serde_json::from_value(stored).map_err(broken)?;
        let (chunk, range) = (file.chunk, file.first_row..file.end_row);
        let job = provenance.parameters().get("job").unwrap_or(&Value::Null);
        for (what, own, found) in [
            ("job_digest", &file.job_digest, digest(&job.to_string())),
            ("rows_digest", &file.rows_digest, rows_digest(chunk, &range, &file.rows.to_string())),
        ] {
            if *own != found {
                return Err(refuse(&format!("it is damaged: its {what} is not that of its content")));
            }
        }
        let Value::Array(rows) = file.rows else { return Err(refuse("it has no rows")) };
        let Chunk { index, count } = chunk;
        if !(1..=count).contains(&index) || range.start.checked_add(rows.len()) != Some(range.end) {
            return Err(refuse(&format!(
                "it does not fit together: chunk {index} of {count}, rows {} to {}, and {} of them",
                range.start,
                range.end,
                rows.len()
            )));
        }
        Ok(Self { name, provenance, chunk, range, rows })
    }

    /// The command that it is a part of.
    pub(crate) fn command(&self) -> &str {
        self.provenance.parameters().get("command").and_then(Value::as_str).unwrap_or_default()
    }

    /// What all parts of a computation have in common.
    fn computation(&self) -> Value {
        json!({
            "command": self.command(),
            "job": self.provenance.parameters().get("job"),
            "number of chunks": self.chunk.count,
        })
    }
}

/// The result of all parts, which are those of one job of this type.
///
/// # Errors
/// [`Failure::Usage`] names the parts that are missing, doubled or foreign; those of the library.
pub(crate) fn merged<J: GridJob>(mut parts: Vec<Part>, observer: &dyn Observer) -> Result<Report, Failure> {
    let computation = check(&mut parts)?;
    let unreadable =
        |name: &str, error: &serde_json::Error| Failure::usage(format!("{name}: it cannot be read: {error}"));
    let job = J::deserialize(&computation["job"]).map_err(|error| unreadable(&parts[0].name, &error))?;
    let total = job.rows();
    let mut rows = Vec::new();
    for part in parts {
        let (Range { start, end }, expected) = (part.range.clone(), part.chunk.rows(total));
        if part.range != expected {
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

/// Sorts the parts, if they are all parts of one computation, each once, and gives what they have in common.
fn check(parts: &mut [Part]) -> Result<Value, Failure> {
    let Some(first) = parts.first() else { return Err(Failure::usage("there are no chunks")) };
    let computation = first.computation();
    for part in parts.iter() {
        if let Some((what, found, expected)) = difference(&part.computation(), &computation, "its") {
            return Err(Failure::usage(format!(
                "{} is of another computation: {what} is {found}, where {} has {expected}",
                part.name, first.name
            )));
        }
    }
    let count = first.chunk.count;
    parts.sort_by_key(|part| part.chunk.index);
    for pair in parts.windows(2) {
        if pair[0].chunk == pair[1].chunk {
            return Err(Failure::usage(format!(
                "chunk {} is there twice: {} and {}",
                pair[0].chunk.index, pair[0].name, pair[1].name
            )));
        }
    }
    let missing = count - parts.len();
    if missing > 0 {
        let is_there = |index: &usize| parts.binary_search_by_key(index, |part| part.chunk.index).is_ok();
        let absent = (1..=count).filter(|index| !is_there(index)).take(20);
        let shown: Vec<_> = absent.map(|index| format!("{index}/{count}")).collect();
        let more = missing - shown.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        return Err(Failure::usage(format!("chunks are missing: {}{more}", shown.join(", "))));
    }
    Ok(computation)
}

/// Where two values differ first, with what they have there.
fn difference(found: &Value, expected: &Value, path: &str) -> Option<(String, String, String)> {
    if let (Value::Object(one), Value::Object(other)) = (found, expected) {
        return one.keys().chain(other.keys()).find_map(|name| {
            let (one, other) = (&found[name], &expected[name]);
            let separator = if path == "its" { ' ' } else { '.' };
            difference(one, other, &format!("{path}{separator}{name}"))
        });
    }
    let short = |value: &Value| match value {
        Value::String(text) => text.clone(),
        other => other.to_string().chars().take(80).collect(),
    };
    (found != expected).then(|| (path.to_owned(), short(found), short(expected)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_cover_all_rows_once() {
        for rows in [0, 1, 2, 7, 100] {
            for count in [1, 2, 3, 7, 13] {
                let all: Vec<usize> =
                    (1..=count).flat_map(|index| Chunk { index, count }.rows(rows)).collect();
                assert_eq!(all, (0..rows).collect::<Vec<_>>(), "{rows} rows in {count}");
            }
        }
        assert_eq!("2/10".parse(), Ok(Chunk { index: 2, count: 10 }));
        for text in ["", "1", "0/3", "4/3", "1/0", "-1/3", "a/b", "1/2/3"] {
            assert!(text.parse::<Chunk>().is_err(), "{text}");
        }
    }

    #[test]
    fn of_many_parts_that_are_missing_the_first_are_named() {
        let part = Part {
            name: "part-1.json".to_owned(),
            provenance: Provenance::new(CHUNK),
            chunk: Chunk { index: 1, count: 100 },
            range: 0..0,
            rows: Vec::new(),
        };
        let Err(Failure::Usage(text)) = check(&mut [part]) else { panic!("accepted") };
        assert!(
            text.starts_with("chunks are missing: 2/100, 3/100") && text.ends_with("and 79 more"),
            "{text}"
        );
    }
}
