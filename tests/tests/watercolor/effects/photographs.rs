//! Effects only of photographs (soft steps, lifted darks, reserved whites, a margin, back-runs),
//! settings of watercolour (presets, TOML files and their errors, scaling to a picture), and glazes
//! of calibrated pigments over paper of known reflectance.

use std::collections::BTreeSet;
use std::io::Cursor;

use calibrate::PigmentId;
use documents::hint::{Explain, Fault};
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::picture::Photograph;
use image::{ImageFormat, Rgb, RgbImage};
use spectra::color::delta_e_ciede2000;
use watercolor::{
    BackRunSettings, BrushTouch, Controls, FrameTextures, GlazeError, Glazes, PaperTexture,
    PhotographPainter, PreparedPhotograph, Preset, Settings, Textures, Wash, back_runs, paint,
};

use super::{any_picture, without_effects};
use paint::document::{Document, Lighting, Slots};
use paint::light::Light;
use paint::scene::{picture, scene};

fn photograph(width: u32, height: u32, color: impl Fn(u32, u32) -> [u8; 3]) -> Photograph {
    let picture = RgbImage::from_fn(width, height, |x, y| Rgb(color(x, y)));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    Photograph::from_bytes("made.png", bytes.get_ref()).unwrap()
}

/// Settings with only the effects of photographs left, all switched off.
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

/// A sky that becomes paler downwards, with a dark tower in front.
fn sky() -> Photograph {
    photograph(400, 300, |x, y| match x {
        180..230 if y > 90 => [60, 30, 25],
        _ => {
            let t = f64::from(y) / 300.0;
            [60.0 + 170.0 * t, 110.0 + 110.0 * t, 180.0 + 40.0 * t].map(|v| v as u8)
        }
    })
}

/// Largest step of red between neighbours of a column.
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
    let [own, other] =
        [&soft, &hard].map(|color| (color[(176, 200)][0] - color[(184, 200)][0]).abs());
    assert!((own - other).abs() < 0.03, "{own} {other}");
}

#[test]
fn wet_outlines_run_over_their_share_of_the_picture() {
    let two = photograph(400, 300, |x, _| if x < 200 { [150, 120, 90] } else { [130, 140, 110] });
    let mut settings = plain();
    settings.abstraction.range_luv = 5.0;
    settings.wet.reach_px = 12.0;
    let [none, some, all] = [0.0, 0.4, 1.0].map(|amount| {
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
    });
    assert!(none == 0 && some > 20 && some < 280 && all > 285, "{none} {some} {all} rows");
    // On the wettest paper, an outline of black against white stays.
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
    let rims = (80..220).map(|y| (0..400).find(|&x| color[(x, y)][3] > 0.5).unwrap() as f32);
    let rims: Vec<f32> = rims.collect();
    let mean = rims.iter().sum::<f32>() / rims.len() as f32;
    let spread = rims.iter().map(|rim| (rim - mean).powi(2)).sum::<f32>() / rims.len() as f32;
    assert!((mean - 30.0).abs() < 12.0, "the mean margin is {mean} px");
    assert!(spread.sqrt() > 2.0, "its rim varies by {} px", spread.sqrt());
    assert!((100..300).all(|x| color[(x, 2)][3] == 0.0 && color[(x, 150)][3] == 1.0));
}

#[test]
fn back_runs_are_pale_with_a_dark_rim_and_follow_their_share() {
    let wash = Field::filled(300, 300, [0.4, 0.5, 0.7, 1.0]);
    let [none, some, again, all] = [0.0, 0.4, 0.4, 1.0].map(|share| {
        let settings = BackRunSettings { size_px: 80.0, share, ..BackRunSettings::default() };
        back_runs(&wash, &settings)
    });
    assert!(none.values().iter().all(|value| *value == 0.5));
    fn count(field: &Field<f32>, inside: fn(&&f32) -> bool) -> usize {
        field.values().iter().filter(inside).count()
    }
    let [pale, dark] = [count(&all, |v| **v < 0.4), count(&all, |v| **v > 0.58)];
    assert!(pale > 9000 && dark > 1500 && dark < pale, "{pale} pale, {dark} dark pixels");
    assert!(count(&some, |v| **v < 0.4) < pale * 3 / 4);
    assert_eq!(some, again);
}

