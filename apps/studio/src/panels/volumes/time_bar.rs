//! The time bar: play, step, go back, and a track with all events.

use eframe::egui::{
    Align2, FontId, Key, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2,
    vec2,
};
use session::volumes::{STEPS_A_SECOND, SceneState, SceneTool, VolumeCommand};

use super::context::SceneContext;
use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::panels::controls::row_height;
use crate::theme;

/// Height of the bar, in points; enough for buttons that are touched.
pub const HEIGHT: f32 = 46.0;

/// Side of its buttons, in points.
const BUTTON: f32 = 28.0;

/// Width of the text at its right, in points.
const TEXT: f32 = 128.0;

/// Shortest time that the track shows, in steps: 5 s.
const SHORTEST: u64 = 5 * STEPS_A_SECOND;

/// Signs on the buttons.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Start,
    Play,
    Pause,
    Step,
}

/// Seconds and hundredths of a number of steps, such as `3.25 s`.
#[must_use]
pub fn seconds_text(steps: u64) -> String {
    format!("{:.2} s", steps as f64 / STEPS_A_SECOND as f64)
}

/// Draws the bar over the available width.
pub fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let time = cx.state.time;
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let key = |ui: &Ui, name| hint(ui.ctx(), name);
        let tip = format!("{}{}", tr("Goes to the start"), key(ui, "scene.start"));
        if sign_button(ui, Sign::Start, tr("From the start"), &tip) {
            cx.command(VolumeCommand::Seek(0));
        }
        let (sign, name, tip) = match time.playing {
            true => (Sign::Pause, tr("Pause"), tr("Stops time")),
            false => (Sign::Play, tr("Play"), tr("Lets time run")),
        };
        let tip = format!("{tip}{}", key(ui, "scene.play"));
        if sign_button(ui, sign, name, &tip) {
            cx.command(VolumeCommand::Play(!time.playing));
        }
        let tip = format!("{}{}", tr("Takes one step of 1/120 s"), key(ui, "scene.step"));
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

/// Draws a button with a sign. Returns whether it was clicked.
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

/// Last moment of the track: there is always room to go on.
fn length(state: &SceneState) -> u64 {
    state.time.end.max(SHORTEST)
}

/// Draws the track with its events, and goes to the moment that it is dragged to.
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
        let presses = |key| ui.input(|input| input.num_presses(key)) as i64;
        let steps = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_told_in_seconds() {
        assert_eq!([0, 1, 60, 390].map(seconds_text), ["0.00 s", "0.01 s", "0.50 s", "3.25 s"]);
    }
}
