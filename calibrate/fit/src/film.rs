//! A film of one paint on two cards: K d and S d, contrast ratio, and hiding power.
//!
//! You lay one film across a white and a black card, and read both films and both bare cards. We need no
//! recipe. If you know the thickness d, you get K and S by mm.

use documents::hint::Explain;
use documents::{Task, name_list};
use pigment::digits::rounded;
use pigment::remark::Remark;
use pigment::rows::joined;
use pigment::visible_band::{BandError, check_visible_band};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use spectra::optics::{Layer, Specular, Surface, absorption_over_scattering};
use spectra::{Grid, TristimulusWeights, Viewing};

use crate::measurement::{Film, MeasurementTable, Reading, k1_below};
use crate::observation::{BLACK, LEAST_CONTRAST};
use crate::readings::Readings;
use crate::request::{read_surface, surface_schema, write_surface};
use crate::two_cards::{FACTORS, bisected, hidden, powers_of};

pub use crate::two_cards::Estimate;

/// We expect this error of a reading if none was repeated, as a standard deviation of reflectance.
const INSTRUMENT_ERROR: f64 = 0.002;
/// Two readings that differ by less than this many standard deviations do not show the backing.
const VISIBLE: f64 = 2.0;
/// A film may be darker over the white card by this reflectance, because two readings have errors.
const DARKER: f64 = 0.02;
/// A reading may be below the surface's own reflection by this many standard deviations.
const CHANCE: f64 = 3.0;
/// Largest internal reflectance of a film or card.
const WHITE: f64 = 1.0 - 1e-9;
/// An error lists at most this many names.
const LISTED: usize = 8;

/// Options of [`film`]. [`Self::run`] computes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a film on two cards")]
pub struct FilmRequest {
    /// Only this sample [default: every sample with films over two cards that were read bare]
    pub sample: Option<String>,
    /// Name of the film over the white card, for a file without the columns film and backing
    pub over_white: Option<String>,
    /// Name of the film over the black card
    pub over_black: Option<String>,
    /// Name of the bare white card
    pub white_card: Option<String>,
    /// Name of the bare black card
    pub black_card: Option<String>,
    /// Surface reflection as K1,K2, or none [default: 0.03,0.6, with a smaller k1 if a reading is below
    /// 0.03]
    #[serde(serialize_with = "write_surface", deserialize_with = "read_surface")]
    #[schemars(schema_with = "surface_schema")]
    pub surface: Option<Surface>,
    /// Whether the readings include the specular reflection
    pub specular: Specular,
    /// Thickness of the film in mm, if the file has no column thickness_mm
    pub thickness_mm: Option<f64>,
    /// Volume of the film as a share of the volume of wet paint, for the spreading rate of the paint
    pub solids: f64,
    /// Contrast ratio of a film that hides, above 0 and below 1
    pub contrast: f64,
    /// Standard deviation of one reading of reflectance [default: the spread of repeated readings, else
    /// 0.002]
    pub noise: Option<f64>,
    /// Light and observer of the contrast ratio
    pub viewing: Viewing,
}

impl Default for FilmRequest {
    fn default() -> Self {
        Self {
            sample: None,
            over_white: None,
            over_black: None,
            white_card: None,
            black_card: None,
            surface: None,
            specular: Specular::default(),
            thickness_mm: None,
            solids: 1.0,
            contrast: 0.98,
            noise: None,
            viewing: Viewing::default(),
        }
    }
}

/// K and S of a film at one wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmPower {
    /// Wavelength in nm.
    pub nm: f64,
    /// K/S of the paint.
    pub ratio: f64,
    /// K d, 0 and up. `None` where the readings do not show the backing.
    pub absorption: Option<Estimate>,
    /// S d, 0 and up. `None` where the readings do not show the backing.
    pub scattering: Option<Estimate>,
}

/// Thickness at which a film hides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HidingPower {
    /// Thickness relative to the film that was read.
    pub factor: Estimate,
    /// Thickness in mm, if you know the thickness of the film.
    pub thickness_mm: Option<Estimate>,
    /// Spreading rate of the paint in square metres by litre, if you know the thickness of the film.
    pub spreading_rate: Option<Estimate>,
}

