//! The panels at the right: one group of tabs, or two where there is room.

use eframe::egui::{Button, CornerRadius, Panel, RichText, ScrollArea, Ui, vec2};

use crate::files::Files;
use crate::panels::brushes::Brushes;
use crate::panels::eyedropper::Eyedropper;
use crate::panels::history::History;
use crate::panels::layers::Layers;
use crate::panels::light::LightPanel;
use crate::panels::reference::Reference;
use crate::panels::tubes::Tubes;
use crate::panels::{Desk, revisions};
use crate::theme;

/// From this height on there is room for two groups, in points.
const TALL: f32 = 860.0;

/// What can be shown at the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tab {
    /// The brushes.
    Brush,
    /// Wet and dry paint.
    Layers,
    /// The light.
    Light,
    /// What was picked, and recipes for a colour.
    Color,
    /// What was done.
    History,
    /// Revisions.
    Files,
}

impl Tab {
    /// What painting itself needs.
    const UPPER: [Self; 2] = [Self::Brush, Self::Layers];

    /// What is looked at now and then.
    const LOWER: [Self; 4] = [Self::Light, Self::Color, Self::History, Self::Files];

    /// Its name.
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

    fn told(self) -> &'static str {
        match self {
            Self::Brush => "The stand, the head of the brush, its paint",
            Self::Layers => "Wet and dry paint",
            Self::Light => "The light, the gloss, and a second light to compare",
            Self::Color => "What lies where the eyedropper asked, and recipes for a colour",
            Self::History => "What was done, to go back to",
            Self::Files => "Numbered revisions of the painting",
        }
    }
}

/// The panels and which of them are shown.
#[derive(Debug)]
pub struct Panels {
    /// The brushes.
    pub brushes: Brushes,
    /// The tubes, beside the palette.
    pub tubes: Tubes,
    /// What was picked, and recipes for a colour.
    pub eyedropper: Eyedropper,
    /// The picture beside the canvas.
    pub reference: Reference,
    layers: Layers,
    pub(super) light: LightPanel,
    history: History,
    upper: Tab,
    lower: Tab,
    /// The tab chosen last, where there is one group.
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
    /// Brings a tab to the front.
    pub fn bring(&mut self, tab: Tab) {
        self.only = tab;
        if Tab::UPPER.contains(&tab) {
            self.upper = tab;
        } else {
            self.lower = tab;
        }
    }

    /// Shows them in a column.
    pub(super) fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>, files: &Files) {
        if ui.available_height() < TALL {
            let all: Vec<Tab> = Tab::UPPER.into_iter().chain(Tab::LOWER).collect();
            let only = tabs(ui, &all, self.only);
            self.bring(only);
            self.body(ui, only, desk, files);
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
                self.body(ui, self.upper, desk, files);
            });
        ui.add_space(6.0);
        self.lower = tabs(ui, &Tab::LOWER, self.lower);
        self.body(ui, self.lower, desk, files);
    }

    fn body(&mut self, ui: &mut Ui, tab: Tab, desk: &mut Desk<'_>, files: &Files) {
        ui.add_space(4.0);
        ScrollArea::vertical().id_salt(tab.name()).auto_shrink(false).show(ui, |ui| match tab {
            Tab::Brush => self.brushes.show(ui, desk),
            Tab::Layers => self.layers.show(ui, desk),
            Tab::Light => self.light.show(ui, desk),
            Tab::Color => self.eyedropper.show(ui, desk),
            Tab::History => self.history.show(ui, desk),
            Tab::Files => revisions::show(ui, desk, &files.revisions),
        });
    }
}

/// A row of tabs; the one that is chosen now.
fn tabs(ui: &mut Ui, all: &[Tab], mut chosen: Tab) -> Tab {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        ui.spacing_mut().button_padding.x = 1.0;
        let width = (ui.available_width() - (all.len() - 1) as f32) / all.len() as f32;
        for &tab in all {
            let here = tab == chosen;
            let fill = if here { theme::CHOSEN } else { theme::BAR };
            let button = Button::new(RichText::new(tab.name()).size(12.0))
                .fill(fill)
                .selected(here)
                .corner_radius(CornerRadius { sw: 0, se: 0, ..CornerRadius::same(theme::ROUND) });
            if ui.add_sized(vec2(width, 24.0), button).on_hover_text(tab.told()).clicked() {
                chosen = tab;
            }
        }
    });
    chosen
}
