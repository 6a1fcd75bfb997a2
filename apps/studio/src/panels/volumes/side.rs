//! The side panel of a scene: tubes, the tool in hand, and tabs.

use eframe::egui::{Button, CornerRadius, RichText, ScrollArea, Ui, vec2};

use super::context::{SceneContext, SceneTab};
use super::{events, export, here, light, tool, tubes, view};
use crate::language::tr;
use crate::panels::controls::row_height;
use crate::panels::section::section;
use crate::theme;

impl SceneTab {
    /// All tabs in their order.
    const ALL: [Self; 5] = [Self::View, Self::Light, Self::Here, Self::Events, Self::Export];

    /// Name and description.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::View => (tr("View"), tr("The picture that is shown")),
            Self::Light => {
                (tr("Light"), tr("Where the light comes from, and the light on pigments"))
            }
            Self::Here => (tr("Here"), tr("Colour and paint at the last right click")),
            Self::Events => (tr("Events"), tr("All that was done, to go back to and to take back")),
            Self::Export => (tr("Export"), tr("Pictures, a painting, the script, an animation")),
        }
    }
}

/// Draws the side panel.
pub fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    section(ui, tr("Tubes"), |ui| tubes::show(ui, cx));
    section(ui, tr("Tool in hand"), |ui| tool::show(ui, cx));
    ui.add_space(6.0);
    tabs(ui, &mut cx.tools.tab);
    ui.add_space(4.0);
    let tab = cx.tools.tab;
    let body = ScrollArea::vertical().id_salt(tab.words().0).auto_shrink(false);
    body.show(ui, |ui| match tab {
        SceneTab::View => view::show(ui, cx),
        SceneTab::Light => light::show(ui, cx),
        SceneTab::Here => here::show_panel(ui, cx),
        SceneTab::Events => events::show(ui, cx),
        SceneTab::Export => export::show(ui, cx),
    });
}

/// Draws the row of tabs.
fn tabs(ui: &mut Ui, chosen: &mut SceneTab) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        let count = SceneTab::ALL.len() as f32;
        let width = (ui.available_width() - (count - 1.0)) / count;
        for tab in SceneTab::ALL {
            let (name, description) = tab.words();
            let here = tab == *chosen;
            let button = Button::new(RichText::new(name).size(12.0))
                .fill(if here {
                    theme::colors(ui.ctx()).chosen
                } else {
                    theme::colors(ui.ctx()).bar
                })
                .selected(here)
                .corner_radius(CornerRadius {
                    sw: 0,
                    se: 0,
                    ..CornerRadius::same(theme::CORNER_RADIUS)
                });
            if ui
                .add_sized(vec2(width, row_height(ui, 24.0)), button)
                .on_hover_text(description)
                .clicked()
            {
                *chosen = tab;
            }
        }
    });
}
