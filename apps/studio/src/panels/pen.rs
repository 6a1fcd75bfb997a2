//! The window of the pen: pressure curve with a test field, stabiliser, and options of single
//! brushes.
//!
//! You drag points of the curve, click to add one, and remove one with the right button or by
//! dragging it out. A line marks the present pressure.

use eframe::egui::{
    Align2, Context, DragValue, Grid, Id, Key, Painter, Pos2, Rect, Response, Role, Sense, Shape,
    Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, pos2, vec2,
};
use session::brushes::{
    BrushOptions, CurvePoints, LengthUnit, PressureCurve, StabiliserMethod, StabiliserSettings,
    TiltUse, TwistUse,
};
use web_time::Instant;

use crate::language::{brush_label, tr, tr_format};
use crate::panels::controls::{arrow_keys, button};
use crate::pen::{Pen, PenSettings, ReportKind, TestField, TestPoint};
use crate::{floating, theme};

const WIDTH: f32 = 452.0;

/// Settings that the window shows and changes.
#[derive(Debug)]
pub struct PenContext<'a> {
    /// The pen with its reports.
    pub pen: &'a Pen,
    /// Settings for all brushes.
    pub settings: &'a mut PenSettings,
    /// Options of the brush in hand.
    pub options: &'a mut BrushOptions,
    /// Label of the brush in hand.
    pub brush: &'a str,
}

/// State of the window of the pen.
#[derive(Debug, Default)]
pub struct PenWindow {
    field: TestField,
    /// Shows the options of the brush in hand instead of the settings for all.
    only_brush: bool,
    /// Pressure now.
    live: Option<f64>,
    /// Whether the last pressed device measures pressure.
    measures: Option<bool>,
}

impl PenWindow {
    /// Draws the window while `open` is true. The close button and Escape clear `open`.
    pub fn show(&mut self, context: &Context, open: &mut bool, mut cx: PenContext<'_>) {
        if !*open {
            self.live = None;
            return;
        }
        self.read(cx.pen);
        floating::show(context, tr("Pen"), "pen", open, |ui| {
            ui.set_width(WIDTH);
            ui.horizontal(|ui| {
                let tip = tr("Settings for all brushes that have no own ones");
                ui.selectable_value(&mut self.only_brush, false, tr("All brushes"))
                    .on_hover_text(tip);
                let only = tr_format!("Only {brush}", brush = brush_label(cx.brush));
                let tip = tr("Options of the brush in hand, which come before those for all");
                ui.selectable_value(&mut self.only_brush, true, only).on_hover_text(tip);
            });
            ui.separator();
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 12.0;
                self.curve(ui, &mut cx);
                test_field(ui, &mut self.field, cx.pen);
            });
            self.below_curve(ui, &mut cx);
            ui.separator();
            if self.only_brush {
                brush_rows(ui, cx.options, cx.settings);
            } else {
                general_rows(ui, cx.settings);
            }
        });
    }

    fn read(&mut self, pen: &Pen) {
        for report in pen.reports() {
            match report.kind {
                ReportKind::Pressed(state) | ReportKind::Moved(state) => {
                    self.live = state.pressure;
                    if let ReportKind::Pressed(_) = report.kind {
                        self.measures = Some(state.pressure.is_some());
                    }
                }
                ReportKind::Released | ReportKind::Gone => self.live = None,
                ReportKind::Barrel { .. } => {}
            }
        }
    }

    fn curve(&self, ui: &mut Ui, cx: &mut PenContext<'_>) {
        match (&mut cx.options.curve, self.only_brush) {
            (Some(own), true) => edit_curve(ui, own, self.live, true),
            (None, true) => edit_curve(ui, &mut cx.settings.curve.clone(), self.live, false),
            (_, false) => edit_curve(ui, &mut cx.settings.curve, self.live, true),
        }
    }

    /// Draws presets of the curve, the present pressure, and the button that clears the field.
    fn below_curve(&mut self, ui: &mut Ui, cx: &mut PenContext<'_>) {
        ui.horizontal(|ui| {
            if self.only_brush {
                own_curve(ui, cx);
            }
            match (&mut cx.options.curve, self.only_brush) {
                (Some(own), true) => curve_presets(ui, own),
                (None, true) => {}
                (_, false) => curve_presets(ui, &mut cx.settings.curve),
            }
            ui.with_layout(
                eframe::egui::Layout::right_to_left(eframe::egui::Align::Center),
                |ui| {
                    let nothing =
                        self.field.strokes().is_empty().then_some(tr("nothing was drawn yet"));
                    if button(ui, tr("Clear"), tr("Clears the field"), nothing) {
                        self.field.clear();
                    }
                    let curve = cx.options.curve.as_ref().unwrap_or(&cx.settings.curve);
                    ui.weak(match (self.live, self.measures) {
                        (Some(live), _) => {
                            let brush = cx.options.in_range(curve.at(live));
                            tr_format!("pen {live:.2}, brush {brush:.2}", live, brush)
                        }
                        (None, Some(false)) => tr("no pressure: by speed").to_owned(),
                        (None, _) => String::new(),
                    });
                },
            );
        });
    }
}

