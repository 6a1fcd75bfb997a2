//! What lies on the device: paint, heads, stores, and how they come and go.

use crate::layer::{Layer, SLOTS};
use graphics::field::Field;
use graphics::gpu::{Buffer, Device, DeviceError, Rows};
use graphics::tile::{Rect, TILE};

/// Bytes of pigments in a cell.
pub(super) const PIGMENTS: u64 = 4 * SLOTS as u64;

/// Cells of a tile.
const TILE_CELLS: usize = TILE * TILE;

/// Tiles in one store.
const STORE: usize = 64;

/// A layer of paint on the device.
#[derive(Debug, Clone)]
pub(super) struct Paint {
    pub(super) pigments: Buffer,
    pub(super) vehicle: Buffer,
}

impl Paint {
    /// No paint over `cells`.
    pub(super) fn empty(
        device: &Device,
        what: &'static str,
        cells: usize,
    ) -> Result<Self, DeviceError> {
        Ok(Self {
            pigments: device.buffer(what, PIGMENTS * cells as u64)?,
            vehicle: device.buffer(what, 4 * cells as u64)?,
        })
    }

    /// Puts `layer` in the place of its cells in `rect`, in rows of `width`.
    pub(super) fn write(
        &self,
        device: &mut Device,
        (rect, width): (Rect, usize),
        layer: &Layer,
    ) -> Result<(), DeviceError> {
        let rows = Rows::of(rect, width);
        device.write(&self.pigments, rows, layer.pigments.values())?;
        device.write(&self.vehicle, rows, layer.vehicle.values())
    }

    /// Its cells in `rect`, in rows of `width`.
    pub(super) fn read(
        &self,
        device: &mut Device,
        (rect, width): (Rect, usize),
    ) -> Result<Layer, DeviceError> {
        let rows = Rows::of(rect, width);
        let pigments = device.read(&self.pigments, rows)?;
        let vehicle = device.read(&self.vehicle, rows)?;
        Ok(Layer {
            pigments: Field::from_values(rect.width, rect.height, pigments),
            vehicle: Field::from_values(rect.width, rect.height, vehicle),
        })
    }
}

/// The paint on the head of a brush.
#[derive(Debug)]
pub(super) struct Head {
    pub(super) size: (usize, usize),
    pub(super) paint: Paint,
}

impl Head {
    pub(super) fn new(device: &Device, size: (usize, usize)) -> Result<Self, DeviceError> {
        let cells = size.0 * size.1;
        Ok(Self { size, paint: Paint::empty(device, "the head of a brush", cells)? })
    }

    /// All its cells, and how many are in a row.
    pub(super) fn whole(&self) -> (Rect, usize) {
        let (width, height) = self.size;
        (Rect { x: 0, y: 0, width, height }, width)
    }

    pub(super) fn cells(&self) -> u32 {
        (self.size.0 * self.size.1) as u32
    }
}

/// What a sub-step writes down between its kernels, for so many cells.
#[derive(Debug)]
pub(super) struct Scratch {
    pub(super) cells: usize,
    /// Penetration and volume.
    pub(super) depths: Buffer,
    /// The cell of the head above.
    pub(super) above: Buffer,
    /// Velocity and mobile share.
    pub(super) flow: Buffer,
    /// The cell after its paint has moved.
    pub(super) moved: Buffer,
}

impl Scratch {
    pub(super) fn new(device: &Device, cells: usize) -> Result<Self, DeviceError> {
        let buffer = |bytes| device.buffer("the paint in motion", bytes * cells as u64);
        Ok(Self {
            cells,
            depths: buffer(8)?,
            above: buffer(48)?,
            flow: buffer(8)?,
            moved: buffer(48)?,
        })
    }
}

/// Tiles kept for undo, in stores of a fixed number of them.
#[derive(Debug, Default)]
pub(super) struct Stores {
    stores: Vec<Paint>,
}

impl Stores {
    /// The store that has slot number `slot`, and the slot's first cell there;
    /// made if it is new.
    pub(super) fn place(
        &mut self,
        device: &Device,
        slot: usize,
    ) -> Result<(Paint, u32), DeviceError> {
        while self.stores.len() <= slot / STORE {
            self.stores.push(Paint::empty(device, "the undo history", STORE * TILE_CELLS)?);
        }
        Ok((self.stores[slot / STORE].clone(), (slot % STORE * TILE_CELLS) as u32))
    }
}
