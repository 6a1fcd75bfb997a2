//! Viewing of a painting at rest. You get the parameters of its [`Scene`], its picture without a
//! paint engine, and the exact spectrum of every cell.
//!
//! We compute pictures on all cores, with one pixel per cell or several. The reflectance by
//! wavelength is in f64. We check the engine's eight wavelengths against this, and spectral files
//! and the eyedropper read it.

use documents::hint::Explain;
use graphics::field::Field;
use pigment::quadrature::EffectiveQuadrature;
use pigment::thin_films::least_films;
use pigment::{PigmentId, library::PigmentLibrary};
use rayon::prelude::*;
use spectra::optics::{Layer as Film, Surface};

use crate::composite::composite_layer_row;
use crate::document::{Document, Lighting, Medium, Slots};
use crate::ground::Ground;
use crate::layer::{Cell, Layer, SLOTS};
use crate::light::Light;
use crate::optics::{
    Lamp, LayerOptics, NODES, Scene, at_nodes, covers, layer_optics, scene_surface,
    thickness_per_quantum,
};
use crate::shade::{TopMaterial, Tops, color_row, relieve_row, shade_row};

/// Least elevation of the light in degrees. Colours are relative to the light on a level surface,
/// and at elevation 0 this light is 0.
const LOWEST_DEG: f64 = 1.0;

/// Everything except the paint itself that decides how a painting looks.
#[derive(Debug, Clone, Copy)]
pub struct Appearance<'a> {
    /// Library that the slots refer to.
    pub library: &'a PigmentLibrary,
    /// Binder of the paint.
    pub medium: &'a Medium,
    /// Ground of the painting.
    pub ground: &'a Ground,
    /// Width and height of a cell in mm.
    pub cell_mm: f64,
    /// Pigments and opacity of the dry layers, lowest first.
    pub dry: &'a [(Slots, f64)],
    /// Pigments of the wet layer.
    pub slots: &'a Slots,
    /// Direction and kind of the light.
    pub lighting: &'a Lighting,
}

/// Parameters that convert the paint of `document` to linear sRGB under `light`.
///
/// You must have made `light` for the document's library. We treat a ground darker than its surface
/// reflection as black.
#[must_use]
pub fn scene(document: &Document, light: &Light) -> Scene {
    let dry: Vec<_> =
        document.dry.iter().map(|layer| (layer.slots, layer.shown_opacity())).collect();
    Appearance::of(document, &dry).scene(light)
}

impl<'a> Appearance<'a> {
    /// Appearance of a document. `dry` holds the pigments and opacities of its dry layers.
    pub(crate) fn of(document: &'a Document, dry: &'a [(Slots, f64)]) -> Self {
        let Document { library, medium, ground, cell_mm, slots, lighting, .. } = document;
        Self { library, medium, ground, cell_mm: *cell_mm, dry, slots, lighting }
    }

    /// Shares of a cell that a quantum of each slot and of vehicle covers, see [`covers`].
    fn covers(&self, slots: &Slots, least_films: &[f64]) -> [f64; SLOTS + 1] {
        let Self { medium, cell_mm, .. } = *self;
        if !medium.films_break {
            return [1.0; SLOTS + 1];
        }
        let thickness = thickness_per_quantum(cell_mm, medium.scattering_per_mm);
        covers(slots, least_films, thickness, cell_mm)
    }

    /// Parameters that convert paint to linear sRGB under `light`, see [`scene`].
    #[must_use]
    pub fn scene(&self, light: &Light) -> Scene {
        let Self { library, medium, ground, lighting, .. } = *self;
        let thickness = thickness_per_quantum(self.cell_mm, medium.scattering_per_mm);
        let optics = |slots: &Slots, opacity: f64| LayerOptics {
            covers: self.covers(slots, &light.least_films).map(|share| share as f32),
            ..layer_optics(slots, &light.quadrature, thickness, opacity)
        };
        let below = internal_ground(library, &ground.reflectance);
        Scene {
            ground: at_nodes(&light.quadrature.rule, library.grid, &below, 1.0),
            dry: self.dry.iter().map(|(slots, opacity)| optics(slots, *opacity)).collect(),
            wet: optics(self.slots, 1.0),
            surface: scene_surface(&library.saunderson),
            rgb_from_nodes: light.rgb_at_degree(lighting.adaptation),
            lamp: Lamp {
                direction: direction(lighting),
                relief: lighting.relief as f32,
                ambient: lighting.ambient as f32,
                wet: medium.wet,
                dry: medium.dry,
                ground: ground.gloss,
            },
            cell_mm: self.cell_mm as f32,
        }
    }
}

