//! Draws the reference picture and picks colours from it.

use std::fmt;
use std::path::{Path, PathBuf};

use eframe::egui::{
    Button, Color32, Context, CursorIcon, DragValue, Key, PointerButton, Pos2, Rect, Response,
    Role, Sense, Stroke, TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo, vec2,
};
use spectra::color::Rgb;

use super::super::context::PanelContext;
use super::picture::{PendingPicture, Picture};
use super::picture_view::PictureView;
use crate::files::FileRequest;
use crate::theme;

/// Default radius of the averaged disc, in pixels of the picture.
const RADIUS: f32 = 2.0;

/// State of the reference panel: the picture and its view.
pub struct Reference {
    path: Option<PathBuf>,
    reading: Option<PendingPicture>,
    picture: Option<Picture>,
    texture: Option<TextureHandle>,
    view: Option<PictureView>,
    error: Option<String>,
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
            view: None,
            error: None,
            grey: false,
            flipped: false,
            radius: RADIUS,
        }
    }
}

impl Reference {
    /// Starts to read a PNG or JPEG on another thread, replacing the current picture.
    /// An error is shown in the panel.
    pub fn open(&mut self, context: &Context, path: &Path) {
        let context = context.clone();
        let reading = PendingPicture::start(path, move || context.request_repaint());
        let (grey, flipped, radius) = (self.grey, false, self.radius);
        let path = Some(path.to_owned());
        *self = Self { path, reading: Some(reading), grey, flipped, radius, ..Self::default() };
    }

    /// Closes the picture.
    pub fn close(&mut self) {
        *self = Self { radius: self.radius, ..Self::default() };
    }

