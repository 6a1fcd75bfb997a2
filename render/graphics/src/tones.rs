//! Tone ramp of toon shading: which grey each amount of light becomes.

use std::path::Path;

use documents::hint::Explain;

use crate::picture_formats::{NAMES, small_picture};

/// Number of samples of a [`ToneRamp`], joined by straight lines.
pub const TONES: usize = 256;

/// One-dimensional texture that maps the cosine between light and surface normal to a grey (Lake,
/// Marshall, Harris and Blackstein, "Stylized rendering techniques for scalable real-time 3D
/// animation", 2000). Grey 0.5 keeps the surface colour. Darker means denser paint, lighter
/// thinner paint.
#[derive(Debug, Clone, PartialEq)]
pub struct ToneRamp {
    greys: Box<[f32; TONES]>,
}

impl ToneRamp {
    /// A staircase of `levels` equal steps from grey 0 (shade) to 1 (light). If you ask for one
    /// level, it is 0.5 throughout. Each step blends into the next over the share `softness`
    /// (0..1) of its width.
    #[must_use]
    pub fn steps(levels: usize, softness: f32) -> Self {
        let levels = levels.max(1) as f32;
        Self::from_curve(|cosine| {
            // Position and nearest edge, in steps.
            let at = cosine * levels;
            let edge = at.round().clamp(1.0, (levels - 1.0).max(1.0));
            let across = match softness > 0.0 {
                true => ((at - edge) / softness + 0.5).clamp(0.0, 1.0),
                false => f32::from(u8::from(at >= edge)),
            };
            let step = edge - 1.0 + across * across * (3.0 - 2.0 * across);
            if levels > 1.0 { step / (levels - 1.0) } else { 0.5 }
        })
    }

    /// A ramp through the given greys (0..1), at equal cosine intervals from shade (0) to light
    /// (1).
    ///
    /// # Errors
    /// [`ToneRampError::Empty`], [`ToneRampError::OutOfRange`].
    pub fn from_greys(greys: &[f32]) -> Result<Self, ToneRampError> {
        if greys.is_empty() {
            return Err(ToneRampError::Empty);
        }
        if let Some(index) = greys.iter().position(|grey| !(0.0..=1.0).contains(grey)) {
            return Err(ToneRampError::OutOfRange { index, grey: greys[index] });
        }
        let last = greys.len() - 1;
        Ok(Self::from_curve(|cosine| {
            let at = cosine * last as f32;
            let below = (at as usize).min(last);
            let above = (below + 1).min(last);
            greys[below] + (greys[above] - greys[below]) * (at - below as f32)
        }))
    }

    /// Reads a ramp from the middle row of a picture (PNG, JPEG, TIFF or WebP), shade at the left.
    /// We take the mean of the encoded channels as the grey.
    ///
    /// # Errors
    /// [`ToneRampError::NoPicture`] with the path.
    pub fn open(path: &Path) -> Result<Self, ToneRampError> {
        fn rejected(reason: String, path: &Path) -> ToneRampError {
            ToneRampError::NoPicture { name: path.display().to_string(), reason }
        }
        let bytes =
            documents::file::disk::read(path).map_err(|error| rejected(error.to_string(), path))?;
        let picture = small_picture(&bytes).map_err(|reason| rejected(reason, path))?;
        let row = picture.crop_imm(0, picture.height() / 2, picture.width(), 1).into_rgb16();
        Self::from_greys(
            &row.pixels()
                .map(|pixel: &image::Rgb<u16>| {
                    let sum: f32 = pixel.0.iter().map(|&value| f32::from(value)).sum();
                    sum / (3.0 * f32::from(u16::MAX))
                })
                .collect::<Vec<_>>(),
        )
    }

    fn from_curve(grey: impl Fn(f32) -> f32) -> Self {
        let greys = std::array::from_fn(|i| grey(i as f32 / (TONES - 1) as f32));
        Self { greys: Box::new(greys) }
    }

    /// Grey at a cosine. Negative cosines count as 0.
    #[must_use]
    #[inline]
    pub fn grey(&self, cosine: f32) -> f32 {
        let at = cosine.clamp(0.0, 1.0) * (TONES - 1) as f32;
        let below = (at as usize).min(TONES - 2);
        let [low, high] = [self.greys[below], self.greys[below + 1]];
        low + (high - low) * (at - below as f32)
    }

    /// Greys at [`TONES`] equal cosine intervals from 0 (shade) to 1 (light).
    #[must_use]
    pub fn greys(&self) -> &[f32; TONES] {
        &self.greys
    }
}

/// A tone ramp cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ToneRampError {
    /// The list of greys is empty.
    #[error("a tone ramp has at least one grey, found `0`")]
    #[hint("give greys from 0 (black, dense paint) to 1 (white, thin paint)")]
    Empty,
    /// A grey is outside 0..1.
    #[error("grey {index} of the tone ramp is not within 0 to 1: `{grey}`")]
    #[hint("give greys from 0 (black, dense paint) to 1 (white, thin paint)")]
    OutOfRange {
        /// Index of the grey, from 0.
        index: usize,
        /// Value of the grey.
        grey: f32,
    },
    /// The file is not a picture that can be read.
    #[error("{name}: {reason}")]
    #[hint("give a picture ({NAMES}) whose middle row runs from shade to light")]
    NoPicture {
        /// Path of the file.
        name: String,
        /// Reason given by the decoder.
        reason: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_flat_in_the_middle_and_rise_from_black_to_white() {
        for levels in 2..7 {
            let tones = ToneRamp::steps(levels, 0.3);
            for step in 0..levels {
                let wanted = step as f32 / (levels - 1) as f32;
                for inside in [0.3, 0.5, 0.7] {
                    let found = tones.grey((step as f32 + inside) / levels as f32);
                    assert!((found - wanted).abs() < 1e-4, "{levels} {step}: {found}");
                }
            }
            assert!(tones.greys().is_sorted(), "{levels}");
            assert_eq!((tones.grey(-1.0), tones.grey(2.0)), (0.0, 1.0));
        }
        assert!(ToneRamp::steps(1, 0.5).greys().iter().all(|&grey| grey == 0.5));
        let hard = ToneRamp::steps(4, 0.0);
        let greys = hard.greys().iter().map(|&grey| (grey * 3.0).fract());
        assert!(greys.fold(0.0, f32::max) < 1e-5);
    }

    #[test]
    fn greys_are_joined_by_straight_lines_and_bad_ones_refused() {
        let tones = ToneRamp::from_greys(&[0.2, 0.8, 0.4]).unwrap();
        for (cosine, wanted) in [(0.0, 0.2), (0.25, 0.5), (0.5, 0.8), (0.75, 0.6), (1.0, 0.4)] {
            assert!((tones.grey(cosine) - wanted).abs() < 5e-3, "{cosine}");
        }
        assert_eq!(ToneRamp::from_greys(&[]), Err(ToneRampError::Empty));
        let error = ToneRamp::from_greys(&[0.5, f32::NAN]).unwrap_err();
        assert!(matches!(error, ToneRampError::OutOfRange { index: 1, .. }), "{error}");
        assert!(ToneRamp::open(Path::new("no/such.png")).is_err());
    }
}
