//! Pictures with the processor.

use super::backend::Backend;
use crate::field::Field;
use crate::gpu::GpuError;

/// The processor: rows of pixels on all cores.
#[derive(Debug, Default)]
pub struct OnCpu;

impl Backend for OnCpu {
    type Colour = Field<[f32; 4]>;
    type Grey = Field<f32>;

    fn name(&self) -> String {
        "cpu".to_owned()
    }

    fn colour_of(&mut self, field: &Field<[f32; 4]>) -> Result<Self::Colour, GpuError> {
        Ok(field.clone())
    }

    fn grey_of(&mut self, field: &Field<f32>) -> Result<Self::Grey, GpuError> {
        Ok(field.clone())
    }

    fn colour_field(&mut self, colour: &Self::Colour) -> Result<Field<[f32; 4]>, GpuError> {
        Ok(colour.clone())
    }

    fn grey_field(&mut self, grey: &Self::Grey) -> Result<Field<f32>, GpuError> {
        Ok(grey.clone())
    }
}
