//! `impasto quadrature`: chooses a few wavelengths and weights that give XYZ.

use std::path::PathBuf;

use calibrate::evaluate::Viewing;
use calibrate::quadrature::{
    Quadrature as Rule, QuadratureChoice, QuadratureError, QuadratureRequest,
};
use clap::{Arg, Args};
use documents::Task;
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::named_or_default;
use crate::progress::waited;
use crate::readings::{ViewingOptions, remark_coverage};
use crate::request_options::{CommandLine, RequestOptions};

impl CommandLine for QuadratureRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "nodes" => option.short('n').value_name("N"),
            "mixtures" => option.value_name("N"),
            _ => option,
        }
    }
}

/// Choose wavelengths and weights that give XYZ under a light
///
/// With a library, prints the colour error against full integration over random mixtures (films
/// that hide, of one to four pigments). No method was fitted to these mixtures. For `effective`, it also
/// prints the error over thin films on coloured grounds.
#[derive(Debug, Args)]
pub(crate) struct Quadrature {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else none]
    library: Option<PathBuf>,
    #[command(flatten)]
    request: RequestOptions<QuadratureRequest>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: nodes_nm, weights, error (null without a library); for `effective` also pigments (name,
    /// absorption, scattering at the nodes) and error_over_grounds
    #[arg(long)]
    json: bool,
    /// Print the wavelengths and weights as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

/// Words for one mixture and for several.
const MIXTURES: [&str; 2] = ["random mixture", "random mixtures"];
/// Words for one film over a ground and for several.
const FILMS: [&str; 2] = ["film over a random ground", "films over random grounds"];

impl Quadrature {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing(console)?;
        let library = named_or_default(self.library.as_deref())?.map(|(_, library)| library);
        let request = QuadratureRequest { viewing, ..self.request.request()? };
        let needs_library =
            matches!(request.method, Some(QuadratureChoice::Library | QuadratureChoice::Effective));
        if needs_library && library.is_none() {
            return Err(Failure::usage(
                "--method library and --method effective need a pigment library",
                "try impasto quadrature LIBRARY.json",
            ));
        }
        let outcome = waited("fitting wavelengths", console, || {
            request.run(library.as_ref(), &Task::default())
        })?;
        if let Some(library) = &library
            && (outcome.effective.is_some() || request.mixtures > 0)
        {
            remark_coverage(library.grid, console)?;
        }
        if self.csv {
            return console.csv_rows(&csv_rows(&outcome.rule));
        }
        if self.json {
            return console.json(&outcome.to_json(library.as_ref()));
        }
        rows(&outcome.rule, &request.viewing, console)?;
        for (error, of) in [(outcome.error, MIXTURES), (outcome.error_over_grounds, FILMS)] {
            if let Some(error) = error {
                console.line(figures(&request, of, &error))?;
            }
        }
        Ok(())
    }
}

/// The error over films of one kind as a sentence.
fn figures(request: &QuadratureRequest, [one, many]: [&str; 2], error: &QuadratureError) -> String {
    let films = documents::counted_as(request.mixtures, one, many);
    let seed = request.seed;
    let QuadratureError { mean, p95, max } = error;
    format!(
        "CIEDE2000 over {films} (seed {seed}): mean {mean:.3}, 95 % below {p95:.3}, largest {max:.3}"
    )
}

/// The wavelengths with their weights, one row each.
fn csv_rows(rule: &Rule) -> Vec<Value> {
    let pairs = rule.nodes_nm.iter().zip(&rule.weights);
    pairs.map(|(nm, weights)| json!({"nm": nm, "weights": weights})).collect()
}

/// Prints the wavelengths with their weights.
fn rows(rule: &Rule, viewing: &Viewing, console: &mut Console<'_>) -> Result<()> {
    let count = rule.nodes_nm.len();
    let light = viewing.illuminant.name();
    console.line(format!(
        "{} for {light}, observer {}",
        documents::counted(count, "wavelength"),
        viewing.observer
    ))?;
    console.line("     nm          X          Y          Z")?;
    for (nm, [x, y, z]) in rule.nodes_nm.iter().zip(&rule.weights) {
        console.line(format!("{nm:7.2} {x:10.4} {y:10.4} {z:10.4}"))?;
    }
    Ok(())
}
