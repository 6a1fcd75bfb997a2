//! Pigments at points: which pigments of a library explain each measured spectrum, for example of a
//! fibre-optic spectrometer held to a painting.
//!
//! Comments of the fields are the help texts of the command line and the descriptions of the schema.

use std::path::PathBuf;

use calibrate::Residuals;
use calibrate::measurement::{AveragedSpectra, AveragedSpectrum, Film};
use pigment::PigmentLibrary;
use pigment::evaluate::Remark;
use pigment::library::Input;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::films::settings::{ModelError, PigmentGroup};
use crate::mapping::groups::Column;
use crate::mapping::{Explained, Mapper};
use crate::outcomes::{parts_words, percent};
use crate::pixel_maps::{MapError, Mask};
use crate::request::{MapRequest, MapRequestError, groups_schema, read_groups};
use crate::surveyed::SpotPigment;

/// Options of identifying pigments in measured spectra. [`Self::run`] identifies them.
///
/// ```
/// use calibrate::measurement::{AveragedSpectra, AveragedSpectrum, Film};
/// use maps::IdentifyRequest;
/// use pigment::PigmentLibrary;
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let recipe = oils.recipe([("Zinc White", 0.8), ("Viridian", 0.2)])?;
/// let reflectance = oils.mix(recipe)?.hiding(oils.saunderson);
/// let spot = AveragedSpectrum {
///     sample: "leaf".to_owned(),
///     film: Film::Paint,
///     name: "leaf".to_owned(),
///     reflectance,
/// };
/// let spots = AveragedSpectra { grid: oils.grid, spectra: vec![spot] };
/// let found = IdentifyRequest::default().run(&oils, &spots)?;
/// let leaf = &found.spectra[0];
/// let viridian = leaf.pigments.iter().find(|pigment| pigment.name == "Viridian").unwrap();
/// assert!((viridian.share - 0.2).abs() < 0.02 && viridian.presence > 0.95, "{leaf:?}");
/// assert!(leaf.chi2 < 0.1 && leaf.sets[0].probability > 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of identifying pigments in measured spectra")]
pub struct IdentifyRequest {
    /// Most pigments of one spectrum, 1 to 4 [default: 3]
    pub at_most: usize,
    /// A pigment that may take part; may be repeated [default: all whose S is known]
    pub palette: Vec<String>,
    /// Pigments that count as one, such as `whites=Lead White,Zinc White`; may be repeated
    #[serde(deserialize_with = "read_groups")]
    #[schemars(schema_with = "groups_schema")]
    pub groups: Vec<PigmentGroup>,
    /// Name each pigment by itself, also those that the wavelengths cannot tell apart
    pub apart: bool,
    /// Standard deviation of the noise at a wavelength, as a fraction [default: 0.003]
    pub noise: Option<f64>,
    /// Errors of mixtures that the library had not seen, from the residuals of `impasto validate`
    /// [default: for the Van Gogh oils, the residuals that ship with them]
    #[schemars(with = "Option<String>")]
    pub residuals: Option<PathBuf>,
    /// How far K and S of the library may be off, as a fraction [default: 0.1 for a library without
    /// residuals]
    pub model_error: Option<f64>,
    /// Amount by which a further pigment must lower chi-square to be named [default: 2]
    pub penalty: f64,
    /// Most sets of pigments that are listed for a spectrum [default: 5]
    pub sets: usize,
}

impl Default for IdentifyRequest {
    fn default() -> Self {
        let MapRequest { penalty, .. } = MapRequest::default();
        Self {
            // A single spectrum seldom tells more: with 4, recall on measured swatches is lower.
            at_most: 3,
            palette: Vec::new(),
            groups: Vec::new(),
            apart: false,
            noise: None,
            residuals: None,
            model_error: None,
            penalty,
            sets: 5,
        }
    }
}

/// Pigments of measured spectra.
#[derive(Debug, Clone, PartialEq)]
pub struct Identified {
    /// Wavelengths of the spectra in nm.
    pub measured_nm: Vec<f64>,
    /// Wavelengths of the library in nm.
    pub mapped_nm: Vec<f64>,
    /// Groups of pigments that count as one.
    pub groups: Vec<Column>,
    /// Names of the pigments that take no part: those guessed from a colour, and masstones that look
    /// like a measured pigment.
    pub left_out: Vec<String>,
    /// Effective number of independent wavelengths.
    pub effective_bands: f64,
    /// Remarks on the library, the spectra and the assumed errors.
    pub remarks: Vec<Remark>,
    /// One result a spectrum, in the order of the spectra.
    pub spectra: Vec<IdentifiedSpectrum>,
    library_sha256: String,
    model_error: Value,
}

