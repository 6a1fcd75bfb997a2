//! Guides as data.

use graphics::camera::{Camera, Framing};

use super::error::{GuideFault, GuidesError};

/// Longest side of the picture in pixels.
const LONGEST_SIDE: u32 = 1 << 14;

/// Most pixels of the picture: a view of a model takes 16 bytes for each.
const MOST_PIXELS: u64 = 1 << 26;

/// Lines along which strokes run, drawn over one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Guides {
    /// Name of the file of the guides, for messages.
    pub file: String,
    /// File of the picture that they were drawn on, where it is known.
    pub picture: Option<String>,
    /// Width and height of that picture, 1 to 16384.
    pub size_px: [u32; 2],
    /// The camera of a view of a model, in degrees: around the model, above the horizon (-90 to
    /// 90), and of the field of view (1 to 170). `None` for other pictures.
    pub camera: Option<[f32; 3]>,
    /// The lines, each of two points or more in pixels from the upper left corner.
    pub lines: Vec<Vec<[f64; 2]>>,
}

impl Guides {
    /// Checks that the guides are on the picture.
    ///
    /// # Errors
    /// [`GuidesError`] with guide and point.
    pub fn check(&self) -> Result<(), GuidesError> {
        let [width, height] = self.size_px;
        let sides = 1..=LONGEST_SIDE;
        let pixels = u64::from(width) * u64::from(height);
        if !sides.contains(&width) || !sides.contains(&height) || pixels > MOST_PIXELS {
            return Err(GuidesError::Size { file: self.file.clone(), found: self.size_px });
        }
        if let Some(found @ [around, above, view]) = self.camera
            && !(around.is_finite() && above.abs() <= 90.0 && (1.0..=170.0).contains(&view))
        {
            return Err(GuidesError::Camera { file: self.file.clone(), found });
        }
        if self.lines.is_empty() {
            return Err(GuidesError::NoGuides { file: self.file.clone() });
        }
        self.lines.iter().enumerate().try_for_each(|(index, line)| {
            check_line(line, self.size_px).map_err(|fault| self.fault(index, fault))
        })
    }

    /// The camera from which a model of these vertices was drawn upon; `None` if the guides do not
    /// tell.
    #[must_use]
    pub fn camera_around(&self, positions: &[[f32; 3]]) -> Option<Camera> {
        let [azimuth_deg, elevation_deg, field_of_view_deg] = self.camera?;
        let [width, height] = self.size_px.map(|side| side.max(1) as f32);
        let framing =
            Framing { azimuth_deg, elevation_deg, field_of_view_deg, aspect: width / height };
        Some(framing.fit(positions))
    }

    /// The error that the guide of this index has a fault.
    pub(super) fn fault(&self, index: usize, fault: GuideFault) -> GuidesError {
        GuidesError::Guide { file: self.file.clone(), line: None, guide: index + 1, fault }
    }
}

fn check_line(points: &[[f64; 2]], size_px: [u32; 2]) -> Result<(), GuideFault> {
    if points.len() < 2 {
        return Err(GuideFault::FewPoints { found: points.len() });
    }
    for (&at, point) in points.iter().zip(1..) {
        if let Some(&value) = at.iter().find(|value| !value.is_finite()) {
            return Err(GuideFault::NotFinite { point, value });
        }
        let inside = |place: f64, side: u32| (0.0..f64::from(side)).contains(&place);
        if !inside(at[0], size_px[0]) || !inside(at[1], size_px[1]) {
            return Err(GuideFault::OffPicture { point, at, size_px });
        }
    }
    if points.iter().all(|point| *point == points[0]) {
        return Err(GuideFault::NoLength);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_fits_the_model_into_a_picture_of_that_shape() {
        let mut guides = Guides {
            file: "g.toml".to_owned(),
            picture: None,
            size_px: [800, 400],
            camera: None,
            lines: vec![vec![[1.0, 1.0], [2.0, 2.0]]],
        };
        let corners = [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]];
        assert_eq!(guides.camera_around(&corners), None);
        guides.camera = Some([30.0, 20.0, 40.0]);
        let wanted = Framing {
            azimuth_deg: 30.0,
            elevation_deg: 20.0,
            field_of_view_deg: 40.0,
            aspect: 2.0,
        };
        assert_eq!(guides.camera_around(&corners), Some(wanted.fit(&corners)));
    }
}
