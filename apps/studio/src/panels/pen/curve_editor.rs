//! Editor of the pressure curve: points are dragged, added by a click and removed by dragging them
//! out or by the right button; the present pressure is marked.

use eframe::egui::{
    EventFilter, Id, Key, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind,
    Ui, WidgetInfo, pos2, vec2,
};
use session::brushes::{CurvePoints, PressureCurve};

use crate::language::{tr, tr_format};
use crate::theme;

/// Side of the plot, in points.
pub(super) const SIDE: f32 = 220.0;

/// Side of the square in which a point is grabbed, in points; larger in touch mode.
const GRABBED: f32 = 26.0;

/// Distance beyond the plot from which a dragged point is removed, in points.
const REMOVED: f32 = 28.0;

/// Straight pieces in which the curve is drawn.
const PIECES: usize = 96;

/// Step of an arrow key.
const STEP: f64 = 0.02;

/// Draws the curve; `live` is the present pressure of the pen. While `enabled`, it is edited.
pub(super) fn edit_curve(ui: &mut Ui, curve: &mut PressureCurve, live: Option<f64>, enabled: bool) {
    let sense = if enabled { Sense::click_and_drag() } else { Sense::hover() };
    let (rect, plot) = ui.allocate_exact_size(vec2(SIDE, SIDE), sense);
    plot.widget_info(|| WidgetInfo::labeled(Role::Canvas, enabled, tr("Pressure curve")));
    let inner = rect.shrink(8.0);
    let painter = ui.painter_at(rect.expand(REMOVED));
    draw(&painter, rect, inner, curve, live);
    if !enabled {
        return;
    }
    let mut points = curve.points();
    let before = points.clone();
    press_plot(ui, &plot, inner, &mut points);
    let mut removed = None;
    for index in 0..points.list().len() {
        let Some(&place) = points.list().get(index) else { break };
        let at = in_window(inner, place);
        let area = Rect::from_center_size(at, theme::at_least(ui, vec2(GRABBED, GRABBED)));
        let id = plot.id.with(("point", index));
        let response = ui.interact(area, id, Sense::click_and_drag());
        let name = tr_format!("curve point {index}", index = index + 1);
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, &name));
        let out = response.interact_pointer_pos().is_some_and(|pointer| is_out(inner, pointer));
        if move_point(ui, &response, index, inner, &mut points) && !out {
            ui.ctx().request_repaint();
        }
        if (response.drag_stopped() && out)
            || response.secondary_clicked()
            || deletes(ui, &response)
        {
            removed = Some(index);
        }
        let goes = out && response.dragged() && points.list().len() > CurvePoints::LEAST;
        let active = response.hovered() || response.dragged() || response.has_focus();
        draw_point(&painter, in_window(inner, points.list()[index]), active, goes);
        let [x, y] = points.list()[index];
        response.on_hover_text(tr_format!(
            "The pen's {x:.2} becomes {y:.2}. Drag it, or out of the field to remove it (right \
             button, Delete)",
            x,
            y
        ));
    }
    if let Some(index) = removed {
        points.remove(index);
    }
    plot.on_hover_text(tr(
        "The pen's pressure goes to the right, the brush's up. A click adds a point",
    ));
    if points != before {
        *curve = PressureCurve::Points(points);
    }
}

/// Adds a point where the plot itself is clicked, or dragged from, and drags that point on.
fn press_plot(ui: &Ui, plot: &Response, inner: Rect, points: &mut CurvePoints) {
    let id = Id::unique("dragged new point");
    let pressed = ui.input(|input| input.pointer.press_origin());
    if plot.drag_started() || plot.clicked() {
        let at = if plot.clicked() { plot.interact_pointer_pos() } else { pressed };
        let added = at.and_then(|at| points.add(of_window(inner, at)));
        ui.data_mut(|data| data.insert_temp(id, added));
    }
    let added: Option<usize> = ui.data(|data| data.get_temp(id)).flatten();
    let (Some(index), Some(pointer)) = (added, plot.interact_pointer_pos()) else { return };
    if plot.dragged() {
        points.move_to(index, of_window(inner, pointer));
    } else if plot.drag_stopped() {
        if is_out(inner, pointer) {
            points.remove(index);
        }
        ui.data_mut(|data| data.remove::<Option<usize>>(id));
    }
}

