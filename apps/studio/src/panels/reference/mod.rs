//! The reference picture beside the canvas: its buttons, its view, and the lists of samples and
//! guides below it.

mod picture;
mod samples;
mod state;
mod over_canvas;

use std::path::Path;

use eframe::egui::{
    Button, Color32, Context, CursorIcon, DragValue, Frame, Key, Label, Panel, PointerButton, Rect,
    Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextureId, TextureOptions, Ui,
    Vec2, WidgetInfo, vec2,
};

use super::context::PanelContext;
use super::controls::{button, named_button};
use crate::files::{DrawingKind, FileRequest};
use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::theme;
use picture::{PendingPicture, Picture, PictureView, ReferenceMode};
use state::screen_color;

pub use state::Reference;

/// Height of the list, unless you drag it, in points.
const LIST_HEIGHT: f32 = 190.0;

impl Reference {
    /// Draws the panel in the available space. If you click, it picks a colour for the tools or
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

    /// Draws the list of samples or guides. Its height stays when you add lines, so that the
    /// picture does not move.
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
                ui.label(RichText::new(text).color(theme::BOARD_TEXT));
            });
            if self.reading.is_some() {
                ui.add(eframe::egui::Spinner::new().color(Color32::BLACK));
            }
        });
    }

    /// You pan with the middle or secondary button or with the space bar, and zoom with the wheel
    /// or by pinching.
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
        // The line that you draw stays where it is.
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

    fn texture(&mut self, context: &Context) -> Option<TextureId> {
        let picture = self.picture.as_ref()?;
        let texture = self.texture.get_or_insert_with(|| {
            let image = picture.on_screen(self.grey, self.exposure);
            context.load_texture(tr("reference picture"), image, TextureOptions::LINEAR)
        });
        Some(texture.id())
    }

    fn controls(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        ui.horizontal_wrapped(|ui| {
            let open = ui.button(tr("Open\u{2026}")).accessible_name(tr("Open picture"));
            if open
                .on_hover_text(tr(
                    "Opens another picture: PNG, JPEG, TIFF, WebP, OpenEXR or a painting",
                ))
                .clicked()
            {
                cx.file(FileRequest::OpenReference(None));
            }
            self.view_controls(ui);
            let close = ui.add_enabled(self.is_open(), Button::new(tr("Close")));
            let close = close.accessible_name(tr("Close picture"));
            if close.on_hover_text(tr("Closes the picture")).clicked() {
                // Otherwise we ask first.
                if self.unsaved_drawings().is_empty() {
                    self.close();
                }
                cx.file(FileRequest::CloseReference);
            }
        });
        ui.horizontal_wrapped(|ui| {
            for mode in ReferenceMode::ALL {
                let chosen = Button::selectable(self.mode == mode, mode.name());
                let button = ui.add_enabled(self.picture.is_some(), chosen);
                if button.on_hover_text(mode.description()).clicked() {
                    self.mode = mode;
                    self.first_place = None;
                    self.line.clear();
                }
            }
            if self.mode == ReferenceMode::Pick {
                let radius = DragValue::new(&mut self.radius)
                    .range(0.0..=100.0)
                    .speed(0.1)
                    .fixed_decimals(0)
                    .prefix(tr("radius "))
                    .suffix(" px");
                let radius = ui.add(radius).accessible_name(tr("Radius of the mean"));
                radius
                    .on_hover_text(tr("A click picks the mean within this radius; 0 is one pixel"));
            }
            self.exposure_control(ui);
        });
        self.over_controls(ui);
    }

    /// The exposure of a picture with scene-referred values.
    fn exposure_control(&mut self, ui: &mut Ui) {
        if !self.picture.as_ref().is_some_and(Picture::is_scene_linear) {
            return;
        }
        let drag = DragValue::new(&mut self.exposure).range(-16.0..=16.0).speed(0.05);
        let drag = drag.max_decimals(2).prefix(tr("exposure ")).suffix(" EV");
        let drag = ui.add(drag).accessible_name(tr("Exposure"));
        let tip = tr("Doubles the light of the picture with each step; colours are picked with it");
        if drag.on_hover_text(tip).changed() {
            self.texture = None;
        }
    }

    fn view_controls(&mut self, ui: &mut Ui) {
        let loaded = self.picture.is_some();
        let fit = ui.add_enabled(loaded, Button::new(tr("Fit")));
        if fit.on_hover_text(tr("Fits the whole picture into the panel")).clicked() {
            self.view = None;
        }
        let full = ui.add_enabled(loaded, Button::new("100 %"));
        if full.on_hover_text(tr("Shows one picture pixel as one screen pixel")).clicked()
            && let Some(view) = &mut self.view
        {
            view.zoom = 1.0 / ui.pixels_per_point();
        }
        let grey = ui.add_enabled(loaded, Button::selectable(self.grey, tr("Grey")));
        if grey.on_hover_text(tr("Shows lightness only")).clicked() {
            self.grey ^= true;
            self.texture = None;
        }
        let flip = ui.add_enabled(loaded, Button::selectable(self.flipped, tr("Flip")));
        if flip.on_hover_text(tr("Mirrors the picture")).clicked() {
            self.flipped ^= true;
        }
    }

    fn sample_list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let (Some(path), Some(picture)) = (self.path.clone(), &self.picture) else { return };
        let size = picture.file_size();
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            for (spacing, name, tip) in [
                (false, tr("Scribble"), tr("A line over a passage is a new sample; a click selects one")),
                (
                    true,
                    tr("Spacing"),
                    tr("A line between the middles of two neighbouring strokes, or a click on each, \
                     tells how far apart the strokes of the selected sample are; also with Shift"),
                ),
            ] {
                let chosen = Button::selectable(self.spacing == spacing, name);
                if ui.add(chosen).on_hover_text(tip).clicked() {
                    (self.spacing, self.first_place) = (spacing, None);
                }
            }
            let nothing = (!self.samples.can_undo()).then_some(tr("There is no mark to undo"));
            let tip = tr_format!("Undoes the last mark{hint}", hint = hint(ui.ctx(), "undo"));
            if named_button(ui, tr("Undo"), tr("Undo mark"), &tip, nothing) {
                self.undo();
            }
            let empty = self.samples.marks().is_empty().then_some(tr("There is no mark to save"));
            if button(ui, tr("Save marks\u{2026}"), tr("Saves the marks beside the picture"), empty) {
                cx.file(FileRequest::SaveDrawing(self.samples.as_file(&path)));
            }
            if button(ui, tr("Open marks\u{2026}"), tr("Opens a file of marks for this picture"), None) {
                cx.file(FileRequest::OpenDrawing(DrawingKind::Marks, path.clone()));
            }
        });
        if self.samples.marks().is_empty() {
            ui.label(RichText::new(tr("Draw a line over a passage whose strokes you like")).weak());
        }
        if let Some(fault) = self.samples.fault() {
            ui.label(RichText::new(&fault.text).color(theme::colors(ui.ctx()).strong));
            ui.label(RichText::new(fault.hint.as_deref().unwrap_or_default()).weak());
        } else if let Some(file) = self.samples.file() {
            next_step(ui, tr("Takes the samples"), &sample_command(&path, file));
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let mut removed = None;
            for index in 0..self.samples.marks().len() {
                if self.sample_row(ui, index, size) {
                    removed = Some(index);
                }
            }
            if let Some(index) = removed {
                self.renaming = None;
                self.samples.remove(index, size);
            }
        });
    }

    /// Draws the row of a sample. Returns whether you clicked its button that removes it.
    fn sample_row(&mut self, ui: &mut Ui, index: usize, size: [usize; 2]) -> bool {
        let mark = &self.samples.marks()[index];
        let name = mark.name.clone();
        let spacing = mark.spacing_px();
        ui.horizontal(|ui| {
            if patch(ui, &name, index, index == self.samples.selected) {
                self.samples.selected = index;
            }
            self.name_field(ui, index, &name, size);
            let (words, tip) = match spacing {
                Some(px) => (format!("{px:.1} px"), tr("Distance of neighbouring strokes")),
                None => {
                    (tr("estimated").to_owned(), tr("The distance of strokes will be estimated"))
                }
            };
            ui.add_sized(vec2(62.0, 18.0), Label::new(RichText::new(words).weak()))
                .on_hover_text(tip);
            let delete = tr_format!("Delete {name}", name);
            named_button(ui, "\u{d7}", &delete, tr("Removes the sample"), None)
        })
        .inner
    }

    fn name_field(&mut self, ui: &mut Ui, index: usize, name: &str, size: [usize; 2]) {
        let own = self.renaming.take_if(|(renamed, _)| *renamed == index);
        let mut typed = own.map_or_else(|| name.to_owned(), |(_, typed)| typed);
        let width = (ui.available_width() - RIGHT).max(40.0);
        let field = ui.add(theme::text_field(&mut typed).desired_width(width));
        let field = field.on_hover_text(tr("Name of the sample, different from all others"));
        if field.gained_focus() {
            self.samples.selected = index;
        }
        if field.has_focus() {
            self.renaming = Some((index, typed));
        } else if field.lost_focus() && typed.trim() != name {
            // This refuses a name that another sample has.
            self.samples.rename(index, &typed, size);
        }
    }

    fn guide_list(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>) {
        let (Some(path), Some(picture)) = (self.path.clone(), &self.picture) else { return };
        let size = picture.file_size();
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            let nothing = (!self.combing.can_undo()).then_some(tr("There is no guide to undo"));
            let tip = &tr_format!("Undoes the last guide{hint}", hint = hint(ui.ctx(), "undo"));
            if named_button(ui, tr("Undo"), tr("Undo guide"), tip, nothing) {
                self.undo();
            }
            let empty =
                self.combing.combed().lines.is_empty().then_some(tr("There is no guide to save"));
            if button(
                ui,
                tr("Save guides\u{2026}"),
                tr("Saves the guides beside the picture"),
                empty,
            ) {
                cx.file(FileRequest::SaveDrawing(self.combing.as_file(&path, size)));
            }
            if button(
                ui,
                tr("Open guides\u{2026}"),
                tr("Opens a file of guides for this picture"),
                None,
            ) {
                cx.file(FileRequest::OpenDrawing(DrawingKind::Guides, path.clone()));
            }
        });
        self.camera_row(ui);
        if self.combing.combed().lines.is_empty() {
            let words = tr("Draw lines as strokes should run, from their start to their end");
            ui.label(RichText::new(words).weak());
        }
        if let Some(file) = self.combing.file() {
            let command = paint_command(&path, self.combing.combed().camera, file);
            next_step(ui, tr("Paints along the guides"), &command);
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let mut removed = None;
            for index in 0..self.combing.combed().lines.len() {
                if self.guide_row(ui, index) {
                    removed = Some(index);
                }
            }
            if let Some(index) = removed {
                self.combing.remove(index);
            }
        });
    }

    fn camera_row(&mut self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            let camera = self.combing.combed().camera;
            let mut is_view = camera.is_some();
            let view = ui.checkbox(&mut is_view, tr("View of a model"));
            let tip =
                tr("The picture shows a model, seen from the camera that it was painted with");
            if view.on_hover_text(tip).changed() {
                self.combing.set_view(is_view);
            }
            let Some(mut camera) = camera.filter(|_| is_view) else { return };
            let mut changed = false;
            let [around, above, view] = &mut camera;
            for (value, range, name, tip) in [
                (
                    around,
                    -360.0..=360.0,
                    tr("around"),
                    tr("Degrees around the model, 0 from the front"),
                ),
                (above, -90.0..=90.0, tr("above"), tr("Degrees above the horizon")),
                (view, 1.0..=170.0, tr("view"), tr("Angle of the field of view in degrees")),
            ] {
                let drag = DragValue::new(value).range(range).speed(1.0).max_decimals(1);
                let drag = ui.add(drag.prefix(format!("{name} ")).suffix("\u{b0}"));
                changed |= drag.on_hover_text(tip).changed();
            }
            if changed {
                self.combing.set_camera(camera);
            }
        });
    }

    /// Draws the row of a guide. Returns whether you clicked its button that removes it.
    fn guide_row(&mut self, ui: &mut Ui, index: usize) -> bool {
        let line = &self.combing.combed().lines[index];
        let lengths = line.windows(2).map(|ends| {
            let [[x, y], [to_x, to_y]] = [ends[0], ends[1]];
            (to_x - x).hypot(to_y - y)
        });
        let length: f64 = lengths.sum();
        let number = index + 1;
        ui.horizontal(|ui| {
            let chosen = Button::selectable(
                self.combing.selected == index,
                tr_format!("Guide {number}, {length:.0} px", number, length),
            );
            if ui.add(chosen).on_hover_text(tr("Selects the guide")).clicked() {
                self.combing.selected = index;
            }
            let name = tr_format!("Reverse guide {number}", number);
            let tip = tr("Strokes flow the other way");
            if named_button(ui, tr("Reverse"), &name, tip, None) {
                self.combing.reverse(index);
            }
            named_button(
                ui,
                "\u{d7}",
                &tr_format!("Delete guide {number}", number),
                tr("Removes the guide"),
                None,
            )
        })
        .inner
    }
}

