//! The panel of the reference picture.

use std::fmt;
use std::path::{Path, PathBuf};

use eframe::egui::{
    Button, Color32, Context, CursorIcon, DragValue, Key, PointerButton, Pos2, Rect, Response,
    Role, Sense, Stroke, TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo, vec2,
};
use spectra::color::Rgb;

use super::super::desk::Desk;
use super::picture::{Picture, Reading};
use super::placing::Placing;
use crate::files::FileRequest;
use crate::theme;

/// The radius of the mean at first, in pixels of the picture.
const RADIUS: f32 = 2.0;

/// The picture that is pinned, and how it is looked at.
pub struct Reference {
    path: Option<PathBuf>,
    reading: Option<Reading>,
    picture: Option<Picture>,
    texture: Option<TextureHandle>,
    placing: Option<Placing>,
    fault: Option<String>,
    grey: bool,
    flipped: bool,
    radius: f32,
}

impl fmt::Debug for Reference {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Reference").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Default for Reference {
    fn default() -> Self {
        Self {
            path: None,
            reading: None,
            picture: None,
            texture: None,
            placing: None,
            fault: None,
            grey: false,
            flipped: false,
            radius: RADIUS,
        }
    }
}

impl Reference {
    /// Begins to read a PNG or JPEG beside the window; what was pinned goes. A
    /// fault is told in the panel.
    pub fn open(&mut self, context: &Context, path: &Path) {
        let context = context.clone();
        let reading = Reading::begin(path, move || context.request_repaint());
        let (grey, flipped, radius) = (self.grey, false, self.radius);
        let path = Some(path.to_owned());
        *self = Self { path, reading: Some(reading), grey, flipped, radius, ..Self::default() };
    }

    /// Takes the picture away.
    pub fn close(&mut self) {
        *self = Self { radius: self.radius, ..Self::default() };
    }

