//! `impasto plan`: which swatches to prepare.

use std::path::PathBuf;

use calibrate::fit::{ExpectedNoise, unidentified};
use calibrate::library::PigmentLibrary;
use calibrate::plan::{
    Information, Palette, Recipe, Sheet, Weighing, candidates, optimal, sample_names, usual,
    usual_count,
};
use clap::Args;
use spectra::Grid;

use super::plan_report::{self, Forecast};
use crate::console::Console;
use crate::failure::Refusal;
use crate::input::library;
use crate::output::Output;

/// Plan the swatches to prepare, so that K and S of every pigment can be told
///
/// Prints each swatch with its recipe in parts and grams, and how much of each paint all of them
/// take. With --prior, a library of paint like it, the swatches are chosen to tell most of K and S
/// (D-optimal), and the deviations to expect are predicted. --output writes the measurement file to
/// fill in: bare cards and every swatch over a white and a black card, amounts in grams. Put in its
/// amounts what the balance really showed.
#[derive(Debug, Args)]
pub(crate) struct Plan {
    /// The pigments; with --prior a name may be cut short
    #[arg(required = true, value_name = "PIGMENT")]
    pigments: Vec<String>,
    /// The white that lets them down, whose S is the unit
    #[arg(long, value_name = "NAME")]
    white: String,
    /// A black, for shades
    #[arg(long, value_name = "NAME")]
    black: Option<String>,
    /// A pigment library of the same or similar paint, to choose the swatches by
    #[arg(long, value_name = "LIBRARY")]
    prior: Option<PathBuf>,
    /// How many swatches [default: masstones, two tints each, a shade each with a black, and one
    /// cross each]
    #[arg(long, value_name = "N")]
    swatches: Option<usize>,
    /// Grams of paint a swatch
    #[arg(long, value_name = "G", default_value_t = 10.0, allow_hyphen_values = true)]
    grams: f64,
    /// The step that the balance shows, in grams; no part is smaller than fifty steps, so that it
    /// is weighed to 1 %
    #[arg(long, value_name = "G", default_value_t = 0.01, allow_hyphen_values = true)]
    balance: f64,
    /// Expected noise of a swatch's reflectance, as standard deviations CONSTANT,EVEN: the
    /// instrument's, and that of weighing, mixing and film, even to the eye [default: 0.002 and
    /// the residual that the prior's own fit left, else 0.01]
    #[arg(long, value_name = "CONSTANT,EVEN", requires = "prior", allow_hyphen_values = true)]
    noise: Option<String>,
    /// Readings of each film and card in the file
    #[arg(long, value_name = "N", default_value_t = 2)]
    replicates: usize,
    /// Wavelengths of the file in nm: first,last,step
    #[arg(long, value_name = "FIRST,LAST,STEP", default_value = "400,700,10")]
    grid: String,
    /// The empty measurement file to write (CSV)
    #[arg(short, long, value_name = "CSV")]
    output: Option<PathBuf>,
    /// Print JSON: swatches, totals_g, unknowns, identified, prior (null without)
    #[arg(long)]
    json: bool,
}

impl Plan {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let sheet = Sheet { grid: self.grid()?, replicates: self.replicates()? };
        let noise = self.noise()?;
        let inputs: Vec<PathBuf> = self.prior.iter().cloned().collect();
        let open = |path: &PathBuf| {
            let output = Output::open(path, &inputs)?;
            // It may hold a day's readings by now.
            if path.exists() {
                return Err(Refusal::usage(
                    format!("{}: is there already, and is not written over", path.display()),
                    "give another name, or remove the file first",
                ));
            }
            Ok(output)
        };
        let output = self.output.as_ref().map(open).transpose()?;
        let prior = self.prior.as_deref().map(library).transpose()?;
        let palette = self.palette(prior.as_ref())?;
        let weighing = Weighing::new(self.grams, self.balance)?;

