//! Light on the device: dry layers baked, wet paint shown over them.
//!
//! Twins of [`crate::composite`] and [`crate::shade`], in f32; how near is told
//! by the tests.

use super::OnGpu;
use super::canvas::Paint;
use crate::amount::QUANTA_PER_CELL;
use crate::engine::View;
use crate::layer::SLOTS;
use crate::optics::{Gloss, Lamp, NODES, Scene};
use graphics::field::Field;
use graphics::gpu::{Buffer, Device, DeviceError, GROUP, Kernel, Layout, Rows, Storage, layout};
use graphics::tile::{Rect, TILE, TileSet};

/// As many tiles as one dispatch may have in a direction.
const TILES: usize = 65535;

/// [`crate::optics::Coat`], laid out for both languages.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Coat {
    absorption: [[f32; NODES]; SLOTS],
    scattering: [[f32; NODES]; SLOTS],
}

/// What baking is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Baking {
    coat: Coat,
    ground: [f32; NODES],
    canvas: [u32; 2],
    first_tile: u32,
    spare: u32,
}

/// The surface between paint and air.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Skin {
    k1: f32,
    k2: f32,
    floor: f32,
    bumpy: u32,
}

/// What a lamp makes of slopes.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Bumps {
    towards_lamp: [f32; 2],
    ambient: f32,
    slope: f32,
    halfway: [f32; 4],
    gloss: [[f32; 4]; 3],
}

/// What showing is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Showing {
    coat: Coat,
    rgb_from_nodes: [[f32; 4]; NODES],
    skin: Skin,
    bumps: Bumps,
    canvas: [u32; 2],
    first_tile: u32,
    spare: u32,
}

const COAT: Layout = layout!(Coat { absorption, scattering });

const BAKE_SOURCE: &str = concat!(
    include_str!("../amount.wgsl"),
    include_str!("../layer.wgsl"),
    include_str!("../composite.wgsl"),
    include_str!("passes/bake.wgsl"),
);

const BAKING: Layout = layout!(Baking { coat, ground, canvas, first_tile, spare });

const BAKE_STORAGE: &[Storage] =
    &[Storage::Batch, Storage::Read, Storage::Read, Storage::Write, Storage::Write];

/// Tiles as bare ground.
pub(super) static PRIME: Kernel = Kernel {
    name: "prime_tiles",
    source: BAKE_SOURCE,
    parameters: BAKING,
    structs: &[COAT],
    storage: BAKE_STORAGE,
};

/// One dry layer over what is baked.
pub(super) static BAKE: Kernel = Kernel {
    name: "bake_tiles",
    source: BAKE_SOURCE,
    parameters: BAKING,
    structs: &[COAT],
    storage: BAKE_STORAGE,
};

