//! Context in which you draw a panel: the painting, the tools with their settings, and a queue of
//! requests.

use std::f64::consts::TAU;
use std::sync::Arc;

use eframe::egui::{Response, Ui};
use paint::strokes::{Action, Load, Recipe, StrokeTool};
use serde::Serialize;
use session::swatches::{KeptMixture, SwatchChange};
use session::{Command, PaintingState, Picked};

use crate::files::FileRequest;
use crate::view::Outline;

/// A brush is full if less than this height of paint fits on it, in mm. This is the smallest load
/// that the panel offers.
const LEAST_LOAD_MM: f64 = 0.02;

/// Number of mixtures that we remember as loaded last.
const MOST_RECENT: usize = 6;

/// Request of a panel.
#[derive(Debug)]
pub enum Request {
    /// Command for the worker.
    Worker(Command),
    /// Request for the file manager.
    File(FileRequest),
}

/// Input and output of a panel in one frame.
#[derive(Debug)]
pub struct PanelContext<'a> {
    /// State of the painting as last reported by the worker.
    pub painting: &'a PaintingState,
    /// Selected tool, brush and tool settings.
    pub tools: &'a mut Tools,
    /// Requests in order. The window carries them out after the frame.
    pub requests: &'a mut Vec<Request>,
}

impl PanelContext<'_> {
    /// Queues a command for the worker.
    pub fn command(&mut self, command: Command) {
        self.requests.push(Request::Worker(command));
    }

    /// Queues an action. It becomes one entry of the history.
    pub fn act(&mut self, action: Action) {
        self.command(Command::Apply(action));
    }

    /// Adds paint of a recipe with this share of medium to the selected brush, and selects the
    /// paint tool. The height comes from the tools, or from the room left on the brush. The paint
    /// on the brush stays until you wash it.
    pub fn load(&mut self, recipe: Recipe, vehicle: f64) {
        if recipe.len() > 1 {
            let recent = &mut self.tools.recent;
            recent.retain(|(known, _)| *known != recipe);
            recent.insert(0, (recipe.clone(), vehicle));
            recent.truncate(MOST_RECENT);
        }
        let brush = self.tools.brush.clone();
        let mut amount_mm = self.tools.load_mm;
        let state = self.painting.brushes.iter().find(|state| state.name == brush);
        // If the brush is full, we send the whole load. The refusal explains what to do.
        if let Some(most_mm) = state.map(|state| state.most_load_mm)
            && most_mm >= LEAST_LOAD_MM
        {
            amount_mm = amount_mm.min(most_mm);
        }
        self.act(Action::Load(Load { brush, recipe, vehicle, amount_mm }));
        self.tools.mode = Mode::Paint;
    }

    /// Queues a file request.
    pub fn file(&mut self, request: FileRequest) {
        self.requests.push(Request::File(request));
    }
}

/// Tool: the effect of the pen on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Paints with the brush.
    #[default]
    Paint,
    /// Picks colour and paint (eyedropper).
    Pick,
    /// Moves the view.
    Pan,
    /// Rotates the view.
    Rotate,
    /// Zooms the view.
    Zoom,
    /// Squeezes paint from the selected tube.
    Squeeze,
    /// Softens and mixes wet paint with the clean head of the brush.
    Blend,
    /// Scrapes wet paint off with the head of the brush.
    Scrape,
    /// Rubs wet paint off with the head of the brush.
    Erase,
    /// Draws the polygon or rectangle that a mask leaves open.
    Mask,
}

impl Mode {
    /// Whether the pen moves the head of a brush.
    #[must_use]
    pub fn moves_head(self) -> bool {
        matches!(self, Self::Paint | Self::Blend | Self::Scrape | Self::Erase)
    }

    const ALL: [Self; 10] = [
        Self::Paint,
        Self::Blend,
        Self::Scrape,
        Self::Erase,
        Self::Mask,
        Self::Pick,
        Self::Pan,
        Self::Rotate,
        Self::Zoom,
        Self::Squeeze,
    ];

    /// Name of the tool in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Paint => "paint",
            Self::Blend => "blend",
            Self::Scrape => "scrape",
            Self::Erase => "erase",
            Self::Mask => "mask",
            Self::Pick => "pick",
            Self::Pan => "pan",
            Self::Rotate => "rotate",
            Self::Zoom => "zoom",
            Self::Squeeze => "squeeze",
        }
    }

    /// The tool with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mode| mode.name() == name)
    }
}