        let pool = candidates(&palette, weighing.least_share());
        let count = self.swatches.unwrap_or_else(|| usual_count(&palette, &pool));
        let start = usual(&palette, &pool, count)?;
        let (design, forecast) = match &prior {
            Some(prior) => {
                let (design, forecast) = best(prior, &palette, &pool, &start, noise, console)?;
                (design, Some(forecast))
            }
            None => (start, None),
        };
        let recipes: Vec<Recipe> = design.iter().map(|&index| pool[index].clone()).collect();
        check_identified(&palette, &recipes)?;
        let samples = sample_names(&palette, &recipes);
        let grams: Vec<Vec<(usize, f64)>> = recipes.iter().map(|r| weighing.grams(r)).collect();
        if let Some(output) = output {
            output.write(sheet.csv(&palette, &samples, &grams))?;
        }
        if self.json {
            return console.json(&plan_report::as_json(
                &palette,
                &recipes,
                &samples,
                &grams,
                forecast.as_ref(),
            ));
        }
        plan_report::print_swatches(&palette, &recipes, &samples, &grams, console)?;
        plan_report::print_totals(&palette, &grams, console)?;
        console.line("")?;
        console.line(format!(
            "{} swatches for {} unknowns a wavelength; every pigment is identified",
            recipes.len(),
            palette.unknowns()
        ))?;
        if let Some(forecast) = &forecast {
            plan_report::print_forecast(&palette, forecast, console)?;
        }
        match &self.output {
            Some(path) => console.remark(format!(
                "written: {}; fill it in, then impasto fit {} --reference \"{}\"",
                path.display(),
                path.display(),
                palette.names[Palette::WHITE]
            )),
            None => console.remark("give --output FILE.csv for the measurement file to fill in"),
        }
    }

    fn palette(&self, prior: Option<&PigmentLibrary>) -> anyhow::Result<Palette> {
        let full = |name: &String| -> anyhow::Result<String> {
            Ok(match prior {
                Some(prior) => prior.pigments[prior.find(name)?].name.clone(),
                None => name.trim().to_owned(),
            })
        };
        let colors = self.pigments.iter().map(full).collect::<anyhow::Result<Vec<_>>>()?;
        let black = self.black.as_ref().map(full).transpose()?;
        Ok(Palette::new(&colors, &full(&self.white)?, black.as_deref())?)
    }

    fn replicates(&self) -> anyhow::Result<usize> {
        if (1..=100).contains(&self.replicates) {
            return Ok(self.replicates);
        }
        Err(Refusal::usage(
            format!("--replicates takes 1 to 100, found `{}`", self.replicates),
            "two readings, the sample turned between them, show how far they repeat",
        ))
    }

    fn grid(&self) -> anyhow::Result<Grid> {
        let wrong = || {
            Refusal::usage(
                format!(
                    "--grid takes FIRST,LAST,STEP in nm, within 200 to 2500 and LAST a whole number of steps from FIRST, found `{}`",
                    self.grid
                ),
                "try --grid 400,700,10",
            )
        };
        let [first, last, step] = numbers(&self.grid).ok_or_else(wrong)?;
        let steps = (last - first) / step;
        let whole = (steps - steps.round()).abs() < 1e-6 && (0.0..=5000.0).contains(&steps);
        if !(first >= 200.0 && last <= 2500.0 && step > 0.0 && whole) {
            return Err(wrong());
        }
        Ok(Grid::from_nm(first, step, steps.round() as usize + 1)?)
    }

    fn noise(&self) -> anyhow::Result<Option<ExpectedNoise>> {
        let Some(text) = &self.noise else { return Ok(None) };
        match numbers(text) {
            Some([constant, even])
                if (0.0..1.0).contains(&constant)
                    && (0.0..1.0).contains(&even)
                    && constant + even >= 1e-6 =>
            {
                Ok(Some(ExpectedNoise { constant, even }))
            }
            _ => Err(Refusal::usage(
                format!("--noise takes CONSTANT,EVEN, each 0 to 1 and one above 0, found `{text}`"),
                "try --noise 0.002,0.01",
            )),
        }
    }
}

/// Exactly N numbers with commas between them.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}

/// The design of most information by `prior`, and what to expect of it.
fn best(
    prior: &PigmentLibrary,
    palette: &Palette,
    pool: &[Recipe],
    start: &[usize],
    noise: Option<ExpectedNoise>,
    console: &mut Console<'_>,
) -> anyhow::Result<(Vec<usize>, Forecast)> {
    let pigments =
        palette.names.iter().map(|name| prior.find(name)).collect::<Result<Vec<_>, _>>()?;
    for &index in &pigments {
        let pigment = &prior.pigments[index];
        if !pigment.identified {
            console.warnings(&[format!(
                "{}: the prior does not know its scattering, so that its swatches are chosen by a guess",
                pigment.name
            )])?;
        }
    }
    let left = prior.evidence.as_ref().map_or(0.01, |evidence| evidence.rms.max(1e-4));
    let noise = noise.unwrap_or(ExpectedNoise { constant: 0.002, even: left });
    let information = Information::new(prior, &pigments, pool, noise);
    // The first of the usual design is the white by itself, which is always read.
    let design = optimal(&information, start, 1);
    let forecast = Forecast {
        usual_efficiency: information.efficiency(start, &design),
        deviations: information.deviations(&design),
        usual_deviations: information.deviations(start),
        noise,
    };
    Ok((design, forecast))
}

/// Refuses a plan that a fit would not identify.
fn check_identified(palette: &Palette, recipes: &[Recipe]) -> anyhow::Result<()> {
    let shares: Vec<Vec<f64>> = recipes
        .iter()
        .map(|recipe| {
            let mut shares = vec![0.0; palette.names.len()];
            recipe.shares().into_iter().for_each(|(paint, share)| shares[paint] = share);
            shares
        })
        .collect();
    let unknown = unidentified(&shares, Palette::WHITE);
    if unknown.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = unknown.iter().map(|u| palette.names[u.pigment].as_str()).collect();
    Err(Refusal::data(
        format!("these swatches would not identify `{}`", names.join(", ")),
        "give more --swatches",
    ))
}
