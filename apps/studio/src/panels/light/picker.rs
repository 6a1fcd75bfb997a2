//! A drop-down list of illuminants with a search field.

use std::path::Path;

use eframe::egui::{
    Align, Align2, Button, Key, Layout, Popup, PopupCloseBehavior, Response, RichText, ScrollArea,
    Shape, Stroke, Ui, vec2,
};
use spectra::{ColorTemperature, Illuminant, light_from_text};

use super::super::controls::mark;
use super::super::search::{self, Highlight};
use super::illuminants::{Kind, ListedIlluminant, listed_illuminants};
use crate::language::{tr, tr_format};
use crate::theme;

/// Button that opens the list.
#[derive(Debug)]
pub(super) struct Picker {
    name: &'static str,
    lamps: Vec<ListedIlluminant>,
    search: String,
    highlight: Highlight,
}

impl Picker {
    /// Creates a picker with an accessible name.
    pub(super) fn new(name: &'static str) -> Self {
        let lamps = listed_illuminants();
        let highlight = Highlight::default();
        Self { name, lamps, search: String::new(), highlight }
    }

    /// Draws the button with the chosen illuminant, and the list while it is open.
    /// Returns the name of the illuminant that was picked.
    pub(super) fn show(&mut self, ui: &mut Ui, chosen: &str) -> Option<String> {
        let text = short(chosen);
        let width = ui.available_width();
        let button = Button::new(text.clone()).right_text("   ").truncate();
        let response = ui.add_sized([width, ui.spacing().interact_size.y], button);
        let tip = response.rect.right_center() - vec2(13.0, -2.5);
        let corners = vec![tip, tip + vec2(-4.0, -5.0), tip + vec2(4.0, -5.0)];
        ui.painter().add(Shape::convex_polygon(
            corners,
            theme::colors(ui.ctx()).faint,
            Stroke::NONE,
        ));
        response.widget_info(|| {
            let label = format!("{}: {text}", tr(self.name));
            eframe::egui::WidgetInfo::labeled(eframe::egui::Role::Button, true, label)
        });
        let response = response.on_hover_text(self.hover(chosen));
        let mut picked = None;
        let opened = response.clicked();
        Popup::menu(&response)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .width(width.max(260.0))
            .show(|ui| picked = self.list(ui, chosen, opened));
        if picked.is_some() {
            self.search.clear();
        }
        picked
    }

    fn hover(&self, chosen: &str) -> String {
        let lamp = self.lamps.iter().find(|lamp| lamp.name.eq_ignore_ascii_case(chosen));
        let note = lamp.map_or_else(String::new, |lamp| format!(": {}", lamp.note));
        tr_format!(
            "{name}: {chosen}{note}. Click to choose another",
            name = tr(self.name),
            chosen,
            note
        )
    }

    fn list(&mut self, ui: &mut Ui, chosen: &str, opened: bool) -> Option<String> {
        let id = ui.scope_id().with("search of a light");
        self.highlight.read_arrows(ui, ui.memory(|memory| memory.has_focus(id)));
        let field = theme::text_field(&mut self.search)
            .id(id)
            .hint_text(tr("Search, or 3200K, D5600K"))
            .desired_width(f32::INFINITY)
            .align(Align2::LEFT_CENTER);
        let field = ui.add(field).on_hover_text(
            tr("Words of a light's name or kind; a temperature, such as 3200K for a black body or D5600K for \
             daylight; or the path of a lamp's file. Enter takes the marked one, arrows move the mark"),
        );
        if opened {
            field.request_focus();
        }
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let mut found: Vec<ListedIlluminant> =
            self.lamps.iter().copied().filter(|lamp| lamp.matches(&self.search)).collect();
        search::sort(&mut found, &self.search, |lamp| lamp.name);
        let marked = self.highlight.among(&self.search, found.len());
        let typed = self.search.trim();
        let typed = (found.is_empty() && light_from_text(typed).is_ok()).then(|| typed.to_owned());
        let mut picked = None;
        if entered {
            picked = typed.clone().or(found.get(marked).map(|lamp| lamp.name.to_owned()));
        }
        if let Some(typed) = &typed
            && ui
                .button(tr_format!("Take {typed}", typed = short(typed)))
                .on_hover_text(tr("As typed"))
                .clicked()
        {
            picked = Some(typed.clone());
        }
        if found.is_empty() && typed.is_none() {
            ui.weak(tr("No such light"));
        }
        let moved = std::mem::take(&mut self.highlight.moved);
        ScrollArea::vertical().max_height(360.0).show(ui, |ui| {
            let mut kind: Option<Kind> = None;
            for (line, lamp) in found.iter().enumerate() {
                // What was searched for is in the order of its match, not of its kind.
                if self.search.trim().is_empty() && kind.replace(lamp.kind) != Some(lamp.kind) {
                    ui.add_space(3.0);
                    let name = RichText::new(lamp.kind.name()).small();
                    ui.label(name.color(theme::colors(ui.ctx()).faint));
                }
                let chosen = lamp.name.eq_ignore_ascii_case(chosen);
                let response = entry(ui, lamp, chosen);
                if line == marked {
                    mark(ui, &response, moved);
                }
                if response.clicked() {
                    picked = Some(lamp.name.to_owned());
                }
            }
        });
        if picked.is_some() {
            ui.close();
        }
        picked
    }
}

/// Draws a line of the list.
fn entry(ui: &mut Ui, lamp: &ListedIlluminant, chosen: bool) -> Response {
    let colors = theme::colors(ui.ctx());
    let note_color = if chosen { colors.text } else { colors.faint };
    let note = RichText::new(lamp.note).small().color(note_color);
    let line = Button::selectable(chosen, lamp.name).right_text(note);
    let response = ui.with_layout(Layout::top_down_justified(Align::Min), |ui| ui.add(line)).inner;
    let enabled = response.enabled();
    response.widget_info(|| {
        eframe::egui::WidgetInfo::selected(eframe::egui::Role::Button, enabled, chosen, lamp.name)
    });
    response.on_hover_ui(|ui| {
        ui.label(format!("{}: {}", lamp.name, lamp.note));
        let temperature = Illuminant::named(lamp.name).ok().as_ref().map(ColorTemperature::of);
        if let Some(Some(temperature)) = temperature {
            ui.label(format!("{:.0} K  Duv {:+.4}", temperature.kelvin, temperature.duv));
        }
    })
}

/// Short name of a light: the file name if it is a path.
pub(super) fn short(illuminant: &str) -> String {
    let path = Path::new(illuminant);
    match path.file_name() {
        Some(name) if path.components().count() > 1 => name.to_string_lossy().into_owned(),
        _ => illuminant.to_owned(),
    }
}
