//! Charts and one-page reports of a pigment library.
//!
//! In scope: figures as SVG, PNG and CSV, and the page that holds them. Out of
//! scope: anything that is computed rather than shown (see `calibrate`).
//!
//! Files stand in an order of dependence; each uses only what stands above it.
