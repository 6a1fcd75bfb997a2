//! Composites Kubelka-Munk layers: the internal reflectance of painted cells.
//!
//! The layer equations in Baxter, Wendt and Lin 2004 (eq. 8 and 9) are misprinted. You find the
//! form with decaying exponentials at [`spectra::optics::Layer::new`]. With d = 1 over a backing
//! g, and rearranged so that it subtracts no nearly equal values and divides once, that form is:
//! ```text
//! x = sqrt(K (K + 2 S))   e = exp(-2 x)   n = S (1 - e)
//! den   = (K + S) (1 - e) + (1 + e) x
//! above = (K + S (1 - g)) (1 - e) + (1 + e) x      (den - n g)
//! R = (n above + 4 e x^2 g) / (den above)
//! ```
//!
//! Paint does not make a film of any thinness: hair and knife leave it in furrows and crumbs. Each
//! quantum covers a share of its cell ([`LayerOptics::covers`]). Where the shares of a cell sum to
//! less than 1, we show the paint as a thicker film that covers this part of the cell. So at the
//! edge of a dark mark you see the mark and the ground side by side, and not a film of some
//! thousandths of a mm with a chroma that no paint has. A skin levels on the body below it, so what
//! the body covers counts for the skin too.

use pulp::Simd;

use crate::layer::{FilmRow, Layer, SLOTS};
use crate::optics::{LayerOptics, NODES};
use graphics::lanes::{decay, greater, lesser, multiply_add};

/// Composites the cells of a layer from column `x` of row `y` over `backing`, in place: the body, then the skin.
///
/// # Panics
/// If the layer does not have these cells.
pub fn composite_layer_row(
    optics: &LayerOptics,
    layer: &Layer,
    (x, y): (usize, usize),
    backing: &mut [[f32; NODES]],
) {
    let body = layer.row(y, x, backing.len());
    composite_row(optics, body, None, backing);
    if let Some(skin) = &layer.skin {
        composite_row(optics, skin.row(y, x, backing.len()), Some(body), backing);
    }
}

/// Composites a film over a row of cells, in place. `backing` holds the internal reflectance below
/// the film and receives the reflectance of the result. `body` is the film of the same layer below a
/// skin. Vehicle is transparent.
///
/// Agrees within 5e-7 with f64 arithmetic for K d and S d of 0 to 1e4 and backings of 0
/// to 1. Results lie in 0 to 1. Cells without paint keep their backing bit for bit.
/// Slots that are empty over the whole row are skipped, which does not change the result, so
/// rows may be split anywhere.
///
/// # Panics
/// If the rows differ in length.
pub fn composite_row(
    layer: &LayerOptics,
    film: FilmRow<'_>,
    body: Option<FilmRow<'_>>,
    backing: &mut [[f32; NODES]],
) {
    let FilmRow { pigments, vehicle } = film;
    assert_eq!(pigments.len(), backing.len(), "each cell of paint needs a backing");
    let is_whole = vehicle.is_empty() || vehicle.len() == backing.len();
    assert!(is_whole, "each cell of paint needs its vehicle");
    let is_below = body.is_none_or(|body| body.pigments.len() == backing.len());
    assert!(is_below, "each cell of a skin needs its body");
    let mut any = [0; SLOTS];
    for amounts in pigments {
        for (any, amount) in any.iter_mut().zip(amounts) {
            *any |= amount;
        }
    }
    let mut slots = [0; SLOTS];
    let mut count = 0;
    for (slot, any) in any.into_iter().enumerate() {
        slots[count] = slot;
        count += usize::from(any != 0);
    }
    if count > 0 {
        let slots = &slots[..count];
        graphics::lanes::vectorized(CompositeRow { layer, slots, film, body, backing });
    }
}

struct CompositeRow<'a> {
    layer: &'a LayerOptics,
    /// Indices of the slots that are not empty.
    slots: &'a [usize],
    film: FilmRow<'a>,
    body: Option<FilmRow<'a>>,
    backing: &'a mut [[f32; NODES]],
}