/// Moves a point with the pointer or the arrow keys. Returns whether it moved.
fn move_point(
    ui: &Ui,
    response: &Response,
    index: usize,
    inner: Rect,
    points: &mut CurvePoints,
) -> bool {
    let [x, y] = points.list()[index];
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        points.move_to(index, of_window(inner, pointer));
    } else if response.has_focus() {
        let arrows = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        let (right, up) = ui.input(|input| {
            let presses = |key| input.num_presses(key) as f64;
            let right = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
            (right, presses(Key::ArrowUp) - presses(Key::ArrowDown))
        });
        if (right, up) != (0.0, 0.0) {
            points.move_to(index, [x + STEP * right, y + STEP * up]);
        }
    }
    points.list()[index] != [x, y]
}

/// Whether the key that removes a focused point was pressed.
fn deletes(ui: &Ui, response: &Response) -> bool {
    response.has_focus()
        && ui.input(|input| input.key_pressed(Key::Delete) || input.key_pressed(Key::Backspace))
}

fn is_out(inner: Rect, pointer: Pos2) -> bool {
    !inner.expand(REMOVED).contains(pointer)
}

fn in_window(inner: Rect, [x, y]: [f64; 2]) -> Pos2 {
    pos2(inner.left() + inner.width() * x as f32, inner.bottom() - inner.height() * y as f32)
}

fn of_window(inner: Rect, at: Pos2) -> [f64; 2] {
    let x = f64::from((at.x - inner.left()) / inner.width());
    let y = f64::from((inner.bottom() - at.y) / inner.height());
    [x.clamp(0.0, 1.0), y.clamp(0.0, 1.0)]
}

fn draw(painter: &Painter, rect: Rect, inner: Rect, curve: &PressureCurve, live: Option<f64>) {
    let colors = theme::colors(painter.ctx());
    let edge = Stroke::new(1.0, colors.line);
    painter.rect(rect, theme::CORNER_RADIUS, colors.well, edge, StrokeKind::Inside);
    for quarter in 0..=4 {
        let share = f64::from(quarter) / 4.0;
        let grid = Stroke::new(0.5, colors.line);
        painter.line_segment([[share, 0.0], [share, 1.0]].map(|at| in_window(inner, at)), grid);
        painter.line_segment([[0.0, share], [1.0, share]].map(|at| in_window(inner, at)), grid);
    }
    let diagonal = [[0.0, 0.0], [1.0, 1.0]].map(|at| in_window(inner, at));
    painter.line_segment(diagonal, Stroke::new(1.0, colors.line));
    if let Some(pressure) = live {
        let to = [pressure, curve.at(pressure)];
        let mark = Stroke::new(1.0, colors.faint);
        painter.line_segment([[to[0], 0.0], to].map(|at| in_window(inner, at)), mark);
        painter.line_segment([[0.0, to[1]], to].map(|at| in_window(inner, at)), mark);
    }
    let line: Vec<Pos2> = (0..=PIECES)
        .map(|piece| piece as f64 / PIECES as f64)
        .map(|x| in_window(inner, [x, curve.at(x)]))
        .collect();
    painter.add(Shape::line(line, Stroke::new(2.0, colors.strong)));
    if let Some(pressure) = live {
        let at = in_window(inner, [pressure, curve.at(pressure)]);
        painter.circle(at, 6.0, colors.strong, Stroke::new(2.0, colors.well));
    }
}

/// Draws a point of the curve; one that goes when it is dropped is only an outline.
fn draw_point(painter: &Painter, at: Pos2, active: bool, goes: bool) {
    let colors = theme::colors(painter.ctx());
    let radius = if active { 6.0 } else { 4.5 };
    let fill = if goes { colors.well } else { colors.strong };
    painter.circle(
        at,
        radius,
        fill,
        Stroke::new(1.5, if goes { colors.faint } else { colors.bar }),
    );
}
