//! Effects of photographs alone: soft steps, lifted darks, reserved whites, a margin, back-runs.

use std::io::Cursor;

use graphics::field::Field;
use graphics::picture::Photograph;
use image::{ImageFormat, Rgb, RgbImage};
use watercolor::{
    BackRunSettings, BrushTouch, PaperTexture, PhotographPainter, PreparedPhotograph, Settings,
    back_runs,
};

use super::without_effects;

fn photograph(width: u32, height: u32, color: impl Fn(u32, u32) -> [u8; 3]) -> Photograph {
    let picture = RgbImage::from_fn(width, height, |x, y| Rgb(color(x, y)));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    Photograph::from_bytes("made.png", bytes.get_ref()).unwrap()
}

/// Settings in which only the effects of photographs are left, all off.
fn plain() -> Settings {
    let mut settings = without_effects(Settings::default());
    settings.reference_px = 400.0;
    settings.tones.dark = "#000000".to_owned();
    settings.tones.reserve = 1.0;
    settings.wet.tone_px = 0.0;
    settings.wet.amount = 0.0;
    settings.margin.width_px = 0.0;
    settings
}

fn prepared(photograph: &Photograph, settings: Settings) -> PreparedPhotograph {
    PhotographPainter::new(settings).prepare(photograph).unwrap()
}

/// A sky that grows paler downwards, with a dark tower before it.
fn sky() -> Photograph {
    photograph(400, 300, |x, y| match x {
        180..230 if y > 90 => [60, 30, 25],
        _ => {
            let t = f64::from(y) / 300.0;
            [60.0 + 170.0 * t, 110.0 + 110.0 * t, 180.0 + 40.0 * t].map(|v| v as u8)
        }
    })
}

/// The greatest step of red between neighbours of a column.
fn steepest(color: &Field<[f32; 4]>, x: usize) -> f32 {
    let steps = (1..color.height()).map(|y| (color[(x, y)][0] - color[(x, y - 1)][0]).abs());
    steps.fold(0.0, f32::max)
}

#[test]
fn steps_of_a_sky_run_together_and_outlines_stay() {
    let mut settings = plain();
    let hard = prepared(&sky(), settings.clone()).wash.color;
    assert!(steepest(&hard, 60) > 0.08, "the sky has steps: {}", steepest(&hard, 60));
    settings.wet.tone_px = 24.0;
    let soft = prepared(&sky(), settings).wash.color;
    assert!(steepest(&soft, 60) < 0.02, "no arc in the sky: {}", steepest(&soft, 60));
    let edge = |color: &Field<[f32; 4]>| (color[(176, 200)][0] - color[(184, 200)][0]).abs();
    assert!((edge(&soft) - edge(&hard)).abs() < 0.03, "{} {}", edge(&soft), edge(&hard));
}

#[test]
fn wet_outlines_run_over_their_share_of_the_picture() {
    let two = photograph(400, 300, |x, _| if x < 200 { [150, 120, 90] } else { [130, 140, 110] });
    let mut settings = plain();
    settings.abstraction.range_luv = 5.0;
    settings.wet.reach_px = 12.0;
    let moved = |amount: f32| {
        settings.wet.amount = amount;
        let color = prepared(&two, settings.clone()).wash.color;
        (0..300)
            .filter(|y: &usize| {
                let own = |x: usize| color[(x, *y)][0];
                (180..220)
                    .filter(|&x| (own(x) - own(if x < 200 { 20 } else { 380 })).abs() > 0.01)
                    .count()
                    > 4
            })
            .count()
    };
    let mut of = moved;
    let [none, some, all] = [0.0, 0.4, 1.0].map(&mut of);
    assert!(none == 0 && some > 20 && some < 280 && all > 285, "{none} {some} {all} rows");
    // An outline of black against white stays on the wettest paper.
    let strong = photograph(400, 300, |x, _| [if x < 200 { 20 } else { 235 }; 3]);
    let [dry, wet] = [0.0, 1.0].map(|amount| {
        settings.wet.amount = amount;
        prepared(&strong, settings.clone()).wash.color
    });
    let most = (180..220)
        .map(|x: usize| (0..300).map(|y| (wet[(x, y)][0] - dry[(x, y)][0]).abs()).sum::<f32>())
        .fold(0.0, f32::max)
        / 300.0;
    assert!(most < 0.03, "a strong outline ran by {most}");
}