fn internal_ground(library: &PigmentLibrary, reflectance: &[f64]) -> Vec<f64> {
    reflectance
        .iter()
        .map(|&measured: &f64| {
            library.saunderson.internal_from_measured(measured).unwrap_or(0.0).min(1.0)
        })
        .collect()
}

/// Unit vector towards the light: x right, y down, z towards the viewer.
fn direction(lighting: &Lighting) -> [f32; 3] {
    let azimuth = lighting.azimuth_deg.to_radians();
    let elevation = lighting.elevation_deg.clamp(LOWEST_DEG, 90.0).to_radians();
    let level = elevation.cos();
    [azimuth.sin() * level, -azimuth.cos() * level, elevation.sin()].map(|v| v as f32)
}

/// Picture of a document in linear sRGB, white at 1. The fourth value is 1. This equals the picture
/// of a paint engine. It takes 20 bytes per cell beside the document.
///
/// You must have made `scene` for `document`.
#[must_use]
pub fn picture(document: &Document, scene: &Scene) -> Field<[f32; 4]> {
    picture_of_lowest(document, scene, ALL)
}

/// Picture of a document like [`picture`], but only with its lowest `layers`, dry ones first. Use
/// this to see how it would look without the others. If you pass 0, you get the ground.
#[must_use]
pub fn picture_of_lowest(document: &Document, scene: &Scene, layers: usize) -> Field<[f32; 4]> {
    let width = document.wet.width();
    let tops = tops(document, layers);
    let mut picture = Field::filled(width, document.wet.height(), [0.0; 4]);
    if width == 0 {
        return picture;
    }
    picture.values_mut().par_chunks_mut(width).enumerate().for_each_init(
        || (vec![scene.ground; width], vec![TopMaterial::Ground; width]),
        |(internal, materials), (y, out)| {
            lay_row((document, layers), scene, y, internal, materials);
            shade_row(scene, (&tops, (0, y)), internal, materials, out);
        },
    );
    picture
}

/// Number of layers that stands for all of them.
const ALL: usize = usize::MAX;

/// Computes the internal reflectance and the topmost material of every cell of row `y` of the
/// lowest `layers`.
fn lay_row(
    (document, layers): (&Document, usize),
    scene: &Scene,
    y: usize,
    internal: &mut [[f32; NODES]],
    materials: &mut [TopMaterial],
) {
    internal.fill(scene.ground);
    materials.fill(TopMaterial::Ground);
    let dry = document.dry.iter().map(|layer| &layer.paint).zip(&scene.dry);
    let wet = std::iter::once((&document.wet, &scene.wet));
    let dry = dry.map(|layer| (TopMaterial::Dry, layer));
    let wet = wet.map(|layer| (TopMaterial::Wet, layer));
    for (material, (layer, optics)) in dry.chain(wet).take(layers) {
        composite_layer_row(optics, layer, (0, y), internal);
        mark(layer, y, material, materials);
    }
}

/// Sets `materials` to `material` in each cell of row `y` where `layer` has paint.
fn mark(layer: &Layer, y: usize, material: TopMaterial, materials: &mut [TopMaterial]) {
    let first = y * layer.width();
    for (i, top) in materials.iter_mut().enumerate() {
        if layer.cell(first + i).volume() > 0 {
            *top = material;
        }
    }
}

