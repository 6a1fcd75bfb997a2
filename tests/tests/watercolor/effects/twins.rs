//! Every kernel against its form on the processor.

use render::field::Field;
use render::watercolor::{
    Backend, ColorMask, ColorRange, Density, DensityLayer, DryBrush, DryBrushReach, Edges, OnCpu,
    OnGpu, OnSheet, Plane, Sheet, Wobble,
};
use spectra::color::Rgb;
use suite::adapter::device;
use suite::near::assert_near;

use super::{any_grey, any_picture, greys, numbers};

/// What f32 may be off where a backend fuses and another does not.
const NEAR: f64 = 2e-6;

/// Sizes on both sides of those of a work group and of a band of rows.
const SIZES: [(usize, usize); 6] = [(1, 1), (1, 9), (7, 5), (8, 8), (67, 33), (30, 71)];

struct Both {
    gpu: OnGpu,
    size: (usize, usize),
    picture: Field<[f32; 4]>,
    there: Plane,
}

impl Both {
    fn each(mut each: impl FnMut(&mut Self)) {
        let Some(device) = device() else { return };
        let mut gpu = OnGpu::new(device);
        for (seed, (width, height)) in (0..).zip(SIZES) {
            let picture = any_picture(width, height, seed);
            let there = gpu.color_of(&picture).unwrap();
            let mut both = Self { gpu, size: (width, height), picture, there };
            each(&mut both);
            gpu = both.gpu;
        }
    }

    fn grey(&mut self, seed: u64) -> (Field<f32>, Plane) {
        let grey = any_grey(self.size.0, self.size.1, seed);
        let there = self.gpu.grey_of(&grey).unwrap();
        (grey, there)
    }

    fn assert_alike(&mut self, case: &str, here: &Field<[f32; 4]>, there: &Plane, near: f64) {
        let there = self.gpu.color_field(there).unwrap();
        assert_near(format!("{case}, {:?}", self.size), &numbers(&there), &numbers(here), near);
    }
}

#[test]
fn density() {
    Both::each(|both| {
        let greys: Vec<_> = (0..6).map(|seed| both.grey(seed)).collect();
        for strengths in
            [&[][..], &[0.0], &[1.3], &[-2.0, 0.5, 9.0, 2.0], &[0.4, 1.0, -1.0, 3.0, 2.0]]
        {
            for (overall, masked) in [(1.0, false), (0.3, false), (2.5, true), (0.0, true)] {
                let mask = masked.then_some(&greys[5]);
                let layer = |i: usize| (strengths[i], [0.5, 0.0][i % 2]);
                let here: Vec<_> = (0..strengths.len())
                    .map(|i| (layer(i), &greys[i].0))
                    .map(|((strength, pivot), texture)| DensityLayer { texture, strength, pivot })
                    .collect();
                let there: Vec<_> = (0..strengths.len())
                    .map(|i| (layer(i), &greys[i].1))
                    .map(|((strength, pivot), texture)| DensityLayer { texture, strength, pivot })
                    .collect();
                let (picture, plane) = (both.picture.clone(), both.there.clone());
                let here = OnCpu.densified(picture, overall, &here, mask.map(|m| &m.0)).unwrap();
                let there = both.gpu.densified(plane, overall, &there, mask.map(|m| &m.1)).unwrap();
                let case = format!("{strengths:?}, {overall}, {masked}");
                // A strength of 9 lets what rounds grow.
                both.assert_alike(&case, &here, &there, 10.0 * NEAR);
            }
        }
    });
}

#[test]
fn edges() {
    Both::each(|both| {
        for width_px in [0.0, 0.1, 0.5, 1.0, 3.3, 12.0] {
            let here = OnCpu.edges(&both.picture, width_px).unwrap();
            let there = both.gpu.edges(&both.there, width_px).unwrap();
            let there = both.gpu.grey_field(&there).unwrap();
            let case = format!("{width_px} px, {:?}", both.size);
            assert_near(case, &greys(&there), &greys(&here), NEAR);
        }
    });
}

#[test]
fn wobble() {
    Both::each(|both| {
        let (heights, plane) = both.grey(11);
        for px in [0.0, 0.01, 0.8, -3.0, 500.0] {
            let here = OnCpu.wobbled(both.picture.clone(), &heights, px).unwrap();
            let there = both.gpu.wobbled(both.there.clone(), &plane, px).unwrap();
            // Where little paint is mixed in, its colour is a quotient of small numbers;
            // how far a place is off grows with the distance.
            let near = NEAR * (10.0 + 10.0 * f64::from(px.abs()));
            both.assert_alike(&format!("{px} px"), &here, &there, near);
        }
    });
}

#[test]
fn dry_brush() {
    Both::each(|both| {
        let ((heights, plane), (flow, flow_plane)) = (both.grey(12), both.grey(13));
        let mask = both.grey(14);
        for threshold in [0.0, 0.2, 0.9] {
            for (softness, patches, masked) in
                [(0.1, 0.0, false), (0.5, 0.6, true), (0.02, 1.0, true)]
            {
                let reach = DryBrushReach { threshold, softness, patches };
                let mask = masked.then_some(&mask);
                let (picture, there) = (both.picture.clone(), both.there.clone());
                let here =
                    OnCpu.dry_brushed(picture, &heights, &flow, reach, mask.map(|m| &m.0)).unwrap();
                let there = both
                    .gpu
                    .dry_brushed(there, &plane, &flow_plane, reach, mask.map(|m| &m.1))
                    .unwrap();
                // Over a narrow band what rounds grows by its inverse.
                let near = NEAR / f64::from(softness);
                both.assert_alike(&format!("{reach:?}"), &here, &there, near);
            }
        }
    });
}

#[test]
fn color_mask() {
    Both::each(|both| {
        let mask = both.grey(15);
        for (color, tolerance) in [("#ffffff", 30.0), ("#4060a0", 1.0), ("#000000", 200.0)] {
            for mask in [None, Some(&mask)] {
                let range = ColorRange::around(Rgb::from_hex(color).unwrap(), tolerance);
                let here = OnCpu.color_mask(&both.picture, range, mask.map(|m| &m.0)).unwrap();
                let there = both.gpu.color_mask(&both.there, range, mask.map(|m| &m.1)).unwrap();
                let there = both.gpu.grey_field(&there).unwrap();
                let case = format!("{color} {tolerance}, {:?}", both.size);
                // WGSL's pow is loose; by the tolerance CIELAB becomes a share.
                assert_near(case, &greys(&there), &greys(&here), 1e-3 / f64::from(tolerance));
            }
        }
    });
}

#[test]
fn sheet() {
    Both::each(|both| {
        let (heights, plane) = both.grey(16);
        for (color, relief) in [([1.0; 3], 0.0), ([0.9, 0.8, 0.6], 0.4), ([0.2, 1.0, 0.0], 5.0)] {
            let sheet = Sheet { color, relief };
            let here = OnCpu.on_sheet(both.picture.clone(), &heights, sheet).unwrap();
            let there = both.gpu.on_sheet(both.there.clone(), &plane, sheet).unwrap();
            both.assert_alike(&format!("{sheet:?}"), &here, &there, NEAR);
        }
    });
}
