//! The window of the drawing aids.

use eframe::egui::{Context, DragValue, Slider, Ui};

use super::controls::button;
use crate::floating;
use crate::pen::{DrawingAids, GuideKind, RulerShape, SymmetryKind};

/// Width of the window, in points.
const WIDTH: f32 = 330.0;

/// Shapes of the ruler with their names and what strokes do.
const SHAPES: [(RulerShape, &str, &str); 4] = [
    (RulerShape::Line, "Line", "Strokes keep to the ruler"),
    (RulerShape::Parallel, "Parallels", "Strokes keep parallel to the ruler, wherever they start"),
    (RulerShape::Ellipse, "Ellipse", "Strokes keep to the ellipse"),
    (RulerShape::Concentric, "Ellipses", "Strokes keep to an ellipse of its own form and middle"),
];

/// Kinds of symmetry with their names and what is painted besides a stroke.
const KINDS: [(SymmetryKind, &str, &str); 4] = [
    (SymmetryKind::Vertical, "Left and right", "Each stroke is mirrored at the axis"),
    (SymmetryKind::Horizontal, "Above and below", "Each stroke is mirrored at the line across it"),
    (SymmetryKind::Both, "Both", "Each stroke is mirrored at both lines"),
    (SymmetryKind::Radial, "Radial", "Each stroke is turned about the centre"),
];

/// Draws the window while `open` is true; its close button and Escape clear `open`.
pub fn show(context: &Context, open: &mut bool, aids: &mut DrawingAids) {
    let _ = floating::show(context, "Drawing aids", "drawing aids", open, |ui| {
        ui.set_width(WIDTH);
        guide_rows(ui, aids);
        ui.separator();
        symmetry_rows(ui, aids);
        ui.separator();
        ui.horizontal(|ui| {
            let tip = "Puts ruler, vanishing points and symmetry to the middle of the canvas";
            if button(ui, "Put back", tip, None) {
                aids.put_back();
            }
            ui.weak("Handles can be dragged while this is open");
        });
    });
}

fn guide_rows(ui: &mut Ui, aids: &mut DrawingAids) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Guide");
        for (guide, name, tip) in [
            (None, "No guide", "Strokes are free"),
            (Some(GuideKind::Ruler), "Ruler", "A line or an ellipse"),
            (Some(GuideKind::Perspective), "Perspective", "Lines to vanishing points"),
        ] {
            ui.selectable_value(&mut aids.guide, guide, name).on_hover_text(tip);
        }
    });
    match aids.guide {
        Some(GuideKind::Ruler) => {
            ui.horizontal_wrapped(|ui| {
                for (shape, name, tip) in SHAPES {
                    ui.selectable_value(&mut aids.ruler.shape, shape, name).on_hover_text(tip);
                }
            });
        }
        Some(GuideKind::Perspective) => {
            ui.horizontal_wrapped(|ui| {
                let now = aids.perspective.in_use().len();
                for (count, name) in [(1, "1 point"), (2, "2 points"), (3, "3 points")] {
                    let tip = "Number of vanishing points, which go to their usual places";
                    if ui.selectable_label(now == count, name).on_hover_text(tip).clicked() {
                        aids.set_vanishing_points(count);
                    }
                }
            });
            vanishing_rows(ui, aids);
        }
        None => return,
    }
    let tip = "Strokes on the canvas keep to the guide (G); otherwise it is only shown";
    ui.checkbox(&mut aids.snaps, "Strokes follow it").on_hover_text(tip);
}

/// Places of the vanishing points in numbers: they may lie far outside.
fn vanishing_rows(ui: &mut Ui, aids: &mut DrawingAids) {
    let count = aids.perspective.in_use().len();
    for (number, point) in (1..).zip(&mut aids.perspective.points[..count]) {
        ui.horizontal(|ui| {
            ui.label(format!("Point {number}"));
            for (value, axis) in point.iter_mut().zip(["x", "y"]) {
                let value = DragValue::new(value).range(-1e5..=1e5).max_decimals(1).suffix(" mm");
                let value = ui.add(value.prefix(format!("{axis} ")));
                value.accessible_name(format!("Point {number}, {axis}"));
            }
        });
    }
}

fn symmetry_rows(ui: &mut Ui, aids: &mut DrawingAids) {
    let symmetry = &mut aids.symmetry;
    let tip = "Each stroke on the canvas is painted again when it ends, mirrored or turned (Y), with \
               the paint that the brush has then";
    ui.checkbox(&mut symmetry.on, "Symmetry").on_hover_text(tip);
    if !symmetry.on {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (kind, name, tip) in KINDS {
            ui.selectable_value(&mut symmetry.kind, kind, name).on_hover_text(tip);
        }
    });
    if symmetry.kind == SymmetryKind::Radial {
        let arms = ui.add(Slider::new(&mut symmetry.arms, 2..=12).text("arms"));
        arms.accessible_name("Arms").on_hover_text("Number of strokes around the centre");
    } else {
        let angle = Slider::new(&mut symmetry.angle_deg, -180.0..=180.0).suffix(" degrees");
        let angle = ui.add(angle.max_decimals(1));
        angle.accessible_name("Angle of the axis").on_hover_text("Clockwise from upright");
    }
}