/// One film that was read over a white and a black card.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmOnCards {
    /// Name of the sample.
    pub sample: String,
    /// Thickness in mm, if you know it.
    pub thickness_mm: Option<f64>,
    /// K d and S d by wavelength.
    pub powers: Vec<FilmPower>,
    /// Y of the film over the white and over the black card, 100 for a perfect white.
    pub luminances: [f64; 2],
    /// Contrast ratio: Y over the black card divided by Y over the white card.
    pub contrast: Estimate,
    /// Thickness at which the contrast ratio reaches [`FilmRequest::contrast`], from K d and S d. `None` if
    /// no thickness does.
    pub hiding: Option<HidingPower>,
    /// Standard deviation of one reading that we took.
    pub noise: f64,
}

/// Films of a file, with what you should know about them.
#[derive(Debug, Clone, PartialEq)]
pub struct Films {
    /// The films, in the order of the file.
    pub films: Vec<FilmOnCards>,
    /// Samples with films of several thicknesses, and the spreading rate in square metres by litre at which
    /// the contrast ratio reaches [`FilmRequest::contrast`]. We interpolate linearly between the two
    /// neighbouring films, as ISO 6504-3 does.
    pub interpolated: Vec<(String, f64)>,
    /// Contrast ratio of a film that hides.
    pub contrast: f64,
    /// Light and observer of the contrast ratio.
    pub viewing: Viewing,
    /// Surface of the films.
    pub surface: Surface,
    /// Choices that were made, and warnings.
    pub remarks: Vec<Remark>,
}

/// Computes K d, S d, contrast ratio and hiding power of films that were read over two cards.
///
/// The contrast ratio is Y of the film over the black card divided by Y over the white card, surface
/// included, as ISO 6504-3 defines it. A film hides where it reaches 0.98. We compute K d and S d below the
/// surface from Kubelka's equations (1948), and from these the contrast ratio at other thicknesses.
/// Deviations follow from the noise of the readings of films and cards. For K and S each wavelength has an
/// error of its own. For contrast ratio and hiding power one error holds for a whole spectrum, which is the
/// cautious case.
///
/// ```
/// use calibrate::{FilmRequest, Readings};
///
/// let text = "sample,film,backing,thickness_mm,400,500,600,700\n\
///     card,none,white,,0.85,0.86,0.87,0.87\ncard,none,black,,0.05,0.05,0.05,0.05\n\
///     ochre,paint,white,0.08,0.20,0.35,0.62,0.68\nochre,paint,black,0.08,0.17,0.28,0.50,0.52\n";
/// let readings = Readings::from_csv("ochre.csv", text.as_bytes())?;
/// let found = calibrate::film(&readings, &FilmRequest::default())?;
/// let ochre = &found.films[0];
/// assert!((ochre.contrast.value - 0.80).abs() < 0.01);
/// let hiding = ochre.hiding.and_then(|hiding| hiding.thickness_mm).map(|mm| mm.value);
/// assert!((0.15..0.25).contains(&hiding.unwrap_or_default()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FilmError`] if no film lies on two cards that were read bare, for unknown names, impossible numbers,
/// and readings that no film can have.
pub fn film(readings: &Readings, request: &FilmRequest) -> Result<Films, FilmError> {
    request.run(readings, &Task::default())
}

impl FilmRequest {
    /// Computes as [`film`] does.
    ///
    /// # Errors
    /// [`FilmError`] as for [`film`].
    pub fn run(&self, readings: &Readings, _task: &Task) -> Result<Films, FilmError> {
        self.check()?;
        let table = &readings.table;
        let mut remarks = Vec::from_iter(check_visible_band(table.grid)?);
        let pairs = self.pairs(table)?;
        let (surface, lowered) = self.surface_below(&pairs, table.grid)?;
        remarks.extend(lowered);
        let weights = self.viewing.weights(table.grid).expect("the method fits the grid");
        let scale = Scale { grid: table.grid, surface, weights: &weights, contrast: self.contrast };
        let mut films = Vec::new();
        for pair in &pairs {
            pair.check(table.grid)?;
            let noise = self.noise.or_else(|| pair.spread()).unwrap_or(INSTRUMENT_ERROR);
            let found = scale.film(pair, noise, self.solids);
            remarks.extend(doubts(&found));
            films.push(found);
        }
        if self.noise.is_none() && pairs.iter().any(|pair| pair.spread().is_none()) {
            let text = format!("no reading was repeated: deviations assume {INSTRUMENT_ERROR}");
            remarks.push(Remark::note(text).with_hint("state the noise with [noise]"));
        }
        let interpolated = interpolated(&films, self.contrast, self.solids);
        let viewing = self.viewing.clone();
        Ok(Films { films, interpolated, contrast: self.contrast, viewing, surface, remarks })
    }

