//! Draws a report on the shipped oil paints:
//! `cargo run -p impasto-reports --example report [FOLDER]`.

#![expect(clippy::print_stdout, reason = "an example prints its result")]

use std::path::PathBuf;

use calibrate::library::PigmentLibrary;
use documents::Task;
use reports::{Report, ReportRequest};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    std::fs::create_dir_all(folder.join("figures"))?;

    let library = PigmentLibrary::van_gogh_oils();
    let request = ReportRequest::default();
    let subject = request.run(&library, None, "report", &Task::default())?;
    let report = Report::draw(&subject, &Task::default())?;
    for (path, content) in report.files() {
        documents::file::write_whole(&folder.join(path), &content)?;
    }
    println!("{} figures: {}", report.figures().count(), folder.join("report.html").display());
    Ok(())
}
