//! Validation of OBJ and MTL files line by line, since the parser reports no line numbers
//! and panics on some input.

use documents::counted;

/// Line number from 1, and the reason.
pub(super) type LineFault = (usize, String);

/// Number of positions, texture coordinates and normals.
#[derive(Debug, Default, Clone, Copy)]
struct Counts {
    positions: usize,
    coordinates: usize,
    normals: usize,
}

/// Checks the lines of an OBJ file that affect the mesh.
pub(super) fn check_obj(text: &str) -> Result<(), LineFault> {
    let words = |line: &'_ str| line.split_whitespace().next().map(str::to_owned);
    let count = |of: &str| text.lines().filter(|line| words(line).as_deref() == Some(of)).count();
    let all = Counts { positions: count("v"), coordinates: count("vt"), normals: count("vn") };
    let mut so_far = Counts::default();
    let mut colored = None;
    for (line, number) in text.lines().zip(1..) {
        let fault = |reason: String| (number, reason);
        let mut words = line.split_whitespace();
        let Some(first) = words.next() else { continue };
        let words: Vec<&str> = words.collect();
        match first {
            "v" => {
                so_far.positions += 1;
                let found = numbers(&words).map_err(fault)?;
                if ![3, 4, 6].contains(&found) {
                    return Err(fault(format!(
                        "{} for a position: `{line}`",
                        counted(found, "number")
                    )));
                }
                if words.get(3).is_some_and(|w| found == 4 && w.parse() == Ok(0.0f32)) {
                    return Err(fault(format!("a position divided by 0: `{line}`")));
                }
                if *colored.get_or_insert(found == 6) != (found == 6) {
                    let reason = "some vertices have colours and some do not";
                    return Err(fault(format!("{reason}: `{line}`")));
                }
            }
            "vt" => {
                so_far.coordinates += 1;
                if !(2..=3).contains(&numbers(&words).map_err(fault)?) {
                    return Err(fault(format!("no texture coordinate of 2 numbers: `{line}`")));
                }
            }
            "vn" => {
                so_far.normals += 1;
                if numbers(&words).map_err(fault)? != 3 {
                    return Err(fault(format!("no normal of 3 numbers: `{line}`")));
                }
            }
            "f" => {
                if words.len() < 3 {
                    return Err(fault(format!(
                        "a face of {}: `{line}`",
                        counted(words.len(), "corner")
                    )));
                }
                words.iter().try_for_each(|word| corner(word, so_far, all)).map_err(fault)?;
            }
            "l" => {
                words.iter().try_for_each(|word| corner(word, so_far, all)).map_err(fault)?;
            }
            "usemtl" if words.is_empty() => {
                return Err(fault("`usemtl` without a name".to_owned()));
            }
            _ => {}
        }
    }
    Ok(())
}

/// Checks the colour lines of an MTL file.
pub(super) fn check_mtl(text: &str) -> Result<(), LineFault> {
    for (line, number) in text.lines().zip(1..) {
        let mut words = line.split_whitespace();
        let first = words.next().unwrap_or_default();
        let words: Vec<&str> = words.collect();
        if ["Ka", "Kd", "Ks", "Ke"].contains(&first) {
            let found = numbers(&words).map_err(|reason| (number, reason))?;
            if found != 3 {
                return Err((number, format!("no colour of 3 numbers: `{line}`")));
            }
        }
    }
    Ok(())
}

/// Number of words, if all of them are finite numbers.
fn numbers(words: &[&str]) -> Result<usize, String> {
    let bad = words.iter().find(|word| !word.parse::<f32>().is_ok_and(f32::is_finite));
    match bad {
        Some(word) => Err(format!("not a finite number: `{word}`")),
        None => Ok(words.len()),
    }
}

/// Checks a face corner `position/texture/normal`, of which the last two may be missing.
/// Negative indices count back from the latest entry.
fn corner(word: &str, so_far: Counts, all: Counts) -> Result<(), String> {
    let kinds = [
        ("position", so_far.positions, all.positions),
        ("texture coordinate", so_far.coordinates, all.coordinates),
        ("normal", so_far.normals, all.normals),
    ];
    let indices: Vec<&str> = word.split('/').collect();
    if indices.len() > kinds.len() {
        return Err(format!("not a corner: `{word}`"));
    }
    for (index, (kind, so_far, all)) in indices.iter().zip(kinds) {
        if index.is_empty() && kind != "position" {
            continue;
        }
        let index: i64 = index.parse().map_err(|_| format!("not a corner: `{word}`"))?;
        let within = match index {
            0 => false,
            1.. => index <= all as i64,
            _ => index >= -(so_far as i64),
        };
        if !within {
            return Err(format!("no {kind} `{index}`, there are {all}"));
        }
    }
    Ok(())
}
