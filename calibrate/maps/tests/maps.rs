//! Maps of simulated pixels: equal bytes for blocks of any size, bad pixels, books, settings.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use calibrate::{Residuals, ResidualsError};
use documents::hint::Explain;
use documents::{Cancellation, Task};
use maps::accuracy::{Painting, PaintingPlan};
use maps::pixel_maps::{BlockMaps, Mask};
use maps::{Book, Ground, MapError, MapSettings, Mapper, ModelError, PigmentGroup};
use pigment::PigmentLibrary;

fn oils() -> (PigmentLibrary, Vec<f64>) {
    let oils = PigmentLibrary::van_gogh_oils();
    let nm = oils.grid.wavelengths_nm().collect();
    (oils, nm)
}

fn settings() -> MapSettings {
    let model_error = Some(ModelError::Stated(0.1));
    MapSettings { group_alike: false, model_error, ..MapSettings::default() }
}

fn scan(pixels: usize) -> (Mapper, Vec<f32>) {
    let (oils, nm) = oils();
    let plan = PaintingPlan { pixels, recipes: 12, ..PaintingPlan::default() };
    let painting = Painting::simulate(&oils, &oils, &plan);
    (Mapper::new(&oils, &nm, &settings()).unwrap(), painting.spectra)
}

fn place(mapper: &Mapper, name: &str) -> usize {
    mapper.pigments().iter().position(|known| known == name).unwrap()
}

/// All numbers of a map as bits, so that e.g. NaN equals NaN.
fn bits(maps: &BlockMaps) -> Vec<u32> {
    let lists = [&maps.share, &maps.share_sd, &maps.presence, &maps.chi2, &maps.rms];
    let numbers = lists.into_iter().flatten().map(|value| value.to_bits());
    let second = maps.second.iter().map(|bits| *bits as u32);
    numbers.chain(second).chain(maps.mask.iter().map(|mask| u32::from(mask.code()))).collect()
}

#[test]
fn a_pixel_depends_on_itself_and_the_book_only() {
    let (mapper, spectra) = scan(700);
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    let whole = mapper.map_block(&book, &spectra).unwrap();
    assert!(whole.is_consistent(), "lengths");
    for pool in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(pool).build().unwrap();
        let again = pool.install(|| mapper.survey(&spectra, &Task::default()).unwrap());
        assert_eq!(again.to_json().unwrap(), book.to_json().unwrap());
        for pixels in [1, 97, 700] {
            let pieces = spectra.chunks(pixels * 31);
            let pieces: Vec<BlockMaps> =
                pool.install(|| pieces.map(|p| mapper.map_block(&book, p).unwrap()).collect());
            let first: Vec<u32> =
                pieces.iter().flat_map(|p| p.share.iter().map(|v| v.to_bits())).collect();
            let expected: Vec<u32> = whole.share.iter().map(|v| v.to_bits()).collect();
            assert_eq!(first, expected, "{pixels} pixels at a time");
            if pixels == 700 {
                assert_eq!(bits(&pieces[0]), bits(&whole));
            }
        }
    }
}

