//! `impasto demo`: the shipped oils, fitted and mixed.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context;
use calibrate::PigmentId;
use calibrate::calibration::calibrate;
use calibrate::evaluate::Viewing;
use calibrate::fit::FitSettings;
use calibrate::library::PigmentLibrary;
use calibrate::measurement::{MeasurementTable, ScaleChoice};
use calibrate::observation::BelowSurface;
use calibrate::swatch::SwatchSet;
use clap::Args;
use spectra::optics::{Specular, Surface};

use super::{fit_report, library};
use crate::console::Console;
use crate::input::input;
use crate::output::Output;

const NAME: &str = "measurements/van-gogh-oils.csv";
const OILS: &[u8] = include_bytes!("../../../measurements/van-gogh-oils.csv");
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
    /// Folder for the library
    #[arg(long, value_name = "FOLDER", default_value = "out")]
    out: PathBuf,
    /// Print JSON, as `fit` does
    #[arg(long)]
    json: bool,
}

impl Demo {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let start = Instant::now();
        std::fs::create_dir_all(&self.out)
            .with_context(|| format!("{}: cannot be made", self.out.display()))?;
        let path = self.out.join("van-gogh-oils.pigments.json");
        let output = Output::open(&path, &[])?;
        let viewing = Viewing::default();
        let library = fitted(&viewing)?;
        output.write(library.to_json())?;
        let evidence = library.evidence.as_ref().expect("a fit has evidence");
        let seconds = start.elapsed().as_secs_f64();
        if self.json {
            return console.json(&fit_report::library_json(&library, evidence, seconds));
        }
        console.line(format!("{} ({})", library.title, library.licence))?;
        console.line("")?;
        library::print_pigments(&library, &viewing, console)?;
        console.line("")?;
        console.line("How well the fit reproduces its samples, worst first:")?;
        fit_report::print(&library, evidence, 12, console)?;
        console.line("")?;
        console.line("What the data cannot tell, or tell against themselves:")?;
        for warning in &evidence.warnings {
            console.line(format!("  {warning}"))?;
        }
        console.line("")?;
        console.line("Mixtures nobody measured:")?;
        print_mixtures(&library, &viewing, console)?;
        console.line("")?;
        console.remark(format!("written: {} ({seconds:.2} s)", path.display()))?;
        console.line("Next:")?;
        console
            .line(format!("  impasto mix {} \"Zinc White=9\" \"Cobalt Blue=1\"", path.display()))?;
        console.line(format!("  impasto library show {} \"Viridian\"", path.display()))?;
        console.line(format!("  impasto validate {NAME}"))?;
        console.line("  impasto fit YOUR-READINGS.csv --output your-paint.json")
    }
}

/// The library of the shipped oils.
fn fitted(viewing: &Viewing) -> anyhow::Result<PigmentLibrary> {
    let table = MeasurementTable::from_csv(NAME, OILS, ScaleChoice::ByFile)?;
    let set = SwatchSet::from_table(&table)?;
    let white = set.pigments.iter().position(|p| p == "Zinc White").map(PigmentId);
    let surface = Surface::new(0.03, 0.6, Specular::Included)?;
    let settings = FitSettings { below_surface: BelowSurface::Floor, ..FitSettings::default() };
    let white = white.context("the shipped oils have a zinc white")?;
    let mut library = calibrate(&set, white, surface, &settings, viewing)?.library;
    library.title = "Van Gogh's oils".to_owned();
    library.licence = "CC0 1.0".to_owned();
    library.source = "Geldof, Proano Gaibor, Ligterink, Hendriks, Kirchner, Heritage Science 6:17 (2018), doi 10.1186/s40494-018-0181-6".to_owned();
    library.inputs = vec![input(NAME, OILS)];
    Ok(library)
}

fn print_mixtures(
    library: &PigmentLibrary,
    viewing: &Viewing,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let width = MIXTURES.iter().map(|(title, _)| title.len()).max().unwrap_or(0);
    for (title, recipe) in MIXTURES {
        let color = library.color(recipe.iter().copied(), viewing)?;
        let [l, a, b] = color.lab.to_array();
        let rgb = color.srgb;
        let words: Vec<String> =
            recipe.iter().map(|(name, part)| format!("{part} {name}")).collect();
        console.line(format!(
            "  {}{} {title:width$}  Lab {l:5.1} {a:6.1} {b:6.1}  {}",
            console.patch(rgb),
            rgb.to_hex(),
            words.join(" + ")
        ))?;
    }
    Ok(())
}
