//! The design for paints whose K and S are unknown.

use super::error::PlanError;
use super::paints::PaintSet;
use super::swatch_recipe::{Purpose, SwatchRecipe};
use pigment::PigmentId;

/// Total parts of the first tint, 1:4.
const FIRST_TINT: u32 = 5;
/// Greatest total of parts of the second tint, 1:19.
const SECOND_TINT: u32 = 20;
/// Most parts of the colour to one part of black in a shade.
const SHADE: u32 = 9;

/// Selects `swatches` recipes of `pool`, which comes from [`super::candidates`], as indices into it. The
/// order is: masstones; a tint of every paint at 1:4; one at 1:19 (or the weakest that can be weighed); a
/// shade of every colour with black at 9:1; each colour mixed 1:1 with the next; then the rest of the pool in
/// its order, the strongest tints first.
///
/// The ratios were measured on the Van Gogh oils. Of two tints of one pigment with zinc white, the optimal
/// design most often contained 4:1, 1:4 and 1:19, and of shades with bone black 4:1 and 9:1. With masstones
/// and the two tints, 11 of 17 pigments had a D-efficiency above 0.9; weak ones, for which 4:1 is better,
/// had 0.56 to 0.72.
///
/// # Errors
/// [`PlanError::Swatches`] for fewer swatches than unknowns per wavelength, or more than the pool holds.
pub fn usual(
    paints: &PaintSet,
    pool: &[SwatchRecipe],
    swatches: usize,
) -> Result<Vec<usize>, PlanError> {
    let least = paints.unknowns();
    let most = pool.len();
    if !(least..=most).contains(&swatches) {
        return Err(PlanError::Swatches { paints: paints.names.len(), least, most, swatches });
    }
    let mut design = rounds(paints, pool);
    let rest: Vec<usize> = (0..pool.len()).filter(|index| !design.contains(index)).collect();
    design.extend(rest);
    design.truncate(swatches);
    Ok(design)
}

/// Number of swatches of the usual design where no number is requested.
#[must_use]
pub fn usual_count(paints: &PaintSet, pool: &[SwatchRecipe]) -> usize {
    rounds(paints, pool).len().max(paints.unknowns()).min(pool.len())
}

/// Indices of the recipes that come before the rest of the pool, in order.
fn rounds(paints: &PaintSet, pool: &[SwatchRecipe]) -> Vec<usize> {
    let weakest = pool
        .iter()
        .filter(|recipe| recipe.purpose == Purpose::Tint && recipe.total() <= SECOND_TINT)
        .map(SwatchRecipe::total)
        .max();
    let weakest = weakest.unwrap_or(FIRST_TINT);
    let shade = |recipe: &SwatchRecipe| recipe.parts[0].1;
    let shades = pool.iter().filter(|r| r.purpose == Purpose::Shade && shade(r) <= SHADE);
    let strongest_shade = shades.map(shade).max();
    let colors: Vec<PigmentId> = paints.colors().collect();
    // With two colours, a closed ring would contain their pair twice.
    let links = if colors.len() > 2 { colors.len() } else { colors.len().saturating_sub(1) };
    let ring: Vec<[PigmentId; 2]> = (0..links)
        .map(|i| {
            let mut pair = [colors[i], colors[(i + 1) % colors.len()]];
            pair.sort_unstable();
            pair
        })
        .collect();
    let tint = |recipe: &SwatchRecipe, total: u32| {
        recipe.purpose == Purpose::Tint && recipe.parts[0].1 == 1 && recipe.total() == total
    };
    let linked = |recipe: &SwatchRecipe| {
        recipe.purpose == Purpose::Cross
            && recipe.total() == 2
            && ring.contains(&[recipe.parts[0].0, recipe.parts[1].0])
    };
    let rounds: [&dyn Fn(&SwatchRecipe) -> bool; 5] = [
        &|recipe| recipe.purpose == Purpose::Masstone,
        &|recipe| tint(recipe, FIRST_TINT),
        &|recipe| weakest > FIRST_TINT && tint(recipe, weakest),
        &|recipe| recipe.purpose == Purpose::Shade && Some(shade(recipe)) == strongest_shade,
        &linked,
    ];
    rounds
        .into_iter()
        .flat_map(|selects: &dyn Fn(&SwatchRecipe) -> bool| -> Vec<usize> {
            (0..pool.len()).filter(|&index| selects(&pool[index])).collect()
        })
        .collect()
}
