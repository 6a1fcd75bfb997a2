//! Painting on a graphics device: all paint stays there, and comes back only
//! when asked for.
//!
//! Calls are written down and sent together, when there is enough of them or
//! when something is read.

mod canvas;

mod motion;

mod rest;

mod light;

mod kernels;

use canvas::{Head, PIGMENTS, Paint, Scratch, Stores};
pub use kernels::kernels;
use light::Lit;
use motion::Step;
use rest::{Drying, Keeping};

use super::contact::{Contact, Touch};
use super::engine::{BrushId, Engine, Slot, View};
use super::motion::Motion;
use crate::layer::Layer;
use crate::optics::Scene;
use graphics::field::Field;
use graphics::gpu::{Adapter, Buffer, Device, DeviceError, Recording, Rows, groups};
use graphics::tile::{Rect, TILE, Tile, TileSet};

/// Bytes and commands from which on what was written down is sent.
const FULL_BYTES: usize = 16 << 20;
const FULL_COMMANDS: usize = 512;

/// A painting's paint on a graphics device.
#[derive(Debug)]
pub struct OnGpu {
    device: Device,
    bounds: Rect,
    waiting: Recording,
    wet: Paint,
    floor: Buffer,
    brushes: Vec<Head>,
    scratch: Scratch,
    dry: Vec<Paint>,
    kept: Stores,
    lit: [Option<Lit>; 2],
}

/// How many cells the largest canvas has that one buffer of `adapter` holds; its
/// memory may end before.
#[must_use]
pub fn largest_canvas(adapter: &Adapter) -> u64 {
    adapter.limits.binding_bytes / PIGMENTS
}

impl OnGpu {
    /// A canvas without paint, on `device`, over a ground of height `floor`.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] if the device lends less than the canvas takes.
    pub fn new(mut device: Device, floor: &Field<i32>) -> Result<Self, DeviceError> {
        let bounds = floor.bounds();
        let cells = bounds.width * bounds.height;
        // The largest of all buffers: what does not fit is refused before any is made.
        device.check_size("the canvas", PIGMENTS * cells as u64)?;
        Ok(Self {
            bounds,
            waiting: Recording::default(),
            wet: Paint::empty(&device, "the wet paint", cells)?,
            floor: device.buffer_of("the ground", floor.values())?,
            brushes: Vec::new(),
            scratch: Scratch::new(&device, 1)?,
            dry: Vec::new(),
            kept: Stores::default(),
            lit: [None, None],
            device,
        })
    }

    /// The device.
    #[must_use]
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Sends what waits, and waits until the device has done all.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    pub fn finish(&mut self) -> Result<(), DeviceError> {
        self.send()?;
        Ok(self.device.finish()?)
    }

    fn size(&self) -> (usize, usize) {
        (self.bounds.width, self.bounds.height)
    }

    /// `rect` in rows of the canvas.
    fn rows(&self, rect: Rect) -> (Rect, usize) {
        assert_eq!(rect.intersection(self.bounds), rect, "cells of {:?}", self.bounds);
        (rect, self.bounds.width)
    }

    fn canvas(&self) -> [u32; 2] {
        [self.bounds.width as u32, self.bounds.height as u32]
    }

    fn send(&mut self) -> Result<(), DeviceError> {
        Ok(self.device.submit(&mut self.waiting)?)
    }

    fn send_if_full(&mut self) -> Result<(), DeviceError> {
        if self.waiting.bytes() >= FULL_BYTES || self.waiting.len() >= FULL_COMMANDS {
            self.send()?;
        }
        Ok(())
    }

