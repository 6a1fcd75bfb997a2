//! Wavefront OBJ, with its MTL materials and their textures.
//!
//! We validate OBJ and MTL files line by line first, because the parser does not report line
//! numbers and panics on some input.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::Path;

use documents::counted;
use documents::file::{NamedFiles, Outside};

use super::part::{MeshError, PAINTED, PLAIN, Part, Parts, Read, Textures};
use crate::mesh::model::{Material, Texture};

/// Reads an OBJ file. We take colours of materials and vertices as encoded sRGB. If some vertices
/// of a group lack a normal or texture coordinate, this ignores all of the group's.
pub(super) fn read(path: &Path, bytes: &[u8], outside: Outside) -> Result<Read, MeshError> {
    let name = &path.display().to_string();
    let text = String::from_utf8_lossy(bytes);
    fn at_line(name: &str, (line, reason): (usize, String)) -> MeshError {
        MeshError::Malformed { name: name.to_owned(), place: format!("line {line}"), reason }
    }
    check_obj(&text).map_err(|fault| at_line(name, fault))?;
    let options = tobj::LoadOptions {
        single_index: true,
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
    };
    let files = RefCell::new(NamedFiles::of(path, outside));
    let libraries = RefCell::new(BTreeSet::new());
    // tobj's error type cannot carry our errors out of the callback.
    let failed = RefCell::new(None);
    let loaded = tobj::load_obj_buf(&mut text.as_bytes(), &options, |file| {
        let named = file.display().to_string();
        // A library that is named a thousand times is read once.
        if !libraries.borrow_mut().insert(named.clone()) {
            return Ok(Default::default());
        }
        let name = path.with_file_name(file).display().to_string();
        let read = files.borrow_mut().read("mtllib", &named).map_err(MeshError::from);
        let checked = read.and_then(|bytes| {
            let text = String::from_utf8_lossy(&bytes).into_owned();
            check_mtl(&text).map_err(|fault| at_line(&name, fault)).map(|()| text)
        });
        let loaded = checked.and_then(|text| {
            tobj::load_mtl_buf(&mut text.as_bytes()).map_err(|error| MeshError::Malformed {
                name: name.clone(),
                place: "materials".to_owned(),
                reason: error.to_string(),
            })
        });
        loaded.map_err(|error| {
            failed.borrow_mut().get_or_insert(error);
            tobj::LoadError::OpenFileFailed
        })
    });
    if let Some(error) = failed.into_inner() {
        return Err(error);
    }
    let (models, materials) = match loaded {
        Ok((models, Ok(materials))) => (models, materials),
        Ok((_, Err(error))) | Err(error) => {
            return Err(MeshError::Malformed {
                name: name.to_owned(),
                place: "faces".to_owned(),
                reason: error.to_string(),
            });
        }
    };
    unknown_material(&text, &materials).map_or(Ok(()), |fault| Err(at_line(name, fault)))?;
    let mut files = files.into_inner();
    let mut parts = Parts::default();
    let mut textures = Textures::default();
    for material in &materials {
        let material = painted(name, material, &mut files, &mut textures)?;
        parts.mesh.materials.push(material);
    }
    let plain = parts.mesh.materials.len() as u32;
    // Either all vertices of a file have colours or none has.
    let colored = models.iter().any(|model| !model.mesh.vertex_color.is_empty());
    for model in models {
        let tobj::Mesh { positions, normals, texcoords, vertex_color, indices, .. } = model.mesh;
        let count = positions.len() / 3;
        let material = model.mesh.material_id.map_or(plain, |id| id as u32);
        let positions = positions.chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect();
        let mut part = Part { positions, material, ..Part::default() };
        if normals.len() == 3 * count {
            part.normals = triples(&normals);
        }
        if texcoords.len() == 2 * count {
            let upwards = texcoords.chunks_exact(2);
            let upwards = upwards.map(|at| [at[0] as f32, 1.0 - at[1] as f32]);
            part.texture_coordinates = upwards.collect();
        }
        if vertex_color.len() == 3 * count {
            let colors = triples(&vertex_color);
            part.colors = colors.iter().map(|rgb| rgb.map(|v| v.clamp(0.0, 1.0))).collect();
        }
        part.corners = indices;
        parts.add(part).map_err(|fault| MeshError::faulty(path, fault))?;
    }
    if parts.mesh.triangles.iter().any(|triangle| triangle.material == plain) {
        parts.mesh.materials.push(if colored { PAINTED } else { PLAIN });
    }
    let finished = parts.finish();
    let (mesh, origin) = finished.map_err(|fault| MeshError::faulty(path, fault))?;
    Ok((mesh, origin, files.found().to_vec()))
}

