//! What others have published on bouncing balls: `data/literature` and `data/literature/README.md` against the exact
//! map.
//!
//! A statement with a `check` is computed here, and its row of the page must have that number and that
//! verdict. The units of the data are those of the page; a frequency has amplitude, gravity and mass 1, so
//! that P is its square.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use bouncing_disk::core::attractors::{Verdict, VerdictSettings};
use bouncing_disk::core::numerics::elementary::sin_cos;
use bouncing_disk::core::orbits::doubling_cascade;
use bouncing_disk::core::{
    ChatterPolicy, ImpactMap, ImpactState, Launch, OrbitEvent, Phase, Unobserved, Vibration,
};
use bouncing_disk_experiments::claims::printed::PrintedNumber;
use serde::Deserialize;
use serde_json::Value;

const PAGE: &str = include_str!("../../data/literature/README.md");

/// The printed number of the page has six digits at least where it is compared, or five for a speed.
const PAGE_PRECISION: f64 = 3e-5;

/// Half a unit of the last place may be rounded itself.
const ROUNDING: f64 = 1.0 + 1e-9;

/// From the gravity of the Toronto program to the standard one, which may be meant (m/s²).
const OTHER_GRAVITY_M_PER_S2: f64 = 9.81;

const FEIGENBAUM_DELTA: f64 = 4.669_201_609;

#[derive(Deserialize)]
struct Entry {
    id: String,
    inputs: BTreeMap<String, String>,
    statements: Vec<Statement>,
}

#[derive(Deserialize)]
struct Statement {
    name: String,
    quantity: String,
    printed: Option<String>,
    #[serde(default)]
    inputs: BTreeMap<String, String>,
    check: Option<String>,
}

/// A statement with the entry that it stands in.
struct Checked<'a> {
    entry: &'a Entry,
    own: &'a Statement,
}

fn entries() -> Vec<Entry> {
    serde_json::from_str(include_str!("../../data/literature/bouncing_ball.json")).expect("legal")
}

fn printed(text: &str) -> PrintedNumber {
    PrintedNumber::read(text).unwrap_or_else(|| panic!("{text} is no number"))
}

fn map(peak_acceleration: f64, restitution: f64) -> ImpactMap {
    ImpactMap::new(Vibration::new(peak_acceleration).expect("legal"), restitution).expect("legal")
}

/// The first impact after a launch.
fn first_impact(map: &ImpactMap, launch: Launch) -> ImpactState {
    let next =
        map.orbit_from_launch(launch, ChatterPolicy::Complete).next().expect("endless").expect("flies");
    match next {
        OrbitEvent::Impact(impact) => impact.into(),
        other => panic!("{other:?}"),
    }
}

impl Checked<'_> {
    fn input(&self, name: &str) -> f64 {
        let found = self.own.inputs.get(name).or_else(|| self.entry.inputs.get(name));
        printed(found.unwrap_or_else(|| panic!("{} has no {name}", self.entry.id))).value
    }

    fn restitution(&self) -> f64 {
        self.input("restitution")
    }

    /// The forcing of a doubling of the cascade.
    fn doubling(&self, number: usize) -> f64 {
        let found = doubling_cascade(self.restitution(), number, &Unobserved).expect("converges");
        found.doublings[number - 1].axial_forcing
    }

    /// Where the doublings accumulate, from the last two of nine.
    fn accumulation(&self) -> f64 {
        let (before, last) = (self.doubling(8), self.doubling(9));
        last + (last - before) / (FEIGENBAUM_DELTA - 1.0)
    }

    /// Whether a number is the printed one, to half a unit of its last digit or the grid on which it was
    /// read.
    fn agrees(&self, number: f64) -> bool {
        let own = &self.own.inputs;
        if own.contains_key("low") {
            return (self.input("low")..=self.input("high")).contains(&number);
        }
        let text = self.own.printed.as_deref().expect("printed");
        let targets = match PrintedNumber::read(text) {
            Some(printed) => vec![printed],
            None if own.len() == 1 => own.values().map(|text| printed(text)).collect(),
            None => {
                own.iter().filter(|(name, _)| *name != "frequency").map(|(_, text)| printed(text)).collect()
            }
        };
        let grid = if self.entry.inputs.contains_key("grid") { self.input("grid") } else { 0.0 };
        let near =
            |target: &PrintedNumber| (number - target.value).abs() <= target.half_unit.max(grid) * ROUNDING;
        !targets.is_empty() && targets.iter().all(near)
    }

    /// The speeds on the attracting orbit that the homework's start leads to, largest first.
    fn speeds(&self) -> Vec<f64> {
        let frequency = self.input("frequency");
        let map = map(frequency * frequency, self.restitution());
        // On the platform as it rises through zero, with the own speed 2.
        let launch = Launch::new(Phase::new(0.0).expect("legal"), 2.0 * frequency - frequency * frequency);
        let first = first_impact(&map, launch.expect("rises"));
        let settings = VerdictSettings { transient: 3_000, impacts: 6_000, ..VerdictSettings::default() };
        let Verdict::Periodic { impacts, mut state, .. } = map.verdict(first, settings).expect("decided")
        else {
            return Vec::new();
        };
        let mut speeds = Vec::new();
        for _ in 0..impacts {
            let (_, cosine) = sin_cos(state.phase().angle());
            speeds.push((frequency * frequency * cosine - map.restitution() * state.velocity()) / frequency);
            state = map.step(state).expect("flies").into();
        }
        speeds.sort_by(|one, other| other.total_cmp(one));
        speeds
    }

    /// Whether something holds at the gravity of the program, at the standard one, and at all between them.
    fn for_all_gravities(&self, holds: impl Fn(&ImpactMap) -> bool) -> bool {
        let angular = TAU * self.input("frequency_hz");
        let own = self.input("gravity_m_per_s2");
        let answers: Vec<bool> = (0..=20)
            .map(|step| own + (OTHER_GRAVITY_M_PER_S2 - own) * f64::from(step) / 20.0)
            .map(|gravity| {
                holds(&map(self.input("amplitude_m") * angular * angular / gravity, self.restitution()))
            })
            .collect();
        assert!(answers.iter().all(|answer| *answer == answers[0]), "{}: {answers:?}", self.entry.id);
        answers[0]
    }

    /// The number of a check, if it is one, and whether the statement holds.
    fn answer(&self) -> (Option<f64>, bool) {
        let check = self.own.check.as_deref().expect("filtered");
        let (kind, last) = check.rsplit_once(' ').unwrap_or((check, ""));
        let number = || last.parse::<usize>().unwrap_or_else(|_| panic!("{check} has no number"));
        let birth = || (1.0 - self.restitution()) / (1.0 + self.restitution());
        let found = match (kind, last) {
            ("birth", "") => birth(),
            ("birth as", _) => TAU * birth(),
            ("doubling", _) => self.doubling(number()),
            ("frequency of doubling", _) => (PI * self.doubling(number())).sqrt(),
            ("frequency of the", _) => (PI * self.accumulation()).sqrt(),
            ("phase at the", _) => {
                let map = map(PI * self.doubling(1), self.restitution());
                map.period_one(1).expect("born").phase().cycles()
            }
            ("speed 1 of" | "speed 2 of", _) => {
                let speeds = self.speeds();
                let index = usize::from(kind.contains('2'));
                return (Some(speeds[index]), speeds.len() == number() && self.agrees(speeds[index]));
            }
            ("count", _) => {
                let speeds = self.speeds();
                return (Some(speeds[0]), speeds.len() == number());
            }
            ("impulse", _) => {
                let map = map(10.0, 0.5);
                let speed = |periods| map.period_one_pair(periods).expect("born").node.state.velocity();
                speed(2) / speed(1)
            }
            ("stable", "") => {
                let periods = self.input("platform_periods") as u64;
                let stable = |map: &ImpactMap| {
                    map.period_one_pair(periods).is_some_and(|pair| {
                        pair.node.multipliers().spectral_radius() < 1.0
                            && pair.node.is_admissible(map).expect("flies")
                    })
                };
                return (None, self.for_all_gravities(stable));
            }
            ("rests", _) => {
                let settings =
                    VerdictSettings { transient: 500, impacts: 5_500, ..VerdictSettings::default() };
                let rests = |map: &ImpactMap| {
                    let phase = map.vibration().separation_phase().expect("falls away");
                    let first = first_impact(map, Launch::new(phase, 0.0).expect("legal"));
                    matches!(map.verdict(first, settings), Ok(Verdict::Chattering { .. }))
                };
                return (None, self.for_all_gravities(rests));
            }
            _ => panic!("{check} is no check"),
        };
        (Some(found), self.agrees(found))
    }
}

