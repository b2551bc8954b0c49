//! The compiled module `bouncing_disk._native` of the Python package `bouncing_disk`.
#![cfg(feature = "extension-module")]

use pyo3::prelude::*;

#[pymodule]
mod _native {}
