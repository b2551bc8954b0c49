//! How a long computation says how far it is.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use bouncing_disk::Observer;

/// Receives the progress of one experiment. An experiment reports; it never prints.
pub trait Progress: Sync {
    /// A stage of `total` units begins; `unit` is their name in the plural ("orbits", "cells").
    ///
    /// A later call begins a new stage.
    fn start(&self, total: u64, unit: &'static str);

    /// `done` more units are finished. May be called from several threads.
    fn advance(&self, done: u64);
}

/// Ignores all progress, for tests and library use.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn start(&self, _total: u64, _unit: &'static str) {}

    fn advance(&self, _done: u64) {}
}

/// Observes a call of the model whose items are units of a stage: advances by what is new, and never stops
/// it.
pub(crate) fn advancing(progress: &dyn Progress) -> impl Observer {
    let passed = AtomicU64::new(0);
    move |now: bouncing_disk::Progress| {
        let before = passed.fetch_max(now.done, Ordering::Relaxed);
        if now.done > before {
            progress.advance(now.done - before);
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sum(AtomicU64);

    impl Progress for Sum {
        fn start(&self, _: u64, _: &'static str) {}

        fn advance(&self, done: u64) {
            self.0.fetch_add(done, Ordering::Relaxed);
        }
    }

    #[test]
    fn items_are_counted_once_in_whatever_order_they_are_told() {
        let sum = Sum(AtomicU64::new(5));
        let observer = advancing(&sum);
        for done in [0, 3, 2, 3, 7, 4] {
            assert!(observer.observe(bouncing_disk::Progress { done, total: 7 }).is_continue());
        }
        assert_eq!(sum.0.load(Ordering::Relaxed), 12);
    }
}
