//! The paint engine on a graphics device. All paint stays in the device's memory, and we copy it
//! back only when you read it.
//!
//! We record calls and submit them together, when enough have gathered or when you read something.

mod buffers;
mod sub_step;
mod render;

use graphics::field::Field;
use graphics::gpu::{Adapter, Buffer, Device, DeviceError, Kernel, Recording, Rows, groups};
use graphics::tile::{Rect, TILE, Tile, TileSet};

use crate::contact::{Contact, Wicking};
use crate::engine::{BrushId, UndoSlot, View};
use crate::layer::Layer;
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::motion::bed::BLOCK;
use crate::optics::Scene;
use buffers::{
    BrushBuffers, PIGMENT_BYTES, PaintBuffers, SubStepBuffers, floor_buffer, mask_start,
    painted_start,
};
use render::{CanvasBuffers, Tops, ViewBuffers};
use sub_step::{
    BedParams, DryParams, SubStepParams, UNDO_TILE, UndoTileParams, UndoTiles, WickParams,
    check_contact,
};

/// We submit a recording when it holds this many bytes or commands. This is often enough to keep
/// the device busy and to bound the memory of waiting commands.
const SUBMIT_BYTES: usize = 16 << 20;
const SUBMIT_COMMANDS: usize = 512;

/// Minimum number of cells for which we allocate the buffers of a sub-step.
const MIN_SUB_STEP_CELLS: usize = 1 << 14;

/// The paint of one painting on a graphics device. You use this through
/// [`PaintEngine`](crate::engine::PaintEngine), which documents its operations.
#[derive(Debug)]
pub struct GpuPaint {
    device: Device,
    bounds: Rect,
    recording: Recording,
    wet: PaintBuffers,
    /// Height of ground and dry paint of each cell in quanta, then the bed of all blocks (see
    /// [`crate::motion::bed`]), then the bits of the mask, then of the cells painted before the stroke.
    floor: Buffer,
    /// Index at which the mask begins in `floor`. Without a mask this is 0.
    mask: u32,
    brushes: Vec<BrushBuffers>,
    sub_step: SubStepBuffers,
    dry: Vec<PaintBuffers>,
    undo_tiles: UndoTiles,
    /// Tiles that may have wet paint, and tiles that may have a skin.
    painted: TileSet,
    skinned: TileSet,
    tops: Tops,
    /// Buffers of each [`View`], once they are allocated.
    views: [Option<ViewBuffers>; 2],
}

/// Number of cells of the largest canvas that one buffer of `adapter` can hold. You may run out of
/// the device's memory before this.
#[must_use]
pub fn max_canvas_cells(adapter: &Adapter) -> u64 {
    adapter.limits.binding_bytes / (2 * PIGMENT_BYTES)
}

impl GpuPaint {
    /// A canvas without paint over a ground of height `floor`, in quanta.
    pub(crate) fn new(mut device: Device, floor: &Field<i32>) -> Result<Self, DeviceError> {
        let bounds = floor.bounds();
        let cells = bounds.width * bounds.height;
        // This is the largest of all buffers, so we check it before we allocate any.
        device.check_size("the canvas", 2 * PIGMENT_BYTES * cells as u64)?;
        Ok(Self {
            bounds,
            recording: Recording::default(),
            wet: PaintBuffers::empty(&device, "the wet paint", cells, true)?,
            floor: floor_buffer(&mut device, floor)?,
            mask: 0,
            brushes: Vec::new(),
            sub_step: SubStepBuffers::new(&device, 1)?,
            dry: Vec::new(),
            undo_tiles: UndoTiles::default(),
            painted: TileSet::default(),
            skinned: TileSet::default(),
            tops: Tops::new(bounds),
            views: [None, None],
            device,
        })
    }

    pub(crate) fn device(&self) -> &Device {
        &self.device
    }

    pub(crate) fn finish(&mut self) -> Result<(), DeviceError> {
        self.submit()?;
        self.device.finish()
    }

    pub(crate) fn name(&self) -> String {
        let adapter = self.device.adapter();
        format!("{} ({})", adapter.name, adapter.backend)
    }

    pub(crate) fn bounds(&self) -> Rect {
        self.bounds
    }

    pub(crate) fn apply_contacts(
        &mut self,
        brush: BrushId,
        motion: &MotionConstants,
        contacts: &[Contact],
    ) -> Result<(), DeviceError> {
        for contact in contacts {
            if contact.wicking.share > 0 {
                self.record_wicking(brush, contact.wicking)?;
            }
            if !contact.rect.is_empty() {
                self.record_sub_step(brush, motion, contact)?;
            }
        }
        Ok(())
    }

    pub(crate) fn add_brush(
        &mut self,
        width: usize,
        height: usize,
    ) -> Result<BrushId, DeviceError> {
        self.brushes.push(BrushBuffers::new(&self.device, (width, height))?);
        Ok(BrushId(self.brushes.len() - 1))
    }

