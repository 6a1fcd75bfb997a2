//! Rows of settings: presets of the curve, stabiliser, tilt, twist and range.

use eframe::egui::{DragValue, Ui};
use session::brushes::{
    BrushOptions, LengthUnit, PressureCurve, StabiliserMethod, StabiliserSettings, TiltUse,
    TwistUse,
};

use crate::language::{tr, tr_format};

/// Angle of a brush that is fixed first, in degrees.
const FIRST_TILT_DEG: f64 = 30.0;

/// Buttons that set the whole curve.
pub(super) fn curve_presets(ui: &mut Ui, curve: &mut PressureCurve) {
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

/// Method, length and unit of a stabiliser.
pub(super) fn stabiliser(ui: &mut Ui, settings: &mut StabiliserSettings) {
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

/// The tilt of one brush.
pub(super) fn tilt(ui: &mut Ui, tilt: &mut TiltUse) {
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

/// The rotation of one brush about its handle.
pub(super) fn twist(ui: &mut Ui, twist: &mut TwistUse) {
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

/// Pressures of one brush at the lightest and the heaviest touch, in percent.
pub(super) fn range(ui: &mut Ui, options: &mut BrushOptions) {
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