/// Lets you give the brush its own curve.
fn own_curve(ui: &mut Ui, cx: &mut PenContext<'_>) {
    let mut own = cx.options.curve.is_some();
    let tip = tr("This brush has a pressure curve of its own");
    if ui.checkbox(&mut own, tr("Own curve")).on_hover_text(tip).changed() {
        let general: &PressureCurve = &cx.settings.curve;
        cx.options.curve = own.then(|| general.clone());
    }
}

fn general_rows(ui: &mut Ui, settings: &mut PenSettings) {
    grid(ui, |ui| {
        ui.label(tr("Stabiliser"));
        stabiliser(ui, &mut settings.stabiliser);
        ui.end_row();
        ui.label(tr("Tilt and twist"));
        let tip =
            tr("The brush follows tilt and twist of the pen; otherwise it is held as with a mouse");
        ui.checkbox(&mut settings.pen_tilt, tr("From the pen")).on_hover_text(tip);
        ui.end_row();
        ui.label(tr("Without twist"));
        let tip = tr("The broad side turns across the direction of the stroke");
        ui.checkbox(&mut settings.follow, tr("Turns across the stroke")).on_hover_text(tip);
        ui.end_row();
    });
}

fn brush_rows(ui: &mut Ui, options: &mut BrushOptions, settings: &PenSettings) {
    grid(ui, |ui| {
        ui.label(tr("Pressure"));
        range(ui, options);
        ui.end_row();
        ui.label(tr("Tilt"));
        tilt(ui, &mut options.tilt);
        ui.end_row();
        ui.label(tr("Twist"));
        twist(ui, &mut options.twist);
        ui.end_row();
        let mut own = options.stabiliser.is_some();
        let tip = tr("This brush has a stabiliser of its own");
        if ui.checkbox(&mut own, tr("Own stabiliser")).on_hover_text(tip).changed() {
            options.stabiliser = own.then_some(settings.stabiliser);
        }
        match &mut options.stabiliser {
            Some(own) => stabiliser(ui, own),
            None => {
                ui.weak(tr("as for all brushes"));
            }
        }
        ui.end_row();
    });
}

fn grid(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    Grid::new("pen rows")
        .num_columns(2)
        .spacing(vec2(12.0, 6.0))
        .min_row_height(24.0)
        .show(ui, content);
}

/// Angle in degrees with which a brush starts when you fix its angle.
const FIRST_TILT_DEG: f64 = 30.0;

fn curve_presets(ui: &mut Ui, curve: &mut PressureCurve) {
    ui.horizontal(|ui| {
        for (preset, name, tip) in [
            (PressureCurve::SOFT, tr("Soft"), tr("A light hand presses well")),
            (PressureCurve::LINEAR, tr("Linear"), tr("The pressure of the pen as it is")),
            (PressureCurve::FIRM, tr("Firm"), tr("Only a heavy hand presses well")),
        ] {
            if ui.selectable_label(*curve == preset, name).on_hover_text(tip).clicked() {
                *curve = preset;
            }
        }
    });
}

