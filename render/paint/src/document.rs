//! A painting at rest. Its [`Document`] holds everything that its file stores. You can also
//! describe a canvas, look up the pigments of a palette, and cut out a part of a painting as a
//! painting of its own.

use documents::hint::Explain;
use graphics::tile::Rect;
use pigment::palette::scattering_per_mm;
use pigment::{RecipeError, library::PigmentLibrary};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::ground::{Ground, GroundError, GroundSpec};
use crate::layer::{Layer, SLOTS};
use crate::optics::Gloss;

pub use crate::layer::{DryLayer, LayerId, Slots};

/// Light that a painting is viewed under.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lighting {
    /// Name of the illuminant, as [`spectra::light_from_text`] reads it (e.g. `D65`, `A`, `4000K`).
    pub illuminant: String,
    /// Name of the observer, as [`spectra::Observer::named`] reads it (e.g. `1931-2`).
    pub observer: String,
    /// Direction of the light, in degrees clockwise from the top of the canvas.
    pub azimuth_deg: f64,
    /// Elevation of the light above the canvas in degrees, above 0 and up to 90.
    pub elevation_deg: f64,
    /// Share of diffuse light from all sides, 0..1.
    pub ambient: f64,
    /// Factor on the heights of the relief: 0 flat, 1 physical.
    pub relief: f64,
    /// How far the eye adapts to the light, 0..1. At 1 white paint looks white under every light.
    /// At 0 you see the light's own colour beside D65. Files omit 1.
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
    /// S of the library's reference white per mm of height. We need this to convert heights to the
    /// library's thickness, which does not have a unit of its own.
    pub scattering_per_mm: f64,
    /// Stiffness of the wet paint: 0 is stand oil, which levels by itself, 1 is putty, which stays
    /// where you lay it. Files leave this out for tube paint.
    #[serde(default = "tube_paint", skip_serializing_if = "is_tube_paint")]
    pub stiffness: f64,
    /// Whether thin paint covers only a part of its cell, see [`covers`](crate::optics::covers): hair and
    /// knife leave little paint in furrows and crumbs. Set it to false for films that are even however thin they
    /// are. Files leave this out for false.
    #[serde(default, skip_serializing_if = "is_not")]
    pub films_break: bool,
    /// Gloss of wet paint.
    pub wet: Gloss,
    /// Gloss of dry paint.
    pub dry: Gloss,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_not(breaks: &bool) -> bool {
    !breaks
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
    /// A thin oil: for example, 0.1 mm of white is translucent (S d = 5). We chose the values by
    /// eye.
    fn default() -> Self {
        Self {
            scattering_per_mm: 50.0,
            stiffness: tube_paint(),
            films_break: true,
            wet: Gloss { strength: 0.25, exponent: 60.0 },
            dry: Gloss { strength: 0.06, exponent: 20.0 },
        }
    }
}

impl Medium {
    /// Oil in which the white of `library` hides the ground from a thickness of 0.05 mm on (see
    /// [`scattering_per_mm`]). If the library does not have a white that hides, you get the default
    /// scattering.
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
    /// Ground of the painting. It is as large as the canvas.
    pub ground: Ground,
    /// Pigments that the layers refer to.
    pub library: PigmentLibrary,
    /// Binder of the paint.
    pub medium: Medium,
    /// Dry layers, lowest first.
    pub dry: Vec<DryLayer>,
    /// Identity of the next dry layer. This is above the identities of all layers so far.
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

    /// Returns whether you can use this as the palette of `canvas`: library, pigments, light,
    /// medium and width of a cell must be equal.
    #[must_use]
    pub fn belongs_to(&self, canvas: &Self) -> bool {
        self.library == canvas.library
            && self.slots == canvas.slots
            && self.lighting == canvas.lighting
            && self.medium == canvas.medium
            && self.cell_mm == canvas.cell_mm
    }

