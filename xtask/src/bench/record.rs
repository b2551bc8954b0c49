//! What a run of the benches has measured, as it is stored.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context as _, bail};
use serde::{Deserialize, Serialize};

/// All times of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Record {
    pub(crate) machine: Machine,
    /// Whether the run was a short one, with wider intervals.
    pub(crate) quick: bool,
    /// By the name of the bench.
    pub(crate) benches: BTreeMap<String, Measured>,
    /// Wall times of `cargo xtask figures`, if they were measured.
    pub(crate) figures: Option<FigureTimes>,
    /// Wall time (s) of a release build of xtask from nothing, if it was measured.
    #[serde(default)]
    pub(crate) build_s: Option<f64>,
}

/// Where a run was made, and of what.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Machine {
    pub(crate) processor: String,
    /// How many processors this program may use.
    pub(crate) processors: usize,
    pub(crate) compiler: String,
    /// The source, as Git describes it.
    pub(crate) source: String,
}

/// Wall times of all figures and tables in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FigureTimes {
    pub(crate) draft_s: f64,
    pub(crate) paper_s: f64,
}

/// The kernel that a time is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Reference {
    /// Links that wait for each other, as the impacts of one orbit do.
    Chain,
    /// Polynomials of many numbers, which fill the arithmetic units as flights in lockstep do.
    Lanes,
}

impl Reference {
    pub(crate) const ALL: [Self; 2] = [Self::Chain, Self::Lanes];

    /// The one for a bench.
    pub(crate) fn of(bench: &str) -> Self {
        const IN_LOCKSTEP: [&str; 7] = [
            "w1/lanes/",
            "limit/pair/lanes/",
            "w2/ensemble/",
            "w3/threads_",
            "w3/panel_",
            "growth/cells/",
            "figures/fig07/",
        ];
        if IN_LOCKSTEP.iter().any(|prefix| bench.starts_with(prefix)) { Self::Lanes } else { Self::Chain }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Chain => "chain",
            Self::Lanes => "lanes",
        }
    }
}

/// The time of one bench.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Measured {
    /// Least median time (ns) of one element, with the ends of its 95 % confidence interval.
    pub(crate) low_ns: f64,
    pub(crate) median_ns: f64,
    pub(crate) high_ns: f64,
    /// The medians (ns) of all measurements in their order, the least one among them.
    pub(crate) medians_ns: Vec<f64>,
    /// The reference kernel.
    pub(crate) reference: Reference,
    /// Its time (ns) in the same program: the mean of before and after.
    pub(crate) reference_ns: f64,
    /// How much the reference differed between before and after, relative to its mean.
    pub(crate) reference_drift: f64,
}

impl Measured {
    /// The time in units of the reference kernel.
    pub(crate) fn ratio(&self) -> f64 {
        self.median_ns / self.reference_ns
    }

    /// How far the ratio may be off, relative to it.
    fn uncertainty(&self) -> f64 {
        0.5 * (self.high_ns - self.low_ns) / self.median_ns + 0.5 * self.reference_drift
    }

    /// The median (ns) of the medians of all measurements: what a single one is as likely to be below as above.
    pub(crate) fn middle_ns(&self) -> f64 {
        let mut medians = self.medians_ns.clone();
        medians.sort_by(f64::total_cmp);
        let half = medians.len() / 2;
        if medians.len() % 2 == 1 { medians[half] } else { 0.5 * (medians[half - 1] + medians[half]) }
    }

    fn add(&mut self, other: &Self) {
        self.medians_ns.extend(&other.medians_ns);
        if other.median_ns < self.median_ns {
            (self.low_ns, self.median_ns, self.high_ns) = (other.low_ns, other.median_ns, other.high_ns);
        }
        if other.reference_ns < self.reference_ns {
            (self.reference_ns, self.reference_drift) = (other.reference_ns, other.reference_drift);
        }
    }

    fn is_sound(&self) -> bool {
        let times = [self.low_ns, self.median_ns, self.high_ns, self.reference_ns];
        times.iter().all(|time| time.is_finite() && *time > 0.0)
            && self.low_ns <= self.median_ns
            && self.median_ns <= self.high_ns
            && self.reference_drift.is_finite()
            && self.medians_ns.contains(&self.median_ns)
            && self.medians_ns.iter().all(|median| median.is_finite() && *median >= self.median_ns)
    }
}

