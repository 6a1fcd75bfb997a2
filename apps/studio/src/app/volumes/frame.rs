//! One frame of the workspace of scenes: draws its bars and panels, and performs its intents.

use std::sync::Arc;

use eframe::egui::{
    Align, CentralPanel, Context, Event, FocusDirection, Frame, Key, Label, Layout, Margin, Panel,
    Ui, ViewportCommand,
};
use session::volumes::{Inside, SceneState, Show, VolumeCommand};
use web_time::{Duration, Instant};

use super::bars;
use super::bars::enabled;
use super::intent::{SceneIntent, scene_key_rows};
use super::workspace::Volumes;
use crate::app::bars::small;
use crate::files::Files;
use crate::keymap::{KeyTable, installed};
use crate::language::{tr, tr_format};
use crate::panels::volumes::{
    SceneExport, SceneFileRequest, SceneRequest, TIME_BAR_HEIGHT, show_side, show_time_bar,
};
use crate::pen::Pen;
use crate::view::fill_rect;
use crate::{floating, theme};

impl Volumes {
    /// Draws the workspace over the whole window. Returns intents that the window must carry out.
    pub(in crate::app) fn show(
        &mut self,
        ui: &mut Ui,
        panels: bool,
        pen: &mut Pen,
        files: &mut Files,
    ) -> Option<WindowIntent> {
        let context = ui.ctx().clone();
        let mut left = None;
        if !files.has_dialog() {
            for intent in self.read_keys(&context) {
                left = self.perform(intent, &context).or(left);
            }
        }
        let mut intent = None;
        if panels {
            intent = self.show_panels(ui);
        }
        if let Some(intent) = intent {
            left = self.perform(intent, &context).or(left);
        }
        CentralPanel::no_frame().show(ui, |ui| {
            let rect = ui.available_rect_before_wrap();
            floating::set_room(ui.ctx(), rect);
            self.show_canvas(ui, rect, pen);
        });
        self.send_requests(files);
        self.keep_awake(&context);
        left
    }

