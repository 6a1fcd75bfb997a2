//! The side panel at the right: one group of tabs, or two in a tall window.

use eframe::egui::{Button, CornerRadius, Panel, RichText, ScrollArea, Ui, vec2};

use crate::files::Files;
use crate::panels::brushes::Brushes;
use crate::panels::eyedropper::Eyedropper;
use crate::panels::history::History;
use crate::panels::layers::Layers;
use crate::panels::light::LightPanel;
use crate::panels::reference::Reference;
use crate::panels::tubes::Tubes;
use crate::panels::{PanelContext, revisions};
use crate::theme;

/// Minimum height for two groups of tabs, in points.
const TWO_GROUPS_HEIGHT: f32 = 860.0;

/// Tabs of the side panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tab {
    /// List of brushes, head and paint of the selected brush.
    Brush,
    /// Wet and dry paint.
    Layers,
    /// Illuminant, direction, gloss and second light.
    Light,
    /// Picked colour and recipes for it.
    Color,
    /// List of actions.
    History,
    /// Numbered revisions of the painting.
    Files,
}

impl Tab {
    /// Tabs of the upper group: needed while painting.
    const UPPER: [Self; 2] = [Self::Brush, Self::Layers];

    /// Tabs of the lower group: looked at occasionally.
    const LOWER: [Self; 4] = [Self::Light, Self::Color, Self::History, Self::Files];

    /// Name of the tab.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Brush => "Brush",
            Self::Layers => "Layers",
            Self::Light => "Light",
            Self::Color => "Colour",
            Self::History => "History",
            Self::Files => "Files",
        }
    }

    fn description(self) -> &'static str {
        match self {
            Self::Brush => "List of brushes, head and paint of the selected brush",
            Self::Layers => "Wet and dry paint",
            Self::Light => "The light, the gloss, and a second light to compare",
            Self::Color => "Colour and paint picked by the eyedropper, and recipes for a colour",
            Self::History => "List of actions, to undo and redo",
            Self::Files => "Numbered revisions of the painting",
        }
    }
}

/// State of all panels, and which tabs are selected.
#[derive(Debug)]
pub struct Panels {
    /// State of the brush panel.
    pub brushes: Brushes,
    /// State of the tube panel beside the palette.
    pub tubes: Tubes,
    /// Eyedropper panel with recipe search.
    pub eyedropper: Eyedropper,
    /// Reference picture beside the canvas.
    pub reference: Reference,
    layers: Layers,
    pub(super) light: LightPanel,
    history: History,
    upper: Tab,
    lower: Tab,
    /// Selected tab while there is only one group.
    only: Tab,
}

impl Default for Panels {
    fn default() -> Self {
        Self {
            brushes: Brushes::default(),
            tubes: Tubes::default(),
            eyedropper: Eyedropper::default(),
            reference: Reference::default(),
            layers: Layers::default(),
            light: LightPanel::default(),
            history: History::default(),
            upper: Tab::Brush,
            lower: Tab::Light,
            only: Tab::Brush,
        }
    }
}

impl Panels {
    /// Selects a tab in its group.
    pub fn select(&mut self, tab: Tab) {
        self.only = tab;
        if Tab::UPPER.contains(&tab) {
            self.upper = tab;
        } else {
            self.lower = tab;
        }
    }

    /// Draws the side panel.
    pub(super) fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, files: &Files) {
        if ui.available_height() < TWO_GROUPS_HEIGHT {
            let all: Vec<Tab> = Tab::UPPER.into_iter().chain(Tab::LOWER).collect();
            let only = tabs(ui, &all, self.only);
            self.select(only);
            self.body(ui, only, cx, files);
            return;
        }
        let half = (0.5 * ui.available_height()).round();
        Panel::top("upper tabs")
            .frame(eframe::egui::Frame::NONE)
            .default_size(half)
            .size_range(240.0..=ui.available_height() - 240.0)
            .resizable(true)
            .show(ui, |ui| {
                self.upper = tabs(ui, &Tab::UPPER, self.upper);
                self.body(ui, self.upper, cx, files);
            });
        ui.add_space(6.0);
        self.lower = tabs(ui, &Tab::LOWER, self.lower);
        self.body(ui, self.lower, cx, files);
    }

    fn body(&mut self, ui: &mut Ui, tab: Tab, cx: &mut PanelContext<'_>, files: &Files) {
        ui.add_space(4.0);
        ScrollArea::vertical().id_salt(tab.name()).auto_shrink(false).show(ui, |ui| match tab {
            Tab::Brush => self.brushes.show(ui, cx),
            Tab::Layers => self.layers.show(ui, cx),
            Tab::Light => self.light.show(ui, cx),
            Tab::Color => self.eyedropper.show(ui, cx),
            Tab::History => self.history.show(ui, cx),
            Tab::Files => revisions::show(ui, cx, &files.revisions),
        });
    }
}

/// Draws a row of tabs. Returns the selected one.
fn tabs(ui: &mut Ui, all: &[Tab], mut chosen: Tab) -> Tab {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        ui.spacing_mut().button_padding.x = 1.0;
        let width = (ui.available_width() - (all.len() - 1) as f32) / all.len() as f32;
        for &tab in all {
            let here = tab == chosen;
            let fill =
                if here { theme::colors(ui.ctx()).chosen } else { theme::colors(ui.ctx()).bar };
            let button = Button::new(RichText::new(tab.name()).size(12.0))
                .fill(fill)
                .selected(here)
                .corner_radius(CornerRadius {
                    sw: 0,
                    se: 0,
                    ..CornerRadius::same(theme::CORNER_RADIUS)
                });
            if ui.add_sized(vec2(width, 24.0), button).on_hover_text(tab.description()).clicked() {
                chosen = tab;
            }
        }
    });
    chosen
}
