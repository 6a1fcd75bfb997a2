//! Bands of a scan, cut to the library's wavelengths and folded to its resolution.
//!
//! A scan often has several bands within one step of the library's grid. You learn no more about K
//! and S from them than from one band, but they cost more time. Each folded band is a weighted mean
//! of the bands around its wavelength, with weights that leave every straight line over wavelength
//! unchanged.
//!
//! We also fold the bare ground of a painting in this way, so that we recognise pixels without
//! paint.

use std::cmp::Ordering::Greater;

use pigment::library::{Pigment, PigmentLibrary};
use spectra::Grid;

use crate::pixel_maps::MapError;

/// We fold a scan to at most this many bands.
pub const MOST_BANDS: usize = 64;
/// A scan needs this many bands within the library's wavelengths.
pub const LEAST_BANDS: usize = 4;
/// We fold a scan if its step is smaller than this part of the wanted step (chosen by eye).
const FINER: f64 = 0.8;

/// A folded value as a weighted sum of other values.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Indices of the values, with their weights. The weights sum to 1.
    pub terms: Vec<(usize, f64)>,
}

impl Row {
    /// The weighted sum of `values`.
    ///
    /// # Panics
    /// If `values` is shorter than the list that you made the row for.
    #[must_use]
    pub fn apply(&self, values: &[f64]) -> f64 {
        self.terms.iter().map(|&(index, weight)| weight * values[index]).sum()
    }
}

/// Folded bands of a scan.
#[derive(Debug, Clone, PartialEq)]
pub struct Bands {
    /// Wavelengths of the folded bands in nm, rising; 4 to 64.
    pub nm: Vec<f64>,
    /// For each folded band, how it follows from the bands of the scan.
    pub from_scan: Vec<Row>,
    /// For each folded band, how it follows from values on the library's grid.
    pub from_library: Vec<Row>,
    /// Number of bands of the scan.
    pub scan_bands: usize,
}

impl Bands {
    /// Folds the bands of a scan at the wavelengths `nm` to the resolution of `grid`.
    ///
    /// We leave out bands outside the grid. If the scan is coarser than the grid, its bands stay as
    /// they are, and we fold the grid to them.
    ///
    /// # Errors
    /// [`MapError::Order`] unless `nm` rises strictly, [`MapError::Overlap`] if fewer than
    /// [`LEAST_BANDS`] lie within the grid.
    pub fn new(nm: &[f64], grid: Grid) -> Result<Self, MapError> {
        let disorder = (1..nm.len()).find(|&i| nm[i].partial_cmp(&nm[i - 1]) != Some(Greater));
        if let Some(index) = disorder {
            let before = nm[index - 1];
            let after = nm[index];
            return Err(MapError::Order { band: index + 1, before, after });
        }
        let inside: Vec<f64> = nm.iter().copied().filter(|&nm| grid.covers(nm)).collect();
        let overlap = MapError::Overlap {
            bands: nm.len(),
            inside: inside.len(),
            needed: LEAST_BANDS,
            start_nm: grid.start_nm(),
            end_nm: grid.end_nm(),
        };
        if inside.len() < LEAST_BANDS {
            return Err(overlap);
        }
        // A band beyond the grid still tells of the grid's end, if there is one on its other side.
        let first = nm[0].max(grid.start_nm());
        let last = nm[nm.len() - 1].min(grid.end_nm());
        let wanted = grid.step_nm().max((last - first) / (MOST_BANDS - 1) as f64);
        let own = median_step(&inside);
        let centers = if own >= FINER * wanted && inside.len() <= MOST_BANDS {
            inside
        } else {
            centers(grid, first, last, wanted)
        };
        let spacing = median_step(&centers);
        let from_scan = rows(nm, &centers, if own < FINER * wanted { spacing } else { 0.0 });
        let library: Vec<f64> = grid.wavelengths_nm().collect();
        let from_library = rows(&library, &centers, spacing.max(grid.step_nm()));
        // A gap in the scan leaves no band near some wavelengths.
        let found: Vec<(f64, Row, Row)> = (centers.into_iter().zip(from_scan).zip(from_library))
            .filter_map(|((nm, scan), library)| Some((nm, scan?, library?)))
            .collect();
        if found.len() < LEAST_BANDS {
            return Err(overlap);
        }
        let mut bands = Self {
            nm: Vec::new(),
            from_scan: Vec::new(),
            from_library: Vec::new(),
            scan_bands: nm.len(),
        };
        for (nm, scan, library) in found {
            bands.nm.push(nm);
            bands.from_scan.push(scan);
            bands.from_library.push(library);
        }
        Ok(bands)
    }

