//! Arrows from lines: a field along which things can move.

use glam::DVec3;

use super::field::DirectionField;
use super::links::Links;
use super::spanning_tree::spanning_tree;
use super::within::vector_within;
use crate::mesh::tangent_plane::carried;

/// Part of an arrow along an axis below which it does not decide the sign of a connected part.
const LEAST_PART: f64 = 1e-3;

/// Lines with signs: an arrow for every vertex, and a strength that fades to 0 where neighbours
/// disagree.
#[derive(Debug, Clone)]
pub struct FlowField {
    of_vertex: Vec<u32>,
    normals: Vec<DVec3>,
    /// Unit arrows at all places.
    arrows: Vec<DVec3>,
    /// Strength of the flow at all places, 0 to 1.
    strengths: Vec<f64>,
    singular: Vec<bool>,
}

impl DirectionField {
    /// Gives the lines signs along the spanning tree of greatest reliability, which grows from all
    /// places with a guide at once, so that flow runs along guides and not against them. Where signs cannot
    /// agree, around singular places and across the cuts that half turns force, vertices are
    /// marked as singular and the strength is 0; it rises to 1 over `fade_rings` rings of edges (2
    /// or 3 are usual; 0 leaves it at 1 beside singular vertices).
    #[must_use]
    pub fn oriented(&self, fade_rings: usize) -> FlowField {
        self.signed(self.arrows(), fade_rings)
    }

    /// Gives the lines the signs of arrows of any length, one for each vertex; 0 leaves a vertex
    /// without. A connected part takes those vertices' signs as [`Self::oriented`] does, turned over
    /// if most given arrows say so.
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
            let places = || order[part.clone()].iter().map(|&place| place as usize);
            let agreement: f64 = places().map(|place| arrows[place].dot(wanted[place])).sum();
            for place in places() {
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

    /// Unit arrows at all places, signed along the tree.
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

    /// Cosine of the angle between the arrows of two neighbours, carried along their link.
    fn cosine(&self, arrows: &[DVec3], place: usize, other: usize) -> f64 {
        let normal = |place: usize| self.planes[place].normal;
        let there = carried(arrows[other], normal(other), normal(place));
        there.map_or(0.0, |there| arrows[place].dot(there))
    }

    /// Whether the arrow of a neighbour differs by more than 90 degrees.
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

    /// Flow at a point inside a triangle with these corners, whose barycentric weights are not
    /// negative and add up to 1: a tangent vector whose length, 0 to 1, is the strength. It is
    /// continuous in the triangle and across its edges.
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

/// Whether the first arrow of a part points down, or if it is level to the left, or backwards.
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

/// Smoothstep over 0..1.
fn smooth(at: f64) -> f64 {
    at * at * (3.0 - 2.0 * at)
}
