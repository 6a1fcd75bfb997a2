//! Maps as a Zarr store: begun, written shard by shard, resumed.

use std::path::Path;

use documents::hint::Explain;
use maps::pixel_maps::{BlockMaps, Mask};
use maps::store::{MapStore, MapsAbout, StoreError, StoreMode};
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

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

/// Maps of a rectangle whose numbers depend on the pixel alone.
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
        assert!(hint.contains("`out`"), "{hint}");
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
