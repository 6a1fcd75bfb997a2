//! The entry to maps. You prepare a library for the wavelengths of a scan, then survey and map.

pub(crate) mod book;
pub(crate) mod groups;
mod palette;
pub(crate) mod survey;

use std::borrow::Cow;

use documents::Task;
use pigment::evaluate::Remark;
use pigment::library::{Input, PigmentLibrary};
use rayon::prelude::*;

use crate::films::bands::{Bands, Ground};
use crate::films::settings::{MapSettings, ModelError};
use crate::pixel_maps::{BlockMaps, MapError, Mask};
use crate::search::Scratch;
use crate::search::set_fit::SetFit;
use book::{Book, Folded, OpenBook, Prepared};
use groups::{Column, ColumnSet, Confusion, PixelResult, column_sets, columns, strength_sd};
use palette::{LIKE_MEASURED, Palette, UNKNOWN_LEVEL, confusion};
use survey::{survey, survey_step};

/// Gauss-Newton steps when a trial fits the true pigments.
const TRUTH_STEPS: usize = 12;
/// Above this chi-square per degree of freedom no mixture explains a pixel. It means three standard
/// deviations of sensor and library in all bands. The 65 measured oils reach 6.4, each without
/// itself in the library. Spectra unlike any paint have 17 and more.
const OUT_OF_GAMUT: f64 = 9.0;
/// A thread maps this many pixels at a time.
const TOGETHER: usize = 256;

/// Maps the pigments of a library in scans with certain wavelengths.
///
/// ```
/// use documents::Task;
/// use maps::{MapSettings, Mapper};
/// use pigment::PigmentLibrary;
///
/// let oils = PigmentLibrary::van_gogh_oils();
/// let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
/// let mapper = Mapper::new(&oils, &nm, &MapSettings::default())?;
/// let recipe = oils.recipe([("Zinc White", 0.8), ("Viridian", 0.2)])?;
/// let green: Vec<f32> =
///     oils.mix(recipe)?.hiding(oils.saunderson).iter().map(|r| *r as f32).collect();
/// let book = mapper.survey(&green, &Task::default())?;
/// let maps = mapper.map_block(&book, &green)?;
/// let viridian = mapper.columns().iter().position(|column| column.name == "Viridian").unwrap();
/// assert!((maps.share[viridian] - 0.2).abs() < 0.01, "{}", maps.share[viridian]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mapper {
    prepared: Prepared,
    columns: Vec<Column>,
    /// Column of each pigment.
    column_of: Vec<usize>,
    model_error: ModelError,
    identity: String,
    left_out: Vec<String>,
    remarks: Vec<Remark>,
    /// The ground, if it is a column.
    ground: Option<Ground>,
}

/// How the sets of pigments of a full search explain one spectrum.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Explained {
    /// Whether the spectrum can be mapped. The other fields are empty or NaN if we did not compare it.
    pub(crate) mask: Mask,
    pub(crate) result: PixelResult,
    /// Sets of columns, the most likely first.
    pub(crate) sets: Vec<ColumnSet>,
    /// Single pigments of the best set with their shares.
    pub(crate) best: Vec<(String, f64)>,
}

