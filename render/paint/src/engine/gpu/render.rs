//! Rendering on the device: we bake dry layers, composite the wet layer over them and shade the
//! result.
//!
//! These are twins of [`crate::composite`] and [`crate::shade`] in f32. Tests state how close the
//! two backends agree. Shading reads the heights of the surface around every cell. We compute them
//! again only where the paint changed, and use them for all views.

use graphics::gpu::{Buffer, Device, DeviceError, Kernel, Layout, Recording, Storage, layout};
use graphics::tile::{Rect, TILE, TileSet};

use super::buffers::PaintBuffers;
use crate::layer::SLOTS;
use crate::optics::{Gloss, NODES, Scene};
use crate::shade::{MOST, ReliefLamp, SOFT, Tap};

/// Number of cells that an invocation of [`BAKE`] or [`SHOW`] computes.
const CELLS_AT_ONCE: u32 = 4;

/// Maximum number of tiles in one dispatch: the WebGPU limit of workgroups along an
/// axis.
pub(super) const MAX_TILES: usize = 65535;

/// [`crate::optics::LayerOptics`] as a uniform.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct LayerOptics {
    absorption: [[f32; NODES]; SLOTS],
    scattering: [[f32; NODES]; SLOTS],
    /// Eight slots, then vehicle, then zeros that fill the last vector of four.
    covers: [f32; 12],
}

/// Uniforms of [`PRIME`] and [`BAKE`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct BakeParams {
    layer: LayerOptics,
    /// Internal reflectance of the ground.
    ground: [f32; NODES],
    canvas: [u32; 2],
    first_tile: u32,
    /// Index of the film's first cell in its buffer.
    first_cell: u32,
}

/// Saunderson's shares of the surface between paint and air.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct SurfaceParams {
    k1: f32,
    k2: f32,
    specular: f32,
    /// 0 to skip relief and gloss.
    relief_on: u32,
}

/// [`ReliefLamp`] as a uniform.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct LampParams {
    towards_lamp: [f32; 2],
    ambient: f32,
    slope: f32,
    halfway: [f32; 4],
    gloss: [[f32; 4]; 3],
    shadow: [[f32; 4]; 6],
    around: [[f32; 4]; 8],
    soft: f32,
    most: f32,
    padding: [f32; 2],
}

/// Uniforms of [`SHOW`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ShowParams {
    layer: LayerOptics,
    rgb_from_nodes: [[f32; 4]; NODES],
    surface: SurfaceParams,
    lamp: LampParams,
    canvas: [u32; 2],
    first_tile: u32,
    /// 1 if a cell of the wet layer may have a skin.
    skin: u32,
}

const LAYER_OPTICS: Layout = layout!(LayerOptics { absorption, scattering, covers });

const BAKE_SOURCE: &str = concat!(
    include_str!("../../amount.wgsl"),
    include_str!("../../layer.wgsl"),
    include_str!("../../composite.wgsl"),
    include_str!("passes/bake_tiles.wgsl"),
);

const BAKE_PARAMS: Layout = layout!(BakeParams { layer, ground, canvas, first_tile, first_cell });

const BAKE_STORAGE: &[Storage] =
    &[Storage::Batch, Storage::Read, Storage::Read, Storage::Write, Storage::Write];

/// Sets tiles to the reflectance of the bare ground.
pub(super) static PRIME: Kernel = Kernel {
    name: "prime_tiles",
    source: BAKE_SOURCE,
    parameters: BAKE_PARAMS,
    structs: &[LAYER_OPTICS],
    storage: BAKE_STORAGE,
};

/// Composites one dry layer over the baked reflectance.
pub(super) static BAKE: Kernel = Kernel {
    name: "bake_tiles",
    source: BAKE_SOURCE,
    parameters: BAKE_PARAMS,
    structs: &[LAYER_OPTICS],
    storage: BAKE_STORAGE,
};

/// Composites the wet layer over the baked reflectance and shades it.
pub(super) static SHOW: Kernel = Kernel {
    name: "show_tiles",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("../../composite.wgsl"),
        include_str!("../../shade.wgsl"),
        include_str!("passes/show_tiles.wgsl"),
    ),
    parameters: layout!(ShowParams {
        layer,
        rgb_from_nodes,
        surface,
        lamp,
        canvas,
        first_tile,
        skin
    }),
    structs: &[
        LAYER_OPTICS,
        layout!(SurfaceParams { k1, k2, specular, relief_on }),
        layout!(LampParams {
            towards_lamp,
            ambient,
            slope,
            halfway,
            gloss,
            shadow,
            around,
            soft,
            most,
            padding
        }),
    ],
    storage: &[
        Storage::Batch,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
    ],
};

