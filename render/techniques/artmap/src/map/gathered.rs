//! Channels of a map, gathered from its sample by the places that its texels show.

use graphics::field::Field;
use paint::layer::SLOTS;

use super::tile::Tile;
use crate::sample::{Sample, TexelPaint};

/// Texels on either side of a seam whose channels are blended.
const BLEND: isize = 1;

/// The tile that shows, at every texel, the texel of `sample` in `sources`. Where neighbouring
/// texels show places that are no neighbours in the sample, colour, paint and height are the means
/// of what the texels within one texel continue to; elsewhere they are those of the source.
pub(crate) fn tile(sample: &Sample, sources: &Field<[u16; 2]>) -> Tile {
    let size = sources.width();
    let shown: Vec<Vec<(usize, usize)>> = (0..size * size)
        .map(|index| continued(sample, sources, (index % size, index / size)))
        .collect();
    let field = |of: &dyn Fn((usize, usize)) -> f32| {
        shown
            .iter()
            .map(|places: &Vec<(usize, usize)>| {
                places.iter().map(|&place| of(place)).sum::<f32>() / places.len() as f32
            })
            .collect::<Vec<f32>>()
    };
    let [red, green, blue] = [0, 1, 2].map(|index| field(&|place| sample.color[place][index]));
    let color = (0..size * size).map(|at| [red[at], green[at], blue[at]]).collect();
    let paint = sample.paint.as_ref().map(|paint| {
        let mut gathered = vec![TexelPaint::default(); size * size];
        for slot in 0..SLOTS {
            let amounts = field(&|place| paint[place].pigments_mm[slot]);
            gathered.iter_mut().zip(amounts).for_each(|(texel, mm)| texel.pigments_mm[slot] = mm);
        }
        let vehicle = field(&|place| paint[place].vehicle_mm);
        gathered.iter_mut().zip(vehicle).for_each(|(texel, mm)| texel.vehicle_mm = mm);
        Field::from_values(size, size, gathered)
    });
    let height = sample.height_mm.as_ref();
    let height_mm =
        height.map(|height| Field::from_values(size, size, field(&|place| height[place])));
    Tile { color: Field::from_values(size, size, color), paint, height_mm }
}

/// Places of the sample that a texel shows: its source, and at a seam also what the texels around
/// it continue to. Without a seam that is the source alone.
fn continued(
    sample: &Sample,
    sources: &Field<[u16; 2]>,
    (x, y): (usize, usize),
) -> Vec<(usize, usize)> {
    let size = sources.width() as isize;
    let own = sources[(x, y)];
    let mut places = vec![(usize::from(own[0]), usize::from(own[1]))];
    for (i, j) in (-BLEND..=BLEND).flat_map(|j| (-BLEND..=BLEND).map(move |i| (i, j))) {
        let near = ((x as isize + i).rem_euclid(size), (y as isize + j).rem_euclid(size));
        let [u, v] = sources[(near.0 as usize, near.1 as usize)];
        let place = (u16::try_from(u as isize - i), u16::try_from(v as isize - j));
        let (Ok(u), Ok(v)) = place else { continue };
        let place = (usize::from(u), usize::from(v));
        let inside = place.0 < sample.mask.width() && place.1 < sample.mask.height();
        if [u, v] != own && inside && sample.mask[place] {
            places.push(place);
        }
    }
    places
}
