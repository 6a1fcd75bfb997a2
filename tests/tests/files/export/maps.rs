//! Export of pigment maps: scale, file names, table of volumes, refused maps.

use graphics::field::Field;
use paint::export::{NamedFile, PigmentMap, pigment_maps};
use suite::near::assert_near;

fn map(name: &str, height_mm: impl Fn(usize) -> f32) -> PigmentMap {
    let values = (0..12).map(height_mm).collect();
    PigmentMap { name: name.to_owned(), height_mm: Field::from_values(4, 3, values) }
}

fn three() -> Vec<PigmentMap> {
    vec![
        map("Zinc White", |i| i as f32 * 0.01),
        map("Blue, \"dark\"", |i| if i == 11 { 0.09 } else { 0.0 }),
        map("Zinc white", |_| 0.0),
    ]
}

fn file<'a>(files: &'a [NamedFile], name: &str) -> &'a [u8] {
    let names: Vec<_> = files.iter().map(|file| &file.name).collect();
    let found = files.iter().find(|file| file.name == name);
    &found.unwrap_or_else(|| panic!("no {name} in {names:?}")).bytes
}

#[test]
fn maps_give_millimetres_back_by_their_scale() {
    let files = pigment_maps("study", &three(), 0.2).unwrap();
    let sidecar: serde_json::Value =
        serde_json::from_slice(file(&files, "study.maps.json")).unwrap();
    let scale = sidecar["mm_at_65535"].as_f64().unwrap();
    // The scale is the thickness of the thickest cell: 0.11 mm of white and 0.09 mm of blue.
    assert_near("scale", &[scale], &[0.2], 1e-7);
    assert_eq!(sidecar["width_mm"], 0.8);
    for (index, map) in three().iter().enumerate() {
        assert_eq!(sidecar["maps"][index]["pigment"], *map.name);
        let png = file(&files, sidecar["maps"][index]["file"].as_str().unwrap());
        let image = image::load_from_memory(png).unwrap();
        let grey = image.as_luma16().unwrap();
        let got: Vec<f64> = grey.iter().map(|v| f64::from(*v) * scale / 65535.0).collect();
        let wanted: Vec<f64> = map.height_mm.values().iter().map(|mm| f64::from(*mm)).collect();
        assert_near(&map.name, &got, &wanted, 0.51 * scale / 65535.0);
    }
    let total = file(&files, sidecar["thickness"]["file"].as_str().unwrap());
    let total = image::load_from_memory(total).unwrap();
    assert_eq!(total.as_luma16().unwrap().iter().max(), Some(&65535));
    let names: Vec<_> = files.iter().map(|file| file.name.as_str()).collect();
    let wanted = [
        "study.zinc-white.png",
        "study.blue---dark-.png",
        "study.zinc-white-2.png",
        "study.thickness.png",
        "study.maps.json",
        "study.recipe.csv",
    ];
    assert_eq!(names, wanted);
}

#[test]
fn the_recipe_tells_volumes_and_shares() {
    let files = pigment_maps("study", &three(), 0.2).unwrap();
    let mut table = csv::Reader::from_reader(file(&files, "study.recipe.csv"));
    let rows: Vec<_> = table.records().map(|row| row.unwrap()).collect();
    assert_eq!(rows[1][0], *"Blue, \"dark\"");
    let figures = |row: usize| -> Vec<f64> {
        rows[row].iter().skip(1).map(|text| text.parse().unwrap()).collect()
    };
    // The heights of white sum to 0.66 mm over 12 cells of 0.04 mm2; one cell has 0.09 mm of blue.
    assert_near("white", &figures(0), &[0.0264, 0.88, 0.055, 0.11, 11.0 / 12.0], 1e-5);
    assert_near("blue", &figures(1), &[0.0036, 0.12, 0.0075, 0.09, 1.0 / 12.0], 1e-5);
    assert_near("none", &figures(2), &[0.0; 5], 0.0);
}

#[test]
fn no_paint_makes_black_maps() {
    let files = pigment_maps("bare", &[map("Zinc White", |_| 0.0)], 0.2).unwrap();
    let image = image::load_from_memory(file(&files, "bare.zinc-white.png")).unwrap();
    assert!(image.as_luma16().unwrap().iter().all(|v| *v == 0), "black");
}

#[test]
fn maps_that_are_no_amounts_are_refused() {
    let odd = PigmentMap { name: "B".to_owned(), height_mm: Field::filled(3, 4, 0.0) };
    let cases = [
        (vec![], "found `0 x 0`"),
        (vec![map("A", |_| 0.0), odd], "`B` has another size than the picture of 4 x 3"),
        (vec![map("A", |i| if i == 6 { -0.5 } else { 0.0 })], "A at x 2, y 1 is 0 and up"),
        (vec![map("A", |i| if i == 6 { f32::NAN } else { 0.0 })], "A at x 2, y 1 is no finite"),
    ];
    for (maps, wanted) in cases {
        let error = pigment_maps("x", &maps, 0.1).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error} for {wanted}");
    }
}