#[test]
fn back_runs_stay_in_the_wash_that_their_water_falls_into() {
    let settings = BackRunSettings { size_px: 80.0, share: 1.0, ..BackRunSettings::default() };
    let [blue, sand] = [[0.3, 0.4, 0.7, 1.0], [0.9, 0.8, 0.6, 1.0]];
    let even = back_runs(&Field::filled(300, 300, blue), &settings);
    fn columns(left: [f32; 4], right: [f32; 4]) -> Field<[f32; 4]> {
        let row = (0..300).map(move |x| if x < 150 { left } else { right });
        Field::from_values(300, 300, (0..300).flat_map(|_| row.clone()).collect())
    }
    fn changed(field: &Field<f32>, columns: std::ops::Range<usize>) -> usize {
        let places = (0..300).flat_map(|y| columns.clone().map(move |x| (x, y)));
        places.filter(|&at| field[at] != 0.5).count()
    }
    // A tone of the same wash does not end a bloom. The other wash and bare paper do.
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
    // Counterclockwise in a picture with rows from top to bottom: up to the right.
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
    let [small, large] = [1600, 2400].map(|width| {
        PhotographPainter::new(settings.clone()).with_width_px(width).prepare(&sky()).unwrap()
    });
    assert_eq!(small.regions, large.regions);
    assert_eq!(large.original.width(), 1600);
    let color = &large.wash.color;
    assert_eq!((color.width(), color.height()), (2400, 1800));
    assert_eq!(large.flat_regions().width(), 2400);
    // The side of the tower lies at 180 of 400 and is at most three pixels soft.
    let [sky, tower] = [1000, 1200].map(|x| color[(x, 1200)][0]);
    let between = (1000..1200).filter(|&x| {
        let t = (color[(x, 1200)][0] - sky) / (tower - sky);
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
    let [own, coarse] = [&found, &teeth].map(|color| {
        let places = (0..300).map(|x| (90..110).map(|y| color[(x, y)][0]).sum());
        let places: Vec<f32> = places.collect();
        let jumps = places.windows(3).map(|at| (at[0] - 2.0 * at[1] + at[2]).abs());
        let [low, high] = [f32::min, f32::max].map(|of| places.iter().copied().reduce(of).unwrap());
        (high - low, jumps.sum::<f32>())
    });
    assert!(own.0 > 0.3 * coarse.0 && own.0 > 0.3, "wanders by {} and {}", own.0, coarse.0);
    assert!(own.1 < 0.6 * coarse.1, "{}, on the paper of the picture {}", own.1, coarse.1);
}

/// `group.key` of every key, and whether there is a comment on the line above it. Includes keys that are
/// commented out.
fn keys(text: &str) -> Vec<(String, bool)> {
    let mut group = String::new();
    let mut found = Vec::new();
    let mut above = "";
    for line in text.lines() {
        if let Some(header) = line.strip_prefix('[') {
            group = format!("{}.", header.split(']').next().unwrap());
        }
        let shown = line.strip_prefix("# ").filter(|rest| rest.contains(" = \""));
        if let Some((key, _)) = shown.unwrap_or(line).split_once(" = ")
            && (shown.is_some() || !line.starts_with('#'))
        {
            found.push((format!("{group}{key}"), above.starts_with("# ")));
        }
        above = line;
    }
    found
}

#[test]
fn presets_are_read_and_tell_of_every_key() {
    // All keys, including keys without a default value.
    let mut settings = Settings::default();
    settings.paper.scan = Some("x".to_owned());
    settings.toon.greys = Some("x".to_owned());
    settings.dry_brush.color = Some("x".to_owned());
    let all = keys(&toml::to_string(&settings).unwrap());
    let all: BTreeSet<String> = all.into_iter().map(|(key, _)| key).collect();
    assert!(all.contains("paper.scan") && all.contains("reference_px") && all.len() > 40);
    let mut seen = vec![Settings::default()];
    for preset in Preset::ALL {
        let settings = preset.settings();
        assert!(!seen.contains(&settings), "{preset:?} equals another preset");
        seen.push(settings);
        let found = keys(&preset.text());
        for (key, documented) in &found {
            assert!(documented, "{preset:?}: no comment above {key}");
        }
        let found: BTreeSet<String> = found.into_iter().map(|(key, _)| key).collect();
        assert_eq!(found, all, "{preset:?}");
        assert_eq!(preset.name().parse::<Preset>().unwrap(), preset);
    }
    let error = "oil".parse::<Preset>().unwrap_err();
    assert_eq!(error.to_string(), "there is no preset `oil`");
    assert!(error.hint().unwrap().to_string().contains("portrait, landscape, sketch"));
}

#[test]
fn what_a_file_leaves_out_is_usual() {
    let read = Settings::from_toml("a.toml", "[edges]\nstrength = 4\n").unwrap();
    let mut wanted = Settings::default();
    wanted.edges.strength = 4.0;
    assert_eq!(read, wanted);
    assert_eq!(Settings::from_toml("a.toml", "").unwrap(), Settings::default());
    let written = toml::to_string(&wanted).unwrap();
    assert_eq!(Settings::from_toml("a.toml", &written).unwrap(), wanted);
}

#[test]
fn broken_files_are_told_by_line_and_key() {
    for (text, reason) in [
        ("[edges]\n\nstrenght = 4.0", "a.toml, line 3: edges.strenght: unknown key `strenght`"),
        ("\n[edge]\nstrength = 4.0", "a.toml, line 2: edge: unknown key `edge`"),
        (
            "[edges]\nstrength = \"much\"",
            "a.toml, line 2: edges.strength: invalid type: text \"much\"",
        ),
        ("[flow]\nstrength = 1\nstrength = 2", "a.toml, line 3: duplicate key"),
        ("[flow\nstrength = 1", "a.toml, line 1: "),
        ("[flow]\noctaves = 2.5", "a.toml, line 2: flow.octaves: invalid type: number `2.5`"),
        ("[flow]\nseed = -1", "a.toml, line 2: flow.seed: invalid value: number `-1`"),
        ("[paper]\nkind = \"glossy\"", "a.toml, line 2: paper.kind: unknown word `glossy`"),
        (
            "[flow]\n\noctaves = 9",
            "a.toml, line 3: flow.octaves takes a whole number from 1 to 8, found `9`",
        ),
        (
            "[wobble]\namount_px = -0.1",
            "a.toml, line 2: wobble.amount_px takes 0 to 50, found `-0.1`",
        ),
        ("reference_px = nan", "a.toml, line 1: reference_px takes 16 to 65536, found `NaN`"),
        ("dry_brush.amount = inf", "a.toml, line 1: dry_brush.amount takes 0 to 1, found `inf`"),
        (
            "paper = {grain_px = 1e9}",
            "a.toml, line 1: paper.grain_px takes 1 to 512, found `1000000000`",
        ),
        (
            "[paper]\ncolour = \"white\"",
            "a.toml, line 2: paper.colour takes a colour written #rrggbb, found `white`",
        ),
        (
            "[dry_brush]\ncolour = \"#12345\"",
            "a.toml, line 2: dry_brush.colour takes a colour written #rrggbb",
        ),
        ("\u{feff}[flow]\nseed = 9", ""),
    ] {
        let read = Settings::from_toml("a.toml", text);
        if reason.is_empty() {
            assert_eq!(read.unwrap().flow.seed, 9, "{text}");
            continue;
        }
        let error = read.unwrap_err();
        assert!(error.to_string().starts_with(reason), "{text}: {error}");
        assert!(error.hint().is_some(), "{text}");
    }
    let missing = Settings::open(std::path::Path::new("no/such.toml")).unwrap_err();
    assert!(missing.to_string().starts_with("no/such.toml"), "{missing}");
    assert!(missing.hint().is_some() && missing.fault() == Fault::Environment);
}

#[test]
fn lengths_follow_the_picture_once() {
    let settings = Settings::default();
    let double = settings.for_size(1500, 2000);
    assert_eq!(double.reference_px, 2000.0);
    assert_eq!(double.wobble.amount_px, 2.0 * settings.wobble.amount_px);
    assert_eq!(double.paper.grain_px, 2.0 * settings.paper.grain_px);
    let area = settings.abstraction.least_region_px;
    assert_eq!(double.abstraction.least_region_px, 4.0 * area);
    assert_eq!(double.edges.strength, settings.edges.strength);
    assert_eq!(double.for_size(1500, 2000), double);
}

/// Tolerance in linear RGB for thin glazes rounded to whole quanta.
const NEAR: f32 = 2e-3;

/// Reflectance of a slightly warm white paper at `count` wavelengths.
fn paper(count: usize) -> Vec<f64> {
    (0..count).map(|i| 0.86 + 0.05 * i as f64 / count as f64).collect()
}

struct Made {
    glazes: Glazes,
    light: Light,
    sheet: PaperTexture,
}

/// Glazes of six oils, computed once for all tests.
fn made() -> &'static Made {
    static MADE: std::sync::OnceLock<Made> = std::sync::OnceLock::new();
    MADE.get_or_init(|| {
        let library = suite::oils::library();
        let light = Light::named(&library, "D65", "1931-2").unwrap();
        let slots: Slots = std::array::from_fn(|i| (i < 6).then_some(PigmentId(3 * i)));
        let paper = paper(library.grid.count());
        let glazes = Glazes::new(&library, &slots, paper, &light).unwrap();
        let sheet = PaperTexture::new(40, 30, &Settings::default().paper).unwrap();
        Made { glazes, light, sheet }
    })
}

fn level() -> Lighting {
    Lighting { relief: 0.0, ..Lighting::default() }
}

fn seen(document: &Document, light: &Light) -> Field<[f32; 4]> {
    picture(document, &scene(document, light))
}

#[test]
fn a_density_of_1_is_the_recipe_and_no_coverage_is_the_paper() {
    let Made { glazes, light, sheet } = made();
    let mut color = any_picture(40, 30, 51);
    color.values_mut().iter_mut().for_each(|c| c[3] = c[3].ceil());
    let covered: Vec<f32> = color.values().iter().map(|c| c[3]).collect();
    let thickness = Field::from_values(40, 30, covered);
    let document = glazes.document("made", &color, &thickness, sheet, level());
    let found = seen(&document, light);
    let bare = glazes.film().rgb(&[0.0; 8]);
    let mut bares = 0;
    for (found, color) in found.values().iter().zip(color.values()) {
        let wanted = match color[3] > 0.0 {
            true => glazes.film().rgb(&glazes.heights_mm(*color)),
            false => bare,
        };
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < NEAR, "{color:?}: {found} {wanted}");
        }
        bares += usize::from(color[3] == 0.0);
    }
    assert!(bares > 100, "{bares} bare pixels");
    assert!(document.ground.height.values().iter().any(|height| *height > 0));
}

