//! The two wet films of a cell: a body, and a skin that a brush laid over it.
//!
//! A brush that lays paint where there was wet paint before the stroke lays it on the skin. So a light
//! over wet dark stays light. With each mm of its way, the hair stirs skin and body into each other. It
//! takes paint from the skin first. Layers of wet paint that exchange with the brush and with each other:
//! Stuyck, Da, Hadap and Dutre 2017; Chu, Baxter, Wei and Govindaraju 2010, section 4.
//!
//! A cell has no third film. When a stroke begins, we settle the films of the tiles that it reaches
//! ([`settling`]). A skin over bare ground, or over a body of the same mixture, becomes body. You do not
//! see this. Of any other skin the upper [`SKIN_MM`] stay and the rest becomes body. You do not see this
//! either if the part that stays hides the body. The stroke then lays its paint into the skin that stayed.

use crate::amount::{ratio_of_65536, share_of_256, share_of_65536};
use crate::contact::{ExchangeRates, Touch};
use crate::layer::Cell;

/// Height in mm of the skin that stays apart from the body when a stroke begins: about as much as most
/// paint needs to hide (chosen by eye).
pub const SKIN_MM: f64 = 0.06;

/// Largest sum of differences between the shares of two mixtures that count as one, in parts of 65536.
const ALIKE: u32 = 65536 / 32;

/// Share of the skin that joins the body when a stroke begins, in parts of 65536. `most` is the height of
/// the skin that stays, in quanta.
#[inline(always)]
#[must_use]
pub fn settling(body: &Cell, skin: &Cell, most: u32) -> u32 {
    let below = body.volume();
    let above = skin.volume();
    if below == 0 || alike(body, skin, (below, above)) {
        return 65536;
    }
    ratio_of_65536(above.saturating_sub(most), above)
}

/// Whether two mixtures with these volumes look alike.
#[inline(always)]
fn alike(a: &Cell, b: &Cell, (whole_a, whole_b): (u32, u32)) -> bool {
    let mut difference = 0;
    for (a, b) in a.pigments.iter().zip(&b.pigments) {
        difference += ratio_of_65536(*a, whole_a).abs_diff(ratio_of_65536(*b, whole_b));
    }
    difference += ratio_of_65536(a.vehicle, whole_a).abs_diff(ratio_of_65536(b.vehicle, whole_b));
    difference <= ALIKE
}

/// Shares of the body and of the skin, in parts of 65536, that the hair stirs into each other in a
/// sub-step. Both are the same amount. `penetration` is the depth in quanta that the hair has reached,
/// `body` and `skin` are the volumes of the films.
#[inline(always)]
#[must_use]
pub fn stirred(
    rates: &ExchangeRates,
    touch: Touch,
    penetration: i32,
    body: u32,
    skin: u32,
) -> [u32; 2] {
    let reached = (penetration.max(0) as u32).saturating_sub(skin).min(body);
    let moved = share_of_65536(reached.min(skin), rates.shear);
    let moved = share_of_256(moved, touch.transfer_weight());
    [ratio_of_65536(moved, body), ratio_of_65536(moved, skin)]
}

/// Shares of the body and of the skin that dry, in parts of 65536, if `share` of a column dries: from the
/// bottom, so the body first. `body` and `skin` are the volumes of the films.
#[inline(always)]
#[must_use]
pub fn drying(share: u32, body: u32, skin: u32) -> [u32; 2] {
    if skin == 0 || share == 65536 {
        return [share; 2];
    }
    let dries = share_of_65536(body + skin, share);
    if dries < body {
        return [ratio_of_65536(dries, body), 0];
    }
    [65536, ratio_of_65536(dries - body, skin)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(slot: usize, amount: u32) -> Cell {
        let mut cell = Cell::default();
        cell.pigments[slot] = amount;
        cell
    }

    #[test]
    fn skins_join_bodies_where_it_does_not_show() {
        let red = cell(0, 300_000);
        let white = cell(1, 300_000);
        assert_eq!(settling(&Cell::default(), &white, 100_000), 65536, "over bare ground");
        assert_eq!(settling(&cell(1, 7_000_000), &white, 100_000), 65536, "the same paint");
        let nearly = white.plus(&cell(0, 2000));
        assert_eq!(settling(&cell(1, 7_000_000), &nearly, 100_000), 65536, "nearly the same");
        let share = settling(&red, &white, 100_000);
        let left = 300_000 - share_of_65536(300_000, share);
        assert!(left.abs_diff(100_000) < 50, "{left} stay");
        assert_eq!(settling(&red, &white, 300_000), 0, "a thin skin");
    }

    #[test]
    fn the_body_dries_before_the_skin() {
        assert_eq!(drying(20_000, 500, 0), [20_000; 2], "one film");
        assert_eq!(drying(65536, 500, 300), [65536; 2], "all");
        assert_eq!(drying(16384, 600, 200), [21845, 0], "200 of 800");
        assert_eq!(drying(57344, 600, 200), [65536, 32768], "700 of 800");
    }

    #[test]
    fn hair_stirs_equal_amounts_as_deep_as_it_reaches() {
        let rates = ExchangeRates { shear: 6000, ..ExchangeRates::default() };
        let touch = Touch::new(0, 0, (0, 0), 256, 1);
        let amounts = |penetration: i32, body: u32, skin: u32| {
            let [of_body, of_skin] = stirred(&rates, touch, penetration, body, skin);
            [share_of_65536(body, of_body), share_of_65536(skin, of_skin)]
        };
        let [down, up] = amounts(900_000, 800_000, 300_000);
        let wanted = share_of_65536(300_000, 6000);
        assert!(down.abs_diff(wanted) < 200 && up.abs_diff(wanted) < 200, "{down} {up} {wanted}");
        assert_eq!(amounts(300_000, 800_000, 300_000), [0, 0], "only the skin is reached");
        assert_eq!(amounts(i32::MIN, 800_000, 300_000), [0, 0], "no contact");
        assert_eq!(amounts(900_000, 800_000, 0), [0, 0], "no skin");
    }
}