/// How a ratio differs from that of a baseline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Change {
    /// Relative change; negative is faster.
    pub(crate) relative: f64,
    /// What both uncertainties together explain.
    pub(crate) uncertainty: f64,
}

impl Change {
    /// None where they are ratios to different kernels.
    pub(crate) fn between(baseline: &Measured, now: &Measured) -> Option<Self> {
        (baseline.reference == now.reference).then(|| Self {
            relative: now.ratio() / baseline.ratio() - 1.0,
            uncertainty: now.uncertainty() + baseline.uncertainty(),
        })
    }
}

impl Record {
    /// The least median time (ns) of a bench.
    pub(crate) fn median_ns(&self, name: &str) -> Option<f64> {
        Some(self.benches.get(name)?.median_ns)
    }

    /// The median (ns) of all its medians.
    pub(crate) fn middle_ns(&self, name: &str) -> Option<f64> {
        Some(self.benches.get(name)?.middle_ns())
    }

    /// Time (ns) of a reference kernel: the least of all programs. The one of the figures is compiled for less speed.
    pub(crate) fn reference_ns(&self, reference: Reference) -> Option<f64> {
        let benches = self.benches.values().filter(|bench| bench.reference == reference);
        benches.map(|bench| bench.reference_ns).reduce(f64::min)
    }

    /// Takes over measurements, of each bench and each reference those with the least median: others on the machine only add
    /// time.
    pub(crate) fn add(&mut self, benches: BTreeMap<String, Measured>) {
        for (name, measured) in benches {
            self.benches.entry(name).and_modify(|kept| kept.add(&measured)).or_insert(measured);
        }
    }

    /// Reads the record that `command` stores.
    pub(crate) fn read(path: &Path, command: &str) -> anyhow::Result<Self> {
        let shown = path.display();
        let text = fs::read(path).with_context(|| format!("cannot read {shown}; `{command}` makes it"))?;
        let record: Self = serde_json::from_slice(&text).with_context(|| {
            format!("{shown} does not have the form of this version; `{command}` makes it anew")
        })?;
        if let Some((name, _)) = record.benches.iter().find(|(_, measured)| !measured.is_sound()) {
            bail!("{shown}: the times of {name} do not belong together, or are no positive numbers");
        }
        Ok(record)
    }

