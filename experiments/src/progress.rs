//! How a long computation says how far it is.

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
