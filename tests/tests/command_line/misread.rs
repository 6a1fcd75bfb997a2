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
