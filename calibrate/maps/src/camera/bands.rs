//! Spectra of a scene at the wavelengths of the bands.

use spectra::{Extrapolation, Grid, Interpolation, Response, Spectrum};

use super::settings::{CameraError, RANGE_NM};

/// Rows of weights that interpolate spectra on a grid at the wavelengths of bands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CameraBands {
    pub(crate) nm: Vec<f64>,
    /// First wavelength of the grid and weights of it and those that follow, of each band.
    rows: Vec<(usize, Vec<f64>)>,
}

impl CameraBands {
    /// `count` bands over what `grid` has of the range of the camera.
    pub(crate) fn new(grid: Grid, count: usize) -> Result<Self, CameraError> {
        let outside = || CameraError::Wavelengths { grid };
        let first = grid.start_nm().max(RANGE_NM[0]);
        let last = grid.end_nm().min(RANGE_NM[1]);
        if first >= last {
            return Err(outside());
        }
        let nm: Vec<f64> = (0..count)
            .map(|band| first + (last - first) * band as f64 / (count.max(2) - 1) as f64)
            // Three digits, which the header holds.
            .map(|nm| ((nm * 1000.0).round() / 1000.0).clamp(first, last))
            .collect();
        let units = (0..grid.count()).map(|at| {
            let unit = (0..grid.count()).map(|other| f64::from(u8::from(other == at))).collect();
            Spectrum::<Response>::new(grid, unit).map_err(|_| outside())
        });
        let units = units.collect::<Result<Vec<_>, _>>()?;
        let method = Interpolation::best_for(grid);
        let rows = nm
            .iter()
            .map(|nm: &f64| {
                let weights = units.iter().map(|unit| unit.at(*nm, method, Extrapolation::Refuse));
                let weights = weights.collect::<Result<Vec<f64>, _>>().map_err(|_| outside())?;
                let is_used = |weight: &f64| *weight != 0.0;
                let first = weights.iter().position(is_used).unwrap_or(0);
                let end = weights.iter().rposition(is_used).map_or(first, |last| last + 1);
                Ok((first, weights[first..end].to_vec()))
            })
            .collect::<Result<_, CameraError>>()?;
        Ok(Self { nm, rows })
    }

    /// Values of a spectrum in each band.
    pub(crate) fn values(&self, spectrum: &[f64]) -> impl Iterator<Item = f64> {
        self.rows.iter().map(|(first, weights)| {
            weights.iter().zip(&spectrum[*first..]).map(|(weight, value)| weight * value).sum()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_lie_evenly_and_take_smooth_spectra_as_they_are() {
        let grid = Grid::from_range(380.0, 700.0, 10.0).unwrap();
        let bands = CameraBands::new(grid, 31).unwrap();
        let expected: Vec<f64> = (0..31).map(|band| 400.0 + 10.0 * f64::from(band)).collect();
        assert_eq!(bands.nm, expected);
        let spectrum: Vec<f64> = grid.wavelengths_nm().map(|nm| (nm / 60.0).sin()).collect();
        let at: Vec<f64> = bands.values(&spectrum).collect();
        assert!(at.iter().zip(&spectrum[2..]).all(|(a, b)| (a - b).abs() < 1e-12), "on the grid");
        let fine = CameraBands::new(grid, 204).unwrap();
        assert_eq!((fine.nm[0], fine.nm[203]), (400.0, 700.0));
        for (nm, value) in fine.nm.iter().zip(fine.values(&spectrum)) {
            // The last intervals are bounded by extrapolated values.
            let most = if (420.0..670.0).contains(nm) { 1e-5 } else { 2e-3 };
            assert!((value - (nm / 60.0).sin()).abs() < most, "{nm}: {value}");
        }
    }

    #[test]
    fn the_range_is_that_of_the_camera() {
        let long = Grid::from_range(300.0, 2500.0, 10.0).unwrap();
        let bands = CameraBands::new(long, 4).unwrap();
        assert_eq!(bands.nm, [400.0, 600.0, 800.0, 1000.0]);
        let infrared = Grid::from_range(1200.0, 2500.0, 10.0).unwrap();
        let error = CameraBands::new(infrared, 4).unwrap_err().to_string();
        assert!(error.contains("1200 to 2500 nm"), "{error}");
    }
}
