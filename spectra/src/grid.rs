//! Regular wavelength grids, and a single wavelength in nanometres.

use documents::hint::Explain;
use serde::{Deserialize, Serialize};

/// Wavelengths in nanometres at a constant step.
///
/// ```
/// use spectra::Grid;
/// let grid = Grid::from_nm(400.0, 10.0, 31).unwrap();
/// assert_eq!(grid.end_nm(), 700.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "GridParts", into = "GridParts")]
pub struct Grid {
    start: Wavelength,
    step_nm: f64,
    count: usize,
}

impl Grid {
    /// A grid of `count` wavelengths from `start_nm` on, `step_nm` apart.
    ///
    /// # Errors
    /// [`GridError`] unless the start is a wavelength, the step finite and
    /// above 0, and the count at least 1.
    pub fn from_nm(start_nm: f64, step_nm: f64, count: usize) -> Result<Self, GridError> {
        let start = Wavelength::from_nm(start_nm)?;
        if !(step_nm.is_finite() && step_nm > 0.0) {
            return Err(GridError::Step(step_nm));
        }
        if count == 0 {
            return Err(GridError::Empty);
        }
        Ok(Self { start, step_nm, count })
    }

    /// The grid from `first_nm` to `last_nm` in steps of `step_nm`.
    ///
    /// # Errors
    /// [`GridError`] unless you reach the last wavelength from the first in a whole number of steps
    /// (to a millionth of a step), at most 100 000, or if [`Grid::from_nm`] refuses the numbers.
    pub fn from_range(first_nm: f64, last_nm: f64, step_nm: f64) -> Result<Self, GridError> {
        let steps = (last_nm - first_nm) / step_nm;
        let is_whole = (steps - steps.round()).abs() <= 1e-6;
        if !(is_whole && (0.0..=100_000.0).contains(&steps)) {
            return Err(GridError::Range { first_nm, last_nm, step_nm });
        }
        Self::from_nm(first_nm, step_nm, steps.round() as usize + 1)
    }

    /// The grid of 360 to 830 nm at 1 nm: the band of the CIE standard observers, over which we sum
    /// tristimulus values (CIE 15:2018, section 7.1).
    #[must_use]
    pub fn cie() -> Self {
        Self {
            start: Wavelength::from_nm(360.0).expect("360 is a wavelength"),
            step_nm: 1.0,
            count: 471,
        }
    }

    /// The grid through `nm`, if the wavelengths rise at a constant step (to a millionth of this
    /// step), otherwise `None`. A single wavelength gives a grid of step 1.
    #[must_use]
    pub fn through(nm: &[f64]) -> Option<Self> {
        let first = *nm.first()?;
        let step = match nm.last() {
            Some(&last) if nm.len() > 1 => (last - first) / (nm.len() - 1) as f64,
            _ => 1.0,
        };
        let grid = Self::from_nm(first, step, nm.len()).ok()?;
        let regular =
            nm.iter().zip(grid.wavelengths_nm()).all(|(a, b)| (a - b).abs() <= 1e-6 * step);
        regular.then_some(grid)
    }

    /// A regular grid for wavelengths that may be irregular. This is [`Grid::through`] them if
    /// possible. Otherwise you get a grid inside their band with a step of 1, 2, 5, 10 or 20 nm: the
    /// largest one that is not coarser (by more than 5 %) than their smallest step, and never below 1 nm.
    /// `None` unless the wavelengths rise strictly.
    #[must_use]
    pub fn suited_to(nm: &[f64]) -> Option<Self> {
        if let Some(grid) = Self::through(nm) {
            return Some(grid);
        }
        let steps = nm.windows(2).map(|pair| pair[1] - pair[0]);
        let smallest = steps.reduce(f64::min).filter(|step| *step > 0.0)?;
        let step =
            [20.0, 10.0, 5.0, 2.0].into_iter().find(|s| *s <= 1.05 * smallest).unwrap_or(1.0);
        let last = nm[nm.len() - 1];
        let round = (nm[0] / step).ceil() * step;
        let start = if round <= last { round } else { nm[0] };
        let count = ((last - start) / step).floor().max(0.0) as usize + 1;
        Self::from_nm(start, step, count).ok()
    }

    /// The first wavelength in nm.
    #[must_use]
    pub fn start_nm(&self) -> f64 {
        self.start.nm()
    }

    /// The step in nm.
    #[must_use]
    pub fn step_nm(&self) -> f64 {
        self.step_nm
    }

    /// Number of wavelengths, at least 1.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The last wavelength in nm.
    #[must_use]
    pub fn end_nm(&self) -> f64 {
        self.nm(self.count - 1)
    }