fn space_held(ui: &Ui) -> bool {
    ui.input(|input| input.key_down(Key::Space))
}

/// Width of number and button at the right of a sample, in points.
const RIGHT: f32 = 104.0;

/// Draws the colour of a sample as a button. Returns whether you clicked it.
fn patch(ui: &mut Ui, name: &str, index: usize, selected: bool) -> bool {
    let (rect, response) =
        ui.allocate_exact_size(theme::at_least(ui, vec2(20.0, 20.0)), Sense::click());
    let words = tr_format!("Select {name}", name);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, &words));
    let width = if selected { 2.0 } else { 0.0 };
    let edge = Stroke::new(width, theme::colors(ui.ctx()).strong);
    ui.painter().rect(rect.shrink(2.0), 2, screen_color(index), edge, StrokeKind::Outside);
    response.on_hover_text(tr("Selects the sample; Spacing is for the selected one")).clicked()
}

/// Command line that takes samples of `picture` at the marks in a file.
fn sample_command(picture: &Path, marks: &Path) -> String {
    let samples = picture.with_extension("samples.exr");
    let sheet = picture.with_extension("samples.png");
    let [picture, marks, samples, sheet] = [picture, marks, &samples, &sheet].map(quoted);
    format!("impasto artmap sample {picture} --marks {marks} --output {samples} --sheet {sheet}")
}