fn stabiliser(ui: &mut Ui, settings: &mut StabiliserSettings) {
    ui.horizontal(|ui| {
        for (method, name, tip) in [
            (StabiliserMethod::Off, tr("Off"), tr("The brush is where the pen is")),
            (
                StabiliserMethod::Average,
                tr("Average"),
                tr("The brush is at the mean of the pen's last way"),
            ),
            (StabiliserMethod::String, tr("String"), tr("The pen pulls the brush by a string")),
        ] {
            ui.selectable_value(&mut settings.method, method, name).on_hover_text(tip);
        }
        if settings.method == StabiliserMethod::Off {
            return;
        }
        let drag = DragValue::new(&mut settings.length).range(0.1..=500.0).speed(0.1);
        let drag = ui.add(drag.max_decimals(1)).accessible_name(tr("Length of the stabiliser"));
        drag.on_hover_text(tr("Length of the averaged way, or of the string"));
        for (unit, name, tip) in [
            (LengthUnit::Mm, "mm", tr("On the canvas, whatever the zoom")),
            (LengthUnit::Px, "px", tr("In the window, whatever the zoom")),
        ] {
            ui.selectable_value(&mut settings.unit, unit, name).on_hover_text(tip);
        }
    });
}

fn tilt(ui: &mut Ui, tilt: &mut TiltUse) {
    ui.horizontal(|ui| {
        for (choice, name, tip) in [
            (TiltUse::AsSet, tr("As all"), tr("As for all brushes")),
            (TiltUse::Pen, tr("Pen"), tr("Leans as the pen does")),
            (TiltUse::Ignored, tr("Ignored"), tr("Held as with a mouse, whatever the pen does")),
        ] {
            let choice = ui.selectable_value(tilt, choice, name);
            choice.accessible_name(tr_format!("tilt {name}", name)).on_hover_text(tip);
        }
        let fixed = matches!(tilt, TiltUse::Fixed(_));
        let button = ui.selectable_label(fixed, tr("Fixed")).accessible_name(tr("tilt Fixed"));
        if button.on_hover_text(tr("Always leans by this angle")).clicked() && !fixed {
            *tilt = TiltUse::Fixed(FIRST_TILT_DEG);
        }
        if let TiltUse::Fixed(degrees) = tilt {
            let drag = DragValue::new(degrees).range(0.0..=80.0).max_decimals(0);
            ui.add(drag.suffix("\u{b0}")).accessible_name(tr("Angle of the tilt"));
        }
    });
}

fn twist(ui: &mut Ui, twist: &mut TwistUse) {
    ui.horizontal(|ui| {
        for (choice, name, tip) in [
            (TwistUse::AsSet, tr("As all"), tr("As for all brushes")),
            (TwistUse::Device, tr("Pen"), tr("Turns with the pen, where it measures that")),
            (TwistUse::Stroke, tr("Stroke"), tr("The broad side turns across the stroke")),
        ] {
            let choice = ui.selectable_value(twist, choice, name);
            choice.accessible_name(tr_format!("twist {name}", name)).on_hover_text(tip);
        }
        let fixed = matches!(twist, TwistUse::Fixed(_));
        let button = ui.selectable_label(fixed, tr("Fixed")).accessible_name(tr("twist Fixed"));
        if button.on_hover_text(tr("Always at this angle")).clicked() && !fixed {
            *twist = TwistUse::Fixed(0.0);
        }
        if let TwistUse::Fixed(degrees) = twist {
            let drag = DragValue::new(degrees).range(0.0..=360.0).max_decimals(0);
            ui.add(drag.suffix("\u{b0}")).accessible_name(tr("Angle of the twist"));
        }
    });
}

