//! What a backend does: it holds the paint, moves it, and shows it.
//!
//! Everything that is decided (where the brush is, which tiles an undo needs,
//! which light shines) is decided above, once; a backend only carries it out.
//! Two implement it, [`crate`]'s CPU and GPU.

use super::contact::Contact;
use super::motion::Motion;
use crate::layer::Layer;
use crate::optics::Scene;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::tile::{Rect, Tile, TileSet};

/// The paint on the head of one brush.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BrushId(pub usize);

/// A place where a tile is kept for undo.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Slot(pub usize);

/// One of the pictures that a backend keeps, each under a light of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum View {
    /// The picture.
    First,
    /// The same paint under a second light.
    Second,
}

/// A backend: the paint of one painting.
///
/// Amounts are integers and every change is exact, so all backends hold the same
/// bits after the same calls. Rectangles, tiles and indices are those of the
/// canvas; a caller who names others has a bug, and the call panics.
pub trait Engine: std::fmt::Debug + Send {
    /// What computes, in words for people.
    fn name(&self) -> String;

    /// The cells of the canvas.
    fn bounds(&self) -> Rect;

    /// Plays sub-steps of one brush, in order.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn play(
        &mut self,
        brush: BrushId,
        motion: &Motion,
        contacts: &[Contact],
    ) -> Result<(), DeviceError>;

    /// A new brush whose head has `width` x `height` cells, without paint.
    ///
    /// # Errors
    /// [`DeviceError`] if it does not fit the device.
    fn add_brush(&mut self, width: usize, height: usize) -> Result<BrushId, DeviceError>;

    /// The paint on a brush.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn brush(&mut self, brush: BrushId) -> Result<Layer, DeviceError>;

    /// Puts `paint` on a brush, in place of what it had.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn set_brush(&mut self, brush: BrushId, paint: &Layer) -> Result<(), DeviceError>;

    /// The wet paint.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn wet(&mut self) -> Result<Layer, DeviceError> {
        self.wet_in(self.bounds())
    }

    /// The wet paint in `rect`; costs what `rect` holds.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn wet_in(&mut self, rect: Rect) -> Result<Layer, DeviceError>;

    /// Puts `paint` on the canvas in place of the wet paint there.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn set_wet(&mut self, paint: &Layer) -> Result<(), DeviceError> {
        self.set_wet_in(self.bounds(), paint)
    }

    /// Puts `paint` in place of the wet paint in `rect`; costs what `rect` holds.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn set_wet_in(&mut self, rect: Rect, paint: &Layer) -> Result<(), DeviceError>;

    /// The tiles that have wet paint.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn painted(&mut self) -> Result<TileSet, DeviceError>;

    /// Dries `share` of 65536 parts of all wet paint, from the bottom: it
    /// becomes the topmost dry layer.
    ///
    /// # Errors
    /// [`DeviceError`] if there is no memory for it.
    fn dry(&mut self, share: u32) -> Result<(), DeviceError>;

    /// How many dry layers there are.
    fn dry_count(&self) -> usize;

    /// A dry layer, counted from the lowest.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn dry_layer(&mut self, index: usize) -> Result<Layer, DeviceError> {
        self.dry_in(index, self.bounds())
    }

    /// A dry layer in `rect`; costs what `rect` holds.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn dry_in(&mut self, index: usize, rect: Rect) -> Result<Layer, DeviceError>;

    /// Puts a dry layer on top.
    ///
    /// # Errors
    /// [`DeviceError`] if there is no memory for it.
    fn push_dry(&mut self, layer: &Layer) -> Result<(), DeviceError>;

    /// Takes the topmost dry layer away.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn pop_dry(&mut self) -> Result<Layer, DeviceError>;

    /// The height of ground and dry paint, in quanta over the plane of the
    /// canvas.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn floor(&mut self) -> Result<Field<i32>, DeviceError>;

    /// Keeps the wet paint of a tile in `slot`.
    ///
    /// # Errors
    /// [`DeviceError`] if there is no memory for it.
    fn save(&mut self, tile: Tile, slot: Slot) -> Result<(), DeviceError>;

    /// Exchanges the wet paint of a tile with what `slot` keeps.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn swap(&mut self, tile: Tile, slot: Slot) -> Result<(), DeviceError>;

    /// Computes the light of a view anew: of `baked` tiles everything, of `shown`
    /// tiles only the wet layer over what is baked; costs what they hold. A
    /// change of `scene` other than of its lamp wants all tiles baked.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost, or has no memory for the view.
    fn light(
        &mut self,
        view: View,
        scene: &Scene,
        baked: &TileSet,
        shown: &TileSet,
    ) -> Result<(), DeviceError>;

    /// The picture as last computed: linear sRGB, white at 1, and 1.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn picture(&mut self) -> Result<Field<[f32; 4]>, DeviceError> {
        self.picture_in(View::First, self.bounds())
    }

    /// A view as last computed, in `rect`; costs what `rect` holds.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    fn picture_in(&mut self, view: View, rect: Rect) -> Result<Field<[f32; 4]>, DeviceError>;

    /// Gives the memory of a view back; all of its tiles are baked before it is
    /// shown again.
    fn forget_view(&mut self, view: View);
}
