//! Charts and one-page reports of a pigment library.
//!
//! ```text
//! PigmentLibrary --+
//! Readings --------+--> ReportRequest::run --> Subject --> Report::draw --> report.html
//! (if you have any)                                                         figures/*.svg, *.png, *.csv
//! ```
//!
//! ```no_run
//! use calibrate::library::PigmentLibrary;
//! use documents::Task;
//! use reports::{Report, ReportRequest};
//!
//! let library = PigmentLibrary::van_gogh_oils();
//! let request = ReportRequest::default();
//! let subject = request.run(&library, None, "my program", &Task::default())?;
//! let report = Report::draw(&subject, &Task::default())?;
//! for (path, content) in report.files() {
//!     documents::file::write_whole(std::path::Path::new(&path), &content)?;
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A single chart needs no library:
//!
//! ```
//! use reports::panel::{Axis, Chart, Mark, Panel};
//! use reports::style::{CURVE, SERIES};
//!
//! let x = Axis::linear("Wavelength", "nm", 400.0, 700.0, 4);
//! let y = Axis::reflectance(1.0, 4);
//! let points = vec![(400.0, 0.1), (550.0, 0.2), (700.0, 0.8)];
//! let curve = Mark::Line { points, color: SERIES[0], width: CURVE };
//! let svg = Chart::single(Panel::new(x, y, vec![curve]).with_title("Red paint"), 200.0).svg();
//! assert!(svg.starts_with("<svg") && svg.contains("Red paint"));
//! ```
//!
//! This crate draws figures as SVG, PNG and CSV, and the page that shows them. It does not compute
//! their numbers (see `calibrate`).
//!
//! To add a figure:
//!
//! 1. compute its numbers in `calibrate`,
//! 2. write one `pub(crate) fn .._section(&Subject) -> Section` in the file of its topic: describe panels
//!    as data ([`panel::Panel`], [`panel::Mark`]) and arrange them ([`panel::Chart`]), or draw
//!    patches and text ([`svg::Canvas`]), then pass drawing, texts and data to
//!    [`Subject::figure`],
//! 3. add that function to the list `SECTIONS` in `report`, at its place on the page.
//!
//! You need nothing else for SVG, PNG, CSV, page, contents and dark colours. The page leaves out a
//! section without figures and text. If you draw a patch that shows the colour of a paint, make it
//! a rectangle ([`panel::Mark::Bar`], [`svg::Canvas::rectangle`]): on a dark screen all other
//! elements become lighter.
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

pub mod style;
pub mod svg;
pub mod panel;
mod chart;

#[cfg(feature = "pictures")]
pub mod picture;
pub mod figure;
pub mod subject;
mod request;
mod fit;
mod light;
mod palette;
mod report;

#[cfg(feature = "pictures")]
pub use picture::PictureError;
#[cfg(feature = "pictures")]
pub use report::Report;
pub use report::{Head, STEPS, Warning, absences, page_alone};
pub use request::{PreparedReport, ReportError, ReportRequest};
pub use subject::Subject;
