//! What has been measured on one processor, as it is stored in `data/performance`.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::process::Command;

use anyhow::Context as _;
use bouncing_disk_experiments::output::OutputFolder;
use bouncing_disk_experiments::provenance::{self, Provenance};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::criterion::{Times, parsed};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Record {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    provenance: Option<Provenance>,
    pub(super) processor: String,
    /// The best vector instructions that the processor has and the library uses.
    pub(super) instructions: String,
    /// How many processors the benches could use.
    pub(super) processors: usize,
    pub(super) compiler: String,
    /// The source, as Git describes it.
    pub(super) source: String,
    /// How many runs of the benches the times are the least of.
    pub(super) passes: u32,
    /// Wall time (s) of the first build of a crate that depends on the model, if it was measured.
    pub(super) first_build_s: Option<f64>,
    /// The least median (ns) of each bench.
    pub(super) times_ns: Times,
}

impl Record {
    /// Of this processor, nothing measured yet.
    pub(super) fn here(root: &Path, passes: u32) -> anyhow::Result<Self> {
        let about = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let version = Command::new("rustc").arg("--version").output().context("cannot start rustc")?;
        Ok(Self {
            provenance: Some(provenance::new(provenance::PERFORMANCE)),
            processor: processor(&about).unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            instructions: instructions().to_owned(),
            processors: std::thread::available_parallelism().map_or(1, NonZeroUsize::get),
            compiler: String::from_utf8_lossy(&version.stdout).trim().to_owned(),
            source: super::git(root, &["describe", "--always", "--dirty"])?,
            passes,
            first_build_s: None,
            times_ns: Times::new(),
        })
    }

    /// What heads its column.
    pub(super) fn heading(&self) -> String {
        format!("{}, {}", self.processor, self.instructions)
    }

    fn file_name(&self) -> String {
        let heading = self.heading().to_lowercase();
        let words: Vec<_> =
            heading.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
        format!("{}.json", words.join("-"))
    }

    /// All that are stored in a folder, in the order of the file names.
    pub(super) fn all(folder: &Path) -> anyhow::Result<Vec<Self>> {
        let entries = fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()))?;
        let mut paths = entries.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
        paths.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
        paths.sort();
        paths.iter().map(|path| Self::read(path)).collect()
    }

    fn read(path: &Path) -> anyhow::Result<Self> {
        let stored: Value = parsed(path)?;
        let name = path.to_string_lossy();
        provenance::refuse_newer(provenance::PERFORMANCE, stored.get("provenance"), &name)?;
        Self::deserialize(stored).with_context(|| format!("{} does not have the right form", path.display()))
    }

    /// Stores it beside the others.
    pub(super) fn store(&self, folder: &OutputFolder) -> anyhow::Result<()> {
        let mut text = serde_json::to_vec_pretty(self).context("the record cannot be written as JSON")?;
        text.push(b'\n');
        Ok(folder.write(&self.file_name(), &text)?)
    }
}

#[cfg(target_arch = "x86_64")]
fn instructions() -> &'static str {
    match (is_x86_feature_detected!("avx512f"), is_x86_feature_detected!("avx2")) {
        (true, _) => "AVX-512",
        (false, true) => "AVX2",
        (false, false) => "baseline",
    }
}

#[cfg(not(target_arch = "x86_64"))]
const fn instructions() -> &'static str {
    "baseline"
}

/// Name, family and model: a name like "AMD EPYC" alone is that of very different processors.
fn processor(about: &str) -> Option<String> {
    let field = |name: &str| {
        let value = |line: &str| {
            let (key, value) = line.split_once(':')?;
            (key.trim() == name).then(|| value.trim().to_owned())
        };
        about.lines().find_map(value)
    };
    Some(format!("{} ({}/{})", field("model name")?, field("cpu family")?, field("model")?))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::bench) fn record(times: &[(&str, f64)]) -> Record {
        Record {
            provenance: Some(provenance::new(provenance::PERFORMANCE)),
            processor: "A Processor (1/2)".to_owned(),
            instructions: "AVX-512".to_owned(),
            processors: 2,
            compiler: "rustc".to_owned(),
            source: "0123456".to_owned(),
            passes: 8,
            first_build_s: Some(30.0),
            times_ns: times.iter().map(|(name, time)| ((*name).to_owned(), *time)).collect(),
        }
    }

    #[test]
    fn records_are_stored_and_read() {
        let path = std::env::temp_dir().join(format!("bouncing-disk-record-{}", std::process::id()));
        let folder = OutputFolder::create(&path).expect("writable");
        let record = record(&[("w1/scalar", 150.0)]);
        record.store(&folder).expect("writable");
        fs::write(path.join("README.md"), "not a record").expect("writable");
        assert_eq!(Record::all(&path).expect("readable"), [record]);
        let stored = path.join("a-processor-1-2-avx-512.json");
        fs::write(&stored, r#"{"processor": 3}"#).expect("writable");
        let error = Record::all(&path).expect_err("malformed");
        assert!(format!("{error:#}").contains("a-processor-1-2-avx-512.json"), "{error:#}");
        let newer = provenance::new(provenance::Format { version: 2, ..provenance::PERFORMANCE });
        fs::write(&stored, serde_json::json!({ "provenance": newer }).to_string()).expect("writable");
        let error = format!("{:#}", Record::all(&path).expect_err("newer"));
        assert!(error.contains("2-avx-512.json\" has version 2 of the format"), "{error}");
        fs::remove_dir_all(&path).expect("removable");
    }

    #[test]
    fn a_processor_is_told_by_name_family_and_model() {
        let about = "cpu family\t: 26\nmodel\t\t: 2\nmodel name\t: AMD EPYC\n\nmodel\t\t: 3\n";
        assert_eq!(processor(about).as_deref(), Some("AMD EPYC (26/2)"));
        assert_eq!(processor(""), None);
    }
}
