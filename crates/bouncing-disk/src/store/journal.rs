//! The journal of a long computation.

use std::collections::BTreeSet;
use std::fs::{File, TryLockError};
use std::io::{self, BufRead, BufReader, Read as _, Seek as _, SeekFrom, Write as _};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

use bouncing_disk_core::numerics::digest::Digest;
use bouncing_disk_core::sweep::PartialResults;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::store::error::StorageError;
use crate::store::provenance::{Format, Provenance};

/// The format of a [`Journal`]. In every later version, too, the first line will be an object whose
/// `provenance` names format, version and program.
pub const JOURNAL: Format = Format { name: "bouncing-disk journal", version: 1, oldest: 1 };

/// The file of a long computation of many items. Finished results are appended; existing lines never change.
///
/// The file is text. The first line is the key: the [`Provenance`] of the computation and the number of its
/// items. Each further line is the result of one item. Every line is a JSON object with a digest of the rest
/// of the line, so that other programs can read it and changes are detected.
///
/// A killed process leaves at most half a line, which is removed when the journal is opened again; no
/// finished result is lost. (A power cut may lose everything appended since the last [`Self::sync`].) A
/// journal of another computation, or with results of another version of the program, is an error: one
/// version must compute all results. Only one journal at a time can write to a file; opening a second one is
/// an error while the first exists, in any process. The lock belongs to the operating system and ends with
/// the process.
///
/// ```
/// use bouncing_disk::store::{JOURNAL, Journal, Provenance, StorageError};
///
/// # let path = std::env::temp_dir().join(format!("journal-example-{}", std::process::id()));
/// # let _ = std::fs::remove_file(&path);
/// // The key of the computation: it must contain everything on which the results depend.
/// let roots = Provenance::new(JOURNAL).with("quantity", "square roots")?.with("first", &2.0)?;
/// let square_root = |index: usize| (2.0 + index as f64).sqrt();
/// {
///     let (mut journal, _) = Journal::<f64>::open(&path, &roots, 1_000)?;
///     for index in 0..400 {
///         journal.append(index, &square_root(index))?;
///     }
///     // Here the process is killed.
/// }
///
/// // The next process continues from there.
/// let (mut journal, mut finished) = Journal::open(&path, &roots, 1_000)?;
/// assert_eq!(finished.done(), 400);
/// for index in finished.open(1_000)? {
///     journal.append(index, &square_root(index))?;
///     finished.extend([(index, square_root(index))]);
/// }
/// let expected: Vec<f64> = (0..1_000).map(square_root).collect();
/// assert_eq!(finished.into_results()?, expected);
/// # drop(journal);
///
/// // Other parameters define another computation.
/// let others = Provenance::new(JOURNAL).with("quantity", "square roots")?.with("first", &3.0)?;
/// let error = Journal::<f64>::open(&path, &others, 1_000).expect_err("of another key");
/// assert!(error.to_string().ends_with("its provenance.parameters.first is 2.0, but 3.0 is requested"));
/// # std::fs::remove_file(&path).expect("removable");
/// # Ok::<(), StorageError>(())
/// ```
#[derive(Debug)]
pub struct Journal<T> {
    path: PathBuf,
    file: Locked,
    /// Whether a failed write may have left bytes after the last whole line.
    torn: bool,
    /// Total length of the whole lines (bytes).
    length: u64,
    items: usize,
    finished: BTreeSet<usize>,
    results: PhantomData<fn(T) -> T>,
}

/// A file that is locked while it is open.
///
/// The lock is released explicitly instead of by closing the file: a process that is just being started
/// briefly holds a copy of every open file, and would extend the lock.
#[derive(Debug)]
struct Locked(File);

impl Drop for Locked {
    fn drop(&mut self) {
        // If this fails, the operating system ends the lock with the process.
        let _ = self.0.unlock();
    }
}

/// A line with the result of an item, after its digest.
#[derive(Serialize)]
struct Body<'a, T> {
    index: usize,
    result: &'a T,
}

/// A line with the result of an item.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[serde(bound(deserialize = "T: DeserializeOwned"))]
struct Entry<T> {
    #[serde(rename = "digest")]
    _digest: String,
    index: usize,
    result: T,
}