    /// Draws everything around the picture. Returns the intent of menu or toolbar.
    fn show_panels(&mut self, ui: &mut Ui) -> Option<SceneIntent> {
        let context = ui.ctx().clone();
        let bar = Frame::new().inner_margin(Margin::symmetric(6, 2));
        let state = self.state.clone();
        let state = state.as_deref();
        let mut intent = None;
        let title = self.title();
        Panel::top("scene menus").frame(bar).show_separator_line(false).show(ui, |ui| {
            fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
            intent = bars::show_menus(ui, state, &title);
        });
        Panel::bottom("scene line").frame(bar).exact_size(24.0).show_separator_line(false).show(
            ui,
            |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                self.status_line(ui);
            },
        );
        let column = bar.inner_margin(Margin::symmetric(4, 6));
        Panel::left("scene tools")
            .frame(column)
            .resizable(false)
            .exact_size(crate::app::bars::width(&context))
            .show_separator_line(false)
            .show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).bar);
                intent = intent.or(bars::show_toolbar(ui, self.tools.grip.tool, state));
            });
        let side = Frame::new().inner_margin(Margin::symmetric(8, 6));
        Panel::right("scene side")
            .frame(side)
            .resizable(false)
            .exact_size(theme::panel_width(&context))
            .show_separator_line(false)
            .show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).panel);
                self.with_panels(|cx| show_side(ui, cx));
            });
        Panel::bottom("scene time")
            .frame(bar.inner_margin(Margin::symmetric(8, 0)))
            .exact_size(TIME_BAR_HEIGHT)
            .show_separator_line(false)
            .show(ui, |ui| {
                fill_rect(ui.painter(), ui.clip_rect(), theme::colors(ui.ctx()).panel);
                self.with_panels(|cx| show_time_bar(ui, cx));
            });
        intent
    }

    fn send_requests(&mut self, files: &mut Files) {
        for request in std::mem::take(&mut self.requests) {
            match request {
                SceneRequest::Worker(command) => self.worker.ask(command),
                SceneRequest::File(SceneFileRequest::Open(None)) => files.ask_for_scene(),
                SceneRequest::File(SceneFileRequest::Open(Some(path))) => {
                    self.open(session::volumes::Subject::of_file(&path));
                }
                SceneRequest::File(SceneFileRequest::Library) => files.ask_for_scene_library(),
                SceneRequest::File(SceneFileRequest::Export(export)) => {
                    files.ask_where_to_export_scene(export);
                }
                SceneRequest::File(SceneFileRequest::ExportOfPainting) => {
                    files.ask_what_to_export_of_scene();
                }
            }
        }
    }

    /// Removes this frame's key events and returns their intents.
    pub(super) fn read_keys(&self, context: &Context) -> Vec<SceneIntent> {
        if context.text_edit_focused() {
            return Vec::new();
        }
        let focused = context.memory(|memory| memory.focused().is_some());
        let mut intents = Vec::new();
        let mut tabbed = false;
        let table = installed(context).map_or_else(
            || Arc::new(KeyTable::new(scene_key_rows())),
            |keymap| keymap.scenes.clone(),
        );
        context.input_mut(|input| {
            input.events.retain(|event| {
                let Event::Key { key, pressed: true, repeat, modifiers, .. } = event else {
                    return true;
                };
                // A focused control handles these keys itself.
                if focused && matches!(key, Key::Tab | Key::Space | Key::Enter) {
                    return true;
                }
                let Some(intent) = SceneIntent::of_key(&table, *key, *modifiers) else {
                    return true;
                };
                if !*repeat || intent.repeats() {
                    tabbed |= *key == Key::Tab;
                    intents.push(intent);
                }
                false
            });
        });
        if tabbed {
            context.memory_mut(|memory| memory.move_focus(FocusDirection::None));
        }
        intents
    }

    /// Performs one intent. If the window must carry it out, this returns it.
    pub(super) fn perform(
        &mut self,
        intent: SceneIntent,
        context: &Context,
    ) -> Option<WindowIntent> {
        if !enabled(intent, self.state()) {
            return None;
        }
        match intent {
            SceneIntent::New => self.open_new(),
            SceneIntent::Open => self.file(SceneFileRequest::Open(None)),
            SceneIntent::Save => self.file(SceneFileRequest::Export(SceneExport::Script)),
            SceneIntent::Easel => return Some(WindowIntent::Easel),
            SceneIntent::Quit => context.send_viewport_cmd(ViewportCommand::Close),
            SceneIntent::Library => self.file(SceneFileRequest::Library),
            SceneIntent::DryAll => self.ask(VolumeCommand::DryAll),
            SceneIntent::Undo => self.ask(VolumeCommand::Undo),
            SceneIntent::Play => {
                let playing = self.state().is_some_and(|state| state.time.playing);
                self.ask(VolumeCommand::Play(!playing));
            }
            SceneIntent::Step => self.ask(VolumeCommand::StepOnce),
            SceneIntent::Start => self.ask(VolumeCommand::Seek(0)),
            SceneIntent::Volumes => self.with_panels(|cx| {
                cx.change_look(|look| {
                    look.show = match look.show {
                        Show::Volumes => Show::Final,
                        _ => Show::Volumes,
                    };
                });
            }),
            SceneIntent::Hatching => {
                self.with_panels(|cx| cx.change_look(|look| look.hatching ^= true));
            }
            SceneIntent::Inside => {
                if let Some(inside) =
                    self.state().map(|state| state.look.inside.next(state.by_region))
                {
                    self.with_panels(|cx| cx.change_look(|look| look.inside = inside));
                    self.tell_inside(inside);
                }
            }
            SceneIntent::Frame => self.orbit.frame(),
            SceneIntent::More => self.change_rate(STEP),
            SceneIntent::Less => self.change_rate(1.0 / STEP),
            SceneIntent::Tube(number) => {
                let number = usize::from(number) - 1;
                let tubes = self.state().map_or(0, |state| state.tubes.len());
                if number < tubes {
                    self.tools.grip.tube = number;
                }
            }
            SceneIntent::Tool(tool) => self.tools.grip.tool = tool,
            SceneIntent::Preferences => return Some(WindowIntent::Preferences),
            SceneIntent::Panels => return Some(WindowIntent::Panels),
            SceneIntent::FullScreen => {
                let full = context.input(|input| input.viewport().fullscreen.unwrap_or(false));
                context.send_viewport_cmd(ViewportCommand::Fullscreen(!full));
            }
            SceneIntent::Keys => return Some(WindowIntent::Keys),
        }
        None
    }

    fn change_rate(&mut self, factor: f64) {
        let [least, most] = RATES;
        let rate = &mut self.tools.grip.rate_mm3_s;
        *rate = (*rate * factor).clamp(least, most);
        let text = tr_format!("pours {rate:.0} mm3 a second", rate);
        self.say(text);
    }

    /// Says in the status line what volumes show from now on.
    fn tell_inside(&mut self, inside: Inside) {
        self.say(match inside {
            Inside::OwnColours => tr("inside: the subject's own colours").to_owned(),
            Inside::Glaze => tr("inside: a glaze of the poured pigments").to_owned(),
            Inside::Both => tr("inside: the pigments over the subject's own colours").to_owned(),
            Inside::ByRegion => tr("inside: what the script names for each region").to_owned(),
        });
    }

    pub(super) fn status_line(&self, ui: &mut Ui) {
        let Some(state) = &self.state else {
            ui.weak(tr("preparing the scene"));
            return;
        };
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 14.0;
            if state.time.playing {
                let speed = tr_format!("{speed:.0} % of real time", speed = 100.0 * state.time.speed);
                ui.label(small(ui, &speed)).on_hover_text(tr("Speed of time over the last second"));
            }
            let moves = self.shown_at.is_some_and(|at| at.elapsed() < Duration::from_secs(1));
            let rate = if moves { self.frames.rate().frames_a_second } else { 0.0 };
            let rate = match rate.round() {
                1.0 => tr("1 picture/s").to_owned(),
                _ => tr_format!("{rate:.0} pictures/s", rate),
            };
            ui.label(small(ui, &rate))
                .on_hover_text(tr("Pictures drawn in the last second; none while the scene rests"));
            ui.label(small(ui, &paint_text(state)))
                .on_hover_text(tr("Paint poured, on the surfaces, taken up, and left in the tubes"));
            ui.label(small(ui, &volumes_text(state)))
                .on_hover_text(tr("Volumes of paint, and the particles of all of them"));
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if state.prepares {
                    ui.spinner();
                    ui.label(tr("mixing the paint")).on_hover_text(
                        tr("The pigments are prepared for the picture, which shows them when it is done"),
                    );
                }
                let message = self.message.as_ref();
                if let Some(message) =
                    message.filter(|message| message.is_displayed(Instant::now()))
                {
                    // If the text is cut, its tooltip has all of it.
                    ui.add(Label::new(&message.text).truncate());
                }
            });
        });
    }
}