/// A set of pigments or groups that explains a spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentSet {
    /// Names of pigments or groups with their shares, 0 to 1, the greatest first.
    pub parts: Vec<(String, f64)>,
    /// Probability that these are the pigments, 0 to 1. It weighs all sets that explain the spectrum.
    pub probability: f64,
    /// Chi-square per degree of freedom.
    pub chi2: f64,
}

/// Pigments of one spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct IdentifiedSpectrum {
    /// Name of the spectrum.
    pub name: String,
    /// Whether the spectrum can be compared with mixtures, and whether one explains it.
    pub mask: Mask,
    /// Pigments and groups with a share in the best set or a probability of 1 % or more. The most probable
    /// comes first. There are none unless the mask is [`Mask::Mapped`].
    pub pigments: Vec<SpotPigment>,
    /// Sets of pigments, the most probable first. There are none unless the mask is [`Mask::Mapped`].
    pub sets: Vec<PigmentSet>,
    /// Chi-square of the best set per degree of freedom, or NaN if we did not compare the spectrum.
    pub chi2: f64,
    /// Root mean square difference in reflectance between the spectrum and the best set, or NaN.
    pub rms: f64,
    /// Measured reflectance at each wavelength.
    pub measured: Vec<f64>,
    /// Reflectance of the best set at the wavelengths of the library. Empty if we did not compare.
    pub mapped: Vec<f64>,
}

/// A pigment or a set with a lower probability is not listed.
const LEAST_PROBABLE: f64 = 0.01;

/// The text does not show pigments with a lower probability.
const LEAST_SHOWN: f64 = 0.05;

impl IdentifyRequest {
    /// Identifies the pigments of each spectrum of `spots`. Every spectrum stands for itself: no other spectrum
    /// changes its result. Films must hide what is below them. Spectra of bare cards are left out with a remark.
    ///
    /// # Errors
    /// [`MapRequestError`] for residuals that cannot be read or do not suit the library, a setting out of
    /// range, an unknown pigment, or spectra that hardly overlap with the library.
    pub fn run(
        &self,
        library: &PigmentLibrary,
        spots: &AveragedSpectra,
    ) -> Result<Identified, MapRequestError> {
        self.run_with(library, spots, None)
    }

    /// Identifies pigments like [`Self::run`], with `residuals` that you hold instead of a file of them.
    ///
    /// # Errors
    /// [`MapRequestError`] for the reasons of [`Self::run`].
    pub fn run_with(
        &self,
        library: &PigmentLibrary,
        spots: &AveragedSpectra,
        residuals: Option<Residuals>,
    ) -> Result<Identified, MapRequestError> {
        let mut settings = self.as_map().settings_with(None, None, library)?;
        settings.model_error = residuals.map(ModelError::Residuals).or(settings.model_error);
        let nm: Vec<f64> = spots.grid.wavelengths_nm().collect();
        let mapper = Mapper::new(library, &nm, &settings).map_err(MapRequestError::of)?;
        let mut remarks = mapper.remarks().to_vec();
        remarks.extend(mapper.assumed_error(self.model_error.is_some()));
        let (paint, bare): (Vec<&AveragedSpectrum>, Vec<&AveragedSpectrum>) =
            spots.spectra.iter().partition(|spectrum| spectrum.film == Film::Paint);
        if !bare.is_empty() {
            let bare = documents::counted_as(bare.len(), "spectrum", "spectra");
            remarks
                .push(Remark::note(format!("left out {bare} of bare cards, which hold no paint")));
        }
        let spectra = paint.into_iter().map(|spectrum| {
            let narrow: Vec<f32> = spectrum.reflectance.iter().map(|value| *value as f32).collect();
            let explained = mapper.explain(&narrow)?;
            self.told(library, &mapper, spectrum, explained)
        });
        let spectra = spectra.collect::<Result<Vec<_>, MapError>>().map_err(MapRequestError::of)?;
        let columns = mapper.columns().iter();
        Ok(Identified {
            measured_nm: nm,
            mapped_nm: library.grid.wavelengths_nm().collect(),
            groups: columns.filter(|column| column.pigments.len() > 1).cloned().collect(),
            left_out: mapper.left_out().to_vec(),
            effective_bands: mapper.effective_bands(),
            remarks,
            spectra,
            library_sha256: Input::new("", library.to_json().as_bytes()).sha256,
            model_error: mapper.model_error().to_json(),
        })
    }

