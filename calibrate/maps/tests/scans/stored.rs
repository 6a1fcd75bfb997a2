//! Finished maps, read back and drawn.

use documents::hint::Explain;
use maps::pictures::{Overview, Ramp, picture_png};
use maps::pixel_maps::{BlockMaps, Mask};
use maps::store::{MapStore, StoreMode, StoredMaps};

use crate::store::{about, maps_of};

const ROWS: usize = 300;
const COLUMNS: usize = 530;

/// Writes maps of a region that begins at row 10 and column 20 of its scan.
fn write(folder: &std::path::Path) -> MapStore {
    let mut about = about(ROWS, COLUMNS, 3);
    (about.rows, about.columns) = (10..10 + ROWS, 20..20 + COLUMNS);
    let store = MapStore::create(folder.join("maps.zarr"), &about, StoreMode::New).unwrap();
    for shard in store.shards() {
        let mut writer = store.writer(shard);
        let maps = maps_of(shard.rows.clone(), shard.columns.clone(), 3);
        writer.add(shard.rows.clone(), &maps).unwrap();
        writer.finish().unwrap();
    }
    store
}

/// Checks numbers against those that were written, to the precision of the store.
fn check(found: &BlockMaps, expected: &BlockMaps) {
    assert_eq!(found.mask, expected.mask, "masks");
    assert_eq!(found.second, expected.second, "second");
    for (found, expected, within, name) in [
        (&found.share, &expected.share, 5e-4, "share"),
        (&found.share_sd, &expected.share_sd, 1e-4, "share_sd"),
        (&found.presence, &expected.presence, 0.0021, "presence"),
        (&found.chi2, &expected.chi2, 0.0, "chi2"),
        (&found.rms, &expected.rms, 0.0, "rms"),
    ] {
        assert_eq!(found.len(), expected.len(), "{name}");
        for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
            let equal = found.is_nan() && expected.is_nan() || (found - expected).abs() <= within;
            assert!(equal, "{name}, number {at}: {found}, expected {expected}");
        }
    }
}

#[test]
fn any_rectangle_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let store = write(folder.path());
    let maps = StoredMaps::open(store.path()).unwrap();
    assert_eq!((maps.rows(), maps.columns()), (10..310, 20..550));
    assert_eq!(maps.pigments(), ["Pigment 0", "Pigment 1", "Pigment 2"]);
    assert_eq!(maps.attributes()["library_sha256"], "a1");
    for (rows, columns) in [
        (10..310, 20..550),
        (10..11, 20..21),
        (260..275, 270..540),
        (309..310, 549..550),
        (30..30, 20..30),
    ] {
        let found = maps.read(rows.clone(), columns.clone()).unwrap();
        check(&found, &maps_of(rows, columns, 3));
    }
    for (rows, columns) in [(9..20, 20..30), (10..20, 20..551)] {
        let error = maps.read(rows, columns).unwrap_err().to_string();
        assert!(error.contains("are not mapped, only rows 10 to 310"), "{error}");
    }
}

#[test]
fn unfinished_and_damaged_maps_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let store = write(folder.path());
    let share = store.path().join("share/c/0/0/0");
    let mut bytes = std::fs::read(&share).unwrap();
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    std::fs::write(&share, bytes).unwrap();
    let maps = StoredMaps::open(store.path()).unwrap();
    let error = maps.read(10..12, 20..22).unwrap_err();
    assert!(error.to_string().contains("the checksum of a chunk does not fit"), "{error}");
    std::fs::remove_file(store.path().join("mask/c/0/0")).unwrap();
    let error = StoredMaps::open(store.path()).unwrap_err();
    assert!(error.to_string().ends_with("1 of 1 shards are not written yet"), "{error}");
    assert!(error.hint().unwrap().to_string().contains("`resume`"), "{error}");
    std::fs::write(store.path().join("zarr.json"), "{}").unwrap();
    let error = StoredMaps::open(store.path()).unwrap_err();
    assert!(error.to_string().ends_with("describes no pigment maps"), "{error}");
    assert!(StoredMaps::open(folder.path().join("none")).is_err(), "no folder");
}

#[test]
fn maps_of_another_layout_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let store = write(folder.path());
    let path = store.path().join("zarr.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let refused = |text: String| {
        std::fs::write(&path, text).unwrap();
        StoredMaps::open(store.path()).unwrap_err().to_string()
    };
    let error = refused(text.replacen("\"little\"", "\"big\"", 1));
    assert!(error.contains("`share` is stored in another order"), "{error}");
    // Numbers of rows that no file backs.
    let many = (10_u64 + (1 << 50)).to_string();
    let error = refused(text.replace("310", &many).replace("300", &(1_u64 << 50).to_string()));
    assert!(error.contains("shards, more than"), "{error}");
}