/// Height of the surface of the lowest `layers` at every cell.
fn tops(document: &Document, layers: usize) -> Tops {
    let ground = &document.ground.height;
    let all = document.dry.iter().map(|layer| &layer.paint).chain([&document.wet]);
    let layers: Vec<_> = all.take(layers).collect();
    let mut tops = Tops::level(ground.width(), ground.height());
    tops.set_all(|x, y| {
        let index = y * ground.width() + x;
        let volumes = layers.iter().map(|layer| layer.cell(index).volume());
        volumes.fold(ground.values()[index], i32::saturating_add_unsigned)
    });
    tops
}

/// Pixels of a picture along a cell's width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelsPerCell(u8);

/// A number of pixels along a cell is out of range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error, Explain)]
#[error("a cell has 1 to {} pixels along its width, found `{found}`", PixelsPerCell::MOST)]
#[hint("2 hides the cells on most screens")]
#[fault(Setting)]
pub struct PixelsPerCellError {
    /// The number that was asked for.
    pub found: u8,
}

impl Default for PixelsPerCell {
    /// One pixel a cell.
    fn default() -> Self {
        Self(1)
    }
}

impl PixelsPerCell {
    /// Most pixels along a cell's width.
    pub const MOST: u8 = 4;

    /// Checks a number of pixels along a cell's width, 1 to [`PixelsPerCell::MOST`].
    ///
    /// # Errors
    /// [`PixelsPerCellError`] outside that range.
    pub fn new(count: u8) -> Result<Self, PixelsPerCellError> {
        match (1..=Self::MOST).contains(&count) {
            true => Ok(Self(count)),
            false => Err(PixelsPerCellError { found: count }),
        }
    }

    /// Number of pixels along a cell's width.
    #[must_use]
    pub fn count(self) -> usize {
        usize::from(self.0)
    }
}

/// Picture of a document in linear sRGB, white at 1, like [`picture`] but with `pixels` along the
/// width and the height of every cell. Between the centres of cells, we interpolate heights and the
/// light of level paint by Mitchell and Netravali's (1988) bicubic filter. We shade relief and
/// gloss at this finer grid. Even paint has its exact colour. This takes 21 bytes per cell and 20
/// bytes per pixel beside the document.
///
/// You must have made `scene` for `document`.
#[must_use]
pub fn fine_picture(document: &Document, scene: &Scene, pixels: PixelsPerCell) -> Field<[f32; 4]> {
    let count = pixels.count();
    let cells = Cells::of(document, scene);
    let width = document.wet.width() * count;
    let height = document.wet.height() * count;
    let mut picture = Field::filled(width, height, [0.0; 4]);
    if picture.values().is_empty() {
        return picture;
    }
    let between = Between::new(pixels, document.wet.width(), document.wet.height());
    let coarse = tops(document, ALL);
    let mut fine = Tops::level(width, height);
    fine.set_all(|x, y| {
        let from = f64::from(coarse.at(between.cell(x, y)));
        let mut more = 0.0;
        between.around(x, y, |weight, cell| {
            more += f64::from(weight) * (f64::from(coarse.at(cell)) - from);
        });
        (from + more).round() as i32
    });
    // Heights are in widths of a cell, so on this finer grid they count more.
    let relief = scene.lamp.relief * count as f32;
    let lamp = Lamp { relief, ..scene.lamp };
    let scene = Scene { lamp, cell_mm: scene.cell_mm / count as f32, ..scene.clone() };
    picture.values_mut().par_chunks_mut(width).enumerate().for_each_init(
        || vec![TopMaterial::Ground; width],
        |materials, (y, out)| {
            for (x, (out, material)) in out.iter_mut().zip(&mut *materials).enumerate() {
                (*out, *material) = cells.between(&between, x, y);
            }
            relieve_row(&scene, (&fine, (0, y)), materials, out);
        },
    );
    picture
}

/// Light of level paint and topmost material of every cell.
struct Cells {
    /// Linear sRGB without relief and gloss.
    colors: Field<[f32; 4]>,
    materials: Field<TopMaterial>,
}

