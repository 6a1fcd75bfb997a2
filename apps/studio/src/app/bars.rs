//! The bars of the window: the toolbar at the left with its icons, the menu bar, and the status
//! line.

use eframe::egui::{
    Align, Button, Color32, Context, InnerResponse, Layout, MenuBar, Painter, Pos2, Rect, Response,
    RichText, Role, ScrollArea, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};
use web_time::{Duration, Instant};

use super::entries::entries;
use super::intent::{self, Entry, Intent, Menu, Part};
use crate::language::tr;
use crate::panels::Mode;
use crate::pen::{DrawingAids, GuideKind};
use crate::theme;
use crate::theme::{Look, ThemeChoice};
use Mark::{Arc, Filled, Line};

/// Buttons of the toolbar in groups.
const GROUPS: [&[Intent]; 4] = [
    &[
        Intent::Tool(Mode::Paint),
        Intent::Tool(Mode::Blend),
        Intent::Tool(Mode::Scrape),
        Intent::Tool(Mode::Erase),
        Intent::Tool(Mode::Mask),
        Intent::Tool(Mode::Squeeze),
        Intent::Tool(Mode::Pick),
        Intent::Tool(Mode::Pan),
        Intent::Tool(Mode::Rotate),
        Intent::Tool(Mode::Zoom),
    ],
    &[Intent::Undo, Intent::Redo],
    &[Intent::Wash, Intent::Wipe, Intent::Dry],
    &[Intent::Mirror, Intent::Fit],
];

/// Program state shown by the buttons.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    pub(super) mode: Mode,
    pub(super) mirror: bool,
    pub(super) history: (bool, bool),
}

/// Width of the toolbar, in points.
pub(super) fn width(context: &Context) -> f32 {
    if theme::is_touch(context) { theme::TOUCH_TARGET + 8.0 } else { 42.0 }
}

/// Draws the toolbar. Returns the intent of the clicked button.
pub(super) fn show_toolbar(ui: &mut Ui, state: State) -> Option<Intent> {
    let mut clicked = None;
    ui.spacing_mut().item_spacing = vec2(0.0, 2.0);
    // In a low window, large buttons scroll.
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for (at, group) in GROUPS.into_iter().enumerate() {
            if at > 0 {
                ui.add_space(3.0);
                ui.separator();
                ui.add_space(3.0);
            }
            for &intent in group {
                if button(ui, intent, state) {
                    clicked = Some(intent);
                }
            }
        }
    });
    clicked
}

fn button(ui: &mut Ui, intent: Intent, state: State) -> bool {
    let Some(entry) = Entry::of(intent) else { return false };
    let chosen = match intent {
        Intent::Tool(mode) => mode == state.mode,
        Intent::Mirror => state.mirror,
        _ => false,
    };
    let enabled = match intent {
        Intent::Undo => state.history.0,
        Intent::Redo => state.history.1,
        _ => true,
    };
    let clicked = ui.add_enabled_ui(enabled, |ui| {
        let side = ui.available_width();
        let (rect, response) =
            ui.allocate_exact_size(theme::at_least(ui, vec2(side, 30.0)), Sense::click());
        response
            .widget_info(|| WidgetInfo::selected(Role::Button, enabled, chosen, tr(entry.name)));
        intent::note(ui.ctx(), Part::Button(intent), rect);
        let visuals = ui.style().interact(&response);
        let fill = match (chosen, response.hovered()) {
            (true, _) => theme::colors(ui.ctx()).chosen,
            (false, true) => visuals.bg_fill,
            (false, false) => theme::colors(ui.ctx()).bar,
        };
        ui.painter().rect(
            rect,
            theme::CORNER_RADIUS,
            fill,
            Stroke::NONE,
            eframe::egui::StrokeKind::Inside,
        );
        let color = if chosen { theme::colors(ui.ctx()).strong } else { visuals.fg_stroke.color };
        draw(ui.painter(), rect, intent, color);
        let response = response.on_hover_ui(|ui| tip(ui, entry)).on_disabled_hover_ui(|ui| {
            tip(ui, entry);
        });
        response.clicked()
    });
    clicked.inner
}

