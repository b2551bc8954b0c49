//! Computations of many rows: in one go, in parts on several machines, or with a journal that they go on
//! from.
//!
//! A row is computed the same, to the last bit, whatever others are computed with it. So the result does not
//! depend on how the rows were divided.

pub(crate) mod chunk;

use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};

use bouncing_disk::core::sweep::PartialResults;
use bouncing_disk::{JOURNAL, Journal, Observer, Provenance};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::arguments::{GridArgs, OutputArgs};
use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::files::{Kind, check_place};
use crate::output::json;
use crate::output::report::{PROGRAM, Report, VERSION, wrote};

/// The first rows are so many times fewer than the most that are computed together.
const FIRST_SHARE: usize = 256;

/// How long rows are computed together: as much is lost by an interruption.
const SHORT: Duration = Duration::from_millis(300);
const LONG: Duration = Duration::from_millis(1_200);

/// A computation of many rows. Stored, it has all that its rows depend on.
pub(crate) trait GridJob: Serialize + DeserializeOwned {
    /// The command, as it is written on the line.
    const COMMAND: &'static str;

    /// What is known of a row when it is computed.
    type Row: Serialize + DeserializeOwned;

    /// What is worked out once for all rows.
    type Prepared;

    /// Number of rows.
    fn rows(&self) -> usize;

    /// Most rows that are computed together: they are kept, or begun again, together.
    fn together(&self) -> usize;

    /// Works out what all rows need.
    ///
    /// # Errors
    /// Those of the library, also for a job that is not legal.
    fn prepare(&self, observer: &dyn Observer) -> Result<Self::Prepared, Failure>;

    /// Computes rows.
    ///
    /// # Errors
    /// Those of the library.
    fn compute(
        &self,
        prepared: &Self::Prepared,
        rows: Range<usize>,
        observer: &dyn Observer,
    ) -> Result<Vec<Self::Row>, Failure>;

    /// The result of all rows.
    ///
    /// # Errors
    /// Those of the library, and what cannot be stored.
    fn report(self, prepared: Self::Prepared, rows: Vec<Self::Row>) -> Result<Report, Failure>;
}

/// Computes a job, or its part, and delivers what comes out; `inputs` are the files that the job was read
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
    let mut watcher = context.watch(J::COMMAND);
    let prepared = job.prepare(&watcher)?;
    let mut kept = Kept::open(&job, range.clone(), grid.journal.as_deref())?;
    kept.compute_all(&job, &prepared, &mut watcher)?;
    drop(watcher);
    let computed = kept.into_rows()?;
    match grid.chunk {
        Some(chunk) => {
            let target = &output.out[0];
            let fields = chunk::fields(&job, chunk, range, &computed)?;
            target
                .write(output.force, |to| json::write(to, fields.iter().map(|(name, data)| (*name, data))))?;
            wrote(target, context.quiet);
            Ok(())
        }
        None => job.report(prepared, computed)?.deliver(output, context.quiet),
    }
}

/// Whether there is room for `count` <= `limit` things of so many bytes each, in which all rows end: better
/// told now than after a day of computing.
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

/// Rows that are computed, and where they are kept.
struct Kept<R> {
    range: Range<usize>,
    finished: PartialResults<R>,
    journal: Option<Journal<R>>,
}

impl<R: Serialize + DeserializeOwned> Kept<R> {
    fn open<J: GridJob<Row = R>>(
        job: &J,
        range: Range<usize>,
        journal: Option<&Path>,
    ) -> Result<Self, Failure> {
        let items = range.len();
        let Some(path) = journal else {
            return Ok(Self { range, finished: PartialResults::new(items), journal: None });
        };
        let key = Provenance::new(JOURNAL)
            .written_by(PROGRAM, VERSION)
            .with("command", J::COMMAND)?
            .with("job", job)?
            .with("rows", &[range.start, range.end])?;
        let (journal, finished) = Journal::open(path, &key, items)?;
        Ok(Self { range, finished, journal: Some(journal) })
    }

    fn compute_all<J: GridJob<Row = R>>(
        &mut self,
        job: &J,
        prepared: &J::Prepared,
        watcher: &mut crate::progress::Watcher,
    ) -> Result<(), Failure> {
        let items = self.range.len();
        let open = self.finished.open(items)?;
        let mut left = &open[..];
        let most = job.together().max(1);
        let mut together = (most / FIRST_SHARE).max(1);
        while let Some(first) = left.first() {
            // Rows that follow each other, as far as they are open.
            let run = left.iter().zip(*first..).take_while(|(index, next)| *index == next).count();
            let count = run.min(together);
            let began = Instant::now();
            watcher.set_parts(items - left.len(), items);
            let rows = self.range.start + first..self.range.start + first + count;
            let computed = if interrupt::came() {
                Err(Failure::Interrupted(String::new()))
            } else {
                job.compute(prepared, rows, &watcher.part(count))
            };
            let computed = computed.map_err(|failure| match failure {
                Failure::Interrupted(_) => self.interrupted(items),
                other => other,
            })?;
            if let Some(journal) = &mut self.journal {
                for (index, row) in (*first..).zip(&computed) {
                    journal.append(index, row)?;
                }
                journal.sync()?;
            }
            self.finished.extend((*first..).zip(computed));
            left = &left[count..];
            // No row depends on what is computed with it.
            match began.elapsed() {
                fast if fast < SHORT => together = (2 * together).min(most),
                slow if slow > LONG => together = (together / 2).max(1),
                _ => {}
            }
        }
        Ok(())
    }

    /// What is kept, and how to go on.
    fn interrupted(&self, items: usize) -> Failure {
        let done = self.finished.done();
        Failure::Interrupted(match &self.journal {
            Some(journal) => format!(
                "interrupted: {done} of {items} rows are kept in {}; the same command goes on from there",
                journal.path().display()
            ),
            None => format!(
                "interrupted after {done} of {items} rows; nothing is kept. With --journal FILE the same command goes \
                 on where it was"
            ),
        })
    }

    fn into_rows(self) -> Result<Vec<R>, Failure> {
        Ok(self.finished.into_results()?)
    }
}
