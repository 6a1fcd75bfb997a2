//! Selected tool and tool settings, which are not part of the painting.

use std::sync::Arc;

use session::Picked;

/// Tool: the effect of the pen on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mode {
    /// Paints with the brush.
    #[default]
    Paint,
    /// Picks colour and paint (eyedropper).
    Pick,
    /// Moves the view.
    Pan,
    /// Rotates the view.
    Rotate,
    /// Zooms the view.
    Zoom,
    /// Squeezes paint from the selected tube.
    Squeeze,
}

/// Selected tool, brush and tube, and their settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Tools {
    /// Tool selected in the toolbar.
    pub mode: Mode,
    /// Name of the selected brush.
    pub brush: String,
    /// Slot of the selected tube.
    pub tube: usize,
    /// Share of clear medium in a load of the brush, 0 to 1.
    pub vehicle: f64,
    /// Height of the paint that one load adds to the brush head, in mm.
    pub load_mm: f64,
    /// Share of the brush's paint that remains after wiping, 0 to 1.
    pub wipe_keep: f64,
    /// Volume of one squeeze, in cubic mm.
    pub squeeze_mm3: f64,
    /// Share of the wet paint that one drying action dries, 0 to 1.
    pub dry_share: f64,
    /// Radius of the disc that the eyedropper averages, in mm; 0 is one cell.
    pub pick_radius_mm: f64,
    /// Last result of the eyedropper.
    pub picked: Option<Arc<Picked>>,
    /// Colour picked from the reference picture, linear sRGB.
    pub reference_color: Option<[f64; 3]>,
    /// Position of the boundary between the two lights of the split view, as a share of the
    /// canvas width, 0 (left) to 1 (right).
    pub split: f32,
    /// Whether the performance figures are shown over the canvas.
    pub figures: bool,
}

impl Default for Tools {
    fn default() -> Self {
        Self {
            mode: Mode::Paint,
            brush: "round".to_owned(),
            tube: 0,
            vehicle: 0.15,
            load_mm: 0.3,
            wipe_keep: 0.3,
            squeeze_mm3: 60.0,
            dry_share: 1.0,
            pick_radius_mm: 0.5,
            picked: None,
            reference_color: None,
            split: 0.5,
            figures: false,
        }
    }
}