impl Cells {
    fn of(document: &Document, scene: &Scene) -> Self {
        let width = document.wet.width();
        let height = document.wet.height();
        let mut colors = Field::filled(width, height, [0.0; 4]);
        let mut materials = Field::filled(width, height, TopMaterial::Ground);
        if width > 0 {
            let rows = colors.values_mut().par_chunks_mut(width);
            let rows = rows.zip(materials.values_mut().par_chunks_mut(width)).enumerate();
            rows.for_each_init(
                || vec![scene.ground; width],
                |internal, (y, (colors, materials))| {
                    lay_row((document, ALL), scene, y, internal, materials);
                    color_row(scene, internal, colors);
                },
            );
        }
        Self { colors, materials }
    }

    /// Colour and topmost material of a pixel. We choose the material that covers most of it.
    fn between(&self, between: &Between, x: usize, y: usize) -> ([f32; 4], TopMaterial) {
        let from = self.colors[between.cell(x, y)];
        let mut more = [0.0; 4];
        let mut shares = [0.0f32; 3];
        between.around(x, y, |weight, cell| {
            let there = &self.colors[cell];
            for i in 0..4 {
                more[i] += weight * (there[i] - from[i]);
            }
            shares[self.materials[cell] as usize] += weight;
        });
        let [wet, dry, ground] = shares;
        let material = match wet.max(dry) >= ground {
            true if wet >= dry => TopMaterial::Wet,
            true => TopMaterial::Dry,
            false => TopMaterial::Ground,
        };
        (std::array::from_fn(|i| from[i] + more[i]), material)
    }
}

/// Weights of the cells around the pixels of a finer grid.
struct Between {
    /// For each pixel along a cell, the weights of the cells at -2 to 2 from its own.
    weights: Vec<[f32; 5]>,
    width: usize,
    height: usize,
}

impl Between {
    fn new(pixels: PixelsPerCell, width: usize, height: usize) -> Self {
        let count = pixels.count();
        let weights = (0..count).map(|pixel| {
            let from_center = (pixel as f32 + 0.5) / count as f32 - 0.5;
            std::array::from_fn(|cell| mitchell(cell as f32 - 2.0 - from_center))
        });
        Self { weights: weights.collect(), width, height }
    }

    fn cell(&self, x: usize, y: usize) -> (usize, usize) {
        (x / self.weights.len(), y / self.weights.len())
    }

    /// Calls `add` with the weight of each cell around a pixel. The weights sum to 1. Beyond the
    /// edges of the canvas we repeat its last cells.
    fn around(&self, x: usize, y: usize, mut add: impl FnMut(f32, (usize, usize))) {
        let count = self.weights.len();
        let across = &self.weights[x % count];
        let down = &self.weights[y % count];
        let (x, y) = self.cell(x, y);
        for (j, down) in down.iter().enumerate() {
            let row = (y + j).saturating_sub(2).min(self.height - 1);
            for (i, across) in across.iter().enumerate() {
                add(across * down, ((x + i).saturating_sub(2).min(self.width - 1), row));
            }
        }
    }
}

/// The cubic filter of Mitchell and Netravali (1988) with B = C = 1/3, at a distance in cells.
fn mitchell(distance: f32) -> f32 {
    let d = distance.abs();
    let sixfold = match d {
        ..1.0 => (7.0 * d - 12.0) * d * d + 16.0 / 3.0,
        1.0..2.0 => ((-7.0 / 3.0 * d + 12.0) * d - 20.0) * d + 32.0 / 3.0,
        _ => 0.0,
    };
    sixfold / 6.0
}

/// Optics of a stack of layers over a ground, by wavelength, without relief and gloss.
#[derive(Debug, Clone)]
pub struct SpectralStack {
    surface: Surface,
    /// Internal reflectance of the ground, by wavelength.
    ground: Vec<f64>,
    /// K and S of the layers, lowest first, the wet layer last.
    optics: Vec<Optics>,
    /// Shares of a cell that a quantum of each slot and of vehicle covers, by layer.
    covers: Vec<[f64; SLOTS + 1]>,
}

