//! A smooth field of lines along a surface. You can make arrows from it, along which things move.
//! A spanning tree gives the lines their signs.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::smoothing::{Evidence, Link, Links, line_within, smooth_squares, vector_within};
use super::{DirectionFault, DirectionSettings, Guide, Line};
use crate::mesh::curvature::{PlaceShape, Places, TangentPlane, carried, place_shapes};
use crate::mesh::model::Mesh;

/// Least smoothing length, as a share of the model's radius. Through this, places without
/// curvature take their neighbours' directions.
const LEAST_SMOOTHING: f64 = 1e-3;

/// The part of a guide along the surface must be longer than this share of the guide's length.
const LEAST_ALONG: f64 = 1e-3;

/// A smooth field of tangent directions of arbitrary sign on a mesh, one for every vertex.
///
/// This field belongs to the model: it does not depend on a camera, and it turns with the mesh. If
/// a connected part has no direction in its shape, for example a sphere or a plane, it follows a
/// fixed axis (y, or x if its surface faces up). Its poles then stay singular.
#[derive(Debug, Clone)]
pub struct DirectionField {
    pub(super) of_vertex: Vec<u32>,
    pub(super) links: Links,
    pub(super) planes: Vec<TangentPlane>,
    pub(super) squares: Vec<DVec2>,
    pub(super) lines: Vec<DVec3>,
    pub(super) guided: Vec<Option<DVec3>>,
}

struct Base<'a> {
    of_vertex: &'a [u32],
    shapes: Vec<PlaceShape>,
    radius: f64,
    links: Links,
    planes: Vec<TangentPlane>,
    fixed: Vec<bool>,
}

impl DirectionField {
    /// The field along the principal directions of the mesh's curvature ([`Curvature::of_mesh`](crate::mesh::Curvature::of_mesh)),
    /// smoothed over `settings.smoothing` as lines of two-fold symmetry.
    ///
    /// The weight of a direction is the difference between the absolute values of both curvatures
    /// times the model's radius. Where both are equal, the neighbours decide. If you give a vertex
    /// a guide, it has the direction of the guide.
    ///
    /// # Errors
    /// [`DirectionFault`] if the smoothing is outside 0..1, or a guide has no such vertex or no
    /// part along the surface there.
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist, or there are fewer normals than positions.
    /// [`Mesh::check`] finds both.
    pub fn of_curvature(
        mesh: &Mesh,
        settings: &DirectionSettings,
        guides: &[Guide],
    ) -> Result<Self, DirectionFault> {
        Self::found(mesh, settings, guides, |base| {
            let mut evidence = Evidence::of_curvature(&base.shapes, base.radius, settings.along);
            evidence.add_axes(&base.links, &base.planes, &base.shapes, &base.fixed);
            evidence
        })
    }

    /// The field through given lines, one for each vertex, smoothed over `settings.smoothing`. A
    /// line counts by its weight and the area around its vertex. Where you set weights to 0, the
    /// neighbours decide. If you give a vertex a guide, it has the direction of the guide.
    ///
    /// # Errors
    /// This fails like [`Self::of_curvature`].
    ///
    /// # Panics
    /// This panics like [`Self::of_curvature`], and if there are fewer lines than vertices.
    pub fn of_lines(
        mesh: &Mesh,
        lines: &[Line],
        settings: &DirectionSettings,
        guides: &[Guide],
    ) -> Result<Self, DirectionFault> {
        Self::found(mesh, settings, guides, |base| {
            let mut evidence =
                Evidence::of_lines(base.of_vertex, &base.planes, &base.shapes, lines);
            evidence.add_axes(&base.links, &base.planes, &base.shapes, &base.fixed);
            evidence
        })
    }