/// Tooltip of an entry: name, shortcut and description.
pub(super) fn tip(ui: &mut Ui, entry: &Entry) {
    ui.horizontal(|ui| {
        ui.strong(tr(entry.name));
        ui.weak(entry.shortcut_text(ui.ctx()));
    });
    ui.label(tr(entry.description));
}

/// Side of the square of icon coordinates, in points.
const SQUARE: f32 = 18.0;

#[derive(Debug, Clone, Copy)]
pub(super) enum Mark {
    /// Polyline through points.
    Line(&'static [(f32, f32)]),
    /// Filled convex polygon.
    Filled(&'static [(f32, f32)]),
    /// Circular arc: centre, radius, start and end angle in degrees clockwise from the
    /// right.
    Arc((f32, f32), f32, f32, f32),
}

/// Draws the icon of an intent at the centre of a button. Returns whether there is an icon.
pub(super) fn draw(painter: &Painter, button: Rect, intent: Intent, color: Color32) -> bool {
    let marks = marks(intent);
    draw_marks(painter, button, marks, color);
    !marks.is_empty()
}

pub(super) fn draw_marks(painter: &Painter, button: Rect, marks: &[Mark], color: Color32) {
    let corner = button.center() - eframe::egui::Vec2::splat(0.5 * SQUARE);
    let place = |&(x, y): &(f32, f32)| corner + vec2(x, y);
    let stroke = Stroke::new(1.5, color);
    for mark in marks {
        match mark {
            Line(places) => {
                painter.line(places.iter().map(place).collect(), stroke);
            }
            Filled(places) => {
                let shape = places.iter().map(place).collect();
                painter.add(Shape::convex_polygon(shape, color, Stroke::NONE));
            }
            Arc(middle, radius, from, to) => {
                let middle = place(middle);
                painter.line(
                    (0..=24)
                        .map(|step: u8| {
                            let angle = from + (to - from) * f32::from(step) / 24.0;
                            let (sin, cos) = angle.to_radians().sin_cos();
                            pos2(middle.x + radius * cos, middle.y + radius * sin)
                        })
                        .collect::<Vec<Pos2>>(),
                    stroke,
                );
            }
        }
    }
}

/// The marks of an intent's icon, or none.
pub(super) fn marks(intent: Intent) -> &'static [Mark] {
    match intent {
        Intent::Tool(Mode::Paint) => &[
            Line(&[(7.5, 10.5), (15.5, 2.5)]),
            Line(&[(6.0, 9.0), (9.0, 12.0)]),
            Filled(&[(5.6, 9.8), (8.2, 12.4), (6.4, 15.0), (2.0, 16.0), (3.0, 11.6)]),
        ],
        Intent::Tool(Mode::Blend) => &[
            Line(&[(9.0, 1.5), (9.0, 6.0)]),
            Line(&[(6.5, 6.0), (11.5, 6.0), (15.0, 12.5), (3.0, 12.5), (6.5, 6.0)]),
            Line(&[(9.0, 8.5), (9.0, 12.5)]),
            Arc((5.5, 16.0), 1.8, 180.0, 360.0),
            Arc((9.1, 16.0), 1.8, 0.0, 180.0),
            Arc((12.7, 16.0), 1.8, 180.0, 360.0),
        ],
        Intent::Tool(Mode::Scrape) => &[
            Line(&[(16.0, 2.0), (11.5, 6.5)]),
            Filled(&[(11.0, 4.5), (13.5, 7.0), (7.0, 15.5), (2.5, 11.0)]),
            Line(&[(2.0, 16.5), (16.0, 16.5)]),
        ],
        Intent::Tool(Mode::Erase) => &[
            Line(&[(6.0, 14.5), (2.0, 10.5), (10.0, 2.5), (16.0, 8.5), (10.0, 14.5), (6.0, 14.5)]),
            Line(&[(6.2, 6.3), (12.2, 12.3)]),
            Line(&[(6.0, 16.8), (16.0, 16.8)]),
        ],
        Intent::Tool(Mode::Mask) => &[
            Line(&[(2.5, 5.5), (2.5, 2.5), (5.5, 2.5)]),
            Line(&[(7.5, 2.5), (10.5, 2.5)]),
            Line(&[(12.5, 2.5), (15.5, 2.5), (15.5, 5.5)]),
            Line(&[(15.5, 7.5), (15.5, 10.5)]),
            Line(&[(15.5, 12.5), (15.5, 15.5), (12.5, 15.5)]),
            Line(&[(10.5, 15.5), (7.5, 15.5)]),
            Line(&[(5.5, 15.5), (2.5, 15.5), (2.5, 12.5)]),
            Line(&[(2.5, 10.5), (2.5, 7.5)]),
        ],
        Intent::Tool(Mode::Squeeze) => &[
            Line(&[(3.0, 2.5), (15.0, 2.5)]),
            Line(&[(4.5, 2.5), (6.8, 11.5), (11.2, 11.5), (13.5, 2.5)]),
            Filled(&[(7.2, 11.5), (10.8, 11.5), (10.8, 14.0), (7.2, 14.0)]),
            Filled(&[(8.0, 15.0), (10.0, 15.0), (9.0, 17.5)]),
        ],
        Intent::Tool(Mode::Pick) => &[
            Line(&[(10.0, 8.0), (4.0, 14.0), (2.5, 15.5)]),
            Line(&[(8.5, 6.5), (3.5, 11.5), (3.0, 15.0), (6.5, 14.5), (11.5, 9.5)]),
            Line(&[(7.0, 5.0), (13.0, 11.0)]),
            Filled(&[(9.5, 6.5), (12.5, 3.0), (15.0, 3.0), (15.0, 5.5), (11.5, 8.5)]),
        ],
        Intent::Tool(Mode::Pan) => &[
            Line(&[(9.0, 2.0), (9.0, 16.0)]),
            Line(&[(2.0, 9.0), (16.0, 9.0)]),
            Line(&[(7.0, 4.0), (9.0, 2.0), (11.0, 4.0)]),
            Line(&[(7.0, 14.0), (9.0, 16.0), (11.0, 14.0)]),
            Line(&[(4.0, 7.0), (2.0, 9.0), (4.0, 11.0)]),
            Line(&[(14.0, 7.0), (16.0, 9.0), (14.0, 11.0)]),
        ],
        Intent::Tool(Mode::Rotate) => {
            &[Arc((9.0, 9.5), 6.0, -60.0, 220.0), Filled(&[(8.2, 1.6), (13.6, 3.6), (9.6, 7.4)])]
        }
        Intent::Tool(Mode::Zoom) => &[
            Arc((7.5, 7.5), 4.8, 0.0, 360.0),
            Line(&[(11.0, 11.0), (16.0, 16.0)]),
            Line(&[(5.3, 7.5), (9.7, 7.5)]),
            Line(&[(7.5, 5.3), (7.5, 9.7)]),
        ],
        Intent::Undo => {
            &[Arc((9.5, 10.0), 5.0, -130.0, 100.0), Filled(&[(2.6, 6.8), (7.6, 3.0), (8.4, 8.6)])]
        }
        Intent::Redo => {
            &[Arc((8.5, 10.0), 5.0, -50.0, -280.0), Filled(&[(15.4, 6.8), (10.4, 3.0), (9.6, 8.6)])]
        }
        Intent::Mirror => &[
            Line(&[(9.0, 1.5), (9.0, 16.5)]),
            Line(&[(6.5, 4.5), (6.5, 13.5), (1.8, 13.5), (6.5, 4.5)]),
            Filled(&[(11.5, 4.5), (11.5, 13.5), (16.2, 13.5)]),
        ],
        Intent::Fit => &[
            Line(&[(2.0, 6.0), (2.0, 2.5), (5.5, 2.5)]),
            Line(&[(12.5, 2.5), (16.0, 2.5), (16.0, 6.0)]),
            Line(&[(16.0, 12.0), (16.0, 15.5), (12.5, 15.5)]),
            Line(&[(5.5, 15.5), (2.0, 15.5), (2.0, 12.0)]),
            Line(&[(5.0, 6.0), (13.0, 6.0), (13.0, 12.0), (5.0, 12.0), (5.0, 6.0)]),
        ],
        Intent::Wash => &[
            Line(&[(9.0, 2.0), (5.2, 8.2)]),
            Line(&[(9.0, 2.0), (12.8, 8.2)]),
            Arc((9.0, 11.0), 4.7, -36.0, 216.0),
            Arc((9.0, 11.0), 2.4, 30.0, 100.0),
        ],
        Intent::Wipe => &[
            Line(&[(3.0, 12.0), (8.5, 3.5), (15.0, 7.0), (11.0, 13.0)]),
            Line(&[(3.0, 12.0), (6.0, 13.5), (8.5, 11.5), (11.0, 13.0)]),
            Line(&[(2.5, 16.0), (15.5, 16.0)]),
        ],
        Intent::Dry => &[
            Arc((9.0, 9.0), 3.2, 0.0, 360.0),
            Line(&[(9.0, 1.5), (9.0, 3.8)]),
            Line(&[(9.0, 14.2), (9.0, 16.5)]),
            Line(&[(1.5, 9.0), (3.8, 9.0)]),
            Line(&[(14.2, 9.0), (16.5, 9.0)]),
            Line(&[(3.7, 3.7), (5.3, 5.3)]),
            Line(&[(12.7, 12.7), (14.3, 14.3)]),
            Line(&[(14.3, 3.7), (12.7, 5.3)]),
            Line(&[(5.3, 12.7), (3.7, 14.3)]),
        ],
        _ => &[],
    }
}

/// Program state that enables and checks menu entries.
#[derive(Debug, Clone, Copy)]
pub(super) struct MenuState {
    pub(super) open: bool,
    pub(super) scene: bool,
    pub(super) history: (bool, bool),
    pub(super) shown: (bool, bool, bool),
    pub(super) mirror: bool,
    pub(super) aids: DrawingAids,
    pub(super) look: Look,
}

/// Shows the bar with `title` at its right. Returns the clicked entry.
pub(super) fn show_menus(ui: &mut Ui, state: MenuState, title: &str) -> Option<Intent> {
    let mut clicked = None;
    MenuBar::new().ui(ui, |ui| {
        if theme::is_touch(ui.ctx()) {
            ui.spacing_mut().button_padding.x = 13.0;
        }
        for (menu, name, description) in [
            (Menu::File, tr("File"), tr("Open, save, export")),
            (Menu::Edit, tr("Edit"), tr("The painting and the brush")),
            (Menu::View, tr("View"), tr("Zoom, rotation and visible parts")),
            (Menu::Tools, tr("Tools"), tr("Tools of the pen")),
            (Menu::Help, tr("Help"), tr("Keys, first steps and a guided tour")),
        ] {
            let opened = menu_button(ui, name, |ui| {
                let own: Vec<_> = entries().filter(|entry| entry.menu == menu).collect();
                let ticks = own.iter().any(|entry| checked(entry.intent, state).is_some());
                for entry in own {
                    if begins_group(entry.intent) {
                        ui.separator();
                    }
                    let enabled = enabled(entry.intent, state);
                    let checked = checked(entry.intent, state);
                    let keys = entry.shortcut_text(ui.ctx());
                    let response = show_item(ui, tr(entry.name), &keys, enabled, checked, ticks);
                    let response = response.on_hover_ui(|ui| tip(ui, entry));
                    if response.clicked() {
                        clicked = Some(entry.intent);
                        ui.close();
                    }
                }
            });
            opened.response.on_hover_text(description);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(4.0);
            if !theme::is_narrow(ui.ctx()) {
                ui.weak(title);
            } else if ui.selectable_label(state.shown.0, tr("Panels")).clicked() {
                clicked = Some(Intent::Panels);
            }
        });
    });
    clicked
}