/// The number that begins the text of a cell.
fn leading_number(cell: &str) -> f64 {
    let end = cell.find([';', ' ']).unwrap_or(cell.len());
    cell[..end].parse().unwrap_or_else(|_| panic!("{cell} begins with no number"))
}

#[test]
fn the_page_has_what_the_exact_map_gives() {
    let page = PAGE.replace('\\', "");
    let mut checked = 0;
    for entry in entries() {
        let (_, section) =
            page.split_once(&format!("\n**{}**", entry.id)).unwrap_or_else(|| panic!("no {}", entry.id));
        let section = section.split("\n**").next().expect("a first part");
        for own in &entry.statements {
            let printed = own.printed.as_deref().unwrap_or("—");
            let begin = format!("| {} | {printed} | ", own.quantity);
            let row = section.lines().find_map(|line| line.strip_prefix(&begin));
            let row = row.unwrap_or_else(|| panic!("{}: no row {begin}", entry.id));
            if own.check.is_none() {
                continue;
            }
            let (number, holds) = Checked { entry: &entry, own }.answer();
            let (cell, verdict) = row.split_once(" | ").expect("two cells");
            if let Some(number) = number {
                let shown = leading_number(cell);
                assert!(
                    (shown - number).abs() <= PAGE_PRECISION * number.abs(),
                    "{} {}: {number}, page: {shown}",
                    entry.id,
                    own.name
                );
            }
            let expected = if holds { "agrees" } else { "**differs**" };
            assert_eq!(verdict.trim_end_matches([' ', '|']), expected, "{} {}", entry.id, own.name);
            checked += 1;
        }
    }
    assert!(checked >= 30, "{checked}");
}

/// Nothing is from memory: what a statement starts from stands in the words of its source.
#[test]
fn every_input_and_every_printed_number_stands_in_the_text() {
    let raw: Vec<Value> =
        serde_json::from_str(include_str!("../../data/literature/bouncing_ball.json")).expect("legal");
    for (entry, mut raw) in entries().into_iter().zip(raw) {
        let members = raw.as_object_mut().expect("an object");
        for own in ["inputs", "statements"] {
            members.remove(own);
        }
        let text =
            members.values().map(|value| value.as_str().map_or_else(|| value.to_string(), str::to_owned));
        let text = text.collect::<Vec<_>>().join("\n");
        let own = entry.statements.iter().flat_map(|statement| statement.inputs.values());
        for input in entry.inputs.values().chain(own) {
            assert!(text.contains(input.as_str()), "{}: {input}", entry.id);
            printed(input);
        }
        for printed in entry.statements.iter().filter_map(|statement| statement.printed.as_ref()) {
            assert!(printed.split(", ").all(|part| text.contains(part)), "{}: {printed}", entry.id);
        }
    }
}
