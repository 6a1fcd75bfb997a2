//! State of all panels.

use std::collections::BTreeMap;

use crate::arrangement::Arrangement;
use crate::panels::brushes::Brushes;
use crate::panels::eyedropper::Eyedropper;
use crate::panels::history::History;
use crate::panels::layers::Layers;
use crate::panels::light::LightPanel;
use crate::panels::reference::Reference;
use crate::panels::swatches::Swatches;
use crate::panels::tubes::Tubes;
use crate::panels::wheel::Wheel;

/// Panels of the columns at the sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tab {
    /// List of brushes, head and paint of the selected brush.
    Brush,
    /// Wet and dry paint.
    Layers,
    /// Illuminant, direction, gloss and second light.
    Light,
    /// Picked colour and recipes for it.
    Color,
    /// Colours that the tubes can mix.
    Wheel,
    /// Mixtures that the painter keeps.
    Swatches,
    /// List of actions.
    History,
    /// Numbered revisions of the painting.
    Files,
}

/// State of all panels, and where they stand.
#[derive(Debug, Default)]
pub struct Panels {
    /// State of the brush panel.
    pub brushes: Brushes,
    /// State of the tube panel beside the palette.
    pub tubes: Tubes,
    /// Eyedropper panel with recipe search.
    pub eyedropper: Eyedropper,
    /// Reference picture beside the canvas.
    pub reference: Reference,
    pub(in crate::app) wheel: Wheel,
    pub(super) swatches: Swatches,
    pub(super) layers: Layers,
    pub(in crate::app) light: LightPanel,
    pub(super) history: History,
    /// Columns, groups and tabs.
    pub(in crate::app) arrangement: Arrangement,
    /// Heights of the panels' contents in the last frame, in points.
    pub(super) content_heights: BTreeMap<Tab, f32>,
    /// Counter of selections, and its value when each panel was selected last.
    pub(super) uses: u64,
    pub(super) last_used: BTreeMap<Tab, u64>,
}
