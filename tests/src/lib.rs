//! Helpers of several test programs: golden files, comparison, sample data and runs of `impasto`.
pub mod golden;
pub mod program;
pub mod oils;
pub mod watercolors;
pub mod stroke_bench;
