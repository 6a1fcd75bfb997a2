//! Colour of a paint film over a ground, and its derivatives by the amount of each pigment.
//!
//! We use Kubelka and Munk 1931 through [`spectra::optics::Layer`], Saunderson's surface
//! correction, then XYZ at a few nodes or over the whole grid. We adapt sRGB colours to the white
//! of the light by Bradford's transform, as everywhere in impasto.

use pigment::library::PigmentLibrary;
use pigment::quadrature::EffectiveQuadrature;
use spectra::color::{Adaptation, Lab, Matrix3, RgbSpace, Xyz};
use spectra::optics::{Layer, Surface};

use crate::document::Slots;
use crate::layer::SLOTS;

/// Pigments, ground and binder of which you make films.
#[derive(Debug, Clone, Copy)]
pub struct FilmMaterials<'a> {
    /// Library of the pigments.
    pub library: &'a PigmentLibrary,
    /// Pigments of the palette.
    pub slots: &'a Slots,
    /// Measured reflectance of the ground on the library's grid, 0..1.
    pub ground: &'a [f64],
    /// Thickness in the library's unit per mm, see
    /// [`Medium::scattering_per_mm`](crate::document::Medium::scattering_per_mm).
    pub scattering_per_mm: f64,
}

/// Films of a palette over a ground, seen under one light.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintFilm {
    used: Vec<usize>,
    bands: Vec<Band>,
    surface: Surface,
    white: Xyz,
    xyz_from_rgb: Matrix3,
    rgb_from_xyz: Matrix3,
}

#[derive(Debug, Clone, PartialEq)]
struct Band {
    /// K per mm of each slot.
    absorption: [f64; SLOTS],
    /// S per mm of each slot.
    scattering: [f64; SLOTS],
    /// Internal reflectance of the ground, 0..1.
    ground: f64,
    /// Weights of the reflectance in X, Y and Z.
    weights: [f64; 3],
}

/// CIELAB of a film, with its derivatives by the height of each slot.
#[derive(Debug, Clone, Copy)]
pub(super) struct LabSlopes {
    pub(super) lab: [f64; 3],
    pub(super) over_mm: [[f64; SLOTS]; 3],
}

impl PaintFilm {
    /// Films as you see them at the nodes of `quadrature`. The paint engine computes them in this
    /// way.
    ///
    /// # Panics
    /// If the ground's reflectance is not on the library's grid, or a slot refers to a
    /// pigment that the library lacks.
    #[must_use]
    pub fn at_nodes(materials: FilmMaterials<'_>, quadrature: &EffectiveQuadrature) -> Self {
        let FilmMaterials { library, slots, ground, scattering_per_mm } = materials;
        assert_eq!(
            ground.len(),
            library.grid.count(),
            "the ground's reflectance is not on the library's grid"
        );
        let surface = library.saunderson;
        let white = quadrature.rule.white;
        let ground = quadrature.rule.at_nodes(library.grid, ground);
        let mut bands: Vec<Band> = quadrature
            .rule
            .weights
            .iter()
            .zip(&ground)
            .map(|(&weights, &bare)| Band {
                absorption: [0.0; SLOTS],
                scattering: [0.0; SLOTS],
                // We treat a ground darker than the surface reflection as black.
                ground: surface.internal_from_measured(bare).unwrap_or(0.0).min(1.0),
                weights,
            })
            .collect();
        let mut used = Vec::new();
        for (slot, pigment) in slots.iter().enumerate() {
            let Some(pigment) = pigment else { continue };
            used.push(slot);
            let [absorption, scattering] =
                [&quadrature.absorption, &quadrature.scattering].map(|c| &c[pigment.index()]);
            let planes = absorption.iter().zip(scattering);
            for (band, (k, s)) in bands.iter_mut().zip(planes) {
                band.absorption[slot] = scattering_per_mm * k;
                band.scattering[slot] = scattering_per_mm * s;
            }
        }
        let adaptation = Adaptation::Bradford.matrix(RgbSpace::Srgb.white(), white);
        let xyz_from_rgb = adaptation.after(&RgbSpace::Srgb.xyz_from_linear());
        let rgb_from_xyz = xyz_from_rgb.inverse();
        Self { used, bands, surface, white, xyz_from_rgb, rgb_from_xyz }
    }

