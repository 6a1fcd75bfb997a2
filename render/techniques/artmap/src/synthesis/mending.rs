//! Re-synthesis of texels at the seams of patches, after Lee and Yan (2005) as far as Yan and
//! others (2008, section 4.3) tell it: worst texels first, each once.

use graphics::field::Field;

use super::canvas::as_texel;
use super::level::{Level, difference};

/// Texels on either side of a seam that are synthesised anew.
const REACH: isize = 2;
/// Half the width of the neighbourhood that a texel has to fit.
const NEAR: isize = 3;

/// Synthesises the texels at seams anew. Candidates are the sources of the texels around,
/// shifted (k-coherence, Tong and others 2002); the one that fits its neighbourhood best is
/// taken.
pub(crate) fn mend(level: &Level, sources: &mut Field<[u16; 2]>) {
    let mut seams = seam_texels(level, sources);
    // Worst first; ties in the order of rows.
    seams.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let size = sources.width();
    for (_, index) in seams {
        let texel = (index % size, index / size);
        let mut candidates = Vec::new();
        for (i, j) in neighbourhood(NEAR) {
            let [x, y] = sources[shifted(texel, (i, j), size)].map(isize::try_from);
            let (Ok(x), Ok(y)) = (x, y) else { continue };
            let place = (x - i, y - j);
            if is_inside(level, place) && !candidates.contains(&place) {
                candidates.push(place);
            }
        }
        let misfit = |&place: &(isize, isize)| misfit(level, sources, texel, place);
        let mut best: Option<(f32, (isize, isize))> = None;
        for place in candidates {
            let found = misfit(&place);
            if best.is_none_or(|(least, _)| found < least) {
                best = Some((found, place));
            }
        }
        if let Some((_, (x, y))) = best {
            sources[texel] = [x as u16, y as u16];
        }
    }
}

/// Mean squared difference between the neighbourhood of a place in the sample and that of a texel
/// of the map.
fn misfit(
    level: &Level,
    sources: &Field<[u16; 2]>,
    texel: (usize, usize),
    place: (isize, isize),
) -> f32 {
    let mut sum = 0.0;
    let mut count = 0.0;
    for (i, j) in neighbourhood(NEAR) {
        let at = (place.0 + i, place.1 + j);
        if is_inside(level, at) {
            let there = as_texel(sources[shifted(texel, (i, j), sources.width())]);
            let here = (at.0 as usize, at.1 as usize);
            sum += difference(&level.look[here], &level.look[there]);
            count += 1.0;
        }
    }
    // Places at the border of the sample are judged by fewer texels; half of them must be there.
    if count < 25.0 { f32::INFINITY } else { sum / count }
}

/// Texels near a seam, each with the largest error of the seams around it.
fn seam_texels(level: &Level, sources: &Field<[u16; 2]>) -> Vec<(f32, usize)> {
    let size = sources.width();
    let mut worst = vec![-1.0_f32; size * size];
    for index in 0..size * size {
        let texel = (index % size, index / size);
        for step in [(1, 0), (0, 1)] {
            let next = shifted(texel, step, size);
            let [x, y] = sources[texel];
            let there = sources[next];
            let continued = [x.wrapping_add(step.0 as u16), y.wrapping_add(step.1 as u16)];
            if continued == there {
                continue;
            }
            let [x, y] = continued.map(|value| value as isize);
            let inside = |place| is_inside(level, place);
            let error = if inside((x, y)) {
                difference(&level.look[as_texel(continued)], &level.look[as_texel(there)])
            } else {
                0.0
            };
            for (i, j) in neighbourhood(REACH - 1) {
                let (x, y) = shifted(texel, (i, j), size);
                worst[y * size + x] = worst[y * size + x].max(error);
                let (x, y) = shifted(next, (i, j), size);
                worst[y * size + x] = worst[y * size + x].max(error);
            }
        }
    }
    let near = worst.into_iter().enumerate().filter(|(_, error)| *error >= 0.0);
    near.map(|(index, error)| (error, index)).collect()
}

fn neighbourhood(reach: isize) -> impl Iterator<Item = (isize, isize)> {
    (-reach..=reach).flat_map(move |j| (-reach..=reach).map(move |i| (i, j)))
}

fn shifted((x, y): (usize, usize), (i, j): (isize, isize), size: usize) -> (usize, usize) {
    let wrap = |value: usize, by: isize| (value as isize + by).rem_euclid(size as isize) as usize;
    (wrap(x, i), wrap(y, j))
}

fn is_inside(level: &Level, (x, y): (isize, isize)) -> bool {
    let width = level.mask.width() as isize;
    let height = level.mask.height() as isize;
    x >= 0 && y >= 0 && x < width && y < height && level.mask[(x as usize, y as usize)]
}
