//! Tests of composing: exactness, order, samples, paper, and the twin on a device.

use super::*;
use crate::test_device::{device, far};

fn field<T>(width: usize, height: usize, value: impl Fn(usize, usize) -> T) -> Field<T> {
    Field::from_values(
        width,
        height,
        (0..width * height).map(|i: usize| value(i % width, i / width)).collect(),
    )
}

/// Colours without a pattern that repeats soon.
fn shaded(width: usize, height: usize) -> Field<[f32; 4]> {
    field(width, height, |x, y| {
        let share = |step: usize| ((x * step + y * 17) % 101) as f32 / 101.0;
        [share(3), share(29), share(47), share(61)]
    })
}

/// Surfaces but for a band of columns.
fn visible(width: usize, height: usize) -> VisibilityBuffer {
    field(width, height, |x, _| match x % 5 {
        4 => Fragment::EMPTY,
        _ => Fragment { triangle: 0, ..Fragment::EMPTY },
    })
}

fn counts(width: usize, height: usize, step: usize) -> Field<i32> {
    field(width, height, |x, y| ((x * step + y) % 7) as i32 - 1)
}

fn region(counts: Field<i32>, tints: &[f32], inside: Inside) -> Region {
    let table = TintTable::new(tints.to_vec()).unwrap();
    Region { counts: counts.into(), table, inside, stain: Region::UNSTAINED }
}

fn picture(size: (usize, usize), regions: &[Region], paper: Option<[f32; 3]>) -> Field<[f32; 4]> {
    let (width, height) = size;
    let shaded = shaded(width, height).into();
    let visible = visible(width, height).into();
    let picture = reveal(&mut Compute::cpu(), &shaded, &visible, regions, paper, 1);
    picture.unwrap().into_host()
}

#[test]
fn outside_is_grey_to_the_bit_and_inside_is_the_colour_to_the_bit() {
    let size = (67, 33);
    let counts = field(67, 33, |x, _| i32::from(x >= 30));
    let hard = region(counts, &[0.0, 1.0], Inside::OwnColors);
    let found = picture(size, &[hard], Some([1.0; 3]));
    let none = picture(size, &[], Some([1.0; 3]));
    let shaded = shaded(67, 33);
    let visible = visible(67, 33);
    for y in 0..33 {
        for x in 0..67 {
            let [r, g, b, grey] = shaded[(x, y)];
            let bare = visible[(x, y)].triangle == NO_TRIANGLE;
            let color = if x >= 30 { [r, g, b, 1.0] } else { [grey, grey, grey, 1.0] };
            assert_eq!(found[(x, y)], if bare { [1.0; 4] } else { color }, "{x} {y}");
            let grey = if bare { [1.0; 4] } else { [grey, grey, grey, 1.0] };
            assert_eq!(none[(x, y)], grey, "{x} {y}");
        }
    }
}

#[test]
fn full_tint_everywhere_is_the_plain_colour_picture() {
    let counts = Field::filled(67, 33, 3);
    let all = region(counts, &[0.0, 0.3, 1.0], Inside::OwnColors);
    let found = picture((67, 33), &[all], None);
    for ((found, shaded), visible) in
        found.values().iter().zip(shaded(67, 33).values()).zip(visible(67, 33).values())
    {
        match visible.triangle == NO_TRIANGLE {
            true => assert_eq!(*found, [1.0, 1.0, 1.0, 0.0]),
            false => assert_eq!(*found, [shaded[0], shaded[1], shaded[2], 1.0]),
        }
    }
}

#[test]
fn later_regions_lie_over_earlier_ones() {
    let everywhere = |tints: &[f32], color: [f32; 3]| {
        let inside = field(5, 1, |_, _| [color[0], color[1], color[2], 0.0]).into();
        region(Field::filled(5, 1, 1), tints, Inside::Picture(inside))
    };
    let red = [0.9, 0.1, 0.1];
    let blue = [0.1, 0.2, 0.8];
    let over = |first: Region, second: Region| picture((5, 1), &[first, second], None)[(0, 0)];
    let found = over(everywhere(&[0.0, 1.0], red), everywhere(&[0.0, 1.0], blue));
    assert_eq!(found, [0.1, 0.2, 0.8, 1.0]);
    let found = over(everywhere(&[0.0, 1.0], red), everywhere(&[0.0, 0.25], blue));
    for i in 0..3 {
        assert!((found[i] - (0.75 * red[i] + 0.25 * blue[i])).abs() < 1e-6, "{found:?}");
    }
}