/// The layers of the canvas, as rendering reads them.
#[derive(Debug, Clone, Copy)]
pub(super) struct CanvasBuffers<'a> {
    pub(super) size: [u32; 2],
    pub(super) wet: &'a PaintBuffers,
    /// Height of the surface of each cell in quanta.
    pub(super) surface_heights: &'a Buffer,
    pub(super) dry: &'a [PaintBuffers],
    /// Whether a cell of the wet layer may have a skin.
    pub(super) has_skin: bool,
}

/// The buffers of one view. You can clone the handles cheaply.
#[derive(Debug, Clone)]
pub(super) struct ViewBuffers {
    /// Internal reflectance of ground and dry layers at the eight wavelengths.
    baked: Buffer,
    /// Material below the wet paint: 1 dry paint, 2 bare ground.
    material: Buffer,
    /// Linear sRGB, with 1 as the fourth component.
    pub(super) picture: Buffer,
}

impl From<&crate::optics::LayerOptics> for LayerOptics {
    fn from(layer: &crate::optics::LayerOptics) -> Self {
        let mut covers = [0.0; 12];
        covers[..layer.covers.len()].copy_from_slice(&layer.covers);
        Self { absorption: layer.absorption, scattering: layer.scattering, covers }
    }
}

impl From<ReliefLamp> for LampParams {
    fn from(lamp: ReliefLamp) -> Self {
        let [x, y, z] = lamp.halfway;
        Self {
            towards_lamp: lamp.towards_lamp,
            ambient: lamp.ambient,
            slope: lamp.slope,
            halfway: [x, y, z, 0.0],
            gloss: lamp.gloss.map(gloss_uniform),
            shadow: lamp.shadow.map(tap_uniform),
            around: lamp.around.map(tap_uniform),
            soft: SOFT,
            most: MOST,
            padding: [0.0; 2],
        }
    }
}

fn gloss_uniform((Gloss { strength, exponent }, level): (Gloss, f32)) -> [f32; 4] {
    [strength, exponent, level, 0.0]
}

fn tap_uniform(tap: Tap) -> [f32; 4] {
    let [x, y] = tap.offset.map(|cells| cells as f32);
    [x, y, tap.per_quantum, tap.less]
}

impl ViewBuffers {
    /// Allocates a black picture of `cells` cells.
    pub(super) fn new(device: &Device, cells: usize) -> Result<Self, DeviceError> {
        let cells = cells as u64;
        Ok(Self {
            baked: device.buffer("the light of dry layers", 4 * NODES as u64 * cells)?,
            material: device.buffer("the light of dry layers", 4 * cells)?,
            picture: device.buffer("the picture", 16 * cells)?,
        })
    }

    /// Records the baking of the tiles in `baked`, then the rendering of the tiles in `baked` and
    /// `shown`.
    ///
    /// # Panics
    /// If `scene` does not describe each dry layer.
    pub(super) fn record(
        &self,
        recording: &mut Recording,
        canvas: &CanvasBuffers<'_>,
        scene: &Scene,
        baked: &TileSet,
        shown: &TileSet,
    ) {
        let count = canvas.dry.len();
        assert_eq!(scene.dry.len(), count, "the scene must describe each dry layer");
        let mut shown = shown.clone();
        for tile in baked.iter() {
            shown.insert_tile(tile);
        }
        for tiles in columns_and_rows(baked).chunks(MAX_TILES) {
            self.record_bake(recording, canvas, scene, tiles);
        }
        for tiles in columns_and_rows(&shown).chunks(MAX_TILES) {
            self.record_show(recording, canvas, scene, tiles);
        }
    }

    fn record_bake(
        &self,
        recording: &mut Recording,
        canvas: &CanvasBuffers<'_>,
        scene: &Scene,
        tiles: &[[u32; 2]],
    ) {
        let params = BakeParams {
            layer: (&crate::optics::LayerOptics::EMPTY).into(),
            ground: scene.ground,
            canvas: canvas.size,
            first_tile: recording.batch(tiles),
            first_cell: 0,
        };
        let buffers = |paint: &PaintBuffers| {
            [&paint.pigments, &paint.vehicle, &self.baked, &self.material].map(Clone::clone)
        };
        let ground = buffers(canvas.wet);
        recording.dispatch(&PRIME, &params, &ground.each_ref(), workgroups(tiles, 1));
        let fewer = workgroups(tiles, CELLS_AT_ONCE);
        for (layer, paint) in scene.dry.iter().zip(canvas.dry) {
            let films = if paint.skin { 2 } else { 1 };
            for film in 0..films {
                let first_cell = (film * paint.cells) as u32;
                let params = BakeParams { layer: layer.into(), first_cell, ..params };
                recording.dispatch(&BAKE, &params, &buffers(paint).each_ref(), fewer);
            }
        }
    }

