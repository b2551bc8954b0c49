//! The computing threads.
//!
//! Each call borrows its own pool, which is kept for the next call: two Python threads compute at
//! the same time, and neither waits for the other. A forked process has none of its parent's threads,
//! so it makes its own pools.

use std::mem;
use std::num::NonZeroUsize;
use std::ops::Deref;
use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::arguments::Arguments;
use crate::errors;

/// The most threads of a pool.
const MOST: u64 = 1024;

/// The idle pools.
struct Idle {
    /// Their process.
    process: u32,
    /// Threads of a pool; `None` for rayon's default.
    threads: Option<NonZeroUsize>,
    pools: Vec<ThreadPool>,
}

static IDLE: Mutex<Idle> = Mutex::new(Idle { process: 0, threads: None, pools: Vec::new() });

fn idle() -> MutexGuard<'static, Idle> {
    let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if idle.process != process {
        // A parent's threads do not exist here; dropping its pools would wait for them.
        mem::forget(mem::take(&mut idle.pools));
        idle.process = process;
    }
    idle
}

/// A pool, until it is dropped.
pub(crate) struct Borrowed(Option<ThreadPool>, Option<NonZeroUsize>);

impl Borrowed {
    /// An idle pool, or a new one.
    pub(crate) fn take() -> PyResult<Self> {
        let (pool, threads) = {
            let mut idle = idle();
            (idle.pools.pop(), idle.threads)
        };
        let pool = match pool {
            Some(pool) => pool,
            None => ThreadPoolBuilder::new()
                .num_threads(threads.map_or(0, NonZeroUsize::get))
                .thread_name(|index| format!("bouncing-disk-{index}"))
                .build()
                .map_err(|error| PyOSError::new_err(error.to_string()))?,
        };
        Ok(Self(Some(pool), threads))
    }
}

impl Deref for Borrowed {
    type Target = ThreadPool;

    fn deref(&self) -> &ThreadPool {
        self.0.as_ref().expect("it is there until it is dropped")
    }
}

impl Drop for Borrowed {
    fn drop(&mut self) {
        let mut idle = idle();
        if let Some(pool) = self.0.take()
            && idle.threads == self.1
        {
            idle.pools.push(pool);
        }
    }
}

/// The number of threads of a call.
#[pyfunction]
pub(crate) fn threads(py: Python<'_>) -> PyResult<usize> {
    py.detach(|| Ok(Borrowed::take()?.current_num_threads()))
}

/// Sets the number of threads of each later call.
#[pyfunction]
pub(crate) fn set_threads(a: Arguments<'_>) -> PyResult<()> {
    const RANGE: &str = "[1, 1024]";
    let threads = match a.given("count")? {
        None => None,
        Some(_) => {
            let count = a.count("count", MOST, RANGE)? as usize;
            Some(NonZeroUsize::new(count).ok_or_else(|| errors::out_of_range(a.py(), "count", 0.0, RANGE))?)
        }
    };
    let old = {
        let mut idle = idle();
        idle.threads = threads;
        mem::take(&mut idle.pools)
    };
    a.py().detach(|| drop(old));
    Ok(())
}
