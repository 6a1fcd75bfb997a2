//! The colour of a film of a palette's paint over a ground, and how it changes
//! with each pigment.
//!
//! Kubelka and Munk 1931 through `spectra::optics::Layer`, Saunderson's surface,
//! then XYZ by a few nodes or by the whole grid. Colours of the photograph are
//! brought to the white of the light by Bradford's adaptation, as everywhere else.

use pigment::evaluate::Viewing;
use pigment::library::PigmentLibrary;
use pigment::quadrature::Quadrature;
use spectra::InterpolateError;
use spectra::color::{Adaptation, Lab, Matrix3, RgbSpace, Xyz};
use spectra::optics::{Layer, Surface};

use crate::document::Slots;
use crate::layer::SLOTS;

/// What is painted with, and on what.
#[derive(Debug, Clone, Copy)]
pub struct Materials<'a> {
    /// The pigments.
    pub library: &'a PigmentLibrary,
    /// The palette: indices into the library.
    pub slots: &'a Slots,
    /// Reflectance of the ground as an instrument would read it, on the
    /// library's grid.
    pub ground: &'a [f64],
    /// The library's thickness for one mm, `Medium::scattering_per_mm`.
    pub scattering_per_mm: f64,
}

/// Films of a palette over a ground, under one light.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintFilm {
    used: Vec<usize>,
    waves: Vec<Wave>,
    surface: Surface,
    white: Xyz,
    xyz_from_rgb: Matrix3,
    rgb_from_xyz: Matrix3,
}

/// One wavelength.
#[derive(Debug, Clone, PartialEq)]
struct Wave {
    /// K per mm of each slot.
    absorption: [f64; SLOTS],
    /// S per mm of each slot.
    scattering: [f64; SLOTS],
    /// Internal reflectance of the ground.
    ground: f64,
    /// Weights of X, Y and Z.
    weights: [f64; 3],
}

/// CIELAB of a film, and its slopes over each slot's mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) lab: [f64; 3],
    pub(super) over_mm: [[f64; SLOTS]; 3],
}

impl PaintFilm {
    /// Films seen at a few wavelengths, as the engine sees them.
    ///
    /// # Panics
    /// If the ground does not stand on the library's grid, or a slot names no
    /// pigment of it.
    #[must_use]
    pub fn at_nodes(materials: Materials<'_>, quadrature: &Quadrature) -> Self {
        let grid = materials.library.grid;
        let at = |values: &[f64]| quadrature.at_nodes(grid, values);
        Self::new(materials, &quadrature.weights, quadrature.white, at)
    }

    /// Films seen over the library's whole grid.
    ///
    /// # Errors
    /// Never in practice: the interpolation is chosen to fit the grid.
    ///
    /// # Panics
    /// As [`PaintFilm::at_nodes`].
    pub fn on_grid(materials: Materials<'_>, viewing: &Viewing) -> Result<Self, InterpolateError> {
        let weights = viewing.weights(materials.library.grid)?;
        Ok(Self::new(materials, weights.weights(), weights.white(), <[f64]>::to_vec))
    }

