//! Whole cubes mapped shard by shard.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use documents::hint::Explain;
use maps::blocks::{RunError, map_cube};
use maps::cube::{Block, Cube, CubeError, CubeOptions, CubeScale};
use maps::pixel_maps::{BlockMaps, Mask};
use maps::store::{MapStore, StoreMode};

use crate::store::{about, digest};
use crate::written::{header, write_envi};

const LINES: usize = 2300;
const SAMPLES: usize = 300;

/// Writes a scan of two shards whose pixels differ.
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
    let mut last = None;
    let outcome = map_cube(&cube, &store, map, |progress| {
        let done = last.map_or(0, |before: maps::blocks::MapProgress| before.done);
        assert!(progress.done > done && progress.all == (LINES * SAMPLES) as u64);
        last = Some(progress);
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(last.unwrap().done, (LINES * SAMPLES) as u64);
    let masks = cube.read_rows(0..LINES).unwrap().mask;
    let ignored = masks.iter().filter(|mask| **mask == Mask::Ignored).count() as u64;
    assert!(ignored > 1000, "{ignored} pixels ignored");
    assert_eq!(outcome.pixels.of(Mask::Ignored), ignored);
    assert_eq!(outcome.pixels.all(), (LINES * SAMPLES) as u64);
    assert_eq!((outcome.written, outcome.kept, outcome.cancelled), (2, 0, false));

    let path = folder.path().join("cancelled.zarr");
    let store = MapStore::create(&path, &about, StoreMode::New).unwrap();
    let outcome = map_cube(&cube, &store, map, |progress| match progress.shards {
        0 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    })
    .unwrap();
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
        |_| ControlFlow::Continue(()),
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
        |_| ControlFlow::Continue(()),
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
    let error = map_cube(&cube, &store, map, |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(error, RunError::Cube(_)), "{error}");
    assert!(error.to_string().contains("scan.raw") && error.hint().is_some(), "{error}");
    assert!(store.shards().iter().all(|shard| !store.is_finished(shard)), "a half shard");
}