    fn check(&self) -> Result<(), FilmError> {
        let above_zero = |value: f64| value.is_finite() && value > 0.0;
        let share = "above 0 and below 1";
        for (setting, value, is_possible, range) in [
            ("thickness_mm", self.thickness_mm, above_zero as fn(f64) -> bool, "above 0"),
            ("noise", self.noise, |noise| noise > 0.0 && noise < 1.0, share),
            ("contrast", Some(self.contrast), |ratio| ratio > 0.0 && ratio < 1.0, share),
            ("solids", Some(self.solids), |part| part > 0.0 && part <= 1.0, "above 0, up to 1"),
        ] {
            if let Some(value) = value.filter(|value| !is_possible(*value)) {
                return Err(FilmError::Number { setting, range, value });
            }
        }
        Ok(())
    }

    /// The films with their cards: by name, else by the columns of the file.
    fn pairs<'a>(&self, table: &'a MeasurementTable) -> Result<Vec<FilmPair<'a>>, FilmError> {
        let names = [&self.over_white, &self.over_black, &self.white_card, &self.black_card];
        let mut pairs = match names {
            [None, None, None, None] => pairs_of_columns(table),
            [Some(over_white), Some(over_black), Some(white_card), Some(black_card)] => {
                let [over_white, over_black, white_card, black_card] =
                    [over_white, over_black, white_card, black_card]
                        .map(|name| readings_of(table, name));
                let over_white = over_white?;
                vec![FilmPair {
                    sample: over_white[0].sample.clone(),
                    thickness_mm: over_white[0].thickness_mm,
                    films: [over_white, over_black?],
                    cards: [white_card?, black_card?],
                }]
            }
            _ => return Err(FilmError::Names),
        };
        if let Some(sample) = &self.sample {
            pairs.retain(|pair| pair.sample == *sample);
        }
        for pair in &mut pairs {
            pair.thickness_mm = pair.thickness_mm.or(self.thickness_mm);
        }
        if pairs.is_empty() {
            let mut samples: Vec<String> = Vec::new();
            for reading in table.readings.iter().filter(|r| r.film == Film::Paint) {
                if !samples.contains(&reading.sample) {
                    samples.push(reading.sample.clone());
                }
            }
            return Err(FilmError::NoPair { sample: self.sample.clone(), samples });
        }
        Ok(pairs)
    }

    /// The surface that you state, else the usual one with a k1 below every reading.
    fn surface_below(
        &self,
        pairs: &[FilmPair<'_>],
        grid: Grid,
    ) -> Result<(Surface, Option<Remark>), FilmError> {
        let stated = self.surface.map(|surface| match self.specular {
            specular @ Specular::Excluded => Surface { specular, ..surface },
            Specular::Included => surface,
        });
        let surface = stated.unwrap_or(Surface::of_most_paints(self.specular));
        let least = pairs.iter().flat_map(FilmPair::readings).flat_map(|reading| {
            let values = reading.reflectance.iter().enumerate();
            values.map(move |(at, value)| (*value, reading, at))
        });
        let Some((measured, reading, at)) = least.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return Ok((surface, None));
        };
        if measured >= surface.floor() {
            return Ok((surface, None));
        }
        let lower = k1_below(measured).max(0.0);
        let nm = grid.nm(at);
        if stated.is_some() {
            // Noise alone may put the reading of a black film below the surface.
            let allowed = CHANCE * self.noise.unwrap_or(INSTRUMENT_ERROR);
            if measured > surface.floor() - allowed {
                return Ok((surface, None));
            }
            let sample = reading.sample.clone();
            return Err(FilmError::BelowSurface { sample, nm, measured, k1: surface.k1, lower });
        }
        let text = format!(
            "k1 lowered from {} to {lower} because {} reads only {measured:.4} at {nm} nm",
            surface.k1, reading.sample
        );
        let remark = Remark::note(text).with_hint("state the surface with [saunderson=K1,K2]");
        Ok((Surface { k1: lower, ..surface }, Some(remark)))
    }
}

