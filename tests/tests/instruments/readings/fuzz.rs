//! Arbitrary and damaged bytes: no reader of text formats panics, and every error names the file.

use proptest::prelude::*;
use spectra::instrument::{Format, read};

use super::fixtures;

const FILE: &str = "some/file.txt";

/// Reads the bytes in every format and with the detected format; checks the spectra or the error.
fn read_every_way(bytes: &[u8]) {
    let told = Format::ALL.into_iter().map(Some).chain([None]);
    for format in told {
        match read(FILE, bytes, format) {
            Ok(file) => {
                assert!(!file.spectra.is_empty(), "{format:?} without a spectrum");
                for record in file.spectra {
                    let nm = &record.wavelengths_nm;
                    assert!(nm.windows(2).all(|pair| pair[0] < pair[1]), "{format:?} {nm:?}");
                    assert!(nm.iter().all(|nm| nm.is_finite() && *nm > 0.0), "{format:?} {nm:?}");
                    let finite = record.values.iter().all(|value| value.is_finite());
                    assert!(finite && record.values.len() == nm.len(), "{format:?}");
                    assert!(record.line > 0, "{format:?}");
                }
            }
            Err(error) => assert!(error.to_string().contains(FILE), "{format:?}: {error}"),
        }
    }
}

/// Damage to a file: places, as fractions of its length, and the bytes that replace the content.
fn edits() -> impl Strategy<Value = Vec<(f64, Vec<u8>)>> {
    let piece = prop_oneof![
        proptest::collection::vec(any::<u8>(), 0..4),
        "[0-9eE+.,;\t\n -]{0,6}".prop_map(String::into_bytes),
        "[A-Za-s%@$#=]{1,4}[0-9]{0,9}".prop_map(String::into_bytes),
    ];
    proptest::collection::vec((0.0..1.0, piece), 0..6)
}

fn cases() -> u32 {
    // The environment variable PROPTEST_CASES sets another number.
    std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(300)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        read_every_way(&bytes);
    }

    #[test]
    fn spoilt_files(which in any::<prop::sample::Index>(), edits in edits(), kept in 0.0..1.5) {
        let files = fixtures();
        let mut bytes = which.get(&files).1.clone();
        for (at, piece) in edits {
            let from = (at * bytes.len() as f64) as usize;
            let to = (from + piece.len().max(1)).min(bytes.len());
            bytes.splice(from..to, piece);
        }
        bytes.truncate((kept * bytes.len() as f64) as usize);
        read_every_way(&bytes);
    }
}
