//! The picture that effects are applied to: flat colours, and where effects are weaker.

use rayon::prelude::*;
use spectra::color::Rgb;

use graphics::compute::{ColorImage, Compute, GreyImage};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::picture::Photograph;

/// An abstracted picture, with the controls of the effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Wash {
    /// Encoded sRGB in 0..1, then coverage: 1 where paint is, 0 on bare paper.
    pub color: Field<[f32; 4]>,
    /// Where effects are weaker.
    pub controls: Controls,
}

/// Factors of effects, 0 to 1 for each pixel, of the size of the picture. An effect without
/// a control is at its full strength everywhere.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Controls {
    /// Factor of the dry brush.
    pub dry_brush: Option<Field<f32>>,
    /// Factor of all changes of density.
    pub density: Option<Field<f32>>,
}

/// Mask pictures of any size, which are stretched over a painting: white where an effect is
/// at its full strength, black where there is none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Masks {
    /// Mask of the dry brush.
    pub dry_brush: Option<Photograph>,
    /// Mask of all changes of density.
    pub density: Option<Photograph>,
}

impl Masks {
    /// The controls of a picture of `width` x `height` pixels: the mean of red, green and
    /// blue of each mask, as encoded.
    #[must_use]
    pub fn controls(&self, width: usize, height: usize) -> Controls {
        let control = |mask: &Photograph| {
            let picture = mask.on_canvas(width, height);
            let values = picture
                .values()
                .par_iter()
                .map(|rgb: &[f32; 3]| {
                    let encoded = Rgb(rgb.map(f64::from)).encoded().0;
                    (encoded.iter().sum::<f64>() / 3.0) as f32
                })
                .collect();
            Field::from_values(width, height, values)
        };
        Controls {
            dry_brush: self.dry_brush.as_ref().map(control),
            density: self.density.as_ref().map(control),
        }
    }
}

/// A [`Wash`] in the memory of a [`Compute`].
#[derive(Debug, Clone)]
pub struct WashImages {
    /// Encoded sRGB and coverage.
    pub color: ColorImage,
    /// Factor of the dry brush, 0 to 1.
    pub dry_brush: Option<GreyImage>,
    /// Factor of all changes of density, 0 to 1.
    pub density: Option<GreyImage>,
}

impl Wash {
    /// Copies the wash into the memory of `compute`.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    pub fn upload(&self, compute: &mut Compute) -> Result<WashImages, DeviceError> {
        let color = compute.upload(&self.color)?;
        WashImages::new(compute, color, &self.controls)
    }
}

impl WashImages {
    /// A picture in the memory of `compute`, with controls that are copied there.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    pub fn new(
        compute: &mut Compute,
        color: ColorImage,
        controls: &Controls,
    ) -> Result<Self, DeviceError> {
        let mut grey =
            |field: &Option<_>| field.as_ref().map(|field| compute.upload(field)).transpose();
        let dry_brush = grey(&controls.dry_brush)?;
        let density = grey(&controls.density)?;
        Ok(Self { color, dry_brush, density })
    }
}