/// Selected tool, brush and tube, and their settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Tools {
    /// Tool selected in the toolbar.
    pub mode: Mode,
    /// Name of the selected brush.
    pub brush: String,
    /// Slot of the selected tube.
    pub tube: usize,
    /// Share of clear medium in a load of the brush, 0 to 1.
    pub vehicle: f64,
    /// Height of the paint that one load adds to the brush head, in mm.
    pub load_mm: f64,
    /// Share of the brush's paint that remains after wiping, 0 to 1.
    pub wipe_keep: f64,
    /// Volume of one squeeze, in cubic mm.
    pub squeeze_mm3: f64,
    /// Share of the wet paint that one drying action dries, 0 to 1.
    pub dry_share: f64,
    /// How much blending mixes and moves the paint, above 0 to 1.
    pub blend_strength: f64,
    /// Height of the scraper over the ground at pressure 0, in mm.
    pub scrape_mm: f64,
    /// How much erasing takes, above 0 to 1.
    pub erase_strength: f64,
    /// Radius of the disc that the eyedropper averages, in mm; 0 is one cell.
    pub pick_radius_mm: f64,
    /// Mixtures of two or more pigments that you loaded last, with their share of medium, the
    /// latest first.
    pub recent: Vec<(Recipe, f64)>,
    /// Last result of the eyedropper.
    pub picked: Option<Arc<Picked>>,
    /// Colour picked from the reference picture, linear sRGB.
    pub reference_color: Option<[f64; 3]>,
    /// Position of the boundary between the two lights of the split view, as a share of the canvas
    /// width, 0 (left) to 1 (right).
    pub split: f32,
    /// Whether you see the performance figures over the canvas.
    pub figures: bool,
}

impl Default for Tools {
    fn default() -> Self {
        Self {
            mode: Mode::Paint,
            brush: "round".to_owned(),
            tube: 0,
            vehicle: 0.15,
            load_mm: 0.3,
            wipe_keep: 0.3,
            squeeze_mm3: 60.0,
            dry_share: 1.0,
            blend_strength: 0.5,
            scrape_mm: 0.0,
            erase_strength: 0.5,
            pick_radius_mm: 0.5,
            recent: Vec::new(),
            picked: None,
            reference_color: None,
            split: 0.5,
            figures: false,
        }
    }
}

impl Tools {
    /// The tool of the brush head in this mode. Modes without a head give the paint tool.
    #[must_use]
    pub fn stroke_tool(&self, mode: Mode) -> StrokeTool {
        match mode {
            Mode::Blend => StrokeTool::Blend { strength: self.blend_strength },
            Mode::Scrape => StrokeTool::Scrape { height_mm: self.scrape_mm },
            Mode::Erase => StrokeTool::Erase { strength: self.erase_strength },
            _ => StrokeTool::Paint,
        }
    }
}

/// Clearance around a new heap of paint, divided by the cube root of its volume. The heap itself
/// has a radius of 0.94 of this root (`Painting::squeeze`).
const REACH: f64 = 1.2;

/// Squeezes a heap of a mixture, with the volume set in the tools, on a free place of the palette.
pub(super) fn lay_on_palette(cx: &mut PanelContext<'_>, recipe: Recipe, vehicle: f64) {
    let volume_mm3 = cx.tools.squeeze_mm3;
    let reach_mm = REACH * volume_mm3.cbrt();
    let places = candidates(cx.painting, reach_mm);
    cx.command(Command::SqueezeInFreeSpace { recipe, vehicle, volume_mm3, places, reach_mm });
}

/// Keeps a mixture in your list, with its colour under the light of the painting. This does nothing
/// for a recipe without pigment.
pub(super) fn keep(cx: &mut PanelContext<'_>, recipe: Recipe, vehicle: f64) {
    let painting = cx.painting;
    let Ok(weights) = painting.light.viewing.weights(painting.library.grid) else { return };
    let light = (&weights, painting.lighting.illuminant.as_str());
    if let Some(kept) = KeptMixture::of(&painting.library, recipe, vehicle, light) {
        cx.file(FileRequest::Swatches(SwatchChange::Keep(Box::new(kept))));
    }
}