/// Adds a button that opens a menu. If a menu is higher than the window, it scrolls.
pub(super) fn menu_button(
    ui: &mut Ui,
    name: &str,
    content: impl FnOnce(&mut Ui),
) -> InnerResponse<Option<()>> {
    ui.menu_button(name, |ui| {
        ui.set_min_width(190.0);
        if !theme::is_touch(ui.ctx()) {
            return content(ui);
        }
        let most = ui.ctx().content_rect().height() - 2.0 * theme::TOUCH_TARGET;
        ui.set_min_width(290.0);
        let area = ScrollArea::vertical().max_height(most).min_scrolled_height(most);
        area.show(ui, content);
    })
}

fn begins_group(intent: Intent) -> bool {
    matches!(
        intent,
        Intent::Save
            | Intent::Export
            | Intent::OpenReference
            | Intent::NewScene
            | Intent::Quit
            | Intent::Dry
            | Intent::Larger
            | Intent::Pen
            | Intent::Fit
            | Intent::TurnLeft
            | Intent::Panels
            | Intent::Tool(Mode::Squeeze)
            | Intent::Tool(Mode::Pan)
            | Intent::DrawingAids
            | Intent::StandardLayout
            | Intent::Theme(ThemeChoice::Dark)
            | Intent::TouchTargets
    )
}

