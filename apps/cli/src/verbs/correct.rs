//! `impasto correct`: what to add to a pot of paint that missed its target colour.

use calibrate::library::PigmentLibrary;
use calibrate::matching::{
    Batch, BatchRound, ColorTarget, CorrectRequest, Corrections, Metric, TargetColor,
};
use clap::{Arg, Args};
use documents::{Task, counted, name_list};
use serde_json::{Map, Value, json};
use spectra::color::Lab;
use spectra::{Reflectance, Spectrum};

use crate::console::Console;
use crate::csv_rows;
use crate::failure::{Failure, Result};
use crate::library_choice::{ChosenLibrary, chosen, split};
use crate::progress::waited;
use crate::readings::{ReadingOptions, TargetOptions, condition, srgb, targets};
use crate::request_options::{CommandLine, RequestOptions, without_value};

/// Most names that an error lists.
const NAMES: usize = 8;

/// Find what to add to a batch of paint so that it matches its target
///
/// The batch is the paint in the pot. Give the amounts that were mixed (--made) and the measured
/// spectrum of an opaque film. This finds additions that bring the batch within --tolerance of the
/// target, the least paint first. It starts from the measured spectrum, not from the recipe, and
/// estimates what was weighed and how the paints differ from the library. For a second correction give
/// the earlier reading (--before) and what was added after it (--added) too.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto correct [OPTIONS] [LIBRARY] <TARGET> <BATCH> --made <PIGMENT=GRAMS>..."
)]
pub(crate) struct Correct {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else the Van Gogh oils that ship],
    /// then the target (#rrggbb, L,a,b, a colour of a swatch file or a table, or a measured standard, FILE or
    /// FILE#NAME), then the spectrum
    /// of the batch, FILE or FILE#SAMPLE
    #[arg(required = true, value_name = "[LIBRARY] TARGET BATCH")]
    words: Vec<String>,
    #[command(flatten)]
    request: RequestOptions<CorrectRequest>,
    /// Grams (or parts) of a pigment that are in the pot (may be repeated)
    // After the first option of the request.
    #[arg(long, value_name = "PIGMENT=GRAMS", required = true, num_args = 1.., display_order = 0)]
    made: Vec<String>,
    /// Grams of paint in the pot [default: the sum of --made and --added]
    #[arg(long, value_name = "GRAMS", allow_hyphen_values = true, display_order = 1)]
    grams: Option<f64>,
    /// Grams of a pigment that were added to the pot since the reading --before (may be repeated)
    #[arg(long, value_name = "PIGMENT=GRAMS", num_args = 1.., display_order = 2)]
    added: Vec<String>,
    /// Reading of the pot before --added, FILE or FILE#SAMPLE
    #[arg(long, value_name = "FILE", display_order = 3)]
    before: Option<String>,
    /// Light, as in `color`, with its weight where there are several (may be repeated)
    #[arg(long, value_name = "LIGHT[=WEIGHT]", default_value = "D65")]
    illuminant: Vec<String>,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
    #[command(flatten)]
    target: TargetOptions,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Print JSON: target, batch, differences, and a list of corrections
    #[arg(long)]
    json: bool,
    /// Print the corrections as CSV, a row for each pigment of each correction
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl CommandLine for CorrectRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "by" => without_value(option, Metric::Cie1976.name()),
            "stock" => option.value_name("PIGMENT=GRAMS").num_args(1..),
            "strength" => option.value_name("PIGMENT=FACTOR").num_args(1..),
            "weighing" => option.value_name("DEVIATION"),
            "only" | "without" => option.value_name("PIGMENT"),
            "at_most" => option.value_name("K"),
            "least_grams" => option.long("least").value_name("GRAMS"),
            "most_grams" => option.long("most").value_name("GRAMS"),
            "tolerance" => option.value_name("DELTA_E"),
            "count" => option.value_name("N"),
            _ => option,
        }
    }
}

