//! Context in which you draw a panel of a scene (its state, the tools, and a queue of requests),
//! the time bar with its track of events, and the choosers of pigments and illuminants.

use std::path::PathBuf;

use eframe::egui::{
    Align2, Context, FontId, Key, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
    pos2, vec2,
};
use paint::document::Medium;
use session::volumes::{Grip, Here, Look, STEPS_A_SECOND, SceneState, SceneTool, VolumeCommand};
use spectra::light_from_text;

use crate::files::SceneExport;
use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::panels::controls::{button, row_height};
use crate::panels::light::{IlluminantControl, WhitePoint, power_chart};
use crate::panels::pigments::{CatalogueCache, PigmentList};
use crate::{floating, theme};

/// Tabs of the side panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SceneTab {
    /// The picture.
    #[default]
    View,
    /// The light.
    Light,
    /// The findings of the last right click.
    Here,
    /// The list of events.
    Events,
    /// Files made from a scene.
    Export,
}

/// Tools and panels, as you set them.
#[derive(Debug, Default)]
pub struct SceneTools {
    /// The tool in hand and its settings.
    pub grip: Grip,
    /// The tab of the side panel.
    pub tab: SceneTab,
    /// Controls of the illuminant.
    pub illuminant: SceneIlluminant,
    /// Window that chooses the pigments of tubes.
    pub chooser: TubeChooser,
    /// The last answer to a right click.
    pub here: Option<Here>,
}

/// An action on files that you can request in menus and panels.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneFileRequest {
    /// Opens a scene. Without a path, this asks for its file.
    Open(Option<PathBuf>),
    /// Asks for a library and fills the tubes from it.
    Library,
    /// Asks where to write a file, and writes it.
    Export(SceneExport),
    /// Asks which export of the painting to write, and where.
    ExportOfPainting,
}

/// Request of a panel.
#[derive(Debug)]
pub enum SceneRequest {
    /// Command for the worker.
    Worker(VolumeCommand),
    /// Request for files.
    File(SceneFileRequest),
}

/// Input and output of a panel in one frame.
#[derive(Debug)]
pub struct SceneContext<'a> {
    /// State of the scene as last reported.
    pub state: &'a SceneState,
    /// Tools and panels.
    pub tools: &'a mut SceneTools,
    /// Requests in order. The window carries them out after the frame.
    pub requests: &'a mut Vec<SceneRequest>,
}

impl SceneContext<'_> {
    /// Queues a command for the worker.
    pub fn command(&mut self, command: VolumeCommand) {
        self.requests.push(SceneRequest::Worker(command));
    }

    /// Queues a request for files.
    pub fn file(&mut self, request: SceneFileRequest) {
        self.requests.push(SceneRequest::File(request));
    }

    /// Queues a change of the picture.
    pub fn change_look(&mut self, change: impl FnOnce(&mut Look)) {
        let mut look = self.state.look;
        change(&mut look);
        if look != self.state.look {
            self.command(VolumeCommand::Look(look));
        }
    }
}

/// Height of the bar, in points. It is enough for buttons in touch mode.
pub const TIME_BAR_HEIGHT: f32 = 46.0;

const BUTTON: f32 = 28.0;

const TEXT: f32 = 128.0;

/// Shortest time that the track shows, in steps: 5 s.
const SHORTEST: u64 = 5 * STEPS_A_SECOND;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Start,
    Play,
    Pause,
    Step,
}

/// Seconds and hundredths of a number of steps, e.g. `3.25 s`.
#[must_use]
pub fn seconds_text(steps: u64) -> String {
    format!("{:.2} s", steps as f64 / STEPS_A_SECOND as f64)
}

