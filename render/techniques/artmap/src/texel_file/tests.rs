use documents::hint::Explain;
use paint::file::{ATTRIBUTE, EXPANSION};

use super::*;

const KIND: TexelFileKind =
    TexelFileKind { format: "impasto-test", version: 3, content: "test", reserved: &["a", "b"] };
const ORIGIN: Origin<'_> = Origin { kind: &KIND, file: "a.exr" };

fn plans() -> Vec<PartPlan> {
    vec![PartPlan::new("p.000", (5, 64), &["b", "a"]), PartPlan::new("p.001", (7, 3), &["a"])]
}

/// Two parts, each number of which is another.
fn parts() -> Vec<PartPlanes> {
    plans()
        .into_iter()
        .map(|plan: PartPlan| {
            let count = plan.width * plan.height;
            plan.with(|channel| {
                let first = channel.len() as f32 + if channel == "b" { 0.5 } else { 0.25 };
                (0..count).map(|index| first + index as f32).collect()
            })
        })
        .collect()
}

fn bytes() -> Vec<u8> {
    write(&KIND, "some words", parts()).unwrap()
}

fn refused(bytes: &[u8], plans: Vec<PartPlan>) -> String {
    let error = Opened::new(ORIGIN, bytes).unwrap().planes(plans).unwrap_err();
    assert!(error.hint().is_some(), "{error}");
    error.to_string()
}

/// Place of `wanted` in the bytes.
fn place(bytes: &[u8], wanted: &[u8]) -> usize {
    bytes.windows(wanted.len()).position(|window| window == wanted).unwrap()
}

#[test]
fn parts_come_back_with_their_description() {
    let bytes = bytes();
    let opened = Opened::new(ORIGIN, &bytes).unwrap();
    assert_eq!(opened.description().unwrap(), "some words");
    assert_eq!(opened.planes(plans()).unwrap(), parts());
    let part = &parts()[0];
    assert_eq!((part.of("b")[1], part.of("c")), (2.5, &[][..]));
}

#[test]
fn descriptions_of_other_formats_and_versions_are_told_apart() {
    let decode = |json: &str| decoded::<serde_json::Value>(ORIGIN, json).unwrap_err().to_string();
    let other = decode(r#"{"format": "impasto-painting", "version": 3}"#);
    let wanted = "`format` must be \"impasto-test\", found `\"impasto-painting\"`";
    assert_eq!(other, format!("a.exr: no test of impasto: {wanted}"));
    let newer = decode(r#"{"format": "impasto-test", "version": 4}"#);
    assert_eq!(newer, "a.exr: test of version `4`, this program reads versions up to 3");
    assert!(decode("{").starts_with("a.exr: attribute `impasto`: EOF"), "{}", decode("{"));
    let mut bytes = bytes();
    let at = place(&bytes, format!("{ATTRIBUTE}\0").as_bytes());
    bytes[at] = b'I';
    let error = Opened::new(ORIGIN, &bytes).unwrap().description().unwrap_err();
    assert_eq!(error.to_string(), "a.exr: no test of impasto: attribute `impasto` is missing");
}

#[test]
fn parts_and_channels_that_are_not_planned_are_named() {
    let with = |change: &dyn Fn(&mut Vec<PartPlan>)| {
        let mut plans = plans();
        change(&mut plans);
        refused(&bytes(), plans)
    };
    let fewer = with(&|plans| drop(plans.pop()));
    assert_eq!(fewer, "a.exr: attribute `impasto`: it names 1 parts, the file has `2`");
    let named = with(&|plans| plans[1].name = "q".to_owned());
    assert_eq!(named, "a.exr: part `q` is missing at its place");
    let larger = with(&|plans| plans[0].width = 6);
    assert_eq!(larger, "a.exr: part `p.000` has `5 x 64` texels, attribute `impasto` says 6 x 64");
    let missing = with(&|plans| plans[1].channels.push("c".to_owned()));
    assert_eq!(missing, "a.exr: part `p.001`, channel `c` is missing");
    let unknown = with(&|plans| drop(plans[0].channels.pop()));
    assert!(unknown.starts_with("a.exr: part `p.000`, channel `b` is none that"), "{unknown}");
}

#[test]
fn channels_of_other_numbers_are_refused() {
    let mut whole = bytes();
    // A channel is its name, a zero, the type of its numbers (0 whole, 1 half, 2 float), a byte
    // and three for its use, and its steps in x and y.
    let at = place(&whole, b"\0b\0\x02\0\0\0");
    whole[at + 3] = 0;
    let error = refused(&whole, plans());
    assert_eq!(error, "a.exr: part `p.000`, channel `b` must hold 32-bit floats");
}

#[test]
fn rows_that_occur_twice_are_named() {
    let mut bytes = bytes();
    // A block begins with part, row and number of bytes: part 0 has blocks at rows 0 and 32.
    let at = place(&bytes, &[0, 0, 0, 0, 32, 0, 0, 0]);
    bytes[at + 4] = 0;
    assert_eq!(refused(&bytes, plans()), "a.exr: part `p.000` has row `0` twice");
}

#[test]
fn sizes_that_the_file_cannot_hold_are_refused_before_memory_is_taken() {
    let width = 1_000_000;
    let mut bytes = bytes();
    // The data window of the first part: left, top, right and bottom, the last ones inclusive.
    let window = |right: i32| [0, 0, right, 63].map(i32::to_le_bytes).concat();
    let at = place(&bytes, b"dataWindow\0box2i\0") + 21;
    assert_eq!(bytes[at..at + 16], window(4));
    bytes[at..at + 16].copy_from_slice(&window(width - 1));
    let mut plans = plans();
    plans[0].width = width as usize;
    assert!(8 * 64 * width as u64 > EXPANSION * bytes.len() as u64);
    let error = refused(&bytes, plans);
    assert!(error.contains("bytes cannot hold the 512000084"), "{error}");
}

#[test]
fn a_description_that_does_not_come_back_is_not_written() {
    let proven = |back: Result<u8, TexelFileError>| {
        proven(&KIND, 7, None, back.map(|back| (back, None))).map_err(|error| error.to_string())
    };
    assert_eq!(proven(Ok(7)), Ok(7));
    let other = proven(Ok(8)).unwrap_err();
    assert!(other.starts_with("the test cannot be saved: the description does not"), "{other}");
    let fault = proven(Err(ORIGIN.header("a reason"))).unwrap_err();
    assert_eq!(fault, "the test cannot be saved: a reason");
}