    fn found(
        mesh: &Mesh,
        settings: &DirectionSettings,
        guides: &[Guide],
        evidence: impl FnOnce(&Base<'_>) -> Evidence,
    ) -> Result<Self, DirectionFault> {
        if !(0.0..=1.0).contains(&settings.smoothing) {
            return Err(DirectionFault::Smoothing(settings.smoothing));
        }
        let places = Places::of(mesh, settings.normal_rounds);
        let normals = places.normals.par_iter();
        let planes: Vec<_> = normals.map(|&normal| TangentPlane::of_normal(normal)).collect();
        let (guided, given) = fixed_squares(guides, &places.of_vertex, &planes)?;
        let fixed: Vec<bool> = guided.iter().map(Option::is_some).collect();
        let shapes = place_shapes(&places, &planes);
        let links = Links::new(&places, &planes);
        let radius = places.radius();
        let base = Base { of_vertex: &places.of_vertex, shapes, radius, links, planes, fixed };
        let evidence = evidence(&base);
        let Base { links, planes, fixed, .. } = base;
        let length = radius * settings.smoothing.max(LEAST_SMOOTHING);
        let squares = smooth_squares(&links, &evidence, length * length, &fixed, &given);
        let pairs = squares.par_iter().zip(&planes);
        let lines = pairs.map(|(&square, plane)| line(plane, square)).collect();
        Ok(Self { of_vertex: places.of_vertex, links, planes, squares, lines, guided })
    }

    /// Unit direction at a vertex, of arbitrary sign, perpendicular to its smoothed normal.
    ///
    /// # Panics
    /// If the mesh has no such vertex.
    #[must_use]
    pub fn along(&self, vertex: usize) -> [f32; 3] {
        self.lines[self.of_vertex[vertex] as usize].as_vec3().to_array()
    }

    /// How well the direction at a vertex is determined, 0 to 1. This is near 0 at singular
    /// places, around which directions cancel out, and where no evidence is near.
    ///
    /// # Panics
    /// If the mesh has no such vertex.
    #[must_use]
    pub fn reliability(&self, vertex: usize) -> f32 {
        self.squares[self.of_vertex[vertex] as usize].length().min(1.0) as f32
    }

    /// Unit direction, of arbitrary sign, at a point inside a triangle with these corners. Pass
    /// barycentric weights that are not negative and add up to 1. Except for its sign, the
    /// direction is continuous in the triangle and across its edges, but not at singular points.
    ///
    /// # Panics
    /// If the mesh has no such vertices.
    #[must_use]
    pub fn within(&self, corners: [u32; 3], weights: [f32; 3]) -> [f32; 3] {
        let places = corners.map(|corner| self.of_vertex[corner as usize] as usize);
        let normals = places.map(|place| self.planes[place].normal);
        let lines = places.map(|place| self.lines[place]);
        line_within(normals, lines, weights.map(f64::from)).as_vec3().to_array()
    }
}

/// Unit vector along the line with this square. If the square is 0, nothing determines the line,
/// and this follows the y axis.
fn line(plane: &TangentPlane, square: DVec2) -> DVec3 {
    let axis = plane.projected(DVec3::Y);
    plane.along(if square == DVec2::ZERO { axis.rotate(axis) } else { square })
}

fn fixed_squares(
    guides: &[Guide],
    of_vertex: &[u32],
    planes: &[TangentPlane],
) -> Result<(Vec<Option<DVec3>>, Vec<DVec2>), DirectionFault> {
    let mut fixed = vec![None; planes.len()];
    let mut given = vec![DVec2::ZERO; planes.len()];
    for (index, guide) in guides.iter().enumerate() {
        let Some(&place) = of_vertex.get(guide.vertex as usize) else {
            let vertices = of_vertex.len();
            return Err(DirectionFault::NoSuchVertex {
                guide: index,
                found: guide.vertex,
                vertices,
            });
        };
        let off =
            DirectionFault::OffSurface { guide: index, vertex: guide.vertex, found: guide.along };
        let along = DVec3::from(guide.along.map(f64::from)).try_normalize().ok_or(off.clone())?;
        let flat = planes[place as usize].projected(along);
        if flat.length() <= LEAST_ALONG {
            return Err(off);
        }
        let unit = flat.normalize();
        fixed[place as usize] = Some(along);
        given[place as usize] = unit.rotate(unit);
    }
    Ok((fixed, given))
}

/// The sign of an arrow comes from its first component that is larger than this.
const LEAST_PART: f64 = 1e-3;

/// Lines with signs: an arrow for every vertex, and a strength that fades to 0 where neighbours
/// disagree.
#[derive(Debug, Clone)]
pub struct FlowField {
    of_vertex: Vec<u32>,
    normals: Vec<DVec3>,
    arrows: Vec<DVec3>,
    strengths: Vec<f64>,
    singular: Vec<bool>,
}

impl DirectionField {
    /// Gives the lines signs along the spanning tree of greatest reliability. The tree grows from
    /// all places with a guide at once, so that flow runs along guides and not against them.
    ///
    /// Around some places lines make half a turn, so that the arrows of neighbours must oppose each
    /// other somewhere. This marks vertices with such neighbours as singular and sets the strength
    /// there to 0. The strength rises to 1 over `fade_rings` rings of edges. Use 2 or 3. If you
    /// pass 0, it is 1 right beside singular vertices.
    #[must_use]
    pub fn oriented(&self, fade_rings: usize) -> FlowField {
        self.signed(self.arrows(), fade_rings)
    }

