//! Maps as a Zarr store: created, written shard by shard, resumed, read back and drawn.

use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use documents::hint::Explain;
use documents::{Cancellation, Task};
use maps::blocks::{RunError, map_cube};
use maps::cube::{Block, Cube, CubeError, CubeOptions, CubeScale};
use maps::pictures::{Overview, Ramp, picture_png};
use maps::pixel_maps::{BlockMaps, Mask};
use maps::store::{MapStore, MapsAbout, StoreError, StoreMode, StoredMaps};
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use crate::written::{header, write_envi};

pub(crate) fn about(rows: usize, columns: usize, pigments: usize) -> MapsAbout {
    let mut settings = Map::new();
    settings.insert("at_most".to_owned(), json!(4));
    MapsAbout {
        pigments: (0..pigments).map(|at| format!("Pigment {at}")).collect(),
        library_sha256: "a1".to_owned(),
        book_sha256: "b2".to_owned(),
        scan: "c3".to_owned(),
        rows: 0..rows,
        columns: 0..columns,
        settings,
    }
}

/// Maps of a rectangle with numbers that depend on the pixel alone.
pub(crate) fn maps_of(
    rows: std::ops::Range<usize>,
    columns: std::ops::Range<usize>,
    pigments: usize,
) -> BlockMaps {
    let pixels = rows.len() * columns.len();
    let mut maps = BlockMaps::without_values(pixels, pigments, Mask::Mapped);
    let places = rows.flat_map(|row| columns.clone().map(move |column| (row, column)));
    for (pixel, (row, column)) in places.enumerate() {
        let first = ((row * 7 + column * 3) % 100) as f32 / 100.0;
        if (row + column) % 50 == 13 {
            maps.mask[pixel] = Mask::Ignored;
            continue;
        }
        for pigment in 0..pigments {
            let share = match pigment {
                0 => first,
                1 => 1.0 - first,
                _ => 0.0,
            };
            let at = pixel * pigments + pigment;
            maps.share[at] = share;
            maps.share_sd[at] = share / 16.0;
            maps.presence[at] = share;
        }
        maps.chi2[pixel] = row as f32;
        maps.rms[pixel] = column as f32 * 1e-4;
        maps.second[pixel] = 1 << (column % 64);
    }
    maps
}