/// Edits the pressures of one brush at the lightest and the heaviest touch, in percent.
fn range(ui: &mut Ui, options: &mut BrushOptions) {
    ui.horizontal(|ui| {
        let [least, most] = options.range;
        for (end, limits, name, tip) in [
            (0, [0.0, most], tr("Least pressure"), tr("Pressure at the lightest touch")),
            (1, [least, 1.0], tr("Most pressure"), tr("Pressure at the heaviest touch")),
        ] {
            let share = &mut options.range[end];
            let drag = DragValue::from_get_set(|set| {
                if let Some(percent) = set {
                    *share = percent / 100.0;
                }
                *share * 100.0
            });
            let drag = drag.range(100.0 * limits[0]..=100.0 * limits[1]).max_decimals(0);
            ui.add(drag.suffix(" %")).accessible_name(name).on_hover_text(tip);
        }
        ui.weak(tr("lightest to heaviest"));
    });
}

const WIDEST: f32 = 26.0;

/// Draws the field with your strokes on it.
fn test_field(ui: &mut Ui, field: &mut TestField, pen: &Pen) {
    // If this senses drags, the window stays in its place while you draw.
    let (rect, response) = ui.allocate_exact_size(vec2(SIDE, SIDE), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, tr("Test field")));
    let layer = ui.layer_id();
    let pressed = ui.input(|input| input.pointer.latest_pos());
    let reachable =
        pressed.is_none_or(|at| ui.ctx().layer_id_at(at).is_none_or(|above| above == layer));
    field.update(pen, rect, reachable, Instant::now());
    let colors = theme::colors(ui.ctx());
    let edge = Stroke::new(1.0, colors.line);
    ui.painter().rect(rect, theme::CORNER_RADIUS, colors.well, edge, StrokeKind::Inside);
    if field.strokes().is_empty() {
        let font = TextStyle::Body.resolve(ui.style());
        ui.painter().text(
            rect.center(),
            Align2::CENTER_CENTER,
            tr("Draw here"),
            font,
            colors.faint,
        );
    }
    let painter = ui.painter_at(rect.shrink(1.0));
    for stroke in field.strokes() {
        draw_stroke(&painter, rect, stroke);
    }
    if field.is_drawing() {
        ui.ctx().request_repaint();
    }
    response.on_hover_text(tr(
        "Draws a line as wide as the brush would press, with the settings shown",
    ));
}

fn draw_stroke(painter: &Painter, rect: Rect, stroke: &[TestPoint]) {
    let color = theme::colors(painter.ctx()).strong;
    let dots: Vec<(Pos2, f32)> = stroke
        .iter()
        .map(|point| (rect.min + point.at.to_vec2(), WIDEST * point.pressure as f32))
        .collect();
    for &(place, width) in &dots {
        painter.circle_filled(place, 0.5 * width, color);
    }
    for pair in dots.windows(2) {
        let width = 0.5 * (pair[0].1 + pair[1].1);
        painter.line_segment([pair[0].0, pair[1].0], Stroke::new(width, color));
    }
}

const SIDE: f32 = 220.0;

/// Side of the square in which you can grab a point, in points. Touch mode needs a larger one.
const GRABBED: f32 = 26.0;

/// If you drag a point this far beyond the plot, it is removed, in points.
const REMOVED: f32 = 28.0;

/// Straight pieces in which the curve is drawn.
const PIECES: usize = 96;

const STEP: f64 = 0.02;

/// Draws the curve and, while `enabled`, lets you edit it. `live` is the present pressure of the
/// pen.
fn edit_curve(ui: &mut Ui, curve: &mut PressureCurve, live: Option<f64>, enabled: bool) {
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

/// If you press on the plot itself, this adds a point and drags it on.
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
    } else {
        let (right, up) = arrow_keys(ui, response);
        if (right, up) != (0.0, 0.0) {
            points.move_to(index, [x + STEP * right, y + STEP * up]);
        }
    }
    points.list()[index] != [x, y]
}

/// Whether you pressed a key that removes the focused point.
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

/// Draws a point of the curve. If you are about to remove it, it is only an outline.
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
