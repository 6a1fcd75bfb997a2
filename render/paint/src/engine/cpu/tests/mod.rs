//! Tests of the paint engine on the CPU.

mod motion;
mod rest;

use super::CpuPaint;
use crate::engine::View;
use crate::layer::Layer;
use graphics::field::Field;

/// Operations on the whole canvas, as [`crate::engine::PaintEngine`] has them.
impl CpuPaint {
    fn wet(&self) -> Layer {
        self.wet_in(self.bounds())
    }

    fn set_wet(&mut self, layer: &Layer) {
        self.set_wet_in(self.bounds(), layer);
    }

    fn dry_layer(&self, index: usize) -> Layer {
        self.dry_layer_in(index, self.bounds())
    }

    fn picture(&mut self) -> Field<[f32; 4]> {
        self.picture_in(View::First, self.bounds())
    }
}