/// Positions on the palette, in mm, that are bare wood up to a distance of `reach_mm`. They come
/// row by row from the upper left.
fn candidates(painting: &PaintingState, reach_mm: f64) -> Vec<[f64; 2]> {
    let cells = painting.palette_cells;
    let reach = reach_mm / painting.cell_mm;
    let step = (reach_mm / painting.cell_mm).max(1.0);
    let [columns, rows] = [cells.0, cells.1].map(|size| (size as f64 / step) as usize);
    let rows = (1..=rows).map(|row| row as f64 * step);
    let all = rows.flat_map(|y| (1..=columns).map(move |column| [column as f64 * step, y]));
    let on_wood = all.filter(|&[x, y]| {
        let turns = (0..16).map(|turn| f64::from(turn) * TAU / 16.0);
        let mut rim = turns.map(|turn| [x + reach * turn.cos(), y + reach * turn.sin()]);
        rim.all(|place| Outline::Palette.contains(place, cells))
    });
    on_wood.map(|place| place.map(|cells| cells * painting.cell_mm)).collect()
}

/// We drop an unconfirmed value after this time, in seconds.
const TIMEOUT_SECONDS: f64 = 3.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Edit {
    #[default]
    None,
    /// You drag the control and its value changed.
    Dragged,
    /// A drag ended.
    Released,
    /// You set the value by a key or by typing.
    Set,
}

impl Edit {
    /// Reads the change from the response of a slider or similar control.
    pub(super) fn of(response: &Response) -> Self {
        if response.drag_stopped() {
            Self::Released
        } else if !response.changed() {
            Self::None
        } else if response.dragged() {
            Self::Dragged
        } else {
            Self::Set
        }
    }

    /// Combines the changes by two controls of one value. If `self` is `None`, this returns
    /// `other`.
    pub(super) fn or(self, other: Self) -> Self {
        if self == Self::None { other } else { self }
    }
}

/// A value that you chose. We show it until the worker reports it.
#[derive(Debug, Clone)]
pub(super) struct PendingValue<T> {
    value: Option<T>,
    released_at: Option<f64>,
}

impl<T> Default for PendingValue<T> {
    fn default() -> Self {
        Self { value: None, released_at: None }
    }
}

impl<T: Clone> PendingValue<T> {
    /// Value to show at time `now` in seconds. This is the requested one until the worker reports a
    /// value `near` it, but at most three seconds after the release.
    pub(super) fn shown(&mut self, reported: &T, near: impl Fn(&T, &T) -> bool, now: f64) -> T {
        let (Some(value), Some(released_at)) = (&self.value, self.released_at) else {
            return self.value.as_ref().unwrap_or(reported).clone();
        };
        if near(value, reported) || now > released_at + TIMEOUT_SECONDS {
            *self = Self::default();
            return reported.clone();
        }
        value.clone()
    }

    pub(super) fn drag(&mut self, value: T) {
        *self = Self { value: Some(value), released_at: None };
    }

    /// Stores a value that you set or released at time `now` in seconds.
    pub(super) fn set(&mut self, value: T, now: f64) {
        *self = Self { value: Some(value), released_at: Some(now) };
    }

    /// Queues `action` for a change of the control to `value`, and stores `value`. One drag becomes
    /// one action of the history.
    pub(super) fn request(
        &mut self,
        ui: &Ui,
        cx: &mut PanelContext<'_>,
        edit: Edit,
        action: Action,
        value: T,
    ) {
        match edit {
            Edit::None => return,
            Edit::Dragged => {
                cx.command(Command::Adjust(action));
                return self.drag(value);
            }
            Edit::Released => {
                cx.command(Command::Adjust(action));
                cx.command(Command::EndAdjustment);
            }
            Edit::Set => cx.command(Command::Apply(action)),
        }
        self.set(value, ui.input(|input| input.time));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(draft: &mut PendingValue<i32>, reported: i32, now: f64) -> i32 {
        draft.shown(&reported, |a, b| a == b, now)
    }

    #[test]
    fn a_dragged_value_is_shown_until_the_worker_reports_it() {
        let mut draft = PendingValue::default();
        assert_eq!(shown(&mut draft, 1, 0.0), 1);
        draft.drag(5);
        assert_eq!(shown(&mut draft, 1, 90.0), 5, "during the drag");
        assert_eq!(shown(&mut draft, 5, 91.0), 5);
        draft.drag(7);
        draft.set(7, 92.0);
        assert_eq!(shown(&mut draft, 5, 92.1), 7, "an older state arrives late");
        assert_eq!(shown(&mut draft, 7, 92.2), 7);
        assert_eq!(shown(&mut draft, 2, 92.3), 2, "a later change is shown");
    }

    #[test]
    fn an_unconfirmed_value_is_dropped_after_the_timeout() {
        let mut draft = PendingValue::default();
        draft.set(7, 10.0);
        assert_eq!(shown(&mut draft, 1, 12.9), 7);
        assert_eq!(shown(&mut draft, 1, 13.1), 1);
    }
}