    /// Whether a picture is shown, being read, or failed to be read.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.path.is_some()
    }

    /// Draws the panel in the available space. A click stores the picked colour in the
    /// tools.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        self.update();
        self.controls(ui, cx);
        let area = ui.available_size().max(vec2(40.0, 40.0));
        let (rect, response) = ui.allocate_exact_size(area, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Reference picture"));
        ui.painter().rect_filled(rect, 0.0, theme::SURROUND);
        if self.picture.is_none() {
            return self.placeholder(ui, rect);
        }
        self.navigate(ui, &response);
        self.draw(ui, rect);
        self.pick(ui, &response, cx);
        response.on_hover_cursor(CursorIcon::Crosshair);
    }

    fn update(&mut self) {
        let Some(read) = self.reading.as_ref().and_then(PendingPicture::result) else { return };
        self.reading = None;
        match read {
            Ok(picture) => self.picture = Some(picture),
            Err(error) => self.error = Some(error),
        }
    }

    fn controls(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        ui.horizontal_wrapped(|ui| {
            let open = ui.button("Open\u{2026}").accessible_name("Open picture");
            if open.on_hover_text("Opens another picture, PNG or JPEG").clicked() {
                cx.file(FileRequest::OpenReference(None));
            }
            let loaded = self.picture.is_some();
            let fit = ui.add_enabled(loaded, Button::new("Fit"));
            if fit.on_hover_text("Fits the whole picture into the panel").clicked() {
                self.view = None;
            }
            let full = ui.add_enabled(loaded, Button::new("100 %"));
            if full.on_hover_text("Shows one picture pixel as one screen pixel").clicked()
                && let Some(view) = &mut self.view
            {
                view.zoom = 1.0 / ui.pixels_per_point();
            }
            let grey = ui.add_enabled(loaded, Button::selectable(self.grey, "Grey"));
            if grey.on_hover_text("Shows lightness only").clicked() {
                self.grey ^= true;
                self.texture = None;
            }
            let flip = ui.add_enabled(loaded, Button::selectable(self.flipped, "Flip"));
            if flip.on_hover_text("Mirrors the picture").clicked() {
                self.flipped ^= true;
            }
            let radius = DragValue::new(&mut self.radius)
                .range(0.0..=100.0)
                .speed(0.1)
                .fixed_decimals(0)
                .prefix("radius ")
                .suffix(" px");
            let radius = ui.add(radius).accessible_name("Radius of the mean");
            radius.on_hover_text("A click picks the mean within this radius; 0 is one pixel");
            let close = ui.add_enabled(self.is_open(), Button::new("Close"));
            let close = close.accessible_name("Close picture");
            if close.on_hover_text("Closes the picture").clicked() {
                self.close();
                cx.file(FileRequest::CloseReference);
            }
        });
    }

    fn placeholder(&self, ui: &mut Ui, rect: Rect) {
        let name = self.path.as_deref().and_then(Path::file_name);
        let name = name.map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let text = match &self.error {
            Some(error) => error.clone(),
            None if self.reading.is_some() => format!("Reading {name}"),
            None => "A reference picture to pick colours from: open one, or drop it \
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

    /// Pans with the middle or secondary button, or while the space bar is held; zooms with
    /// the wheel or by pinching.
    fn navigate(&mut self, ui: &Ui, response: &Response) {
        let Some(size) = self.size() else { return };
        let panel = response.rect;
        let fitted = PictureView::fit(size, panel.size(), self.flipped);
        let mut view = self.view.unwrap_or(fitted);
        view.flipped = self.flipped;
        let other = response.dragged_by(PointerButton::Middle)
            || response.dragged_by(PointerButton::Secondary);
        if other || (response.dragged() && space_held(ui)) {
            view = view.panned(response.drag_delta());
        }
        if let Some(about) = response.hover_pos() {
            let (scroll, pinch) =
                ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let factor = pinch * (scroll / 200.0).exp();
            if factor != 1.0 {
                view = view.zoomed(panel, about, factor);
            }
        }
        if self.view.is_some() || view != fitted {
            self.view = Some(view);
        }
    }

    fn size(&self) -> Option<Vec2> {
        let [width, height] = self.picture.as_ref()?.size();
        Some(vec2(width as f32, height as f32))
    }

    fn current_view(&self, panel: Rect) -> Option<PictureView> {
        let fitted = PictureView::fit(self.size()?, panel.size(), self.flipped);
        Some(self.view.unwrap_or(fitted))
    }

    fn draw(&mut self, ui: &Ui, panel: Rect) {
        let (Some(view), Some(size)) = (self.current_view(panel), self.size()) else { return };
        let Some(picture) = &self.picture else { return };
        let texture = self.texture.get_or_insert_with(|| {
            let image = picture.on_screen(self.grey);
            ui.ctx().load_texture("reference picture", image, TextureOptions::LINEAR)
        });
        let (rect, uv) = view.rects(panel, size);
        ui.painter_at(panel).image(texture.id(), rect, uv, Color32::WHITE);
    }

    /// Picks the colour at the pointer when the primary button is released, and shows
    /// it beside the pointer until then.
    fn pick(&self, ui: &Ui, response: &Response, cx: &mut PanelContext<'_>) {
        let first = ui.input(|input| {
            input.pointer.button_down(PointerButton::Primary)
                || input.pointer.button_released(PointerButton::Primary)
        });
        let Some(pointer) = response.interact_pointer_pos().filter(|_| first && !space_held(ui))
        else {
            return;
        };
        let (Some(view), Some(picture)) = (self.current_view(response.rect), &self.picture) else {
            return;
        };
        let place = view.place(response.rect, pointer);
        let Some(color) = picture.mean([place.x, place.y], self.radius) else { return };
        if response.drag_stopped() || response.clicked() {
            cx.tools.reference_color = Some(color);
        } else {
            let reach = view.zoom * self.radius.max(0.5);
            loupe(ui, response.rect, pointer, reach, Rgb(color));
        }
    }
}

fn space_held(ui: &Ui) -> bool {
    ui.input(|input| input.key_down(Key::Space))
}

/// Draws the colour beside the pointer, and the disc that is averaged.
fn loupe(ui: &Ui, panel: Rect, pointer: Pos2, reach: f32, linear: Rgb) {
    let [red, green, blue] = linear.encoded().to_bytes();
    let painter = ui.painter_at(panel);
    painter.circle_stroke(pointer, reach.max(3.0), Stroke::new(1.5, Color32::WHITE));
    painter.circle_stroke(pointer, reach.max(3.0) + 1.0, Stroke::new(1.0, Color32::BLACK));
    let patch = Rect::from_center_size(pointer - vec2(0.0, 44.0), vec2(44.0, 44.0));
    painter.rect_filled(patch.expand(1.0), 0.0, Color32::BLACK);
    painter.rect_filled(patch, 0.0, Color32::from_rgb(red, green, blue));
}