impl Correct {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, words) = split(&self.words, true);
        let ChosenLibrary { library, .. } = chosen(path.as_deref(), console)?;
        let [target, pot] = words else {
            return Err(Failure::usage(
                format!("a target and a batch are wanted, found {}", counted(words.len(), "word")),
                "try impasto correct standard.csv batch.csv --made \"Zinc White=440\"",
            ));
        };
        let target =
            one(target, "a target", targets(target, &self.target, &self.reading, console)?)?;
        let made = amounts("--made", &self.made)?;
        let added = amounts("--added", &self.added)?;
        if self.before.is_some() == added.is_empty() {
            return Err(Failure::usage(
                "a second correction needs the reading before the first one, and what was added after it",
                "give both: --before FILE#SAMPLE --added PIGMENT=GRAMS",
            ));
        }
        let in_pot = made.iter().chain(&added).map(|(_, grams)| grams);
        let grams = self.grams.unwrap_or_else(|| in_pot.sum());
        let reflectance = self.batch_spectrum(pot, console)?;
        let mut rounds = Vec::new();
        if let Some(before) = &self.before {
            rounds.push(BatchRound { reflectance: self.batch_spectrum(before, console)?, added });
        }
        let batch = Batch { made, grams, reflectance, rounds };
        let conditions =
            self.illuminant.iter().map(|text| condition(text, &self.observer, console));
        let conditions = conditions.collect::<Result<_>>()?;
        let mut request = self.request.clone();
        let stock = amounts("--stock", &request.take("stock"))?;
        let strength = amounts("--strength", &request.take("strength"))?;
        let options = CorrectRequest { conditions, stock, strength, ..request.request()? };
        let found = waited("searching corrections", console, || {
            options.run(&library, &target, &batch, &Task::default())
        })?;
        console.remarks(&found.remarks)?;
        let report = Report { library: &library, options: &options, grams };
        if self.csv {
            return console.csv_rows(&report.rows(&found));
        }
        if self.json { console.json(&report.json(&found)) } else { report.print(&found, console) }
    }

    /// Reads the one spectrum of the batch.
    fn batch_spectrum(
        &self,
        pot: &str,
        console: &mut Console<'_>,
    ) -> Result<Spectrum<Reflectance>> {
        let measured = one(pot, "a batch", targets(pot, &self.target, &self.reading, console)?)?;
        match measured.color {
            TargetColor::Reflectance(reflectance) => Ok(reflectance),
            _ => Err(Failure::usage(
                format!("a batch is a measured spectrum, found the colour `{pot}`"),
                "give the file of its reading: FILE or FILE#SAMPLE",
            )),
        }
    }
}

/// The only one of the colours that `text` names.
fn one(text: &str, what: &str, colors: Vec<ColorTarget>) -> Result<ColorTarget> {
    let names: Vec<String> = colors.iter().map(|color| color.name.clone()).collect();
    let mut colors = colors.into_iter();
    match (colors.next(), names.len()) {
        (Some(color), 1) => Ok(color),
        (_, count) => Err(Failure::usage(
            format!("{what} is one colour, and {text} holds {count}"),
            format!("name one of them, FILE#NAME: {}", name_list(&names, NAMES, ", ")),
        )),
    }
}

/// Parses amounts of the form `PIGMENT=GRAMS`.
fn amounts(option: &str, texts: &[String]) -> Result<Vec<(String, f64)>> {
    let amounts = texts.iter().map(|text| {
        let found = text.rsplit_once('=').and_then(|(name, grams)| {
            let grams: f64 = grams.trim().parse().ok().filter(|g| (0.0..1e9).contains(g))?;
            Some((name.trim().to_owned(), grams))
        });
        found.ok_or_else(|| {
            Failure::usage(
                format!("{option} takes PIGMENT=GRAMS, found `{text}`"),
                format!("try {option} \"Cobalt Blue=20\""),
            )
        })
    });
    amounts.collect()
}

/// Names and settings that all corrections of a run share.
struct Report<'a> {
    library: &'a PigmentLibrary,
    options: &'a CorrectRequest,
    grams: f64,
}