impl Mapper {
    /// Prepares `library` for scans with bands at `wavelengths`, in nm and rising.
    ///
    /// # Errors
    /// [`MapError`] if wavelengths, library and residuals do not fit together, a name is unknown,
    /// or a setting is out of range.
    pub fn new(
        library: &PigmentLibrary,
        wavelengths: &[f64],
        settings: &MapSettings,
    ) -> Result<Self, MapError> {
        settings.check()?;
        let model_error = settings.model_error_of(library)?;
        let Palette { names, left_out, remarks } =
            Palette::new(library, wavelengths, settings, &model_error)?;
        let of_palette = MapSettings { palette: names, ground: None, ..settings.clone() };
        let ground = match settings.ground.clone() {
            Some(ground) => {
                is_distinct(&ground, library, wavelengths, (&of_palette, &model_error))?
                    .then_some(ground)
            }
            None => None,
        };
        let all = with_ground(library, ground.as_ref())?;
        let column = ground.iter().map(|_| Ground::COLUMN.to_owned());
        let palette = of_palette.palette.iter().cloned().chain(column).collect();
        let of_all = MapSettings { palette, ..settings.clone() };
        let mut prepared = Prepared::new(&all, wavelengths, &of_all, &model_error)?;
        prepared.engine.strength_sd = strength_sds(&all, &prepared, &model_error)?;
        let alike = match settings.group_alike {
            true => confusion(library, wavelengths, &of_palette, &model_error)?.groups(),
            false => Vec::new(),
        };
        let columns = columns(
            &prepared.paints,
            &settings.groups,
            |name: &str| all.find(name).map(|id| all[id].name.clone()),
            &alike,
        )?;
        let names = prepared.paints.names.iter();
        let column_of = names
            .map(|name| columns.iter().position(|c| c.pigments.contains(name)).unwrap_or(0))
            .collect();
        let identity = identity(library, wavelengths, settings, &model_error);
        Ok(Self { prepared, columns, column_of, model_error, identity, left_out, remarks, ground })
    }

    /// Names of the pigments that take no part: those guessed from a colour, and masstones that look
    /// like a measured pigment.
    #[must_use]
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// Pigments of the library that take no part, and pigments that take part although K and S of
    /// them were not measured.
    #[must_use]
    pub fn remarks(&self) -> &[Remark] {
        &self.remarks
    }

