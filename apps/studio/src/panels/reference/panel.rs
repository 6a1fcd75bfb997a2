//! The picture with its buttons, and its view.

use std::path::Path;

use eframe::egui::{
    Color32, Context, CursorIcon, Frame, Key, Panel, PointerButton, Rect, Response, Role, Sense,
    TextureId, TextureOptions, Ui, Vec2, WidgetInfo, vec2,
};

use super::super::context::PanelContext;
use super::mode::ReferenceMode;
use super::picture::PendingPicture;
use super::picture_view::PictureView;
use super::state::Reference;
use crate::language::{tr, tr_format};
use crate::theme;

/// Usual height of the list of what is drawn, in points.
const LIST_HEIGHT: f32 = 190.0;

impl Reference {
    /// Draws the panel in the available space. A click stores the picked colour in the tools, or
    /// draws, as the mode says.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        self.update();
        self.controls(ui, cx);
        if self.mode != ReferenceMode::Pick && self.picture.is_some() {
            self.list(ui, cx);
        }
        let area = ui.available_size().max(vec2(40.0, 40.0));
        let (rect, response) = ui.allocate_exact_size(area, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tr("Reference picture")));
        ui.painter().rect_filled(rect, 0.0, theme::SURROUND);
        self.hovered = response.contains_pointer();
        if self.picture.is_none() {
            return self.placeholder(ui, rect);
        }
        self.navigate(ui, &response);
        let Some(view) = self.current_view(rect) else { return };
        self.draw(ui, rect, view);
        if space_held(ui) {
            self.line.clear();
        } else if self.mode == ReferenceMode::Pick {
            self.pick(ui, &response, view, cx);
        } else {
            self.sketch(ui, &response, view);
        }
        self.draw_sketches(ui, rect, view);
        response.on_hover_cursor(CursorIcon::Crosshair);
    }

    /// Draws the list of what is drawn. Its height stays while lines are added, so that the picture
    /// does not move.
    fn list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let room = ui.available_height();
        Panel::bottom("reference drawing")
            .frame(Frame::NONE)
            .resizable(true)
            .show_separator_line(false)
            .default_size((0.4 * room).min(LIST_HEIGHT))
            .size_range(60.0..=(0.7 * room).max(60.0))
            .show(ui, |ui| match self.mode {
                ReferenceMode::Comb => self.guide_list(ui, cx),
                _ => self.sample_list(ui, cx),
            });
    }

    fn update(&mut self) {
        let Some(read) = self.reading.as_ref().and_then(PendingPicture::result) else { return };
        self.reading = None;
        match read {
            Ok(picture) => {
                self.picture = Some(picture);
                self.restore_drawings();
            }
            Err(error) => self.error = Some(error),
        }
    }

    fn placeholder(&self, ui: &mut Ui, rect: Rect) {
        let name = self.path.as_deref().and_then(Path::file_name);
        let name = name.map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let text = match &self.error {
            Some(error) => error.clone(),
            None if self.reading.is_some() => tr_format!("Reading {name}", name),
            None => tr("A reference picture to pick colours from: open one, or drop it \
                     on the window")
            .to_owned(),
        };
        let inner = rect.shrink(16.0);
        let mut within = ui.new_child(eframe::egui::UiBuilder::new().max_rect(inner));
        within.vertical_centered(|ui| {
            ui.add_space(inner.height() * 0.4);
            let board = Frame::new().fill(theme::BOARD).corner_radius(theme::CORNER_RADIUS);
            board.inner_margin(6).show(ui, |ui| {
                ui.label(eframe::egui::RichText::new(text).color(theme::BOARD_TEXT));
            });
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
        // A line that is being drawn stays where it is.
        let drawing = !self.line.points().is_empty();
        if let Some(about) = response.hover_pos().filter(|_| !drawing) {
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
        let [width, height] = self.picture.as_ref()?.file_size();
        Some(vec2(width as f32, height as f32))
    }

    fn current_view(&self, panel: Rect) -> Option<PictureView> {
        let fitted = PictureView::fit(self.size()?, panel.size(), self.flipped);
        Some(self.view.unwrap_or(fitted))
    }

    fn draw(&mut self, ui: &Ui, panel: Rect, view: PictureView) {
        let (Some(size), Some(texture)) = (self.size(), self.texture(ui.ctx())) else { return };
        let (rect, uv) = view.rects(panel, size);
        ui.painter_at(panel).image(texture, rect, uv, Color32::WHITE);
    }

    /// The texture of the picture as it is shown.
    pub(super) fn texture(&mut self, context: &Context) -> Option<TextureId> {
        let picture = self.picture.as_ref()?;
        let texture = self.texture.get_or_insert_with(|| {
            let image = picture.on_screen(self.grey, self.exposure);
            context.load_texture(tr("reference picture"), image, TextureOptions::LINEAR)
        });
        Some(texture.id())
    }
}

fn space_held(ui: &Ui) -> bool {
    ui.input(|input| input.key_down(Key::Space))
}