    /// Number of folded bands.
    #[must_use]
    pub fn count(&self) -> usize {
        self.nm.len()
    }

    /// Folds values on the library's grid.
    #[must_use]
    pub fn fold_library(&self, values: &[f64]) -> Vec<f64> {
        self.from_library.iter().map(|row| row.apply(values)).collect()
    }

    /// Folds the reflectances of one pixel of the scan.
    #[must_use]
    pub fn fold_scan(&self, values: &[f64]) -> Vec<f64> {
        self.from_scan.iter().map(|row| row.apply(values)).collect()
    }

    /// Standard deviation of each folded band, if the bands of the scan have independent noise of standard
    /// deviation `sensor`.
    #[must_use]
    pub fn noise(&self, sensor: f64) -> Vec<f64> {
        self.from_scan.iter().map(|row| sensor * row_noise(row)).collect()
    }
}

fn row_noise(row: &Row) -> f64 {
    row.terms.iter().map(|(_, w)| w * w).sum::<f64>().sqrt()
}

fn median_step(nm: &[f64]) -> f64 {
    let mut steps: Vec<f64> = nm.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied().unwrap_or(1.0)
}

/// Wavelengths of the grid itself if it has the wanted step, else evenly spaced ones.
fn centers(grid: Grid, first: f64, last: f64, wanted: f64) -> Vec<f64> {
    let slack = 1e-9 * wanted;
    let own: Vec<f64> =
        grid.wavelengths_nm().filter(|nm| (first - slack..=last + slack).contains(nm)).collect();
    if (wanted - grid.step_nm()).abs() <= slack && own.len() >= LEAST_BANDS {
        return own;
    }
    let count = (((last - first) / wanted + 1e-9).floor() as usize + 1).min(MOST_BANDS);
    let start = f64::midpoint(first, last) - 0.5 * wanted * (count - 1) as f64;
    (0..count).map(|index| start + wanted * index as f64).collect()
}

/// Rows of triangular weights with the half width `reach` around each centre, corrected so that
/// they are exact for straight lines. A centre without a value within reach has `None`. If you pass
/// a reach of 0, each centre must be one of the values.
fn rows(nm: &[f64], centers: &[f64], reach: f64) -> Vec<Option<Row>> {
    centers
        .iter()
        .map(|&center: &f64| {
            if reach == 0.0 {
                let index = nm.iter().position(|&nm| nm == center)?;
                return Some(Row { terms: vec![(index, 1.0)] });
            }
            let near = nm.iter().enumerate().filter_map(|(index, &nm)| {
                let x = (nm - center) / reach;
                (x.abs() < 1.0 - 1e-9).then_some((index, x, 1.0 - x.abs()))
            });
            let near: Vec<(usize, f64, f64)> = near.collect();
            let [s0, s1, s2] =
                [0, 1, 2].map(|power| near.iter().map(|(_, x, w)| w * x.powi(power)).sum::<f64>());
            let determinant = s0 * s2 - s1 * s1;
            let is_line = determinant > 1e-9 * s0 * s0;
            // A single value stands for its own wavelength only.
            let fits = is_line || near.iter().any(|(_, x, _)| x.abs() < 1e-6);
            let terms = near.iter().map(|&(i, x, w)| {
                (i, if is_line { w * (s2 - s1 * x) / determinant } else { w / s0 })
            });
            fits.then(|| Row { terms: terms.collect() })
        })
        .collect()
}

/// The lightness of the ground varies from place to place by this standard deviation, relative to
/// its reflectance.
const LIGHTNESS: f64 = 0.03;
/// The light that the surface itself reflects varies by this standard deviation, in reflectance.
const GLOSS: f64 = 0.005;
/// Each band of bare ground also varies by itself, with this standard deviation relative to its
/// reflectance.
const UNEVEN: f64 = 0.005;
/// A pixel is bare ground up to this chi-square per band.
const EXPLAINED: f64 = 2.0;

/// Internal reflectances of a ground, so that K/S is above 0 and finite.
const INTERNAL: [f64; 2] = [1e-3, 0.9995];

