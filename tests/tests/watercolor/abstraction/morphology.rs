//! Openings and closings: definition, algebraic properties, and CPU against GPU.

use graphics::compute::{ColorImage, Compute};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::morphology::{self, Extremum, StructuringElement};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use suite::adapter::device;

type Colors = Field<[f32; 4]>;

fn noise(width: usize, height: usize) -> Colors {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let values = (0..width * height).map(|_| std::array::from_fn(|_| random.random())).collect();
    Field::from_values(width, height, values)
}

/// A morphological operator with a radius in pixels.
type Operator = fn(&mut Compute, &ColorImage, u32) -> Result<ColorImage, DeviceError>;

/// Applies an operator to a field: upload, compute, download.
fn applied(compute: &mut Compute, operator: Operator, field: &Colors, radius_px: u32) -> Colors {
    let image = compute.upload(field).unwrap();
    let found = operator(compute, &image, radius_px).unwrap();
    compute.download(&found).unwrap()
}

fn opened(field: &Colors, radius_px: u32) -> Colors {
    applied(&mut Compute::cpu(), morphology::opening, field, radius_px)
}

fn closed(field: &Colors, radius_px: u32) -> Colors {
    applied(&mut Compute::cpu(), morphology::closing, field, radius_px)
}

fn smoothed(field: &Colors, radius_px: u32) -> Colors {
    applied(&mut Compute::cpu(), morphology::opening_then_closing, field, radius_px)
}

fn extremum(
    compute: &mut Compute,
    field: &Colors,
    element: StructuringElement,
    which: Extremum,
) -> Colors {
    let image = compute.upload(field).unwrap();
    let found = morphology::extremum(compute, &image, element, which, None).unwrap();
    compute.download(&found).unwrap()
}

/// The extremum by a loop over all pixels under the element.
fn exhaustive(field: &Colors, element: StructuringElement, which: Extremum) -> Colors {
    let reach = element.reach() as i32;
    let mut result = field.clone();
    for y in 0..field.height() as i32 {
        for x in 0..field.width() as i32 {
            let own = &mut result[(x as usize, y as usize)];
            for dy in -reach..=reach {
                for dx in -reach..=reach {
                    let x = x + dx;
                    let y = y + dy;
                    let inside = (0..field.width() as i32).contains(&x)
                        && (0..field.height() as i32).contains(&y);
                    if !inside || !element.covers(dx, dy) {
                        continue;
                    }
                    let other = field[(x as usize, y as usize)];
                    for (own, other) in own.iter_mut().zip(other) {
                        *own = match which {
                            Extremum::Minimum => own.min(other),
                            Extremum::Maximum => own.max(other),
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
fn extrema_are_those_of_all_pixels_under_the_element() {
    for (width, height) in SIZES {
        let field = noise(width, height);
        for radius in [0, 1, 2, 3, 5, 8] {
            for element in
                [StructuringElement::round(radius), StructuringElement::round(radius).twice()]
            {
                for which in [Extremum::Minimum, Extremum::Maximum] {
                    let found = extremum(&mut Compute::cpu(), &field, element, which);
                    let wanted = exhaustive(&field, element, which);
                    assert!(found == wanted, "{width} x {height}, {element:?} {which:?}");
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
            let after_opening = opened(&field, radius);
            let after_closing = closed(&field, radius);
            assert!(all(&after_opening, &field) && all(&field, &after_closing), "{width} {radius}");
            assert!(opened(&after_opening, radius) == after_opening, "{width} {radius}");
            assert!(closed(&after_closing, radius) == after_closing, "{width} {radius}");
            let after_both = smoothed(&field, radius);
            assert!(closed(&after_opening, radius) == after_both, "{width} {radius}");
            assert!(smoothed(&after_both, radius) == after_both, "{width} {radius}");
        }
        assert!(smoothed(&field, 0) == field);
        assert!(opened(&field, 0) == field);
    }
}

#[test]
fn what_the_element_fits_into_stays_and_smaller_details_go() {
    // Paint on bare paper: a disc of radius 9 px and a speck of 3 x 3 px.
    let mut field = Field::filled(60, 40, [1.0, 1.0, 1.0, 0.0]);
    let element = StructuringElement::round(9);
    for y in 0..40 {
        for x in 0..60 {
            let disc = element.covers(x - 20, y - 20);
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
    let after_both = smoothed(&field, 4);
    assert!(after_both == wanted);
}

#[test]
fn processor_and_device_agree_bit_for_bit() {
    let Some(mut gpu) = device().map(Compute::gpu) else { return };
    for (width, height) in SIZES {
        let field = noise(width, height);
        for radius in [0, 1, 2, 3, 5, 8] {
            for element in
                [StructuringElement::round(radius), StructuringElement::round(radius).twice()]
            {
                for which in [Extremum::Minimum, Extremum::Maximum] {
                    let here = extremum(&mut Compute::cpu(), &field, element, which);
                    let found = extremum(&mut gpu, &field, element, which);
                    assert!(found == here, "{width} x {height}, {element:?} {which:?}");
                }
            }
            let found = applied(&mut gpu, morphology::opening_then_closing, &field, radius);
            assert!(found == smoothed(&field, radius), "{width} {radius}");
        }
    }
}