fn readings_of<'a>(table: &'a MeasurementTable, name: &str) -> Result<Vec<&'a Reading>, FilmError> {
    let found: Vec<&Reading> = table.readings.iter().filter(|r| r.sample == name).collect();
    if found.is_empty() {
        let mut samples: Vec<String> = table.readings.iter().map(|r| r.sample.clone()).collect();
        samples.dedup();
        return Err(FilmError::Unknown { name: name.to_owned(), samples });
    }
    Ok(found)
}

/// Readings of a film over the white and the black card, and of the bare cards, in this order.
struct FilmPair<'a> {
    sample: String,
    thickness_mm: Option<f64>,
    films: [Vec<&'a Reading>; 2],
    cards: [Vec<&'a Reading>; 2],
}

/// The films of every sample and thickness over two backings with the greatest contrast.
fn pairs_of_columns(table: &MeasurementTable) -> Vec<FilmPair<'_>> {
    let mut keys: Vec<(&str, Option<f64>)> = Vec::new();
    for reading in table.readings.iter().filter(|r| r.film == Film::Paint) {
        let key = (reading.sample.as_str(), reading.thickness_mm);
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let mut backings: Vec<&str> = table.readings.iter().map(|r| &*r.backing).collect();
    backings.sort_unstable();
    backings.dedup();
    let pair = |(sample, thickness_mm): (&str, Option<f64>)| -> Option<FilmPair<'_>> {
        let selected = |film: Film, backing: &str, own: bool| -> Vec<&Reading> {
            let is_one = |r: &&Reading| {
                r.film == film
                    && *r.backing == *backing
                    && (!own || r.sample == sample)
                    && (film == Film::None || r.thickness_mm == thickness_mm)
            };
            table.readings.iter().filter(is_one).collect()
        };
        let mut sides: Vec<[Vec<&Reading>; 2]> = Vec::new();
        for backing in &backings {
            let films = selected(Film::Paint, backing, true);
            let own = selected(Film::None, backing, true);
            let cards = if own.is_empty() { selected(Film::None, backing, false) } else { own };
            if !films.is_empty() && !cards.is_empty() {
                sides.push([films, cards]);
            }
        }
        sides.sort_by(|a, b| mean_of(&b[1]).total_cmp(&mean_of(&a[1])));
        let dark = sides.pop().filter(|_| !sides.is_empty())?;
        let light = sides.swap_remove(0);
        if mean_of(&light[1]) - mean_of(&dark[1]) < LEAST_CONTRAST {
            return None;
        }
        let [light, white_card] = light;
        let [dark, black_card] = dark;
        let films = [light, dark];
        let cards = [white_card, black_card];
        Some(FilmPair { sample: sample.to_owned(), thickness_mm, films, cards })
    };
    keys.into_iter().filter_map(pair).collect()
}

fn mean_of(readings: &[&Reading]) -> f64 {
    let mean = mean(readings);
    mean.iter().sum::<f64>() / mean.len() as f64
}

fn mean(readings: &[&Reading]) -> Vec<f64> {
    let count = readings.len() as f64;
    (0..readings[0].reflectance.len())
        .map(|at| readings.iter().map(|r| r.reflectance[at]).sum::<f64>() / count)
        .collect()
}

impl<'a> FilmPair<'a> {
    /// Films over white and black, then the white and the black card.
    fn groups(&self) -> [&Vec<&'a Reading>; 4] {
        let [light, dark] = &self.films;
        let [white, black] = &self.cards;
        [light, dark, white, black]
    }