    fn step(
        &mut self,
        brush: BrushId,
        motion: &Motion,
        contact: &Contact,
    ) -> Result<(), DeviceError> {
        let head = &self.brushes[brush.0];
        check_contact(contact, self.bounds, head.cells());
        let region = contact.rect.grown(2, self.bounds);
        let cells = region.width * region.height;
        if self.scratch.cells < cells {
            self.scratch = Scratch::new(&self.device, (cells * 3 / 2).max(1 << 14))?;
        }
        self.device.check_size("a contact", size_of_val(contact.touches.as_slice()) as u64)?;
        let step = Step {
            motion: *motion,
            region: numbers(region),
            contact: numbers(contact.rect),
            canvas: self.canvas(),
            first_touch: self.waiting.batch(&contact.touches),
            spare: 0,
        };
        let Paint { pigments, vehicle } = &self.wet;
        let Paint { pigments: head_pigments, vehicle: head_vehicle } = &head.paint;
        let Scratch { depths, above, flow, moved, .. } = &self.scratch;
        let over = [groups(region.width), groups(region.height), 1];
        let to_do = &mut self.waiting;
        let begun = [pigments, vehicle, &self.floor, head_pigments, head_vehicle, depths, above];
        to_do.dispatch(&motion::BEGIN, &step, &begun, over);
        to_do.dispatch(&motion::PRESS, &step, &[depths, flow], over);
        to_do.dispatch(&motion::ADVECT, &step, &[pigments, vehicle, flow, moved], over);
        let exchanged = [depths, moved, above, head_pigments, head_vehicle, pigments, vehicle];
        to_do.dispatch(&motion::TRANSFER, &step, &exchanged, over);
        self.send_if_full()
    }

    fn keep(&mut self, tile: Tile, slot: Slot, exchange: bool) -> Result<(), DeviceError> {
        let rect = tile.rect(self.bounds);
        assert!(!rect.is_empty(), "{tile:?} lies outside {:?}", self.bounds);
        let (store, first_cell) = self.kept.place(&self.device, slot.0)?;
        let keeping = Keeping {
            tile: numbers(rect),
            canvas: self.canvas(),
            first_cell,
            exchange: u32::from(exchange),
        };
        let buffers = [&self.wet.pigments, &self.wet.vehicle, &store.pigments, &store.vehicle];
        let over = [groups(TILE), groups(TILE), 1];
        self.waiting.dispatch(&rest::KEEP, &keeping, &buffers, over);
        self.send_if_full()
    }

    /// Runs a kernel of drying between the wet paint and `layer`.
    fn with_dry(&mut self, kernel: &'static graphics::gpu::Kernel, layer: &Paint, drying: Drying) {
        let buffers =
            [&self.floor, &layer.pigments, &layer.vehicle, &self.wet.pigments, &self.wet.vehicle];
        let over = [groups(self.bounds.width), groups(self.bounds.height), 1];
        self.waiting.dispatch(kernel, &drying, &buffers, over);
    }

    fn empty_dry(&self) -> Result<Paint, DeviceError> {
        let cells = self.bounds.width * self.bounds.height;
        Ok(Paint::empty(&self.device, "a dry layer", cells)?)
    }
}

impl Engine for OnGpu {
    fn name(&self) -> String {
        let adapter = self.device.adapter();
        format!("{} ({})", adapter.name, adapter.backend)
    }

    fn bounds(&self) -> Rect {
        self.bounds
    }

    fn play(
        &mut self,
        brush: BrushId,
        motion: &Motion,
        contacts: &[Contact],
    ) -> Result<(), DeviceError> {
        for contact in contacts.iter().filter(|contact| !contact.rect.is_empty()) {
            self.step(brush, motion, contact)?;
        }
        Ok(())
    }

    fn add_brush(&mut self, width: usize, height: usize) -> Result<BrushId, DeviceError> {
        self.brushes.push(Head::new(&self.device, (width, height))?);
        Ok(BrushId(self.brushes.len() - 1))
    }

    fn brush(&mut self, brush: BrushId) -> Result<Layer, DeviceError> {
        self.send()?;
        let head = &self.brushes[brush.0];
        Ok(head.paint.read(&mut self.device, head.whole())?)
    }

    fn set_brush(&mut self, brush: BrushId, paint: &Layer) -> Result<(), DeviceError> {
        self.send()?;
        let head = &self.brushes[brush.0];
        assert_eq!((paint.width(), paint.height()), head.size, "the cells of {brush:?}");
        Ok(head.paint.write(&mut self.device, head.whole(), paint)?)
    }

    fn wet_in(&mut self, rect: Rect) -> Result<Layer, DeviceError> {
        self.send()?;
        let rows = self.rows(rect);
        Ok(self.wet.read(&mut self.device, rows)?)
    }

