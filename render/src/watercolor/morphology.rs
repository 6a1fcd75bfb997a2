//! Openings and closings with a round brush: details smaller than the brush go.
//!
//! Bousseau et al. 2006, section 4.1, after the morphology of Serra: an opening takes
//! away what is lighter than its surroundings and too small for the brush, a closing
//! what is darker. Each channel by itself, coverage too: bare paper must be white, then
//! specks of paint on paper go with the dark, and gaps in paint with the light.
//!
//! The brush is an octagon, the sum of a square and a diamond, each a sum of segments;
//! so a pass needs a few comparisons a pixel, whatever the radius. What is outside the
//! picture counts for nothing.

use super::octagon::{Brush, Extreme, extreme};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, groups, layout};
use graphics::image::Backend;
use graphics::image::OnCpu;
use graphics::image::{OnGpu, Plane};

/// Takes small details away. Least and greatest are exact: backends agree bit for bit.
pub trait Morphology: Backend {
    /// The least or greatest of each channel under the brush. The memory of `spare`,
    /// which is of the same size, may be used for it.
    ///
    /// # Errors
    /// [`DeviceError`] if the device has no room or is lost; never on the processor.
    fn extreme(
        &mut self,
        color: &Self::Color,
        brush: Brush,
        which: Extreme,
        spare: Option<Self::Color>,
    ) -> Result<Self::Color, DeviceError>;

    /// Without light details into which a brush of `radius_px` does not fit; with 0 as
    /// it is. Nowhere lighter than before; once more changes nothing.
    ///
    /// # Errors
    /// As [`Morphology::extreme`].
    fn opened(&mut self, color: &Self::Color, radius_px: u32) -> Result<Self::Color, DeviceError> {
        let brush = Brush::round(radius_px);
        let least = self.extreme(color, brush, Extreme::Least, None)?;
        self.extreme(&least, brush, Extreme::Greatest, None)
    }

    /// Without dark details into which the brush does not fit. Nowhere darker than
    /// before; once more changes nothing.
    ///
    /// # Errors
    /// As [`Morphology::extreme`].
    fn closed(&mut self, color: &Self::Color, radius_px: u32) -> Result<Self::Color, DeviceError> {
        let brush = Brush::round(radius_px);
        let greatest = self.extreme(color, brush, Extreme::Greatest, None)?;
        self.extreme(&greatest, brush, Extreme::Least, None)
    }

    /// Opened, then closed.
    ///
    /// # Errors
    /// As [`Morphology::extreme`].
    fn smoothed(
        &mut self,
        color: &Self::Color,
        radius_px: u32,
    ) -> Result<Self::Color, DeviceError> {
        let brush = Brush::round(radius_px);
        let least = self.extreme(color, brush, Extreme::Least, None)?;
        // The last pass of the opening and the first of the closing are one.
        let greatest = self.extreme(&least, brush.twice(), Extreme::Greatest, None)?;
        self.extreme(&greatest, brush, Extreme::Least, Some(least))
    }
}

impl Morphology for OnCpu {
    fn extreme(
        &mut self,
        color: &Self::Color,
        brush: Brush,
        which: Extreme,
        spare: Option<Self::Color>,
    ) -> Result<Self::Color, DeviceError> {
        let fresh = || Field::filled(color.width(), color.height(), [0.0; 4]);
        let mut result = spare.unwrap_or_else(fresh);
        extreme(color, brush, which, &mut result);
        Ok(result)
    }
}

/// What the kernel is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Crossing {
    size: [i32; 2],
    margin_in: i32,
    margin_out: i32,
    along: [i32; 2],
    across: [i32; 2],
    reach_along: i32,
    reach_across: i32,
    greatest: u32,
    spare: u32,
}

/// The least or greatest on two segments that cross.
pub(super) static CROSSING: Kernel = Kernel {
    name: "crossing",
    source: include_str!("morphology.wgsl"),
    parameters: layout!(Crossing {
        size,
        margin_in,
        margin_out,
        along,
        across,
        reach_along,
        reach_across,
        greatest,
        spare,
    }),
    structs: &[],
    storage: &[Storage::Read, Storage::Write],
};

impl Morphology for OnGpu {
    fn extreme(
        &mut self,
        color: &Plane,
        brush: Brush,
        which: Extreme,
        _: Option<Plane>,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = (color.width(), color.height());
        let crossings = brush.crossings();
        // Segments between may lie outside of the picture.
        let margin = brush.reach() as usize;
        let mut current = color.clone();
        let mut margin_in = 0;
        for (i, crossing) in crossings.iter().enumerate() {
            let margin_out = if i + 1 == crossings.len() { 0 } else { margin };
            let [out_width, out_height] = [width, height].map(|side| side + 2 * margin_out);
            let out = self.plane(out_width, out_height, size_of::<[f32; 4]>())?;
            let parameters = Crossing {
                size: [width as i32, height as i32],
                margin_in: margin_in as i32,
                margin_out: margin_out as i32,
                along: crossing.along,
                across: crossing.across,
                reach_along: crossing.reach_along as i32,
                reach_across: crossing.reach_across as i32,
                greatest: u32::from(which == Extreme::Greatest),
                spare: 0,
            };
            self.recording.dispatch(
                &CROSSING,
                &parameters,
                &[current.buffer(), out.buffer()],
                [groups(out_width), groups(out_height), 1],
            );
            (current, margin_in) = (out, margin_out);
        }
        Ok(current)
    }
}