fn enabled(intent: Intent, state: MenuState) -> bool {
    match intent {
        Intent::Undo => state.history.0,
        Intent::Redo => state.history.1,
        Intent::ShowScene => state.scene,
        Intent::Open
        | Intent::New
        | Intent::NewScene
        | Intent::OpenScene
        | Intent::Preferences
        | Intent::Pen
        | Intent::Quit
        | Intent::Keys
        | Intent::Theme(_)
        | Intent::TouchTargets
        | Intent::LargerInterface
        | Intent::SmallerInterface
        | Intent::StandardLayout
        | Intent::FullScreen => true,
        _ => state.open,
    }
}

fn checked(intent: Intent, state: MenuState) -> Option<bool> {
    match intent {
        Intent::Panels => Some(state.shown.0),
        Intent::Palette => Some(state.shown.1),
        Intent::Figures => Some(state.shown.2),
        Intent::Mirror => Some(state.mirror),
        Intent::Ruler => Some(state.aids.guide == Some(GuideKind::Ruler)),
        Intent::Perspective => Some(state.aids.guide == Some(GuideKind::Perspective)),
        Intent::Snapping => Some(state.aids.snaps),
        Intent::Symmetry => Some(state.aids.symmetry.on),
        Intent::Theme(theme) => Some(state.look.theme == theme),
        Intent::TouchTargets => Some(state.look.touch),
        _ => None,
    }
}

