//! Two sets of measurements compared sample by sample, as quality control compares a batch with its standard.

use documents::hint::Explain;
use documents::name_list;
use pigment::digits::rounded;
use pigment::evaluate::{lab, percentile};
use pigment::remark::Remark;
use pigment::visible_band::{BandError, check_visible_band};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use spectra::Viewing;
use spectra::color::{ColorDifferences, Lab};

use crate::measurement::MeasurementTable;

/// An error lists at most this many names.
const LISTED: usize = 8;

/// Options of [`compare_sets`].
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a comparison of two sets of measurements")]
pub struct CompareRequest {
    /// Largest CIEDE2000 difference that passes [default: no sample passes or fails]
    pub tolerance: Option<f64>,
    /// Light and observer of the colours
    pub viewing: Viewing,
}

/// A sample of both sets.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedSample {
    /// Name of the sample, with its backing and thickness if it has several spectra.
    pub name: String,
    /// Colour in the first set.
    pub lab: Lab,
    /// Colour in the second set, the standard.
    pub standard: Lab,
    /// Differences between the two colours.
    pub differences: ColorDifferences,
    /// Whether CIEDE2000 is within the tolerance. `None` without one.
    pub passes: Option<bool>,
}

/// Two sets of measurements compared.
#[derive(Debug, Clone, PartialEq)]
pub struct SetComparison {
    /// Samples of both sets, in the order of the first.
    pub samples: Vec<ComparedSample>,
    /// Names that only the first set has.
    pub only_first: Vec<String>,
    /// Names that only the second set has.
    pub only_second: Vec<String>,
    /// Mean CIEDE2000 of all samples.
    pub mean: f64,
    /// 95th percentile of CIEDE2000.
    pub p95: f64,
    /// Largest CIEDE2000 of all samples.
    pub max: f64,
    /// Mean difference of L*, a* and b*, first minus second. It shows an error that all samples share.
    pub shift: [f64; 3],
    /// Tolerance of the request.
    pub tolerance: Option<f64>,
    /// Light and observer of the colours.
    pub viewing: Viewing,
    /// Warnings about the wavelengths and about samples that only one set has.
    pub remarks: Vec<Remark>,
}

/// Compares the samples of `first` with the samples of `second` that have the same names.
///
/// Repeated readings are averaged. Each set keeps its own wavelengths.
///
/// ```
/// use calibrate::{CompareRequest, Readings, compare_sets};
///
/// let set = |name: &str, red: &str| {
///     let text = format!("sample,400,500,600,700\nred,0.05,0.06,{red}\ngrey,0.3,0.3,0.3,0.3\n");
///     Readings::from_csv(name, text.as_bytes())
/// };
/// let request = CompareRequest { tolerance: Some(1.0), ..CompareRequest::default() };
/// let batch = set("batch.csv", "0.50,0.62")?;
/// let standard = set("standard.csv", "0.55,0.65")?;
/// let found = compare_sets(&batch.table, &standard.table, &request)?;
/// assert_eq!(found.failed().map(|sample| sample.name.as_str()).collect::<Vec<_>>(), ["red"]);
/// assert!(found.shift[0] < 0.0, "the batch is darker");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`CompareError`] for an impossible tolerance, sets without a common sample, and wavelengths that are not
/// visible.
pub fn compare_sets(
    first: &MeasurementTable,
    second: &MeasurementTable,
    request: &CompareRequest,
) -> Result<SetComparison, CompareError> {
    let tolerance = request.tolerance;
    if let Some(value) = tolerance.filter(|value| !(value.is_finite() && *value >= 0.0)) {
        return Err(CompareError::Tolerance(value));
    }
    let mut remarks = Vec::from_iter(check_visible_band(first.grid)?);
    if second.grid != first.grid {
        remarks.extend(check_visible_band(second.grid)?);
    }
    let colors = |table: &MeasurementTable| -> Vec<(String, Lab)> {
        let weights = request.viewing.weights(table.grid).expect("the method fits the grid");
        let spectra = table.averaged().spectra.into_iter();
        spectra.map(|spectrum| (spectrum.name, lab(&weights, &spectrum.reflectance))).collect()
    };
    let first = colors(first);
    let second = colors(second);
    let missing = |from: &[(String, Lab)], among: &[(String, Lab)]| -> Vec<String> {
        let names = from.iter().map(|(name, _)| name);
        names.filter(|name| among.iter().all(|(other, _)| other != *name)).cloned().collect()
    };
    let only_first = missing(&first, &second);
    let only_second = missing(&second, &first);
    let samples = first.iter().filter_map(|(name, lab)| {
        let (_, standard) = second.iter().find(|(other, _)| other == name)?;
        let differences = ColorDifferences::between(*standard, *lab);
        let passes = tolerance.map(|tolerance| differences.ciede2000 <= tolerance);
        let (lab, standard) = (*lab, *standard);
        Some(ComparedSample { name: name.clone(), lab, standard, differences, passes })
    });
    let samples: Vec<ComparedSample> = samples.collect();
    if samples.is_empty() {
        return Err(CompareError::NothingInCommon { first: only_first, second: only_second });
    }
    for (set, names) in [("first", &only_first), ("second", &only_second)] {
        if !names.is_empty() {
            let names = name_list(names, LISTED, ", ");
            remarks.push(Remark::warning(format!("only in the {set} set: {names}")));
        }
    }
    let errors: Vec<f64> = samples.iter().map(|sample| sample.differences.ciede2000).collect();
    let count = samples.len() as f64;
    let shift = [0, 1, 2].map(|axis: usize| {
        let steps = samples.iter().map(|s| s.lab.to_array()[axis] - s.standard.to_array()[axis]);
        steps.sum::<f64>() / count
    });
    Ok(SetComparison {
        mean: errors.iter().sum::<f64>() / count,
        p95: percentile(&errors, 95.0),
        max: percentile(&errors, 100.0),
        shift,
        samples,
        only_first,
        only_second,
        tolerance,
        viewing: request.viewing.clone(),
        remarks,
    })
}