#[test]
fn an_overview_holds_the_means_of_squares() {
    let folder = tempfile::tempdir().unwrap();
    let maps = StoredMaps::open(write(folder.path()).path()).unwrap();
    let overview = Overview::of(&maps, 100).unwrap();
    assert_eq!((overview.step, overview.width, overview.height), (6, 89, 50));
    let all = maps.read(maps.rows(), maps.columns()).unwrap();
    let mut sum = 0.0;
    let mut chi2 = 0.0;
    let mut count = 0.0;
    for row in 12..18 {
        for column in 24..30 {
            let pixel = row * COLUMNS + column;
            if all.mask[pixel] == Mask::Mapped {
                sum += all.share[3 * pixel];
                chi2 += all.chi2[pixel];
                count += 1.0;
            }
        }
    }
    let square = 2 * 89 + 4;
    assert!(
        (overview.share[0][square] - sum / count).abs() < 1e-5,
        "{}",
        overview.share[0][square]
    );
    assert!((overview.chi2[square] - chi2 / count).abs() < 1e-3, "{}", overview.chi2[square]);
    let mapped = all.mask.iter().filter(|mask| **mask == Mask::Mapped).count() as u64;
    assert_eq!(overview.pixels.of(Mask::Mapped), mapped);
    assert_eq!(overview.pixels.all(), (ROWS * COLUMNS) as u64);
    assert!((overview.mean_share.iter().sum::<f64>() - 1.0).abs() < 1e-3, "shares add up to 1");
    assert_eq!(overview.present[2], 0.0, "a pigment that is nowhere");

    let size = (overview.width, overview.height);
    let bytes = picture_png(&overview.share[0], size, &Ramp::of_ink([0, 0, 255])).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (89, 50));
    let expected = (255.0 * (1.0 - overview.share[0][square])).round() as u8;
    assert_eq!(pixels[4 * square..4 * square + 4], [expected, expected, 255, 255]);
    let error = picture_png(&overview.share[0], (89, 51), &Ramp::of_ink([0; 3])).unwrap_err();
    assert!(error.to_string().ends_with("for a picture of 89 x 51 pixels"), "{error}");
}

#[test]
fn wide_maps_are_drawn_piece_by_piece() {
    let folder = tempfile::tempdir().unwrap();
    let mut about = about(3, 5000, 2);
    about.columns = 7..5007;
    let store = MapStore::create(folder.path().join("wide"), &about, StoreMode::New).unwrap();
    for shard in store.shards() {
        let mut writer = store.writer(shard);
        writer.add(0..3, &maps_of(shard.rows.clone(), shard.columns.clone(), 2)).unwrap();
        writer.finish().unwrap();
    }
    let maps = StoredMaps::open(store.path()).unwrap();
    let overview = Overview::of(&maps, 1000).unwrap();
    assert_eq!((overview.step, overview.width, overview.height), (5, 1000, 1));
    assert_eq!(overview.pixels.all(), 15_000);
    let all = maps.read(0..3, 7..5007).unwrap();
    for square in [0, 409, 410, 999] {
        let pixels = (0..3).flat_map(|row| (0..5).map(move |at| row * 5000 + square * 5 + at));
        let mapped: Vec<usize> = pixels.filter(|at| all.mask[*at] == Mask::Mapped).collect();
        let sum: f32 = mapped.iter().map(|at| all.rms[*at]).sum();
        let mean = sum / mapped.len() as f32;
        assert!((overview.rms[square] - mean).abs() < 1e-5, "square {square}: {mean}");
    }
}

#[test]
fn squares_without_a_mapped_pixel_have_no_value() {
    let folder = tempfile::tempdir().unwrap();
    let store = MapStore::create(folder.path().join("a"), &about(4, 4, 1), StoreMode::New).unwrap();
    let mut maps = BlockMaps::without_values(16, 1, Mask::TooDark);
    for pixel in [0, 1, 4, 5] {
        maps.mask[pixel] = Mask::Mapped;
        (maps.share[pixel], maps.presence[pixel]) = (1.0, 1.0);
        (maps.chi2[pixel], maps.rms[pixel]) = (2.0, 0.01);
    }
    let mut writer = store.writer(&store.shards()[0]);
    writer.add(0..4, &maps).unwrap();
    writer.finish().unwrap();
    let overview = Overview::of(&StoredMaps::open(store.path()).unwrap(), 2).unwrap();
    assert_eq!(overview.share[0][0], 1.0);
    assert!(overview.share[0][1..].iter().all(|value| value.is_nan()), "{overview:?}");
    assert_eq!((overview.present[0], overview.pixels.of(Mask::TooDark)), (1.0, 12));
    let png = picture_png(&overview.chi2, (2, 2), &Ramp::of_ink([0; 3])).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
}