/// The wet layer over what is baked, to light.
pub(super) static SHOW: Kernel = Kernel {
    name: "show_tiles",
    source: concat!(
        include_str!("../amount.wgsl"),
        include_str!("../layer.wgsl"),
        include_str!("../composite.wgsl"),
        include_str!("../shade.wgsl"),
        include_str!("passes/show.wgsl"),
    ),
    parameters: layout!(Showing { coat, rgb_from_nodes, skin, bumps, canvas, first_tile, spare }),
    structs: &[
        COAT,
        layout!(Skin { k1, k2, floor, bumpy }),
        layout!(Bumps { towards_lamp, ambient, slope, halfway, gloss }),
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

/// What the light of a view needs on the device, made when it is first asked for.
#[derive(Debug, Clone)]
pub(super) struct Lit {
    baked: Buffer,
    bare: Buffer,
    picture: Buffer,
}

impl Lit {
    fn new(device: &Device, cells: usize) -> Result<Self, DeviceError> {
        let cells = cells as u64;
        Ok(Self {
            baked: device.buffer("the light of dry layers", 4 * NODES as u64 * cells)?,
            bare: device.buffer("the light of dry layers", 4 * cells)?,
            picture: device.buffer("the picture", 16 * cells)?,
        })
    }
}

impl From<&crate::optics::Coat> for Coat {
    fn from(coat: &crate::optics::Coat) -> Self {
        Self { absorption: coat.absorption, scattering: coat.scattering }
    }
}

impl Bumps {
    fn new(lamp: &Lamp) -> Self {
        let [x, y, z] = lamp.direction;
        let length = (x * x + y * y + (z + 1.0) * (z + 1.0)).sqrt();
        let halfway = [x / length, y / length, (z + 1.0) / length];
        let gloss = |Gloss { strength, exponent }: Gloss| {
            [strength * (1.0 - lamp.ambient), exponent, halfway[2].powf(exponent), 0.0]
        };
        Self {
            towards_lamp: [-x / z, -y / z],
            ambient: lamp.ambient,
            slope: lamp.relief / (2.0 * QUANTA_PER_CELL as f32),
            halfway: [halfway[0], halfway[1], halfway[2], 0.0],
            gloss: [lamp.wet, lamp.dry, lamp.ground].map(gloss),
        }
    }
}

impl OnGpu {
    /// Makes the light's buffers unless they are there.
    fn lit(&mut self, view: View) -> Result<Lit, DeviceError> {
        if let Some(lit) = &self.lit[view as usize] {
            return Ok(lit.clone());
        }
        let lit = Lit::new(&self.device, self.bounds.width * self.bounds.height)?;
        self.lit[view as usize] = Some(lit.clone());
        Ok(lit)
    }

    pub(super) fn light_tiles(
        &mut self,
        view: View,
        scene: &Scene,
        baked: &TileSet,
        shown: &TileSet,
    ) -> Result<(), DeviceError> {
        let found = scene.dry.len();
        assert_eq!(found, self.dry.len(), "a coat for each dry layer, found {found}");
        let lit = self.lit(view)?;
        let mut shown = shown.clone();
        for tile in baked.iter() {
            shown.insert_tile(tile);
        }
        for tiles in columns_and_rows(baked).chunks(TILES) {
            self.bake(&lit, scene, tiles);
        }
        for tiles in columns_and_rows(&shown).chunks(TILES) {
            self.show(&lit, scene, tiles);
        }
        self.send()
    }

    fn bake(&mut self, lit: &Lit, scene: &Scene, tiles: &[[u32; 2]]) {
        let empty = Coat { absorption: [[0.0; NODES]; SLOTS], scattering: [[0.0; NODES]; SLOTS] };
        let baking = Baking {
            coat: empty,
            ground: scene.ground,
            canvas: [self.bounds.width as u32, self.bounds.height as u32],
            first_tile: self.waiting.batch(tiles),
            spare: 0,
        };
        let over = over(tiles);
        let buffers = |paint: &'_ Paint| {
            [&paint.pigments, &paint.vehicle, &lit.baked, &lit.bare].map(Clone::clone)
        };
        let ground = buffers(&self.wet);
        self.waiting.dispatch(&PRIME, &baking, &ground.each_ref(), over);
        for (coat, paint) in scene.dry.iter().zip(&self.dry) {
            let baking = Baking { coat: coat.into(), ..baking };
            self.waiting.dispatch(&BAKE, &baking, &buffers(paint).each_ref(), over);
        }
    }

    fn show(&mut self, lit: &Lit, scene: &Scene, tiles: &[[u32; 2]]) {
        let surface = scene.surface;
        let showing = Showing {
            coat: (&scene.wet).into(),
            rgb_from_nodes: scene.rgb_from_nodes.map(|[r, g, b]| [r, g, b, 0.0]),
            skin: Skin {
                k1: surface.k1,
                k2: surface.k2,
                floor: surface.floor,
                bumpy: u32::from(scene.lamp.relief != 0.0),
            },
            bumps: Bumps::new(&scene.lamp),
            canvas: [self.bounds.width as u32, self.bounds.height as u32],
            first_tile: self.waiting.batch(tiles),
            spare: 0,
        };
        let Paint { pigments, vehicle } = &self.wet;
        let buffers = [pigments, vehicle, &self.floor, &lit.baked, &lit.bare, &lit.picture];
        self.waiting.dispatch(&SHOW, &showing, &buffers, over(tiles));
    }

    /// A view in `rect`; black where no light was computed.
    pub(super) fn read_picture(
        &mut self,
        view: View,
        rect: Rect,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let lit = self.lit(view)?;
        let (rect, width) = self.rows(rect);
        let values = self.device.read(&lit.picture, Rows::of(rect, width))?;
        Ok(Field::from_values(rect.width, rect.height, values))
    }
}

fn columns_and_rows(tiles: &TileSet) -> Vec<[u32; 2]> {
    tiles.iter().map(|tile| [tile.column as u32, tile.row as u32]).collect()
}

/// Groups over whole tiles.
fn over(tiles: &[[u32; 2]]) -> [u32; 3] {
    let across = TILE as u32 / GROUP;
    [across, across, tiles.len() as u32]
}