/// SHA-256 of all files of a folder with their names.
pub(crate) fn digest(folder: &Path) -> String {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(inner) = folders.pop() {
        for entry in std::fs::read_dir(&inner).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    let mut hash = Sha256::new();
    for file in files {
        hash.update(file.strip_prefix(folder).unwrap().to_str().unwrap());
        hash.update(std::fs::read(&file).unwrap());
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn write_shards(store: &MapStore, rows: usize) {
    for shard in store.shards() {
        if store.is_finished(shard) {
            continue;
        }
        let mut writer = store.writer(shard);
        for start in shard.rows.clone().step_by(rows) {
            let part = start..(start + rows).min(shard.rows.end);
            let maps = maps_of(part.clone(), shard.columns.clone(), store.pigments());
            writer.add(part, &maps).unwrap();
        }
        writer.finish().unwrap();
        assert!(store.is_finished(shard), "{shard}");
    }
}

#[test]
fn bytes_do_not_depend_on_blocks_threads_or_resuming() {
    let folder = tempfile::tempdir().unwrap();
    let about = about(300, 2100, 3);
    let make = |name: &str, rows: usize| {
        let path = folder.path().join(name);
        let store = MapStore::create(&path, &about, StoreMode::New).unwrap();
        assert_eq!(store.shards().len(), 2);
        write_shards(&store, rows);
        path
    };
    let whole = digest(&make("whole", 300));
    assert_eq!(digest(&make("rows", 1)), whole, "row after row");
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one.install(|| digest(&make("one", 77))), whole, "one thread");
    // A run that ended between two arrays of the second shard.
    let path = make("resumed", 100);
    for array in ["mask", "second"] {
        std::fs::remove_file(path.join(array).join("c/0/1")).unwrap();
    }
    let store = MapStore::create(&path, &about, StoreMode::Resume).unwrap();
    let finished: Vec<bool> = store.shards().iter().map(|s| store.is_finished(s)).collect();
    assert_eq!(finished, [true, false]);
    write_shards(&store, 64);
    assert_eq!(digest(&path), whole, "resumed");
}

fn refused(path: &Path, about: &MapsAbout, mode: StoreMode) -> (String, String) {
    let error = MapStore::create(path, about, mode).unwrap_err();
    (error.to_string(), error.hint().map(|hint| hint.to_string()).unwrap_or_default())
}

#[test]
fn outputs_of_other_runs_are_refused_and_stay_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("maps.zarr");
    let mine = about(20, 30, 3);
    MapStore::create(&path, &mine, StoreMode::New).unwrap();
    let before = digest(&path);
    let (found, hint) = refused(&path, &mine, StoreMode::New);
    assert!(found.ends_with("maps.zarr: exists already and holds maps"), "{found}");
    assert!(hint.contains("`resume`"), "{hint}");
    type Change = fn(&mut MapsAbout);
    let changes: [(Change, &str); 7] = [
        (|it| it.library_sha256 = "00".into(), "`library_sha256` is \"a1\", now \"00\""),
        (|it| it.book_sha256 = "00".into(), "`book_sha256` is \"b2\", now \"00\""),
        (|it| it.scan = "00".into(), "`scan` is \"c3\", now \"00\""),
        (|it| it.rows = 1..20, "`rows` is [0,20], now [1,20]"),
        (|it| it.columns = 0..29, "`columns` is [0,30], now [0,29]"),
        (
            |it| drop(it.settings.insert("at_most".into(), json!(3))),
            "`settings` is {\"at_most\":4}, now {\"at_most\":3}",
        ),
        (|it| it.pigments.truncate(2), "`pigments` is"),
    ];
    for (change, words) in changes {
        let mut other = mine.clone();
        change(&mut other);
        let (found, hint) = refused(&path, &other, StoreMode::Resume);
        assert!(found.contains("holds maps of another run") && found.contains(words), "{found}");
        assert!(hint.contains("`output`"), "{hint}");
    }
    assert_eq!(digest(&path), before, "nothing changed");
    let (found, _) = refused(folder.path(), &mine, StoreMode::Resume);
    assert!(found.ends_with("exists already and holds other files"), "{found}");
    std::fs::write(path.join("zarr.json"), "{\"attributes\": {}}").unwrap();
    let (found, _) = refused(&path, &mine, StoreMode::Resume);
    assert!(found.ends_with("exists already and holds other data"), "{found}");
}

#[test]
fn a_store_that_was_only_begun_can_be_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("maps.zarr");
    let mine = about(20, 30, 3);
    MapStore::create(&path, &mine, StoreMode::Resume).unwrap();
    let whole = digest(&path);
    std::fs::remove_file(path.join("zarr.json")).unwrap();
    std::fs::remove_dir_all(path.join("chi2")).unwrap();
    let (found, _) = refused(&path, &mine, StoreMode::New);
    assert!(found.ends_with("exists already and holds maps that were begun"), "{found}");
    MapStore::create(&path, &mine, StoreMode::Resume).unwrap();
    assert_eq!(digest(&path), whole);
}

#[test]
fn names_of_pigments_are_part_of_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("maps.zarr");
    let mine = about(20, 30, 3);
    MapStore::create(&path, &mine, StoreMode::New).unwrap();
    let mut other = mine.clone();
    other.pigments[1] = "Another".to_owned();
    let (found, _) = refused(&path, &other, StoreMode::Resume);
    assert!(found.contains("Pigment 1") && found.contains("Another"), "{found}");
}

#[test]
fn maps_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mine = about(20, 30, 3);
    let store = MapStore::create(folder.path().join("a"), &mine, StoreMode::New).unwrap();
    let shard = &store.shards()[0];
    let mut writer = store.writer(shard);
    writer.add(0..5, &maps_of(0..5, 0..30, 3)).unwrap();
    for (rows, maps) in [
        (6..8, maps_of(6..8, 0..30, 3)),
        (5..8, maps_of(5..8, 0..29, 3)),
        (5..8, maps_of(5..8, 0..30, 2)),
        (5..21, maps_of(5..21, 0..30, 3)),
    ] {
        let error = writer.add(rows, &maps).unwrap_err();
        assert!(matches!(error, StoreError::Maps { .. }), "{error}");
        assert!(error.to_string().contains("from row 5 on and 3 pigments"), "{error}");
    }
    let error = writer.finish().unwrap_err().to_string();
    assert!(error.contains("end before row 5"), "{error}");
    assert!(!store.is_finished(shard), "nothing was written");
    let (found, _) = refused(&folder.path().join("b"), &about(20, 30, 65), StoreMode::New);
    assert!(found.contains("1 to 64 pigments of different names, found 65"), "{found}");
    let mut twice = about(20, 30, 3);
    twice.pigments[0] = twice.pigments[1].clone();
    refused(&folder.path().join("b"), &twice, StoreMode::New);
    assert!(!folder.path().join("b").exists(), "nothing was written");
}