    /// Whether a picture is pinned, being read, or could not be read.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.path.is_some()
    }

    /// Shows the panel in all the room there is, and makes a colour that is clicked
    /// the wanted one.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        self.update();
        self.controls(ui, desk);
        let room = ui.available_size().max(vec2(40.0, 40.0));
        let (rect, response) = ui.allocate_exact_size(room, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Reference picture"));
        ui.painter().rect_filled(rect, 0.0, theme::SURROUND);
        if self.picture.is_none() {
            return self.without_picture(ui, rect);
        }
        self.look(ui, &response);
        self.draw(ui, rect);
        self.pick(ui, &response, desk);
        response.on_hover_cursor(CursorIcon::Crosshair);
    }

    fn update(&mut self) {
        let Some(read) = self.reading.as_ref().and_then(Reading::end) else { return };
        self.reading = None;
        match read {
            Ok(picture) => self.picture = Some(picture),
            Err(fault) => self.fault = Some(fault),
        }
    }

    fn controls(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        ui.horizontal_wrapped(|ui| {
            let open = ui.button("Open\u{2026}").accessible_name("Open picture");
            if open.on_hover_text("Pins another picture, PNG or JPEG").clicked() {
                desk.file(FileRequest::OpenReference(None));
            }
            let there = self.picture.is_some();
            let fit = ui.add_enabled(there, Button::new("Fit"));
            if fit.on_hover_text("Shows all of the picture").clicked() {
                self.placing = None;
            }
            let full = ui.add_enabled(there, Button::new("100 %"));
            if full.on_hover_text("One pixel of the picture on one of the screen").clicked()
                && let Some(placing) = &mut self.placing
            {
                placing.zoom = 1.0 / ui.pixels_per_point();
            }
            let grey = ui.add_enabled(there, Button::selectable(self.grey, "Grey"));
            if grey.on_hover_text("Shows lightness only").clicked() {
                self.grey ^= true;
                self.texture = None;
            }
            let flip = ui.add_enabled(there, Button::selectable(self.flipped, "Flip"));
            if flip.on_hover_text("Exchanges left and right, as in a mirror").clicked() {
                self.flipped ^= true;
            }
            let radius = DragValue::new(&mut self.radius)
                .range(0.0..=100.0)
                .speed(0.1)
                .fixed_decimals(0)
                .prefix("radius ")
                .suffix(" px");
            let radius = ui.add(radius).accessible_name("Radius of the mean");
            radius.on_hover_text("A click takes the mean of the pixels this near; 0 is one pixel");
            let close = ui.add_enabled(self.is_open(), Button::new("Close"));
            let close = close.accessible_name("Close picture");
            if close.on_hover_text("Takes the picture away").clicked() {
                self.close();
                desk.file(FileRequest::CloseReference);
            }
        });
    }

    fn without_picture(&self, ui: &mut Ui, rect: Rect) {
        let name = self.path.as_deref().and_then(Path::file_name);
        let name = name.map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let text = match &self.fault {
            Some(fault) => fault.clone(),
            None if self.reading.is_some() => format!("Reading {name}"),
            None => "A picture to look at, and to take colours from: open one, or drop it \
                     on the window"
                .to_owned(),
        };
        let inner = rect.shrink(16.0);
        let mut within = ui.new_child(eframe::egui::UiBuilder::new().max_rect(inner));
        within.vertical_centered(|ui| {
            ui.add_space(inner.height() * 0.4);
            ui.label(eframe::egui::RichText::new(text).color(Color32::BLACK));
            if self.reading.is_some() {
                ui.add(eframe::egui::Spinner::new().color(Color32::BLACK));
            }
        });
    }

    /// Pans with the middle or second button or the space bar, zooms with the wheel.
    fn look(&mut self, ui: &Ui, response: &Response) {
        let Some(size) = self.size() else { return };
        let panel = response.rect;
        let fitted = Placing::fit(size, panel.size(), self.flipped);
        let mut placing = self.placing.unwrap_or(fitted);
        placing.flipped = self.flipped;
        let other = response.dragged_by(PointerButton::Middle)
            || response.dragged_by(PointerButton::Secondary);
        if other || (response.dragged() && space(ui)) {
            placing = placing.panned(response.drag_delta());
        }
        if let Some(about) = response.hover_pos() {
            let (scroll, pinch) =
                ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let factor = pinch * (scroll / 200.0).exp();
            if factor != 1.0 {
                placing = placing.zoomed(panel, about, factor);
            }
        }
        if self.placing.is_some() || placing != fitted {
            self.placing = Some(placing);
        }
    }

    fn size(&self) -> Option<Vec2> {
        let [width, height] = self.picture.as_ref()?.size();
        Some(vec2(width as f32, height as f32))
    }

    fn placed(&self, panel: Rect) -> Option<Placing> {
        let fitted = Placing::fit(self.size()?, panel.size(), self.flipped);
        Some(self.placing.unwrap_or(fitted))
    }

    fn draw(&mut self, ui: &Ui, panel: Rect) {
        let (Some(placing), Some(size)) = (self.placed(panel), self.size()) else { return };
        let Some(picture) = &self.picture else { return };
        let texture = self.texture.get_or_insert_with(|| {
            let image = picture.on_screen(self.grey);
            ui.ctx().load_texture("reference picture", image, TextureOptions::LINEAR)
        });
        let (rect, uv) = placing.drawn(panel, size);
        ui.painter_at(panel).image(texture.id(), rect, uv, Color32::WHITE);
    }

    /// Takes the colour at the pointer once its first button is let go, and shows it
    /// beside the pointer until then.
    fn pick(&self, ui: &Ui, response: &Response, desk: &mut Desk<'_>) {
        let first = ui.input(|input| {
            input.pointer.button_down(PointerButton::Primary)
                || input.pointer.button_released(PointerButton::Primary)
        });
        let Some(pointer) = response.interact_pointer_pos().filter(|_| first && !space(ui)) else {
            return;
        };
        let (Some(placing), Some(picture)) = (self.placed(response.rect), &self.picture) else {
            return;
        };
        let place = placing.place(response.rect, pointer);
        let Some(color) = picture.mean([place.x, place.y], self.radius) else { return };
        if response.drag_stopped() || response.clicked() {
            desk.tools.wanted = Some(color);
        } else {
            let reach = placing.zoom * self.radius.max(0.5);
            loupe(ui, response.rect, pointer, reach, Rgb(color));
        }
    }
}

fn space(ui: &Ui) -> bool {
    ui.input(|input| input.key_down(Key::Space))
}

/// The colour beside the pointer, and what it is the mean of.
fn loupe(ui: &Ui, panel: Rect, pointer: Pos2, reach: f32, linear: Rgb) {
    let [red, green, blue] = linear.encoded().to_bytes();
    let painter = ui.painter_at(panel);
    painter.circle_stroke(pointer, reach.max(3.0), Stroke::new(1.5, Color32::WHITE));
    painter.circle_stroke(pointer, reach.max(3.0) + 1.0, Stroke::new(1.0, Color32::BLACK));
    let patch = Rect::from_center_size(pointer - vec2(0.0, 44.0), vec2(44.0, 44.0));
    painter.rect_filled(patch.expand(1.0), 0.0, Color32::BLACK);
    painter.rect_filled(patch, 0.0, Color32::from_rgb(red, green, blue));
}
