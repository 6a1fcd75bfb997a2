//! Nearest points among many: a k-d tree of few dimensions.

/// Coordinates of a point.
pub(crate) const DIMENSIONS: usize = 8;
/// Points of a leaf.
const LEAF: usize = 16;

/// A point in the space of the tree.
pub(crate) type Point = [f32; DIMENSIONS];

/// Points that are sorted for search.
#[derive(Debug, Clone)]
pub(crate) struct Nearest {
    points: Vec<Point>,
    /// Place of each sorted point in the list it came from.
    places: Vec<u32>,
    /// Splits of the ranges, in the order in which they are visited from the root.
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    first: u32,
    last: u32,
    /// Dimension of the split; `DIMENSIONS` for a leaf.
    dimension: u32,
    value: f32,
    /// Node of the points above the split; those below follow the node itself.
    above: u32,
}

impl Nearest {
    pub(crate) fn new(list: &[Point]) -> Self {
        let mut order: Vec<u32> = (0..list.len() as u32).collect();
        let mut nodes = Vec::new();
        split(list, &mut order, 0, &mut nodes);
        let points = order.iter().map(|&place| list[place as usize]).collect();
        Self { points, places: order, nodes }
    }

    /// Places and squared distances of the `K` nearest points, the nearest first; ties by place. Fewer
    /// points leave places of `u32::MAX`.
    pub(crate) fn find<const K: usize>(&self, point: &Point) -> [(f32, u32); K] {
        let mut best = [(f32::INFINITY, u32::MAX); K];
        if !self.nodes.is_empty() {
            self.visit(0, point, 0.0, &mut [0.0; DIMENSIONS], &mut best);
        }
        best
    }

    fn visit<const K: usize>(
        &self,
        node: usize,
        point: &Point,
        outside: f32,
        offsets: &mut Point,
        best: &mut [(f32, u32); K],
    ) {
        let Node { first, last, dimension, value, above } = self.nodes[node];
        let dimension = dimension as usize;
        if dimension == DIMENSIONS {
            let range = first as usize..last as usize;
            for (other, &place) in self.points[range.clone()].iter().zip(&self.places[range]) {
                let mut found = (distance(point, other), place);
                // NaN is near nothing.
                let is_near = found < best[K - 1];
                if !is_near {
                    continue;
                }
                for slot in best.iter_mut() {
                    if found < *slot {
                        std::mem::swap(slot, &mut found);
                    }
                }
            }
            return;
        }
        let offset = point[dimension] - value;
        let (near, far) =
            if offset < 0.0 { (node + 1, above as usize) } else { (above as usize, node + 1) };
        self.visit(near, point, outside, offsets, best);
        let before = offsets[dimension];
        let beyond = outside - before * before + offset * offset;
        // Rounding must not hide a point at the same distance.
        if beyond * 0.9999 <= best[K - 1].0 {
            offsets[dimension] = offset;
            self.visit(far, point, beyond, offsets, best);
            offsets[dimension] = before;
        }
    }
}

fn distance(a: &Point, b: &Point) -> f32 {
    let d: Point = std::array::from_fn(|i| (a[i] - b[i]) * (a[i] - b[i]));
    ((d[0] + d[4]) + (d[1] + d[5])) + ((d[2] + d[6]) + (d[3] + d[7]))
}

/// Sorts `order`, a part of the list that begins at `start`, into a tree along the widest dimensions.
fn split(list: &[Point], order: &mut [u32], start: usize, nodes: &mut Vec<Node>) {
    let node = nodes.len();
    let range = (start as u32, (start + order.len()) as u32);
    let leaf = DIMENSIONS as u32;
    nodes.push(Node { first: range.0, last: range.1, dimension: leaf, value: 0.0, above: 0 });
    let spread = |dimension: usize| {
        let values = order.iter().map(|&place| list[place as usize][dimension]);
        let ends = values
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        ends.1 - ends.0
    };
    let dimension = (0..DIMENSIONS)
        .reduce(|a: usize, b: usize| if spread(b) > spread(a) { b } else { a })
        .unwrap_or(0);
    let differs = spread(dimension) > 0.0;
    if order.len() <= LEAF || !differs {
        return;
    }
    let middle = order.len() / 2;
    let value = |place: &u32| list[*place as usize][dimension];
    order.select_nth_unstable_by(middle, |a, b| value(a).total_cmp(&value(b)).then(a.cmp(b)));
    let at = value(&order[middle]);
    // Each range is sorted by place, so that the tree does not depend on the way of selecting.
    let (below, above) = order.split_at_mut(middle);
    below.sort_unstable();
    above.sort_unstable();
    split(list, below, start, nodes);
    nodes[node].dimension = dimension as u32;
    nodes[node].value = at;
    nodes[node].above = nodes.len() as u32;
    split(list, above, start + middle, nodes);
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn the_tree_finds_what_a_search_of_all_points_finds() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut point =
            || -> Point { std::array::from_fn(|i| random.random::<f32>() / (1 + i) as f32) };
        let mut list: Vec<Point> = (0..3000).map(|_| point()).collect();
        list.extend_from_slice(&list.clone()[..50]);
        let tree = Nearest::new(&list);
        for _ in 0..200 {
            let wanted = point();
            let mut all: Vec<(f32, u32)> =
                list.iter().zip(0..).map(|(p, place)| (distance(&wanted, p), place)).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            assert_eq!(tree.find::<4>(&wanted).as_slice(), &all[..4]);
        }
    }

    #[test]
    fn few_or_equal_points_are_found() {
        assert_eq!(Nearest::new(&[]).find::<2>(&[0.0; 8])[0].1, u32::MAX);
        let tree = Nearest::new(&[[1.0; 8]; 40]);
        let found = tree.find::<3>(&[0.0; 8]);
        assert_eq!(found.map(|(_, place)| place), [0, 1, 2]);
        assert_eq!(Nearest::new(&[[1.0; 8]]).find::<2>(&[0.0; 8])[1].1, u32::MAX);
    }
}
