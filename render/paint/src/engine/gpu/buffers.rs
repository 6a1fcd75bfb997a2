//! The buffers that hold paint on the device. You copy paint to and from them here.

use crate::layer::{Layer, SLOTS};
use crate::motion::bed::{BLOCK, NO_BED};
use graphics::field::Field;
use graphics::gpu::{Buffer, Device, DeviceError, Rows};
use graphics::tile::Rect;

/// Bytes of a cell's pigment amounts.
pub(super) const PIGMENT_BYTES: u64 = 4 * SLOTS as u64;

/// A layer of paint on the device. You can clone the handles cheaply.
#[derive(Debug, Clone)]
pub(super) struct PaintBuffers {
    /// Eight u32 amounts per cell, by slot: the body, then the skin if there is room for one.
    pub(super) pigments: Buffer,
    /// One u32 amount per cell, in the same order.
    pub(super) vehicle: Buffer,
    /// Number of cells of the body.
    pub(super) cells: usize,
    /// Whether the skin follows the body.
    pub(super) skin: bool,
}

impl PaintBuffers {
    /// Allocates `cells` cells without paint, and as many for a skin if you want one. You see `label`
    /// in errors.
    pub(super) fn empty(
        device: &Device,
        label: &'static str,
        cells: usize,
        skin: bool,
    ) -> Result<Self, DeviceError> {
        let all = if skin { 2 * cells } else { cells } as u64;
        Ok(Self {
            pigments: device.buffer(label, PIGMENT_BYTES * all)?,
            vehicle: device.buffer(label, 4 * all)?,
            cells,
            skin,
        })
    }

    /// Uploads `layer` to the cells of `rect`, in a buffer whose rows have `width` cells.
    pub(super) fn upload(
        &self,
        device: &mut Device,
        (rect, width): (Rect, usize),
        layer: &Layer,
    ) -> Result<(), DeviceError> {
        self.write(device, Rows::of(rect, width), layer)?;
        let Some(rows) = self.skin_rows(rect, width) else { return Ok(()) };
        match layer.painted_skin() {
            Some(skin) => self.write(device, rows, skin),
            None => self.write(device, rows, &Layer::empty(rect.width, rect.height)),
        }
    }

    fn write(&self, device: &mut Device, rows: Rows, film: &Layer) -> Result<(), DeviceError> {
        device.write(&self.pigments, rows, film.pigments.values())?;
        device.write(&self.vehicle, rows, film.vehicle.values())
    }

    /// Downloads the cells of `rect`, from a buffer whose rows have `width` cells.
    pub(super) fn download(
        &self,
        device: &mut Device,
        (rect, width): (Rect, usize),
    ) -> Result<Layer, DeviceError> {
        let size = (rect.width, rect.height);
        let mut layer = self.read(device, Rows::of(rect, width), size)?;
        if let Some(rows) = self.skin_rows(rect, width) {
            layer.skin = Some(Box::new(self.read(device, rows, size)?));
            if layer.painted_skin().is_none() {
                layer.skin = None;
            }
        }
        Ok(layer)
    }

    fn read(
        &self,
        device: &mut Device,
        rows: Rows,
        (width, height): (usize, usize),
    ) -> Result<Layer, DeviceError> {
        let pigments = device.read(&self.pigments, rows)?;
        let vehicle = device.read(&self.vehicle, rows)?;
        Ok(Layer {
            pigments: Field::from_values(width, height, pigments),
            vehicle: Field::from_values(width, height, vehicle),
            skin: None,
        })
    }

    /// The cells of the skin in `rect`. `None` without one.
    fn skin_rows(&self, rect: Rect, width: usize) -> Option<Rows> {
        let rows = Rows::of(rect, width);
        self.skin.then(|| Rows { first: self.cells + rows.first, ..rows })
    }
}

#[derive(Debug)]
pub(super) struct BrushBuffers {
    pub(super) size: (usize, usize),
    /// The buffer of the vehicle also holds the mean of each cell's hair, after all vehicle.
    pub(super) paint: PaintBuffers,
}

impl BrushBuffers {
    pub(super) fn new(device: &Device, size: (usize, usize)) -> Result<Self, DeviceError> {
        let cells = (size.0 * size.1) as u64;
        let label = "the head of a brush";
        let pigments = device.buffer(label, PIGMENT_BYTES * cells)?;
        let vehicle = device.buffer(label, 2 * 4 * cells)?;
        let cells = cells as usize;
        Ok(Self { size, paint: PaintBuffers { pigments, vehicle, cells, skin: false } })
    }

    /// Uploads the paint of all cells. The means are 0 until paint flows along the hair.
    pub(super) fn upload(&self, device: &mut Device, paint: &Layer) -> Result<(), DeviceError> {
        self.paint.upload(device, self.all_cells(), paint)?;
        let cells = self.size.0 * self.size.1;
        let means = Rows { first: cells, ..Rows::start(cells) };
        device.write(&self.paint.vehicle, means, &vec![0_u32; cells])
    }

    /// The rectangle of all cells, and the width of a row.
    pub(super) fn all_cells(&self) -> (Rect, usize) {
        let (width, height) = self.size;
        (Rect { x: 0, y: 0, width, height }, width)
    }

    pub(super) fn cell_count(&self) -> u32 {
        (self.size.0 * self.size.1) as u32
    }
}

/// Intermediate results that the kernels of a sub-step pass to each other.
#[derive(Debug)]
pub(super) struct SubStepBuffers {
    /// Number of cells that fit.
    pub(super) cells: usize,
    /// Penetration, volume, top and coat of each cell, i32 each.
    pub(super) depths: Buffer,
    /// Paint of the head's cell above each cell.
    pub(super) above: Buffer,
    /// Velocity and mobile share of each cell.
    pub(super) flow: Buffer,
    /// Body of each cell after advection, then the skin of each.
    pub(super) moved: Buffer,
}

impl SubStepBuffers {
    pub(super) fn new(device: &Device, cells: usize) -> Result<Self, DeviceError> {
        let buffer = |bytes| device.buffer("the paint in motion", bytes * cells as u64);
        Ok(Self {
            cells,
            depths: buffer(16)?,
            above: buffer(48)?,
            flow: buffer(8)?,
            moved: buffer(96)?,
        })
    }
}

/// Index in the buffer of the floor at which the mask of a canvas begins, in words of 32 cells.
pub(super) fn mask_start(canvas: Rect) -> usize {
    let blocks = canvas.width.div_ceil(BLOCK) * canvas.height.div_ceil(BLOCK);
    canvas.width * canvas.height + blocks
}

/// Index in the buffer of the floor at which the painted cells begin. Each block has two words with a bit
/// for each cell: 1 if the cell had wet paint before the stroke. Each row of the block is a byte.
pub(super) fn painted_start(canvas: Rect) -> usize {
    mask_start(canvas) + (canvas.width * canvas.height).div_ceil(32)
}

/// Creates the buffer that holds the floor, then a bed that you have not recorded yet, then a mask
/// that covers no cell, then the cells that had paint before the stroke: none.
pub(super) fn floor_buffer(device: &mut Device, floor: &Field<i32>) -> Result<Buffer, DeviceError> {
    let bounds = floor.bounds();
    let mut values = floor.values().to_vec();
    let blocks = mask_start(bounds) - values.len();
    values.resize(mask_start(bounds), NO_BED);
    values.resize(painted_start(bounds) + 2 * blocks, 0);
    device.buffer_of("the ground", &values)
}
