//! Computations of many rows: in one go, in parts on several machines, or with a journal from which they
//! resume.
//!
//! A row is the same to the last bit, whatever other rows are computed with it, so the result does not
//! depend on how the rows are divided.

use std::fs::{self, File};
use std::io::{self, BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use bouncing_disk::Observer;
use bouncing_disk::core::sweep::PartialResults;
use bouncing_disk::store::{JOURNAL, Journal, Provenance, StorageError};
use clap::Args;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::context::{Context, Watcher};
use crate::failure::{Failure, Result, unreadable};
use crate::interrupt;
use crate::output::files::{Kind, check_place};
use crate::output::{OutputArgs, PROGRAM, Report, VERSION};

/// Largest number of rows that are computed together. Their number doubles as long as rows are fast; later
/// ones may be slow.
const MOST_TOGETHER: usize = 4096;

/// How long a group of rows is computed: an interruption loses at most this much.
const SHORT: Duration = Duration::from_millis(300);
const LONG: Duration = Duration::from_millis(1_200);

/// How the rows of a grid are computed.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Long computations")]
pub(crate) struct GridArgs {
    /// Computes the I-th of N parts of the rows and writes it to --out FILE.json; `bouncing-disk merge`
    /// joins the parts
    #[arg(long, value_name = "I/N", allow_hyphen_values = true, value_parser = chunk)]
    chunk: Option<(usize, usize)>,
    /// Keeps finished rows in a file, from which the same command resumes after an interruption
    #[arg(long, value_name = "FILE")]
    journal: Option<PathBuf>,
}

/// A part of the rows of a grid, `2/10` on the command line: the second of ten.
fn chunk(text: &str) -> Result<(usize, usize), String> {
    let whole = |text: &str| text.trim().parse::<usize>().ok();
    let parts = text.split_once('/').and_then(|(index, count)| Some((whole(index)?, whole(count)?)));
    let legal = parts.filter(|(index, count)| (1..=*count).contains(index));
    legal.ok_or_else(|| "a chunk is I/N, from 1/N to N/N, such as 2/10".to_owned())
}

/// The rows of this part, of so many in total.
fn rows_of((index, count): (usize, usize), rows: usize) -> Rows {
    let upto = |parts: usize| (rows as u128 * parts as u128 / count as u128) as usize;
    upto(index - 1)..upto(index)
}

/// Consecutive rows.
pub(crate) type Rows = std::ops::Range<usize>;

/// A computation of many rows. Its stored form contains everything that the rows depend on.
pub(crate) trait GridJob: Serialize + DeserializeOwned {
    /// The command, as on the command line.
    const COMMAND: &'static str;

    type Row: Clone + Serialize + DeserializeOwned;

    /// Computed once, for all rows.
    type Prepared;

    fn rows(&self) -> usize;

    /// Checks the job, and computes the data that all rows share.
    fn prepare(&self, observer: &dyn Observer) -> Result<Self::Prepared>;

    fn compute(&self, from: &Self::Prepared, rows: Rows, observer: &dyn Observer) -> Result<Vec<Self::Row>>;

    /// The result of all rows.
    fn report<'a>(&'a self, prepared: &'a Self::Prepared, rows: &'a [Self::Row]) -> Result<Report<'a>>;
}

impl GridArgs {
    pub(crate) fn journal(&self) -> Option<&Path> {
        self.journal.as_deref()
    }

    /// Checks that the journal or the part can be written.
    pub(crate) fn check(&self, output: &OutputArgs) -> Result<()> {
        if let Some(path) = self.journal() {
            check_place(path).map_err(|why| Failure::Usage(format!("--journal: {why}")))?;
        }
        if self.chunk.is_some() && !matches!(&output.out[..], [target] if target.kind == Kind::Json) {
            return Err(Failure::Usage("--chunk needs exactly one --out FILE.json for its part".to_owned()));
        }
        Ok(())
    }
}

/// Computes a job, or its part, and delivers the result.
pub(crate) fn run<J: GridJob>(job: J, grid: &GridArgs, output: &OutputArgs, context: Context) -> Result<()> {
    let rows = job.rows();
    let range = grid.chunk.map_or(0..rows, |chunk| rows_of(chunk, rows));
    let watcher = context.watch(J::COMMAND);
    let prepared = job.prepare(&watcher)?;
    let finished = compute_all(&job, &prepared, range.clone(), grid.journal(), watcher)?;
    if grid.chunk.is_none() {
        return job.report(&prepared, &finished.into_results()?)?.deliver(output, context);
    }
    let key = key(&job)?;
    output.out[0].fill(output.force, context.quiet, |file| {
        let write = || {
            let (mut part, _) = Journal::open(file.path(), &key, rows)?;
            let mut own = finished.iter().filter(|(row, _)| range.contains(row));
            own.try_for_each(|(row, result)| part.append(row, result))
        };
        write().map_err(|error: StorageError| io::Error::other(error))
    })
}

/// The key of a journal or a part: everything that the rows depend on.
fn key<J: GridJob>(job: &J) -> Result<Provenance> {
    let key = Provenance::new(JOURNAL).written_by(PROGRAM, VERSION).with("command", J::COMMAND)?;
    Ok(key.with("job", job)?)
}

