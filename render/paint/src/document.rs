//! A painting at rest: everything that its file stores.

use pigment::library::PigmentLibrary;
use pigment::palette::scattering_per_mm;
use sha2::{Digest, Sha256};

use crate::ground::Ground;
use crate::layer::Layer;
use crate::optics::Gloss;

pub use crate::dry_layer::{DryLayer, LayerId};
pub use crate::layer::Slots;

/// Light that a painting is viewed under.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lighting {
    /// Name of the illuminant, as [`spectra::light_from_text`] reads it (`D65`, `A`, `4000K`).
    pub illuminant: String,
    /// Name of the observer, as [`spectra::Observer::named`] reads it (`1931-2`).
    pub observer: String,
    /// Direction of the light, in degrees clockwise from the top of the canvas.
    pub azimuth_deg: f64,
    /// Elevation of the light above the canvas in degrees, above 0 and up to 90.
    pub elevation_deg: f64,
    /// Share of diffuse light from all sides, 0..1.
    pub ambient: f64,
    /// Factor on the heights of the relief: 0 flat, 1 physical.
    pub relief: f64,
    /// How far the eye adapted to the light, 0..1: at 1 white paint is white under every light,
    /// at 0 the picture has the light's own colour beside D65. Files omit 1.
    #[serde(default = "complete", skip_serializing_if = "is_complete")]
    pub adaptation: f64,
}

fn complete() -> f64 {
    1.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_complete(adaptation: &f64) -> bool {
    *adaptation == complete()
}

impl Default for Lighting {
    /// Daylight from the upper left, half of it diffuse.
    fn default() -> Self {
        Self {
            illuminant: "D65".to_owned(),
            observer: "1931-2".to_owned(),
            azimuth_deg: 315.0,
            elevation_deg: 50.0,
            ambient: 0.5,
            relief: 1.0,
            adaptation: complete(),
        }
    }
}

/// The binder: the optical thickness of a film per mm of height, and its gloss.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Medium {
    /// S of the library's reference white per mm of height. It converts heights to the
    /// library's thickness, which has no unit of its own.
    pub scattering_per_mm: f64,
    /// Stiffness of the wet paint: 0 is stand oil, which levels by itself, 1 is putty, which
    /// stays as it is laid. Left out of files where it is that of tube paint.
    #[serde(default = "tube_paint", skip_serializing_if = "is_tube_paint")]
    pub stiffness: f64,
    /// Gloss of wet paint.
    pub wet: Gloss,
    /// Gloss of dry paint.
    pub dry: Gloss,
}

/// Stiffness of paint from the tube (chosen by eye).
fn tube_paint() -> f64 {
    0.7
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_tube_paint(stiffness: &f64) -> bool {
    *stiffness == tube_paint()
}

impl Default for Medium {
    /// A thin oil: 0.1 mm of white is translucent (S d = 5). Values chosen by eye.
    fn default() -> Self {
        Self {
            scattering_per_mm: 50.0,
            stiffness: tube_paint(),
            wet: Gloss { strength: 0.25, exponent: 60.0 },
            dry: Gloss { strength: 0.06, exponent: 20.0 },
        }
    }
}

impl Medium {
    /// Oil for the paint of `library`: its white hides from 0.05 mm on (see [`scattering_per_mm`]),
    /// or has the scattering of the default if the library has no white that hides.
    #[must_use]
    pub fn of(library: &PigmentLibrary) -> Self {
        let default = Self::default();
        let scattering_per_mm = scattering_per_mm(library).unwrap_or(default.scattering_per_mm);
        Self { scattering_per_mm, ..default }
    }
}

/// A painting at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Title of the painting.
    pub title: String,
    /// Width and height of a cell in mm.
    pub cell_mm: f64,
    /// Ground of the painting; its size is that of the canvas.
    pub ground: Ground,
    /// Pigments that the layers refer to.
    pub library: PigmentLibrary,
    /// Binder of the paint.
    pub medium: Medium,
    /// Dry layers, lowest first.
    pub dry: Vec<DryLayer>,
    /// Identity of the next dry layer, above those of all layers so far.
    pub next_layer: LayerId,
    /// Pigments of the wet layer.
    pub slots: Slots,
    /// Amounts of wet paint in every cell.
    pub wet: Layer,
    /// Light that the painting is viewed under.
    pub lighting: Lighting,
}

impl Document {
    /// A canvas without paint.
    #[must_use]
    pub fn bare(
        title: &str,
        cell_mm: f64,
        ground: Ground,
        library: PigmentLibrary,
        medium: Medium,
        slots: Slots,
        lighting: Lighting,
    ) -> Self {
        let wet = Layer::empty(ground.height.width(), ground.height.height());
        Self {
            title: title.to_owned(),
            cell_mm,
            ground,
            library,
            medium,
            dry: Vec::new(),
            next_layer: LayerId::FIRST,
            slots,
            wet,
            lighting,
        }
    }

    /// Whether this can be the palette of `canvas`: library, pigments, light, medium and width of
    /// a cell are the same.
    #[must_use]
    pub fn belongs_to(&self, canvas: &Self) -> bool {
        self.library == canvas.library
            && self.slots == canvas.slots
            && self.lighting == canvas.lighting
            && self.medium == canvas.medium
            && self.cell_mm == canvas.cell_mm
    }

    /// SHA-256 of the ground's heights and of all amounts of paint, wet and dry, as 64 hexadecimal digits. Two
    /// paintings with equal digests hold the same paint to the last quantum.
    #[must_use]
    pub fn digest_of_paint(&self) -> String {
        let mut digest = Sha256::new();
        for height in self.ground.height.values() {
            digest.update(height.to_le_bytes());
        }
        for layer in self.dry.iter().map(|dry| &dry.paint).chain([&self.wet]) {
            for (pigments, vehicle) in layer.pigments.values().iter().zip(layer.vehicle.values()) {
                for amount in pigments.iter().chain([vehicle]) {
                    digest.update(amount.to_le_bytes());
                }
            }
        }
        digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Adds a dry layer on top, with an identity of its own.
    pub fn push_dry(&mut self, slots: Slots, paint: Layer) {
        self.dry.push(DryLayer::new(self.next_layer, slots, paint));
        self.next_layer = self.next_layer.next();
    }
}
