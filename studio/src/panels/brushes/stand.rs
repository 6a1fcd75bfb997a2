//! The stand: which brushes are at hand, in which order, and what they are called.

use render::paint::brush::HeadShape;
use render::paint::strokes::{Action, BrushSpec, Load};

use super::care::{in_hand, like};
use crate::panels::{Desk, Mode};
use session::{BrushState, Command, PaintingState};

/// Sizes of heads, in mm.
pub(super) const SIZES_MM: std::ops::RangeInclusive<f64> = 0.2..=100.0;

/// A place in the stand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    /// The brush's name in the painting and its recording.
    pub(super) name: String,
    /// What the painter calls it.
    pub(super) label: String,
    /// A head that was asked for and not yet told of.
    asked: Option<Asked>,
}

#[derive(Debug, Clone, PartialEq)]
struct Asked {
    spec: BrushSpec,
    paint: Option<Load>,
}

/// The brushes at hand. A brush that was put away stays in the painting, whose
/// recording may name it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Stand {
    pub(super) places: Vec<Place>,
    away: Vec<String>,
}

impl Stand {
    /// Takes over what the worker told: new brushes stand last, lost ones go; the
    /// brush in hand is one of the stand.
    pub(super) fn follow(&mut self, desk: &mut Desk<'_>) {
        let told = |name: &str| desk.easel.brushes.iter().find(|brush| brush.name == name);
        for place in &mut self.places {
            let arrived = place.asked.as_ref().is_some_and(|asked| {
                told(&place.name).is_some_and(|brush| {
                    brush.spec == asked.spec && (asked.paint.is_none() || brush.amount_mm > 0.0)
                })
            });
            if arrived {
                place.asked = None;
            }
        }
        self.places.retain(|place| place.asked.is_some() || told(&place.name).is_some());
        self.away.retain(|name| told(name).is_some());
        let new = |brush: &&BrushState| {
            !self.away.contains(&brush.name) && self.find(&brush.name).is_none()
        };
        let mut new: Vec<&BrushState> = desk.easel.brushes.iter().filter(new).collect();
        // The round first, the knife last, as the shapes are told of.
        let shape = |brush: &BrushState| HeadShape::ALL.iter().position(|s| *s == brush.spec.shape);
        new.sort_by_key(|brush| shape(brush));
        for BrushState { name, .. } in new {
            self.places.push(Place { name: name.clone(), label: name.clone(), asked: None });
        }
        if self.find(&desk.tools.brush).is_none()
            && let Some(first) = self.places.first()
        {
            desk.tools.brush.clone_from(&first.name);
        }
    }

    /// The place of a brush.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.places.iter().position(|place| place.name == name)
    }

    /// The head of a brush, as it was last asked for.
    pub(super) fn spec(&self, easel: &PaintingState, name: &str) -> Option<BrushSpec> {
        let asked = self.find(name).and_then(|place| self.places[place].asked.as_ref());
        let told = || easel.brushes.iter().find(|brush| brush.name == name);
        asked.map(|asked| asked.spec.clone()).or_else(|| Some(told()?.spec.clone()))
    }

    /// Takes a brush in hand, to paint with.
    pub(super) fn take(&self, place: usize, desk: &mut Desk<'_>) {
        if let Some(place) = self.places.get(place) {
            desk.tools.brush.clone_from(&place.name);
            desk.tools.mode = Mode::Paint;
        }
    }

    /// Takes a new, clean brush in hand, called like `base`; it stands after the
    /// one in hand before.
    pub(super) fn add(&mut self, base: &str, spec: BrushSpec, desk: &mut Desk<'_>) {
        let name = self.free_name(base, desk.easel);
        let after = self.find(&desk.tools.brush).map_or(self.places.len(), |place| place + 1);
        let asked = Some(Asked { spec: spec.clone(), paint: None });
        self.places.insert(after, Place { name: name.clone(), label: name.clone(), asked });
        desk.command(Command::SetBrush { name, spec });
        self.take(after, desk);
    }

    /// Keeps the brush in hand as it is loaded, and takes a clean twin in hand.
    pub(super) fn keep(&mut self, desk: &mut Desk<'_>) {
        let kept = desk.tools.brush.clone();
        if let Some(spec) = self.spec(desk.easel, &kept) {
            self.add(&kept, spec, desk);
        }
    }

    /// Puts a brush away, and takes its neighbour in hand if it was there.
    pub(super) fn put_away(&mut self, place: usize, desk: &mut Desk<'_>) {
        let gone = self.places.remove(place);
        if gone.name == desk.tools.brush && !self.places.is_empty() {
            let next = place.min(self.places.len() - 1);
            desk.tools.brush.clone_from(&self.places[next].name);
        }
        self.away.push(gone.name);
    }

    /// Gives the brush in hand another head. The mean of its paint goes along.
    pub(super) fn exchange(&mut self, spec: BrushSpec, desk: &mut Desk<'_>) {
        let Some(place) = self.find(&desk.tools.brush) else { return };
        if self.spec(desk.easel, &desk.tools.brush).as_ref() == Some(&spec) {
            return;
        }
        let name = desk.tools.brush.clone();
        // Asked twice before the worker told: the paint is what it was at first.
        let before = self.places[place].asked.take();
        let paint = match before {
            Some(asked) => asked.paint,
            None => in_hand(desk).and_then(|brush| like(desk, brush)),
        };
        self.places[place].asked = Some(Asked { spec: spec.clone(), paint: paint.clone() });
        desk.command(Command::SetBrush { name, spec });
        if let Some(paint) = paint {
            desk.act(Action::Load(paint));
        }
    }

    /// A name that no brush of painting and stand has: `flat`, `flat 2` ..
    fn free_name(&self, base: &str, easel: &PaintingState) -> String {
        let taken = |name: &str| {
            self.find(name).is_some() || easel.brushes.iter().any(|brush| brush.name == name)
        };
        let stem = match base.rsplit_once(' ') {
            Some((stem, number)) if number.parse::<u32>().is_ok() => stem,
            _ => base,
        };
        let numbered = (2..).map(|number| format!("{stem} {number}"));
        let mut names = std::iter::once(stem.to_owned()).chain(numbered);
        names.find(|name| !taken(name)).expect("numbers do not end")
    }
}