#[test]
fn a_stained_region_multiplies_the_grey_and_shows_colours_at_its_core() {
    let stain = [0.5, 0.25, 1.0];
    let counts = field(4, 1, |x, _| x as i32);
    let own = region(counts.clone(), &[0.0, 0.0, 0.5, 1.0], Inside::OwnColors);
    let found = picture((4, 1), &[Region { stain, ..own.clone() }], None);
    let shaded = shaded(4, 1);
    for (x, share) in [0.0, 0.0, 0.5, 1.0].into_iter().enumerate() {
        let [r, g, b, grey] = shaded[(x, 0)];
        let under = stain.map(|stain| if x > 0 { grey * stain } else { grey });
        let wanted = [0, 1, 2].map(|i| under[i] * (1.0 - share) + [r, g, b][i] * share);
        assert_eq!(found[(x, 0)][..3], wanted, "{x}");
    }
    // Where a region was before, its colours are stained.
    let colored = region(Field::filled(4, 1, 1), &[0.0, 1.0], Inside::OwnColors);
    let over = Region { stain, ..region(counts, &[0.0, 0.0, 0.0], Inside::OwnColors) };
    let found = picture((4, 1), &[colored, over], None);
    let [r, g, b, _] = shaded[(3, 0)];
    assert_eq!(found[(3, 0)], [0.5 * r, 0.25 * g, b, 1.0]);
    assert!(r > 0.05 && g > 0.05, "{r} {g}");
}

#[test]
fn the_samples_of_a_pixel_are_averaged() {
    let shaded = field(4, 2, |x, _| if x < 2 { [1.0, 0.0, 0.0, 0.2] } else { [0.5; 4] });
    // The left pixel is half inside; the right one shows its surface in a single sample.
    let counts = field(4, 2, |x, y| i32::from(x < 2 && y == 0));
    let visible = field(4, 2, |x, y| match (x, y) {
        (3, _) | (2, 0) => Fragment::EMPTY,
        _ => Fragment { triangle: 0, ..Fragment::EMPTY },
    });
    let regions = [region(counts, &[0.0, 1.0], Inside::OwnColors)];
    let found = |paper| {
        let shaded = shaded.clone().into();
        let visible = visible.clone().into();
        let picture = reveal(&mut Compute::cpu(), &shaded, &visible, &regions, paper, 2);
        picture.unwrap().into_host()
    };
    let on_paper = found(Some([0.9, 0.8, 0.7]));
    assert!((on_paper[(0, 0)][0] - 0.6).abs() < 1e-6 && (on_paper[(0, 0)][1] - 0.1).abs() < 1e-6);
    assert!((on_paper[(1, 0)][0] - 0.8).abs() < 1e-6, "{on_paper:?}");
    let bare = found(None);
    assert_eq!(bare[(1, 0)], [0.5, 0.5, 0.5, 0.25]);
}

#[test]
fn numbers_that_are_none_are_refused() {
    let shaded = shaded(2, 2).into();
    let visible = visible(2, 2).into();
    let compute = &mut Compute::cpu();
    let refused = reveal(compute, &shaded, &visible, &[], Some([0.5, f32::NAN, 1.0]), 1);
    assert!(matches!(refused, Err(DrawingError::Setting { name: "paper", .. })));
    let own = region(Field::filled(2, 2, 1), &[0.0, 1.0], Inside::OwnColors);
    let region = Region { stain: [2.0, 0.0, 0.0], ..own };
    assert!(reveal(compute, &shaded, &visible, &[region], None, 1).is_err());
}

#[test]
fn a_device_composes_the_same_picture() {
    let Some(mut gpu) = device() else { return };
    for (samples, width, height) in [(1, 1, 1), (1, 8, 8), (1, 67, 33), (2, 34, 18), (3, 201, 99)] {
        let inside = || shaded(height, width).values().to_vec();
        let regions = |compute: &mut Compute| {
            let inside = Field::from_values(width, height, inside());
            let mut region = |step, tints: &[f32], inside| Region {
                counts: compute.upload(&counts(width, height, step)).unwrap(),
                table: TintTable::new(tints.to_vec()).unwrap(),
                inside,
                stain: [[0.4, 0.9, 0.7], Region::UNSTAINED][step % 2],
            };
            let mut regions = vec![
                region(3, &[0.0, 0.25, 0.5, 0.75, 1.0], Inside::OwnColors),
                region(5, &[0.0, 0.5], Inside::OwnColors),
                region(2, &[0.0, 0.0, 0.0, 0.6], Inside::OwnColors),
            ];
            regions[2].inside = Inside::Picture(compute.upload(&inside).unwrap());
            regions
        };
        for paper in [None, Some([0.9, 0.85, 0.8])] {
            for count in [0, 1, 3] {
                let picture = |compute: &mut Compute| {
                    let all = regions(compute);
                    let shaded = compute.upload(&shaded(width, height)).unwrap();
                    let visible = compute.upload(&visible(width, height)).unwrap();
                    let picture =
                        reveal(compute, &shaded, &visible, &all[..count], paper, samples).unwrap();
                    compute.download(&picture).unwrap()
                };
                let wanted = picture(&mut Compute::cpu());
                let found = picture(&mut gpu);
                let (most, _) = far(&wanted, &found);
                assert!(most < 0.01 / 255.0, "{width} x {height}, {count}: {most}");
            }
        }
    }
}