/// Reflectance of the bare ground of a painting in the scan.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "GroundKeys")]
pub struct Ground {
    nm: Vec<f64>,
    reflectance: Vec<f64>,
}

/// The keys of a ground, before we check their values.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct GroundKeys {
    nm: Vec<f64>,
    reflectance: Vec<f64>,
}

impl TryFrom<GroundKeys> for Ground {
    type Error = MapError;

    fn try_from(keys: GroundKeys) -> Result<Self, MapError> {
        Self::new(keys.nm, keys.reflectance)
    }
}

impl Ground {
    /// Pass reflectances, 0 to 1.5, at rising wavelengths `nm` in nm.
    ///
    /// # Errors
    /// [`MapError::Ground`] if the lists differ in length, the wavelengths do not rise, or a number
    /// is not a reflectance.
    pub fn new(nm: Vec<f64>, reflectance: Vec<f64>) -> Result<Self, MapError> {
        if nm.len() != reflectance.len() || nm.len() < 2 {
            let nm = nm.len();
            let values = reflectance.len();
            return Err(ground_error(format!("has {nm} wavelengths and {values} reflectances")));
        }
        if let Some(place) = nm.windows(2).position(|pair| !rises(pair)) {
            let before = nm[place];
            let after = nm[place + 1];
            return Err(ground_error(format!("has {after} nm after {before} nm")));
        }
        if let Some(place) = reflectance.iter().position(|value| !(0.0..=1.5).contains(value)) {
            let value = reflectance[place];
            let nm = nm[place];
            return Err(ground_error(format!("reflects {value} at {nm} nm")));
        }
        Ok(Self { nm, reflectance })
    }

    /// The column of the ground in a map: how much of it shows through thin paint.
    pub const COLUMN: &str = "ground";

    /// `library` with the ground as one more pigment, the last. We know K/S of it, from its reflectance,
    /// and set S to 1: a film through which the ground shows looks much like the paint mixed with the
    /// ground. Wavelengths that nobody measured take the nearest reflectance.
    ///
    /// # Errors
    /// [`MapError::Ground`] if a pigment has this name.
    pub(crate) fn among(&self, library: &PigmentLibrary) -> Result<PigmentLibrary, MapError> {
        if library.pigments.iter().any(|pigment| pigment.name == Self::COLUMN) {
            let name = Self::COLUMN;
            return Err(ground_error(format!("has the name of the library's pigment `{name}`")));
        }
        let ratios = library.grid.wavelengths_nm().map(|nm| {
            let last = *self.reflectance.last().unwrap_or(&0.0);
            let nearest = if nm < self.nm[0] { self.reflectance[0] } else { last };
            let measured = self.at(nm).unwrap_or(nearest);
            let internal = library.saunderson.internal_from_measured(measured).unwrap_or(0.0);
            let internal = internal.clamp(INTERNAL[0], INTERNAL[1]);
            (1.0 - internal).powi(2) / (2.0 * internal)
        });
        let mut library = library.clone();
        let absorption: Vec<f64> = ratios.collect();
        library.pigments.push(Pigment {
            name: Self::COLUMN.to_owned(),
            color_index: None,
            scattering: vec![1.0; absorption.len()],
            absorption,
            absorption_sd: Vec::new(),
            scattering_sd: Vec::new(),
            identified: false,
            guessed: false,
            measured_amounts: None,
            notes: Vec::new(),
        });
        Ok(library)
    }

    /// Interpolates the reflectance at a wavelength. Outside the measured ones this is `None`.
    fn at(&self, nm: f64) -> Option<f64> {
        let after = self.nm.iter().position(|own| *own >= nm)?;
        if self.nm[after] == nm {
            return Some(self.reflectance[after]);
        }
        let before = after.checked_sub(1)?;
        let part = (nm - self.nm[before]) / (self.nm[after] - self.nm[before]);
        Some(self.reflectance[before] * (1.0 - part) + self.reflectance[after] * part)
    }
}

fn rises(pair: &[f64]) -> bool {
    pair[0] < pair[1]
}

fn ground_error(problem: String) -> MapError {
    MapError::Ground(problem)
}

/// The ground on the bands of a map, and the covariance with which it differs from place to place.
/// We take three differences together: a common lightness, a common gloss, and each band by itself.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BareGround {
    reflectance: Vec<f64>,
    /// 1 / variance of each band.
    weights: Vec<f64>,
    /// Weights of two sums over the differences of a pixel from the ground. We subtract the squares
    /// of these sums from chi-square, because lightness and gloss vary in common.
    common: [Vec<f64>; 2],
}