    /// `library` with the ground of the settings as its last pigment.
    pub(crate) fn with_ground<'a>(
        &self,
        library: &'a PigmentLibrary,
    ) -> Result<Cow<'a, PigmentLibrary>, MapError> {
        with_ground(library, self.ground.as_ref())
    }

    /// Columns of the maps: pigments, and groups of pigments that we map as one. If you know the ground,
    /// and it looks like no pigment, it is a column too.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Names of the pigments that take part, as the library has them.
    #[must_use]
    pub fn pigments(&self) -> &[String] {
        &self.prepared.paints.names
    }

    /// How likely you take each pigment for another. Pigments are indices in [`Mapper::pigments`].
    #[must_use]
    pub fn confusion(&self) -> Confusion {
        Confusion::new(&self.prepared.engine, &self.prepared.paints)
    }

    /// Bands to which pixels are folded.
    #[must_use]
    pub fn bands(&self) -> &Bands {
        &self.prepared.bands
    }

    /// Effective number of bands: this many independent ones would show as much of the library's
    /// error.
    #[must_use]
    pub fn effective_bands(&self) -> f64 {
        self.prepared.noise.effective_bands
    }

    /// Error of the library's predictions that the maps take into account.
    #[must_use]
    pub fn model_error(&self) -> &ModelError {
        &self.model_error
    }

    /// A remark if the errors of the library are assumed, and the user did not state them.
    #[must_use]
    pub fn assumed_error(&self, is_stated: bool) -> Option<Remark> {
        let assumed = !is_stated && matches!(self.model_error, ModelError::Stated(_));
        assumed.then(|| {
            let words = self.model_error.words();
            Remark::note(format!("this library is taken to have {words}")).with_hint(
                "`impasto validate READINGS [residuals=FILE.json]` measures its errors, and [residuals=FILE.json] takes them into account",
            )
        })
    }

    /// Identity of library, wavelengths and settings, in hexadecimal. A book is valid for one
    /// identity.
    #[must_use]
    pub fn identity(&self) -> &str {
        &self.identity
    }

    /// Surveys pixels of a scan. `spectra` holds the reflectances pixel after pixel, 0 to 1, all
    /// bands of each. For about 20,000 pixels at equal distances we search all sets. `task` counts
    /// these pixels.
    ///
    /// # Errors
    /// [`MapError::Length`] for a broken pixel, [`MapError::NothingToSurvey`] if no pixel can be mapped,
    /// [`MapError::Cancelled`] if `task` was cancelled.
    pub fn survey(&self, spectra: &[f32], task: &Task) -> Result<Book, MapError> {
        let pixels = self.pixels(spectra)?;
        let chosen = pixels.clone().step_by(survey_step(pixels.len()));
        let surveyed = chosen.len();
        let folded: Vec<Folded> =
            chosen.filter_map(|pixel| self.prepared.fold(pixel).ok()).collect();
        if folded.is_empty() {
            return Err(MapError::NothingToSurvey(surveyed));
        }
        let names = self.pigments().to_vec();
        let book = Book::new(self.identity.clone(), self.model_error.words(), names);
        Ok(survey(&self.prepared, book, &folded, task)?)
    }

    /// Prepares the book of a survey for [`Mapper::map`], once for all blocks of a scan.
    ///
    /// # Errors
    /// [`MapError::OtherBook`] if you made it with another library, other wavelengths or other
    /// settings, [`MapError::OtherModelError`] if you made it with another error of the library's
    /// predictions.
    pub fn open_book(&self, book: &Book) -> Result<OpenBook, MapError> {
        let model_error = self.model_error.words();
        if book.model_error != model_error {
            let found = book.model_error.clone();
            let expected = model_error;
            return Err(MapError::OtherModelError { found, expected });
        }
        OpenBook::new(&self.prepared, &self.identity, book)
    }

    /// Maps the pixels of `spectra` as [`Mapper::map`] does, but opens the book for them alone.
    pub fn map_block(&self, book: &Book, spectra: &[f32]) -> Result<BlockMaps, MapError> {
        self.map(&self.open_book(book)?, spectra, &[])
    }

    /// Maps pixels on all cores. Pass their reflectances, 0 to 1, as `spectra`, pixel after pixel
    /// with all bands of each. This skips pixels with a mask other than [`Mask::Mapped`] in
    /// `masks`. If you pass no masks, it maps all. The numbers of a pixel depend only on this pixel
    /// and the book.
    ///
    /// # Errors
    /// [`MapError::Length`] for a broken pixel, [`MapError::Masks`] unless there is a mask for each
    /// pixel or none.
    pub fn map(
        &self,
        book: &OpenBook,
        spectra: &[f32],
        masks: &[Mask],
    ) -> Result<BlockMaps, MapError> {
        self.map_with(spectra, masks, |folded, scratch| {
            book.find(folded, scratch);
        })
    }

    /// Pigments of the best set of one pixel with their shares, the greatest first. These are
    /// single pigments even if the maps show their group. You get `None` if we cannot map the
    /// pixel.
    ///
    /// # Errors
    /// [`MapError::Length`] unless `spectrum` has one reflectance a band.
    pub fn best_set(
        &self,
        book: &OpenBook,
        spectrum: &[f32],
    ) -> Result<Option<Vec<(String, f64)>>, MapError> {
        let bands = self.prepared.bands.scan_bands;
        if spectrum.len() != bands {
            return Err(MapError::Length { values: spectrum.len(), bands });
        }
        let engine = &self.prepared.engine;
        let Ok(folded) = self.prepared.fold(spectrum) else { return Ok(None) };
        let mut scratch = Scratch::new(&engine.films);
        book.find(&folded, &mut scratch);
        Ok(scratch.found.first().map(|best| self.named(best)))
    }

    /// Pigments of a set with their shares, the greatest first.
    fn named(&self, set: &SetFit) -> Vec<(String, f64)> {
        let names = &self.prepared.paints.names;
        let parts = set.parts().map(|(place, share)| (names[place].clone(), f64::from(share)));
        let mut parts: Vec<(String, f64)> = parts.collect();
        parts.sort_by(|a, b| b.1.total_cmp(&a.1));
        parts
    }

    /// Searches all sets for one spectrum, without a survey.
    ///
    /// # Errors
    /// [`MapError::Length`] unless `spectrum` has one reflectance a band.
    pub(crate) fn explain(&self, spectrum: &[f32]) -> Result<Explained, MapError> {
        let bands = self.prepared.bands.scan_bands;
        if spectrum.len() != bands {
            return Err(MapError::Length { values: spectrum.len(), bands });
        }
        let engine = &self.prepared.engine;
        let mut result = PixelResult::new(self.columns.len());
        let folded = match self.prepared.fold(spectrum) {
            Ok(folded) => folded,
            Err(mask) => {
                (result.chi2, result.rms) = (f64::NAN, f64::NAN);
                return Ok(Explained { mask, result, sets: Vec::new(), best: Vec::new() });
            }
        };
        let mut scratch = Scratch::new(&engine.films);
        engine.search(&folded.pixel, engine.table.nearest(&folded.projected), &mut scratch);
        result.sum(engine, &scratch, &self.column_of);
        let mask = if result.chi2 > OUT_OF_GAMUT { Mask::OutOfGamut } else { Mask::Mapped };
        let sets = column_sets(&scratch.found, &self.column_of, engine);
        let best = scratch.found.first().map_or_else(Vec::new, |best| self.named(best));
        Ok(Explained { mask, result, sets, best })
    }

    /// Searches all sets for every pixel, without a survey. This is slow. Use it to see how much a
    /// survey saves.
    ///
    /// # Errors
    /// [`MapError::Length`] for a broken pixel.
    pub fn search(&self, spectra: &[f32]) -> Result<BlockMaps, MapError> {
        let engine = &self.prepared.engine;
        self.map_with(spectra, &[], |folded, scratch| {
            let place = engine.table.nearest(&folded.projected);
            engine.search(&folded.pixel, place, scratch);
        })
    }

    /// Compares the best set of a full search with the true pigments of each pixel, after refining
    /// their shares. You get `None` for pixels that we cannot map or that hold other pigments.
    pub(crate) fn gaps_to_truth(
        &self,
        spectra: &[f32],
        truth: &[Vec<(&str, f64)>],
    ) -> Result<Vec<Option<Gap>>, MapError> {
        let engine = &self.prepared.engine;
        let pixels: Vec<&[f32]> = self.pixels(spectra)?.collect();
        let found = pixels.par_iter().zip(truth).map_init(
            || Scratch::new(&engine.films),
            |scratch: &mut Scratch, (pixel, parts): (&&[f32], &Vec<(&str, f64)>)| {
                let folded = self.prepared.fold(pixel).ok()?;
                let parts: Vec<(usize, f32)> = parts
                    .iter()
                    .map(|(name, share): &(&str, f64)| {
                        Some((self.prepared.paints.place(name)?, *share as f32))
                    })
                    .collect::<Option<_>>()?;
                let set = SetFit::of_parts(&parts)?;
                let nearest = engine.table.nearest(&folded.projected);
                engine.search(&folded.pixel, nearest, scratch);
                let (truth, _) = engine.refined(&folded.pixel, set, TRUTH_STEPS);
                let found = scratch.found.first()?;
                Some(Gap {
                    score: found.score - truth.score,
                    chi2: found.chi2 - truth.chi2,
                    is_right: found.columns(&self.column_of) == truth.columns(&self.column_of),
                })
            },
        );
        Ok(found.collect())
    }

    fn map_with(
        &self,
        spectra: &[f32],
        masks: &[Mask],
        find: impl Fn(&Folded, &mut Scratch) + Sync,
    ) -> Result<BlockMaps, MapError> {
        let pixels: Vec<&[f32]> = self.pixels(spectra)?.collect();
        if !masks.is_empty() && masks.len() != pixels.len() {
            return Err(MapError::Masks { masks: masks.len(), pixels: pixels.len() });
        }
        let engine = &self.prepared.engine;
        let parts: Vec<BlockMaps> = (pixels.par_chunks(TOGETHER).enumerate())
            .map_init(
                || (Scratch::new(&engine.films), PixelResult::new(self.columns.len())),
                |(scratch, result), (number, pixels)| {
                    let mut maps = BlockMaps::with_capacity(pixels.len(), self.columns.len());
                    for (index, pixel) in pixels.iter().enumerate() {
                        let mask = masks.get(number * TOGETHER + index).copied();
                        let folded = match mask.unwrap_or(Mask::Mapped) {
                            Mask::Mapped => self.prepared.fold(pixel),
                            other => Err(other),
                        };
                        match folded {
                            Ok(folded) => {
                                find(&folded, scratch);
                                result.sum(engine, scratch, &self.column_of);
                                if result.chi2 > OUT_OF_GAMUT {
                                    maps.push_masked(Mask::OutOfGamut, result.chi2, result.rms);
                                } else {
                                    result.push_to(&mut maps);
                                }
                            }
                            Err(mask) => maps.push_masked(mask, f64::NAN, f64::NAN),
                        }
                    }
                    maps
                },
            )
            .collect();
        let mut maps = BlockMaps::with_capacity(pixels.len(), self.columns.len());
        parts.into_iter().for_each(|part| maps.append(part));
        Ok(maps)
    }

    fn pixels<'a>(&self, spectra: &'a [f32]) -> Result<std::slice::ChunksExact<'a, f32>, MapError> {
        let bands = self.prepared.bands.scan_bands;
        let pixels = spectra.chunks_exact(bands);
        if !pixels.remainder().is_empty() {
            return Err(MapError::Length { values: spectra.len(), bands });
        }
        Ok(pixels)
    }
}

