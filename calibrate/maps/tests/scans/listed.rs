//! ENVI scans of files that the caller reads.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use maps::cube::{Cube, CubeError, CubeOptions, DarkReading, ReadAt, ScanFile};

use crate::written::{BANDS, by_200, bytes, check, header, in_order, told};

/// Bytes in memory.
#[derive(Debug)]
struct Memory(Vec<u8>);

impl ReadAt for Memory {
    fn bytes(&self) -> u64 {
        self.0.len() as u64
    }

    fn read_exact_at(&self, buffer: &mut [u8], position: u64) -> io::Result<()> {
        let from = usize::try_from(position).unwrap_or(usize::MAX);
        let part = self.0.get(from..).and_then(|rest| rest.get(..buffer.len()));
        buffer.copy_from_slice(part.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    }
}

fn file(name: &str, bytes: impl Into<Vec<u8>>) -> ScanFile {
    ScanFile { name: PathBuf::from(name), contents: Arc::new(Memory(bytes.into())) }
}

fn data(interleave: &str) -> Vec<u8> {
    in_order(interleave).into_iter().flat_map(|value| bytes(12, value, false)).collect()
}

#[test]
fn header_and_data_are_read_wherever_they_lie() {
    for interleave in ["bsq", "bil", "bip"] {
        for name in ["scan.img", "scan", "other.dat"] {
            let files =
                [file(name, data(interleave)), file("scan.hdr", header(interleave, 12, ""))];
            let cube = Cube::of_files(&files, &by_200()).unwrap();
            check(&cube, 1.0 / 200.0, &format!("{interleave}, {name}"));
            assert_eq!(cube.path(), Path::new("scan.hdr"));
        }
    }
}

#[test]
fn readings_are_among_the_files() {
    let reading =
        |value: u8| -> Vec<u8> { (0..BANDS).flat_map(|_| bytes(12, value, false)).collect() };
    let small = header("bip", 12, "")
        .replace("samples = 7", "samples = 1")
        .replace("lines = 5", "lines = 1");
    let files = [
        file("scan.hdr", header("bil", 12, "")),
        file("scan.raw", data("bil")),
        file("white.hdr", small.clone()),
        file("white.raw", reading(200)),
        file("dark.hdr", small),
        file("dark.raw", reading(0)),
    ];
    let options = CubeOptions {
        white_reading: Some("white.hdr".into()),
        dark_reading: DarkReading::File("dark.hdr".into()),
        ..CubeOptions::default()
    };
    check(&Cube::of_files(&files, &options).unwrap(), 1.0 / 200.0, "white and dark");
    let missing = CubeOptions { white_reading: Some("lost.hdr".into()), ..options };
    let (message, _) = told(&Cube::of_files(&files[..2], &missing).unwrap_err());
    assert_eq!(message, "lost.hdr: is not among the files");
}

#[test]
fn files_that_are_no_scan_are_refused() {
    let refused = |files: &[ScanFile]| told(&Cube::of_files(files, &by_200()).unwrap_err());
    let head = || file("scan.hdr", header("bil", 12, ""));
    let both = "give the header (.hdr) and its data file together";
    let (message, hint) = refused(&[head()]);
    assert_eq!(message, "scan.hdr: the data of this header are not beside it");
    assert_eq!(hint, both);
    let (message, hint) = refused(&[file("scan.img", data("bil"))]);
    assert_eq!(
        message,
        "scan.img: is no cube that can be read, and no header of ENVI is beside it"
    );
    assert_eq!(hint, both);
    let (message, _) = refused(&[head(), file("b.hdr", "ENVI\n")]);
    assert_eq!(message, "scan.hdr: is one of 2 headers of ENVI");
    let (message, hint) = refused(&[file("a.mat", "MATLAB 5.0 MAT-file")]);
    assert_eq!(message, "a.mat: is a MATLAB file");
    assert!(hint.contains("export ENVI"), "{hint}");
    assert_eq!(refused(&[]).0, "scan: no file is given");
    let short = data("bil");
    let error = Cube::of_files(&[head(), file("scan.raw", &short[2..])], &by_200()).unwrap_err();
    assert!(matches!(error, CubeError::Size { .. }), "{error}");
}
