//! `impasto demo`: fits the shipped oils and mixes a few colours.

use std::path::PathBuf;
use std::time::Instant;

use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::observation::BelowSurface;
use calibrate::{Fit, FitRequest, Provenance, Readings};
use clap::Args;
use spectra::optics::{Specular, Surface};

use super::{fit, library};
use crate::console::Console;
use crate::failure::Result;
use crate::output::OutputFolder;

const NAME: &str = "measurements/van-gogh-oils.csv";
const OILS: &[u8] = include_bytes!("../../../../measurements/van-gogh-oils.csv");
const MIXTURES: [(&str, &[(&str, f64)]); 6] = [
    ("a sky", &[("Zinc White", 12.0), ("Cobalt Blue", 3.0), ("Emerald Green", 1.0)]),
    ("cypresses", &[("Viridian", 4.0), ("Chrome Yellow", 1.0), ("Bone Black", 1.0)]),
    ("ripe wheat", &[("Lead White", 6.0), ("Chrome Yellow", 3.0), ("Minium", 1.0)]),
    ("a night", &[("Ultramarine", 6.0), ("Prussian Blue", 1.0), ("Zinc White", 4.0)]),
    ("almond blossom", &[("Zinc White", 40.0), ("Cochineal Lake", 1.0), ("Vermilion", 1.0)]),
    ("a grey of complements", &[("Zinc White", 12.0), ("Vermilion", 3.0), ("Viridian", 2.0)]),
];

/// Fit the Van Gogh oils that ship with impasto, and mix a few colours
#[derive(Debug, Args)]
pub(crate) struct Demo {
    /// Folder that the library is written to
    #[arg(short, long, alias = "out", value_name = "FOLDER", default_value = "out")]
    output: PathBuf,
    /// Print JSON, as `fit` does
    #[arg(long)]
    json: bool,
    /// Print the error of every sample as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Demo {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let start = Instant::now();
        let folder = OutputFolder::open(&self.output, &[])?;
        let name = "van-gogh-oils.pigments.json".to_owned();
        folder.check([name.clone()])?;
        let path = folder.file(&name);
        let viewing = Viewing::default();
        let fit = fit_oils()?;
        let library = &fit.library;
        for output in folder.outputs([name])? {
            output.write(library.to_json(), console)?;
        }
        let seconds = start.elapsed().as_secs_f64();
        if self.csv {
            return console.csv_rows(&fit::rows(&fit.evidence().per_sample));
        }
        if self.json {
            return console.json(&fit::timed(fit.errors_json(), seconds));
        }
        console.line(format!("{} ({})", library.title, library.licence))?;
        console.line("")?;
        library::print_pigments(library, &viewing, console)?;
        console.line("")?;
        console.line("How well the fit reproduces its samples, worst first:")?;
        console.lines(fit.report().with_samples(12).to_string())?;
        console.line("")?;
        console.line("Not identified by the data, or inconsistent with it:")?;
        for warning in fit.warnings() {
            console.line(format!("  {warning}"))?;
        }
        console.line("")?;
        console.line("Predicted mixtures, not measured:")?;
        print_mixtures(library, &viewing, console)?;
        console.line("")?;
        console.detail(format!("fitted in {seconds:.2} s"))?;
        console.line("Next:")?;
        console
            .line(format!("  impasto mix {} \"Zinc White=9\" \"Cobalt Blue=1\"", path.display()))?;
        console.line(format!("  impasto library show {} \"Viridian\"", path.display()))?;
        console.line(format!("  impasto validate {NAME}"))?;
        console.line("  impasto fit YOUR-READINGS.csv --output your-paint.json")
    }
}

/// Fits the shipped measurements of Van Gogh's oils.
fn fit_oils() -> Result<Fit> {
    let readings = Readings::from_csv(NAME, OILS)?;
    let options = FitRequest {
        // The published readings of three samples lie below the usual k1, at which the library that
        // ships was made.
        surface: Some(Surface::of_most_paints(Specular::Included)),
        below_surface: Some(BelowSurface::Floor),
        reference: Some("Zinc White".to_owned()),
        provenance: Provenance {
            title: Some("Van Gogh's oils".to_owned()),
            licence: "CC0 1.0".to_owned(),
            source: "Geldof, Proano Gaibor, Ligterink, Hendriks, Kirchner, Heritage Science 6:17 (2018), doi 10.1186/s40494-018-0181-6".to_owned(),
        },
        ..FitRequest::default()
    };
    Ok(calibrate::fit(&readings, &options)?)
}

fn print_mixtures(
    library: &PigmentLibrary,
    viewing: &Viewing,
    console: &mut Console<'_>,
) -> Result<()> {
    let width = MIXTURES.iter().map(|(title, _)| title.len()).max().unwrap_or(0);
    for (title, recipe) in MIXTURES {
        let color = library.color(recipe.iter().copied(), viewing)?;
        let [l, a, b] = color.lab.to_array();
        let rgb = color.srgb;
        let parts: Vec<String> =
            recipe.iter().map(|(name, part)| format!("{part} {name}")).collect();
        console.line(format!(
            "  {} {title:width$}  Lab {l:5.1} {a:6.1} {b:6.1}  {}",
            console.srgb(rgb),
            parts.join(" + ")
        ))?;
    }
    Ok(())
}