/// The contents of a journal.
struct Contents<T> {
    /// Total length of the whole lines (bytes).
    length: u64,
    results: Vec<(usize, T)>,
}

impl<T: Serialize + DeserializeOwned> Journal<T> {
    /// Opens or creates the journal of a computation of `items`, and returns the finished results.
    ///
    /// `key` is a provenance of the format [`JOURNAL`] and names everything on which the results depend. A
    /// file that is not a journal is left unchanged.
    ///
    /// # Errors
    /// [`StorageError::Busy`] if another journal has it open; [`StorageError::OtherKey`] for a journal of
    /// another computation; [`StorageError::NewerFormat`] and the other errors of [`Provenance::read`];
    /// [`StorageError::Damaged`] and [`StorageError::Result`] for a line that cannot be read;
    /// [`StorageError::Io`] for errors of the operating system, including file systems without locks.
    pub fn open(
        path: impl AsRef<Path>,
        key: &Provenance,
        items: usize,
    ) -> Result<(Self, PartialResults<T>), StorageError> {
        let path = path.as_ref();
        let header = header(key, items, path)?;
        let failed = |action| move |source| StorageError::Io { action, path: path.to_owned(), source };
        let mut options = File::options();
        let file = options.read(true).write(true).create(true).truncate(false).open(path);
        let file = file.map_err(failed("open"))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(StorageError::Busy { path: path.to_owned() }),
            Err(TryLockError::Error(source)) => return Err(failed("lock")(source)),
        }
        let file = Locked(file);
        let Contents { length, results } = read(&file.0, path, &header, items)?;
        let finished = results.iter().map(|(index, _)| *index).collect();
        let (path, torn) = (path.to_owned(), false);
        let mut journal = Self { path, file, torn, length, items, finished, results: PhantomData };
        journal.file.0.set_len(length).map_err(failed("write"))?;
        if length == 0 {
            journal.write(&header)?;
            journal.sync()?;
        }
        Ok((journal, partial(items, results)))
    }

    /// Reads a journal without writing to it, to watch the progress or to combine the journals of several
    /// machines. Another process may write meanwhile, unless the system's locks forbid it, as on Windows.
    ///
    /// # Errors
    /// The errors of [`Self::open`] except [`StorageError::Busy`].
    pub fn read(
        path: impl AsRef<Path>,
        key: &Provenance,
        items: usize,
    ) -> Result<PartialResults<T>, StorageError> {
        let path = path.as_ref();
        let failed = |source| StorageError::Io { action: "open", path: path.to_owned(), source };
        // Opening a pipe would wait for a writer.
        check_regular(&std::fs::metadata(path).map_err(failed)?, path)?;
        let file = File::open(path).map_err(failed)?;
        Ok(partial(items, read(&file, path, &header(key, items, path)?, items)?.results))
    }

    /// Appends the result of an item. An existing result is kept.
    ///
    /// A number that is not finite is an error, except in an `Option`, where JSON turns it into `None`.
    ///
    /// # Errors
    /// [`StorageError::NoSuchItem`]; [`StorageError::NotStorable`] for a result that could not be read back;
    /// [`StorageError::Io`] for errors of the operating system, such as a full disk, which leave the journal
    /// unchanged.
    pub fn append(&mut self, index: usize, result: &T) -> Result<(), StorageError> {
        self.append_all([(index, result)])
    }

    /// Appends the missing results of a run with a single system call, and ensures that they are on the disk.
    ///
    /// # Errors
    /// The errors of [`Self::append`].
    pub fn record(&mut self, results: &PartialResults<T>) -> Result<(), StorageError> {
        self.append_all(results.iter())?;
        self.sync()
    }

    fn append_all<'r>(
        &mut self,
        results: impl IntoIterator<Item = (usize, &'r T)>,
    ) -> Result<(), StorageError>
    where
        T: 'r,
    {
        let (mut lines, mut indices) = (Vec::new(), Vec::new());
        for (index, result) in results {
            if index >= self.items {
                return Err(StorageError::NoSuchItem { index, items: self.items });
            }
            if self.finished.contains(&index) {
                continue;
            }
            let failed =
                |source| StorageError::NotStorable { what: format!("the result of item {index}"), source };
            let line = line(&serde_json::to_vec(&Body { index, result }).map_err(failed)?);
            serde_json::from_slice::<Entry<T>>(&line).map_err(failed)?;
            lines.extend(line);
            indices.push(index);
        }
        self.write(&lines)?;
        self.finished.extend(indices);
        Ok(())
    }

    fn write(&mut self, lines: &[u8]) -> Result<(), StorageError> {
        let file = &mut self.file.0;
        let cut = if self.torn { file.set_len(self.length) } else { Ok(()) };
        let placed = cut.and_then(|()| file.seek(SeekFrom::Start(self.length)));
        match placed.and_then(|_| file.write_all(lines)) {
            Ok(()) => {
                self.torn = false;
                self.length += lines.len() as u64;
                Ok(())
            }
            Err(source) => {
                // Half a line is removed now, or otherwise before the next one is written or the journal is
                // opened again.
                self.torn = file.set_len(self.length).is_err();
                Err(StorageError::Io { action: "write", path: self.path.clone(), source })
            }
        }
    }

    /// Waits until everything appended is on the disk, safe from a power cut. A journal survives a killed
    /// process without this.
    ///
    /// # Errors
    /// [`StorageError::Io`] for errors of the operating system.
    pub fn sync(&self) -> Result<(), StorageError> {
        let failed = |source| StorageError::Io { action: "write", path: self.path.clone(), source };
        self.file.0.sync_data().map_err(failed)
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of items whose results are stored.
    #[must_use]
    pub fn done(&self) -> usize {
        self.finished.len()
    }

    /// Number of items of the computation.
    #[must_use]
    pub const fn items(&self) -> usize {
        self.items
    }
}

