//! Places that continue what the coarser level or neighbouring patches show.

use graphics::field::Field;

use super::canvas::SourceCanvas;
use super::descriptors::Descriptors;

/// A finished level of a map.
#[derive(Debug, Clone)]
pub(crate) struct LevelMap {
    /// Texel of the sample's level that each texel of the map shows.
    pub(crate) sources: Field<[u16; 2]>,
    /// Place of the patch of each cell of the grid.
    pub(crate) places: Vec<[u16; 2]>,
}

/// Place from which a patch shows, `into` texels into it, what the coarser level shows at a texel
/// of the map.
pub(crate) fn from_coarser(
    coarser: &LevelMap,
    texel: (usize, usize),
    into: [usize; 2],
) -> [isize; 2] {
    let last = coarser.sources.width() - 1;
    let [x, y] = coarser.sources[((texel.0 / 2).min(last), (texel.1 / 2).min(last))];
    let fine = |coarse: u16, texel: usize, into: usize| {
        2 * coarse as isize + (texel % 2) as isize - into as isize
    };
    [fine(x, texel.0, into[0]), fine(y, texel.1, into[1])]
}

/// Places of the sample within `reach` texels of `middle`.
pub(crate) fn around(
    middle: [isize; 2],
    reach: isize,
    described: &Descriptors,
) -> impl Iterator<Item = [u16; 2]> + '_ {
    (-reach..=reach)
        .flat_map(move |j| (-reach..=reach).map(move |i| [middle[0] + i, middle[1] + j]))
        .filter_map(|place| existing(place, described))
}

/// A place as whole numbers, if a patch of the sample starts there.
pub(crate) fn existing(place: [isize; 2], described: &Descriptors) -> Option<[u16; 2]> {
    let [x, y] = place.map(u16::try_from);
    let place = [x.ok()?, y.ok()?];
    described.at(place).map(|_| place)
}

/// Places that continue the patches to the left of and above a cell.
pub(crate) fn continuations(
    canvas: &SourceCanvas<'_>,
    places: &[[u16; 2]],
    [column, row]: [usize; 2],
    described: &Descriptors,
) -> Vec<[u16; 2]> {
    let grid = canvas.grid;
    let step = |index: usize| (grid.origin(index) - grid.origin(index - 1)) as isize;
    let of = |column: usize, row: usize| places[row * grid.count + column].map(|at| at as isize);
    let mut found = Vec::new();
    if column > 0 {
        let [x, y] = of(column - 1, row);
        found.extend(existing([x + step(column), y], described));
    }
    if row > 0 {
        let [x, y] = of(column, row - 1);
        found.extend(existing([x, y + step(row)], described));
    }
    found
}
