//! `impasto film` computes K d and S d, contrast ratio and hiding power of a film on two cards.

use std::path::PathBuf;

use calibrate::film::{Estimate, FilmOnCards, FilmPower, Films};
use calibrate::{FilmRequest, Readings};
use clap::{Arg, Args};
use documents::Task;

use crate::console::Console;
use crate::failure::Result;
use crate::readings::{ReadingOptions, ViewingOptions, spectra_readings};
use crate::request_options::{CommandLine, RequestOptions, without_value_help};

/// The table has a row every so many nm. JSON and CSV hold all wavelengths.
const TABLE_STEP_NM: f64 = 20.0;

/// K, S and hiding power of one paint on a white and a black card
///
/// Reads a film over both cards, and both cards bare: columns `sample`, `film` (`none` for a bare
/// card), `backing`, and `thickness_mm`, or four spectra by name. No recipe is needed. Prints K d
/// and S d of the film below its surface, and with a thickness K and S per mm, each with its
/// standard deviation; the contrast ratio (Y over black divided by Y over white); and the
/// thickness and the spreading rate at which it reaches 0.98, as ISO 6504-3 defines hiding. The
/// spreading rate counts the volume of the film as you measured it. Give the share of solids in
/// the wet paint as --solids for the spreading rate of wet paint.
#[derive(Debug, Args)]
pub(crate) struct Film {
    /// Spectra of the film and the cards: a CSV, or an instrument's file
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    request: RequestOptions<FilmRequest>,
    #[command(flatten)]
    viewing: ViewingOptions,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Print JSON: illuminant, observer, contrast, surface, interpolated, and films, each with sample,
    /// thickness_mm, luminances, contrast_ratio, hiding, noise, powers
    #[arg(long)]
    json: bool,
    /// Print K and S by wavelength as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl CommandLine for FilmRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "surface" => option.long("saunderson").value_name("K1,K2"),
            "specular" => without_value_help(option),
            "thickness_mm" => option.value_name("MM"),
            "solids" | "contrast" => option.value_name("SHARE"),
            "noise" => option.value_name("DEVIATION"),
            "sample" => option.value_name("SAMPLE"),
            _ => option.value_name("NAME"),
        }
    }
}

impl Film {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing(console)?;
        let mut options = self.request.clone();
        // Without a surface there is no specular reflection to exclude.
        if options.is("surface", "none") {
            options.take("specular");
        }
        let request = FilmRequest { viewing, ..options.request()? };
        let readings: Readings = spectra_readings(&self.files, &self.reading, console)?;
        let found = request.run(&readings, &Task::default())?;
        console.remarks(&found.remarks)?;
        if self.json {
            return console.json(&found.to_json());
        }
        if self.csv {
            return console.csv_rows(&found.rows());
        }
        for (index, film) in found.films.iter().enumerate() {
            if index > 0 {
                console.line("")?;
            }
            print(film, &found, console)?;
        }
        for (sample, rate) in &found.interpolated {
            console.line("")?;
            console.line(format!(
                "{sample}: contrast ratio {} at {rate:.2} m2/l, between its films",
                found.contrast
            ))?;
        }
        Ok(())
    }
}

fn print(film: &FilmOnCards, found: &Films, console: &mut Console<'_>) -> Result<()> {
    let thickness = film.thickness_mm.map(|mm| format!(", {mm} mm")).unwrap_or_default();
    console.line(format!("{}{thickness}", film.sample))?;
    let [light, dark] = film.luminances;
    let viewing = &found.viewing;
    console.line(format!(
        "contrast ratio {} (Y {dark:.2} over black, {light:.2} over white, {}, observer {})",
        text(film.contrast, 4),
        viewing.illuminant.name(),
        viewing.observer
    ))?;
    if let Some(hiding) = film.hiding {
        let mut line = match hiding.thickness_mm {
            Some(mm) => format!("hides ({}) at {} mm", found.contrast, text(mm, 4)),
            None => {
                let factor = text(hiding.factor, 3);
                format!("hides ({}) at {factor} times this thickness", found.contrast)
            }
        };
        if let Some(rate) = hiding.spreading_rate {
            line += &format!(", {} m2/l", text(rate, 2));
        }
        console.line(line)?;
    }
    let mm = film.thickness_mm;
    let heading = match mm {
        Some(_) => format!("{:>6} {:>20} {:>20}", "", "K per mm", "S per mm"),
        None => String::new(),
    };
    let heading = format!("{:>6} {:>20} {:>20} {heading}", "nm", "K d", "S d");
    console.line(heading.trim_end())?;
    let mut next = f64::NEG_INFINITY;
    for power in &film.powers {
        if power.nm + 1e-9 < next {
            continue;
        }
        next = power.nm + TABLE_STEP_NM;
        console.line(row(power, mm).trim_end())?;
    }
    Ok(())
}

fn row(power: &FilmPower, thickness_mm: Option<f64>) -> String {
    let cell = |estimate: Option<Estimate>, divisor: f64| {
        let scaled = estimate.map(|found| Estimate {
            value: found.value / divisor,
            deviation: found.deviation / divisor,
        });
        let cell = scaled.map_or_else(|| "-".to_owned(), |found| text(found, 4));
        format!(" {cell:>20}")
    };
    let mut row = format!("{:>6}", power.nm);
    row += &cell(power.absorption, 1.0);
    row += &cell(power.scattering, 1.0);
    if let Some(mm) = thickness_mm {
        row += &format!("{:>7}", "");
        row += &cell(power.absorption, mm);
        row += &cell(power.scattering, mm);
    }
    row
}

/// A value with its deviation.
fn text(estimate: Estimate, digits: usize) -> String {
    format!("{:.digits$} +- {:.digits$}", estimate.value, estimate.deviation)
}