impl pulp::WithSimd for CompositeRow<'_> {
    type Output = ();

    #[expect(
        clippy::needless_range_loop,
        reason = "with iterators the compiler does not vectorise: seven times slower"
    )]
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { layer, slots, film: FilmRow { pigments, vehicle }, body, backing } = self;
        let [of_pigments @ .., of_vehicle] = &layer.covers;
        for (cell, (amounts, backing)) in pigments.iter().zip(backing).enumerate() {
            let vehicle = vehicle.get(cell).copied().unwrap_or(0);
            let mut covered = of_vehicle * vehicle as f32;
            if let Some(FilmRow { pigments, vehicle }) = body {
                covered += of_vehicle * vehicle.get(cell).copied().unwrap_or(0) as f32;
                for (share, amount) in of_pigments.iter().zip(&pigments[cell]) {
                    covered += share * *amount as f32;
                }
            }
            let mut absorption = [0.0; NODES];
            let mut scattering = [0.0; NODES];
            for &slot in slots {
                let slot = slot % SLOTS;
                // A cell holds at most 2^31 quanta, and i32 converts faster than u32.
                let amount = amounts[slot].min(i32::MAX as u32) as i32 as f32;
                covered = multiply_add::<S>(amount, of_pigments[slot], covered);
                for i in 0..NODES {
                    let k = layer.absorption[slot][i];
                    absorption[i] = multiply_add::<S>(amount, k, absorption[i]);
                }
                for i in 0..NODES {
                    let s = layer.scattering[slot][i];
                    scattering[i] = multiply_add::<S>(amount, s, scattering[i]);
                }
            }
            if covered >= 1.0 || covered == 0.0 {
                for i in 0..NODES {
                    backing[i] = film::<S>(absorption[i], scattering[i], backing[i]);
                }
                continue;
            }
            let thickening = 1.0 / covered;
            for i in 0..NODES {
                let [k, s] = [thickening * absorption[i], thickening * scattering[i]];
                let bare = backing[i];
                backing[i] = multiply_add::<S>(covered, film::<S>(k, s, bare) - bare, bare);
            }
        }
    }
}

/// Minimum of x = alpha d. We compute thinner films with this x, which changes the reflectance by
/// about its square.
const MIN_X: f32 = 1e-5;

/// Internal reflectance of a film of unit thickness over `backing`.
#[inline(always)]
fn film<S: Simd>(absorption: f32, scattering: f32, backing: f32) -> f32 {
    let k = absorption;
    let s = scattering;
    let g = backing;
    let x = greater((k * multiply_add::<S>(2.0, s, k)).sqrt(), MIN_X);
    let (e, rest) = decay::<S>(2.0 * x);
    let through = multiply_add::<S>(e, x, x);
    let n = s * rest;
    let den = multiply_add::<S>(k + s, rest, through);
    let above = multiply_add::<S>(multiply_add::<S>(s, 1.0 - g, k), rest, through);
    let lit = 4.0 * e * x * x * g;
    let film = lesser(multiply_add::<S>(n, above, lit) / (den * above), 1.0);
    if k + s > 0.0 { film } else { g }
}

#[cfg(test)]
mod tests {
    use spectra::optics::Layer;

    use super::*;

    const GRID: [f32; 15] =
        [0.0, 1e-12, 1e-7, 1e-5, 1e-3, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 50.0, 300.0, 2000.0, 1e4];
    const BACKINGS: [f32; 8] = [0.0, 1e-4, 0.03, 0.2, 0.5, 0.8, 0.97, 1.0];

    /// A layer with two pigments. 16384 quanta of slot 0 absorb `k` and do not scatter, and 16384
    /// quanta of slot 1 scatter `s` and do not absorb.
    fn layer(k: f32, s: f32) -> LayerOptics {
        let mut layer = LayerOptics::EMPTY;
        layer.absorption[0] = [k / 16384.0; NODES];
        layer.scattering[1] = [s / 16384.0; NODES];
        layer
    }