/// K and S per quantum, by wavelength and slot.
type Optics = Vec<[[f64; 2]; SLOTS]>;

impl SpectralStack {
    /// The stack at all wavelengths of the library.
    #[must_use]
    pub fn full(appearance: &Appearance<'_>) -> Self {
        let library = appearance.library;
        Self::new(
            appearance,
            |ground| ground,
            |pigment| [&library[pigment].absorption, &library[pigment].scattering],
        )
    }

    fn at_nodes(appearance: &Appearance<'_>, quadrature: &EffectiveQuadrature) -> Self {
        let grid = appearance.library.grid;
        Self::new(
            appearance,
            |ground| quadrature.rule.at_nodes(grid, &ground),
            |pigment| {
                [&quadrature.absorption, &quadrature.scattering]
                    .map(|curves| &curves[pigment.index()])
            },
        )
    }

    fn new<'a>(
        appearance: &Appearance<'_>,
        ground_at: impl Fn(Vec<f64>) -> Vec<f64>,
        curves: impl Fn(PigmentId) -> [&'a Vec<f64>; 2],
    ) -> Self {
        let Appearance { library, medium, cell_mm, .. } = *appearance;
        let thickness = thickness_per_quantum(cell_mm, medium.scattering_per_mm);
        let ground = ground_at(internal_ground(library, &appearance.ground.reflectance));
        let layers = appearance.dry.iter().map(|(slots, opacity)| (slots, *opacity));
        let optics = layers.chain([(appearance.slots, 1.0)]).map(|(slots, opacity)| {
            let mut optics = vec![[[0.0; 2]; SLOTS]; ground.len()];
            for (slot, pigment) in slots.iter().enumerate() {
                let Some(pigment) = *pigment else { continue };
                let [absorption, scattering] = curves(pigment);
                let both = absorption.iter().zip(scattering);
                for (optics, (&k, &s)) in optics.iter_mut().zip(both) {
                    optics[slot] = [k, s].map(|v| v * thickness * opacity);
                }
            }
            optics
        });
        let optics = optics.collect();
        let least_films = least_films(library);
        let slots = appearance.dry.iter().map(|(slots, _)| slots).chain([appearance.slots]);
        let covers = slots.map(|slots| appearance.covers(slots, &least_films)).collect();
        Self { surface: library.saunderson, ground, optics, covers }
    }

    /// Number of wavelengths.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ground.len()
    }

    /// Measured reflectance (0..1) by wavelength of a column of paint, given the quanta of
    /// each pigment in the body and the skin of each layer, lowest first.
    pub fn measured_reflectance(&self, layers: impl IntoIterator<Item = [Cell; 2]>) -> Vec<f64> {
        let mut internal = self.ground.clone();
        for ((films, optics), covers) in layers.into_iter().zip(&self.optics).zip(&self.covers) {
            for (film, share) in films.iter().zip(covered_shares(&films, covers)) {
                for (reflectance, optics) in internal.iter_mut().zip(optics) {
                    let [k, s] = optical_thickness(film, optics);
                    let covered = Film::new(k / share, s / share, 1.0).over(*reflectance);
                    *reflectance += share * (covered - *reflectance);
                }
            }
        }
        internal.into_iter().map(|r| self.surface.measured_from_internal(r)).collect()
    }

    /// Share of the ground, then of the body and the skin of each layer, in what you see of a column
    /// of paint: sum 1.
    ///
    /// At each wavelength, a film hides a part of the contrast between a white and a black below
    /// it. This part is the film's share. All wavelengths count alike. We leave the rest to the
    /// films below.
    pub fn seen(&self, layers: impl IntoIterator<Item = [Cell; 2]>) -> Vec<f64> {
        let layers: Vec<[Cell; 2]> = layers.into_iter().collect();
        let mut parts = vec![0.0; 2 * layers.len() + 1];
        let mut rest = vec![1.0; self.count()];
        for (index, films) in layers.iter().enumerate().rev() {
            let shares = covered_shares(films, &self.covers[index]);
            for ((film, share), place) in films.iter().zip(shares).zip([1, 2]).rev() {
                for (rest, optics) in rest.iter_mut().zip(&self.optics[index]) {
                    let [k, s] = optical_thickness(film, optics);
                    let film = Film::new(k / share, s / share, 1.0);
                    let passed = (film.over(1.0) - film.over(0.0)).clamp(0.0, 1.0);
                    let hidden = *rest * share * (1.0 - passed);
                    parts[2 * index + place] += hidden;
                    *rest -= hidden;
                }
            }
        }
        parts[0] = rest.iter().sum();
        let count = self.count().max(1) as f64;
        parts.into_iter().map(|part| part / count).collect()
    }
}

