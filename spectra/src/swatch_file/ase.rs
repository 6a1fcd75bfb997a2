//! Adobe Swatch Exchange (.ase): blocks of colours and groups, big-endian.
//!
//! Adobe has not published the format; the layout is that which other programs read and write
//! (O. Berisha, "Adobe Swatch Exchange file format", 2006).

use super::bytes::{Bytes, put_units, units};
use super::entries::{SwatchColor, SwatchEntry, SwatchFile};
use super::error::SwatchFileError;
use crate::color::{Lab, Rgb};

const COLOR: u16 = 0x0001;
const GROUP_START: u16 = 0xc001;
const GROUP_END: u16 = 0xc002;
/// Type of an ordinary colour, which is neither global nor a spot colour.
const NORMAL: u16 = 2;
/// The four letters of a colour model, and its values.
type Model<'a> = (&'a [u8; 4], Vec<f64>);

/// Writes an `.ase` file. Adjacent colours of one group are written as a group; RGB is clipped
/// to the gamut.
///
/// # Errors
/// [`SwatchFileError::TooMany`] for a name that is too long.
pub fn write_ase(palette: &SwatchFile) -> Result<Vec<u8>, SwatchFileError> {
    let mut blocks: Vec<(u16, Vec<u8>)> = Vec::new();
    let mut open = "";
    for swatch in &palette.swatches {
        if swatch.group != open {
            if !open.is_empty() {
                blocks.push((GROUP_END, Vec::new()));
            }
            if !swatch.group.is_empty() {
                blocks.push((GROUP_START, name(&swatch.group)?));
            }
            open = &swatch.group;
        }
        let mut block = name(&swatch.name)?;
        let (model, values) = model(swatch.color);
        block.extend(model);
        block.extend(values.iter().flat_map(|value| (*value as f32).to_be_bytes()));
        block.extend(NORMAL.to_be_bytes());
        blocks.push((COLOR, block));
    }
    if !open.is_empty() {
        blocks.push((GROUP_END, Vec::new()));
    }
    let mut bytes = b"ASEF\x00\x01\x00\x00".to_vec();
    bytes.extend((blocks.len() as u32).to_be_bytes());
    for (kind, block) in blocks {
        bytes.extend(kind.to_be_bytes());
        bytes.extend((block.len() as u32).to_be_bytes());
        bytes.extend(block);
    }
    Ok(bytes)
}

fn name(text: &str) -> Result<Vec<u8>, SwatchFileError> {
    let units = units(".ase", text)?;
    let mut bytes = (units.len() as u16).to_be_bytes().to_vec();
    put_units(&mut bytes, &units);
    Ok(bytes)
}

fn model(color: SwatchColor) -> Model<'static> {
    match color {
        SwatchColor::Rgb(Rgb(rgb)) => (b"RGB ", rgb.map(|v| v.clamp(0.0, 1.0)).to_vec()),
        SwatchColor::Lab(lab) => (b"LAB ", vec![lab.lightness / 100.0, lab.a, lab.b]),
        SwatchColor::Cmyk(inks) => (b"CMYK", inks.to_vec()),
        SwatchColor::Grey(grey) => (b"Gray", vec![grey]),
    }
}

/// Reads `bytes`, the content of `file`. Blocks of other kinds are skipped.
///
/// # Errors
/// [`SwatchFileError`] with the offset in bytes.
pub fn read_ase(file: &str, bytes: &[u8]) -> Result<SwatchFile, SwatchFileError> {
    let mut bytes = Bytes { file, rest: bytes, offset: 0 };
    let head = bytes.part(4, "`ASEF`")?;
    if head.rest != b"ASEF" {
        return Err(bytes.wrong(0, "`ASEF`", head.rest.escape_ascii()));
    }
    bytes.u32("a version")?;
    let count = bytes.u32("the number of blocks")?;
    let mut palette = SwatchFile::default();
    let mut group = String::new();
    for _ in 0..count {
        let kind = bytes.u16("a block")?;
        let length = bytes.u32("the length of a block")?;
        let mut block = bytes.part(length as usize, "a block of the stated length")?;
        match kind {
            GROUP_START => group = text(&mut block)?,
            GROUP_END => group.clear(),
            COLOR => {
                let name = text(&mut block)?;
                let color = color(&mut block)?;
                palette.swatches.push(SwatchEntry { name, group: group.clone(), color });
            }
            _ => {}
        }
    }
    Ok(palette)
}

fn text(block: &mut Bytes<'_>) -> Result<String, SwatchFileError> {
    let count = block.u16("the length of a name")?;
    block.text(count.into())
}

fn color(block: &mut Bytes<'_>) -> Result<SwatchColor, SwatchFileError> {
    let model = block.part(4, "a colour model")?;
    let mut value = || block.f32("a number");
    Ok(match model.rest {
        b"RGB " => SwatchColor::Rgb(Rgb([value()?, value()?, value()?])),
        b"LAB " => {
            let lightness = value()? * 100.0;
            SwatchColor::Lab(Lab { lightness, a: value()?, b: value()? })
        }
        b"CMYK" => SwatchColor::Cmyk([value()?, value()?, value()?, value()?]),
        b"Gray" => SwatchColor::Grey(value()?),
        other => {
            let found = other.escape_ascii();
            return Err(block.wrong(model.offset, "RGB, LAB, CMYK or Gray", found));
        }
    })
}