    /// The options that a map has too.
    fn as_map(&self) -> MapRequest {
        MapRequest {
            at_most: self.at_most,
            palette: self.palette.clone(),
            groups: self.groups.clone(),
            apart: self.apart,
            noise: self.noise,
            residuals: self.residuals.clone(),
            model_error: self.model_error,
            penalty: self.penalty,
            ..MapRequest::default()
        }
    }

    fn told(
        &self,
        library: &PigmentLibrary,
        mapper: &Mapper,
        spectrum: &AveragedSpectrum,
        Explained { mask, result, sets, best }: Explained,
    ) -> Result<IdentifiedSpectrum, MapError> {
        let columns = mapper.columns();
        let is_mapped = mask == Mask::Mapped;
        let listed = columns.iter().enumerate().filter(|(place, _)| {
            is_mapped && (result.share[*place] > 0.0 || result.presence[*place] >= LEAST_PROBABLE)
        });
        let mut pigments: Vec<SpotPigment> = listed
            .map(|(place, column)| SpotPigment {
                name: column.name.clone(),
                share: result.share[place],
                share_sd: result.share_sd[place],
                presence: result.presence[place],
            })
            .collect();
        pigments
            .sort_by(|a, b| b.presence.total_cmp(&a.presence).then(b.share.total_cmp(&a.share)));
        let likely = sets.into_iter().filter(|set| is_mapped && set.probability >= LEAST_PROBABLE);
        let sets = likely.take(self.sets.max(1)).map(|set| PigmentSet {
            parts: (set.parts.into_iter())
                .map(|(column, share)| (columns[column].name.clone(), share))
                .collect(),
            probability: set.probability,
            chi2: set.chi2,
        });
        let mapped = match best.is_empty() {
            true => Vec::new(),
            false => library.mix(library.recipe(best)?)?.hiding(library.saunderson),
        };
        Ok(IdentifiedSpectrum {
            name: spectrum.name.clone(),
            mask,
            pigments,
            sets: sets.collect(),
            chi2: result.chi2,
            rms: result.rms,
            measured: spectrum.reflectance.clone(),
            mapped,
        })
    }
}

impl Identified {
    /// The results as JSON. A number that we do not know is null.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let groups = self.groups.iter().map(|group| (group.name.clone(), json!(group.pigments)));
        json!({
            "library_sha256": self.library_sha256,
            "model_error": self.model_error,
            "effective_bands": self.effective_bands,
            "groups": groups.collect::<Map<String, Value>>(),
            "left_out": self.left_out,
            "measured_nm": self.measured_nm,
            "mapped_nm": self.mapped_nm,
            "spectra": self.spectra.iter().map(IdentifiedSpectrum::to_json).collect::<Vec<_>>(),
        })
    }

    /// A row for each pigment of each set, and one row for a spectrum that no set explains.
    #[must_use]
    pub fn rows(&self) -> Vec<Value> {
        self.spectra.iter().flat_map(IdentifiedSpectrum::rows).collect()
    }
}

impl IdentifiedSpectrum {
    fn to_json(&self) -> Value {
        let sets = self.sets.iter().map(|set| {
            let parts = set.parts.iter();
            let parts = parts.map(|(name, share)| json!({ "pigment": name, "share": share }));
            json!({
                "probability": set.probability,
                "chi2": set.chi2,
                "pigments": parts.collect::<Vec<Value>>(),
            })
        });
        json!({
            "spectrum": self.name,
            "result": self.mask.name(),
            "pigments": self.pigments.iter().map(SpotPigment::to_json).collect::<Vec<Value>>(),
            "sets": sets.collect::<Vec<Value>>(),
            "chi2": self.chi2,
            "rms": self.rms,
            "measured": self.measured,
            "mapped": self.mapped,
        })
    }

