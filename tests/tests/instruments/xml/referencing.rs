//! Reflectance from detector counts, also on the command line: made-up counts of a grey of known
//! reflectance, its white and darks, with integration times, saturation and noise.

use std::path::Path;

use calibrate::library::PigmentLibrary;
use documents::hint::Explain;
use spectra::instrument::{MeasuredQuantity, MeasuredSpectrum, Role, Unit};
use spectra::referencing::{Dark, Referencing, ReferencingError, Tile};
use suite::program::impasto;

/// A reading of `counts(nm)` at unevenly spaced pixels from 340 to 860 nm.
fn reading(name: &str, time_ms: Option<f64>, counts: impl Fn(f64) -> f64) -> MeasuredSpectrum {
    let wavelengths_nm: Vec<f64> =
        (0..260).map(|i| 340.0 + 2.0 * f64::from(i) + 0.3 * f64::from(i % 3)).collect();
    let time = time_ms.map(|ms| ("Integration Time (ms)".to_owned(), ms.to_string()));
    MeasuredSpectrum {
        name: name.to_owned(),
        quantity: MeasuredQuantity::Counts,
        role: Role::Main,
        unit: Unit::Unstated,
        values: wavelengths_nm.iter().map(|&nm| counts(nm)).collect(),
        wavelengths_nm,
        line: 1,
        point_lines: Vec::new(),
        details: time.into_iter().collect(),
        remarks: Vec::new(),
    }
}

const TILE: f64 = 0.98;

fn lamp(nm: f64) -> f64 {
    400.0 + 1.5 * (nm - 340.0)
}

/// Dark counts: offset plus dark current during `ms` milliseconds.
fn dark(ms: f64, nm: f64) -> f64 {
    1000.0 + 0.1 * nm + 3.0 * ms
}

fn grey(nm: f64) -> f64 {
    0.2 + 0.3 * (nm - 340.0) / 520.0
}

/// Sample, white and a dark for each of the integration times `sample_ms` and `white_ms`.
fn measured(
    sample_ms: f64,
    white_ms: f64,
) -> (MeasuredSpectrum, MeasuredSpectrum, Vec<MeasuredSpectrum>) {
    fn light(ms: f64, reflectance: impl Fn(f64) -> f64, nm: f64) -> f64 {
        reflectance(nm) * lamp(nm) * ms + dark(ms, nm)
    }
    (
        reading("grey", Some(sample_ms), |nm| light(sample_ms, grey, nm)),
        reading("white", Some(white_ms), |nm| light(white_ms, |_| TILE, nm)),
        [sample_ms, white_ms].map(|ms| reading("dark", Some(ms), |nm| dark(ms, nm))).into(),
    )
}

fn against(white: &MeasuredSpectrum, darks: &[MeasuredSpectrum]) -> Referencing {
    Referencing {
        white: white.clone(),
        dark: Dark::Readings(darks.to_vec()),
        tile: Tile::even(TILE).unwrap(),
        full_scale: Some(65535.0),
        least_light: 0.01,
    }
}

#[test]
fn a_grey_comes_out_as_it_went_in() {
    for (sample_ms, white_ms) in [(10.0, 10.0), (40.0, 10.0)] {
        let (sample, white, darks) = measured(sample_ms, white_ms);
        let found = against(&white, &darks).reflectance(&sample).unwrap();
        assert_eq!(found.wavelengths_nm, sample.wavelengths_nm, "{sample_ms} ms");
        for (&nm, &value) in found.wavelengths_nm.iter().zip(&found.values) {
            assert!((value - grey(nm)).abs() < 1e-12, "{sample_ms} ms, {nm} nm: {value}");
        }
        let kind = (found.quantity, found.unit, found.remarks.len());
        let remarks = usize::from(sample_ms != white_ms);
        assert_eq!(kind, (MeasuredQuantity::Reflectance, Unit::Fraction, remarks), "{found:?}");
    }
}

#[test]
fn other_pixels_are_joined_by_straight_lines() {
    let (sample, mut white, mut darks) = measured(10.0, 10.0);
    for record in std::iter::once(&mut white).chain(&mut darks) {
        // Light and dark are linear in the wavelength, so every second pixel determines the others.
        for values in [&mut record.wavelengths_nm, &mut record.values] {
            *values = values.iter().copied().step_by(2).collect();
        }
    }
    let found = against(&white, &darks).reflectance(&sample).unwrap();
    for (&nm, &value) in found.wavelengths_nm.iter().zip(&found.values) {
        assert!((value - grey(nm)).abs() < 1e-12, "{nm} nm: {value}");
    }
    // The last pixel of the sample is beyond the last pixel of the white.
    assert_eq!(found.values.len() + 1, sample.values.len(), "{:?}", found.remarks);
    assert!(found.remarks[0].contains("the white has no value"), "{:?}", found.remarks);
}