    fn readings(&self) -> impl Iterator<Item = &'a Reading> + '_ {
        self.groups().into_iter().flatten().copied()
    }

    /// Standard deviation of repeated readings around their means, or `None` if none were repeated.
    fn spread(&self) -> Option<f64> {
        let mut squares = 0.0;
        let mut freedom = 0;
        for group in self.groups().into_iter().filter(|group| group.len() > 1) {
            let mean = mean(group);
            let pairs = group.iter().flat_map(|r| r.reflectance.iter().zip(&mean));
            squares += pairs.map(|(value, mean)| (value - mean).powi(2)).sum::<f64>();
            freedom += (group.len() - 1) * mean.len();
        }
        let spread = (freedom > 0).then(|| (squares / freedom as f64).sqrt());
        spread.filter(|spread| *spread > 0.0)
    }

    /// Refuses cards that are alike, and a film that is darker over the white card.
    fn check(&self, grid: Grid) -> Result<(), FilmError> {
        let [light, dark, white, black] = self.groups().map(|group| mean(group));
        if mean_of(&self.cards[0]) - mean_of(&self.cards[1]) < LEAST_CONTRAST {
            return Err(FilmError::Cards { sample: self.sample.clone() });
        }
        let steps = (0..light.len()).filter(|&at| white[at] > black[at]);
        let worst = steps.max_by(|&a, &b| (dark[a] - light[a]).total_cmp(&(dark[b] - light[b])));
        match worst.map(|at| (at, dark[at] - light[at])) {
            Some((at, by)) if by > DARKER => {
                Err(FilmError::Darker { sample: self.sample.clone(), by, nm: grid.nm(at) })
            }
            _ => Ok(()),
        }
    }
}

/// Wavelengths, surface and light of a computation.
struct Scale<'a> {
    grid: Grid,
    surface: Surface,
    weights: &'a TristimulusWeights,
    contrast: f64,
}

/// K d and S d by wavelength, with the internal reflectances of both cards.
struct Powers {
    values: Vec<[f64; 2]>,
    cards: [Vec<f64>; 2],
}