/// Draws the bar over the available width.
pub fn show_time_bar(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let time = cx.state.time;
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let tip = format!("{}{}", tr("Goes to the start"), hint(ui.ctx(), "scene.start"));
        if sign_button(ui, Sign::Start, tr("From the start"), &tip) {
            cx.command(VolumeCommand::Seek(0));
        }
        let (sign, name, tip) = match time.playing {
            true => (Sign::Pause, tr("Pause"), tr("Stops time")),
            false => (Sign::Play, tr("Play"), tr("Lets time run")),
        };
        let tip = format!("{tip}{}", hint(ui.ctx(), "scene.play"));
        if sign_button(ui, sign, name, &tip) {
            cx.command(VolumeCommand::Play(!time.playing));
        }
        let tip = format!("{}{}", tr("Takes one step of 1/120 s"), hint(ui.ctx(), "scene.step"));
        if sign_button(ui, Sign::Step, tr("Step"), &tip) {
            cx.command(VolumeCommand::StepOnce);
        }
        ui.add_space(10.0);
        let size = vec2((ui.available_width() - TEXT).max(60.0), row_height(ui, BUTTON));
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        track(ui, rect, response, cx);
        let words = tr_format!(
            "{step} of {end}",
            step = seconds_text(time.step),
            end = seconds_text(time.end)
        );
        let at = pos2(rect.right() + TEXT - 4.0, rect.center().y);
        let font = FontId::proportional(12.0);
        ui.painter().text(at, Align2::RIGHT_CENTER, words, font, theme::colors(ui.ctx()).text);
    });
}

/// Draws a button with a sign. Returns whether you clicked it.
fn sign_button(ui: &mut Ui, sign: Sign, name: &str, tip: &str) -> bool {
    let (rect, response) =
        ui.allocate_exact_size(theme::at_least(ui, vec2(BUTTON, BUTTON)), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    let visuals = ui.style().interact(&response);
    let painter = ui.painter();
    painter.rect(rect, theme::CORNER_RADIUS, visuals.bg_fill, Stroke::NONE, StrokeKind::Inside);
    let middle = rect.center();
    let color = visuals.fg_stroke.color;
    let triangle = |x: f32| {
        let points = vec![
            middle + vec2(x - 4.0, -6.0),
            middle + vec2(x + 5.0, 0.0),
            middle + vec2(x - 4.0, 6.0),
        ];
        eframe::egui::Shape::convex_polygon(points, color, Stroke::NONE)
    };
    let bar = |x: f32| {
        let bar = Rect::from_center_size(middle + vec2(x, 0.0), vec2(3.0, 12.0));
        painter.rect_filled(bar, 0, color);
    };
    match sign {
        Sign::Start => {
            let points =
                vec![middle + vec2(5.0, -6.0), middle + vec2(-4.0, 0.0), middle + vec2(5.0, 6.0)];
            painter.add(eframe::egui::Shape::convex_polygon(points, color, Stroke::NONE));
            bar(-6.0);
        }
        Sign::Play => {
            painter.add(triangle(0.0));
        }
        Sign::Pause => {
            bar(-3.5);
            bar(3.5);
        }
        Sign::Step => {
            bar(-5.0);
            painter.add(triangle(2.0));
        }
    }
    response.on_hover_text(tip).clicked()
}

/// Last moment of the track. There is always room to continue.
fn length(state: &SceneState) -> u64 {
    state.time.end.max(SHORTEST)
}

/// Draws the track with its events. You drag on it to go to a moment.
fn track(ui: &Ui, rect: Rect, response: Response, cx: &mut SceneContext<'_>) {
    let time = cx.state.time;
    let length = length(cx.state);
    response.widget_info(|| {
        let mut info = WidgetInfo::slider(true, time.step as f64, tr("Time"));
        info.current_text_value = Some(seconds_text(time.step));
        info
    });
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, tr("Time")));
    let line = Rect::from_center_size(rect.center(), vec2(rect.width() - 12.0, 6.0));
    let x =
        |step: u64| line.left() + line.width() * (step.min(length) as f64 / length as f64) as f32;
    if let Some(pointer) = response.interact_pointer_pos() {
        let share = f64::from((pointer.x - line.left()) / line.width()).clamp(0.0, 1.0);
        let step = ((share * length as f64).round() as u64).min(time.end);
        if step != time.step {
            cx.command(VolumeCommand::Seek(step));
        }
    }
    if response.has_focus() {
        let [right, left] = [Key::ArrowRight, Key::ArrowLeft]
            .map(|key| ui.input(|input| input.num_presses(key)) as i64);
        let steps = right - left;
        if steps != 0 {
            let to = time.step.saturating_add_signed(12 * steps).min(time.end);
            cx.command(VolumeCommand::Seek(to));
        }
    }
    let painter = ui.painter_at(rect);
    painter.rect_filled(line, 3, theme::colors(ui.ctx()).well);
    let reached = Rect::from_x_y_ranges(line.left()..=x(time.end), line.y_range());
    painter.rect_filled(reached, 3, theme::colors(ui.ctx()).button);
    for event in cx.state.events.iter() {
        let ends = x(event.to).max(x(event.from) + 3.0);
        let mark = Rect::from_x_y_ranges(x(event.from)..=ends, line.y_range().expand(3.0));
        let fill = match event.tool {
            Some(SceneTool::Pour) | None => theme::colors(ui.ctx()).text,
            Some(_) => theme::colors(ui.ctx()).faint,
        };
        painter.rect_filled(mark, 1, fill);
    }
    let knob = pos2(x(time.step), line.center().y);
    painter.vline(knob.x, rect.y_range(), Stroke::new(2.0, theme::colors(ui.ctx()).strong));
    painter.circle(
        knob,
        6.0,
        theme::colors(ui.ctx()).strong,
        Stroke::new(1.5, theme::colors(ui.ctx()).bar),
    );
    response.on_hover_text(tr("Drag to go to a moment; the scene is replayed to the bit"));
}