    /// The wavelength at `index` (from 0) in nm.
    #[must_use]
    pub fn nm(&self, index: usize) -> f64 {
        self.start.nm() + self.step_nm * index as f64
    }

    /// All wavelengths in nm, rising.
    pub fn wavelengths_nm(&self) -> impl ExactSizeIterator<Item = f64> + Clone + use<> {
        let grid = *self;
        (0..grid.count).map(move |index| grid.nm(index))
    }

    /// Whether `nm` lies between the first and the last wavelength, both included (to a
    /// billionth of the step).
    #[must_use]
    pub fn covers(&self, nm: f64) -> bool {
        let slack = 1e-9 * self.step_nm;
        nm >= self.start_nm() - slack && nm <= self.end_nm() + slack
    }
}

impl std::fmt::Display for Grid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} to {} nm in steps of {} nm", self.start_nm(), self.end_nm(), self.step_nm)
    }
}

/// The fields of a grid in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GridParts {
    start_nm: f64,
    step_nm: f64,
    count: usize,
}

impl TryFrom<GridParts> for Grid {
    type Error = GridError;

    fn try_from(parts: GridParts) -> Result<Self, GridError> {
        Self::from_nm(parts.start_nm, parts.step_nm, parts.count)
    }
}

impl From<Grid> for GridParts {
    fn from(grid: Grid) -> Self {
        Self { start_nm: grid.start_nm(), step_nm: grid.step_nm, count: grid.count }
    }
}

/// Numbers that do not define a grid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
pub enum GridError {
    /// The start is not a wavelength.
    #[error(transparent)]
    Start(#[from] WavelengthError),
    /// The step is not a finite number above 0.
    #[error("the step of a grid is a finite number of nanometres above 0, found `{0}`")]
    Step(f64),
    /// The last wavelength is not a whole number of steps from the first.
    #[error("{last_nm} nm is not a whole number of steps of `{step_nm}` nm from {first_nm} nm")]
    Range {
        /// The first wavelength in nm.
        first_nm: f64,
        /// The last wavelength in nm.
        last_nm: f64,
        /// The step that was given, in nm.
        step_nm: f64,
    },
    /// The grid has no wavelength.
    #[error("a grid holds at least one wavelength, found `0`")]
    Empty,
}

/// A finite, positive wavelength in nanometres.
///
/// ```
/// use spectra::Wavelength;
/// assert_eq!(Wavelength::from_nm(550.0).unwrap().nm(), 550.0);
/// assert!(Wavelength::from_nm(-1.0).is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Wavelength(f64);

impl Wavelength {
    /// A wavelength of `nm` nanometres.
    ///
    /// # Errors
    /// [`WavelengthError`] unless `nm` is finite and above 0.
    pub fn from_nm(nm: f64) -> Result<Self, WavelengthError> {
        if nm.is_finite() && nm > 0.0 { Ok(Self(nm)) } else { Err(WavelengthError { nm }) }
    }

    /// The wavelength in nanometres.
    #[must_use]
    pub fn nm(self) -> f64 {
        self.0
    }
}

impl TryFrom<f64> for Wavelength {
    type Error = WavelengthError;

    fn try_from(nm: f64) -> Result<Self, WavelengthError> {
        Self::from_nm(nm)
    }
}

impl From<Wavelength> for f64 {
    fn from(wavelength: Wavelength) -> Self {
        wavelength.0
    }
}

impl std::fmt::Display for Wavelength {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} nm", self.0)
    }
}

/// A number that is not a wavelength.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
#[error("a wavelength is a finite number of nanometres above 0, found `{nm}`")]
pub struct WavelengthError {
    /// The number that was given, in nm.
    pub nm: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_never_coarser_than_irregular_wavelengths() {
        for (steps, wanted) in [
            ([15.0, 16.0, 15.5], 10.0),
            ([9.7, 10.3, 10.0], 10.0),
            ([10.0, 10.0, 20.0], 10.0),
            ([3.3, 3.4, 3.3], 2.0),
            ([25.0, 30.0, 30.0], 20.0),
            ([20.0, 5.0, 20.0], 5.0),
            ([0.3, 0.4, 0.3], 1.0),
        ] {
            let mut nm = vec![400.0];
            steps.iter().for_each(|step| nm.push(nm[nm.len() - 1] + step));
            assert_eq!(Grid::suited_to(&nm).unwrap().step_nm(), wanted, "{steps:?}");
        }
        assert_eq!(Grid::suited_to(&[400.0, 400.0, 410.0]), None);
    }
}
