//! Runs the program as a user does.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod bad_input;
mod chunks;
mod common;
#[cfg(unix)]
mod documentation;
mod files;
#[cfg(unix)]
mod interrupt;
mod library;
mod stability;
