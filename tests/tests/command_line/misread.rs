//! Files that could be read as something else than they are: each is told, none gives a wrong
//! result in silence.

use suite::program::{Run, impasto};

/// Runs impasto with `content` in a file, whose path replaces `FILE` among `arguments`.
fn run(name: &str, content: &[u8], arguments: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    let path = path.display().to_string();
    let arguments: Vec<String> = arguments.iter().map(|a| a.replace("FILE", &path)).collect();
    impasto(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Asserts that the run failed for its input, with all of `words` in the error.
fn refused(run: &Run, words: &[&str]) {
    assert_eq!(run.status, 1, "{}{}", run.out, run.err);
    for word in words {
        assert!(run.err.contains(word), "`{word}` is missing: {}", run.err);
    }
}

#[test]
fn rows_are_those_of_the_file_with_crlf_and_blank_lines() {
    let rows = ["sample,Red,White,400,500,600", "a,0,1,80,82,85", "", "", "b,1,0,10,x,60"];
    for end in ["\n", "\r\n"] {
        refused(&run("rows.csv", rows.join(end).as_bytes(), &["fit", "FILE"]), &["row 5", "`x`"]);
        let prices = ["pigment,price", "Viridian,3", "", "Zinc White,dear"].join(end);
        let library = suite::program::repository("measurements/van-gogh-oils.pigments.json");
        let matching = ["match", library.as_str(), "50,0,0", "--cost", "FILE"];
        refused(&run("prices.csv", prices.as_bytes(), &matching), &["row 4", "`dear`"]);
    }
}

#[test]
fn lamps_and_paint_are_not_taken_for_each_other() {
    let grey = suite::program::repository("spectra/examples/paints.csv");
    let lamp = |name: &str, text: &str| {
        run(name, text.as_bytes(), &["color", grey.as_str(), "--illuminant", "FILE"])
    };
    refused(&lamp("narrow.csv", "nm,power\n500,1\n510,2\n"), &["420 to 680 nm", "narrow.csv"]);
    refused(&lamp("paint.csv", "nm,%R\n400,10\n700,20\n"), &["found `reflectance`", "hint: "]);
    let irradiance = "Jaz Absolute Irradiance File\n>>>>>Begin Processed\nW\tD\tS\tP\n\
        400\t1\t50\t0.5\n500\t1\t50\t0.5\n700\t1\t20\t0.7\n>>>>>End\n";
    let paint = run("sun.JazIrrad", irradiance.as_bytes(), &["color", "FILE"]);
    refused(&paint, &["the power of a light", "--illuminant"]);
}

#[test]
fn pigments_can_be_named() {
    let table = "sample,White,Red,No,L,a,b,400,500,600,700\n\
        w,1,0,1,92,0,2,0.8,0.82,0.84,0.85\nr,0,1,2,40,50,30,0.05,0.06,0.5,0.6\n\
        m,0.5,0.5,3,60,30,10,0.2,0.25,0.65,0.7\n";
    let fitted = run("lab.csv", table.as_bytes(), &["fit", "FILE"]);
    assert_eq!(fitted.status, 0, "{}", fitted.err);
    assert!(fitted.out.contains("2 pigments from 3 samples"), "{}", fitted.out);
    assert!(fitted.err.contains("ignored: No, L, a, b"), "{}", fitted.err);
    let one = ["fit", "FILE", "--pigments", "White", "--pigments", "Blue"];
    refused(&run("lab.csv", table.as_bytes(), &one), &["`Blue`", "heading of a column"]);
}