#[test]
fn a_dark_of_another_time_is_refused_with_both_times() {
    let (sample, white, darks) = measured(40.0, 10.0);
    let error = against(&white, &darks[1..]).reflectance(&sample).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the sample `grey` was integrated for 40 ms, but no dark was; found `10 ms`"
    );
    let none = against(&white, &[]).reflectance(&sample).unwrap_err();
    assert!(matches!(none, ReferencingError::NoDark { role: "sample", .. }), "{none}");
    let (mut unsaid, ..) = measured(40.0, 10.0);
    unsaid.details.clear();
    let error = against(&white, &darks).reflectance(&unsaid).unwrap_err();
    assert!(matches!(error, ReferencingError::UnknownTime { darks: 2, .. }), "{error}");
}

#[test]
fn a_dark_subtracted_before_is_not_subtracted_again() {
    let sample = reading("grey", None, |nm| grey(nm) * lamp(nm));
    let white = reading("white", None, |nm| TILE * lamp(nm));
    let referencing = Referencing { dark: Dark::Subtracted, ..against(&white, &[]) };
    let found = referencing.reflectance(&sample).unwrap();
    assert!((found.values[100] - grey(found.wavelengths_nm[100])).abs() < 1e-12, "{found:?}");
}

#[test]
fn saturation_is_refused_where_the_eye_sees_and_cut_off_beyond() {
    let (sample, mut white, darks) = measured(10.0, 10.0);
    let [seen, beyond] =
        [600.0, 780.0].map(|nm| white.wavelengths_nm.iter().position(|&w| w >= nm).unwrap());
    let kept = white.values[seen];
    white.values[seen] = 65535.0;
    let error = against(&white, &darks).reflectance(&sample).unwrap_err();
    let ReferencingError::Saturated { role: "white", nm, .. } = error else { panic!("{error}") };
    assert_eq!(nm, white.wavelengths_nm[seen]);
    white.values[seen] = kept;
    white.values[beyond] = 65535.0;
    let found = against(&white, &darks).reflectance(&sample).unwrap();
    assert_eq!(found.values.len(), beyond, "{:?}", found.remarks);
    assert!(found.remarks[0].contains("saturated"), "{:?}", found.remarks);
    // Without a given full scale, several neighbouring pixels at the maximum count as saturated.
    let flat =
        reading("grey", Some(10.0), |nm| (grey(nm) * lamp(nm) * 10.0 + dark(10.0, nm)).min(3000.0));
    let guessing = Referencing { full_scale: None, ..against(&white, &darks) };
    let error = guessing.reflectance(&flat).unwrap_err();
    assert!(matches!(error, ReferencingError::Saturated { role: "sample", .. }), "{error}");
}

#[test]
fn too_little_light_is_refused_where_the_eye_sees_and_cut_off_beyond() {
    let (sample, mut white, darks) = measured(10.0, 10.0);
    let [below, seen] =
        [360.0, 500.0].map(|nm| white.wavelengths_nm.iter().position(|&w| w >= nm).unwrap());
    white.values[below] = darks[0].values[below];
    let found = against(&white, &darks).reflectance(&sample).unwrap();
    assert_eq!(found.wavelengths_nm[0], white.wavelengths_nm[below + 1], "{:?}", found.remarks);
    white.values[seen] = darks[0].values[seen] + 20.0;
    let error = against(&white, &darks).reflectance(&sample).unwrap_err();
    assert!(error.to_string().contains("too little light at"), "{error}");
    assert!(error.hint().unwrap().to_string().contains("least_light"), "{error}");
    let faint = Referencing { least_light: 0.0, ..against(&white, &darks) };
    assert!(faint.reflectance(&sample).is_ok(), "with a limit of 0 little light is enough");
}

#[test]
fn a_noisy_dark_asks_for_more_light() {
    let (sample, white, mut darks) = measured(10.0, 10.0);
    for dark in &mut darks {
        for (value, i) in dark.values.iter_mut().zip(0..) {
            *value += if i % 2 == 0 { 3000.0 } else { -3000.0 };
        }
    }
    let error = against(&white, &darks).reflectance(&sample).unwrap_err();
    assert!(matches!(error, ReferencingError::Dim { least, .. } if least > 9000.0), "{error}");
}

