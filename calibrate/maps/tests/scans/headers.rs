//! Headers of any content: an error or a header, never a panic.

use std::path::Path;

use maps::cube::envi::EnviHeader;
use proptest::prelude::*;

/// Headers that the suite tries; IMPASTO_FUZZ_HEADERS names another number.
fn cases() -> u32 {
    let asked = std::env::var("IMPASTO_FUZZ_HEADERS").ok();
    asked.and_then(|number| number.parse().ok()).unwrap_or(4000)
}

fn key() -> impl Strategy<Value = String> {
    const KNOWN: [&str; 21] = [
        "samples",
        "lines",
        "bands",
        "header offset",
        "data type",
        "interleave",
        "byte order",
        "wavelength",
        "wavelength units",
        "bbl",
        "fwhm",
        "data ignore value",
        "reflectance scale factor",
        "data reflectance gain values",
        "data reflectance offset values",
        "file type",
        "file compression",
        "major frame offsets",
        "z plot titles",
        "tint",
        "description",
    ];
    prop_oneof![
        12 => prop::sample::select(&KNOWN[..]).prop_map(str::to_owned),
        1 => "[ -~]{0,12}",
        1 => "\\PC{0,6}",
    ]
}

fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => (0_u32..20).prop_map(|number| number.to_string()),
        3 => (380.0_f64..1000.0).prop_map(|number| number.to_string()),
        1 => any::<u64>().prop_map(|number| number.to_string()),
        1 => any::<i64>().prop_map(|number| number.to_string()),
        1 => any::<f64>().prop_map(|number| number.to_string()),
        1 => prop::sample::select(&["NaN", "inf", "-0", "1e999", "0x10", "", "18446744073709551616"][..])
            .prop_map(str::to_owned),
    ]
}

fn list() -> impl Strategy<Value = String> {
    (
        prop::collection::vec(number(), 0..12),
        prop::sample::select(&[", ", ",\n", " ", "\n;x\n,"][..]),
    )
        .prop_map(|(numbers, between)| numbers.join(between))
}

fn written_value() -> impl Strategy<Value = String> {
    const WORDS: [&str; 10] =
        ["bil", "BSQ", "Bip", "nm", "Micrometers", "Index", "ENVI Standard", "{", "}", "{}"];
    prop_oneof![
        5 => number(),
        5 => list().prop_map(|list| format!("{{{list}}}")),
        1 => list().prop_map(|list| format!("{{{list}")),
        3 => prop::sample::select(&WORDS[..]).prop_map(str::to_owned),
        1 => "\\PC{0,20}",
    ]
}

fn free() -> impl Strategy<Value = Vec<u8>> {
    let line = (key(), written_value(), prop::sample::select(&[" = ", "=", " ", ""][..]))
        .prop_map(|(key, value, sign)| format!("{key}{sign}{value}"));
    let first = prop::sample::select(&["ENVI", "ENVI ", "\u{feff}ENVI", "envi", ""][..]);
    (first, prop::collection::vec(line, 0..16), prop::sample::select(&["\n", "\r\n", "\r"][..]))
        .prop_map(|(first, lines, end)| format!("{first}{end}{}", lines.join(end)).into_bytes())
}

/// A header that can be read, with a few of its bytes changed.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let whole = "ENVI\nsamples = 3\nlines = 2\nbands = 2\nheader offset = 0\ndata type = 4\n\
                 interleave = bil\nbyte order = 0\nwavelength units = nm\n\
                 wavelength = {400, 500}\nfwhm = {9, 9}\nbbl = {1, 0}\n\
                 data ignore value = -1\nreflectance scale factor = 1\n";
    prop::collection::vec((0..whole.len(), any::<u8>()), 0..4).prop_map(move |changes| {
        let mut bytes = whole.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        bytes
    })
}

#[test]
fn any_header_gives_an_error_or_a_result() {
    let config =
        ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) };
    let bytes = prop_oneof![
        3 => free(),
        3 => damaged(),
        1 => prop::collection::vec(any::<u8>(), 0..200),
    ];
    let mut runner = proptest::test_runner::TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(
            proptest::test_runner::RngAlgorithm::ChaCha,
        ),
    );
    let read = std::cell::Cell::new(0_u32);
    runner
        .run(&bytes, |bytes| {
            match EnviHeader::parse(&bytes, Path::new("scan.hdr")) {
                Ok(header) => {
                    read.set(read.get() + 1);
                    let bands = header.good.len();
                    prop_assert!(bands > 0 && header.good.contains(&true));
                    if let Some(nm) = &header.wavelengths_nm {
                        prop_assert!(nm.len() == bands && nm.iter().all(|nm| *nm >= 150.0));
                    }
                }
                Err(error) => prop_assert!(error.to_string().contains("scan.hdr")),
            }
            Ok(())
        })
        .unwrap();
    let read = read.get();
    assert!(read > cases() / 20, "only {read} of {} headers were read", cases());
}
