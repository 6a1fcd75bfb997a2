//! The picture of a scene in the window, and the card of what is there.

use eframe::egui::{
    Color32, CursorIcon, Id, PointerButton, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo,
};
use session::volumes::{SceneTool, VolumeCommand};

use super::workspace::Volumes;
use crate::language::tr;
use crate::panels::volumes::show_here;
use crate::pen::Pen;
use crate::theme;
use crate::view::{DrawnPart, ViewState, fill_rect};

/// Name of the picture for screen readers and tests.
const NAME: &str = "Scene";

impl Volumes {
    /// Draws the picture in a rectangle of the window, and lets the hand work on it.
    pub(super) fn show_canvas(&mut self, ui: &mut Ui, rect: Rect, pen: &mut Pen) {
        fill_rect(ui.painter(), rect, theme::SURROUND);
        self.rect = rect;
        let id = Id::unique("scene");
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, tr(NAME)));
        let density = ui.ctx().pixels_per_point();
        let painter = ui.painter_at(rect);
        if let Some((_, picture)) = &mut self.picture {
            let mut view = ViewState::default();
            view.fit(picture.cells(), rect, 0.0, density);
            let mut placement = view.placement(rect, density);
            // A picture that is drawn smaller while the scene moves is smoothed.
            placement.aligned &= view.zoom == 1.0;
            picture.draw(&painter, &placement, DrawnPart::Whole);
        }
        self.navigate(ui, &response);
        self.use_tool(ui, pen);
        self.draw_reach(ui, &response);
        self.ask_here(ui, &response);
        self.tell_sight(rect, density);
    }

    /// Tells the worker camera and size if they changed.
    fn tell_sight(&mut self, rect: Rect, density: f32) {
        if self.state.is_none() {
            return;
        }
        let size = [rect.width(), rect.height()].map(|side| (side * density).round().max(1.0));
        self.orbit.set_aspect(size[0] / size[1]);
        let size = size.map(|side| side as usize);
        let camera = self.orbit.camera();
        if self.told.1 != size {
            self.told.1 = size;
            self.ask(VolumeCommand::Size(size));
        }
        if self.told.0 != Some(camera) {
            self.told.0 = Some(camera);
            self.ask(VolumeCommand::Camera(camera));
        }
    }

    /// Draws the reach of the tool around the pointer.
    fn draw_reach(&self, ui: &Ui, response: &Response) {
        let Some(pointer) = response.hover_pos() else { return };
        let Some(state) = &self.state else { return };
        let grip = self.tools.grip;
        let radius = match grip.tool {
            SceneTool::Pour => 4.0,
            _ => self.orbit.points(grip.radius_mm / state.unit_mm, self.rect.height()),
        };
        let painter = ui.painter_at(self.rect);
        painter.circle_stroke(pointer, radius, Stroke::new(3.0, Color32::from_black_alpha(90)));
        painter.circle_stroke(pointer, radius, Stroke::new(1.0, theme::colors(ui.ctx()).strong));
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
    }

    /// Asks what is under a click of the right button, and shows the answer.
    fn ask_here(&mut self, ui: &Ui, response: &Response) {
        if let (Some((at, Some(here))), Some(state)) = (&self.here, &self.state)
            && !show_here(ui.ctx(), *at, here, state)
        {
            self.here = None;
        }
        if response.clicked_by(PointerButton::Secondary)
            && let Some(pointer) = response.interact_pointer_pos()
        {
            self.here = Some((pointer, None));
            let place = self.place(pointer);
            self.ask(VolumeCommand::Pick(place));
        }
    }
}
