//! The window of the drawing aids.

use eframe::egui::{Context, DragValue, Slider, Ui};

use super::controls::button;
use crate::floating;
use crate::keymap::hint;
use crate::language::{english, tr, tr_format};
use crate::pen::{DrawingAids, GuideKind, RulerShape, SymmetryKind};

const WIDTH: f32 = 330.0;

/// Shapes of the ruler, with their names, and tooltips that say how strokes follow them.
const SHAPES: [(RulerShape, &str, &str); 4] = [
    (RulerShape::Line, english("Line"), english("Strokes keep to the ruler")),
    (
        RulerShape::Parallel,
        english("Parallels"),
        english("Strokes keep parallel to the ruler, wherever they start"),
    ),
    (RulerShape::Ellipse, english("Ellipse"), english("Strokes keep to the ellipse")),
    (
        RulerShape::Concentric,
        english("Ellipses"),
        english("Strokes keep to an ellipse of its own form and middle"),
    ),
];

/// Kinds of symmetry, with their names, and tooltips that say how strokes are repeated.
const KINDS: [(SymmetryKind, &str, &str); 4] = [
    (
        SymmetryKind::Vertical,
        english("Left and right"),
        english("Each stroke is mirrored at the axis"),
    ),
    (
        SymmetryKind::Horizontal,
        english("Above and below"),
        english("Each stroke is mirrored at the line across it"),
    ),
    (SymmetryKind::Both, english("Both"), english("Each stroke is mirrored at both lines")),
    (SymmetryKind::Radial, english("Radial"), english("Each stroke is turned about the centre")),
];

/// Draws the window while `open` is true. The close button and Escape clear `open`.
pub fn show(context: &Context, open: &mut bool, aids: &mut DrawingAids) {
    let _ = floating::show(context, tr("Drawing aids"), "drawing aids", open, |ui| {
        ui.set_width(WIDTH);
        guide_rows(ui, aids);
        ui.separator();
        symmetry_rows(ui, aids);
        ui.separator();
        ui.horizontal(|ui| {
            let tip = tr("Puts ruler, vanishing points and symmetry to the middle of the canvas");
            if button(ui, tr("Put back"), tip, None) {
                aids.put_back();
            }
            ui.weak(tr("Handles can be dragged while this is open"));
        });
    });
}

fn guide_rows(ui: &mut Ui, aids: &mut DrawingAids) {
    ui.horizontal_wrapped(|ui| {
        ui.label(tr("Guide"));
        for (guide, name, tip) in [
            (None, tr("No guide"), tr("Strokes are free")),
            (Some(GuideKind::Ruler), tr("Ruler"), tr("A line or an ellipse")),
            (Some(GuideKind::Perspective), tr("Perspective"), tr("Lines to vanishing points")),
        ] {
            ui.selectable_value(&mut aids.guide, guide, name).on_hover_text(tip);
        }
    });
    match aids.guide {
        Some(GuideKind::Ruler) => {
            ui.horizontal_wrapped(|ui| {
                for (shape, name, tip) in SHAPES {
                    let name = tr(name);
                    let tip = tr(tip);
                    ui.selectable_value(&mut aids.ruler.shape, shape, name).on_hover_text(tip);
                }
            });
        }
        Some(GuideKind::Perspective) => {
            ui.horizontal_wrapped(|ui| {
                let now = aids.perspective.in_use().len();
                for (count, name) in [(1, tr("1 point")), (2, tr("2 points")), (3, tr("3 points"))]
                {
                    let tip = tr("Number of vanishing points, which go to their usual places");
                    if ui.selectable_label(now == count, name).on_hover_text(tip).clicked() {
                        aids.set_vanishing_points(count);
                    }
                }
            });
            vanishing_rows(ui, aids);
        }
        None => return,
    }
    let key = hint(ui.ctx(), "snapping");
    let tip = tr("Strokes on the canvas keep to the guide; otherwise it is only shown");
    ui.checkbox(&mut aids.snaps, tr("Strokes follow it")).on_hover_text(format!("{tip}{key}"));
}

/// Edits the vanishing points as numbers, because they may lie far outside.
fn vanishing_rows(ui: &mut Ui, aids: &mut DrawingAids) {
    let count = aids.perspective.in_use().len();
    for (number, point) in (1..).zip(&mut aids.perspective.points[..count]) {
        ui.horizontal(|ui| {
            ui.label(tr_format!("Point {number}", number));
            for (value, axis) in point.iter_mut().zip(["x", "y"]) {
                let value = DragValue::new(value).range(-1e5..=1e5).max_decimals(1).suffix(" mm");
                let value = ui.add(value.prefix(format!("{axis} ")));
                value.accessible_name(tr_format!("Point {number}, {axis}", number, axis));
            }
        });
    }
}

fn symmetry_rows(ui: &mut Ui, aids: &mut DrawingAids) {
    let symmetry = &mut aids.symmetry;
    let tip = tr(
        "Each stroke on the canvas is painted again when it ends, mirrored or turned, with the paint that the brush has then",
    );
    let key = hint(ui.ctx(), "symmetry");
    ui.checkbox(&mut symmetry.on, tr("Symmetry")).on_hover_text(format!("{tip}{key}"));
    if !symmetry.on {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (kind, name, tip) in KINDS {
            let name = tr(name);
            let tip = tr(tip);
            ui.selectable_value(&mut symmetry.kind, kind, name).on_hover_text(tip);
        }
    });
    if symmetry.kind == SymmetryKind::Radial {
        let arms = ui.add(Slider::new(&mut symmetry.arms, 2..=12).text(tr("arms")));
        arms.accessible_name(tr("Arms")).on_hover_text(tr("Number of strokes around the centre"));
    } else {
        let angle = Slider::new(&mut symmetry.angle_deg, -180.0..=180.0).suffix(tr(" degrees"));
        let angle = ui.add(angle.max_decimals(1));
        angle.accessible_name(tr("Angle of the axis")).on_hover_text(tr("Clockwise from upright"));
    }
}
