//! Guides on a picture of any size.

use glam::DVec2;

use super::error::GuidesError;
use super::lines::Guides;
use super::walk::{Step, steps};

/// A place on a guide, and its direction there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuideSample {
    /// Column in pixels from the left edge.
    pub x: f64,
    /// Row in pixels from the upper edge.
    pub y: f64,
    /// Unit direction to the right and downwards, towards the last point of the line.
    pub along: [f64; 2],
}

impl Guides {
    /// Places along all guides, one after the other, in steps of at most 1 px of a picture of
    /// `width` x `height` pixels, to which the picture of the guides is scaled.
    ///
    /// # Errors
    /// [`GuidesError`] if the guides are not on their picture, see [`Self::check`].
    pub fn on_picture(&self, width: usize, height: usize) -> Result<Vec<GuideSample>, GuidesError> {
        self.check()?;
        let [own_width, own_height] = self.size_px.map(f64::from);
        let scale = DVec2::new(width as f64 / own_width, height as f64 / own_height);
        let steps = self.lines.iter().flat_map(|line| steps(line, scale));
        Ok(steps
            .map(|step: Step| GuideSample {
                x: step.at.x,
                y: step.at.y,
                along: step.along.to_array(),
            })
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_directions_are_scaled_with_the_picture() {
        let guides = Guides {
            file: "g.toml".to_owned(),
            picture: None,
            size_px: [100, 100],
            camera: None,
            lines: vec![vec![[10.0, 10.0], [40.0, 40.0]], vec![[50.0, 90.0], [50.0, 60.0]]],
        };
        let samples = guides.on_picture(200, 100).unwrap();
        // 60 x 30 px are 67.1 px long.
        assert_eq!(samples.len(), 68 + 30);
        let first = samples[0];
        assert!((first.x - 20.44).abs() < 0.01 && (first.y - 10.22).abs() < 0.01, "{first:?}");
        let [x, y] = first.along;
        assert!((y / x - 0.5).abs() < 1e-12 && (x.hypot(y) - 1.0).abs() < 1e-12, "{first:?}");
        let last = samples[97];
        assert_eq!((last.x, last.along), (100.0, [0.0, -1.0]));
        assert!((last.y - 60.5).abs() < 1e-9, "{last:?}");
        let off = Guides { size_px: [40, 100], ..guides };
        assert!(off.on_picture(200, 100).is_err(), "off its picture");
    }
}
