//! Openings and closings.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use render::field::Field;
use render::watercolor::{Backend, Brush, Extreme, Morphology, OnCpu, OnGpu};
use suite::adapter::device;

type Colors = Field<[f32; 4]>;

fn noise(width: usize, height: usize) -> Colors {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let values = (0..width * height).map(|_| std::array::from_fn(|_| random.random())).collect();
    Field::from_values(width, height, values)
}

/// Every pixel under the brush looked at.
fn looked_at(field: &Colors, brush: Brush, which: Extreme) -> Colors {
    let reach = brush.reach() as i32;
    let mut result = field.clone();
    for y in 0..field.height() as i32 {
        for x in 0..field.width() as i32 {
            let own = &mut result[(x as usize, y as usize)];
            for dy in -reach..=reach {
                for dx in -reach..=reach {
                    let (x, y) = (x + dx, y + dy);
                    let inside = (0..field.width() as i32).contains(&x)
                        && (0..field.height() as i32).contains(&y);
                    if !inside || !brush.covers(dx, dy) {
                        continue;
                    }
                    let other = field[(x as usize, y as usize)];
                    for (own, other) in own.iter_mut().zip(other) {
                        *own = match which {
                            Extreme::Least => own.min(other),
                            Extreme::Greatest => own.max(other),
                        };
                    }
                }
            }
        }
    }
    result
}

/// Narrow pictures, and one of several tiles.
const SIZES: [(usize, usize); 5] = [(1, 1), (3, 40), (50, 2), (23, 31), (230, 120)];

#[test]
fn extremes_are_those_of_every_pixel_under_the_brush() {
    for (width, height) in SIZES {
        let field = noise(width, height);
        for radius in [0, 1, 2, 3, 5, 8] {
            for brush in [Brush::round(radius), Brush::round(radius).twice()] {
                for which in [Extreme::Least, Extreme::Greatest] {
                    let found = OnCpu.extreme(&field, brush, which, None).unwrap();
                    let wanted = looked_at(&field, brush, which);
                    assert!(found == wanted, "{width} x {height}, {brush:?} {which:?}");
                }
            }
        }
    }
}

#[test]
fn opening_and_closing_keep_their_laws() {
    let all = |a: &Colors, b: &Colors| {
        let pairs = a.values().iter().flatten().zip(b.values().iter().flatten());
        pairs.clone().all(|(a, b)| a <= b) && pairs.clone().any(|(a, b)| a < b)
    };
    for (width, height) in [(3, 40), (64, 48), (230, 120)] {
        let field = noise(width, height);
        for radius in [1, 2, 4, 7] {
            let opened = OnCpu.opened(&field, radius).unwrap();
            let closed = OnCpu.closed(&field, radius).unwrap();
            assert!(all(&opened, &field) && all(&field, &closed), "{width} {radius}");
            assert!(OnCpu.opened(&opened, radius).unwrap() == opened, "{width} {radius}");
            assert!(OnCpu.closed(&closed, radius).unwrap() == closed, "{width} {radius}");
            let smoothed = OnCpu.smoothed(&field, radius).unwrap();
            assert!(OnCpu.closed(&opened, radius).unwrap() == smoothed, "{width} {radius}");
            assert!(OnCpu.smoothed(&smoothed, radius).unwrap() == smoothed, "{width} {radius}");
        }
        assert!(OnCpu.smoothed(&field, 0).unwrap() == field);
        assert!(OnCpu.opened(&field, 0).unwrap() == field);
    }
}

#[test]
fn what_the_brush_fits_stays_and_less_goes() {
    // A disc of 9 px and specks, in paint on paper.
    let mut field = Field::filled(60, 40, [1.0, 1.0, 1.0, 0.0]);
    let brush = Brush::round(9);
    for y in 0..40 {
        for x in 0..60 {
            let disc = brush.covers(x - 20, y - 20);
            let speck = (44..47).contains(&x) && (8..11).contains(&y);
            if disc || speck {
                field[(x as usize, y as usize)] = [0.2, 0.4, 0.3, 1.0];
            }
        }
    }
    let mut wanted = field.clone();
    for y in 8..11 {
        for x in 44..47 {
            wanted[(x, y)] = [1.0, 1.0, 1.0, 0.0];
        }
    }
    let smoothed = OnCpu.smoothed(&field, 4).unwrap();
    assert!(smoothed == wanted);
}

#[test]
fn backends_agree_bit_for_bit() {
    let Some(mut gpu) = device().map(OnGpu::new) else { return };
    for (width, height) in SIZES {
        let field = noise(width, height);
        let there = gpu.color_of(&field).unwrap();
        for radius in [0, 1, 2, 3, 5, 8] {
            for brush in [Brush::round(radius), Brush::round(radius).twice()] {
                for which in [Extreme::Least, Extreme::Greatest] {
                    let here = OnCpu.extreme(&field, brush, which, None).unwrap();
                    let found = gpu.extreme(&there, brush, which, None).unwrap();
                    let found = gpu.color_field(&found).unwrap();
                    assert!(found == here, "{width} x {height}, {brush:?} {which:?}");
                }
            }
            let smoothed = gpu.smoothed(&there, radius).unwrap();
            let smoothed = gpu.color_field(&smoothed).unwrap();
            assert!(smoothed == OnCpu.smoothed(&field, radius).unwrap(), "{width} {radius}");
        }
    }
}