    fn new(
        materials: Materials<'_>,
        weights: &[[f64; 3]],
        white: Xyz,
        at: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Self {
        let Materials { library, slots, ground, scattering_per_mm } = materials;
        assert_eq!(
            ground.len(),
            library.grid.count(),
            "one reflectance of the ground a wavelength"
        );
        let surface = library.saunderson;
        let ground = at(ground);
        let mut waves: Vec<Wave> = weights
            .iter()
            .zip(&ground)
            .map(|(&weights, &bare)| Wave {
                absorption: [0.0; SLOTS],
                scattering: [0.0; SLOTS],
                // A ground darker than its own surface counts as black.
                ground: surface.internal_from_measured(bare).unwrap_or(0.0).min(1.0),
                weights,
            })
            .collect();
        let mut used = Vec::new();
        for (slot, index) in slots.iter().enumerate() {
            let Some(index) = index else { continue };
            let pigment = &library.pigments[*index];
            used.push(slot);
            let planes = at(&pigment.absorption).into_iter().zip(at(&pigment.scattering));
            for (wave, (k, s)) in waves.iter_mut().zip(planes) {
                wave.absorption[slot] = scattering_per_mm * k;
                wave.scattering[slot] = scattering_per_mm * s;
            }
        }
        let adaptation = Adaptation::Bradford.matrix(RgbSpace::Srgb.white(), white);
        let xyz_from_rgb = adaptation.after(&RgbSpace::Srgb.xyz_from_linear());
        let rgb_from_xyz = xyz_from_rgb.inverse();
        Self { used, waves, surface, white, xyz_from_rgb, rgb_from_xyz }
    }

    /// The slots that hold a pigment, rising.
    #[must_use]
    pub fn used(&self) -> &[usize] {
        &self.used
    }

    /// CIELAB, under the light, of a linear sRGB colour.
    #[must_use]
    pub fn lab_from_rgb(&self, rgb: [f32; 3]) -> Lab {
        Lab::from_xyz(self.xyz_from_rgb.apply(rgb.map(f64::from)).into(), self.white)
    }

    /// Linear sRGB of the film that these heights in mm make over the ground;
    /// outside 0..1 where sRGB does not reach it.
    #[must_use]
    pub fn rgb(&self, heights_mm: &[f32; SLOTS]) -> [f32; 3] {
        let xyz = self.xyz(&heights_mm.map(f64::from), 1.0);
        self.rgb_from_xyz.apply(xyz.to_array()).map(|value| value as f32)
    }

    /// CIELAB of the film that these heights in mm make over the ground.
    #[must_use]
    pub fn lab(&self, heights_mm: &[f64; SLOTS]) -> Lab {
        Lab::from_xyz(self.xyz(heights_mm, 1.0), self.white)
    }

    /// The same over black.
    pub(super) fn lab_over_black(&self, heights_mm: &[f64; SLOTS]) -> Lab {
        Lab::from_xyz(self.xyz(heights_mm, 0.0), self.white)
    }

    /// XYZ over the ground, its reflectance multiplied with `lit`: 0 for black.
    fn xyz(&self, heights_mm: &[f64; SLOTS], lit: f64) -> Xyz {
        let mut xyz = [0.0; 3];
        for wave in &self.waves {
            let (k, s) = wave.mixed(heights_mm);
            let internal = Layer::new(k, s, 1.0).over(lit * wave.ground);
            let seen = self.surface.measured_from_internal(internal);
            for (sum, weight) in xyz.iter_mut().zip(&wave.weights) {
                *sum += weight * seen;
            }
        }
        xyz.into()
    }

    /// CIELAB with its slopes, over the ground lit as in [`PaintFilm::xyz`].
    pub(super) fn slopes(&self, heights_mm: &[f64; SLOTS], lit: f64) -> Slopes {
        let mut xyz = [0.0; 3];
        let mut over_mm = [[0.0; SLOTS]; 3];
        for wave in &self.waves {
            let (k, s) = wave.mixed(heights_mm);
            let [internal, by_k, by_s] = Layer::over_with_slopes(k, s, lit * wave.ground);
            let slope = self.surface.measured_slope(internal);
            let seen = self.surface.measured_from_internal(internal);
            let (by_k, by_s) = (slope * by_k, slope * by_s);
            let by_slot: [f64; SLOTS] =
                std::array::from_fn(|i| by_k * wave.absorption[i] + by_s * wave.scattering[i]);
            for (channel, &weight) in wave.weights.iter().enumerate() {
                xyz[channel] += weight * seen;
                for (sum, slope) in over_mm[channel].iter_mut().zip(&by_slot) {
                    *sum += weight * slope;
                }
            }
        }
        let lab_over_xyz = Lab::slopes_over_xyz(xyz.into(), self.white).0;
        Slopes {
            lab: Lab::from_xyz(xyz.into(), self.white).to_array(),
            over_mm: lab_over_xyz
                .map(|row| std::array::from_fn(|i| (0..3).map(|j| row[j] * over_mm[j][i]).sum())),
        }
    }
}

impl Wave {
    /// K d and S d of a film.
    #[inline]
    fn mixed(&self, heights_mm: &[f64; SLOTS]) -> (f64, f64) {
        let sum = |values: &[f64; SLOTS]| values.iter().zip(heights_mm).map(|(v, h)| v * h).sum();
        (sum(&self.absorption), sum(&self.scattering))
    }
}
