//! Charts and one-page reports of a pigment library.
//!
//! In scope: figures as SVG, PNG and CSV, and the page that holds them. Out of
//! scope: anything that is computed rather than shown (see `calibrate`).
//!
//! To add a figure:
//!
//! 1. compute its numbers in `calibrate`;
//! 2. write a module here with one `pub(crate) fn section(&Subject) -> Section`:
//!    describe panels as data ([`panel::Panel`], [`panel::Mark`]), arrange them
//!    ([`panel::Chart`]) or draw patches and words ([`svg::Canvas`]), and hand
//!    drawing, words and numbers to [`subject::Subject::figure`];
//! 3. name that function in the list `SECTIONS` of `report`, where the page shall
//!    have it.
//!
//! SVG, PNG, CSV, page, contents, dark screen and files follow by themselves.
//! A section without figures and words is left out. Patches that mean just their
//! colour are rectangles ([`panel::Mark::Bar`], [`svg::Canvas::rectangle`]): on a
//! dark screen all else is made lighter.
//!
//! Files stand in an order of dependence; each uses only what stands above it.

pub mod style;

pub mod svg;

pub mod axis;

pub mod panel;

mod names;

mod chart;

pub mod picture;

pub mod table;

pub mod figure;

pub mod subject;

pub mod page;

mod curves;

mod samples;

mod residuals;

mod errors;

mod left_out;

mod light;

mod palette;

pub mod report;