const WIDTH: f32 = 400.0;

/// State of the window.
#[derive(Debug, Default)]
pub struct TubeChooser {
    /// Number of the tube, from 0, while the window is open.
    tube: Option<usize>,
    list: PigmentList,
    catalogue: CatalogueCache,
}

/// Your choice in the window.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum TubeChoice {
    /// A pigment for the tube with this number, by its name.
    Pigment(usize, String),
    /// Another library.
    Library,
}

impl TubeChooser {
    pub(super) fn open(&mut self, tube: usize) {
        (self.tube, self.list) = (Some(tube), PigmentList::default());
    }

    /// Draws the window if it is open. Returns your choice.
    pub(super) fn show(&mut self, context: &Context, state: &SceneState) -> Option<TubeChoice> {
        let tube = self.tube?;
        let name = &state.tubes.get(tube)?.name;
        let catalogue = self.catalogue.under(&state.library, &state.light);
        let scattering = Medium::of(&state.library).scattering_per_mm;
        let mut open = true;
        let mut choice = None;
        floating::show(context, tr("Choose a pigment"), tr("choose a pigment"), &mut open, |ui| {
            ui.set_width(WIDTH);
            ui.label(tr_format!("Tube {tube}: {name}", tube = tube + 1, name));
            ui.weak(tr("What was poured from this tube is paint of its new pigment."));
            ui.horizontal(|ui| {
                ui.label(&state.library.title);
                let tip = tr("Fills all tubes from another pigment library (.json)");
                if button(ui, tr("Open another library..."), tip, None) {
                    choice = Some(TubeChoice::Library);
                }
            });
            if let Some(pigment) = self.list.show(ui, &catalogue, scattering, |pigment| {
                let name = catalogue.name(pigment);
                let number = state.tubes.iter().position(|tube| tube.name == name)?;
                Some(tr_format!("it is already in tube {number}", number = number + 1))
            }) {
                choice = Some(TubeChoice::Pigment(tube, catalogue.name(pigment).to_owned()));
            }
        });
        if !open {
            self.tube = None;
        }
        choice
    }
}

/// Controls of the illuminant.
#[derive(Debug)]
pub struct SceneIlluminant {
    control: IlluminantControl,
    white: Option<WhitePoint>,
}

impl Default for SceneIlluminant {
    fn default() -> Self {
        Self { control: IlluminantControl::new(tr("Illuminant"), tr("Temperature")), white: None }
    }
}

impl SceneIlluminant {
    /// Draws the choice of the illuminant, its spectral power and its white point. Returns the name
    /// of the light that you chose.
    pub(super) fn show(&mut self, ui: &mut Ui, state: &SceneState) -> Option<String> {
        ui.label(tr("Light on pigments")).on_hover_text(tr(
            "Light on the pigments of glazes and of the exported painting; the subject's own \
             colours stay as they are",
        ));
        let chosen = self.control.show(ui, &state.illuminant);
        let light = &state.light;
        let preview = self.control.preview().and_then(|name| light_from_text(&name).ok());
        let others: Vec<_> =
            preview.into_iter().map(|other| (other, theme::colors(ui.ctx()).strong)).collect();
        power_chart(ui, light, &others);
        if !self.white.as_ref().is_some_and(|white| white.is_of(light)) {
            self.white = Some(WhitePoint::of(light));
        }
        if let Some(white) = &self.white {
            white.show(ui);
        }
        chosen.filter(|chosen| *chosen != state.illuminant)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_told_in_seconds() {
        assert_eq!([0, 1, 60, 390].map(seconds_text), ["0.00 s", "0.01 s", "0.50 s", "3.25 s"]);
    }
}