    /// Indices of the slots in use, rising.
    #[must_use]
    pub fn used(&self) -> &[usize] {
        &self.used
    }

    /// CIELAB of a linear sRGB colour under the film's light.
    #[must_use]
    pub fn lab_from_rgb(&self, rgb: [f32; 3]) -> Lab {
        Lab::from_xyz(self.xyz_from_rgb.apply(rgb.map(f64::from)).into(), self.white)
    }

    /// Linear sRGB of the film of these heights (in mm, by slot) over the ground. Beyond the sRGB
    /// gamut you get values outside 0..1.
    #[must_use]
    pub fn rgb(&self, heights_mm: &[f32; SLOTS]) -> [f32; 3] {
        let xyz = self.xyz(&heights_mm.map(f64::from), 1.0);
        self.rgb_from_xyz.apply(xyz.to_array()).map(|value| value as f32)
    }

    /// CIELAB of the film of these heights (in mm, by slot) over the ground.
    #[must_use]
    pub fn lab(&self, heights_mm: &[f64; SLOTS]) -> Lab {
        Lab::from_xyz(self.xyz(heights_mm, 1.0), self.white)
    }

    /// CIELAB of the film of these heights (in mm, by slot) over black.
    pub(super) fn lab_over_black(&self, heights_mm: &[f64; SLOTS]) -> Lab {
        Lab::from_xyz(self.xyz(heights_mm, 0.0), self.white)
    }

    /// XYZ of a film. We multiply the ground's reflectance by `lit`: 1, or 0 for black.
    fn xyz(&self, heights_mm: &[f64; SLOTS], lit: f64) -> Xyz {
        let mut xyz = [0.0; 3];
        for band in &self.bands {
            let (k, s) = band.mixed(heights_mm);
            let internal = Layer::new(k, s, 1.0).over(lit * band.ground);
            let seen = self.surface.measured_from_internal(internal);
            for (sum, weight) in xyz.iter_mut().zip(&band.weights) {
                *sum += weight * seen;
            }
        }
        xyz.into()
    }

    /// CIELAB of a film with its derivatives, over the ground multiplied by `lit`: 1, or 0
    /// for black.
    pub(super) fn slopes(&self, heights_mm: &[f64; SLOTS], lit: f64) -> LabSlopes {
        let mut xyz = [0.0; 3];
        let mut over_mm = [[0.0; SLOTS]; 3];
        for band in &self.bands {
            let (k, s) = band.mixed(heights_mm);
            let [internal, by_k, by_s] = Layer::over_with_slopes(k, s, lit * band.ground);
            let slope = self.surface.measured_slope(internal);
            let seen = self.surface.measured_from_internal(internal);
            let by_k = slope * by_k;
            let by_s = slope * by_s;
            let by_slot: [f64; SLOTS] =
                std::array::from_fn(|i| by_k * band.absorption[i] + by_s * band.scattering[i]);
            for (channel, &weight) in band.weights.iter().enumerate() {
                xyz[channel] += weight * seen;
                for (sum, slope) in over_mm[channel].iter_mut().zip(&by_slot) {
                    *sum += weight * slope;
                }
            }
        }
        let lab_over_xyz = Lab::slopes_over_xyz(xyz.into(), self.white).0;
        LabSlopes {
            lab: Lab::from_xyz(xyz.into(), self.white).to_array(),
            over_mm: lab_over_xyz
                .map(|row| std::array::from_fn(|i| (0..3).map(|j| row[j] * over_mm[j][i]).sum())),
        }
    }
}

impl Band {
    /// Optical thicknesses K d and S d of a film of these heights.
    #[inline]
    fn mixed(&self, heights_mm: &[f64; SLOTS]) -> (f64, f64) {
        [&self.absorption, &self.scattering]
            .map(|values| values.iter().zip(heights_mm).map(|(v, h)| v * h).sum::<f64>())
            .into()
    }
}