    /// Gives the lines the signs of given arrows, one for each vertex and of any length. Pass 0
    /// for a vertex without an arrow. A connected part takes the signs as [`Self::oriented`] does.
    /// This turns all of them over if most given arrows say so.
    ///
    /// # Panics
    /// If there are fewer arrows than vertices.
    #[must_use]
    pub fn oriented_by(&self, given: &[[f32; 3]], fade_rings: usize) -> FlowField {
        let mut wanted = vec![DVec3::ZERO; self.lines.len()];
        for (&place, arrow) in self.of_vertex.iter().zip(given) {
            wanted[place as usize] += DVec3::from(arrow.map(f64::from));
        }
        let mut arrows = self.arrows();
        let (order, parts) = self.links.parts();
        for part in parts {
            let places = order[part].iter().map(|&place| place as usize);
            let agreement: f64 = places.clone().map(|place| arrows[place].dot(wanted[place])).sum();
            for place in places {
                let own = arrows[place].dot(wanted[place]);
                if own < 0.0 || (own == 0.0 && agreement < 0.0) {
                    arrows[place] = -arrows[place];
                }
            }
        }
        self.signed(arrows, fade_rings)
    }

    fn signed(&self, arrows: Vec<DVec3>, fade_rings: usize) -> FlowField {
        let singular: Vec<bool> =
            (0..arrows.len()).map(|place| self.is_singular(&arrows, place)).collect();
        let full = fade_rings.saturating_add(1);
        let steps = rings(&self.links, &singular, full);
        let strengths = steps.iter().map(|&ring| smooth(ring as f64 / full as f64));
        FlowField {
            of_vertex: self.of_vertex.clone(),
            normals: self.planes.iter().map(|plane| plane.normal).collect(),
            strengths: strengths.collect(),
            arrows,
            singular,
        }
    }

    fn arrows(&self) -> Vec<DVec3> {
        let reliabilities: Vec<f64> = self.squares.iter().map(|square| square.length()).collect();
        let guided = (0..).zip(&self.guided).filter(|(_, guide)| guide.is_some());
        let seeds: Vec<u32> = guided.map(|(place, _)| place).collect();
        let tree = spanning_tree(&self.links, &reliabilities, &seeds, |place, link| {
            self.squares[place].dot(link.turn.rotate(self.squares[link.to as usize]))
        });
        let mut arrows = self.lines.clone();
        for step in tree {
            let place = step.place as usize;
            let against = match (step.from, self.guided[place]) {
                (_, Some(guide)) => arrows[place].dot(guide) < 0.0,
                (Some(from), None) => self.cosine(&arrows, place, from as usize) < 0.0,
                (None, None) => points_back(arrows[place]),
            };
            if against {
                arrows[place] = -arrows[place];
            }
        }
        arrows
    }

    fn cosine(&self, arrows: &[DVec3], place: usize, other: usize) -> f64 {
        let there = carried(arrows[other], self.planes[other].normal, self.planes[place].normal);
        there.map_or(0.0, |there| arrows[place].dot(there))
    }

    fn is_singular(&self, arrows: &[DVec3], place: usize) -> bool {
        let mut links = self.links.of(place).iter();
        links.any(|link| self.cosine(arrows, place, link.to as usize) < 0.0)
    }
}

impl FlowField {
    /// Unit arrow at a vertex, perpendicular to its smoothed normal.
    ///
    /// # Panics
    /// If the mesh has no such vertex.
    #[must_use]
    pub fn arrow(&self, vertex: usize) -> [f32; 3] {
        self.arrows[self.of_vertex[vertex] as usize].as_vec3().to_array()
    }

    /// Strength of the flow at a vertex, 0 at a singular one to 1.
    ///
    /// # Panics
    /// If the mesh has no such vertex.
    #[must_use]
    pub fn strength(&self, vertex: usize) -> f32 {
        self.strengths[self.of_vertex[vertex] as usize] as f32
    }

    /// Whether the arrow of a neighbour of this vertex differs by more than 90 degrees.
    ///
    /// # Panics
    /// If the mesh has no such vertex.
    #[must_use]
    pub fn is_singular(&self, vertex: usize) -> bool {
        self.singular[self.of_vertex[vertex] as usize]
    }