#[test]
fn power_needs_no_dark_and_no_time() {
    fn power(name: &str, ms: f64, reflectance: impl Fn(f64) -> f64) -> MeasuredSpectrum {
        let mut record = reading(name, Some(ms), |nm| reflectance(nm) * lamp(nm));
        record.quantity = MeasuredQuantity::Power;
        record
    }
    let sample = power("grey", 40.0, grey);
    let white = power("white", 10.0, |_| TILE);
    let found = against(&white, &[]).reflectance(&sample).unwrap();
    assert!((found.values[7] - grey(found.wavelengths_nm[7])).abs() < 1e-12, "{found:?}");
    assert_eq!(found.remarks, ["no dark was subtracted"]);
    let (counts, ..) = measured(10.0, 10.0);
    let error = against(&white, &[]).reflectance(&counts).unwrap_err();
    assert!(matches!(error, ReferencingError::Mixed { role: "white", .. }), "{error}");
}

#[test]
fn a_measured_tile_counts_as_it_is() {
    let (sample, white, darks) = measured(10.0, 10.0);
    for (unit, scale) in [(Unit::Fraction, 1.0), (Unit::Percent, 100.0), (Unit::Unstated, 100.0)] {
        let mut tile = reading("tile", None, |nm| scale * (0.5 + 0.0001 * nm));
        (tile.quantity, tile.unit) = (MeasuredQuantity::Reflectance, unit);
        let tile = Tile::measured(&tile).unwrap();
        let found = Referencing { tile, ..against(&white, &darks) }.reflectance(&sample).unwrap();
        let nm = found.wavelengths_nm[9];
        let wanted = grey(nm) * (0.5 + 0.0001 * nm) / TILE;
        assert!((found.values[9] - wanted).abs() < 1e-12, "{unit:?}: {}", found.values[9]);
    }
    let mut short = reading("tile", None, |_| 0.9);
    short.quantity = MeasuredQuantity::Reflectance;
    short.wavelengths_nm.iter_mut().for_each(|nm| *nm += 60.0);
    let tile = Tile::measured(&short).unwrap();
    let error = Referencing { tile, ..against(&white, &darks) }.reflectance(&sample).unwrap_err();
    assert!(matches!(error, ReferencingError::Uncovered { role: "tile", .. }), "{error}");
    assert!(Tile::measured(&white).is_err(), "counts are not a tile");
    assert!(Tile::even(99.0).is_err() && Tile::even(0.0).is_err(), "no fraction");
}

#[test]
fn a_sample_below_its_dark_is_refused_and_noise_is_black() {
    let (_, white, darks) = measured(10.0, 10.0);
    fn below(share: f64) -> MeasuredSpectrum {
        reading("black", Some(10.0), move |nm| dark(10.0, nm) - share * lamp(nm) * 10.0)
    }
    let black = against(&white, &darks).reflectance(&below(0.005)).unwrap();
    assert!(black.values.iter().all(|&value| value == 0.0), "{:?}", black.values);
    let error = against(&white, &darks).reflectance(&below(0.02)).unwrap_err();
    assert!(matches!(error, ReferencingError::BelowDark { .. }), "{error}");
}

#[test]
fn a_measured_tile_is_a_smooth_curve_between_its_wavelengths() {
    fn ceramic(nm: f64) -> f64 {
        0.85 / (1.0 + f64::exp(-(nm - 395.0) / 12.0))
    }
    let (sample, white, darks) = measured(10.0, 10.0);
    let nm: Vec<f64> = (0..52).map(|i| 345.0 + 10.0 * f64::from(i)).collect();
    let tile = MeasuredSpectrum {
        quantity: MeasuredQuantity::Reflectance,
        unit: Unit::Fraction,
        values: nm.iter().map(|&nm| ceramic(nm)).collect(),
        wavelengths_nm: nm,
        ..sample.clone()
    };
    let referencing =
        Referencing { tile: Tile::measured(&tile).unwrap(), ..against(&white, &darks) };
    let found = referencing.reflectance(&sample).unwrap();
    for (&nm, value) in found.wavelengths_nm.iter().zip(&found.values) {
        let wanted = grey(nm) / TILE * ceramic(nm);
        assert!(nm < 380.0 || (value - wanted).abs() < 5e-5, "{value} for {wanted} at {nm} nm");
    }
}

/// Writes the counts `of` each wavelength, every 10 nm from 380 to 730 nm. Returns the path.
fn counts(folder: &Path, name: &str, of: impl Fn(f64) -> f64) -> String {
    let lines = (0..36).map(|i| 380.0 + 10.0 * f64::from(i));
    let lines: String = lines.map(|nm| format!("{nm}\t{}\n", of(nm))).collect();
    let path = folder.join(name);
    std::fs::write(&path, format!("nm\tcounts\n{lines}")).unwrap();
    path.to_str().unwrap().to_owned()
}