fn partial<T>(items: usize, results: Vec<(usize, T)>) -> PartialResults<T> {
    let mut partial = PartialResults::new(items);
    partial.extend(results);
    partial
}

/// The first line.
fn header(key: &Provenance, items: usize, path: &Path) -> Result<Vec<u8>, StorageError> {
    if key.format() != JOURNAL.name || key.format_version() != JOURNAL.version {
        let found = key.format().to_owned();
        return Err(StorageError::OtherFormat { file: path.to_owned(), expected: JOURNAL.name, found });
    }
    let failed = |source| StorageError::NotStorable { what: "the key of a journal".to_owned(), source };
    let body = serde_json::to_vec(&json!({ "items": items, "provenance": key })).map_err(failed)?;
    Ok(line(&body))
}

/// Longest first line (bytes).
const LONGEST_KEY: u64 = 1 << 26;

/// The text before and after the digest of a line.
const BEFORE_DIGEST: &[u8] = b"{\"digest\":\"";
const AFTER_DIGEST: &[u8] = b"\",";

/// The line of an object, with a digest of everything after it, and a newline.
fn line(object: &[u8]) -> Vec<u8> {
    let rest = object.get(1..).unwrap_or_default();
    let digest = Digest::of(rest).to_string();
    [BEFORE_DIGEST, digest.as_bytes(), AFTER_DIGEST, rest, b"\n"].concat()
}

/// Whether a line, without its newline, is as it was written.
fn is_intact(line: &[u8]) -> bool {
    let rest = line.strip_prefix(BEFORE_DIGEST).and_then(|line| line.split_at_checked(16));
    let split = rest.and_then(|(digest, rest)| Some((digest, rest.strip_prefix(AFTER_DIGEST)?)));
    split.is_some_and(|(digest, rest)| Digest::of(rest).to_string().as_bytes() == digest)
}