    /// Composites films that are even however thin they are.
    fn even_films(layer: &LayerOptics, pigments: &[[u32; SLOTS]], backing: &mut [[f32; NODES]]) {
        composite_row(layer, FilmRow { pigments, vehicle: &[] }, None, backing);
    }

    /// A film of K d = `k` and S d = `s`, both times `parts` / 16384, over `backing`.
    fn over(k: f32, s: f32, parts: u32, backing: [f32; NODES]) -> [f32; NODES] {
        let mut row = [backing];
        even_films(&layer(k, s), &[[parts, parts, 0, 0, 0, 0, 0, 0]], &mut row);
        row[0]
    }

    #[test]
    fn films_agree_with_f64_arithmetic() {
        let mut worst = (0.0, (0.0, 0.0, 0.0));
        for k in GRID {
            for s in GRID {
                let found = over(k, s, 16384, BACKINGS);
                let exact = Layer::new(f64::from(k), f64::from(s), 1.0);
                for (found, backing) in found.into_iter().zip(BACKINGS) {
                    assert!((0.0..=1.0).contains(&found), "{k} {s} over {backing}: {found}");
                    let error = (f64::from(found) - exact.over(f64::from(backing))).abs();
                    if error > worst.0 {
                        worst = (error, (k, s, backing));
                    }
                }
            }
        }
        // Measured 2.0e-7 with fused multiplication.
        assert!(worst.0 < 5e-7, "{worst:?}");
    }

    #[test]
    fn a_layer_split_in_two_composites_to_the_same_reflectance() {
        for k in GRID {
            for s in GRID {
                let whole = over(k, s, 16384, BACKINGS);
                for lower in [1, 4000, 8192] {
                    let cut = over(k, s, 16384 - lower, over(k, s, lower, BACKINGS));
                    for (whole, cut) in whole.into_iter().zip(cut) {
                        assert!((whole - cut).abs() < 1e-6, "{k} {s} {lower}: {whole} {cut}");
                    }
                }
            }
        }
    }

    #[test]
    fn no_paint_keeps_the_backing_and_thick_paint_hides_it() {
        assert_eq!(over(1e4, 1e4, 0, BACKINGS), BACKINGS);
        // If we paint another cell of the row, this one does not change.
        let mut row = [BACKINGS, BACKINGS];
        even_films(&layer(1.0, 1.0), &[[0; SLOTS], [9, 9, 0, 0, 0, 0, 0, 0]], &mut row);
        assert_eq!(row[0], BACKINGS);
        assert_ne!(row[1], BACKINGS);
        for (k, s) in [(1.0, 2000.0), (50.0, 1.0), (1e4, 1e4)] {
            let seen = over(k, s, 16384, BACKINGS);
            let hiding = spectra::optics::infinite_film(f64::from(k), f64::from(s));
            for seen in seen {
                assert!((f64::from(seen) - hiding).abs() < 1e-6, "{k} {s}: {seen} {hiding}");
            }
        }
        // A full cell of a paint stronger than any in the libraries.
        for seen in over(2e-3 * 16384.0, 1e-3 * 16384.0, 1 << 31, BACKINGS) {
            assert!((0.0..0.5).contains(&seen), "{seen}");
        }
    }

    #[test]
    fn reflectance_falls_with_absorption_and_grows_with_scattering_and_backing() {
        for fixed in GRID {
            for pair in GRID.windows(2) {
                let [less, more] = [pair[0], pair[1]];
                let darker = over(more, fixed, 16384, BACKINGS);
                let lighter = over(less, fixed, 16384, BACKINGS);
                for (darker, lighter) in darker.into_iter().zip(lighter) {
                    assert!(darker <= lighter + 2e-7, "K {pair:?}, S {fixed}: {darker} {lighter}");
                }
                // Without a backing, where scattering can only add.
                let darker = over(fixed, less, 16384, [0.0; NODES])[0];
                let lighter = over(fixed, more, 16384, [0.0; NODES])[0];
                assert!(darker <= lighter + 2e-7, "S {pair:?}, K {fixed}: {darker} {lighter}");
            }
            for pair in over(0.5, fixed, 16384, BACKINGS).windows(2) {
                assert!(pair[0] <= pair[1] + 1e-7, "S {fixed}: {pair:?}");
            }
        }
    }

