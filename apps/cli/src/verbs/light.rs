//! `impasto light`: colour temperature and colour rendering of lamps.

use clap::Args;
use serde_json::{Map, Value, json};
use spectra::{ColorRendering, Grid, Illuminant, Interpolation, Observer, TristimulusWeights};

use crate::console::Console;
use crate::failure::Result;
use crate::readings::{self, KnownOptions};

/// Describe lights: chromaticity, colour temperature and colour rendering
///
/// Ra and R1 to R14 are the indices of CIE 13.3-1995; Rf and Rg are fidelity and gamut of ANSI/IES
/// TM-30-18, and Rf is also that of CIE 224:2017. A lamp is compared with a black body or daylight of its
/// correlated colour temperature (CCT); Duv is its distance from the black body, above 0 greener.
/// A measured lamp is interpolated by its smoothness: by Sprague's polynomial, or linearly if it has lines.
#[derive(Debug, Args)]
pub(crate) struct Light {
    /// Lights: a CIE illuminant (A, FL11, LED-B3 ..), 2700K, D5600K, or a lamp's file (an instrument's,
    /// FILE#NAME for one of several spectra, or lines `nm,power`)
    #[arg(required = true, value_name = "LIGHT")]
    lights: Vec<String>,
    #[command(flatten)]
    known: KnownOptions,
    /// Print also R1 to R14, and Rf by 16 bins of hue
    #[arg(long)]
    samples: bool,
    /// Print JSON: a list of light, kelvin, duv, xy, ra, special, rf, rg, samples, hue_bins
    #[arg(long)]
    json: bool,
    /// Print the table as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

/// Width of the columns of figures.
const WIDTH: usize = 7;
/// Position of R9 in the list of special indices.
const R9: usize = 8;

impl Light {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let known = self.known.options(console)?;
        let lights = self
            .lights
            .iter()
            .map(|text| {
                let light = readings::light(text, &known, console)?;
                let rendering = ColorRendering::of(&light)?;
                console.warnings(&rendering.remarks)?;
                Ok(Described { xy: chromaticity(&light)?, light, rendering })
            })
            .collect::<Result<Vec<Described>>>()?;
        if self.csv {
            let rows: Vec<Value> = lights.iter().map(Described::row).collect();
            return console.csv_rows(&rows);
        }
        if self.json {
            let list: Vec<Value> = lights.iter().map(Described::json).collect();
            return console.json(&Value::from(list));
        }
        print(&lights, console)?;
        if self.samples {
            for light in &lights {
                light.print_samples(console)?;
            }
        }
        Ok(())
    }
}

/// CIE 1931 chromaticity of a light.
fn chromaticity(light: &Illuminant) -> Result<[f64; 2]> {
    let observer = Observer::Cie1931Deg2;
    let weights = TristimulusWeights::new(Grid::cie(), light, observer, Interpolation::Linear)?;
    let xyy = weights.white().to_xyy(weights.white());
    Ok([xyy.x, xyy.y])
}

/// A light with its figures.
struct Described {
    light: Illuminant,
    xy: [f64; 2],
    rendering: ColorRendering,
}

impl Described {
    fn json(&self) -> Value {
        let ColorRendering { temperature, index, fidelity, .. } = &self.rendering;
        json!({
            "light": self.light.name(),
            "kelvin": temperature.kelvin,
            "duv": temperature.duv,
            "xy": self.xy,
            "ra": index.general,
            "special": index.special,
            "distance_from_reference": index.distance_from_reference,
            "ra_is_meant": index.is_meant(),
            "rf": fidelity.fidelity,
            "rg": fidelity.gamut,
            "samples": fidelity.samples,
            "hue_bins": fidelity.hue_bins,
        })
    }

    /// Figures with a column for each special index and hue.
    fn row(&self) -> Value {
        let figures = self.json();
        let mut row = Map::new();
        for (key, value) in figures.as_object().into_iter().flatten() {
            let prefix = match key.as_str() {
                "samples" => continue,
                "special" => "R",
                "hue_bins" => "Rf_hue_",
                _ => {
                    row.insert(key.clone(), value.clone());
                    continue;
                }
            };
            for (number, value) in (1..).zip(value.as_array().into_iter().flatten()) {
                row.insert(format!("{prefix}{number}"), value.clone());
            }
        }
        Value::Object(row)
    }

    /// Prints R1 to R14 and the fidelity by hue.
    fn print_samples(&self, console: &mut Console<'_>) -> Result<()> {
        let ColorRendering { index, fidelity, .. } = &self.rendering;
        let special: Vec<Option<f64>> = index.special.iter().copied().map(Some).collect();
        console.line("")?;
        console.line(self.light.name())?;
        for (title, prefix, values) in
            [("CRI    ", "R", &special), ("Rf, hue", "", &fidelity.hue_bins)]
        {
            let mut numbers = title.to_owned();
            let mut cells = " ".repeat(7);
            for (number, value) in (1..).zip(values) {
                numbers += &format!("{:>5}", format!("{prefix}{number}"));
                cells +=
                    &value.map_or_else(|| format!("{:>5}", "-"), |value| format!("{value:5.0}"));
            }
            console.line(numbers)?;
            console.line(cells)?;
        }
        Ok(())
    }
}

fn print(lights: &[Described], console: &mut Console<'_>) -> Result<()> {
    let names = lights.iter().map(|described| described.light.name());
    let width = documents::column_width(names, "light".len());
    let headings = ["x", "y", "CCT, K", "Duv", "Ra", "R9", "Rf", "Rg"];
    let headings: String = headings.iter().map(|name| format!(" {name:>WIDTH$}")).collect();
    console.line(format!("{:width$}{headings}", "light"))?;
    let mut far = false;
    for Described { light, xy: [x, y], rendering } in lights {
        let ColorRendering { temperature, index, fidelity, .. } = rendering;
        let mark = if index.is_meant() { "" } else { "*" };
        far |= !index.is_meant();
        console.line(
            format!(
                "{:width$} {x:7.4} {y:7.4} {:7.0} {:7.4} {:7.1} {:7.1} {:7.1} {:7.1} {mark}",
                light.name(),
                temperature.kelvin,
                (temperature.duv * 1e4).round() / 1e4 + 0.0,
                index.general,
                index.special[R9],
                fidelity.fidelity,
                fidelity.gamut,
            )
            .trim_end(),
        )?;
    }
    if far {
        console.line(
            "* farther than 0.0054 from its reference in CIE 1960 (u, v): Ra and R9 are not meant for it",
        )?;
    }
    Ok(())
}