impl BareGround {
    /// Prepares `ground` for `bands` of a scan at `wavelengths`. `sensor` holds the variance of
    /// each band.
    pub(crate) fn new(
        ground: &Ground,
        wavelengths: &[f64],
        bands: &Bands,
        sensor: &[f64],
    ) -> Result<Self, MapError> {
        let needed = bands.from_scan.iter().flat_map(|row| row.terms.iter().map(|term| term.0));
        let mut of_scan = vec![0.0; wavelengths.len()];
        for band in needed {
            let nm = wavelengths[band];
            of_scan[band] = ground
                .at(nm)
                .ok_or_else(|| MapError::Ground(format!("tells nothing of {nm} nm")))?;
        }
        let reflectance = bands.fold_scan(&of_scan);
        let own = reflectance.iter().zip(sensor);
        let weights: Vec<f64> =
            own.map(|(r, sensor)| 1.0 / (sensor + (UNEVEN * r).powi(2) + 1e-8)).collect();
        let curves = [
            reflectance.iter().map(|r| LIGHTNESS * r).collect::<Vec<f64>>(),
            vec![GLOSS; reflectance.len()],
        ];
        // Woodbury: V^-1 = W - W C (I + C^T W C)^-1 C^T W, where the middle factor is L^-T L^-1.
        let product = |a: &[f64], b: &[f64]| -> f64 {
            a.iter().zip(b).zip(&weights).map(|((a, b), w)| a * b * w).sum()
        };
        let first = (1.0 + product(&curves[0], &curves[0])).sqrt();
        let below = product(&curves[0], &curves[1]) / first;
        let second = (1.0 + product(&curves[1], &curves[1]) - below * below).sqrt();
        let of_first: Vec<f64> =
            curves[0].iter().zip(&weights).map(|(c, w)| c * w / first).collect();
        let of_second = (curves[1].iter().zip(&weights).zip(&of_first))
            .map(|((c, w), first)| (c * w - below * first) / second)
            .collect();
        Ok(Self { reflectance, weights, common: [of_first, of_second] })
    }

    /// Chi-square per band of a pixel, assuming that it is bare ground.
    pub(crate) fn chi2(&self, reflectance: &[f32]) -> f64 {
        let mut sum = 0.0;
        let mut common = [0.0; 2];
        for (band, (own, value)) in self.reflectance.iter().zip(reflectance).enumerate() {
            let difference = f64::from(*value) - own;
            sum += difference * difference * self.weights[band];
            common[0] += difference * self.common[0][band];
            common[1] += difference * self.common[1][band];
        }
        (sum - common[0] * common[0] - common[1] * common[1]) / self.reflectance.len() as f64
    }