    /// SHA-256 of the ground's heights and of all amounts of paint, wet and dry, as 64 hexadecimal
    /// digits. If the digests of two paintings are equal, you know that they hold equal paint to
    /// the last quantum.
    #[must_use]
    pub fn digest_of_paint(&self) -> String {
        let mut digest = Sha256::new();
        for height in self.ground.height.values() {
            digest.update(height.to_le_bytes());
        }
        let layers = self.dry.iter().map(|dry| &dry.paint).chain([&self.wet]);
        // A skin without paint leaves no trace, so that paintings without one keep their digest.
        let films = layers.flat_map(|layer| [Some(layer), layer.painted_skin()]);
        for layer in films.flatten() {
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

/// A canvas without paint: its size, its cells and its ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Canvas {
    /// Width in mm, 0.001 to 1e6.
    pub width_mm: f64,
    /// Height in mm, 0.001 to 1e6.
    pub height_mm: f64,
    /// Width and height of a cell in mm, 0.001 to 10. By default this is 0.1, or 254 cells to the
    /// inch.
    #[serde(default = "default_cell_mm")]
    pub cell_mm: f64,
    /// The ground. Primed linen by default.
    #[serde(default)]
    pub ground: GroundSpec,
}

impl Default for Canvas {
    /// Primed linen of 192 x 108 mm, which are 1920 x 1080 cells.
    fn default() -> Self {
        let cell_mm = default_cell_mm();
        Self { width_mm: 192.0, height_mm: 108.0, cell_mm, ground: GroundSpec::default() }
    }
}

impl Canvas {
    /// Columns and rows of cells: as many as cover the canvas, at least one each.
    #[must_use]
    pub fn cells(&self) -> (usize, usize) {
        let Self { width_mm, height_mm, cell_mm, .. } = *self;
        (covering_cells(width_mm, cell_mm), covering_cells(height_mm, cell_mm))
    }

    /// The ground of this canvas, with its reflectance on the grid of `library`.
    ///
    /// # Errors
    /// [`GroundError`] for a ground that cannot be made or whose picture cannot be read.
    pub fn ground(&self, library: &PigmentLibrary) -> Result<Ground, GroundError> {
        let (width, height) = self.cells();
        self.ground.build(width, height, self.cell_mm, library)
    }

    pub(crate) fn longer_side_mm(&self) -> f64 {
        self.width_mm.max(self.height_mm)
    }
}

pub(crate) fn covering_cells(side_mm: f64, cell_mm: f64) -> usize {
    // We treat a remainder below 1e-6 of a cell as a rounding error, so it does not add a cell.
    ((side_mm / cell_mm - 1e-6).ceil() as usize).max(1)
}

fn default_cell_mm() -> f64 {
    0.1
}

/// Looks up the pigments of these names (see [`PigmentLibrary::find`]) and returns them as the
/// slots of a palette, in their order.
///
/// # Errors
/// [`PaletteError`] for more than eight names, an unknown name, and a pigment named twice.
pub fn palette_slots(names: &[String], library: &PigmentLibrary) -> Result<Slots, PaletteError> {
    if names.len() > SLOTS {
        return Err(PaletteError::TooMany(names.len()));
    }
    let mut slots = Slots::default();
    for (slot, name) in names.iter().enumerate() {
        let pigment = library.find(name)?;
        if slots.contains(&Some(pigment)) {
            return Err(PaletteError::Repeated(name.clone()));
        }
        slots[slot] = Some(pigment);
    }
    Ok(slots)
}

/// The names do not make a palette.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum PaletteError {
    /// There are more pigments than slots.
    #[error("a palette has at most {SLOTS} pigments, found `{0}`")]
    #[hint("leave [palette] out to have the best eight chosen")]
    TooMany(usize),
    /// Two names mean the same pigment.
    #[error("a palette takes each pigment once, found `{0}` again")]
    #[hint("leave the second out")]
    Repeated(String),
    /// The library has none or several pigments of this name.
    #[error(transparent)]
    Pigment(#[from] RecipeError),
}

impl Document {
    /// Cuts out the cells in `rect` as a painting of their own. Ground, dry layers and wet paint
    /// stay as they are, to the quantum. Light, binder and pigments are the whole painting's.
    ///
    /// You can crop a painting, but not enlarge it. A file keeps the relief of a ground but not how
    /// we made it, so we cannot continue it beyond the edges.
    ///
    /// # Panics
    /// If `rect` is empty or reaches beyond the canvas.
    #[must_use]
    pub fn cropped(&self, rect: Rect) -> Self {
        assert!(rect.width > 0 && rect.height > 0, "a crop without cells");
        let dry = self.dry.iter().map(|layer| DryLayer {
            id: layer.id,
            name: layer.name.clone(),
            visible: layer.visible,
            slots: layer.slots,
            opacity: layer.opacity,
            paint: layer.paint.part(rect),
        });
        let mut ground = self.ground.clone();
        ground.height = ground.height.part(rect);
        Self {
            title: self.title.clone(),
            cell_mm: self.cell_mm,
            ground,
            library: self.library.clone(),
            medium: self.medium.clone(),
            dry: dry.collect(),
            next_layer: self.next_layer,
            slots: self.slots,
            wet: self.wet.part(rect),
            lighting: self.lighting.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::GroundSpec;
    use crate::layer::{Cell, Layer};
    use crate::strokes::{Canvas, PaletteSpec, StrokeScript};
    use pigment::library::PigmentLibrary;

    /// A painting of 8 x 6 cells, with the number of each cell as its paint.
    fn numbered() -> Document {
        let library = PigmentLibrary::van_gogh_oils();
        let canvas =
            Canvas { width_mm: 4.0, height_mm: 3.0, cell_mm: 0.5, ground: GroundSpec::default() };
        let palette = PaletteSpec::from_names(["Zinc White", "Vermilion"]);
        let script = StrokeScript::new("numbered", "", canvas, palette);
        let (mut document, _) = script.surfaces(&library, None).unwrap();
        let mut paint = Layer::empty(8, 6);
        for index in 0..48 {
            let mut cell = Cell { vehicle: 7, ..Cell::default() };
            cell.pigments[1] = 100 + index as u32;
            paint.set_cell(index, cell);
        }
        let slots = document.slots;
        document.push_dry(slots, paint.clone());
        document.dry[0].opacity = 0.5;
        document.wet = paint;
        document
    }

    #[test]
    fn a_crop_keeps_the_paint_and_the_ground_of_its_cells() {
        let whole = numbered();
        let part = whole.cropped(Rect { x: 2, y: 1, width: 3, height: 4 });
        assert_eq!((part.wet.width(), part.wet.height()), (3, 4));
        for (x, y) in [(0, 0), (2, 3), (1, 2)] {
            let own = y * 3 + x;
            let there = (y + 1) * 8 + x + 2;
            assert_eq!(part.wet.cell(own), whole.wet.cell(there), "wet paint at {x}, {y}");
            assert_eq!(part.dry[0].paint.cell(own), whole.dry[0].paint.cell(there));
            assert_eq!(part.ground.height[(x, y)], whole.ground.height[(x + 2, y + 1)]);
        }
        assert_eq!(part.dry[0].opacity, 0.5);
        assert_eq!(part.lighting, whole.lighting);
        let all = Rect { x: 0, y: 0, width: 8, height: 6 };
        assert_eq!(whole.cropped(all), whole, "the whole is itself");
    }

    #[test]
    fn a_cropped_painting_survives_its_file() {
        let part = numbered().cropped(Rect { x: 5, y: 2, width: 2, height: 3 });
        let file = crate::file::write(&part).unwrap();
        assert_eq!(crate::file::read("part", &file).unwrap(), part);
    }
}