impl Scale<'_> {
    fn film(&self, pair: &FilmPair<'_>, noise: f64, solids: f64) -> FilmOnCards {
        let means = pair.groups().map(|group| mean(group));
        let deviations = pair.groups().map(|group| noise / (group.len() as f64).sqrt());
        let [light, dark, ..] = &means;
        let luminances = [light, dark].map(|film| self.weights.xyz(film).y);
        let [y_light, y_dark] = luminances;
        let value = y_dark / y_light;
        // An error of the whole spectrum changes Y of a perfect white, 100, by as much.
        let part = |y: f64, deviation: f64| 100.0 * deviation / y.max(f64::MIN_POSITIVE);
        let deviation = value * part(y_light, deviations[0]).hypot(part(y_dark, deviations[1]));
        let contrast = Estimate { value, deviation };
        let powers = self.powers(&means, &deviations);
        let factor = self.hiding_factor(&powers).map(|value| {
            let shifted = (0..4).map(|place| {
                let mut means = means.clone();
                means[place].iter_mut().for_each(|value| *value += deviations[place]);
                let factor = self.hiding_factor(&self.powers(&means, &deviations));
                factor.map_or(value, |factor| (factor - value).powi(2))
            });
            Estimate { value, deviation: shifted.sum::<f64>().sqrt() }
        });
        let hiding = factor.map(|factor| {
            let thickness_mm = pair.thickness_mm.map(|mm| factor.scaled(mm));
            let spreading_rate = thickness_mm.map(|mm| Estimate {
                value: solids / mm.value,
                deviation: solids * mm.deviation / mm.value.powi(2),
            });
            HidingPower { factor, thickness_mm, spreading_rate }
        });
        let powers = (0..self.grid.count())
            .map(|at| self.power(at, powers.values[at], &means, &deviations))
            .collect();
        FilmOnCards {
            sample: pair.sample.clone(),
            thickness_mm: pair.thickness_mm,
            powers,
            luminances,
            contrast,
            hiding,
            noise,
        }
    }

    fn internal(&self, measured: f64) -> f64 {
        let internal = self.surface.internal_from_measured(measured).unwrap_or(BLACK);
        internal.clamp(BLACK, WHITE)
    }

    /// K d and S d at every wavelength. Where the readings do not show the backing, we take the thinnest film
    /// that would not show it.
    fn powers(&self, means: &[Vec<f64>; 4], deviations: &[f64; 4]) -> Powers {
        let [light, dark, white, black] = means
            .each_ref()
            .map(|values| values.iter().map(|value| self.internal(*value)).collect::<Vec<f64>>());
        let values = (0..self.grid.count()).map(|at| {
            let least = visible(deviations) * self.surface.measured_slope(light[at]).recip();
            let cards = [white[at], black[at]];
            if light[at] - dark[at] < least {
                let ratio = absorption_over_scattering(f64::midpoint(light[at], dark[at]));
                return hidden(ratio, cards, least);
            }
            powers_of([light[at], dark[at]], cards)
        });
        Powers { values: values.collect(), cards: [white, black] }
    }

    /// K d and S d at one wavelength with their deviations, by the slopes of both readings.
    fn power(
        &self,
        at: usize,
        [k, s]: [f64; 2],
        means: &[Vec<f64>; 4],
        deviations: &[f64; 4],
    ) -> FilmPower {
        let nm = self.grid.nm(at);
        let ratio = if s > 0.0 { k / s } else { f64::INFINITY };
        let unknown = FilmPower { nm, ratio, absorption: None, scattering: None };
        if means[0][at] - means[1][at] < visible(deviations) {
            return unknown;
        }
        let rows = [0, 1].map(|side: usize| {
            let card = self.internal(means[2 + side][at]);
            let [film, by_k, by_s] = Layer::over_with_slopes(k, s, card);
            let slope = self.surface.measured_slope(film);
            let card_slope =
                Layer::new(k, s, 1.0).over_slope(card) * slope / self.surface.measured_slope(card);
            let variance = deviations[side].powi(2) + (card_slope * deviations[2 + side]).powi(2);
            ([by_k * slope, by_s * slope], variance)
        });
        let [([a, b], first), ([c, d], second)] = rows;
        let determinant = a * d - b * c;
        let estimate = |value: f64, by_first: f64, by_second: f64| {
            let variance = by_first.powi(2) * first + by_second.powi(2) * second;
            Estimate { value, deviation: variance.sqrt() / determinant.abs() }
        };
        let absorption = estimate(k, d, b);
        let scattering = estimate(s, c, a);
        if !(absorption.deviation.is_finite() && scattering.deviation.is_finite()) {
            return unknown;
        }
        FilmPower { nm, ratio, absorption: Some(absorption), scattering: Some(scattering) }
    }

    /// Thickness, relative to the film, at which the contrast ratio reaches the limit. The ratio rises with
    /// the thickness.
    fn hiding_factor(&self, powers: &Powers) -> Option<f64> {
        let ratio = |factor: f64| {
            let [light, dark] = powers.cards.each_ref().map(|card| {
                let values = powers.values.iter().zip(card).map(|([k, s], card)| {
                    self.surface.measured_from_internal(Layer::new(*k, *s, factor).over(*card))
                });
                self.weights.xyz(&values.collect::<Vec<f64>>()).y
            });
            dark / light
        };
        let [least, most] = FACTORS;
        if ratio(most) < self.contrast || ratio(least) > self.contrast {
            return None;
        }
        Some(bisected([least, most], |factor| ratio(factor) < self.contrast))
    }
}

/// Least difference of two readings that shows the backing.
fn visible(deviations: &[f64; 4]) -> f64 {
    VISIBLE * deviations[0].hypot(deviations[1])
}

/// Warnings about a film.
fn doubts(film: &FilmOnCards) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let hidden = film.powers.iter().filter(|power| power.scattering.is_none()).count();
    if hidden > 0 {
        let text = format!(
            "{}: the film hides at {hidden} of {} wavelengths within the noise, where only K/S is known",
            film.sample,
            film.powers.len()
        );
        remarks.push(Remark::warning(text).with_hint("lay a thinner film"));
    }
    if film.hiding.is_none() {
        let text = format!("{}: no thickness of this film hides the cards", film.sample);
        remarks.push(Remark::warning(text));
    }
    remarks
}