    pub(crate) fn brush_paint(&mut self, brush: BrushId) -> Result<Layer, DeviceError> {
        self.submit()?;
        let brush = &self.brushes[brush.0];
        brush.paint.download(&mut self.device, brush.all_cells())
    }

    pub(crate) fn set_brush_paint(
        &mut self,
        brush: BrushId,
        paint: &Layer,
    ) -> Result<(), DeviceError> {
        self.submit()?;
        let brush = &self.brushes[brush.0];
        let size = (paint.width(), paint.height());
        assert_eq!(size, brush.size, "paint must cover the brush's cells");
        brush.upload(&mut self.device, paint)
    }

    pub(crate) fn wet_in(&mut self, rect: Rect) -> Result<Layer, DeviceError> {
        self.submit()?;
        let rows = self.canvas_rows(rect);
        self.wet.download(&mut self.device, rows)
    }

    pub(crate) fn set_wet_in(&mut self, rect: Rect, paint: &Layer) -> Result<(), DeviceError> {
        self.submit()?;
        let size = (paint.width(), paint.height());
        assert_eq!(size, (rect.width, rect.height), "paint must cover {rect:?}");
        let rows = self.canvas_rows(rect);
        self.tops.change(rect);
        self.painted.insert(rect);
        if paint.painted_skin().is_some() {
            self.skinned.insert(rect);
        }
        self.wet.upload(&mut self.device, rows, paint)
    }

    pub(crate) fn wet_tiles(&mut self) -> Result<TileSet, DeviceError> {
        let wet = self.wet_in(self.bounds)?;
        Ok(TileSet::with(self.bounds, |index| wet.cell(index).volume() > 0))
    }

    pub(crate) fn dry(&mut self, share: u32) -> Result<(), DeviceError> {
        assert!(share <= 65536, "a share of the paint is at most 65536 parts: {share}");
        let layer = self.empty_dry_layer(!self.skinned.is_empty())?;
        let params = self.dry_params(share, 1, &layer);
        self.record_dry(&sub_step::DRY, &layer, params);
        self.dry.push(layer);
        self.submit()
    }

    pub(crate) fn dry_layer_count(&self) -> usize {
        self.dry.len()
    }

    pub(crate) fn dry_layer_in(&mut self, index: usize, rect: Rect) -> Result<Layer, DeviceError> {
        self.submit()?;
        let rows = self.canvas_rows(rect);
        self.dry[index].download(&mut self.device, rows)
    }

    pub(crate) fn insert_dry_layer(&mut self, at: usize, layer: &Layer) -> Result<(), DeviceError> {
        assert_eq!(layer.vehicle.bounds(), self.bounds, "a dry layer must cover the canvas");
        self.submit()?;
        let paint = self.empty_dry_layer(layer.painted_skin().is_some())?;
        paint.upload(&mut self.device, (self.bounds, self.bounds.width), layer)?;
        let params = self.dry_params(0, 1, &paint);
        self.record_dry(&sub_step::MOVE_FLOOR, &paint, params);
        self.dry.insert(at, paint);
        self.submit()
    }

    pub(crate) fn remove_dry_layer(&mut self, index: usize) -> Result<Layer, DeviceError> {
        let layer = self.dry_layer_in(index, self.bounds)?;
        let paint = self.dry.remove(index);
        let params = self.dry_params(0, -1, &paint);
        self.record_dry(&sub_step::MOVE_FLOOR, &paint, params);
        self.submit().map(|()| layer)
    }

    pub(crate) fn move_dry_layer(&mut self, from: usize, to: usize) {
        let paint = self.dry.remove(from);
        self.dry.insert(to, paint);
    }

    pub(crate) fn floor(&mut self) -> Result<Field<i32>, DeviceError> {
        self.submit()?;
        let Rect { width, height, .. } = self.bounds;
        let values = self.device.read(&self.floor, Rows::start(width * height))?;
        Ok(Field::from_values(width, height, values))
    }

    pub(crate) fn save_tile(&mut self, tile: Tile, slot: UndoSlot) -> Result<(), DeviceError> {
        self.record_undo_tile(tile, slot, false)
    }

    pub(crate) fn swap_tile(&mut self, tile: Tile, slot: UndoSlot) -> Result<(), DeviceError> {
        self.record_undo_tile(tile, slot, true)
    }

    pub(crate) fn may_have_skin(&self, rect: Rect) -> bool {
        self.skinned.meets(rect)
    }