/// Parts of a cell that body and skin cover, above 0 to 1; see [`crate::composite`].
fn covered_shares(films: &[Cell; 2], covers: &[f64; SLOTS + 1]) -> [f64; 2] {
    let [body, skin] = films.map(|film| -> f64 {
        let amounts = film.pigments.into_iter().chain([film.vehicle]);
        amounts.zip(covers).map(|(amount, share)| f64::from(amount) * share).sum()
    });
    [body, body + skin].map(|covered| if covered > 0.0 { covered.min(1.0) } else { 1.0 })
}

/// K d and S d of a film at one wavelength.
fn optical_thickness(film: &Cell, optics: &[[f64; 2]; SLOTS]) -> [f64; 2] {
    let pairs = film.pigments.iter().zip(optics);
    pairs.fold([0.0; 2], |[k, s], (&amount, optics)| {
        [k + f64::from(amount) * optics[0], s + f64::from(amount) * optics[1]]
    })
}

/// Tells you which paint you see at a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenPaint {
    /// Part of the ground, 0 where the paint hides it.
    pub ground: f64,
    /// Part of each layer, lowest first, the wet layer last. With the ground they sum to 1.
    pub layers: Vec<f64>,
    /// Part of each pigment of the library. With the ground they sum to 1.
    pub pigments: Vec<f64>,
}

/// A document whose reflectance can be computed cell by cell.
#[derive(Debug, Clone)]
pub struct SpectralDocument<'a> {
    document: &'a Document,
    stack: SpectralStack,
    layers: Vec<&'a Layer>,
}

impl<'a> SpectralDocument<'a> {
    /// Reflectance at all wavelengths of the document's library.
    #[must_use]
    pub fn full(document: &'a Document) -> Self {
        Self::new(document, SpectralStack::full)
    }

    /// Reflectance at the nodes of `quadrature`, as we compute pictures. K and S at a node may
    /// stand for a band of wavelengths. Then the reflectance at the node itself is only
    /// approximate, but you get the colour of the whole spectrum.
    #[must_use]
    pub fn at_nodes(document: &'a Document, quadrature: &EffectiveQuadrature) -> Self {
        Self::new(document, |appearance| SpectralStack::at_nodes(appearance, quadrature))
    }