#[test]
fn a_shard_that_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let store =
        MapStore::create(folder.path().join("a"), &about(20, 30, 3), StoreMode::New).unwrap();
    // A file in the place of a folder, as a full disk would stop the write.
    std::fs::write(store.path().join("chi2/c"), "").unwrap();
    let shard = &store.shards()[0];
    let mut writer = store.writer(shard);
    writer.add(0..20, &maps_of(0..20, 0..30, 3)).unwrap();
    let error = writer.finish().unwrap_err();
    let words = "the shard of rows 0 to 19 and columns 0 to 29 cannot be written";
    assert!(error.to_string().ends_with(words), "{error}");
    assert!(error.hint().unwrap().to_string().contains("`resume`"), "{error:?}");
    assert!(!store.is_finished(shard), "the mask is written last");
}

#[test]
fn the_description_holds_names_hashes_and_settings() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("maps.zarr");
    MapStore::create(&path, &about(20, 30, 3), StoreMode::New).unwrap();
    let read = |name: &str| -> Value {
        serde_json::from_slice(&std::fs::read(path.join(name)).unwrap()).unwrap()
    };
    let group = read("zarr.json");
    assert_eq!(group["attributes"]["library_sha256"], "a1");
    assert_eq!(group["attributes"]["settings"]["at_most"], 4);
    for name in
        ["share", "share_sd", "presence", "chi2", "rms", "second", "mask", "y", "x", "pigment"]
    {
        let array = read(&format!("{name}/zarr.json"));
        assert_eq!(group["consolidated_metadata"]["metadata"][name], array, "{name}");
    }
    assert_eq!(read("share/zarr.json")["shape"], json!([20, 30, 3]));
    assert_eq!(read("share/zarr.json")["data_type"], "float16");
}

const LINES: usize = 2300;
const SAMPLES: usize = 300;

/// Writes a scan of two shards with different pixels.
fn write_scan(folder: &Path) -> PathBuf {
    let mut data = Vec::with_capacity(LINES * SAMPLES * 4);
    for line in 0..LINES {
        for band in 0..4 {
            data.extend(
                (0..SAMPLES).map(|sample| ((line * 31 + sample * 7 + band * 5) % 200) as u8),
            );
        }
    }
    let text = header("bil", 1, "data ignore value = 199\n");
    let text = text.replace("samples = 7", &format!("samples = {SAMPLES}"));
    write_envi(folder, "scan", &text.replace("lines = 5", &format!("lines = {LINES}")), &data)
}

fn open(path: &Path) -> Cube {
    let options = CubeOptions { scale: CubeScale::White(200.0), ..CubeOptions::default() };
    Cube::open_with(path, &options).unwrap()
}

/// Maps that depend on each pixel alone: the share of the first pigment is the first band.
fn map(block: &Block) -> Result<BlockMaps, CubeError> {
    let mut maps = BlockMaps::without_values(block.pixels(), 2, Mask::Ignored);
    for (pixel, (values, mask)) in block.iter().enumerate() {
        maps.mask[pixel] = mask;
        if mask == Mask::Mapped {
            maps.share[2 * pixel] = values[0];
            maps.share[2 * pixel + 1] = 1.0 - values[0];
            maps.chi2[pixel] = values[3];
        }
    }
    Ok(maps)
}

#[test]
fn a_cube_is_mapped_cancelled_and_resumed_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let cube = open(&write_scan(folder.path()));
    let about = about(LINES, SAMPLES, 2);
    let path = folder.path().join("whole.zarr");
    let store = MapStore::create(&path, &about, StoreMode::New).unwrap();
    assert_eq!(store.shards().len(), 2);
    let last = AtomicU64::new(0);
    let task = Task::observed(move |progress| {
        let before = last.swap(progress.done, Ordering::Relaxed);
        assert!(progress.done > before && progress.of == (LINES * SAMPLES) as u64);
    });
    let outcome = map_cube(&cube, &store, map, &task).unwrap();
    assert_eq!(task.progress().done, (LINES * SAMPLES) as u64);
    let masks = cube.read_rows(0..LINES).unwrap().mask;
    let ignored = masks.iter().filter(|mask| **mask == Mask::Ignored).count() as u64;
    assert!(ignored > 1000, "{ignored} pixels ignored");
    assert_eq!(outcome.pixels.of(Mask::Ignored), ignored);
    assert_eq!(outcome.pixels.all(), (LINES * SAMPLES) as u64);
    assert_eq!((outcome.written, outcome.kept, outcome.cancelled), (2, 0, false));

    let path = folder.path().join("cancelled.zarr");
    let store = MapStore::create(&path, &about, StoreMode::New).unwrap();
    let first = (store.shards()[0].rows.len() * SAMPLES) as u64;
    let cancellation = Cancellation::default();
    let ends = cancellation.clone();
    let task = Task::observed(move |progress| {
        if progress.done > first {
            ends.cancel();
        }
    });
    let outcome = map_cube(&cube, &store, map, &task.until(cancellation)).unwrap();
    assert_eq!((outcome.written, outcome.cancelled), (1, true));
    let finished: Vec<bool> = store.shards().iter().map(|s| store.is_finished(s)).collect();
    assert_eq!(finished, [true, false], "the shard under way is not written");
    let store = MapStore::create(&path, &about, StoreMode::Resume).unwrap();
    let calls = Cell::new(0);
    let outcome = map_cube(
        &cube,
        &store,
        |block| {
            calls.set(calls.get() + 1);
            assert!(block.rows.start >= 2048, "the first shard is kept");
            map(block)
        },
        &Task::default(),
    )
    .unwrap();
    assert_eq!((outcome.written, outcome.kept), (1, 1));
    assert!(calls.get() > 0, "the second shard is mapped");
    assert_eq!(digest(&path), digest(&folder.path().join("whole.zarr")));
}