    fn set_wet_in(&mut self, rect: Rect, paint: &Layer) -> Result<(), DeviceError> {
        self.send()?;
        assert_eq!((paint.width(), paint.height()), (rect.width, rect.height), "cells of {rect:?}");
        let rows = self.rows(rect);
        Ok(self.wet.write(&mut self.device, rows, paint)?)
    }

    fn painted(&mut self) -> Result<TileSet, DeviceError> {
        let wet = self.wet()?;
        Ok(TileSet::with(self.bounds, |index| wet.cell(index).volume() > 0))
    }

    fn dry(&mut self, share: u32) -> Result<(), DeviceError> {
        assert!(share <= 65536, "a share of 65536 parts, found {share}");
        let layer = self.empty_dry()?;
        let drying = Drying { canvas: self.canvas(), parts: share, rise: 1 };
        self.with_dry(&rest::DRY, &layer, drying);
        self.dry.push(layer);
        self.send()
    }

    fn dry_count(&self) -> usize {
        self.dry.len()
    }

    fn dry_in(&mut self, index: usize, rect: Rect) -> Result<Layer, DeviceError> {
        self.send()?;
        let rows = self.rows(rect);
        Ok(self.dry[index].read(&mut self.device, rows)?)
    }

    fn push_dry(&mut self, layer: &Layer) -> Result<(), DeviceError> {
        assert_eq!((layer.width(), layer.height()), self.size(), "the cells of the canvas");
        self.send()?;
        let paint = self.empty_dry()?;
        paint.write(&mut self.device, (self.bounds, self.bounds.width), layer)?;
        let drying = Drying { canvas: self.canvas(), parts: 0, rise: 1 };
        self.with_dry(&rest::RAISE, &paint, drying);
        self.dry.push(paint);
        self.send()
    }

    fn pop_dry(&mut self) -> Result<Layer, DeviceError> {
        assert!(!self.dry.is_empty(), "a dry layer to take away, found none");
        let layer = self.dry_layer(self.dry.len() - 1)?;
        if let Some(paint) = self.dry.pop() {
            let drying = Drying { canvas: self.canvas(), parts: 0, rise: -1 };
            self.with_dry(&rest::RAISE, &paint, drying);
        }
        self.send()?;
        Ok(layer)
    }

    fn floor(&mut self) -> Result<Field<i32>, DeviceError> {
        self.send()?;
        let (width, height) = self.size();
        let values = self.device.read(&self.floor, Rows::start(width * height))?;
        Ok(Field::from_values(width, height, values))
    }

    fn save(&mut self, tile: Tile, slot: Slot) -> Result<(), DeviceError> {
        self.keep(tile, slot, false)
    }

    fn swap(&mut self, tile: Tile, slot: Slot) -> Result<(), DeviceError> {
        self.keep(tile, slot, true)
    }

    fn light(
        &mut self,
        view: View,
        scene: &Scene,
        baked: &TileSet,
        shown: &TileSet,
    ) -> Result<(), DeviceError> {
        self.light_tiles(view, scene, baked, shown)
    }

    fn picture_in(&mut self, view: View, rect: Rect) -> Result<Field<[f32; 4]>, DeviceError> {
        self.send()?;
        self.read_picture(view, rect)
    }

    fn forget_view(&mut self, view: View) {
        self.lit[view as usize] = None;
    }
}

fn numbers(rect: Rect) -> [u32; 4] {
    [rect.x, rect.y, rect.width, rect.height].map(|number| number as u32)
}

/// A contact that names cells which are not there is a bug of the caller.
fn check_contact(contact: &Contact, bounds: Rect, brush_cells: u32) {
    let Contact { rect, touches } = contact;
    assert_eq!(rect.intersection(bounds), *rect, "a contact within {bounds:?}");
    assert_eq!(touches.len(), rect.width * rect.height, "touches of a contact");
    let strays = |touch: &&Touch| touch.brush_cell >= brush_cells && touch.height < i32::MAX;
    let stray = touches.iter().find(strays);
    assert!(stray.is_none(), "cells of a head of {brush_cells}, found {stray:?}");
}