    fn rows(&self) -> Vec<Value> {
        let start = json!({
            "spectrum": self.name,
            "result": self.mask.name(),
            "set": null,
            "probability": null,
            "pigment": null,
            "share": null,
            "share_sd": null,
            "presence": null,
            "chi2": self.chi2,
            "rms": self.rms,
        });
        let mut rows = Vec::new();
        for (rank, set) in (1..).zip(&self.sets) {
            for (name, share) in &set.parts {
                let mut row = start.clone();
                row["set"] = json!(rank);
                row["probability"] = json!(set.probability);
                row["pigment"] = json!(name);
                row["share"] = json!(share);
                row["chi2"] = json!(set.chi2);
                let pigment = self.pigments.iter().find(|pigment| pigment.name == *name);
                if let Some(pigment) = pigment {
                    row["presence"] = json!(pigment.presence);
                    // Deviation and residual belong to the shares of the best set.
                    let is_best = pigment.share == *share;
                    row["share_sd"] = if is_best { json!(pigment.share_sd) } else { Value::Null };
                }
                rows.push(row);
            }
        }
        if rows.is_empty() { vec![start] } else { rows }
    }

    /// The spectrum as lines of text: its name with the misfit, its pigments with shares, deviations and
    /// probabilities, and the sets of pigments that explain it.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let misfit = format!("residual {:.4}, chi-square {:.2}", self.rms, self.chi2);
        let name = &self.name;
        let mut lines = match self.mask {
            Mask::Mapped => vec![format!("{name}: {misfit}")],
            Mask::OutOfGamut => {
                vec![format!("{name}: no mixture of these pigments explains it; {misfit}")]
            }
            Mask::TooDark => vec![format!(
                "{name}: not compared: darker than the bare surface of the library's paints (k1)"
            )],
            other => vec![format!("{name}: not compared: {}", other.name())],
        };
        let likely: Vec<&SpotPigment> =
            self.pigments.iter().filter(|one| one.presence >= LEAST_SHOWN).collect();
        let width = documents::column_width(likely.iter().map(|one| &one.name), 0);
        for SpotPigment { name, share, share_sd, presence } in likely {
            let [share, sd] = [share, share_sd].map(|part| percent(*part));
            let sure = 100.0 * presence;
            lines.push(format!("  {name:width$}  {share:>4} +- {sd:>4} %  there: {sure:3.0} %"));
        }
        if self.sets.len() > 1 {
            lines.push("  sets of pigments by probability:".to_owned());
            for set in &self.sets {
                let probability = 100.0 * set.probability;
                lines.push(format!("  {probability:5.0} %  {}", parts_words(&set.parts)));
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;

    fn oils() -> PigmentLibrary {
        PigmentLibrary::van_gogh_oils()
    }

    fn spots(library: &PigmentLibrary, recipes: &[(&str, &[(&str, f64)])]) -> AveragedSpectra {
        let spectra = recipes.iter().map(|(name, parts)| {
            let recipe = library.recipe(parts.iter().copied()).unwrap();
            spectrum(name, library.mix(recipe).unwrap().hiding(library.saunderson))
        });
        AveragedSpectra { grid: library.grid, spectra: spectra.collect() }
    }

    fn spectrum(name: &str, reflectance: Vec<f64>) -> AveragedSpectrum {
        let name = name.to_owned();
        AveragedSpectrum { sample: name.clone(), film: Film::Paint, name, reflectance }
    }

    #[test]
    fn pigments_of_known_mixtures_are_found_with_their_shares() {
        let oils = oils();
        let known: [(&str, &[(&str, f64)]); 3] = [
            ("sky", &[("Lead White", 0.9), ("Ultramarine", 0.1)]),
            ("flesh", &[("Lead White", 0.7), ("Vermilion", 0.3)]),
            ("field", &[("Chrome Yellow", 1.0)]),
        ];
        let found = IdentifyRequest::default().run(&oils, &spots(&oils, &known)).unwrap();
        for ((name, parts), spectrum) in known.iter().zip(&found.spectra) {
            assert_eq!((spectrum.name.as_str(), spectrum.mask), (*name, Mask::Mapped));
            for (pigment, share) in *parts {
                let told = spectrum.pigments.iter().find(|told| told.name.contains(pigment));
                let told = told.unwrap_or_else(|| panic!("{pigment}: {spectrum:?}"));
                let near = (told.share - share).abs() < 0.05;
                assert!(near && told.presence > 0.5, "{pigment}: {told:?}");
            }
            let all: f64 = spectrum.sets.iter().map(|set| set.probability).sum();
            assert!(all > 0.7 && all < 1.0 + 1e-9, "{all}");
            assert!(spectrum.chi2 < 0.5 && spectrum.rms < 0.01, "{spectrum:?}");
            let apart = spectrum.measured.iter().zip(&spectrum.mapped).map(|(a, b)| (a - b).abs());
            assert!(apart.fold(0.0, f64::max) < 0.03, "{name}");
        }
    }

    #[test]
    fn a_spectrum_stands_for_itself() {
        let oils = oils();
        let known: [(&str, &[(&str, f64)]); 2] = [
            ("sky", &[("Lead White", 0.9), ("Ultramarine", 0.1)]),
            ("tree", &[("Viridian", 0.5), ("Bone Black", 0.5)]),
        ];
        let request = IdentifyRequest::default();
        let both = request.run(&oils, &spots(&oils, &known)).unwrap();
        let alone = request.run(&oils, &spots(&oils, &known[1..])).unwrap();
        assert_eq!(both.spectra[1], alone.spectra[0]);
    }

    #[test]
    fn what_no_mixture_explains_or_no_paint_reflects_is_told_so() {
        let oils = oils();
        let count = oils.grid.count();
        let comb = (0..count).map(|at| if at % 4 < 2 { 0.05 } else { 0.9 }).collect();
        let mut bare = spectrum("card", vec![0.9; count]);
        bare.film = Film::None;
        let spectra = vec![spectrum("comb", comb), spectrum("hole", vec![0.0; count]), bare];
        let spots = AveragedSpectra { grid: oils.grid, spectra };
        let found = IdentifyRequest::default().run(&oils, &spots).unwrap();
        let masks: Vec<Mask> = found.spectra.iter().map(|spectrum| spectrum.mask).collect();
        assert_eq!(masks, [Mask::OutOfGamut, Mask::TooDark]);
        assert!(found.spectra.iter().all(|s| s.pigments.is_empty() && s.sets.is_empty()));
        let lines: Vec<String> = found.spectra.iter().flat_map(IdentifiedSpectrum::lines).collect();
        assert!(lines[0].contains("no mixture") && lines[1].contains("(k1)"), "{lines:?}");
        assert!(found.remarks.iter().any(|r| r.text.contains("1 spectrum of bare cards")));
        let rows = found.rows();
        assert_eq!((rows.len(), &rows[1]["chi2"]), (2, &Value::Null));
    }

    #[test]
    fn pigments_that_take_no_part_are_named() {
        let mut oils = oils();
        let spots = spots(&oils, &[("sky", &[("Lead White", 0.9), ("Ultramarine", 0.1)])]);
        let remark = |library: &PigmentLibrary, request: &IdentifyRequest| {
            let found = request.run(library, &spots).unwrap();
            found.remarks.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        };
        let shipped = remark(&oils, &IdentifyRequest::default());
        let words = "2 of 20 pigments take no part, so that others stand in for them: \
            Zinc White (linseed), Chrome Yellow (poppyseed) (measured as masstones only";
        assert!(shipped.contains(words) && shipped.contains("palette"), "{shipped}");
        let vermilion = oils.find("Vermilion").unwrap();
        oils.pigments[vermilion.0].guessed = true;
        let guessed = remark(&oils, &IdentifyRequest::default());
        assert!(
            guessed.contains(
                "1 of 20 pigments take no part, so that others stand in for them: Vermilion"
            ),
            "{guessed}"
        );
        let palette = ["Lead White", "Zinc White (linseed)"].map(str::to_owned).to_vec();
        let named = remark(&oils, &IdentifyRequest { palette, ..IdentifyRequest::default() });
        assert!(
            named.contains("warning: shares of Zinc White (linseed) may be off by a factor of 4"),
            "{named}"
        );
        assert!(!named.contains("take no part"), "{named}");
    }

    #[test]
    fn settings_are_checked_and_names_are_known() {
        let oils = oils();
        let spots = spots(&oils, &[("sky", &[("Lead White", 1.0)])]);
        let usual = IdentifyRequest::default();
        for (request, words) in [
            (IdentifyRequest { at_most: 5, ..usual.clone() }, "at_most must be 1 to 4"),
            (IdentifyRequest { palette: vec!["Gamboge".to_owned()], ..usual.clone() }, "Gamboge"),
            (
                IdentifyRequest {
                    model_error: Some(0.1),
                    residuals: Some("r.json".into()),
                    ..usual
                },
                "exclude each other",
            ),
        ] {
            let error = request.run(&oils, &spots).unwrap_err();
            assert!(error.to_string().contains(words), "{error}: {:?}", error.hint());
        }
    }
}
