//! Direction of the strokes of a passage.

use graphics::field::Field;

use super::traits::RegionTraits;

/// Coherence below which a passage has no direction.
const LEAST_COHERENCE: f64 = 0.2;

/// Direction of the strokes of a passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeDirection {
    /// Angle of the strokes in degrees, 0 to 180: 0 along x, 90 along y, growing from x (right) to
    /// y (down).
    pub degrees: f64,
    /// Share of the strong gradients that agree in direction, 0 to 1.
    pub coherence: f64,
    /// Whether the passage is turned until its strokes run along y. It is not if the coherence is
    /// below 0.2.
    pub turned: bool,
}

impl StrokeDirection {
    /// Direction of the strokes among `pixels`, whose depth inside the passage is `depth`.
    pub(super) fn of(
        pixels: &[u32],
        depth: &Field<u32>,
        intensity: &Field<f32>,
        gradient: &Field<[f32; 2]>,
    ) -> Self {
        let traits = RegionTraits::of(pixels, depth, intensity, gradient);
        let coherence = traits.coherence();
        let degrees = traits.angle().to_degrees();
        Self { degrees, coherence, turned: coherence >= LEAST_COHERENCE }
    }

    /// Unit vector along the strokes; y for a passage that is not turned.
    pub(super) fn along(&self) -> [f64; 2] {
        if !self.turned {
            return [0.0, 1.0];
        }
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        [cos, sin]
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_up::{Brush, Texture, textured};
    use super::super::perceived::{gradient_of, intensity_of};
    use super::super::regions::Regions;
    use super::*;

    fn direction_of(texture: Texture) -> StrokeDirection {
        let intensity = intensity_of(&textured(160, 120, 5, &[texture], |_, _| 0));
        let whole = Regions { labels: Field::filled(160, 120, 0), count: 1 };
        let pixels: Vec<u32> = (0..160 * 120).collect();
        StrokeDirection::of(&pixels, &whole.depths(), &intensity, &gradient_of(&intensity))
    }

    #[test]
    fn strokes_have_their_direction_within_2_degrees() {
        for brush in Brush::ALL.into_iter().filter(|brush| brush.has_direction()) {
            for degrees in [0.0, 30.0, 75.0, 120.0, 179.0] {
                let texture = Texture { brush, degrees, ..Texture::default() };
                let found = direction_of(texture);
                let off = (found.degrees - degrees).abs();
                let off = off.min(180.0 - off);
                assert!(off < 2.0, "{brush:?} at {degrees}: {found:?}");
                assert!(found.turned, "{brush:?} at {degrees}: {found:?}");
            }
        }
    }

    #[test]
    fn specks_are_not_turned() {
        let found = direction_of(Texture { brush: Brush::Specks, ..Texture::default() });
        assert!(!found.turned && found.coherence < 0.2, "{found:?}");
        assert_eq!(found.along(), [0.0, 1.0]);
    }
}
