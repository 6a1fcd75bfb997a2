//! Strokes at rest: what each feature of the model carries, whatever the view.

use std::sync::Arc;

use glam::{Vec2, Vec3};
use graphics::coherence::{Feature, Features};
use rayon::prelude::*;

use super::coloring::Coloring;
use super::grid::Grid;
use super::places::{Place, Surface};
use super::regions::Style;

/// Least cosine between the normals of strokes that continue each other.
const ALIKE: f32 = 0.6;

/// Numbers of a feature's random offsets.
const RANDOM: [u64; 2] = [16, 17];

/// A stroke of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Root {
    pub(super) place: Place,
    /// Where it starts in the map.
    pub(super) start: Start,
    /// Colour that is added to the map's.
    pub(super) color: Vec3,
    /// Tone, 0 to 1 of the map's, that does not depend on light; `None` if light decides.
    pub(super) tone: Option<f32>,
}

/// The place in the map that the centre of a stroke shows. Strokes of one patch of the model go on
/// in the map as they do on the model, at whatever size they are seen: each adds its way from the
/// origin of its patch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Start {
    /// Place in the map of the origin of the patch, in widths of the map.
    pub(super) origin: Vec2,
    /// From the origin across and along the strokes, in units of the model.
    pub(super) way: Vec2,
}

impl Start {
    /// Place in the map, 0 to 1 in widths of the map, with so many widths to a unit of the model.
    pub(super) fn at(&self, widths_per_unit: f32) -> Vec2 {
        let place = self.origin + self.way * widths_per_unit;
        place - place.floor()
    }

    /// The same patch of the map, further on.
    pub(super) fn further(&self, way: Vec2) -> Self {
        Self { way: self.way + way, ..*self }
    }
}

/// From the centre of one stroke to that of another, across and along the mean of both their axes,
/// in units of the model.
pub(super) fn way(from: (&Feature, &Place), to: (&Feature, &Place)) -> Vec2 {
    let between = to.0.position - from.0.position;
    let part = |one: Vec3, other: Vec3| {
        let other = if one.dot(other) < 0.0 { one } else { other };
        between.dot(one + other) / 2.0
    };
    Vec2::new(part(from.1.across(), to.1.across()), part(from.1.along, to.1.along))
}

/// Whether the strokes of two places continue each other: on one side of the surface, and of one
/// region.
pub(super) fn alike(one: &Place, other: &Place) -> bool {
    one.normal.dot(other.normal) > ALIKE && one.region == other.region
}

/// The strokes of a subject. Those up to some density are kept; all others are made when they are
/// asked for, and continue the nearest kept one.
#[derive(Debug)]
pub(super) struct Roots {
    surface: Surface,
    coloring: Arc<Coloring>,
    /// L* of the darkest and of the lightest tone, where the subject's lightness decides the tone.
    lightness: Option<[f32; 2]>,
    /// Seeds of kept strokes, rising.
    seeds: Vec<u64>,
    /// Kept strokes and their features, in the order of the seeds.
    kept: Vec<Root>,
    features: Vec<Feature>,
    /// The kept strokes by place, where others continue them.
    grid: Option<Grid>,
}

impl Roots {
    /// Strokes on a surface, none of them kept. Their tone follows the colour of the surface, from
    /// the first L* to the last, or else light.
    pub(super) fn new(
        surface: Surface,
        coloring: Arc<Coloring>,
        lightness: Option<[f32; 2]>,
    ) -> Self {
        let seeds = Vec::new();
        let kept = Vec::new();
        let features = Vec::new();
        Self { surface, coloring, lightness, seeds, kept, features, grid: None }
    }

    /// How a stroke is painted.
    pub(super) fn style(&self, root: &Root) -> &Style {
        &self.surface.regions.styles[usize::from(root.place.region)]
    }

    /// How strokes are painted, by region.
    pub(super) fn styles(&self) -> &[Style] {
        &self.surface.regions.styles
    }

    /// Number of kept strokes.
    pub(super) fn count(&self) -> usize {
        self.kept.len()
    }

    /// Least and greatest size of strokes by that of the settings.
    pub(super) fn sizes(&self) -> [f32; 2] {
        self.surface.regions.sizes()
    }

    /// The same strokes; those of all features below a priority are kept, and start where `starts`
    /// says instead of anywhere. `reach` is half the length of a stroke in units of the model.
    pub(super) fn keeping(
        mut self,
        features: &Features,
        priority: f32,
        reach: f32,
        starts: impl FnOnce(&[Feature], &[Root]) -> Option<Vec<Start>>,
    ) -> Self {
        let mut features = features.below(priority);
        features.sort_unstable_by_key(|feature| feature.seed);
        let kept = features.par_iter().map(|feature| (*feature, self.made(feature)));
        let shown = kept.filter(|(_, root)| root.place.detail > 0.0);
        let (features, mut kept): (Vec<Feature>, Vec<Root>) = shown.unzip();
        if let Some(starts) = starts(&features, &kept) {
            kept.iter_mut().zip(starts).for_each(|(root, start)| root.start = start);
            self.grid = Some(Grid::new(features.iter().map(|feature| feature.position), reach));
        }
        self.seeds = features.iter().map(|feature| feature.seed).collect();
        (self.kept, self.features) = (kept, features);
        self
    }

    /// The stroke of a feature.
    pub(super) fn of(&self, feature: &Feature) -> Root {
        match self.seeds.binary_search(&feature.seed) {
            Ok(index) => self.kept[index],
            Err(_) => self.continued(feature, self.made(feature)),
        }
    }

    /// A bound on the curvature of the surface around a feature, per unit of the model.
    pub(super) fn greatest_bend(&self, feature: &Feature) -> f32 {
        self.surface.greatest_bend(feature)
    }

    /// The stroke of a feature, which need not continue others.
    pub(super) fn single(&self, feature: &Feature) -> Root {
        match self.seeds.binary_search(&feature.seed) {
            Ok(index) => self.kept[index],
            Err(_) => self.made(feature),
        }
    }

    /// A stroke that goes on in the map from the nearest kept one on its side of the surface.
    fn continued(&self, feature: &Feature, own: Root) -> Root {
        let Some(grid) = &self.grid else { return own };
        let near =
            grid.near(feature.position).filter(|&other| alike(&self.kept[other].place, &own.place));
        let distance =
            |other: &usize| self.features[*other].position.distance_squared(feature.position);
        let nearest = near.min_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b)));
        let Some(other) = nearest else { return own };
        let kept = &self.kept[other];
        let way = way((&self.features[other], &kept.place), (feature, &own.place));
        Root { start: kept.start.further(way), ..own }
    }

    /// How a pixel shows colours.
    pub(super) fn coloring(&self) -> &Arc<Coloring> {
        &self.coloring
    }

    fn made(&self, feature: &Feature) -> Root {
        let place = self.surface.place(feature);
        let tone = self.lightness.map(|[darkest, lightest]| {
            let share = (Coloring::lightness(place.color) - darkest) / (lightest - darkest);
            share.clamp(0.0, 1.0)
        });
        Root {
            tone,
            start: Start {
                origin: RANDOM.map(|number| feature.unit(number)).into(),
                way: Vec2::ZERO,
            },
            color: self.coloring.of_splat(place.color),
            place,
        }
    }
}