#[test]
fn darks_are_lifted_and_whites_are_reserved() {
    let photo = photograph(400, 300, |x, _| match x {
        0..130 => [8, 5, 4],
        130..260 => [252, 252, 250],
        _ => [200, 120, 60],
    });
    let mut settings = plain();
    let flat = prepared(&photo, settings.clone()).wash.color;
    assert!(flat[(50, 50)][0] < 0.05 && flat[(200, 50)][3] > 0.99);
    settings.tones.dark = "#333344".to_owned();
    settings.tones.reserve = 0.93;
    let found = prepared(&photo, settings).wash.color;
    let [r, _, b, covered] = found[(50, 50)];
    assert!((0.2..0.26).contains(&r) && b > r && covered > 0.99, "{:?}", found[(50, 50)]);
    assert_eq!(found[(200, 50)][3], 0.0, "white stays bare paper");
    assert!(found[(350, 50)][3] > 0.99 && found[(350, 50)][0] > flat[(350, 50)][0]);
}

#[test]
fn a_margin_stays_bare_and_its_rim_is_ragged() {
    let photo = photograph(400, 300, |_, _| [120, 140, 90]);
    let mut settings = plain();
    (settings.margin.width_px, settings.margin.ragged_px) = (30.0, 10.0);
    let color = prepared(&photo, settings).wash.color;
    let first = |y: usize| (0..400).find(|&x| color[(x, y)][3] > 0.5).unwrap() as f32;
    let rims: Vec<f32> = (80..220).map(first).collect();
    let mean = rims.iter().sum::<f32>() / rims.len() as f32;
    let spread = rims.iter().map(|rim| (rim - mean).powi(2)).sum::<f32>() / rims.len() as f32;
    assert!((mean - 30.0).abs() < 12.0, "the mean margin is {mean} px");
    assert!(spread.sqrt() > 2.0, "its rim varies by {} px", spread.sqrt());
    assert!((100..300).all(|x| color[(x, 2)][3] == 0.0 && color[(x, 150)][3] == 1.0));
}

#[test]
fn back_runs_are_pale_with_a_dark_rim_and_follow_their_share() {
    let wash = Field::filled(300, 300, [0.4, 0.5, 0.7, 1.0]);
    let of = |share| {
        let settings = BackRunSettings { size_px: 80.0, share, ..BackRunSettings::default() };
        back_runs(&wash, &settings)
    };
    assert!(of(0.0).values().iter().all(|value| *value == 0.5));
    let count = |field: &Field<f32>, inside: fn(&&f32) -> bool| {
        field.values().iter().filter(inside).count()
    };
    let [some, all] = [0.4, 1.0].map(of);
    let [pale, dark] = [count(&all, |v| **v < 0.4), count(&all, |v| **v > 0.58)];
    assert!(pale > 9000 && dark > 1500 && dark < pale, "{pale} pale, {dark} dark pixels");
    assert!(count(&some, |v| **v < 0.4) < pale * 3 / 4);
    assert_eq!(some, of(0.4));
}

#[test]
fn back_runs_stay_in_the_wash_that_their_water_falls_into() {
    let settings = BackRunSettings { size_px: 80.0, share: 1.0, ..BackRunSettings::default() };
    let [blue, sand] = [[0.3, 0.4, 0.7, 1.0], [0.9, 0.8, 0.6, 1.0]];
    let even = back_runs(&Field::filled(300, 300, blue), &settings);
    let columns = |left, right| {
        let row = (0..300).map(move |x| if x < 150 { left } else { right });
        Field::from_values(300, 300, (0..300).flat_map(|_| row.clone()).collect())
    };
    let changed = |field: &Field<f32>, columns: std::ops::Range<usize>| {
        let places = (0..300).flat_map(|y| columns.clone().map(move |x| (x, y)));
        places.filter(|&at| field[at] != 0.5).count()
    };
    // A tone of the same wash ends no bloom; the other wash and bare paper do.
    let lighter = back_runs(&columns(blue, [0.4, 0.5, 0.8, 1.0]), &settings);
    let parts = [&even, &lighter].map(|field| changed(field, 0..300));
    assert!(parts[0].abs_diff(parts[1]) < 20, "{parts:?} pixels");
    for other in [sand, [0.3, 0.4, 0.7, 0.0]] {
        let found = back_runs(&columns(blue, other), &settings);
        let crossing = changed(&even, 150..160) - changed(&found, 150..160);
        assert!(crossing > 100, "{other:?}: {crossing} pixels");
        assert!((0..300).all(|y| (0..85).all(|x| found[(x, y)] == even[(x, y)])));
    }
    let bare = back_runs(&Field::filled(300, 300, [0.3, 0.4, 0.7, 0.0]), &settings);
    assert!(bare.values().iter().all(|value| *value == 0.5), "on bare paper");
}

