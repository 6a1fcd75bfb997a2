//! The mask of a canvas on the device.

use super::buffers::mask_start;
use super::gpu_paint::GpuPaint;
use crate::mask::Mask;
use graphics::gpu::{DeviceError, Rows};

impl GpuPaint {
    /// Covers cells of the canvas, or none.
    pub(crate) fn set_mask(&mut self, mask: Option<&Mask>) -> Result<(), DeviceError> {
        self.submit()?;
        let Some(mask) = mask else {
            self.mask = [0; 4];
            return Ok(());
        };
        let start = mask_start(self.bounds);
        let rows = Rows { first: start, ..Rows::start(mask.words().len()) };
        self.device.write(&self.floor, rows, mask.words())?;
        self.mask = [start as u32, 0, 0, 0];
        Ok(())
    }
}