/// Spreading rates at which samples with several thicknesses reach the contrast ratio `limit`.
fn interpolated(films: &[FilmOnCards], limit: f64, solids: f64) -> Vec<(String, f64)> {
    let mut samples: Vec<&str> = Vec::new();
    for film in films {
        if !samples.contains(&film.sample.as_str()) {
            samples.push(&film.sample);
        }
    }
    let rate = |sample: &str| -> Option<(String, f64)> {
        let own = films.iter().filter(|film| film.sample == sample);
        let points =
            own.filter_map(|film| Some((solids / film.thickness_mm?, film.contrast.value)));
        let mut points: Vec<(f64, f64)> = points.collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let around = points.windows(2).find(|pair| pair[0].1 >= limit && pair[1].1 <= limit)?;
        let [(thick, high), (thin, low)] = [around[0], around[1]];
        let part = if high > low { (high - limit) / (high - low) } else { 0.0 };
        Some((sample.to_owned(), thick + part * (thin - thick)))
    };
    samples.into_iter().filter_map(rate).collect()
}

impl Films {
    /// The films as JSON: `illuminant`, `observer`, `contrast`, `surface`, `interpolated` (spreading rates by
    /// sample), and `films` with sample, thickness_mm, luminances, contrast_ratio, hiding, noise and `powers`
    /// by wavelength.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let surface = self.surface;
        let between = self.interpolated.iter();
        let between = between.map(|(name, rate)| json!({"sample": name, "spreading_rate": rate}));
        json!({
            "illuminant": self.viewing.illuminant.name(),
            "observer": self.viewing.observer.name(),
            "contrast": self.contrast,
            "surface": {"k1": surface.k1, "k2": surface.k2, "specular": surface.specular},
            "interpolated": between.collect::<Vec<_>>(),
            "films": self.films.iter().map(FilmOnCards::to_json).collect::<Vec<_>>(),
        })
    }

    /// K and S of all films, one object a wavelength: sample, thickness_mm, and [`FilmOnCards::rows`].
    #[must_use]
    pub fn rows(&self) -> Vec<Value> {
        let rows = self.films.iter().flat_map(|film| {
            let start = json!({"sample": film.sample, "thickness_mm": film.thickness_mm});
            film.rows().into_iter().map(move |row| joined(start.clone(), row))
        });
        rows.collect()
    }
}

impl FilmOnCards {
    fn to_json(&self) -> Value {
        let hiding = self.hiding.map(|hiding| {
            json!({
                "factor": hiding.factor.rounded(),
                "thickness_mm": hiding.thickness_mm.map(Estimate::rounded),
                "spreading_rate": hiding.spreading_rate.map(Estimate::rounded),
            })
        });
        json!({
            "sample": self.sample,
            "thickness_mm": self.thickness_mm,
            "luminances": self.luminances.map(rounded),
            "contrast_ratio": self.contrast.rounded(),
            "hiding": hiding,
            "noise": rounded(self.noise),
            "powers": self.rows(),
        })
    }

    /// K and S by wavelength, one object a row: nm, k_d, k_d_sd, s_d, s_d_sd, k_over_s, and with a thickness
    /// k_per_mm, k_per_mm_sd, s_per_mm, s_per_mm_sd. Unknown values are null.
    #[must_use]
    pub fn rows(&self) -> Vec<Value> {
        let row = |power: &FilmPower| {
            let mut row = json!({ "nm": power.nm });
            let mut put = |name: &str, estimate: Option<Estimate>| {
                let estimate = estimate.map(Estimate::rounded);
                row[name] = json!(estimate.map(|estimate| estimate.value));
                row[format!("{name}_sd")] = json!(estimate.map(|estimate| estimate.deviation));
            };
            put("k_d", power.absorption);
            put("s_d", power.scattering);
            if let Some(mm) = self.thickness_mm {
                put("k_per_mm", power.absorption.map(|k| k.scaled(1.0 / mm)));
                put("s_per_mm", power.scattering.map(|s| s.scaled(1.0 / mm)));
            }
            row["k_over_s"] = json!(power.ratio.is_finite().then(|| rounded(power.ratio)));
            row
        };
        self.powers.iter().map(row).collect()
    }
}