    /// The text to store.
    pub(crate) fn to_json(&self) -> anyhow::Result<Vec<u8>> {
        let mut text = serde_json::to_vec_pretty(self).context("the record cannot be written as JSON")?;
        text.push(b'\n');
        Ok(text)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A record of benches that took so many nanoseconds, with a reference of 10 ns.
    pub(crate) fn record(times: &[(&str, f64)]) -> Record {
        let measured = |median_ns: f64| Measured {
            low_ns: 0.99 * median_ns,
            median_ns,
            high_ns: 1.01 * median_ns,
            medians_ns: vec![median_ns],
            reference: Reference::Chain,
            reference_ns: 10.0,
            reference_drift: 0.02,
        };
        Record {
            machine: Machine {
                processor: "a processor".to_owned(),
                processors: 2,
                compiler: "rustc".to_owned(),
                source: "0123456".to_owned(),
            },
            quick: false,
            benches: times.iter().map(|(name, time)| ((*name).to_owned(), measured(*time))).collect(),
            figures: None,
            build_s: None,
        }
    }

    #[test]
    fn what_runs_in_lockstep_is_compared_with_lanes() {
        let lanes = ["w1/lanes/Avx2", "limit/pair/lanes/Baseline", "w2/ensemble/threads_1", "w3/threads_2"];
        let more = ["w3/panel_1000/threads_1", "growth/cells/900", "figures/fig07/draft/threads_1"];
        assert!(lanes.iter().chain(&more).all(|bench| Reference::of(bench) == Reference::Lanes));
        let chain = [
            "w1/scalar",
            "limit/pair/chained",
            "w2/one_motor",
            "w3/scalar",
            "growth/impacts/1000",
            "impact/grazing",
        ];
        assert!(chain.iter().all(|bench| Reference::of(bench) == Reference::Chain));
        let record = record(&[("w1/scalar", 150.0)]);
        assert_eq!(Reference::ALL.map(|reference| record.reference_ns(reference)), [Some(10.0), None]);
    }

    fn stored(name: &str, text: &[u8]) -> anyhow::Result<Record> {
        let path = std::env::temp_dir().join(format!("bouncing-disk-{name}-{}.json", std::process::id()));
        fs::write(&path, text).expect("writable");
        let record = Record::read(&path, "the command");
        fs::remove_file(&path).expect("removable");
        record
    }

    #[test]
    fn a_record_is_stored_and_read() {
        let record = record(&[("w1/scalar", 150.0)]);
        let text = record.to_json().expect("JSON");
        assert_eq!(stored("sound", &text).expect("readable"), record);
    }

    #[test]
    fn a_malformed_baseline_is_refused_with_what_repairs_it() {
        let error = stored("malformed", b"{\"benches\": 3}").expect_err("malformed");
        assert!(format!("{error:#}").contains("the command"), "{error:#}");
        let mut record = record(&[("w1/scalar", 150.0)]);
        record.benches.get_mut("w1/scalar").expect("there").reference_ns = 0.0;
        let error = stored("unsound", &record.to_json().expect("JSON")).expect_err("no time is zero");
        assert!(format!("{error:#}").contains("w1/scalar"), "{error:#}");
        let mut record = self::record(&[("w1/scalar", 150.0)]);
        for foreign in [vec![], vec![160.0], vec![140.0, 150.0]] {
            record.benches.get_mut("w1/scalar").expect("there").medians_ns = foreign;
            let error =
                stored("foreign", &record.to_json().expect("JSON")).expect_err("150 is not the least");
            assert!(format!("{error:#}").contains("w1/scalar"), "{error:#}");
        }
        let error = Record::read(Path::new("/nowhere/baseline.json"), "the command").expect_err("missing");
        assert!(format!("{error:#}").contains("/nowhere/baseline.json"), "{error:#}");
    }

    #[test]
    fn the_least_of_several_measurements_is_kept() {
        let mut kept = record(&[("a", 150.0), ("b", 20.0)]);
        let mut slower = record(&[("a", 160.0), ("c", 5.0)]);
        let bench = slower.benches.get_mut("a").expect("there");
        (bench.reference_ns, bench.reference_drift) = (9.0, 0.5);
        kept.add(slower.benches);
        let medians = ["a", "b", "c"].map(|name| kept.median_ns(name));
        assert_eq!(medians, [Some(150.0), Some(20.0), Some(5.0)]);
        let mut least = record(&[("a", 150.0)]).benches["a"].clone();
        (least.reference_ns, least.reference_drift) = (9.0, 0.5);
        least.medians_ns = vec![150.0, 160.0];
        assert_eq!(kept.benches["a"], least);
        assert_eq!(["a", "b"].map(|name| kept.middle_ns(name)), [Some(155.0), Some(20.0)]);
        kept.add(record(&[("a", 140.0)]).benches);
        assert_eq!((kept.median_ns("a"), kept.middle_ns("a")), (Some(140.0), Some(150.0)));
    }

    #[test]
    fn a_change_is_one_of_ratios() {
        let (before, after) = (record(&[("a", 100.0)]), record(&[("a", 150.0)]));
        let mut now = after.benches["a"].clone();
        // A machine that is half as fast.
        now.low_ns *= 2.0;
        now.median_ns *= 2.0;
        now.high_ns *= 2.0;
        now.reference_ns *= 2.0;
        let change = Change::between(&before.benches["a"], &now).expect("the same kernel");
        assert!((change.relative - 0.5).abs() < 1e-12, "{change:?}");
        assert!((change.uncertainty - 0.04).abs() < 1e-12, "{change:?}");
        now.reference = Reference::Lanes;
        assert_eq!(Change::between(&before.benches["a"], &now), None);
    }
}