#[test]
fn a_density_of_2_is_two_glazes() {
    let Made { glazes, light, sheet } = made();
    let color = any_picture(40, 30, 52);
    let [twice, mut glazed] = [2.0, 1.0].map(|times| {
        glazes.document("made", &color, &Field::filled(40, 30, times), sheet, level())
    });
    let twice = seen(&twice, light);
    let once = seen(&glazed, light);
    glazed.dry.push(glazed.dry[0].clone());
    let glazed = seen(&glazed, light);
    let mut darker = 0;
    for ((twice, glazed), once) in twice.values().iter().zip(glazed.values()).zip(once.values()) {
        for i in 0..3 {
            let off = (twice[i] - glazed[i]).abs();
            assert!(off < NEAR, "{twice:?} {glazed:?}: {off}");
        }
        darker += usize::from(twice[1] < once[1] - 1e-3);
    }
    assert!(darker > 800, "{darker} of 1200 pixels are darker under two glazes");
}

#[test]
fn a_painting_of_glazes_keeps_grain_edges_and_bare_paper_of_its_effects() {
    let Made { glazes, light, .. } = made();
    let mut settings = Settings::default().for_size(120, 90);
    settings.dry_brush.amount = 0.3;
    settings.dry_brush.patches = 0.0;
    settings.dry_brush.outline_px = 0.0;
    settings.paper.relief = 0.0;
    "#ffffff".clone_into(&mut settings.paper.color);
    let color = Field::from_values(
        120,
        90,
        (0..120 * 90)
            .map(|i: usize| match i % 120 < 60 {
                true => [0.75, 0.62, 0.4, 1.0],
                false => [0.6, 0.7, 0.8, 1.0],
            })
            .collect(),
    );
    let textures = Textures::of_photograph(&color, &settings).unwrap();
    let wash = Wash { color, controls: Controls::default() };
    let found = glazes.paint("made", &wash, &textures, &settings, level());
    assert_eq!(found.dry.len(), 1);
    let found = seen(&found, light);
    let mut cpu = Compute::cpu();
    let images = wash.upload(&mut cpu).unwrap();
    let uploaded = textures.upload(&mut cpu).unwrap();
    let plain = paint(&mut cpu, images, FrameTextures::from(&uploaded), &settings, None).unwrap();
    let plain = cpu.download(&plain).unwrap();
    // Green of both, encoded. Their differences from the mean of each half must agree.
    fn product(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }
    for columns in [4..56, 64..116] {
        let places: Vec<(usize, usize)> =
            (4..86).flat_map(|y| columns.clone().map(move |x| (x, y))).collect();
        let greens: [Vec<f64>; 2] = [
            places.iter().map(|&at| f64::from(found[at][1].max(0.0)).powf(1.0 / 2.2)).collect(),
            places.iter().map(|&at| f64::from(plain[at][1])).collect(),
        ];
        let [glazed, painted] = greens.map(|values| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            values.into_iter().map(|value| value - mean).collect::<Vec<f64>>()
        });
        let own = product(&glazed, &glazed);
        let other = product(&painted, &painted);
        let alike = product(&glazed, &painted) / (own * other).sqrt();
        let contrast = (own / other).sqrt();
        assert!(alike > 0.95, "the grain agrees by {alike} only");
        assert!((0.75..1.25).contains(&contrast), "the contrast is {contrast} times that");
    }
}