    fn new(document: &'a Document, stack: impl Fn(&Appearance<'_>) -> SpectralStack) -> Self {
        let dry: Vec<_> =
            document.dry.iter().map(|layer| (layer.slots, layer.shown_opacity())).collect();
        let stack = stack(&Appearance::of(document, &dry));
        let layers = document.dry.iter().map(|layer| &layer.paint).chain([&document.wet]);
        Self { document, stack, layers: layers.collect() }
    }

    /// Number of wavelengths.
    #[must_use]
    pub fn count(&self) -> usize {
        self.stack.count()
    }

    /// Measured reflectance (0..1) by wavelength of the cell in column `x` and row `y`.
    #[must_use]
    pub fn measured_reflectance(&self, x: usize, y: usize) -> Vec<f64> {
        self.stack.measured_reflectance(self.films_at(x, y))
    }

    /// Paint that you see at the cell in column `x` and row `y`: each layer by how much it hides of
    /// the layers below (see [`SpectralStack::seen`]), each pigment by its part of the layer's
    /// paint, by volume.
    #[must_use]
    pub fn seen(&self, x: usize, y: usize) -> SeenPaint {
        let parts = self.stack.seen(self.films_at(x, y));
        let mut pigments = vec![0.0; self.document.library.pigments.len()];
        let dry = self.document.dry.iter().map(|layer| &layer.slots);
        let slots = dry.chain([&self.document.slots]);
        let films = self.films_at(x, y).zip(slots);
        let films = films.flat_map(|(films, slots)| films.map(|film| (film.pigments, slots)));
        for ((amounts, slots), part) in films.zip(&parts[1..]) {
            let all: f64 = amounts.iter().map(|&amount| f64::from(amount)).sum();
            for (amount, pigment) in amounts.iter().zip(slots) {
                if let Some(pigment) = pigment
                    && *amount > 0
                {
                    pigments[pigment.index()] += part * f64::from(*amount) / all;
                }
            }
        }
        let layers = parts[1..].chunks(2).map(|films| films.iter().sum()).collect();
        SeenPaint { ground: parts[0], layers, pigments }
    }

    /// Body and skin of each layer at the cell in column `x` and row `y`, lowest first.
    fn films_at(&self, x: usize, y: usize) -> impl Iterator<Item = [Cell; 2]> {
        let index = y * self.document.wet.width() + x;
        self.layers.iter().map(move |layer| layer.films(index))
    }

    /// Measured reflectance of all cells as 32-bit planes, one per wavelength. We compute rows on
    /// all CPU cores. After each row this calls `go_on` with the number of rows done. If `go_on`
    /// returns `false`, you get `None`.
    pub fn planes(&self, mut go_on: impl FnMut(usize) -> bool) -> Option<Vec<Field<f32>>> {
        let width = self.document.wet.width();
        let height = self.document.wet.height();
        let mut planes = vec![Field::filled(width, height, 0.0); self.count()];
        for y in 0..height {
            let columns = (0..width).into_par_iter();
            let row: Vec<Vec<f64>> = columns.map(|x| self.measured_reflectance(x, y)).collect();
            for (x, spectrum) in row.into_iter().enumerate() {
                for (plane, value) in planes.iter_mut().zip(spectrum) {
                    plane[(x, y)] = value as f32;
                }
            }
            if !go_on(y + 1) {
                return None;
            }
        }
        Some(planes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuth_runs_clockwise_from_the_top() {
        for (azimuth_deg, elevation_deg, wanted) in [
            (0.0, 45.0, [0.0, -0.5f32.sqrt(), 0.5f32.sqrt()]),
            (90.0, 45.0, [0.5f32.sqrt(), 0.0, 0.5f32.sqrt()]),
            (315.0, 90.0, [0.0, 0.0, 1.0]),
        ] {
            let lighting = Lighting { azimuth_deg, elevation_deg, ..Lighting::default() };
            for (found, wanted) in direction(&lighting).iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-6, "{azimuth_deg} {elevation_deg}: {found}");
            }
        }
        let level = Lighting { azimuth_deg: 0.0, elevation_deg: 0.0, ..Lighting::default() };
        assert!(direction(&level)[2] > 0.01, "a lamp at the horizon stays above it");
    }

    #[test]
    fn weights_sum_to_one_and_are_those_of_a_mirrored_cell() {
        for count in 1..=PixelsPerCell::MOST {
            let between = Between::new(PixelsPerCell::new(count).unwrap(), 9, 9);
            for (weights, mirrored) in between.weights.iter().zip(between.weights.iter().rev()) {
                assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{weights:?}");
                for (weight, mirrored) in weights.iter().zip(mirrored.iter().rev()) {
                    assert!((weight - mirrored).abs() < 1e-6, "{weights:?}");
                }
            }
        }
        for found in [0, 5] {
            assert_eq!(PixelsPerCell::new(found), Err(PixelsPerCellError { found }));
        }
    }
}