/// Spaces before a name that leave room for a tick.
const INDENT: &str = "      ";

/// Adds an entry with its shortcut. If `checked` is set, the entry has a tick or room for one.
/// `indented` leaves this room in an entry without a tick, so that its name stands below names with
/// ticks.
pub(super) fn show_item(
    ui: &mut Ui,
    name: &str,
    shortcut: &str,
    enabled: bool,
    checked: Option<bool>,
    indented: bool,
) -> Response {
    let indent = if indented || checked.is_some() { INDENT } else { "" };
    let button = Button::new(format!("{indent}{name}")).shortcut_text(shortcut);
    let response = ui.add_enabled(enabled, button);
    // Screen readers get the name without indent and shortcut.
    response.widget_info(|| match checked {
        Some(checked) => WidgetInfo::selected(Role::CheckBox, enabled, checked, name),
        None => WidgetInfo::labeled(Role::Button, enabled, name),
    });
    if checked == Some(true) {
        let at = response.rect.left_center() + vec2(ui.spacing().button_padding.x, 0.0);
        let tick = [vec2(1.0, 0.5), vec2(4.0, 3.5), vec2(9.5, -3.5)].map(|part| at + part);
        let color = ui.style().interact(&response).text_color();
        ui.painter().line(tick.to_vec(), Stroke::new(1.5, color));
    }
    response
}