fn lamp_of_counts(nm: f64) -> f64 {
    200.0 + nm
}

#[test]
fn a_grey_has_its_color_by_way_of_counts() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let white = counts(folder, "white.txt", |nm| 100.0 + lamp_of_counts(nm));
    let dark = counts(folder, "dark.txt", |_| 100.0);
    let half = counts(folder, "half.txt", |nm| 100.0 + 0.5 * lamp_of_counts(nm));
    let csv = folder.join("grey.csv");
    std::fs::write(&csv, "sample,380,480,580,680,730\nhalf,0.49,0.49,0.49,0.49,0.49\n").unwrap();
    let wanted = impasto(&["color", csv.to_str().unwrap(), "--json"]).json();
    let run =
        impasto(&["color", &half, "--white", &white, "--dark", &dark, "--tile", "0.98", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let found = run.json();
    for axis in 0..3 {
        let [found, wanted] = [&found, &wanted].map(|json| json[0]["lab"][axis].as_f64().unwrap());
        assert!((found - wanted).abs() < 1e-9, "{axis}: {found}, {wanted}");
    }
    let bare = impasto(&["color", &half, "--white", &white, "--dark", "0", "--json"]);
    assert!(bare.err.contains("the white is taken") && bare.err.contains("--tile"), "{}", bare.err);
    let lighter = bare.json()[0]["xyz"][1].as_f64().unwrap();
    assert!(lighter > wanted[0]["xyz"][1].as_f64().unwrap(), "the dark was left in: {lighter}");
}

#[test]
fn faults_name_both_files_and_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let white =
        counts(
            folder,
            "white.txt",
            |nm| if nm == 500.0 { 101.0 } else { 100.0 + lamp_of_counts(nm) },
        );
    let dark = counts(folder, "dark.txt", |_| 100.0);
    let half = counts(folder, "half.txt", |nm| 100.0 + 0.5 * lamp_of_counts(nm));
    let run = impasto(&["color", &half, "--white", &white, "--dark", &dark]);
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["half.txt: cannot be divided by", "white.txt", "500 nm", "--least-light"] {
        assert!(run.err.contains(word), "{word}: {}", run.err);
    }
    let run = impasto(&["color", &half, "--white", &white]);
    assert!(run.err.contains("hint: add --dark-reading FILE"), "{}", run.err);
    let run = impasto(&["color", &half]);
    assert!(run.status == 1 && run.err.contains("counts"), "{}", run.err);
    let run = impasto(&["color", &half, "--dark", &dark]);
    assert!(run.status == 2 && run.err.contains("--white"), "{}", run.err);
    let run = impasto(&["color", &half, "--white", &white, "--dark", &dark, "--tile", "99"]);
    assert!(run.status == 1 && run.err.contains("--tile 0.99"), "{}", run.err);
}

#[test]
fn a_library_names_the_references_among_its_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let white = counts(folder, "white.txt", lamp_of_counts);
    let paint = counts(folder, "paint.txt", |nm| 0.9 * lamp_of_counts(nm));
    let blue = counts(folder, "blue.txt", |nm| (0.5 - nm / 2000.0) * lamp_of_counts(nm));
    let mixed = counts(folder, "mixed.txt", |nm| (0.8 - nm / 2000.0) * lamp_of_counts(nm));
    let recipes = folder.join("recipes.csv");
    let table = "sample,white,blue\npaint,1,\nblue,,1\nmixed,1,1\n";
    std::fs::write(&recipes, table).unwrap();
    let library = folder.join("library.json");
    let recipes = recipes.to_str().unwrap();
    let output = library.to_str().unwrap();
    let fit =
        ["fit", &paint, &blue, &mixed, "--white", &white, "--dark", "0", "--recipes", recipes];
    let run = impasto(&[&fit[..], &["--output", output]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let text = std::fs::read_to_string(&library).unwrap();
    let library = PigmentLibrary::from_json("library.json", &text).unwrap();
    let inputs: Vec<_> = library.inputs.iter().map(|input| input.path.as_str()).collect();
    assert_eq!(inputs, [&paint, &blue, &mixed, &white, recipes], "{text}");
    let run = impasto(&[&fit[..], &["--output", &white]].concat());
    assert!(run.status != 0 && run.err.contains("white.txt"), "over an input: {}", run.err);
}