fn triples(values: &[f64]) -> Vec<[f32; 3]> {
    values.chunks_exact(3).map(|at| [0, 1, 2].map(|i| at[i] as f32)).collect()
}

/// First `usemtl` line that names an unknown material. A file without `mtllib` may name any
/// material.
fn unknown_material(text: &str, materials: &[tobj::Material]) -> Option<(usize, String)> {
    let has_library = text.lines().any(|line| line.trim().starts_with("mtllib "));
    let known: BTreeSet<&str> = materials.iter().map(|material| material.name.as_str()).collect();
    has_library
        .then(|| {
            text.lines().zip(1..).find_map(|(line, number): (&str, usize)| {
                let name = line.trim().strip_prefix("usemtl ")?.trim();
                let reason = format!("no material `{name}` in the libraries");
                (!known.contains(name)).then_some((number, reason))
            })
        })
        .flatten()
}

fn painted(
    name: &str,
    found: &tobj::Material,
    files: &mut NamedFiles,
    textures: &mut Textures,
) -> Result<Material, MeshError> {
    let texture = match &found.diffuse_texture {
        None => None,
        Some(arguments) => {
            let file = without_options(arguments).replace('\\', "/");
            let bytes = files.read(&format!("map_Kd of the material `{}`", found.name), &file)?;
            let texture: Result<Texture, String> = textures.decode(&bytes);
            Some(texture.map_err(|reason| MeshError::Texture {
                name: name.to_owned(),
                texture: file,
                reason,
            })?)
        }
    };
    // A textured material without a colour shows its texture unchanged.
    let plain = PLAIN.color.map(f64::from);
    let color = found.diffuse.unwrap_or(if texture.is_some() { [1.0; 3] } else { plain });
    let color = color.map(|value| (value as f32).clamp(0.0, 1.0));
    Ok(Material { name: found.name.clone(), color, texture })
}

/// Strips the options in front of a texture's file name, e.g. `-s 1 1 1 wood.png`.
fn without_options(arguments: &str) -> &str {
    let mut rest = arguments.trim();
    while rest.starts_with('-') {
        let mut after = rest.split_once(char::is_whitespace).map_or("", |(_, after)| after);
        while let Some((word, further)) = after.trim_start().split_once(char::is_whitespace) {
            if word.parse::<f32>().is_err() && !["on", "off"].contains(&word) {
                break;
            }
            after = further;
        }
        rest = after.trim_start();
    }
    rest
}

/// Line number from 1, and the reason.
pub(super) type LineFault = (usize, String);

#[derive(Debug, Default, Clone, Copy)]
struct Counts {
    positions: usize,
    coordinates: usize,
    normals: usize,
}

pub(super) fn check_obj(text: &str) -> Result<(), LineFault> {
    fn words(line: &'_ str) -> Option<String> {
        line.split_whitespace().next().map(str::to_owned)
    }
    fn count(of: &str, text: &str) -> usize {
        text.lines().filter(|line| words(line).as_deref() == Some(of)).count()
    }
    let all = Counts {
        positions: count("v", text),
        coordinates: count("vt", text),
        normals: count("vn", text),
    };
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

fn numbers(words: &[&str]) -> Result<usize, String> {
    let bad = words.iter().find(|word| !word.parse::<f32>().is_ok_and(f32::is_finite));
    match bad {
        Some(word) => Err(format!("not a finite number: `{word}`")),
        None => Ok(words.len()),
    }
}

/// Checks a face corner `position/texture/normal`, where you may leave out the last two. Negative
/// indices count back from the latest entry.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_named_after_its_options() {
        for (arguments, wanted) in [
            ("wood.png", "wood.png"),
            ("-s 1 2 3 -clamp on my wood.png", "my wood.png"),
            ("-bm 0.5", "0.5"),
            ("-", ""),
        ] {
            assert_eq!(without_options(arguments), wanted);
        }
    }
}