/// Display time of a message that is not an error.
const DISPLAY_TIME: Duration = Duration::from_secs(10);

/// A message in the status line.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// Message text, one sentence.
    pub text: String,
    /// Suggestion how to solve the problem, if any.
    pub hint: Option<String>,
    /// Whether this is an error. An error stays until you dismiss it.
    pub failed: bool,
    /// Time at which we showed it first.
    pub shown_at: Instant,
}

impl Message {
    /// Whether you still see the message at `now`.
    #[must_use]
    pub fn is_displayed(&self, now: Instant) -> bool {
        self.failed || self.rest(now).is_some()
    }

    /// Time after `now` for which you still see the message. `None` if it is gone, or if it stays
    /// until you dismiss it.
    #[must_use]
    pub fn rest(&self, now: Instant) -> Option<Duration> {
        let rest = DISPLAY_TIME.saturating_sub(now.saturating_duration_since(self.shown_at));
        (!self.failed && !rest.is_zero()).then_some(rest)
    }
}

/// Contents of the status line.
#[derive(Debug, Clone)]
pub(super) struct StatusState<'a> {
    pub(super) message: Option<&'a Message>,
    /// Zoom and rotation, for example `42 %, 15 degrees`.
    pub(super) view: String,
    /// Canvas size in cells and mm.
    pub(super) size: String,
    pub(super) light: String,
    pub(super) backend: &'a str,
}

/// Height of the status line. An error has a button, which needs more room for touch.
pub(super) fn height(context: &Context, message: Option<&Message>) -> f32 {
    let has_button = message.is_some_and(|message| message.failed);
    if has_button && theme::is_touch(context) { theme::TOUCH_TARGET + 4.0 } else { 24.0 }
}

/// Draws the status line. Returns whether you dismissed the message.
pub(super) fn show_status(ui: &mut Ui, state: &StatusState) -> bool {
    let mut dismissed = false;
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 14.0;
        ui.label(small(ui, state.backend))
            .on_hover_text(tr("Processor or graphics adapter that computes the paint"));
        ui.label(small(ui, &state.light)).on_hover_text(tr("The light of the painting"));
        ui.label(small(ui, &state.size))
            .on_hover_text(tr("Size of the canvas in cells and in millimetres"));
        ui.label(small(ui, &state.view))
            .on_hover_text(tr("Zoom in screen pixels per cell, and rotation"));
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let Some(message) = state.message else { return };
            ui.spacing_mut().item_spacing.x = 6.0;
            if message.failed {
                let side = theme::target(ui);
                let close = Button::new("x").min_size(vec2(side, side));
                let close = if side == 0.0 { close.small() } else { close };
                let close = ui.add(close).on_hover_text(tr("Dismisses this message"));
                dismissed = close.clicked();
            }
            let words = message
                .hint
                .as_ref()
                .map_or_else(|| message.text.clone(), |hint| format!("{}: {hint}", message.text));
            let color = if message.failed {
                theme::colors(ui.ctx()).strong
            } else {
                theme::colors(ui.ctx()).text
            };
            let mut text = RichText::new(&words).color(color);
            if message.failed {
                text = text.strong();
            }
            // If the text is cut, its tooltip has all of it.
            ui.add(eframe::egui::Label::new(text).truncate());
        });
    });
    dismissed
}

/// Text of a status line.
pub(super) fn small(ui: &Ui, text: &str) -> RichText {
    RichText::new(text).small().color(theme::colors(ui.ctx()).faint)
}
