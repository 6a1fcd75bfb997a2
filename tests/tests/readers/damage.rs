//! Damages sound files: the same damage from the same reader and number.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Texts that readers of numbers, names and markup stumble over.
const TOKENS: [&str; 26] = [
    "1e999",
    "-1",
    "0",
    "1e-300",
    "1e300",
    "NaN",
    "inf",
    "4294967296",
    "18446744073709551616",
    "-0.0",
    "\"\"",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "[[",
    "\n\n",
    "\t",
    ",,",
    "\u{202e}",
    "\u{1b}[2J",
    "=1+1",
    "null",
    "true",
    "\u{fffd}",
];
/// Numbers that lengths and offsets stumble over.
const NUMBERS: [u32; 8] = [0, 1, 0x7f, 0xffff, 0x1000_0000, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff];
/// Longest part that is removed, repeated or moved.
const LONGEST: usize = 200;

/// Input `number` for `reader`, with the name of the seed that it was made from.
pub(crate) fn damaged(reader: &str, seeds: &[(String, Vec<u8>)], number: u64) -> (String, Vec<u8>) {
    // FNV-1a keeps the inputs of readers apart.
    let hash = reader.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let mut random = ChaCha8Rng::seed_from_u64(hash ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let (name, seed) = &seeds[random.random_range(0..seeds.len())];
    let mut bytes = seed.clone();
    for _ in 0..random.random_range(1..8) {
        let other = &seeds[random.random_range(0..seeds.len())].1;
        damage(&mut random, &mut bytes, other);
    }
    (name.clone(), bytes)
}

/// A part of `length` bytes, of at most [`LONGEST`].
fn part(random: &mut impl Rng, length: usize) -> std::ops::Range<usize> {
    let start = random.random_range(0..=length);
    start..length.min(start + random.random_range(0..LONGEST))
}

fn damage(random: &mut impl Rng, bytes: &mut Vec<u8>, other: &[u8]) {
    if bytes.is_empty() {
        bytes.extend_from_slice(other);
        return;
    }
    let length = bytes.len();
    // The first bytes of a file decide what it is.
    let within = if random.random_range(0..4) == 0 { length.min(64) } else { length };
    let at = random.random_range(0..within);
    match random.random_range(0..10) {
        0 => bytes[at] = random.random(),
        1 => bytes[at] ^= 1 << random.random_range(0..8),
        2 => bytes[at] = b"0123456789.-+eE<>&;,/\"'[]{}= \n"[random.random_range(0..30)],
        3 => bytes.truncate(at),
        4 => drop(bytes.drain(part(random, length))),
        5 => {
            let copied = bytes[part(random, length)].to_vec();
            bytes.splice(at..at, copied).for_each(drop);
        }
        6 => {
            let copied = other[part(random, other.len())].to_vec();
            bytes.splice(at..at, copied).for_each(drop);
        }
        7 => {
            let token = TOKENS[random.random_range(0..TOKENS.len())].bytes();
            bytes.splice(at..at, token).for_each(drop);
        }
        // A number of a text becomes another one.
        8 => {
            let is_digit = |byte: &u8| byte.is_ascii_digit();
            let start = at + bytes[at..].iter().position(is_digit).unwrap_or(0);
            let digits = bytes[start..].iter().take_while(|byte| is_digit(byte)).count();
            let token = TOKENS[random.random_range(0..10)].bytes();
            bytes.splice(start..start + digits, token).for_each(drop);
        }
        _ => {
            let number = NUMBERS[random.random_range(0..NUMBERS.len())];
            let number = if random.random() { number.to_le_bytes() } else { number.to_be_bytes() };
            let end = length.min(at + 4);
            bytes[at..end].copy_from_slice(&number[..end - at]);
        }
    }
}
