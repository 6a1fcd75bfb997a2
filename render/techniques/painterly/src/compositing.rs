//! Frames for compositing: OpenEXR with cover, depth, height and direction.

use documents::hint::{Explain, Fault, Hint};
use graphics::camera::Camera;
use graphics::coherence::Projection;
use graphics::encoding::linear_from_encoded;
use graphics::export::{ExportError, float_exr};

use super::error::PainterError;
use super::painter::Painter;
use super::stages::strongest;

/// Width of a pixel in mm: 96 to the inch.
const PX_MM: f64 = 25.4 / 96.0;

/// A frame for compositing cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CompositingError {
    /// The subject cannot be painted.
    #[error(transparent)]
    Painter(#[from] PainterError),
    /// The file cannot be made.
    #[error(transparent)]
    Export(#[from] ExportError),
}

impl Explain for CompositingError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Painter(error) => error.hint(),
            Self::Export(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Painter(error) => error.fault(),
            Self::Export(error) => error.fault(),
        }
    }
}

impl Painter {
    /// The picture that [`Self::paint`] gives as an OpenEXR file of 32-bit floats: `R`, `G`, `B` in
    /// linear sRGB times the cover, `A` the cover, `Z` the distance of the subject in front of the eye
    /// (infinite where there is none), `height` of the brushwork in mm, and `direction.x`,
    /// `direction.y`, the unit direction of the strongest stroke of the uppermost layer that shows
    /// (x to the right, y downwards; 0 where there is none).
    ///
    /// # Errors
    /// Those of [`Self::paint`]; [`CompositingError::Export`] for pictures that OpenEXR cannot hold.
    pub fn exr_frame(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
    ) -> Result<Vec<u8>, CompositingError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        let painted = self.picture(depth.clone(), &layers)?;
        let projection = Projection::new(camera, size.0, size.1);
        let [_, _, back] = camera.axes();
        let distance = |index: usize| {
            let at = (index % size.0, index / size.0);
            match depth[at] < 1.0 {
                true => (camera.eye - projection.unproject(at, depth[at])).dot(back),
                false => f32::INFINITY,
            }
        };
        let mut directions = vec![[0.0; 2]; size.0 * size.1];
        for splats in &layers {
            let strongest = strongest(&depth, splats);
            for (direction, index) in directions.iter_mut().zip(strongest.values()) {
                if let Some(index) = index {
                    let (sin, cos) = splats[*index as usize].turn().sin_cos();
                    *direction = [cos, sin];
                }
            }
        }
        let linear = linear_from_encoded(&painted.color);
        let colors = |channel: usize| linear.values().iter().map(move |own| own[channel] * own[3]);
        let cover = linear.values().iter().map(|own| own[3]);
        let channels: [(&str, Vec<f32>); 8] = [
            ("R", colors(0).collect()),
            ("G", colors(1).collect()),
            ("B", colors(2).collect()),
            ("A", cover.collect()),
            ("Z", (0..size.0 * size.1).map(distance).collect()),
            ("height", painted.height_mm.values().to_vec()),
            ("direction.x", directions.iter().map(|[x, _]| *x).collect()),
            ("direction.y", directions.iter().map(|[_, y]| *y).collect()),
        ];
        let channels = channels.into_iter().map(|(name, values)| (name.to_owned(), values));
        Ok(float_exr(size, PX_MM, channels.collect())?)
    }
}