/// Reads a journal up to its last whole line.
fn read<T: DeserializeOwned>(
    file: &File,
    path: &Path,
    expected: &[u8],
    items: usize,
) -> Result<Contents<T>, StorageError> {
    let failed = |source| StorageError::Io { action: "read", path: path.to_owned(), source };
    check_regular(&file.metadata().map_err(failed)?, path)?;
    let mut reader = BufReader::new(file);
    let mut contents = Contents { length: 0, results: Vec::new() };
    let mut bytes = Vec::new();
    for number in 1_u64.. {
        bytes.clear();
        // Avoids reading gigabytes of a file without newlines, which is no journal.
        let longest = if number == 1 { LONGEST_KEY } else { u64::MAX };
        let length = reader.by_ref().take(longest).read_until(b'\n', &mut bytes).map_err(failed)?;
        let Some((b'\n', text)) = bytes.split_last() else {
            // A partial key may belong to this journal only if it agrees so far.
            if number == 1 && !expected.starts_with(&bytes) {
                return Err(no_journal(path));
            }
            break;
        };
        if number == 1 {
            check_header(text, expected, path)?;
        } else {
            if !is_intact(text) {
                return Err(StorageError::Damaged { path: path.to_owned(), line: number });
            }
            let unfit = |source| StorageError::Result { path: path.to_owned(), line: number, source };
            let Entry { index, result, .. } = serde_json::from_slice(text).map_err(unfit)?;
            if index >= items {
                return Err(StorageError::NoSuchItem { index, items });
            }
            contents.results.push((index, result));
        }
        contents.length += length as u64;
    }
    Ok(contents)
}

fn check_regular(file: &std::fs::Metadata, path: &Path) -> Result<(), StorageError> {
    if file.is_file() {
        return Ok(());
    }
    let source = io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file");
    Err(StorageError::Io { action: "read", path: path.to_owned(), source })
}

fn no_journal(path: &Path) -> StorageError {
    StorageError::OtherFormat { file: path.to_owned(), expected: JOURNAL.name, found: String::new() }
}

/// Checks the format first, as the rest may differ in a later version.
fn check_header(found: &[u8], expected: &[u8], path: &Path) -> Result<(), StorageError> {
    let key = |line: &[u8]| serde_json::from_slice::<Value>(line).map_err(|_| no_journal(path));
    let (stored, wanted) = (key(found)?, key(expected)?);
    Provenance::read(JOURNAL, &stored["provenance"], path)?;
    if !is_intact(found) {
        return Err(StorageError::Damaged { path: path.to_owned(), line: 1 });
    }
    let parts = |key: &Value| json!({ "items": key["items"], "provenance": key["provenance"] });
    // The version comes first, because other differences between versions do not help to find the right
    // program.
    let version = |key: &Value| json!({ "provenance": { "version": key["provenance"]["version"] } });
    let differ =
        |of: &dyn Fn(&Value) -> Value| first_difference(&of(&stored), &of(&wanted), &mut String::new());
    match differ(&version).or_else(|| differ(&parts)) {
        None => Ok(()),
        Some(Difference { field, found, expected }) => {
            Err(StorageError::OtherKey { path: path.to_owned(), field, found, expected })
        }
    }
}

struct Difference {
    field: String,
    found: String,
    expected: String,
}

/// The first place at which two values differ; `field` leads to the values.
fn first_difference(found: &Value, expected: &Value, field: &mut String) -> Option<Difference> {
    let length = field.len();
    match (found, expected) {
        (Value::Object(left), Value::Object(right)) => {
            let names: BTreeSet<_> = left.keys().chain(right.keys()).collect();
            for name in names {
                if !field.is_empty() {
                    field.push('.');
                }
                field.push_str(name);
                let inside = match (left.get(name), right.get(name)) {
                    (Some(left), Some(right)) => first_difference(left, right, field),
                    (left, right) => Some(difference(left, right, field)),
                };
                if inside.is_some() {
                    return inside;
                }
                field.truncate(length);
            }
            None
        }
        (Value::Array(left), Value::Array(right)) if left.len() == right.len() => {
            for (index, (left, right)) in left.iter().zip(right).enumerate() {
                field.push_str(&format!("[{index}]"));
                let inside = first_difference(left, right, field);
                if inside.is_some() {
                    return inside;
                }
                field.truncate(length);
            }
            None
        }
        // Compared as text: 0 and -0 are equal numbers but different parameters.
        (found, expected) => {
            let [left, right] = [found, expected].map(Value::to_string);
            (left != right).then(|| difference(Some(found), Some(expected), field))
        }
    }
}

fn difference(found: Option<&Value>, expected: Option<&Value>, field: &str) -> Difference {
    let short = |value: Option<&Value>| value.map_or_else(|| "absent".to_owned(), short);
    Difference { field: field.escape_debug().to_string(), found: short(found), expected: short(expected) }
}

/// A value as JSON, shortened for a message.
fn short(value: &Value) -> String {
    const LONGEST: usize = 200;
    let text = value.to_string();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests;