/// Films of which K d and S d cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum FilmError {
    /// A number is out of range.
    #[error("{setting} is a number {range}, found `{value}`")]
    #[hint("leave out [{setting}], or give a number {range}")]
    #[fault(Setting)]
    Number {
        /// Name of the setting.
        setting: &'static str,
        /// Range of possible values.
        range: &'static str,
        /// Value that was given.
        value: f64,
    },
    /// Some of the four names are missing.
    #[error("a film by name needs four names: the film over both cards, and both bare cards")]
    #[hint("give [over_white=NAME] [over_black=NAME] [white_card=NAME] [black_card=NAME]")]
    #[fault(Setting)]
    Names,
    /// No sample has this name.
    #[error("no sample is called `{name}`")]
    #[hint("the file has {}", name_list(samples, LISTED, ", "))]
    Unknown {
        /// The name that no sample has.
        name: String,
        /// Names of all samples.
        samples: Vec<String>,
    },
    /// No film lies on two cards that were read bare.
    #[error(
        "{} over a white and a black card that were also read bare",
        match sample {
            Some(sample) => format!("no film of `{sample}` was read"),
            None => "no film was read".to_owned(),
        }
    )]
    #[hint(
        "say it in the columns film and backing (the card has film `none`), or name the spectra: [over_white] [over_black] [white_card] [black_card]; the file has {}",
        name_list(samples, LISTED, ", ")
    )]
    NoPair {
        /// The sample that was requested.
        sample: Option<String>,
        /// Names of the samples of paint.
        samples: Vec<String>,
    },
    /// The two cards are alike.
    #[error("{sample}: the white card is not brighter than the black card")]
    #[hint("exchange the names of the cards, or read a white and a black one")]
    Cards {
        /// Name of the sample.
        sample: String,
    },
    /// The film is darker over the white card.
    #[error(
        "{sample}: at {nm} nm the film is darker over the white card by {by:.3}, which no film is"
    )]
    #[hint("exchange the films over white and black")]
    Darker {
        /// Name of the sample.
        sample: String,
        /// Difference of reflectance.
        by: f64,
        /// Wavelength in nm.
        nm: f64,
    },
    /// A reading is below what the stated surface reflects.
    #[error(
        "{sample} reads {measured:.4} at {nm} nm, below what the surface alone reflects (k1 = {k1})"
    )]
    #[hint("try [saunderson={lower},0.6], or [specular=excluded] for 45:0 instruments")]
    BelowSurface {
        /// Name of the sample.
        sample: String,
        /// Wavelength in nm.
        nm: f64,
        /// Reflectance that was read.
        measured: f64,
        /// k1 that was stated.
        k1: f64,
        /// A k1 below every reading.
        lower: f64,
    },
    /// The readings have no visible wavelength.
    #[error(transparent)]
    Band(#[from] BandError),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreading_rates_are_interpolated_between_neighbouring_films() {
        let film = |mm: f64, ratio: f64| FilmOnCards {
            sample: "a".to_owned(),
            thickness_mm: Some(mm),
            powers: Vec::new(),
            luminances: [80.0, 80.0 * ratio],
            contrast: Estimate { value: ratio, deviation: 0.0 },
            hiding: None,
            noise: 0.002,
        };
        let films = [film(0.05, 0.90), film(0.2, 0.995), film(0.1, 0.97)];
        let [(_, rate)] = interpolated(&films, 0.98, 1.0)[..] else { panic!("one sample") };
        // Between 5 and 10 square metres by litre, three fifths of the way.
        assert!((rate - 8.0).abs() < 1e-9, "{rate}");
        assert!((interpolated(&films, 0.98, 0.5)[0].1 - 4.0).abs() < 1e-9);
        assert!(interpolated(&films[..2], 0.999, 1.0).is_empty());
    }
}