/// Command line that paints a picture along the guides in a file. With a camera it paints a model,
/// and you fill in the model's name.
fn paint_command(picture: &Path, camera: Option<[f32; 3]>, guides: &Path) -> String {
    let painted = quoted(&picture.with_extension("painted.png"));
    let subject = match camera {
        Some([around, above, view]) => format!("MODEL --camera {around},{above},{view}"),
        None => quoted(picture),
    };
    let guides = quoted(guides);
    format!(
        "impasto painterly {subject} --style oil-flat --directions {guides} --picture {painted}"
    )
}

fn quoted(path: &Path) -> String {
    let text = path.to_string_lossy();
    if !text.is_empty()
        && text.bytes().all(|byte: u8| byte.is_ascii_alphanumeric() || b"/._-".contains(&byte))
        && !text.starts_with('-')
    {
        return text.into_owned();
    }
    let dash = if text.starts_with('-') { "./" } else { "" };
    format!("'{dash}{}'", text.replace('\'', "'\\''"))
}

/// Draws a command line with a button that copies it. `tip` explains it.
fn next_step(ui: &mut Ui, tip: &str, command: &str) {
    ui.horizontal(|ui| {
        if named_button(ui, tr("Copy"), tr("Copy command"), tr("Copies the command"), None) {
            ui.ctx().copy_text(command.to_owned());
        }
        let text = RichText::new(command).monospace().size(11.0);
        ui.add(Label::new(text).truncate()).on_hover_text(format!("{tip}: {command}"));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_words_of_a_shell() {
        let command = sample_command(Path::new("a b/o'k.png"), Path::new("m.toml"));
        let wanted = "impasto artmap sample 'a b/o'\\''k.png' --marks m.toml --output \
                      'a b/o'\\''k.samples.exr' --sheet 'a b/o'\\''k.samples.png'";
        assert_eq!(command, wanted);
        assert_eq!(quoted(Path::new("-x.png")), "'./-x.png'");
    }

    #[test]
    fn guides_of_a_view_need_its_model_and_camera() {
        let rest = "--style oil-flat --directions g.toml --picture a.painted.png";
        assert_eq!(
            paint_command(Path::new("a.png"), None, Path::new("g.toml")),
            format!("impasto painterly a.png {rest}")
        );
        let model = "impasto painterly MODEL --camera 30,20.5,30";
        assert_eq!(
            paint_command(Path::new("a.png"), Some([30.0, 20.5, 30.0]), Path::new("g.toml")),
            format!("{model} {rest}")
        );
    }
}