impl SetComparison {
    /// Samples outside of the tolerance.
    pub fn failed(&self) -> impl Iterator<Item = &ComparedSample> {
        self.samples.iter().filter(|sample| sample.passes == Some(false))
    }

    /// The samples as rows: sample, ciede2000, cie1976, dl, da, db, passes (null without a tolerance).
    #[must_use]
    pub fn rows(&self) -> Vec<Value> {
        let row = |sample: &ComparedSample| {
            let [first, second] = [sample.lab, sample.standard].map(Lab::to_array);
            json!({
                "sample": sample.name,
                "ciede2000": rounded(sample.differences.ciede2000),
                "cie1976": rounded(sample.differences.cie1976),
                "dl": rounded(first[0] - second[0]),
                "da": rounded(first[1] - second[1]),
                "db": rounded(first[2] - second[2]),
                "passes": sample.passes,
            })
        };
        self.samples.iter().map(row).collect()
    }

    /// [`Self::rows`], each with its illuminant, so that you can join tables of several lights.
    #[must_use]
    pub fn rows_under_light(&self) -> Vec<Value> {
        let mut rows = self.rows();
        for row in &mut rows {
            row["illuminant"] = self.viewing.illuminant.name().into();
        }
        rows
    }

    /// The comparison as JSON: illuminant, observer, samples (see [`Self::rows`]), mean, p95, max, shift,
    /// tolerance, failed, only_first, only_second.
    #[must_use]
    pub fn to_json(&self) -> Value {
        json!({
            "illuminant": self.viewing.illuminant.name(),
            "observer": self.viewing.observer.name(),
            "samples": self.rows(),
            "mean": rounded(self.mean),
            "p95": rounded(self.p95),
            "max": rounded(self.max),
            "shift": self.shift.map(rounded),
            "tolerance": self.tolerance,
            "failed": self.tolerance.map(|_| self.failed().count()),
            "only_first": self.only_first,
            "only_second": self.only_second,
        })
    }
}

/// Sets of measurements that cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum CompareError {
    /// The tolerance is impossible.
    #[error("a tolerance is 0 or above, found `{0}`")]
    #[hint("try [tolerance=1]")]
    #[fault(Setting)]
    Tolerance(f64),
    /// No sample has the same name in both sets.
    #[error(
        "no sample has the same name in both sets; first: {}; second: {}",
        name_list(first, LISTED, ", "),
        name_list(second, LISTED, ", ")
    )]
    #[hint("names must be spelled alike in both")]
    NothingInCommon {
        /// Names of the first set.
        first: Vec<String>,
        /// Names of the second set.
        second: Vec<String>,
    },
    /// The readings have no visible wavelength.
    #[error(transparent)]
    Band(#[from] BandError),
}
