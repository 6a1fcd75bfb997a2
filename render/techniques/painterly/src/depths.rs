//! Pass 1: the nearest splat before the mesh.
//!
//! Strokes reach beyond the outline of their surface. Where several surfaces do, the nearest one
//! shows, hidden by the mesh as any surface is.

use graphics::lanes::lesser;

use super::lists::SIDE;
use super::splat::StrokeSplat;
use super::square::Values;

/// How fast a splat recedes towards its end, in tolerances: its weight of 1/(1 + n) lies n times
/// this behind its plane. So no splat is nearest where it has no weight.
const BOWL: f32 = 0.1;

/// The depth at which a splat counts: its plane, bent back where its weight is low.
#[inline(always)]
pub(super) fn bowl(splat: &StrokeSplat, plane: &Values, weight: &Values) -> Values {
    let mut bowl = [[0.0; SIDE]; SIDE];
    let depth = BOWL * splat.tolerance;
    for row in 0..SIDE {
        for column in 0..SIDE {
            let weight = weight[row][column];
            let weight = if weight > 1e-6 { weight } else { 1e-6 };
            bowl[row][column] = plane[row][column] + depth * (1.0 / weight - 1.0);
        }
    }
    bowl
}

/// Brings the nearest depth forward to a splat's.
#[inline(always)]
pub(super) fn bring_forward(nearest: &mut Values, bowl: &Values) {
    for (nearest, bowl) in nearest.iter_mut().zip(bowl) {
        for (nearest, bowl) in nearest.iter_mut().zip(bowl) {
            *nearest = lesser(*nearest, *bowl);
        }
    }
}

/// Share, 0 to 1, with which a splat belongs to the nearest surface.
#[inline(always)]
pub(super) fn nearness(splat: &StrokeSplat, nearest: &Values, bowl: &Values) -> Values {
    let mut near = [[0.0; SIDE]; SIDE];
    let per_tolerance = 1.0 / splat.tolerance;
    for row in 0..SIDE {
        for column in 0..SIDE {
            let behind = (bowl[row][column] - nearest[row][column]) * per_tolerance;
            let share = lesser(2.0 - behind, 1.0);
            near[row][column] = if share > 0.0 { share } else { 0.0 };
        }
    }
    near
}

#[cfg(test)]
mod tests {
    use super::super::made_up::splat;
    use super::*;

    #[test]
    fn the_nearer_splat_hides_the_farther_where_it_has_weight() {
        let near = splat([4.0, 4.0], [6.0, 9.0], 0.0);
        let far = StrokeSplat { depth: 0.6, ..near };
        let mut weight = [[1.0; SIDE]; SIDE];
        weight[0][0] = 0.0;
        let flat = |depth: f32| [[depth; SIDE]; SIDE];
        let bowls = [
            bowl(&near, &flat(near.depth), &weight),
            bowl(&far, &flat(far.depth), &[[1.0; SIDE]; SIDE]),
        ];
        let mut nearest = flat(f32::INFINITY);
        bowls.iter().for_each(|bowl| bring_forward(&mut nearest, bowl));
        let shares = [nearness(&near, &nearest, &bowls[0]), nearness(&far, &nearest, &bowls[1])];
        assert_eq!((shares[0][3][3], shares[1][3][3]), (1.0, 0.0));
        assert_eq!((shares[0][0][0], shares[1][0][0]), (0.0, 1.0));
    }

    #[test]
    fn a_splat_recedes_without_a_step_as_its_weight_falls() {
        let own = splat([4.0, 4.0], [6.0, 9.0], 0.0);
        let mut last = 0.0;
        for step in 1..=1000 {
            let weight = [[step as f32 / 1000.0; SIDE]; SIDE];
            let bowl = bowl(&own, &[[0.5; SIDE]; SIDE], &weight);
            let near = nearness(&own, &[[0.5; SIDE]; SIDE], &bowl)[0][0];
            assert!(near >= last && near - last < 0.05, "{step}: {last} {near}");
            last = near;
        }
        assert_eq!(last, 1.0);
    }
}
