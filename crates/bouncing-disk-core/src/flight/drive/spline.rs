//! Periodic cubic splines.
