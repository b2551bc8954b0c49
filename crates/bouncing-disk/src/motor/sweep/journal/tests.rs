use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::motor::sweep::tests::{mixed, rough};
use crate::motor::{MotorField, OperatingSettings, SweepAxis};
use crate::{Error, Motor, Unobserved};

/// A folder of its own, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("bouncing-disk-sweep-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("writable");
        Self(path)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Stops a run at its first, second, fourth ... question; each time the file ends in half a line, and another
/// number of threads goes on.
#[test]
fn a_sweep_that_is_killed_again_and_again_ends_as_that_of_one_call() {
    let (scratch, sweep) = (Scratch::new("killed"), mixed());
    let path = scratch.path("journal");
    let at_once = sweep.run(&Unobserved).expect("no failure");
    let (mut lines, mut partly) = (0, false);
    for stops in 0.. {
        let threads = [1, 2, 7][stops % 3];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        let calls = AtomicUsize::new(0);
        let observer = |_: Progress| {
            let early = calls.fetch_add(1, Ordering::Relaxed) < (1 << stops) - 1;
            if early { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let outcome = pool.install(|| sweep.run_with_journal(&path, &observer));
        let mut bytes = fs::read(&path).expect("readable");
        let whole = bytes.iter().filter(|byte| **byte == b'\n').count() - 1;
        // Nothing that was finished is lost.
        assert!(whole >= lines && whole <= 6, "{whole} {lines}");
        lines = whole;
        match outcome {
            Ok(result) => {
                assert!(result == at_once && lines == 6);
                break;
            }
            Err(StorageError::Model(Error::Core(bouncing_disk_core::Error::Stopped { .. }))) => {}
            Err(error) => panic!("{error}"),
        }
        if lines > 0 {
            partly = true;
            let end = bytes.iter().rposition(|byte| *byte == b'\n').expect("lines");
            let begin = bytes[..end].iter().rposition(|byte| *byte == b'\n').expect("lines");
            let half = bytes[begin + 1..end - (end - begin) / 2].to_vec();
            bytes.extend(half);
            fs::write(&path, bytes).expect("writable");
        }
    }
    assert!(partly);
    // All is there: nothing is computed again.
    let before = fs::read(&path).expect("readable");
    assert!(sweep.run_with_journal(&path, &Unobserved).expect("done") == at_once);
    assert_eq!(fs::read(&path).expect("readable"), before);
}

#[test]
fn the_journal_of_another_sweep_is_refused_by_name() {
    let scratch = Scratch::new("other");
    let path = scratch.path("journal");
    let axis = |parameter: MotorField, value: f64| vec![SweepAxis::new(parameter, vec![0.1, value])];
    let motor = Motor::paper_70_khz();
    let made =
        |motor: Motor, axes: Vec<SweepAxis>, settings| MotorSweep::new(motor, axes, settings).expect("legal");
    let sweep = made(motor, axis(MotorField::PhaseLag, 0.2), rough());
    let result = sweep.run_with_journal(&path, &Unobserved).expect("free");
    let other = motor.with(|sheet| sheet.friction = 0.2).expect("legal");
    let settings = OperatingSettings { seed: 2, ..rough() };
    for (sweep, field) in [
        (made(motor, axis(MotorField::PhaseLag, 0.3), rough()), "parameters.axes[0].values[1]"),
        (made(motor, axis(MotorField::Friction, 0.2), rough()), "parameters.axes[0].parameter"),
        (made(other, axis(MotorField::PhaseLag, 0.2), rough()), "parameters.motor.friction"),
        (made(motor, axis(MotorField::PhaseLag, 0.2), settings), "parameters.settings.seed"),
    ] {
        let error = sweep.run_with_journal(&path, &Unobserved).expect_err("of another sweep");
        let text = error.to_string();
        assert!(matches!(error, StorageError::OtherKey { .. }) && text.contains(field), "{text}");
    }
    assert_eq!(sweep.run_with_journal(&path, &Unobserved).expect("its own"), result);
}