/// One key press changes the rate by this factor.
const STEP: f64 = 1.25;

/// Lowest and highest rate in mm3 a second.
const RATES: [f64; 2] = [1.0, 1000.0];

/// An intent that the window itself carries out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::app) enum WindowIntent {
    Easel,
    Panels,
    Keys,
    Preferences,
}

/// How much paint you poured, took up again, and left in the tubes, as text.
fn paint_text(state: &SceneState) -> String {
    let tally = &state.tally;
    let mut text = tr_format!("{poured_mm3} poured", poured_mm3 = cubic(tally.poured_mm3));
    for (amount, what) in
        [(tally.lifted_mm3, tr("taken up")), (tally.left_mm3, tr("left in the tubes"))]
    {
        if amount > 0.0 {
            text.push_str(&format!(", {} {what}", cubic(amount)));
        }
    }
    text
}

fn volumes_text(state: &SceneState) -> String {
    match state.tally.volumes {
        1 => tr("1 volume").to_owned(),
        count => tr_format!("{count} volumes", count),
    }
}

/// A volume as text, with two digits or more.
fn cubic(mm3: f64) -> String {
    if mm3 >= 10.0 || mm3 == 0.0 { format!("{mm3:.0} mm3") } else { format!("{mm3:.1} mm3") }
}
