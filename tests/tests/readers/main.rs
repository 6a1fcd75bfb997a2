//! Every reader of a file, fed with damaged files. No reader may panic, be slow, take much memory, or report an error
//! without words.
//!
//! [`table::READERS`] lists the readers with files to damage. Each test feeds some of them with the same
//! inputs every time. For more inputs set their number for each reader:
//!
//! ```sh
//! IMPASTO_FUZZ=1000000 cargo test -p suite --release --test readers
//! ```
//!
//! `IMPASTO_FUZZ_READERS="models,art maps"` feeds these readers alone.
//!
//! A failure names the reader and the number of the input, and leaves the input in the folder of temporary files.

#![expect(clippy::unwrap_used, reason = "a test may panic")]
#![expect(clippy::print_stdout, reason = "with --nocapture you see the counts and the memory")]

mod damage;
mod input;
mod seeds;
mod table;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use table::{Kind, READERS, Reader};

/// Inputs for each reader in CI.
const INPUTS: u64 = 10_000;
/// Longest time for one input, in which this program also used the processor so long: others may use it meanwhile.
const LONGEST: Duration = Duration::from_secs(5);
/// Most memory that the readers may add to what the test took at its start, in MB: used, and only asked for.
const MOST_MB: [u64; 2] = [600, 4096];
/// Most letters of an error. A message shows a place, and not the file.
const MOST_LETTERS: usize = 20_000;

/// Peak of the memory used, and of the memory asked for, in MB. Zeros on other systems than Linux.
fn peaks_mb() -> [u64; 2] {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    ["VmHWM:", "VmPeak:"].map(|key| {
        let line = status.lines().find_map(|line| line.strip_prefix(key));
        let number = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
        number.unwrap_or(0) / 1024
    })
}

/// Time that this program has used the processors, on all threads, to 10 ms. Nothing on other systems than Linux.
fn processor_time() -> Option<Duration> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in brackets, may hold spaces. User's and system's ticks are fields 14 and 15.
    let ticks = stat.rsplit_once(')')?.1.split_whitespace().skip(11).take(2);
    let ticks: Vec<u64> = ticks.map_while(|field| field.parse().ok()).collect();
    Some(Duration::from_millis(10 * ticks.iter().sum::<u64>()))
}

/// Feeds all readers of a kind.
fn feed(kind: Kind) {
    let asked = std::env::var("IMPASTO_FUZZ").ok();
    let asked = asked.map(|text| text.parse().expect("IMPASTO_FUZZ is a number of inputs"));
    let chosen = std::env::var("IMPASTO_FUZZ_READERS").ok();
    let started = Instant::now();
    for reader in READERS.iter().filter(|reader| reader.kind == kind) {
        let is_left_out =
            chosen.as_ref().is_some_and(|chosen| chosen.split(',').all(|name| name != reader.name));
        if is_left_out {
            continue;
        }
        let count = asked.unwrap_or(INPUTS);
        let refused = feed_reader(reader, count);
        assert!(refused > 0 || count < 100, "{}: no input was refused", reader.name);
        let [used, asked_for] = peaks_mb();
        let seconds = started.elapsed().as_secs_f64();
        println!(
            "{}: {refused} of {count} refused, {seconds:.1} s, {used} of {asked_for} MB",
            reader.name
        );
    }
}

/// Feeds one reader with `count` inputs and returns how many it refused.
fn feed_reader(reader: &Reader, count: u64) -> usize {
    let seeds = (reader.seeds)();
    let unsound: Vec<String> =
        seeds.iter().filter_map(|(name, seed)| (reader.read)(name, seed).err()).collect();
    assert!(unsound.is_empty(), "{}: files that are not sound: {unsound:?}", reader.name);
    let before = peaks_mb();
    let mut refused = 0;
    for number in 0..count {
        let (name, input) = damage::damaged(reader.name, &seeds, number);
        let started = Instant::now();
        let used = processor_time();
        let fault = match catch_unwind(AssertUnwindSafe(|| (reader.read)(&name, &input))) {
            Err(_) => Some("it panics".to_owned()),
            Ok(Err(words)) if words.trim().is_empty() => Some("an error without words".to_owned()),
            Ok(Err(words)) if words.chars().count() > MOST_LETTERS => {
                Some(format!("an error of {} letters", words.chars().count()))
            }
            Ok(read) => {
                refused += usize::from(read.is_err());
                None
            }
        };
        let mut taken = started.elapsed();
        if taken > LONGEST
            && let (Some(used), Some(now)) = (used, processor_time())
        {
            taken = taken.min(now - used);
        }
        let slow = (taken > LONGEST).then(|| format!("it takes {taken:?}"));
        let peaks = peaks_mb();
        let large = (0..2).find(|&at| peaks[at] > before[at] + MOST_MB[at]);
        let large =
            large.map(|at| format!("the memory grows from {} to {} MB", before[at], peaks[at]));
        if let Some(fault) = fault.or(slow).or(large) {
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
            let file = folder.join(format!("{}-{number}-{name}", reader.name.replace(' ', "-")));
            std::fs::write(&file, &input).unwrap();
            panic!("{}, input {number} ({}): {fault}", reader.name, file.display());
        }
    }
    refused
}

#[test]
fn measurements() {
    feed(Kind::Measurement);
}

#[test]
fn settings_and_lists_in_toml() {
    feed(Kind::Toml);
}

#[test]
fn documents_in_json() {
    feed(Kind::Json);
}

#[test]
fn binary_files() {
    feed(Kind::Binary);
}

#[test]
fn inputs_are_the_same_every_time_and_differ_from_each_other() {
    let seeds = vec![("a.txt".to_owned(), b"one, two and three".to_vec())];
    let inputs = [0, 1].map(|_| -> Vec<_> {
        (0..200).map(|number| damage::damaged("a reader", &seeds, number).1).collect()
    });
    assert_eq!(inputs[0], inputs[1]);
    let distinct: std::collections::BTreeSet<&Vec<u8>> = inputs[0].iter().collect();
    assert!(distinct.len() > 180, "{} of 200 differ", distinct.len());
    assert_ne!(damage::damaged("another reader", &seeds, 0).1, inputs[0][0]);
}
