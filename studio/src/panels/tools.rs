//! What the painter has in hand; no part of the painting.

use std::sync::Arc;

use session::Picked;

/// What the pen does on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mode {
    /// It leads the brush.
    #[default]
    Paint,
    /// It asks what lies there.
    Pick,
    /// It moves the view.
    Pan,
    /// It turns the view.
    Rotate,
    /// It zooms.
    Zoom,
    /// It squeezes paint of the chosen tube.
    Squeeze,
}

/// What the painter has in hand.
#[derive(Debug, Clone, PartialEq)]
pub struct Tools {
    /// What the pen does.
    pub mode: Mode,
    /// The name of the brush in hand.
    pub brush: String,
    /// The slot of the tube last chosen.
    pub tube: usize,
    /// Share of clear medium in what the brush takes up, 0..1.
    pub vehicle: f64,
    /// How high paint lies on the head after loading, in mm.
    pub load_mm: f64,
    /// The share of its paint that wiping leaves on a brush, 0..1.
    pub wipe_keep: f64,
    /// Cubic millimetres that one squeeze gives.
    pub squeeze_mm3: f64,
    /// The share that `dry` dries, 0..1.
    pub dry_share: f64,
    /// The eyedropper tells the mean over cells this near, in mm; 0 is one cell.
    pub pick_radius_mm: f64,
    /// What was last picked.
    pub picked: Option<Arc<Picked>>,
    /// A colour from the reference picture or a dropped swatch, linear sRGB.
    pub wanted: Option<[f64; 3]>,
    /// Where the two lights of the split view meet, as a share of the canvas's
    /// width.
    pub split: f32,
    /// Whether the figures are shown over the canvas.
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
            wanted: None,
            split: 0.5,
            figures: false,
        }
    }
}
