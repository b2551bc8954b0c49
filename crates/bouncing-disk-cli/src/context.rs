//! What a command is run with.

use crate::arguments::CommonArgs;
use crate::progress::Watcher;

/// What every command has.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context {
    pub(crate) quiet: bool,
}

impl From<CommonArgs> for Context {
    fn from(args: CommonArgs) -> Self {
        Self { quiet: args.quiet }
    }
}

impl Context {
    /// Watches a computation of this name.
    pub(crate) fn watch(self, what: &str) -> Watcher {
        Watcher::new(what, self.quiet)
    }
}