    /// Flow at a point inside a triangle with these corners, as a tangent vector. Pass barycentric
    /// weights that are not negative and add up to 1. The length of the vector, 0 to 1, is the
    /// strength. It is continuous in the triangle and across its edges.
    ///
    /// # Panics
    /// If the mesh has no such vertices.
    #[must_use]
    pub fn within(&self, corners: [u32; 3], weights: [f32; 3]) -> [f32; 3] {
        let places = corners.map(|corner| self.of_vertex[corner as usize] as usize);
        let normals = places.map(|place| self.normals[place]);
        let vectors = places.map(|place| self.strengths[place] * self.arrows[place]);
        vector_within(normals, vectors, weights.map(f64::from)).as_vec3().to_array()
    }
}

/// Whether the first arrow of a part points down. A level arrow points back if it goes to the
/// left, or backwards.
fn points_back(arrow: DVec3) -> bool {
    let parts = [arrow.y, arrow.x, arrow.z];
    parts.into_iter().find(|part| part.abs() > LEAST_PART).is_some_and(|part| part < 0.0)
}

/// Number of links from every place to the nearest singular one, at most `most`.
fn rings(links: &Links, singular: &[bool], most: usize) -> Vec<usize> {
    let mut rings: Vec<usize> = singular.iter().map(|&is| if is { 0 } else { most }).collect();
    let mut edge: Vec<usize> = (0..singular.len()).filter(|&place| singular[place]).collect();
    for ring in 1..most {
        let mut next = Vec::new();
        for place in edge {
            for link in links.of(place) {
                let other = &mut rings[link.to as usize];
                if *other > ring {
                    *other = ring;
                    next.push(link.to as usize);
                }
            }
        }
        if next.is_empty() {
            break;
        }
        edge = next;
    }
    rings
}

fn smooth(at: f64) -> f64 {
    at * at * (3.0 - 2.0 * at)
}

/// A step of the spanning tree: it reaches a place from an earlier one, or begins a connected part
/// there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Step {
    pub(super) place: u32,
    pub(super) from: Option<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Candidate {
    reliability: f64,
    place: u32,
    from: u32,
}

impl Ord for Candidate {
    /// The tree takes the greatest first: the most reliable candidate, and among equals the lowest
    /// indices.
    fn cmp(&self, other: &Self) -> Ordering {
        self.reliability
            .total_cmp(&other.reliability)
            .then(other.place.cmp(&self.place))
            .then(other.from.cmp(&self.from))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// All places in the order in which the spanning tree of greatest reliability reaches them, grown
/// from the most reliable place of each connected part (Prim, "Shortest connection networks and
/// some generalizations", 1957; over surfaces: Hoppe et al., "Surface reconstruction from
/// unorganized points", 1992). If a part has places among `seeds`, it grows from all of these at
/// once. Ties go to the lower index.
pub(super) fn spanning_tree(
    links: &Links,
    of_place: &[f64],
    seeds: &[u32],
    of_link: impl Fn(usize, &Link) -> f64,
) -> Vec<Step> {
    let mut roots: Vec<u32> = (0..links.count() as u32).collect();
    roots.sort_unstable_by(|&a, &b| {
        of_place[b as usize].total_cmp(&of_place[a as usize]).then(a.cmp(&b))
    });
    let mut reached = vec![false; links.count()];
    let mut steps = Vec::with_capacity(links.count());
    let mut candidates = BinaryHeap::new();
    let mut reach = |step: Step, reached: &mut [bool], candidates: &mut BinaryHeap<Candidate>| {
        reached[step.place as usize] = true;
        steps.push(step);
        for link in links.of(step.place as usize) {
            if !reached[link.to as usize] {
                let reliability = of_link(step.place as usize, link);
                candidates.push(Candidate { reliability, place: link.to, from: step.place });
            }
        }
    };
    for &place in seeds {
        reach(Step { place, from: None }, &mut reached, &mut candidates);
    }
    for root in roots {
        while let Some(step) = unreached(&mut candidates, &reached) {
            reach(step, &mut reached, &mut candidates);
        }
        if !reached[root as usize] {
            reach(Step { place: root, from: None }, &mut reached, &mut candidates);
        }
    }
    while let Some(step) = unreached(&mut candidates, &reached) {
        reach(step, &mut reached, &mut candidates);
    }
    steps
}

fn unreached(candidates: &mut BinaryHeap<Candidate>, reached: &[bool]) -> Option<Step> {
    while let Some(Candidate { place, from, .. }) = candidates.pop() {
        if !reached[place as usize] {
            return Some(Step { place, from: Some(from) });
        }
    }
    None
}