#[test]
fn a_region_of_the_scan_is_mapped() {
    let folder = tempfile::tempdir().unwrap();
    let cube = open(&write_scan(folder.path()));
    let mut about = about(LINES, SAMPLES, 2);
    (about.rows, about.columns) = (100..140, 30..50);
    let store = MapStore::create(folder.path().join("maps.zarr"), &about, StoreMode::New).unwrap();
    let found = Cell::new(0);
    map_cube(
        &cube,
        &store,
        |block| {
            assert_eq!((&block.rows, &block.columns), (&(100..140), &(30..50)));
            found.set(block.pixels());
            map(block)
        },
        &Task::default(),
    )
    .unwrap();
    assert_eq!(found.get(), 800);
}

#[test]
fn a_cube_that_cannot_be_read_leaves_no_shard() {
    let folder = tempfile::tempdir().unwrap();
    let path = write_scan(folder.path());
    let cube = open(&path);
    std::fs::write(path.with_extension("raw"), vec![7; LINES * SAMPLES]).unwrap();
    let about = about(LINES, SAMPLES, 2);
    let store = MapStore::create(folder.path().join("maps.zarr"), &about, StoreMode::New).unwrap();
    let error = map_cube(&cube, &store, map, &Task::default()).unwrap_err();
    assert!(matches!(error, RunError::Cube(_)), "{error}");
    assert!(error.to_string().contains("scan.raw") && error.hint().is_some(), "{error}");
    assert!(store.shards().iter().all(|shard| !store.is_finished(shard)), "a half shard");
}

#[test]
fn a_scan_that_changes_while_it_is_mapped_leaves_no_shard() {
    type Change = fn(&Path);
    let changes: [(Change, &str); 3] = [
        (|data| std::fs::write(data, vec![7; LINES * SAMPLES * 4 + 1]).unwrap(), "was changed"),
        (|data| std::fs::remove_file(data).unwrap(), "was removed"),
        (|data| std::fs::write(data.with_extension("hdr"), "ENVI").unwrap(), "was changed"),
    ];
    for (change, told) in changes {
        let folder = tempfile::tempdir().unwrap();
        let path = write_scan(folder.path());
        let cube = open(&path);
        cube.check_unchanged().unwrap();
        let about = about(LINES, SAMPLES, 2);
        let maps = folder.path().join("maps.zarr");
        let store = MapStore::create(maps, &about, StoreMode::New).unwrap();
        let changed = Cell::new(false);
        let error = map_cube(
            &cube,
            &store,
            |block| {
                if !changed.replace(true) {
                    change(&path.with_extension("raw"));
                }
                map(block)
            },
            &Task::default(),
        );
        let error = error.unwrap_err();
        assert!(error.to_string().contains(told) && error.hint().is_some(), "{error}");
        assert!(store.shards().iter().all(|shard| !store.is_finished(shard)), "{told}");
    }
}

const ROWS: usize = 300;
const COLUMNS: usize = 530;

/// Writes maps of a region that begins at row 10 and column 20 of its scan.
fn write(folder: &Path) -> MapStore {
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
    let many = (10_u64 + (1 << 50)).to_string();
    for (text, words) in [
        (text.replacen("\"little\"", "\"big\"", 1), "`share` is stored in another order"),
        // Numbers of rows that no file backs.
        (
            text.replace("310", &many).replace("300", &(1_u64 << 50).to_string()),
            "shards, more than",
        ),
    ] {
        std::fs::write(&path, text).unwrap();
        let error = StoredMaps::open(store.path()).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
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
