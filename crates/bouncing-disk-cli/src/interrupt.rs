//! Signals: the first asks the computation to stop, the second ends the process at once.

use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// The number of the signal received, or 0.
static SIGNAL: LazyLock<Arc<AtomicUsize>> = LazyLock::new(Arc::default);

/// The status that a shell reports for a process ended by a signal.
const BASE: usize = 128;

/// From now on Ctrl-C and the signal that schedulers send before they kill are noted. A second signal ends a
/// computation that does not look at [`came`]: files are renamed when they are complete, so no file is left
/// incomplete.
pub(crate) fn listen() -> io::Result<()> {
    // Either signal also counts as the second after the other. The handler that ends the process is registered
    // first, and so runs first.
    let again = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        flag::register_conditional_shutdown(signal, signal + BASE as i32, Arc::clone(&again))?;
    }
    for signal in [SIGINT, SIGTERM] {
        let number = usize::try_from(signal).unwrap_or_default();
        flag::register(signal, Arc::clone(&again))?;
        flag::register_usize(signal, Arc::clone(&SIGNAL), number)?;
    }
    Ok(())
}

pub(crate) fn came() -> bool {
    SIGNAL.load(Ordering::Relaxed) != 0
}

/// The exit status after an interruption: 130 for Ctrl-C, 143 for the signal to terminate.
pub(crate) fn exit_status() -> u8 {
    u8::try_from(BASE + SIGNAL.load(Ordering::Relaxed)).unwrap_or(u8::MAX)
}