    pub(crate) fn note_bed(
        &mut self,
        rect: Rect,
        motion: &MotionConstants,
    ) -> Result<(), DeviceError> {
        let (rect, _) = self.canvas_rows(rect);
        if self.painted.meets(rect) {
            self.skinned.insert(rect);
        }
        let params = BedParams {
            tile: as_u32(rect),
            canvas: self.canvas_size(),
            skin_quanta: motion.skin_quanta,
            painted: painted_start(self.bounds) as u32,
        };
        let buffers = [&self.wet.pigments, &self.wet.vehicle, &self.floor];
        let over = [rect.width, rect.height].map(|cells| groups(cells.div_ceil(BLOCK)));
        let over = [over[0], over[1], 1];
        self.recording.dispatch(&sub_step::NOTE_BED, &params, &buffers, over);
        self.submit_if_full()
    }

    pub(crate) fn render(
        &mut self,
        view: View,
        scene: &Scene,
        baked: &TileSet,
        shown: &TileSet,
    ) -> Result<(), DeviceError> {
        let view = self.view_buffers(view)?;
        let size = self.canvas_size();
        let Self { device, recording, wet, floor, dry, tops, skinned, .. } = self;
        let has_skin = !skinned.is_empty();
        let surface_heights = &tops.record(device, recording, wet, floor, has_skin)?;
        let canvas = CanvasBuffers { size, wet, surface_heights, dry, has_skin };
        view.record(recording, &canvas, scene, baked, shown);
        self.submit()
    }

    pub(crate) fn picture_in(
        &mut self,
        view: View,
        rect: Rect,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        self.submit()?;
        let view = self.view_buffers(view)?;
        let (rect, width) = self.canvas_rows(rect);
        let values = self.device.read(&view.picture, Rows::of(rect, width))?;
        Ok(Field::from_values(rect.width, rect.height, values))
    }

    pub(crate) fn forget_view(&mut self, view: View) {
        self.views[view as usize] = None;
    }

    /// `rect` and the number of cells in a row of the canvas.
    ///
    /// # Panics
    /// If `rect` reaches beyond the canvas.
    fn canvas_rows(&self, rect: Rect) -> (Rect, usize) {
        let bounds = self.bounds;
        assert_eq!(rect.intersection(bounds), rect, "a rectangle must lie within {bounds:?}");
        (rect, bounds.width)
    }

    fn canvas_size(&self) -> [u32; 2] {
        [self.bounds.width as u32, self.bounds.height as u32]
    }

    fn submit(&mut self) -> Result<(), DeviceError> {
        self.device.submit(&mut self.recording)
    }

    fn submit_if_full(&mut self) -> Result<(), DeviceError> {
        if self.recording.bytes() >= SUBMIT_BYTES || self.recording.len() >= SUBMIT_COMMANDS {
            self.submit()?;
        }
        Ok(())
    }

    fn record_sub_step(
        &mut self,
        brush: BrushId,
        motion: &MotionConstants,
        contact: &Contact,
    ) -> Result<(), DeviceError> {
        let head = &self.brushes[brush.0];
        check_contact(contact, self.bounds, head.cell_count());
        let region = contact.rect.grown(2, self.bounds);
        self.tops.change(region);
        self.painted.insert(region);
        let has_skin = self.skinned.meets(region);
        // Paint may flow on.
        if has_skin {
            self.skinned.insert(region);
        }
        let cells = region.width * region.height;
        if self.sub_step.cells < cells {
            // We take 1.5 times the size, so that a growing contact seldom reallocates.
            let cells = (cells * 3 / 2).max(MIN_SUB_STEP_CELLS);
            self.sub_step = SubStepBuffers::new(&self.device, cells)?;
        }
        self.device.check_size("a contact", size_of_val(contact.touches.as_slice()) as u64)?;
        let params = SubStepParams {
            motion: *motion,
            rates: contact.rates,
            region: as_u32(region),
            contact: as_u32(contact.rect),
            canvas: self.canvas_size(),
            first_touch: self.recording.batch(&contact.touches),
            brush_cells: head.cell_count(),
            mask: [self.mask, painted_start(self.bounds) as u32, u32::from(has_skin), 0],
        };
        let PaintBuffers { pigments, vehicle, .. } = &self.wet;
        let PaintBuffers { pigments: head_pigments, vehicle: head_vehicle, .. } = &head.paint;
        let SubStepBuffers { depths, above, flow, moved, .. } = &self.sub_step;
        let over = [groups(region.width), groups(region.height), 1];
        let recording = &mut self.recording;
        let begin = [pigments, vehicle, &self.floor, head_pigments, head_vehicle, depths, above];
        recording.dispatch(&sub_step::BEGIN, &params, &begin, over);
        recording.dispatch(&sub_step::PRESS, &params, &[depths, flow], over);
        recording.dispatch(&sub_step::ADVECT, &params, &[pigments, vehicle, flow, moved], over);
        let transfer = [depths, moved, above, head_pigments, head_vehicle, pigments, vehicle];
        recording.dispatch(&sub_step::TRANSFER, &params, &transfer, over);
        self.submit_if_full()
    }