/// Checks that `count` <= `limit` items of this many bytes each fit into memory: an error now is
/// better than after a day of computing.
pub(crate) fn check_room(what: &'static str, count: u64, limit: u64, bytes: u64) -> Result<()> {
    let fits = |bytes: u64| {
        usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
    };
    if count <= limit && count.checked_mul(bytes).is_some_and(fits) {
        return Ok(());
    }
    Err(bouncing_disk::core::Error::TooLarge { what, count, limit }.into())
}

/// Computes the rows of a range that are not yet in the journal, if there is one.
fn compute_all<J: GridJob>(
    job: &J,
    prepared: &J::Prepared,
    range: Rows,
    path: Option<&Path>,
    watcher: Watcher,
) -> Result<PartialResults<J::Row>> {
    let (items, total) = (range.len(), job.rows());
    let (mut journal, mut finished) = match path {
        None => (None, PartialResults::new(total)),
        Some(path) => {
            let (journal, finished) = Journal::open(path, &key(job)?, total)?;
            (Some(journal), finished)
        }
    };
    let mut open = finished.open(total)?;
    open.retain(|row| range.contains(row));
    let mut left = &open[..];
    let mut together = 1;
    while let Some(first) = left.first() {
        // Consecutive open rows.
        let run = left.iter().zip(*first..).take_while(|(index, next)| *index == next).count();
        let count = run.min(together);
        let began = Instant::now();
        let done = items - left.len();
        if interrupt::came() {
            return Err(interrupted(path, done, items));
        }
        let computed = job.compute(prepared, *first..first + count, &watcher.part(done, count, items));
        let computed = computed.map_err(|failure| match failure {
            Failure::Interrupted(_) => interrupted(path, done, items),
            other => other,
        })?;
        finished.extend((*first..).zip(computed));
        if let Some(journal) = &mut journal {
            journal.record(&finished)?;
        }
        left = &left[count..];
        // No row depends on the others computed with it.
        match began.elapsed() {
            fast if fast < SHORT => together = (2 * together).min(MOST_TOGETHER),
            slow if slow > LONG => together = (together / 2).max(1),
            _ => {}
        }
    }
    Ok(finished)
}

fn interrupted(journal: Option<&Path>, done: usize, items: usize) -> Failure {
    Failure::Interrupted(match journal {
        Some(path) => format!(
            "interrupted: {done} of {items} rows are kept in {}; the same command resumes from there",
            path.display()
        ),
        None => format!(
            "interrupted after {done} of {items} rows; nothing is kept. With --journal FILE the same command would \
             resume there"
        ),
    })
}

/// Largest number of bytes in the first line of a part.
const LONGEST: u64 = 1 << 26;

/// The command and the job of the part in a file.
pub(crate) fn computation_of(path: &Path) -> Result<(String, Value)> {
    let refuse = |why: &str| Failure::Usage(format!("{}: {why}", path.display()));
    let refuse_file = |error: io::Error| unreadable(path, error);
    if !fs::metadata(path).map_err(refuse_file)?.is_file() {
        return Err(unreadable(path, "it is not a regular file"));
    }
    let mut line = String::new();
    BufReader::new(File::open(path).map_err(refuse_file)?.take(LONGEST))
        .read_line(&mut line)
        .map_err(refuse_file)?;
    let stored: Value = serde_json::from_str(&line)
        .map_err(|_| refuse("it is not a part of a computation written by --chunk of this version"))?;
    let provenance = Provenance::read(JOURNAL, &stored["provenance"], path)?;
    let of = |name: &str| provenance.parameters().get(name).cloned().unwrap_or_default();
    Ok((of("command").as_str().unwrap_or_default().to_owned(), of("job")))
}

/// Delivers the result of this job, whose rows are in these files.
pub(crate) fn merge<J: GridJob>(
    job: &Value,
    parts: &[PathBuf],
    output: &OutputArgs,
    context: Context,
) -> Result<()> {
    let job = J::deserialize(job).map_err(|error| unreadable(&parts[0], error))?;
    let (rows, key) = (job.rows(), key(&job)?);
    let mut finished = PartialResults::new(rows);
    for part in parts {
        computation_of(part)?;
        let part: PartialResults<J::Row> = Journal::read(part, &key, rows)?;
        finished.extend(part.iter().map(|(row, own)| (row, own.clone())));
    }
    let open = finished.open(rows)?;
    if let Some(first) = open.first() {
        let run = open.iter().zip(*first..).take_while(|(row, next)| *row == next).count();
        let (from, to, missing) = (first + 1, first + run, open.len());
        return Err(Failure::Usage(format!("{missing} of {rows} rows are missing, first {from} to {to}")));
    }
    let prepared = job.prepare(&context.watch("merge"))?;
    job.report(&prepared, &finished.into_results()?)?.deliver(output, context)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_cover_all_rows_once() {
        for rows in [0, 1, 2, 7, 100] {
            for count in [1, 2, 3, 7, 13] {
                let all: Vec<usize> = (1..=count).flat_map(|index| rows_of((index, count), rows)).collect();
                assert_eq!(all, (0..rows).collect::<Vec<_>>(), "{rows} rows in {count}");
            }
        }
        assert_eq!(chunk("2/10"), Ok((2, 10)));
        for text in ["", "1", "0/3", "4/3", "1/0", "-1/3", "a/b", "1/2/3"] {
            assert!(chunk(text).is_err(), "{text}");
        }
    }
}