#[test]
fn streaks_run_along_their_direction() {
    let mut settings = Settings::default();
    settings.dry_brush.amount = 0.3;
    settings.dry_brush.streaks = 1.0;
    let paper = PaperTexture::new(240, 240, &settings.paper).unwrap();
    for (direction_deg, level) in [(0.0, true), (90.0, false)] {
        settings.dry_brush.direction_deg = direction_deg;
        let touch = BrushTouch::new(&paper, &settings.dry_brush, &settings.paper).unwrap();
        let field = &touch.touch;
        let [mut across, mut down] = [0.0_f32; 2];
        for y in 1..240 {
            for x in 1..240 {
                across += (field[(x, y)] - field[(x - 1, y)]).abs();
                down += (field[(x, y)] - field[(x, y - 1)]).abs();
            }
        }
        let ratio = if level { down / across } else { across / down };
        assert!(ratio > 3.0, "{direction_deg} degrees: {across} across, {down} down");
        let bare = field.values().iter().filter(|v| **v < touch.quantiles.at(0.3)).count();
        assert!((bare as f32 / 57600.0 - 0.3).abs() < 0.01, "{bare} of 57600 pixels are bare");
    }
    // Counterclockwise in a picture whose rows go down: up to the right.
    settings.dry_brush.direction_deg = 45.0;
    let touch = BrushTouch::new(&paper, &settings.dry_brush, &settings.paper).unwrap().touch;
    let [mut rising, mut falling] = [0.0_f32; 2];
    for y in 1..239 {
        for x in 1..240 {
            rising += (touch[(x, y)] - touch[(x - 1, y + 1)]).abs();
            falling += (touch[(x, y)] - touch[(x - 1, y - 1)]).abs();
        }
    }
    assert!(falling > 3.0 * rising, "{rising} up to the right, {falling} down");
    settings.dry_brush.streaks = 0.0;
    assert!(BrushTouch::new(&paper, &settings.dry_brush, &settings.paper).is_none());
}

#[test]
fn a_large_picture_has_the_regions_of_a_smaller_one_with_crisp_outlines() {
    let mut settings = plain();
    settings.reference_px = 1000.0;
    let painter = |width| PhotographPainter::new(settings.clone()).with_width_px(width);
    let [small, large] = [1600, 2400].map(|width| painter(width).prepare(&sky()).unwrap());
    assert_eq!(small.regions, large.regions);
    assert_eq!(large.original.width(), 1600);
    let color = &large.wash.color;
    assert_eq!((color.width(), color.height()), (2400, 1800));
    assert_eq!(large.flat_regions().width(), 2400);
    // The side of the tower lies at 180 of 400 and is at most three pixels soft.
    let row = |x: usize| color[(x, 1200)][0];
    let sky = row(1000);
    let tower = row(1200);
    let between = (1000..1200).filter(|&x| {
        let t = (row(x) - sky) / (tower - sky);
        (0.1..0.9).contains(&t)
    });
    let between: Vec<usize> = between.collect();
    assert!(between.len() <= 3, "{between:?}");
}

#[test]
fn outlines_of_small_pictures_have_no_saw_teeth() {
    let photo = photograph(300, 200, |_, y| if y < 100 { [60, 80, 160] } else { [220, 200, 150] });
    let mut settings = plain();
    settings.reference_px = 1000.0;
    settings.wobble.amount_px = 2.0;
    let mut painter = PhotographPainter::new(settings);
    let prepared = painter.prepare(&photo).unwrap();
    assert_eq!(prepared.textures.paper.fine().unwrap().factor, 4);
    let found = painter.paint_prepared(&prepared, None).unwrap();
    let mut coarse = prepared;
    coarse.textures.paper =
        coarse.textures.paper.with_fine_heights(1, &coarse.settings.paper).unwrap();
    let teeth = painter.paint_prepared(&coarse, None).unwrap();
    // Differences of second order along the outline show pixels that jump to and fro.
    let at =
        |color: &Field<[f32; 4]>, x: usize| -> f32 { (90..110).map(|y| color[(x, y)][0]).sum() };
    let jump = |color: &Field<[f32; 4]>| -> f32 {
        (1..299).map(|x| (at(color, x - 1) - 2.0 * at(color, x) + at(color, x + 1)).abs()).sum()
    };
    let [own, coarse] = [&found, &teeth].map(|color: &Field<[f32; 4]>| -> f32 {
        let places: Vec<f32> = (0..300).map(|x| at(color, x)).collect();
        let [low, high] = [f32::min, f32::max].map(|of| places.iter().copied().reduce(of).unwrap());
        high - low
    });
    assert!(own > 0.3 * coarse && own > 0.3, "the outline wanders by {own} and {coarse}");
    let found = jump(&found);
    let teeth = jump(&teeth);
    assert!(found < 0.6 * teeth, "{found}, on the paper of the picture {teeth}");
}
