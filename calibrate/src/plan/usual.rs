//! The design for paint of which nothing is known.

use super::palette::{Palette, PlanError};
use super::recipe::{Purpose, Recipe};

/// A design of `swatches` recipes of `pool`, the one of
/// [`super::candidates`], as indices in order of weight: masstones, then a tint
/// of every paint at 1:4, then one at 1:19 (or the weakest that can be
/// weighed), then a shade with black at 9:1, then each colour with its
/// neighbour 1:1, then what is left of the pool from the strong tints on.
///
/// The ratios come from the Van Gogh oils: let to choose two tints of one
/// pigment with zinc white, the optimal design took 4:1, 1:4 and 1:19 most often,
/// and shades of 4:1 and 9:1 with bone black. With masstones and the two tints
/// 11 of 17 pigments had a D-efficiency above 0.9; weak ones, which ask for 4:1,
/// had 0.56 to 0.72.
///
/// # Errors
/// [`PlanError::Swatches`] for fewer than there are unknowns a wavelength, or
/// more than the pool holds.
pub fn usual(palette: &Palette, pool: &[Recipe], swatches: usize) -> Result<Vec<usize>, PlanError> {
    let (least, most) = (palette.unknowns(), pool.len());
    if !(least..=most).contains(&swatches) {
        return Err(PlanError::Swatches { paints: palette.names.len(), least, most, swatches });
    }
    let mut design = rounds(palette, pool);
    let rest: Vec<usize> = (0..pool.len()).filter(|index| !design.contains(index)).collect();
    design.extend(rest);
    design.truncate(swatches);
    Ok(design)
}

/// How many swatches the usual design has where no number is asked for.
#[must_use]
pub fn usual_count(palette: &Palette, pool: &[Recipe]) -> usize {
    rounds(palette, pool).len().max(palette.unknowns()).min(pool.len())
}

fn rounds(palette: &Palette, pool: &[Recipe]) -> Vec<usize> {
    let weakest = pool
        .iter()
        .filter(|recipe| recipe.purpose == Purpose::Tint && recipe.total() <= 20)
        .map(Recipe::total)
        .max();
    let weakest = weakest.unwrap_or(5);
    let shade = |recipe: &Recipe| recipe.parts[0].1;
    let shades = pool.iter().filter(|r| r.purpose == Purpose::Shade && shade(r) <= 9);
    let strongest_shade = shades.map(shade).max();
    let colors: Vec<usize> = palette.colors().collect();
    // A ring of two would be one pair twice.
    let links = if colors.len() > 2 { colors.len() } else { colors.len().saturating_sub(1) };
    let ring: Vec<[usize; 2]> = (0..links)
        .map(|i| {
            let mut pair = [colors[i], colors[(i + 1) % colors.len()]];
            pair.sort_unstable();
            pair
        })
        .collect();
    let tint = |recipe: &Recipe, total: u32| {
        recipe.purpose == Purpose::Tint && recipe.parts[0].1 == 1 && recipe.total() == total
    };
    let linked = |recipe: &Recipe| {
        recipe.purpose == Purpose::Cross
            && recipe.total() == 2
            && ring.contains(&[recipe.parts[0].0, recipe.parts[1].0])
    };
    let wanted: [&dyn Fn(&Recipe) -> bool; 5] = [
        &|recipe| recipe.purpose == Purpose::Masstone,
        &|recipe| tint(recipe, 5),
        &|recipe| weakest > 5 && tint(recipe, weakest),
        &|recipe| recipe.purpose == Purpose::Shade && Some(shade(recipe)) == strongest_shade,
        &linked,
    ];
    let of_round = |wanted: &dyn Fn(&Recipe) -> bool| -> Vec<usize> {
        (0..pool.len()).filter(|&index| wanted(&pool[index])).collect()
    };
    wanted.into_iter().flat_map(of_round).collect()
}
