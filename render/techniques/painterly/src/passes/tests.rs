use super::super::coloring::{Coloring, SubjectKind};
use super::super::divided::THIN;
use super::super::made_up::{map, splat};
use super::super::settings::{ColorSettings, ColorSource};
use super::super::tones::Tones;
use super::*;
use artmap::map::Between;

fn laid_out(from: ColorSource) -> (Tones, Coloring) {
    let map = map(1);
    let settings = ColorSettings { from, ..ColorSettings::default() };
    let coloring = Coloring::new(&[&map], &[], &settings, SubjectKind::Model);
    (Tones::new(&[&map], Between::Blend, &coloring), coloring)
}

/// A picture of the lowest layer.
fn shown(
    depth: &Field<f32>,
    splats: &[StrokeSplat],
    (tones, coloring): (&Tones, &Coloring),
    overlap: &OverlapSettings,
) -> PaintedPicture {
    let divide = Divide { tones, coloring, overhang: overlap.overhang, thin: THIN };
    painted_on_cpu(depth, splats, &divide, overlap)
}

fn overlap(sharpness: u32) -> OverlapSettings {
    OverlapSettings { sharpness, ..OverlapSettings::default() }
}

/// The red of a pixel and the sum of weights before the power, summed in f64 over all splats: weights exp(-4.5 d^2) to a power, by the
/// square of the height of their texel.
fn summed(splats: &[StrokeSplat], tones: &Tones, sharpness: i32, at: [f32; 2]) -> Option<[f64; 2]> {
    let texels = tones.texels(0, 0);
    let size = texels.size as f64;
    let mut sum = 0.0;
    let mut total = 0.0;
    let mut cover = 0.0;
    for splat in splats {
        let from = [at[0] - splat.x, at[1] - splat.y];
        let part = |[x, y]: [f32; 2]| f64::from(x * from[0] + y * from[1]);
        let [a, b] = [part(splat.across), part(splat.along)];
        let square = a * a + b * b;
        if square >= 1.0 {
            continue;
        }
        let end = (-4.5_f64).exp();
        let weight = f64::from(splat.weight) * ((-4.5 * square).exp() - end) / (1.0 - end);
        let place = [(a, 0), (b, 1)].map(|(way, axis)| {
            let at = f64::from(splat.offset[axis]) + f64::from(splat.extent[axis]) * way;
            (at * size - 0.5).rem_euclid(size)
        });
        let bytes = |x: f64, y: f64| {
            let wrapped = |at: f64| at.rem_euclid(size) as usize % texels.size;
            texels.between(wrapped(x), wrapped(y), 0, 0).map(|byte| f64::from(byte) / 256.0)
        };
        let [x, y] = place.map(f64::floor);
        let [right, down] = [place[0] - x, place[1] - y];
        let mix = |channel: usize| {
            let row =
                |y: f64| bytes(x, y)[channel] * (1.0 - right) + bytes(x + 1.0, y)[channel] * right;
            row(y) * (1.0 - down) + row(y + 1.0) * down
        };
        cover += weight;
        let high = 0.25 + 0.75 * mix(3) / 255.0;
        let weight = weight.powi(sharpness) * high * high;
        sum += weight * (f64::from(tones.low[0]) + f64::from(tones.step[0]) * mix(0));
        total += weight;
    }
    (total > 0.0).then(|| [sum / total, cover])
}

#[test]
fn a_pixel_is_the_weighted_mean_of_all_splats() {
    let (tones, coloring) = laid_out(ColorSource::Map);
    let splats: Vec<StrokeSplat> = (0..60_u8)
        .map(|i| {
            let at = [f32::from(i) * 7.3 % 45.0, f32::from(i) * 11.9 % 37.0];
            let own = splat(at, [6.0, 9.5], f32::from(i));
            let offset = [f32::from(i) * 0.37 % 1.0, f32::from(i) * 0.73 % 1.0];
            StrokeSplat { offset, weight: 0.3 + f32::from(i) / 90.0, ..own }
        })
        .collect();
    let depth = Field::filled(45, 37, 0.5);
    for sharpness in [1, 2, 4, 16] {
        let overlap = overlap(sharpness);
        let picture = shown(&depth, &splats, (&tones, &coloring), &overlap);
        let mut compared = 0;
        for y in 0..37 {
            for x in 0..45 {
                let at = [x as f32 + 0.5, y as f32 + 0.5];
                let wanted = summed(&splats, &tones, sharpness as i32, at);
                let found = picture.color[(x, y)];
                let Some(wanted) = wanted else {
                    assert_eq!(found[3], 0.0);
                    continue;
                };
                // A thinner cover is see-through.
                let [wanted, cover] = wanted;
                if cover < 2e-3 {
                    continue;
                }
                let off = (f64::from(found[0]) - wanted).abs();
                assert!(off < 2.0 / 255.0, "{sharpness} at {x}, {y}: {found:?}, {wanted}");
                compared += 1;
            }
        }
        assert!(compared > 1300, "{compared}");
    }
}

#[test]
fn splats_behind_the_mesh_do_not_show_and_those_before_it_reach_out() {
    let (tones, coloring) = laid_out(ColorSource::Map);
    let own = splat([16.0, 16.0], [10.0, 10.0], 0.0);
    let at = |depth: f32| StrokeSplat { depth, ..own };
    let cover = |mesh: f32, splats: &[StrokeSplat], overhang: f32| {
        let depth = Field::filled(32, 32, mesh);
        let overlap = OverlapSettings { overhang, ..overlap(4) };
        shown(&depth, splats, (&tones, &coloring), &overlap).color[(16, 16)][3]
    };
    assert_eq!(cover(0.3, &[at(0.5)], 0.5), 0.0, "hidden");
    assert_eq!(cover(0.5, &[at(0.5)], 0.5), 1.0, "on the mesh");
    assert_eq!(cover(1.0, &[at(0.5)], 0.5), 1.0, "beyond the outline");
    assert_eq!(cover(1.0, &[at(0.5)], 0.0), 0.0, "no overhang is asked for");
    assert_eq!(cover(0.8, &[at(0.5)], 0.0), 1.0, "a mesh is not left bare");
}

#[test]
fn the_nearest_of_two_surfaces_shows_beyond_an_outline() {
    let (tones, coloring) = laid_out(ColorSource::Model);
    let near = StrokeSplat {
        depth: 0.4,
        color: [30.0, 40.0, 0.0],
        ..splat([16.0, 16.0], [10.0, 10.0], 0.0)
    };
    let far = StrokeSplat { depth: 0.6, color: [30.0, -40.0, 0.0], ..near };
    let depth = Field::filled(32, 32, 1.0);
    let paint = |splats: &[StrokeSplat]| {
        shown(&depth, splats, (&tones, &coloring), &overlap(4)).color[(15, 15)]
    };
    assert_eq!(paint(&[far, near]), paint(&[near]));
    assert_eq!(paint(&[near, far]), paint(&[near]));
    assert_ne!(paint(&[far]), paint(&[near]));
}