    fn record_show(
        &self,
        recording: &mut Recording,
        canvas: &CanvasBuffers<'_>,
        scene: &Scene,
        tiles: &[[u32; 2]],
    ) {
        let surface = scene.surface;
        let params = ShowParams {
            layer: (&scene.wet).into(),
            rgb_from_nodes: scene.rgb_from_nodes.map(|[r, g, b]| [r, g, b, 0.0]),
            surface: SurfaceParams {
                k1: surface.k1,
                k2: surface.k2,
                specular: surface.specular,
                relief_on: u32::from(scene.lamp.relief != 0.0),
            },
            lamp: ReliefLamp::new(scene).into(),
            canvas: canvas.size,
            first_tile: recording.batch(tiles),
            skin: u32::from(canvas.has_skin),
        };
        let PaintBuffers { pigments, vehicle, .. } = canvas.wet;
        let heights = canvas.surface_heights;
        let buffers = [pigments, vehicle, heights, &self.baked, &self.material, &self.picture];
        recording.dispatch(&SHOW, &params, &buffers, workgroups(tiles, CELLS_AT_ONCE));
    }
}

pub(super) fn columns_and_rows(tiles: &TileSet) -> Vec<[u32; 2]> {
    tiles.iter().map(|tile| [tile.column as u32, tile.row as u32]).collect()
}

/// Number of workgroups along x, y and z. Each z covers one tile, and an invocation computes
/// `cells` cells of a column.
pub(super) fn workgroups(tiles: &[[u32; 2]], cells: u32) -> [u32; 3] {
    [1, TILE as u32 / cells, tiles.len() as u32]
}

/// Uniforms of [`RAISE`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct RaiseParams {
    canvas: [u32; 2],
    first_tile: u32,
    /// 1 if a cell may have a skin.
    skin: u32,
}

/// Adds up the heights of floor and wet paint.
pub(super) static RAISE: Kernel = Kernel {
    name: "raise_tiles",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("passes/raise_tiles.wgsl"),
    ),
    parameters: PARAMS,
    structs: &[],
    storage: &[Storage::Batch, Storage::Read, Storage::Read, Storage::Read, Storage::Write],
};

const PARAMS: Layout = layout!(RaiseParams { canvas, first_tile, skin });

/// Height of the surface of each cell in quanta.
#[derive(Debug)]
pub(super) struct Tops {
    bounds: Rect,
    /// We allocate this at the first rendering.
    heights: Option<Buffer>,
    /// Tiles with paint that changed since we computed their heights.
    stale: TileSet,
}

impl Tops {
    /// Heights of a canvas of `bounds`. None is computed yet.
    pub(super) fn new(bounds: Rect) -> Self {
        Self { bounds, heights: None, stale: TileSet::all(bounds) }
    }

    /// Marks the paint in `rect` as changing.
    pub(super) fn change(&mut self, rect: Rect) {
        self.stale.insert(rect);
    }

    pub(super) fn change_all(&mut self) {
        self.stale = TileSet::all(self.bounds);
    }

    /// Records the computation of changed heights from wet paint and floor, and returns all
    /// heights. You can clone this handle cheaply.
    pub(super) fn record(
        &mut self,
        device: &Device,
        recording: &mut Recording,
        wet: &PaintBuffers,
        floor: &Buffer,
        has_skin: bool,
    ) -> Result<Buffer, DeviceError> {
        let cells = self.bounds.width * self.bounds.height;
        let heights = match self.heights.take() {
            Some(heights) => heights,
            None => device.buffer("the surface of the paint", 4 * cells as u64)?,
        };
        self.heights = Some(heights.clone());
        let canvas = [self.bounds.width as u32, self.bounds.height as u32];
        for tiles in columns_and_rows(&self.stale.take()).chunks(MAX_TILES) {
            let skin = u32::from(has_skin);
            let params = RaiseParams { canvas, first_tile: recording.batch(tiles), skin };
            let buffers = [&wet.pigments, &wet.vehicle, floor, &heights];
            recording.dispatch(&RAISE, &params, &buffers, workgroups(tiles, 1));
        }
        Ok(heights)
    }
}
