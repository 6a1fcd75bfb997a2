//! Every effect on the GPU against its CPU implementation.

use graphics::compute::Compute;
use graphics::field::Field;
use spectra::color::Rgb;
use suite::adapter::device;
use suite::near::assert_near;
use watercolor::{ColorRange, DryBrushReach, PaperShading};

use super::on_fields::{
    Layer, apply_density, apply_dry_brush, color_mask, edges, shade_paper, wobble,
};
use super::{any_grey, any_picture, greys, numbers};

/// Tolerance for f32 where only one of the two backends uses fused multiply-add.
const NEAR: f64 = 2e-6;

/// Sizes of pictures, below and above those of a workgroup and of a band of rows.
const SIZES: [(usize, usize); 6] = [(1, 1), (1, 9), (7, 5), (8, 8), (67, 33), (30, 71)];

/// Both backends, and a picture of one of the [`SIZES`].
struct Both {
    cpu: Compute,
    gpu: Compute,
    size: (usize, usize),
    picture: Field<[f32; 4]>,
}

impl Both {
    fn for_each(mut each: impl FnMut(&mut Self)) {
        let Some(device) = device() else { return };
        let picture = any_picture(1, 1, 0);
        let cpu = Compute::cpu();
        let gpu = Compute::gpu(device);
        let mut both = Self { cpu, gpu, size: (1, 1), picture };
        for (seed, (width, height)) in (0..).zip(SIZES) {
            (both.size, both.picture) = ((width, height), any_picture(width, height, seed));
            each(&mut both);
        }
    }

    fn grey(&self, seed: u64) -> Field<f32> {
        any_grey(self.size.0, self.size.1, seed)
    }

    /// Asserts that both backends compute the same picture within `near`.
    fn compare(
        &mut self,
        case: &str,
        near: f64,
        effect: impl Fn(&mut Compute, &Field<[f32; 4]>) -> Field<[f32; 4]>,
    ) {
        let wanted = effect(&mut self.cpu, &self.picture);
        let found = effect(&mut self.gpu, &self.picture);
        assert_near(format!("{case}, {:?}", self.size), &numbers(&found), &numbers(&wanted), near);
    }

    /// Asserts that both backends compute the same grey values within `near`.
    fn compare_greys(
        &mut self,
        case: &str,
        near: f64,
        effect: impl Fn(&mut Compute, &Field<[f32; 4]>) -> Field<f32>,
    ) {
        let wanted = effect(&mut self.cpu, &self.picture);
        let found = effect(&mut self.gpu, &self.picture);
        assert_near(format!("{case}, {:?}", self.size), &greys(&found), &greys(&wanted), near);
    }
}

#[test]
fn density_agrees() {
    Both::for_each(|both| {
        let textures: Vec<_> = (0..6).map(|seed| both.grey(seed)).collect();
        for strengths in
            [&[][..], &[0.0], &[1.3], &[-2.0, 0.5, 9.0, 2.0], &[0.4, 1.0, -1.0, 3.0, 2.0]]
        {
            for (overall, masked) in [(1.0, false), (0.3, false), (2.5, true), (0.0, true)] {
                let mask = masked.then_some(&textures[5]);
                let layers: Vec<Layer<'_>> = (0..strengths.len())
                    .map(|i| (&textures[i], strengths[i], [0.5, 0.0][i % 2]))
                    .collect();
                let case = format!("{strengths:?}, {overall}, {masked}");
                // A strength of 9 enlarges rounding errors.
                both.compare(&case, 10.0 * NEAR, |compute, picture| {
                    apply_density(compute, picture, overall, &layers, mask)
                });
            }
        }
    });
}

#[test]
fn edges_agree() {
    Both::for_each(|both| {
        for width_px in [0.0, 0.1, 0.5, 1.0, 3.3, 12.0] {
            let case = format!("{width_px} px");
            both.compare_greys(&case, NEAR, |compute, picture| edges(compute, picture, width_px));
        }
    });
}

#[test]
fn wobble_agrees() {
    Both::for_each(|both| {
        let heights = both.grey(11);
        for px in [0.0_f32, 0.01, 0.8, -3.0, 500.0] {
            // At low coverage the colour is a quotient of small numbers; the error of a position
            // grows with the displacement.
            let near = NEAR * (10.0 + 10.0 * f64::from(px.abs()));
            both.compare(&format!("{px} px"), near, |compute, picture| {
                wobble(compute, picture, &heights, px)
            });
        }
    });
}

#[test]
fn wobble_on_finer_paper_agrees() {
    Both::for_each(|both| {
        let (width, height) = both.size;
        for factor in [2, 5] {
            let heights = any_grey(width * factor, height * factor, 22);
            for px in [0.3_f32, -4.0] {
                let near = NEAR * (10.0 + 10.0 * f64::from(px.abs()));
                both.compare(&format!("{factor} cells, {px} px"), near, |compute, picture| {
                    wobble(compute, picture, &heights, px)
                });
            }
        }
    });
}

#[test]
fn dry_brush_agrees() {
    Both::for_each(|both| {
        let heights = both.grey(12);
        let flow = both.grey(13);
        let mask = both.grey(14);
        let edges = both.grey(21);
        for threshold in [0.0, 0.2, 0.9] {
            for (softness, patches, masked, outline, darkest) in [
                (0.1, 0.0, false, 0.0, 0.0),
                (0.5, 0.6, true, 2.0, 0.0),
                (0.02, 1.0, true, 0.0, 0.3),
                (0.2, 0.0, false, 1.5, 0.4),
            ] {
                let reach = DryBrushReach { threshold, softness, patches, outline, darkest };
                let mask = masked.then_some(&mask);
                let edges = (outline > 0.0).then_some(&edges);
                // Rounding errors grow with the inverse of the softness.
                let near = 4.0 * NEAR / f64::from(softness);
                both.compare(&format!("{reach:?}"), near, |compute, picture| {
                    apply_dry_brush(compute, picture, (&heights, &flow), reach, (edges, mask))
                });
            }
        }
    });
}

#[test]
fn color_mask_agrees() {
    Both::for_each(|both| {
        let mask = both.grey(15);
        for (color, tolerance) in [("#ffffff", 30.0), ("#4060a0", 1.0), ("#000000", 200.0)] {
            for mask in [None, Some(&mask)] {
                let range = ColorRange::around(Rgb::from_hex(color).unwrap(), tolerance);
                // `pow` of WGSL is inexact; the mask divides errors in CIELAB by its tolerance.
                let near = 1e-3 / f64::from(tolerance);
                both.compare_greys(&format!("{color} {tolerance}"), near, |compute, picture| {
                    color_mask(compute, picture, range, mask)
                });
            }
        }
    });
}

#[test]
fn paper_shading_agrees() {
    Both::for_each(|both| {
        let heights = both.grey(16);
        for (color, relief) in [([1.0; 3], 0.0), ([0.9, 0.8, 0.6], 0.4), ([0.2, 1.0, 0.0], 5.0)] {
            let shading = PaperShading { color, relief };
            both.compare(&format!("{shading:?}"), NEAR, |compute, picture| {
                shade_paper(compute, picture, &heights, shading)
            });
        }
    });
}
