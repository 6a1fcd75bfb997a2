//! Speed of reading a cube from the page cache.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use divan::{Bencher, counter::BytesCount};
use maps::cube::{Block, Cube};

const SAMPLES: usize = 1024;
const BANDS: usize = 204;
const LINES: usize = 1024;
const ROWS: usize = 64;

fn main() {
    divan::main();
}

/// Writes a scan of 16-bit numbers, 428 MB, once.
fn scan(interleave: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let path = folder.path().join("scan.hdr");
    let wavelengths: Vec<String> = (0..BANDS).map(|band| (400 + 3 * band).to_string()).collect();
    let header = format!(
        "ENVI\nsamples = {SAMPLES}\nlines = {LINES}\nbands = {BANDS}\ndata type = 12\n\
         interleave = {interleave}\nbyte order = 0\nwavelength units = nm\n\
         wavelength = {{{}}}\nreflectance scale factor = 10000\n",
        wavelengths.join(", ")
    );
    std::fs::write(&path, header).expect("the header is written");
    let data = File::create(path.with_extension("raw")).expect("the data file is made");
    let mut data = BufWriter::new(data);
    let row: Vec<u8> =
        (0..SAMPLES * BANDS).flat_map(|at| (at as u16 % 9000).to_le_bytes()).collect();
    for _ in 0..LINES {
        data.write_all(&row).expect("the data are written");
    }
    drop(data);
    (folder, path)
}

#[divan::bench(args = ["bil", "bip", "bsq"], sample_count = 10, sample_size = 1)]
fn read_u16(bencher: Bencher, interleave: &str) {
    let (_folder, path) = scan(interleave);
    let cube = Cube::open(&path).expect("the scan is a cube");
    bencher.counter(BytesCount::new(2 * SAMPLES * BANDS * LINES)).bench_local(|| {
        let mut sum = 0.0;
        let mut block = Block::default();
        for start in (0..LINES).step_by(ROWS) {
            let rows = start..start + ROWS;
            cube.read_into(rows, 0..SAMPLES, &mut block).expect("the rows are there");
            sum += block.values[start];
        }
        sum
    });
}
