//! Performs the intents of menus, toolbar and keyboard in a scene.

use std::sync::Arc;

use eframe::egui::{Context, Event, FocusDirection, Key, ViewportCommand};
use session::volumes::{Inside, SceneState, Show, VolumeCommand};

use super::entries::scene_key_rows;
use super::intent::SceneIntent;
use super::menus::enabled;
use super::workspace::Volumes;
use crate::keymap::{KeyTable, installed};
use crate::language::{tr, tr_format};
use crate::panels::volumes::{SceneExport, SceneFileRequest};

/// Factor of the rate for one key press.
const STEP: f64 = 1.25;

/// Lowest and highest rate in mm3 a second.
const RATES: [f64; 2] = [1.0, 1000.0];

/// An intent that the window itself carries out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::app) enum WindowIntent {
    /// Shows the easel.
    Easel,
    /// Shows or hides the panels.
    Panels,
    /// Shows or hides the table of keys.
    Keys,
    /// Shows the preferences.
    Preferences,
}

impl Volumes {
    /// Intents of this frame's key events, which are removed.
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

    /// Performs one intent. Returns what is left to the window.
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
                let next = |state: &SceneState| state.look.inside.next(state.by_region);
                if let Some(inside) = self.state().map(next) {
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

    /// Tells what volumes show from now on.
    fn tell_inside(&mut self, inside: Inside) {
        self.say(match inside {
            Inside::OwnColours => tr("inside: the subject's own colours").to_owned(),
            Inside::Glaze => tr("inside: a glaze of the poured pigments").to_owned(),
            Inside::Both => tr("inside: the pigments over the subject's own colours").to_owned(),
            Inside::ByRegion => tr("inside: what the script names for each region").to_owned(),
        });
    }
}
