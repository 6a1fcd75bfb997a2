//! Settings of the tools that work wet paint, and the mask.

use eframe::egui::{Slider, Ui};
use paint::strokes::{Action, LayerRef, MaskChange};

use crate::language::{tr, tr_format};
use crate::panels::controls::{button, percent, slider};
use crate::panels::{Mode, PanelContext};

/// Whether a tool has settings. Their heads are clean: they neither lay nor keep the brush's paint.
pub(super) fn has_settings(mode: Mode) -> bool {
    matches!(mode, Mode::Blend | Mode::Erase | Mode::Scrape | Mode::Mask)
}

/// Draws the settings of the tool in use, if it has some.
pub(super) fn show(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    match cx.tools.mode {
        Mode::Blend => {
            let tip = tr("How much blending mixes and moves the wet paint");
            let note = tr("The head is clean; the paint of the brush stays on it");
            let tip = format!("{tip}.\n{note}.");
            percent(ui, tr("Strength"), &tip, &mut cx.tools.blend_strength, 1.0..=100.0);
        }
        Mode::Erase => {
            let tip = tr("How much of the wet paint a rag takes; pressure takes more");
            let tip = format!("{tip}.\n{note}.", note = tr("Dry layers stay as they are"));
            percent(ui, tr("Strength"), &tip, &mut cx.tools.erase_strength, 1.0..=100.0);
        }
        Mode::Scrape => {
            let height = Slider::new(&mut cx.tools.scrape_mm, 0.0..=2.0).suffix(" mm");
            let tip =
                tr("Height of the blade over the ground: 0 scrapes down to it, and so does full \
                 pressure");
            let note = tr("Paint stays in the valleys of the ground");
            let tip = format!("{tip}.\n{note}.");
            slider(ui, tr("Height"), &tip, height.max_decimals(2).step_by(0.01));
        }
        Mode::Mask => mask(ui, cx),
        _ => {}
    }
}

fn mask(ui: &mut Ui, cx: &mut PanelContext<'_>) {
    let covered = cx.painting.mask.as_ref().map(|mask| mask.covered);
    ui.label(covered.map_or_else(
        || tr("No mask: draw one on the canvas, with shift a rectangle").to_owned(),
        |covered| tr_format!("{covered:.0} % of the canvas is covered", covered = 100.0 * covered),
    ));
    let none = covered.is_none().then_some(tr("there is no mask"));
    let mut change = None;
    ui.horizontal(|ui| {
        let tip = tr("Covers what is open, and opens what is covered");
        if button(ui, tr("Invert"), tip, none) {
            change = Some(MaskChange::Inverse(true));
        }
        if button(ui, tr("Take off"), tr("Takes the mask off the canvas"), none) {
            change = Some(MaskChange::Clear {});
        }
    });
    ui.weak(tr("Leave open only where there is:"));
    ui.horizontal_wrapped(|ui| {
        let tip = tr("Locks the bare canvas: strokes change only cells that have paint now");
        if button(ui, tr("Any paint"), tip, None) {
            change = Some(MaskChange::Painted {});
        }
        if button(ui, tr("Wet paint"), tr("Strokes change only cells that are wet now"), None) {
            change = Some(MaskChange::Layer(LayerRef::Wet));
        }
        for layer in cx.painting.layers.iter().rev() {
            let name = layer.label();
            let tip = tr_format!("Strokes change only cells that have paint of {name}", name);
            if button(ui, &name, &tip, None) {
                change = Some(MaskChange::Layer(LayerRef::Id(layer.id)));
            }
        }
    });
    if let Some(change) = change {
        cx.act(Action::Mask(change));
    }
}
