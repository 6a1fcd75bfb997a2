//! The list of brushes: order, labels, and requested changes of heads.

use paint::brush::HeadShape;
use paint::strokes::{Action, BrushSpec, Load};

use super::paint::{load_matching, selected};
use crate::panels::{Mode, PanelContext};
use session::{BrushState, Command, PaintingState};

/// Range of head sizes, in mm.
pub(super) const SIZES_MM: std::ops::RangeInclusive<f64> = 0.2..=100.0;

/// An entry of the brush list.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ListedBrush {
    /// Name of the brush in the painting and its recording.
    pub(super) name: String,
    /// Label shown to the painter.
    pub(super) label: String,
    /// Requested head that the worker has not reported yet.
    requested: Option<RequestedHead>,
}

#[derive(Debug, Clone, PartialEq)]
struct RequestedHead {
    spec: BrushSpec,
    paint: Option<Load>,
}

/// Brushes shown in the panel. A removed brush stays in the painting, because the
/// recording may name it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct BrushList {
    pub(super) brushes: Vec<ListedBrush>,
    removed: Vec<String>,
}

impl BrushList {
    /// Updates the list from the reported state: appends new brushes, drops missing
    /// ones, and ensures that the selected brush is in the list.
    pub(super) fn synchronize(&mut self, cx: &mut PanelContext<'_>) {
        let reported = |name: &str| cx.painting.brushes.iter().find(|brush| brush.name == name);
        for entry in &mut self.brushes {
            let confirmed = entry.requested.as_ref().is_some_and(|requested| {
                reported(&entry.name).is_some_and(|brush| {
                    brush.spec == requested.spec
                        && (requested.paint.is_none() || brush.amount_mm > 0.0)
                })
            });
            if confirmed {
                entry.requested = None;
            }
        }
        self.brushes.retain(|entry| entry.requested.is_some() || reported(&entry.name).is_some());
        self.removed.retain(|name| reported(name).is_some());
        let new = |brush: &&BrushState| {
            !self.removed.contains(&brush.name) && self.position(&brush.name).is_none()
        };
        let mut new: Vec<&BrushState> = cx.painting.brushes.iter().filter(new).collect();
        // In the order of the shapes, from round to knife.
        let shape = |brush: &BrushState| HeadShape::ALL.iter().position(|s| *s == brush.spec.shape);
        new.sort_by_key(|brush| shape(brush));
        for BrushState { name, .. } in new {
            self.brushes.push(ListedBrush {
                name: name.clone(),
                label: name.clone(),
                requested: None,
            });
        }
        if self.position(&cx.tools.brush).is_none()
            && let Some(first) = self.brushes.first()
        {
            cx.tools.brush.clone_from(&first.name);
        }
    }

    /// Index of a brush in the list.
    pub(super) fn position(&self, name: &str) -> Option<usize> {
        self.brushes.iter().position(|entry| entry.name == name)
    }

    /// Head of a brush, including a requested change that is not confirmed yet.
    pub(super) fn spec(&self, painting: &PaintingState, name: &str) -> Option<BrushSpec> {
        let requested =
            self.position(name).and_then(|entry| self.brushes[entry].requested.as_ref());
        let reported = || painting.brushes.iter().find(|brush| brush.name == name);
        requested.map(|requested| requested.spec.clone()).or_else(|| Some(reported()?.spec.clone()))
    }

    /// Selects a brush, and the paint tool unless another tool with a head is in use.
    pub(super) fn select(&self, entry: usize, cx: &mut PanelContext<'_>) {
        if let Some(entry) = self.brushes.get(entry) {
            cx.tools.brush.clone_from(&entry.name);
            if !cx.tools.mode.moves_head() {
                cx.tools.mode = Mode::Paint;
            }
        }
    }

    /// Adds a new, clean brush after the selected one and selects it. Its name is
    /// `base`, numbered if that exists.
    pub(super) fn add(&mut self, base: &str, spec: BrushSpec, cx: &mut PanelContext<'_>) {
        let name = self.free_name(base, cx.painting);
        let after = self.position(&cx.tools.brush).map_or(self.brushes.len(), |entry| entry + 1);
        let requested = Some(RequestedHead { spec: spec.clone(), paint: None });
        self.brushes
            .insert(after, ListedBrush { name: name.clone(), label: name.clone(), requested });
        cx.command(Command::SetBrush { name, spec });
        self.select(after, cx);
    }

    /// Adds a clean copy of the selected brush and selects it; the original keeps its
    /// paint.
    pub(super) fn duplicate(&mut self, cx: &mut PanelContext<'_>) {
        let kept = cx.tools.brush.clone();
        if let Some(spec) = self.spec(cx.painting, &kept) {
            self.add(&kept, spec, cx);
        }
    }

    /// Removes a brush from the list; if it was selected, selects its neighbour.
    pub(super) fn remove(&mut self, index: usize, cx: &mut PanelContext<'_>) {
        let removed = self.brushes.remove(index);
        if removed.name == cx.tools.brush && !self.brushes.is_empty() {
            let next = index.min(self.brushes.len() - 1);
            cx.tools.brush.clone_from(&self.brushes[next].name);
        }
        self.removed.push(removed.name);
    }

    /// Replaces the head of the selected brush, which keeps the mean of its paint.
    pub(super) fn replace_head(&mut self, spec: BrushSpec, cx: &mut PanelContext<'_>) {
        let Some(entry) = self.position(&cx.tools.brush) else { return };
        if self.spec(cx.painting, &cx.tools.brush).as_ref() == Some(&spec) {
            return;
        }
        let name = cx.tools.brush.clone();
        self.follow_shape(entry, spec.shape, cx.painting);
        // A second request before the worker reported: keep the paint of the first.
        let before = self.brushes[entry].requested.take();
        let paint = match before {
            Some(requested) => requested.paint,
            None => selected(cx).and_then(|brush| load_matching(cx, brush)),
        };
        self.brushes[entry].requested =
            Some(RequestedHead { spec: spec.clone(), paint: paint.clone() });
        cx.command(Command::SetBrush { name, spec });
        if let Some(paint) = paint {
            cx.act(Action::Load(paint));
        }
    }

    /// Labels a brush by its new shape, unless it has a label of the painter's.
    fn follow_shape(&mut self, entry: usize, shape: HeadShape, painting: &PaintingState) {
        let label = stem(&self.brushes[entry].label);
        let is_shape = HeadShape::ALL.iter().any(|known| known.name() == label);
        if is_shape && label != shape.name() {
            self.brushes[entry].label = self.free_name(shape.name(), painting);
        }
    }

    /// Returns a name that no brush of painting or list has, and no label: `flat`, `flat 2`, ..
    fn free_name(&self, base: &str, painting: &PaintingState) -> String {
        let exists = |name: &str| {
            self.brushes.iter().any(|entry| entry.name == name || entry.label == name)
                || painting.brushes.iter().any(|brush| brush.name == name)
        };
        let stem = stem(base);
        let numbered = (2..).map(|number| format!("{stem} {number}"));
        let mut names = std::iter::once(stem.to_owned()).chain(numbered);
        names.find(|name| !exists(name)).expect("there is always a free number")
    }
}

/// A name without its number.
fn stem(name: &str) -> &str {
    match name.rsplit_once(' ') {
        Some((stem, number)) if number.parse::<u32>().is_ok() => stem,
        _ => name,
    }
}
