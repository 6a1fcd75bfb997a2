//! A map by request equals a map by settings that are made in code. The scan is small and in
//! memory.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::io;
use std::sync::Arc;

use calibrate::Residuals;
use documents::Task;
use documents::hint::{Explain, Fault};
use maps::cube::{CubeOptions, ReadAt, ScanFile};
use maps::{
    Book, Cube, GroundSource, MapRequest, MapRequestError, MapSettings, ModelError, Region,
    StoreMode, SurveyedScan,
};
use pigment::PigmentLibrary;

const LINES: usize = 6;
const SAMPLES: usize = 8;

#[derive(Debug)]
struct Memory(Vec<u8>);

impl ReadAt for Memory {
    fn bytes(&self) -> u64 {
        self.0.len() as u64
    }

    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        let from = usize::try_from(position).unwrap();
        buffer.copy_from_slice(&self.0[from..from + buffer.len()]);
        Ok(())
    }
}

/// A scan of bare linen in its first two rows, of white in its left half and of green in the right one.
fn cube(oils: &PigmentLibrary) -> Cube {
    let recipes = [&[("Zinc White", 1.0)][..], &[("Zinc White", 1.0), ("Viridian", 1.0)]];
    let [white, green] = recipes.map(|parts| {
        let recipe = oils.recipe(parts.iter().copied()).unwrap();
        oils.mix(recipe).unwrap().hiding(oils.saunderson)
    });
    let linen: Vec<f64> = (0..white.len()).map(|band| 0.3 + 0.006 * band as f64).collect();
    let mut bytes = Vec::new();
    for line in 0..LINES {
        for sample in 0..SAMPLES {
            let spectrum = match (line, sample) {
                (0..2, _) => &linen,
                (_, 0..4) => &white,
                _ => &green,
            };
            bytes.extend(spectrum.iter().flat_map(|value| (*value as f32).to_le_bytes()));
        }
    }
    let nm: Vec<String> = oils.grid.wavelengths_nm().map(|nm| nm.to_string()).collect();
    let header = format!(
        "ENVI\nsamples = {SAMPLES}\nlines = {LINES}\nbands = {}\nheader offset = 0\ndata type = 4\n\
         interleave = bip\nbyte order = 0\nwavelength units = Nanometers\nwavelength = {{{}}}\n",
        nm.len(),
        nm.join(", ")
    );
    let files = [("scan.hdr", header.into_bytes()), ("scan.img", bytes)]
        .map(|(name, bytes)| ScanFile { name: name.into(), contents: Arc::new(Memory(bytes)) });
    Cube::of_files(&files, &CubeOptions::default()).unwrap()
}

fn request() -> MapRequest {
    MapRequest {
        at_most: 2,
        palette: ["Zinc White", "Viridian", "Vermilion"].map(str::to_owned).to_vec(),
        apart: true,
        noise: Some(0.004),
        model_error: Some(0.05),
        ground: Some(GroundSource::Region(Region { rows: 0..2, columns: 0..SAMPLES })),
        penalty: 1.5,
        region: Some(Region { rows: 0..LINES, columns: 1..7 }),
        spots: vec![Region { rows: 3..4, columns: 5..6 }],
        ..MapRequest::default()
    }
}

#[test]
fn settings_are_what_the_request_says() {
    let oils = PigmentLibrary::van_gogh_oils();
    let cube = cube(&oils);
    let settings = request().settings(&cube, &oils).unwrap();
    let expected = MapSettings {
        at_most: 2,
        palette: ["Zinc White", "Viridian", "Vermilion"].map(str::to_owned).to_vec(),
        groups: Vec::new(),
        group_alike: false,
        sensor_noise: 0.004,
        model_error: Some(ModelError::Stated(0.05)),
        penalty: 1.5,
        ground: Some(Region { rows: 0..2, columns: 0..SAMPLES }.ground(&cube).unwrap()),
    };
    assert_eq!(settings, expected);
    assert_eq!(MapRequest::default().settings(&cube, &oils).unwrap(), MapSettings::default());
}

#[test]
fn a_run_maps_the_scan_and_its_spots() {
    let oils = PigmentLibrary::van_gogh_oils();
    let folder = tempfile::tempdir().unwrap();
    let maps = folder.path().join("maps.zarr");
    let task = Task::default();
    let mapped = request().run(cube(&oils), &oils, &maps, StoreMode::New, &task).unwrap();
    let by_hand = SurveyedScan::survey(
        cube(&oils),
        &oils,
        &request().settings(&cube(&oils), &oils).unwrap(),
        request().region,
        &task,
    );
    assert_eq!(mapped.scan.about(), by_hand.unwrap().about());
    let text = mapped.scan.book().to_json().unwrap();
    let again = Book::from_json(&text).unwrap();
    let again = request().survey(cube(&oils), &oils, Some(again), &task).unwrap();
    assert_eq!(again.about(), mapped.scan.about());
    assert_eq!(mapped.outcome.pixels.all(), 6 * 6);
    let [green] = &mapped.spots[..] else { panic!("{:?}", mapped.spots) };
    let names: Vec<&str> = green.pigments.iter().map(|found| found.name.as_str()).collect();
    assert!(names.contains(&"Viridian") && !names.contains(&"Vermilion"), "{names:?}");
    let twice = request().run(cube(&oils), &oils, &maps, StoreMode::New, &task).unwrap_err();
    assert!(matches!(twice, MapRequestError::Store(_)), "{twice}");
}

#[test]
fn files_that_cannot_be_used_are_refused_with_their_path_and_a_way_out() {
    let oils = PigmentLibrary::van_gogh_oils();
    let cube = cube(&oils);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("few.json");
    let mut few = Residuals::van_gogh_oils();
    few.mixtures.truncate(9);
    few.save(&path).unwrap();
    let ground = Some(GroundSource::File("no-such-file.csv".to_owned()));
    let plain = MapRequest { ground: None, ..request() };
    let stated = MapRequest { model_error: None, residuals: Some(path), ..plain.clone() };
    let both = MapRequest { model_error: Some(0.1), ..stated.clone() };
    for (request, message, fault) in [
        (stated, "few.json cannot be used", Fault::Input),
        (both, "residuals and model_error exclude each other", Fault::Setting),
        (MapRequest { ground, ..plain }, "ground takes a region or a file", Fault::Environment),
    ] {
        let error = request.settings(&cube, &oils).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
        assert!(error.hint().is_some(), "no way out of: {error}");
        assert_eq!(error.fault(), fault, "{error}");
    }
}
