//! Pictures with the processor.

use super::backend::Backend;
use crate::field::Field;
use crate::gpu::DeviceError;

/// The processor: rows of pixels on all cores.
#[derive(Debug, Default)]
pub struct OnCpu;

impl Backend for OnCpu {
    type Color = Field<[f32; 4]>;
    type Grey = Field<f32>;

    fn name(&self) -> String {
        "cpu".to_owned()
    }

    fn color_of(&mut self, field: &Field<[f32; 4]>) -> Result<Self::Color, DeviceError> {
        Ok(field.clone())
    }

    fn grey_of(&mut self, field: &Field<f32>) -> Result<Self::Grey, DeviceError> {
        Ok(field.clone())
    }

    fn color_field(&mut self, color: &Self::Color) -> Result<Field<[f32; 4]>, DeviceError> {
        Ok(color.clone())
    }

    fn grey_field(&mut self, grey: &Self::Grey) -> Result<Field<f32>, DeviceError> {
        Ok(grey.clone())
    }
}