/// Whether the ground looks like none of the pigments that `settings` name. If it looks like one, the two
/// would only compete, and the ground is no column.
fn is_distinct(
    ground: &Ground,
    library: &PigmentLibrary,
    wavelengths: &[f64],
    (settings, model_error): (&MapSettings, &ModelError),
) -> Result<bool, MapError> {
    let all = ground.among(library)?;
    let column = std::iter::once(Ground::COLUMN.to_owned());
    let palette: Vec<String> = settings.palette.iter().cloned().chain(column).collect();
    let last = palette.len() - 1;
    if palette.len() > BlockMaps::MOST_PIGMENTS {
        return Ok(false);
    }
    let settings = MapSettings { palette, ..settings.clone() };
    let confusion = confusion(&all, wavelengths, &settings, model_error)?;
    Ok((0..last).all(|pigment| confusion.of(last, pigment) < LIKE_MEASURED))
}

/// `library`, with `ground` as one more pigment at its end.
fn with_ground<'a>(
    library: &'a PigmentLibrary,
    ground: Option<&Ground>,
) -> Result<Cow<'a, PigmentLibrary>, MapError> {
    Ok(match ground {
        Some(ground) => Cow::Owned(ground.among(library)?),
        None => Cow::Borrowed(library),
    })
}

/// For each paint, the standard deviation of the logarithm of its strength. For paints with known S we
/// estimate it from the left-out mixtures. For masstones and the ground, a factor of [`UNKNOWN_LEVEL`] is
/// one standard deviation.
fn strength_sds(
    library: &PigmentLibrary,
    prepared: &Prepared,
    model_error: &ModelError,
) -> Result<Vec<f64>, MapError> {
    let measured = match model_error {
        ModelError::Residuals(residuals) => strength_sd(prepared, residuals),
        ModelError::Stated(_) => 0.0,
    };
    let names = prepared.paints.names.iter();
    let of_paint = names.map(|name| {
        let is_known = library[library.find(name)?].identified;
        Ok(if is_known { measured } else { libm::log(UNKNOWN_LEVEL).max(measured) })
    });
    of_paint.collect()
}

/// How the best set of a search compares with the true pigments of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gap {
    /// Score of the search minus the score of the true pigments. It is 0 or below if the search
    /// found a set that is as good.
    pub(crate) score: f32,
    /// Chi-square of the search minus the chi-square of the true pigments.
    pub(crate) chi2: f32,
    /// Whether the search found the true columns.
    pub(crate) is_right: bool,
}

/// SHA-256 of everything that a map depends on besides the pixels.
fn identity(
    library: &PigmentLibrary,
    wavelengths: &[f64],
    settings: &MapSettings,
    model_error: &ModelError,
) -> String {
    use std::fmt::Write as _;
    let mut text = library.to_json();
    // Settings that only join columns leave the book valid.
    let MapSettings { at_most, palette, sensor_noise, penalty, ground, .. } = settings;
    let _ = write!(text, "{wavelengths:?} {at_most} {palette:?} {sensor_noise:?} {penalty:?} ");
    let _ = write!(text, "{}", model_error.words());
    if let Some(ground) = ground {
        let _ = write!(text, "{ground:?}");
    }
    Input::new("", text.as_bytes()).sha256
}
