//! Selected tool and tool settings, which are not part of the painting.

use std::sync::Arc;

use paint::strokes::{Recipe, StrokeTool};
use serde::Serialize;
use session::Picked;

/// Tool: the effect of the pen on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
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
    /// Softens and mixes wet paint with the clean head of the brush.
    Blend,
    /// Scrapes wet paint off with the head of the brush.
    Scrape,
    /// Rubs wet paint off with the head of the brush.
    Erase,
    /// Draws the polygon or the rectangle that a mask leaves open.
    Mask,
}

impl Mode {
    /// Whether the pen moves the head of a brush.
    #[must_use]
    pub fn moves_head(self) -> bool {
        matches!(self, Self::Paint | Self::Blend | Self::Scrape | Self::Erase)
    }
}

impl Mode {
    /// All tools.
    const ALL: [Self; 10] = [
        Self::Paint,
        Self::Blend,
        Self::Scrape,
        Self::Erase,
        Self::Mask,
        Self::Pick,
        Self::Pan,
        Self::Rotate,
        Self::Zoom,
        Self::Squeeze,
    ];

    /// Name of the tool in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Paint => "paint",
            Self::Blend => "blend",
            Self::Scrape => "scrape",
            Self::Erase => "erase",
            Self::Mask => "mask",
            Self::Pick => "pick",
            Self::Pan => "pan",
            Self::Rotate => "rotate",
            Self::Zoom => "zoom",
            Self::Squeeze => "squeeze",
        }
    }

    /// The tool with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mode| mode.name() == name)
    }
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
    /// How much blending mixes and moves the paint, above 0 to 1.
    pub blend_strength: f64,
    /// Height of the scraper over the ground at pressure 0, in mm.
    pub scrape_mm: f64,
    /// How much erasing takes, above 0 to 1.
    pub erase_strength: f64,
    /// Radius of the disc that the eyedropper averages, in mm; 0 is one cell.
    pub pick_radius_mm: f64,
    /// Mixtures of two pigments and more that brushes were loaded with, with their share of medium,
    /// the latest first.
    pub recent: Vec<(Recipe, f64)>,
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
            blend_strength: 0.5,
            scrape_mm: 0.0,
            erase_strength: 0.5,
            pick_radius_mm: 0.5,
            recent: Vec::new(),
            picked: None,
            reference_color: None,
            split: 0.5,
            figures: false,
        }
    }
}

impl Tools {
    /// The tool that the head of a brush is used as in a mode; it paints in modes without a head.
    #[must_use]
    pub fn stroke_tool(&self, mode: Mode) -> StrokeTool {
        match mode {
            Mode::Blend => StrokeTool::Blend { strength: self.blend_strength },
            Mode::Scrape => StrokeTool::Scrape { height_mm: self.scrape_mm },
            Mode::Erase => StrokeTool::Erase { strength: self.erase_strength },
            _ => StrokeTool::Paint,
        }
    }
}
