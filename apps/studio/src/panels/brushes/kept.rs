//! Own brushes: taking one in hand, and keeping the one in hand.

use paint::strokes::Action;
use session::brushes::{BrushOptions, BrushPreset, PresetLoad};

use super::paint::{load_matching, selected, wash};
use super::panel::Brushes;
use crate::panels::PanelContext;

impl Brushes {
    /// Label of a brush in the list; its name if it is not there.
    #[must_use]
    pub fn label<'a>(&'a self, name: &'a str) -> &'a str {
        self.list.position(name).map_or(name, |at| &self.list.brushes[at].label)
    }

    /// Takes a kept brush in hand: that of its name in the list, with the kept head, or a new one.
    /// It is washed and loaded with the kept
    /// paint, if there is any. Returns its name in the painting.
    pub fn take(&mut self, preset: &BrushPreset, cx: &mut PanelContext<'_>) -> String {
        self.list.synchronize(cx);
        match self.list.position(&preset.name) {
            Some(at) => {
                self.list.select(at, cx);
                self.list.replace_head(preset.brush.clone(), cx);
            }
            None => self.list.add(&preset.name, preset.brush.clone(), cx),
        }
        let name = cx.tools.brush.clone();
        if let Some(load) = &preset.load {
            (cx.tools.vehicle, cx.tools.load_mm) = (load.vehicle, load.amount_mm);
            if let Some(load) = load.for_brush(&name) {
                // The kept paint alone, without what the brush held before.
                wash(cx);
                cx.act(Action::Load(load));
            }
        }
        name
    }

    /// The brush in hand as it is kept, with these options, and with its paint if `with_paint` is
    /// set; `None` if there is none.
    pub fn kept(
        &mut self,
        options: BrushOptions,
        with_paint: bool,
        cx: &mut PanelContext<'_>,
    ) -> Option<BrushPreset> {
        self.list.synchronize(cx);
        let at = self.list.position(&cx.tools.brush)?;
        let name = self.list.brushes[at].label.clone();
        let brush = self.list.spec(cx.painting, &cx.tools.brush)?;
        let paint = selected(cx).filter(|_| with_paint).and_then(|brush| load_matching(cx, brush));
        let load = paint.map(|paint| PresetLoad {
            recipe: paint.recipe,
            vehicle: paint.vehicle,
            amount_mm: paint.amount_mm,
        });
        Some(BrushPreset { name, brush, options, load })
    }
}