#[test]
fn shares_sum_to_1_and_probabilities_are_probabilities() {
    let (mapper, spectra) = scan(300);
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    let maps = mapper.map_block(&book, &spectra).unwrap();
    for pixel in maps.share.chunks_exact(maps.pigments) {
        assert!((pixel.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{pixel:?}");
    }
    assert!(maps.presence.iter().all(|p| (0.0..=1.0001).contains(p)), "probabilities");
    assert!(maps.share_sd.iter().all(|sd| (0.0..=1.0).contains(sd)), "deviations");
    assert!(maps.rms.iter().all(|rms| (0.0..0.1).contains(rms)), "residuals");
}

#[test]
fn no_pixel_panics_and_bad_ones_are_masked() {
    let (mapper, spectra) = scan(200);
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    let bad: Vec<(f32, Mask)> = vec![
        (f32::NAN, Mask::NotFinite),
        (f32::INFINITY, Mask::NotFinite),
        (-0.1, Mask::TooDark),
        (0.0, Mask::TooDark),
        (0.029, Mask::TooDark),
        (55.0, Mask::OutOfRange),
        (-3.0, Mask::OutOfRange),
        (0.031, Mask::Mapped),
        (0.5, Mask::Mapped),
        (1.0, Mask::OutOfGamut),
        (1.4, Mask::OutOfGamut),
    ];
    let mut pixels: Vec<f32> = bad.iter().flat_map(|(value, _)| [*value; 31]).collect();
    // One dead band spoils its pixel alone.
    pixels
        .extend(spectra[..31].iter().enumerate().map(|(b, v)| if b == 7 { f32::NAN } else { *v }));
    pixels.extend(&spectra[..31]);
    // Bands that leap between the extremes, as no paint does.
    pixels.extend((0..31).map(|band| if band % 2 == 0 { 0.0 } else { 1.0 }));
    for maps in [mapper.map_block(&book, &pixels).unwrap(), mapper.search(&pixels).unwrap()] {
        let expected = bad.iter().map(|(_, mask)| *mask);
        let expected: Vec<Mask> =
            expected.chain([Mask::NotFinite, Mask::Mapped, Mask::OutOfGamut]).collect();
        assert_eq!(maps.mask, expected);
        let shares: Vec<&[f32]> = maps.share.chunks_exact(maps.pigments).collect();
        assert!(shares[0].iter().all(|share| share.is_nan()), "no numbers where there is no map");
        assert!(shares[8].iter().all(|share| share.is_finite()), "grey");
        // A pixel that no mixture explains tells how badly, and no pigments.
        assert!(maps.chi2[13] > 10.0 * maps.chi2[12], "{:?}", &maps.chi2[12..]);
        let shares = shares[13];
        assert!(maps.rms[13] > 0.1 && shares.iter().all(|share| share.is_nan()), "{shares:?}");
    }
    let masks = [Mask::Saturated, Mask::Mapped];
    let opened = mapper.open_book(&book).unwrap();
    let maps = mapper.map(&opened, &spectra[..62], &masks).unwrap();
    assert_eq!(maps.mask, masks);
}

#[test]
fn wrong_lengths_and_other_books_are_refused() {
    let (mapper, spectra) = scan(50);
    let error = mapper.survey(&spectra[..40], &Task::default()).unwrap_err();
    assert_eq!(error, MapError::Length { values: 40, bands: 31 });
    assert!(error.hint().is_some(), "a way out");
    let error = mapper.survey(&[f32::NAN; 62], &Task::default()).unwrap_err();
    assert_eq!(error, MapError::NothingToSurvey(2));
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    let opened = mapper.open_book(&book).unwrap();
    let error = mapper.map(&opened, &spectra, &[Mask::Mapped]).unwrap_err();
    assert_eq!(error, MapError::Masks { masks: 1, pixels: 50 });
    let (oils, nm) = oils();
    let other = Mapper::new(&oils, &nm, &MapSettings { at_most: 2, ..settings() }).unwrap();
    let error = other.map_block(&book, &spectra).unwrap_err();
    assert!(matches!(error, MapError::OtherBook { .. }), "{error}");
    // Groups join columns of the map, which leaves the book valid.
    let groups = vec![PigmentGroup {
        name: "whites".to_owned(),
        pigments: vec!["Zinc White".to_owned(), "lead white".to_owned()],
    }];
    let joined = Mapper::new(&oils, &nm, &MapSettings { groups, ..settings() }).unwrap();
    assert_eq!(joined.columns().len(), 17);
    let maps = joined.map_block(&book, &spectra).unwrap();
    assert_eq!(maps.pigments, 17);
}

#[test]
fn books_survive_their_file_and_broken_ones_are_refused() {
    let (mapper, spectra) = scan(40);
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    let text = book.to_json().unwrap();
    let read = Book::from_json(&text).unwrap();
    assert_eq!(read, book);
    assert_eq!(read.sha256().unwrap(), book.sha256().unwrap());
    let whole = mapper.map_block(&book, &spectra).unwrap();
    assert_eq!(bits(&mapper.map_block(&read, &spectra).unwrap()), bits(&whole));
    for (from, to) in [
        ("impasto-survey", "other"),
        ("\"version\":4", "\"version\":2"),
        ("\"median_chi2\":", "\"median_chi2\":-"),
        ("\"palette\":[", "\"palette\":[0.5,"),
        ("\"point\":[", "\"point\":[1.0,"),
        ("\"shares\":[", "\"shares\":[7.0,"),
    ] {
        let broken = text.replacen(from, to, 1);
        assert!(matches!(Book::from_json(&broken), Err(MapError::Book(..))), "{from}");
    }
    assert!(Book::from_json(&text[..100]).is_err(), "a part of a file");
}

#[test]
fn nothing_below_one_percent_is_told_as_present() {
    let (mapper, spectra) = scan(600);
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    for maps in [mapper.map_block(&book, &spectra).unwrap(), mapper.search(&spectra).unwrap()] {
        let pairs = || maps.share.iter().zip(&maps.presence);
        let traces = pairs().filter(|(share, _)| **share > 0.0 && **share < 0.01).count();
        assert!(traces > 100, "{traces} traces");
        for (share, presence) in pairs().filter(|(share, _)| **share < 0.01) {
            assert!(*presence < 0.5, "share {share}, presence {presence}");
        }
    }
}

/// A light linen, darker in the blue.
fn linen(nm: &[f64]) -> Vec<f64> {
    nm.iter().map(|nm| 0.35 + 0.2 * ((nm - 400.0) / 300.0).sqrt()).collect()
}

#[test]
fn bare_ground_is_told_and_paint_is_not_taken_for_it() {
    let (oils, nm) = oils();
    let (mapper, mut spectra) = scan(300);
    let ground = Ground::new(nm.clone(), linen(&nm)).unwrap();
    let knows = MapSettings { ground: Some(ground), ..settings() };
    let knows = Mapper::new(&oils, &nm, &knows).unwrap();
    // Bare ground of other lightness and gloss, with the noise of the sensor.
    for pixel in 0..40 {
        let factor = 1.0 + 0.03 * (pixel as f64).sin();
        let gloss = 0.004 * (pixel as f64 * 0.7).cos();
        let bare = linen(&nm).into_iter().enumerate();
        spectra.extend(bare.map(|(band, r)| {
            let noise = 0.003 * ((pixel * 31 + band) as f64 * 12.9898).sin();
            (r * factor + gloss + noise) as f32
        }));
    }
    let book = knows.survey(&spectra, &Task::default()).unwrap();
    assert_eq!(book.entries.len(), 300, "the ground is not part of the survey");
    let maps = knows.map_block(&book, &spectra).unwrap();
    let told = maps.mask.iter().map(|mask| *mask == Mask::Ground).collect::<Vec<bool>>();
    assert_eq!(told.iter().filter(|ground| **ground).count(), 40, "{:?}", maps.mask);
    assert!(told[300..].iter().all(|ground| *ground), "the last 40 pixels");
    assert!(maps.share[300 * maps.pigments..].iter().all(|share| share.is_nan()), "no shares");
    // Without the spectrum of the ground these pixels are mapped as paint.
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    let maps = mapper.map_block(&book, &spectra).unwrap();
    assert!(maps.mask.iter().all(|mask| *mask != Mask::Ground), "{:?}", maps.mask);
    let error = knows.map_block(&book, &spectra).unwrap_err();
    assert!(matches!(error, MapError::OtherBook { .. }), "{error}");
    let short = Ground::new(nm[3..].to_vec(), linen(&nm[3..])).unwrap();
    let short = MapSettings { ground: Some(short), ..settings() };
    let error = Mapper::new(&oils, &nm, &short).unwrap_err();
    assert!(error.to_string().contains("400 nm") && error.hint().is_some(), "{error}");
}

/// Thin films of paint over linen: precision of what a map finds, and mean share error, without the ground.
fn of_thin_films(settings: &MapSettings) -> (f64, f64) {
    let (oils, nm) = oils();
    let names =
        ["Lead White", "Viridian", "Vermilion", "Cobalt Blue", "Chrome Yellow", "Bone Black"];
    let pairs = (0..names.len()).flat_map(|a| (a + 1..names.len()).map(move |b| (a, b)));
    let mut spectra: Vec<f32> = Vec::new();
    let mut truth = Vec::new();
    for (a, b) in pairs {
        let paint = oils.mix(oils.recipe([(names[a], 0.4), (names[b], 0.6)]).unwrap()).unwrap();
        for thickness in [0.5, 0.8, 1.2, 1.8, 2.5, 3.5] {
            let film = paint.film(thickness, &linen(&nm), oils.film());
            spectra.extend(film.iter().map(|value| *value as f32));
            truth.push([(names[a], 0.4), (names[b], 0.6)]);
        }
    }
    let mapper = Mapper::new(&oils, &nm, settings).unwrap();
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    let maps = mapper.map_block(&book, &spectra).unwrap();
    let (mut told, mut right, mut error, mut pixels) = (0.0, 0.0, 0.0, 0.0);
    for (pixel, truth) in truth.iter().enumerate() {
        if maps.mask[pixel] != Mask::Mapped {
            continue;
        }
        let columns = mapper.columns().iter().zip(pixel * maps.pigments..);
        let paint = || columns.clone().filter(|(column, _)| column.name != Ground::COLUMN);
        let all: f32 = paint().map(|(_, at)| maps.share[at]).sum();
        pixels += 1.0;
        for (column, at) in paint() {
            let own = truth.iter().filter(|(name, _)| column.pigments.iter().any(|p| p == name));
            let own: f64 = own.map(|(_, share)| share).sum();
            error += 0.5 * (own - f64::from(maps.share[at] / all.max(1e-6))).abs();
            if maps.presence[at] >= 0.5 {
                told += 1.0;
                right += f64::from(u8::from(own > 0.0));
            }
        }
    }
    assert!(pixels > 60.0, "{pixels} mapped");
    (right / told, error / pixels)
}

#[test]
fn ground_that_shows_through_is_a_column_and_no_paint() {
    let (_, nm) = oils();
    let without = of_thin_films(&settings());
    let ground = Some(Ground::new(nm.clone(), linen(&nm)).unwrap());
    let with = of_thin_films(&MapSettings { ground, ..settings() });
    println!("precision, share error: {without:?}, with the ground {with:?}");
    assert!(with.0 > without.0 + 0.1 && with.1 < without.1 - 0.02, "{without:?} {with:?}");
}

#[test]
fn a_survey_finds_the_palette_and_maps_know_it() {
    let (oils, nm) = oils();
    let palette = maps::accuracy::light_palette();
    let plan = PaintingPlan { pixels: 400, palette: palette.clone(), ..PaintingPlan::default() };
    let painting = Painting::simulate(&oils, &oils, &plan);
    let mapper = Mapper::new(&oils, &nm, &settings()).unwrap();
    let book = mapper.survey(&painting.spectra, &Task::default()).unwrap();
    // Whites and chrome yellows stand for each other.
    for name in ["Minium", "Vermilion", "Viridian", "Emerald Green", "Cobalt Blue", "Ultramarine"] {
        let inside = book.palette[place(&mapper, name)];
        assert!(inside > 0.1, "{name}: {inside}");
    }
    let whites = ["Zinc White", "Lead White", "Barium Sulphate", "Calcium Carbonate"]
        .map(|name| book.palette[place(&mapper, name)]);
    assert!(whites.into_iter().fold(0.0, f32::max) > 0.1, "a white: {whites:?}");
    for name in ["Prussian Blue", "Bone Black", "Cochineal Lake"] {
        let inside = book.palette[place(&mapper, name)];
        assert!(inside < 0.1, "{name}: {inside}");
    }
    // The palette is a prior: other pigments are told seldom, but they are told.
    let maps = mapper.map_block(&book, &painting.spectra).unwrap();
    let wrong = |maps: &BlockMaps| {
        let black = place(&mapper, "Bone Black");
        maps.presence.chunks_exact(maps.pigments).filter(|p| p[black] > 0.5).count()
    };
    let without = mapper.search(&painting.spectra).unwrap();
    assert!(wrong(&maps) < wrong(&without) || wrong(&without) == 0, "black where none is");
    let pink = oils.recipe([("Zinc White", 0.6), ("Cochineal Lake", 0.4)]).unwrap();
    let pink = oils.mix(pink).unwrap().hiding(oils.saunderson);
    let pink: Vec<f32> = pink.iter().map(|r| *r as f32).collect();
    let told = mapper.map_block(&book, &pink).unwrap();
    let lakes = ["Eosin Lake (wax)", "Eosin Lake", "Eosin Lake (lead, wax)", "Cochineal Lake"];
    let lakes: f32 = lakes.iter().map(|name| told.presence[place(&mapper, name)]).sum();
    assert!(lakes > 0.8, "a pixel of a lake, which no other holds: {:?}", told.presence);
}

#[test]
fn a_scan_of_two_paints_keeps_their_pigments() {
    let (oils, nm) = oils();
    let recipes = [&[("Zinc White", 0.8), ("Viridian", 0.2)][..], &[("Vermilion", 1.0)]];
    let films = recipes.map(|parts| {
        let mixture = oils.mix(oils.recipe(parts.iter().copied()).unwrap()).unwrap();
        let film: Vec<f32> = mixture.hiding(oils.saunderson).iter().map(|r| *r as f32).collect();
        film.repeat(20)
    });
    let spectra = films.concat();
    let mapper = Mapper::new(&oils, &nm, &settings()).unwrap();
    let book = mapper.survey(&spectra, &Task::default()).unwrap();
    for name in ["Viridian", "Vermilion"] {
        let inside = book.palette[place(&mapper, name)];
        assert!(inside > 0.3, "in one of two paints, {name}: {:?}", book.palette);
    }
    let maps = mapper.map_block(&book, &spectra).unwrap();
    let viridian = maps.share[place(&mapper, "Viridian")];
    assert!((viridian - 0.2).abs() < 0.02, "{:?}", &maps.share[..18]);
}

#[test]
fn settings_out_of_range_are_refused() {
    let (oils, nm) = oils();
    let usual = MapSettings { group_alike: false, ..MapSettings::default() };
    for wrong in [
        MapSettings { at_most: 0, ..usual.clone() },
        MapSettings { at_most: 5, ..usual.clone() },
        MapSettings { sensor_noise: f64::NAN, ..usual.clone() },
        MapSettings { penalty: -1.0, ..usual.clone() },
        MapSettings { model_error: Some(ModelError::Stated(10.0)), ..usual.clone() },
    ] {
        let error = Mapper::new(&oils, &nm, &wrong).unwrap_err();
        assert!(matches!(error, MapError::Setting { .. }), "{error}");
    }
    let twice = MapSettings { groups: vec![group("a"), group("b")], ..usual };
    let error = Mapper::new(&oils, &nm, &twice).unwrap_err();
    assert!(matches!(error, MapError::TwoGroups { .. }), "{error}");
    let long = group(&"w".repeat(70_000));
    let settings = MapSettings { groups: vec![long], ..MapSettings::default() };
    let error = Mapper::new(&oils, &nm, &settings).unwrap_err();
    assert!(matches!(error, MapError::GroupName { .. }), "{error}");
    assert!(error.to_string().ends_with("expected a name of at most 200 letters"), "{error}");
}

fn group(name: &str) -> PigmentGroup {
    PigmentGroup { name: name.to_owned(), pigments: vec!["Zinc White".to_owned()] }
}

#[test]
fn pigments_that_look_alike_are_grouped_and_others_are_not() {
    let (oils, nm) = oils();
    let mapper = Mapper::new(&oils, &nm, &MapSettings::default()).unwrap();
    let column = |name: &str| {
        mapper.columns().iter().position(|c| c.pigments.iter().any(|p| p == name)).unwrap()
    };
    assert_eq!(column("Eosin Lake"), column("Eosin Lake (wax)"), "eosins");
    assert_eq!(column("Zinc White"), column("Lead White"), "whites");
    assert_ne!(column("Viridian"), column("Cobalt Blue"), "a green and a blue");
    assert_ne!(column("Zinc White"), column("Bone Black"), "white and black");
}

#[test]
fn the_oils_that_ship_err_like_their_left_out_mixtures() {
    let (oils, nm) = oils();
    let shipped = ModelError::Residuals(Residuals::van_gogh_oils());
    let usual = Mapper::new(&oils, &nm, &MapSettings::default()).unwrap();
    assert_eq!(*usual.model_error(), shipped);
    let given = MapSettings { model_error: Some(shipped), ..MapSettings::default() };
    let given = Mapper::new(&oils, &nm, &given).unwrap();
    assert_eq!(given.identity(), usual.identity(), "the default is the file that ships");
    let other = PigmentLibrary { title: "others".to_owned(), ..oils.clone() };
    let other = Mapper::new(&other, &nm, &MapSettings::default()).unwrap();
    assert_eq!(*other.model_error(), ModelError::Stated(0.1));
}

#[test]
fn books_of_other_residuals_are_refused_with_both() {
    let (oils, nm) = oils();
    let (_, spectra) = scan(30);
    let with = |residuals: Residuals| {
        let model_error = Some(ModelError::Residuals(residuals));
        Mapper::new(&oils, &nm, &MapSettings { model_error, ..settings() })
    };
    let mut half = Residuals::van_gogh_oils();
    half.mixtures.truncate(32);
    let first = with(half.clone()).unwrap();
    let book = first.survey(&spectra, &Task::default()).unwrap();
    let error = with(Residuals::van_gogh_oils()).unwrap().open_book(&book).unwrap_err();
    let words = error.to_string();
    assert!(words.contains("32 left-out") && words.contains(&half.sha256()), "{words}");
    assert!(words.contains("65 left-out") && error.hint().is_some(), "{words}");
    half.mixtures.truncate(9);
    let few = with(half).unwrap_err();
    let expected = ResidualsError::Few { found: 9, least: maps::LEAST_MIXTURES };
    assert_eq!(few, MapError::Residuals(expected));
}

#[test]
fn few_pigments_and_few_bands_suffice() {
    let (oils, _) = oils();
    let nm = [410.0, 460.0, 520.0, 590.0, 640.0, 690.0];
    let palette = vec!["Zinc White".to_owned(), "Viridian".to_owned()];
    let mapper = Mapper::new(&oils, &nm, &MapSettings { palette, ..settings() }).unwrap();
    let recipe = oils.recipe([("Zinc White", 0.7), ("Viridian", 0.3)]).unwrap();
    let film = oils.mix(recipe).unwrap().hiding(oils.saunderson);
    let seen = nm.map(|nm: f64| film[((nm - 400.0) / 10.0) as usize] as f32);
    let maps = mapper.search(&seen).unwrap();
    assert!((maps.share[1] - 0.3).abs() < 0.03, "{:?}", maps.share);
    let palette = vec!["Viridian".to_owned()];
    let one = Mapper::new(&oils, &nm, &MapSettings { palette, ..settings() }).unwrap();
    assert_eq!(one.search(&seen).unwrap().mask, [Mask::OutOfGamut], "it holds white too");
    let pure = oils.mix(oils.recipe([("Viridian", 1.0)]).unwrap()).unwrap();
    let pure = pure.hiding(oils.saunderson);
    assert_eq!(
        one.search(&nm.map(|nm: f64| pure[((nm - 400.0) / 10.0) as usize] as f32)).unwrap().share,
        [1.0]
    );
}

#[test]
fn a_survey_ends_when_it_is_cancelled() {
    let (mapper, spectra) = scan(20);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let cancellation = Cancellation::default();
    let ends = cancellation.clone();
    let task = Task::observed(move |progress| {
        if progress.done == 3 {
            ends.cancel();
        }
    });
    let task = task.until(cancellation);
    let error = pool.install(|| mapper.survey(&spectra, &task).unwrap_err());
    assert!(matches!(error, MapError::Cancelled(_)) && error.hint().is_some(), "{error:?}");
    assert_eq!(task.progress().done, 3, "pixels were searched after the cancellation");
}