    #[test]
    fn slots_add_up() {
        let mut all = layer(0.0, 0.0);
        for slot in 0..SLOTS {
            all.absorption[slot] = std::array::from_fn(|i| (slot + i) as f32 * 1e-5);
            all.scattering[slot] = std::array::from_fn(|i| (slot * i + 1) as f32 * 1e-5);
        }
        let amounts: [u32; SLOTS] = [3000, 1, 70_000, 0, 12, 123_456, 9, 40_000];
        let mut row = [BACKINGS; 3];
        even_films(&all, &[[0; SLOTS], amounts, [0; SLOTS]], &mut row);
        for i in 0..NODES {
            let [k, s] = [&all.absorption, &all.scattering].map(|table| {
                let parts = amounts.iter().zip(table);
                parts.map(|(&a, row)| f64::from(a) * f64::from(row[i])).sum::<f64>()
            });
            let exact = Layer::new(k, s, 1.0).over(f64::from(BACKINGS[i]));
            assert!((f64::from(row[1][i]) - exact).abs() < 1e-6, "{i}: {} {exact}", row[1][i]);
        }
    }

    /// 4000 quanta, a quarter of which is vehicle, over `BACKINGS`.
    fn thin(covers: [f32; SLOTS + 1]) -> [f32; NODES] {
        let mut row = [BACKINGS];
        let layer = LayerOptics { covers, ..layer(9.0, 5.0) };
        let pigments = &[[1000, 1000, 1000, 0, 0, 0, 0, 0]];
        composite_row(&layer, FilmRow { pigments, vehicle: &[1000] }, None, &mut row);
        row[0]
    }

    #[test]
    fn thin_paint_covers_a_part_of_the_cell() {
        // What covers 1 or more is whole. Vehicle covers too.
        let whole = [2e-4, 3e-4, 4e-4, 0.0, 0.0, 0.0, 0.0, 0.0, 1.1e-4];
        assert_eq!(thin(whole), thin([1.0; SLOTS + 1]));
        for factor in [0.98, 0.5, 0.02] {
            let covered = f64::from(factor * 1.01);
            let height = 1000.0 / covered;
            let LayerOptics { absorption, scattering, .. } = layer(9.0, 5.0);
            let [k, s] =
                [absorption, scattering].map(|table| height * f64::from(table[0][0] + table[1][0]));
            let film = Layer::new(k, s, 1.0);
            let found = thin(whole.map(|share| factor * share));
            for (found, backing) in found.into_iter().zip(BACKINGS) {
                let bare = f64::from(backing);
                let wanted = bare + covered * (film.over(bare) - bare);
                let off = (f64::from(found) - wanted).abs();
                assert!(off < 2e-6, "{factor} over {bare}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn the_body_below_a_skin_counts_for_what_the_skin_covers() {
        let layer = LayerOptics { covers: [4e-4; SLOTS + 1], ..layer(9.0, 5.0) };
        let [thin, thick] = [500, 900].map(|parts| [[parts, parts, 0, 0, 0, 0, 0, 0]]);
        let [bare, less, more] = [None, Some(&thin), Some(&thick)].map(|body| {
            let mut row = [BACKINGS];
            let body = body.map(|pigments| FilmRow { pigments, vehicle: &[] });
            composite_row(&layer, FilmRow { pigments: &thin, vehicle: &[] }, body, &mut row);
            row[0]
        });
        let whole = LayerOptics { covers: [1.0; SLOTS + 1], ..layer };
        let mut even = [BACKINGS];
        even_films(&whole, &thin, &mut even);
        assert_eq!(more, even[0], "0.4 and 0.72 cover all");
        assert_ne!(bare, even[0], "0.4 covers a part");
        assert_ne!(less, even[0], "twice 0.4 covers a part");
    }
}