#[test]
fn a_palette_is_chosen_and_comes_near_to_colors_that_watercolor_has() {
    let library = suite::oils::library();
    let Made { light, .. } = made();
    let paper = paper(library.grid.count());
    let colors = [
        [0.95, 0.93, 0.85, 1.0],
        [0.85, 0.65, 0.35, 1.0],
        [0.5, 0.6, 0.75, 1.0],
        [0.55, 0.3, 0.35, 1.0],
        [0.75, 0.78, 0.45, 1.0],
    ];
    let color = Field::from_values(5, 1, colors.to_vec());
    let wash = Wash { color, controls: Controls::default() };
    let slots = Glazes::palette(&wash, &library, &paper, light).unwrap();
    let glazes = Glazes::new(&library, &slots, paper.clone(), light).unwrap();
    let film = glazes.film();
    let white = film.rgb(&[0.0; 8]);
    // Paint cannot be darker than the reflectance of the surface, so we raise black to it.
    let black = library.saunderson.floor() as f32;
    for color in colors {
        let linear = spectra::color::Rgb([color[0], color[1], color[2]].map(f64::from)).linear();
        let wanted: [f32; 3] =
            std::array::from_fn(|i| black + (1.0 - black) * linear.0[i] as f32 * white[i]);
        let found = film.rgb(&glazes.heights_mm(color));
        let [wanted, found] = [wanted, found].map(|rgb| film.lab_from_rgb(rgb));
        let off = delta_e_ciede2000(wanted, found);
        assert!(off < 4.0, "{color:?}: {off} CIEDE2000");
    }
    let none = Glazes::new(&library, &Slots::default(), paper, light).unwrap_err();
    assert!(
        matches!(none, GlazeError::Separation(_))
            && none.hint().unwrap().to_string().contains("pigments")
    );
}