    fn record_wicking(&mut self, brush: BrushId, wicking: Wicking) -> Result<(), DeviceError> {
        let BrushBuffers { size, paint } = &self.brushes[brush.0];
        let Wicking { share, first_row, hairs, shift, turns, turn } = wicking;
        let hairs = hairs.max(1);
        let turns = turns.max(1);
        let size_u32 = [size.0 as u32, size.1 as u32];
        let params =
            WickParams { size: size_u32, wicking: share, first_row, hairs, shift, turns, turn };
        let hair_groups = (size.0.div_ceil(2) + shift as usize).div_ceil(hairs as usize);
        let hair_groups = hair_groups.div_ceil(turns as usize);
        // A workgroup of 8 x 8 invocations takes 64 groups of hairs.
        let over = [groups(hair_groups.div_ceil(8)), 1, 1];
        self.recording.dispatch(&sub_step::WICK, &params, &[&paint.pigments, &paint.vehicle], over);
        self.submit_if_full()
    }

    fn record_undo_tile(
        &mut self,
        tile: Tile,
        slot: UndoSlot,
        swap: bool,
    ) -> Result<(), DeviceError> {
        let rect = tile.rect(self.bounds);
        assert!(!rect.is_empty(), "{tile:?} lies outside {:?}", self.bounds);
        let (saved, first_cell) = self.undo_tiles.place(&self.device, slot.0)?;
        let params = UndoTileParams {
            tile: as_u32(rect),
            canvas: self.canvas_size(),
            first_cell,
            swap: u32::from(swap),
            saved_skin: saved.cells as u32,
            padding: [0; 3],
        };
        let buffers = [&self.wet.pigments, &self.wet.vehicle, &saved.pigments, &saved.vehicle];
        let over = [groups(TILE), groups(TILE), 1];
        if swap {
            self.tops.change(rect);
            self.painted.insert(rect);
            // The saved tile may have a skin if any did.
            if !self.skinned.is_empty() {
                self.skinned.insert(rect);
            }
        }
        self.recording.dispatch(&UNDO_TILE, &params, &buffers, over);
        self.submit_if_full()
    }

    /// Records one of the kernels of [`drying`] over the whole canvas.
    fn record_dry(&mut self, kernel: &'static Kernel, layer: &PaintBuffers, params: DryParams) {
        let buffers =
            [&self.floor, &layer.pigments, &layer.vehicle, &self.wet.pigments, &self.wet.vehicle];
        let over = [groups(self.bounds.width), groups(self.bounds.height), 1];
        self.tops.change_all();
        self.recording.dispatch(kernel, &params, &buffers, over);
    }

    fn empty_dry_layer(&self, skin: bool) -> Result<PaintBuffers, DeviceError> {
        let cells = self.bounds.width * self.bounds.height;
        PaintBuffers::empty(&self.device, "a dry layer", cells, skin)
    }

    fn dry_params(&self, share: u32, rise: i32, layer: &PaintBuffers) -> DryParams {
        let films = if layer.skin { 2 } else { 1 };
        DryParams { canvas: self.canvas_size(), share, rise, films, padding: [0; 3] }
    }

    /// The buffers of a view. We allocate them when you first ask for them.
    fn view_buffers(&mut self, view: View) -> Result<ViewBuffers, DeviceError> {
        if let Some(buffers) = &self.views[view as usize] {
            return Ok(buffers.clone());
        }
        let buffers = ViewBuffers::new(&self.device, self.bounds.width * self.bounds.height)?;
        self.views[view as usize] = Some(buffers.clone());
        Ok(buffers)
    }
}

fn as_u32(rect: Rect) -> [u32; 4] {
    [rect.x, rect.y, rect.width, rect.height].map(|number| number as u32)
}

impl GpuPaint {
    pub(crate) fn set_mask(&mut self, mask: Option<&Mask>) -> Result<(), DeviceError> {
        self.submit()?;
        let Some(mask) = mask else {
            self.mask = 0;
            return Ok(());
        };
        let start = mask_start(self.bounds);
        let rows = Rows { first: start, ..Rows::start(mask.words().len()) };
        self.device.write(&self.floor, rows, mask.words())?;
        self.mask = start as u32;
        Ok(())
    }
}

/// Every kernel that painting on a device runs. Tests validate them.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![
        &sub_step::BEGIN,
        &sub_step::PRESS,
        &sub_step::ADVECT,
        &sub_step::TRANSFER,
        &sub_step::WICK,
        &sub_step::NOTE_BED,
        &sub_step::DRY,
        &sub_step::MOVE_FLOOR,
        &UNDO_TILE,
        &render::PRIME,
        &render::BAKE,
        &render::RAISE,
        &render::SHOW,
    ]
}
