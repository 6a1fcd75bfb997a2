//! Segmentation of small synthetic pictures (regions, connectivity, coverage, settings), and
//! openings and closings (definition, algebraic properties, CPU against GPU).

use documents::hint::Explain;
use graphics::compute::{ColorImage, Compute};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::morphology::{self, Extremum, StructuringElement};
use graphics::segmentation::{SegmentationError, SegmentationSettings, segment};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use suite::program::device;

fn settings(least_region_px: u32) -> SegmentationSettings {
    SegmentationSettings {
        spatial_radius_px: 5.0,
        range_radius: 10.0,
        least_region_px,
        tone_step: 0.0,
    }
}

/// A step from dark to light at x = 23, with noise of about 4 in L*.
fn step() -> Field<[f32; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut picture = Field::filled(60, 40, [1.0; 4]);
    for (i, pixel) in picture.values_mut().iter_mut().enumerate() {
        let base = if i % 60 < 23 { 0.35 } else { 0.65 };
        let value = base + random.random_range(-0.04..0.04f32);
        *pixel = [value, value, value, 1.0];
    }
    picture
}

/// Squares of 5 x 5 pixels in seven random colours, with noise.
fn wild() -> Field<[f32; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let tones: Vec<[f32; 3]> = (0..7).map(|_| std::array::from_fn(|_| random.random())).collect();
    let squares: Vec<usize> = (0..20 * 15).map(|_| random.random_range(0..7)).collect();
    let mut picture = Field::filled(97, 71, [1.0; 4]);
    for y in 0..71 {
        for x in 0..97 {
            let [r, g, b] = tones[squares[y / 5 * 20 + x / 5]];
            let noise = random.random_range(-0.1..0.1f32);
            picture[(x, y)] = [r + noise, g - noise, b + noise, 1.0];
        }
    }
    picture
}

/// Number of pixels of each label that are 4-connected to its first pixel.
fn reached(labels: &Field<u32>, count: usize) -> Vec<usize> {
    let width = labels.width();
    let height = labels.height();
    let mut seen = vec![false; width * height];
    let mut sizes = vec![0; count];
    let mut begun = vec![false; count];
    for start in 0..width * height {
        let label = labels.values()[start] as usize;
        if std::mem::replace(&mut begun[label], true) {
            continue;
        }
        let mut waiting = vec![start];
        seen[start] = true;
        while let Some(pixel) = waiting.pop() {
            sizes[label] += 1;
            let x = pixel % width;
            let y = pixel / width;
            let beside = [
                (x > 0).then(|| pixel - 1),
                (x + 1 < width).then_some(pixel + 1),
                (y > 0).then(|| pixel - width),
                (y + 1 < height).then_some(pixel + width),
            ];
            for next in beside.into_iter().flatten() {
                if labels.values()[next] as usize == label && !seen[next] {
                    seen[next] = true;
                    waiting.push(next);
                }
            }
        }
    }
    sizes
}

#[test]
fn a_constant_picture_is_one_region_unchanged() {
    let picture = Field::filled(30, 20, [0.25, 0.5, 0.75, 1.0]);
    let found = segment(&picture, &settings(10)).unwrap();
    assert_eq!(found.colors.len(), 1);
    assert_eq!(found.flat(), picture);
}

#[test]
fn a_step_stays_and_noise_goes() {
    let found = segment(&step(), &settings(10)).unwrap();
    assert_eq!(found.colors.len(), 2);
    for y in 0..40 {
        for x in 0..60 {
            assert_eq!(found.labels[(x, y)], u32::from(x >= 23), "{x} {y}");
        }
    }
    for (color, wanted) in found.colors.iter().zip([0.35, 0.65]) {
        assert!((color[0] - wanted).abs() < 0.005 && color[3] == 1.0, "{color:?}");
    }
}

#[test]
fn regions_hang_together_and_none_is_too_small() {
    let picture = wild();
    for least in [1, 12, 60] {
        let found = segment(&picture, &settings(least)).unwrap();
        let count = found.colors.len();
        assert!(count > 3, "{count} regions");
        let mut sizes = vec![0; count];
        found.labels.values().iter().for_each(|&label| sizes[label as usize] += 1);
        assert!(sizes.iter().all(|&size| size >= least as usize), "{least}: {sizes:?}");
        assert_eq!(reached(&found.labels, count), sizes);
        let mut next = 0;
        for &label in found.labels.values() {
            assert!(label <= next, "{label} before {next}");
            next = next.max(label + 1);
        }
    }
}

#[test]
fn threads_do_not_count() {
    let picture = wild();
    let [one, two] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| segment(&picture, &settings(12)).unwrap())
    });
    assert_eq!(one, two);
}

#[test]
fn bare_paper_stays_bare() {
    let mut picture = Field::filled(40, 40, [1.0, 1.0, 1.0, 0.0]);
    for y in 10..30 {
        for x in 10..30 {
            picture[(x, y)] = [0.97, 0.97, 0.97, 1.0];
        }
    }
    let found = segment(&picture, &settings(10)).unwrap();
    let coverages: Vec<f32> = found.colors.iter().map(|color| color[3]).collect();
    assert_eq!(coverages, [0.0, 1.0]);
    assert_eq!(found.labels[(20, 20)], 1);
}

#[test]
fn pictures_of_few_pixels_and_odd_numbers_are_taken() {
    for (width, height) in [(0, 0), (1, 1), (1, 9), (9, 1), (2, 3)] {
        let found = segment(&Field::filled(width, height, [0.5; 4]), &settings(4)).unwrap();
        assert_eq!(found.colors.len(), usize::from(width > 0));
    }
    let odd = [f32::NAN, f32::INFINITY, -1.0, 7.0];
    let values = (0..64).map(|i| [odd[i % 4], 0.5, odd[i / 4 % 4], 1.0]).collect();
    let found = segment(&Field::from_values(8, 8, values), &settings(4)).unwrap();
    assert_eq!(found.labels.values().len(), 64);
}

#[test]
fn settings_out_of_range_are_told() {
    let picture = Field::filled(3, 3, [0.5; 4]);
    let with = |spatial_radius_px: f32, range_radius: f32| {
        let settings = SegmentationSettings {
            spatial_radius_px,
            range_radius,
            least_region_px: 1,
            tone_step: 0.0,
        };
        segment(&picture, &settings).unwrap_err()
    };
    assert_eq!(with(0.5, 8.0), SegmentationError::SpatialRadius(0.5));
    assert_eq!(with(300.0, 8.0), SegmentationError::SpatialRadius(300.0));
    assert_eq!(with(5.0, 0.0), SegmentationError::RangeRadius(0.0));
    assert!(matches!(with(5.0, f32::NAN), SegmentationError::RangeRadius(..)));
    assert!(matches!(with(f32::NAN, 5.0), SegmentationError::SpatialRadius(..)));
    assert!(with(0.5, 8.0).hint().unwrap().to_string().contains("width"));
}

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
    fn all(a: &Colors, b: &Colors) -> bool {
        let pairs = a.values().iter().flatten().zip(b.values().iter().flatten());
        pairs.clone().all(|(a, b)| a <= b) && pairs.clone().any(|(a, b)| a < b)
    }
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
