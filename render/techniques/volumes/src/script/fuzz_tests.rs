//! Random changes of scripts: nothing panics, and every fault has a place and a way out.

use documents::hint::Explain;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::Script;
use super::samples::{DESCRIBED, SHORT, WHOLE};

/// Pieces that are put into texts.
const PIECES: [&str; 32] = [
    "=",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "\"",
    "'''",
    "\"\"\"",
    "#",
    "\n",
    ".",
    ",",
    "-",
    "nan",
    "inf",
    "1e400",
    "-0.0",
    "0x7f",
    "99999999999999999999",
    "1979-05-27T07:32:00Z",
    "true",
    "\u{e9}",
    "\u{feff}",
    "\0",
    "\r",
    "pour",
    "[[pour]]",
    "settings",
    "9e8",
    " = 1\n",
];

/// One of the sample scripts with one to eight random changes.
fn changed(random: &mut ChaCha8Rng) -> String {
    let text = [WHOLE, SHORT, DESCRIBED][random.random_range(0..3)];
    let mut letters: Vec<char> = text.chars().collect();
    for _ in 0..random.random_range(1..=8) {
        let at = random.random_range(0..=letters.len());
        let to = (at + random.random_range(0..12)).min(letters.len());
        match random.random_range(0..5) {
            0 => {
                letters.drain(at..to);
            }
            1 => {
                let piece = PIECES[random.random_range(0..PIECES.len())];
                letters.splice(at..at, piece.chars());
            }
            2 => {
                let copy: Vec<char> = letters[at..to].to_vec();
                let there = random.random_range(0..=letters.len());
                letters.splice(there..there, copy);
            }
            3 if at < letters.len() => {
                letters[at] = char::from(random.random_range(32..127_u8));
            }
            _ => {
                // A digit changes, so that values leave their ranges.
                let digits: Vec<usize> =
                    (0..letters.len()).filter(|&at| letters[at].is_ascii_digit()).collect();
                if let Some(&at) = digits.get(random.random_range(0..digits.len().max(1))) {
                    let number = PIECES[random.random_range(15..21)];
                    letters.splice(at..=at, number.chars());
                }
            }
        }
    }
    letters.into_iter().collect()
}

/// Reads `count` changed scripts; returns how many were good.
fn read(seed: u64, count: usize) -> usize {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let good = (0..count).filter(|_| {
        let text = changed(&mut random);
        match Script::from_text("s.toml", &text) {
            Ok(script) => {
                let written = script.to_text().unwrap();
                let again = Script::from_text("s.toml", &written).unwrap();
                assert_eq!(again, script.rounded(), "{text}");
                assert!(script.events().windows(2).all(|pair| pair[0].start <= pair[1].start));
                true
            }
            Err(error) => {
                let told = error.to_string();
                assert!(told.starts_with("s.toml, line ") && told.len() < 4000, "{text}\n{told}");
                assert!(error.hint().is_some(), "{text}\n{told}");
                false
            }
        }
    });
    good.count()
}

#[test]
fn changed_scripts_are_read_or_refused() {
    let good = read(1, 2000);
    assert!((20..1900).contains(&good), "{good} of 2000 were good");
}

#[test]
#[ignore = "reads a million scripts, which takes minutes"]
fn a_million_changed_scripts_are_read_or_refused() {
    let good: usize = (0..1000).into_par_iter().map(|seed| read(seed + 2, 1000)).sum();
    println!("{good} of 1,000,000 were good");
    assert!(good > 10_000, "{good}");
}