impl Report<'_> {
    fn lights(&self) -> impl Iterator<Item = &str> {
        self.options.conditions.iter().map(|condition| condition.viewing.illuminant.name())
    }

    /// Differences with the names of their lights.
    fn under(&self, differences: &[f64]) -> String {
        let each = differences.iter().zip(self.lights());
        each.map(|(d, light)| format!("{d:.2} ({light})")).collect::<Vec<_>>().join(", ")
    }

    fn print(&self, found: &Corrections, console: &mut Console<'_>) -> Result<()> {
        let color = |lab: Lab| {
            let white = spectra::color::RgbSpace::Srgb.white();
            srgb(lab.to_xyz(white), white)
        };
        let colors = [("target", found.target.lab[0]), ("batch", found.batch[0])];
        let [target, batch] = colors.map(|(name, lab)| {
            format!("{name:8} {}  Lab {}", console.srgb(color(lab)), csv_rows::lab(lab))
        });
        console.line(target)?;
        console.line(format!("{batch}  {} g", shown(self.grams)))?;
        let off = self.under(&found.batch_delta_e);
        console.line(format!("CIEDE2000 of the batch from the target: {off}"))?;
        let off = self.under(&found.recipe_delta_e);
        console.line(format!("CIEDE2000 of the batch from what its recipe predicts: {off}"))?;
        console.line("in the pot by its readings:")?;
        for paint in &found.pot {
            console.line(format!(
                "       {:>10} g  {} (made {} g, strength {:.2})",
                shown(paint.grams),
                self.library[paint.pigment].name,
                shown(paint.made),
                paint.strength,
            ))?;
        }
        if let Some(rms) = found.batch_rms_percent {
            console.line(format!(
                "reflectance of the batch from the target: {rms:.2} % (root mean square)"
            ))?;
        }
        let tolerance = self.options.tolerance;
        let unit = self.options.metric.unit();
        if found.is_near {
            return console
                .line(format!("within {tolerance} {unit} of the target: nothing to add"));
        }
        console.line(if found.corrections.is_empty() {
            "no addition is likely to bring the batch nearer to the target".to_owned()
        } else if found.reaches {
            format!("within {tolerance} {unit} of the target, the least addition first:")
        } else {
            format!("no addition comes within {tolerance} {unit} of the target; the nearest:")
        })?;
        for (rank, correction) in found.corrections.iter().enumerate() {
            let patch = console.patch(color(correction.lab[0]));
            let rms = correction.rms_percent.map(|rms| format!("; reflectance {rms:.2} %"));
            let rms = rms.unwrap_or_default();
            console.line(format!(
                "{:>3}  {patch}add {} g, then {} from the target{rms}; error to expect {:.2}",
                rank + 1,
                shown(correction.grams),
                self.under(&correction.delta_e),
                correction.expected,
            ))?;
            for (id, grams) in &correction.additions {
                let name = &self.library[*id].name;
                let all = correction.out_of_stock.contains(id);
                let note = if all { "  (all that is in stock)" } else { "" };
                console.line(format!("       {:>10} g  {name}{note}", shown(*grams)))?;
            }
        }
        Ok(())
    }

    fn json(&self, found: &Corrections) -> Value {
        let corrections = found.corrections.iter().map(|correction| {
            let additions = correction.additions.iter().map(|(id, grams)| {
                let all = correction.out_of_stock.contains(id);
                json!({ "name": self.library[*id].name, "grams": grams, "all_in_stock": all })
            });
            json!({
                "grams": correction.grams,
                "additions": additions.collect::<Vec<Value>>(),
                "delta_e": self.differences(&correction.delta_e),
                "distance": correction.distance,
                "expected": correction.expected,
                "rms_percent": correction.rms_percent,
                "lab": self.lab(&correction.lab),
                "wavelengths_nm": self.library.grid.wavelengths_nm().collect::<Vec<f64>>(),
                "reflectance": correction.reflectance,
            })
        });
        let pot = found.pot.iter().map(|paint| {
            json!({
                "name": self.library[paint.pigment].name,
                "made": paint.made,
                "grams": paint.grams,
                "strength": paint.strength,
            })
        });
        json!({
            "target": found.target.name,
            "target_lab": self.lab(&found.target.lab),
            "batch_lab": self.lab(&found.batch),
            "batch_grams": self.grams,
            "pot": pot.collect::<Vec<Value>>(),
            "batch_delta_e": self.differences(&found.batch_delta_e),
            "recipe_delta_e": self.differences(&found.recipe_delta_e),
            "by": self.options.metric.name(),
            "unit": self.options.metric.unit(),
            "batch_rms_percent": found.batch_rms_percent,
            "tolerance": self.options.tolerance,
            "is_near": found.is_near,
            "reaches": found.reaches,
            "corrections": corrections.collect::<Vec<Value>>(),
        })
    }

    /// One row for each pigment of each correction.
    fn rows(&self, found: &Corrections) -> Vec<Value> {
        let mut rows = Vec::new();
        for (rank, correction) in found.corrections.iter().enumerate() {
            for (id, grams) in &correction.additions {
                rows.push(json!({
                    "correction": rank + 1,
                    "pigment": self.library[*id].name,
                    "grams": grams,
                    "distance": correction.distance,
                    "expected": correction.expected,
                }));
            }
        }
        rows
    }

    fn lab(&self, labs: &[Lab]) -> Value {
        self.by_light(labs.iter().map(|lab| json!(lab.to_array())))
    }

    fn differences(&self, found: &[f64]) -> Value {
        self.by_light(found.iter().map(|d| json!(d)))
    }

    /// JSON object with one value per light, keyed by its name.
    fn by_light(&self, values: impl Iterator<Item = Value>) -> Value {
        Value::Object(self.lights().map(str::to_owned).zip(values).collect::<Map<_, _>>())
    }
}

/// Grams as text, with at least three significant digits.
fn shown(grams: f64) -> String {
    let decimals = (2 - grams.abs().max(1e-9).log10().floor() as i32).clamp(0, 6);
    format!("{grams:.*}", usize::try_from(decimals).unwrap_or(0))
}