    pub(crate) fn explains(&self, reflectance: &[f32]) -> bool {
        self.chi2(reflectance) <= EXPLAINED
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use spectra::Grid;

    fn oils() -> Grid {
        Grid::from_nm(400.0, 10.0, 31).unwrap()
    }

    fn even(start: f64, step: f64, count: usize) -> Vec<f64> {
        (0..count).map(|i| start + step * i as f64).collect()
    }

    #[test]
    fn bands_on_the_grid_stay_as_they_are() {
        let bands = Bands::new(&even(400.0, 10.0, 31), oils()).unwrap();
        assert_eq!(bands.count(), 31);
        for (index, row) in bands.from_scan.iter().enumerate() {
            assert_eq!(row.terms, [(index, 1.0)]);
        }
        let values: Vec<f64> = (0..31).map(|i| f64::from(i * i)).collect();
        assert_eq!(bands.fold_library(&values), values);
    }

    #[test]
    fn fine_bands_are_folded_and_straight_lines_kept() {
        let nm = even(397.3, 2.92, 204);
        let bands = Bands::new(&nm, oils()).unwrap();
        assert_eq!(bands.count(), 31, "{:?}", bands.nm);
        let scan: Vec<f64> = nm.iter().map(|&nm| line(nm)).collect();
        let library: Vec<f64> = oils().wavelengths_nm().map(line).collect();
        for (nm, (a, b)) in
            bands.nm.iter().zip(bands.fold_scan(&scan).iter().zip(bands.fold_library(&library)))
        {
            assert!((a - line(*nm)).abs() < 1e-12 && (b - line(*nm)).abs() < 1e-12, "{nm} nm");
        }
        assert!(bands.noise(0.003).iter().all(|&sd| sd < 0.0025), "{:?}", bands.noise(0.003));
    }

    fn line(nm: f64) -> f64 {
        0.2 + 0.001 * (nm - 400.0)
    }

    #[test]
    fn a_band_beside_a_gap_needs_two_values_or_one_at_its_wavelength() {
        let nm = [400.0, 410.0, 420.0, 460.0, 470.0];
        let centers = [425.0, 430.0, 440.0, 450.0, 455.0];
        let found = rows(&nm, &centers, 20.0);
        let known: Vec<bool> = found.iter().map(Option::is_some).collect();
        assert_eq!(known, [true, false, false, false, true], "one value or none within 20 nm");
        for (center, row) in centers.iter().zip(found) {
            let Some(row) = row else { continue };
            let values = nm.map(line);
            assert!((row.apply(&values) - line(*center)).abs() < 1e-12, "{center} nm");
        }
        // One value at the wavelength itself stands for it.
        assert_eq!(rows(&nm, &[460.0], 5.0)[0].as_ref().unwrap().terms, [(3, 1.0)]);
        assert!(rows(&nm, &[461.0], 5.0)[0].is_none(), "a value 1 nm off stands for its own");
        assert!(rows(&nm, &[450.0], 0.0)[0].is_none(), "no reach");
    }

    #[test]
    fn coarse_bands_stay_and_a_fine_library_is_folded_to_64() {
        let few = Bands::new(&[420.0, 465.0, 500.0, 555.0, 610.0, 660.0, 810.0], oils()).unwrap();
        assert_eq!(few.nm, [420.0, 465.0, 500.0, 555.0, 610.0, 660.0]);
        let grid = Grid::from_nm(380.0, 1.0, 2121).unwrap();
        let bands = Bands::new(&even(400.0, 2.0, 1000), grid).unwrap();
        assert_eq!(bands.count(), MOST_BANDS);
    }

    #[test]
    fn wavelengths_that_do_not_fit_are_refused() {
        let error = Bands::new(&[400.0, 410.0, 410.0, 420.0], oils()).unwrap_err();
        assert!(matches!(error, MapError::Order { band: 3, .. }), "{error}");
        let error = Bands::new(&[400.0, f64::NAN, 410.0, 420.0], oils()).unwrap_err();
        assert!(matches!(error, MapError::Order { .. }), "{error}");
        let micrometres = even(0.4, 0.01, 31);
        let error = Bands::new(&micrometres, oils()).unwrap_err();
        assert!(matches!(error, MapError::Overlap { inside: 0, .. }), "{error}");
        assert!(Bands::new(&[], oils()).is_err(), "no bands");
    }

    #[test]
    fn a_gap_in_the_scan_leaves_a_gap_in_the_bands() {
        let nm: Vec<f64> =
            even(400.0, 2.5, 121).into_iter().filter(|nm| !(500.0..=560.0).contains(nm)).collect();
        let bands = Bands::new(&nm, oils()).unwrap();
        assert!(bands.nm.iter().all(|nm| !(505.0..=555.0).contains(nm)), "{:?}", bands.nm);
    }

    fn linen() -> (Vec<f64>, Vec<f64>) {
        let nm: Vec<f64> = (0..31).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        let reflectance = nm.iter().map(|nm| 0.2 + 0.001 * (nm - 400.0)).collect();
        (nm, reflectance)
    }

    fn bare() -> BareGround {
        let (nm, reflectance) = linen();
        let bands = Bands::new(&nm, Grid::from_nm(400.0, 10.0, 31).unwrap()).unwrap();
        let ground = Ground::new(nm.clone(), reflectance).unwrap();
        BareGround::new(&ground, &nm, &bands, &[9e-6; 31]).unwrap()
    }

    #[test]
    fn chi_square_is_that_of_the_dense_covariance() {
        let (_, ground) = linen();
        let pixel: Vec<f32> =
            (0..31).map(|i| (1.03 * ground[i] + 0.004 * (i as f64).sin() + 0.003) as f32).collect();
        let mean = DVector::from_vec(ground.clone());
        let covariance = DMatrix::from_fn(31, 31, |i, j| {
            let own = if i == j { 9e-6 + (UNEVEN * ground[i]).powi(2) + 1e-8 } else { 0.0 };
            own + LIGHTNESS * LIGHTNESS * ground[i] * ground[j] + GLOSS * GLOSS
        });
        let difference = DVector::from_iterator(31, pixel.iter().map(|v| f64::from(*v))) - mean;
        let solved = covariance.cholesky().unwrap().solve(&difference);
        let expected = difference.dot(&solved) / 31.0;
        let found = bare().chi2(&pixel);
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    }

    #[test]
    fn lighter_and_glossier_ground_is_ground_and_other_colours_are_not() {
        let (_, ground) = linen();
        let bare = bare();
        let of = |change: &dyn Fn(usize, f64) -> f64| -> Vec<f32> {
            ground.iter().enumerate().map(|(i, r)| change(i, *r) as f32).collect()
        };
        assert!(bare.explains(&of(&|_, r| r)));
        assert!(bare.explains(&of(&|_, r| 0.95 * r)), "darker");
        assert!(bare.explains(&of(&|_, r| r + 0.008)), "glossier");
        assert!(!bare.explains(&of(&|_, r| 0.6 * r)), "much darker");
        assert!(!bare.explains(&of(&bent)), "of another colour");
    }

    fn bent(i: usize, r: f64) -> f64 {
        r + 0.03 * (i as f64 / 10.0).sin()
    }

    #[test]
    fn ground_that_cannot_be_used_is_refused() {
        let (nm, reflectance) = linen();
        refused(nm.clone(), vec![0.2; 30], "31 wavelengths and 30 reflectances");
        refused(vec![500.0, 400.0], vec![0.2; 2], "400 nm after 500 nm");
        refused(vec![500.0, f64::NAN], vec![0.2; 2], "NaN nm after 500 nm");
        refused(vec![500.0, 500.0], vec![0.2; 2], "500 nm after 500 nm");
        refused(vec![500.0], vec![0.2], "1 wavelengths and 1 reflectances");
        refused(vec![400.0, 500.0], vec![0.2, 42.0], "reflects 42 at 500 nm");
        refused(vec![400.0, 500.0], vec![-0.1, 0.2], "reflects -0.1 at 400 nm");
        refused(vec![400.0, 500.0], vec![f64::NAN, 0.2], "reflects NaN at 400 nm");
        let bands = Bands::new(&nm, Grid::from_nm(400.0, 10.0, 31).unwrap()).unwrap();
        let short = Ground::new(nm[..30].to_vec(), reflectance[..30].to_vec()).unwrap();
        let error = BareGround::new(&short, &nm, &bands, &[9e-6; 31]).unwrap_err();
        assert!(error.to_string().contains("700 nm"), "{error}");
        let late = Ground::new(nm[1..].to_vec(), reflectance[1..].to_vec()).unwrap();
        let error = BareGround::new(&late, &nm, &bands, &[9e-6; 31]).unwrap_err();
        assert!(error.to_string().contains("400 nm"), "{error}");
    }

    fn refused(nm: Vec<f64>, reflectance: Vec<f64>, words: &str) {
        let error = Ground::new(nm, reflectance).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }

    #[test]
    fn ground_of_other_wavelengths_is_interpolated() {
        let (nm, reflectance) = linen();
        let bands = Bands::new(&nm, Grid::from_nm(400.0, 10.0, 31).unwrap()).unwrap();
        let few = [[0.175, 0.305, 0.365, 0.525], [0.1, 0.36, 0.24, 0.56]];
        let [straight, bent] = few.map(|few| {
            let ground = Ground::new(vec![375.0, 505.0, 565.0, 725.0], few.to_vec()).unwrap();
            BareGround::new(&ground, &nm, &bands, &[9e-6; 31]).unwrap().reflectance
        });
        for (found, expected) in straight.iter().zip(&reflectance) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
        // A ground that bends between the bands lies between its neighbours everywhere.
        let expected = nm.iter().map(|nm| match nm {
            ..505.0 => 0.1 + 0.002 * (nm - 375.0),
            ..565.0 => 0.36 - 0.002 * (nm - 505.0),
            _ => 0.24 + 0.002 * (nm - 565.0),
        });
        let off = bent.iter().zip(expected).map(|(found, expected)| (found - expected).abs());
        let off: Vec<usize> =
            off.enumerate().filter(|(_, off)| *off > 1e-9).map(|(band, _)| band).collect();
        assert!(off.is_empty(), "{off:?} {bent:?}");
    }
}
