//! A brush with little water: it touches the heights of the paper, and the
//! hollows stay bare.
//!
//! Bousseau et al. 2006, section 3.2: a threshold of the paper's height. Paint
//! fades out over a small band below the threshold, so that its edge has no
//! steps.

use rayon::prelude::*;

use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, groups, layout};
use graphics::image::Backend;
use graphics::image::OnCpu;
use graphics::image::{OnGpu, Plane};
use graphics::lanes::{greater, lesser};

/// Where a dry brush leaves paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DryBrushReach {
    /// The height from which on paint is whole.
    pub threshold: f32,
    /// Below it paint fades out over this much height; above 0.
    pub softness: f32,
    /// How much of it is kept to patches, 0..1: at 0 it is dry everywhere, at 1 only
    /// where the wash flows thinly.
    pub patches: f32,
}

/// Flow from which on a wash is not thin, and how far below it is altogether.
const THIN: f32 = 0.35;
const THINNER: f32 = 0.15;

impl DryBrushReach {
    /// What stays of the paint at `height`. A mask lowers the threshold: 0 leaves
    /// all paint.
    #[inline(always)]
    pub(super) fn kept(self, height: f32, flow: f32, mask: f32) -> f32 {
        let thin = lesser(greater((THIN - flow) / THINNER, 0.0), 1.0);
        let dry = mask * (1.0 - self.patches * (1.0 - thin));
        let above = (height - self.threshold * dry) / self.softness;
        lesser(greater(1.0 + above, 0.0), 1.0)
    }
}

/// Dry brushes.
pub trait DryBrush: Backend {
    /// `color` with the coverage that the brush leaves on paper of `heights`, 0..1,
    /// and of a wash of this `flow`; `mask`, 0..1, tells where the brush is dry. A threshold of 0 changes nothing.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    ///
    /// # Panics
    /// If sizes differ.
    fn dry_brushed(
        &mut self,
        color: Self::Color,
        heights: &Self::Grey,
        flow: &Self::Grey,
        reach: DryBrushReach,
        mask: Option<&Self::Grey>,
    ) -> Result<Self::Color, DeviceError>;
}

impl DryBrush for OnCpu {
    fn dry_brushed(
        &mut self,
        mut color: Field<[f32; 4]>,
        heights: &Field<f32>,
        flow: &Field<f32>,
        reach: DryBrushReach,
        mask: Option<&Field<f32>>,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let (width, height) = (color.width(), color.height());
        for grey in [heights, flow].into_iter().chain(mask) {
            assert_eq!((grey.width(), grey.height()), (width, height), "the paper's size");
        }
        if reach.threshold <= 0.0 || width == 0 {
            return Ok(color);
        }
        color.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, colors)| {
            let mask = mask.map(|mask| mask.row(y, 0, width));
            let paper = heights.row(y, 0, width).iter().zip(flow.row(y, 0, width));
            for (x, (color, (&height, &flow))) in colors.iter_mut().zip(paper).enumerate() {
                color[3] *= reach.kept(height, flow, mask.map_or(1.0, |mask| mask[x]));
            }
        });
        Ok(color)
    }
}

/// What the kernel is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct DryBrushNow {
    size: [u32; 2],
    threshold: f32,
    softness: f32,
    masked: u32,
    patches: f32,
    thin: f32,
    thinner: f32,
}

pub(super) static DRY_BRUSH: Kernel = Kernel {
    name: "watercolor_dry_brush",
    source: include_str!("dry_brush.wgsl"),
    parameters: layout!(DryBrushNow { size, threshold, softness, masked, patches, thin, thinner }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Read, Storage::Read, Storage::Write],
};

impl DryBrush for OnGpu {
    fn dry_brushed(
        &mut self,
        color: Plane,
        heights: &Plane,
        flow: &Plane,
        reach: DryBrushReach,
        mask: Option<&Plane>,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = (color.width(), color.height());
        for grey in [heights, flow].into_iter().chain(mask) {
            assert_eq!((grey.width(), grey.height()), (width, height), "the paper's size");
        }
        if reach.threshold <= 0.0 {
            return Ok(color);
        }
        let brushed = self.plane(width, height, size_of::<[f32; 4]>())?;
        let now = DryBrushNow {
            size: [width as u32, height as u32],
            threshold: reach.threshold,
            softness: reach.softness,
            masked: u32::from(mask.is_some()),
            patches: reach.patches,
            thin: THIN,
            thinner: THINNER,
        };
        let mask = mask.unwrap_or(heights);
        let buffers = [&color, heights, flow, mask, &brushed].map(Plane::buffer);
        self.recording.dispatch(&DRY_BRUSH, &now, &buffers, [groups(width), groups(height), 1]);
        Ok(brushed)
    }
}
