//! Photoshop colour swatches (.aco): a section of version 1 without names, then one of version
//! 2 with names.
//!
//! Adobe, "Adobe Photoshop File Formats Specification", section "Color Swatches".

use super::bytes::{Bytes, put_units, units};
use super::entries::{SwatchColor, SwatchEntry, SwatchFile};
use super::error::SwatchFileError;
use crate::color::{Lab, Rgb};

const RGB: u16 = 0;
const HSB: u16 = 1;
const CMYK: u16 = 2;
const LAB: u16 = 7;
const GREY: u16 = 8;

/// Writes both versions of an `.aco` file. Groups are left out.
///
/// # Errors
/// [`SwatchFileError::TooMany`] if the format cannot count the colours, or the letters of a
/// name.
pub fn write_aco(palette: &SwatchFile) -> Result<Vec<u8>, SwatchFileError> {
    let Ok(count) = u16::try_from(palette.swatches.len()) else {
        let what = "colours";
        let found = palette.swatches.len();
        return Err(SwatchFileError::TooMany { format: ".aco", what, found });
    };
    let mut bytes = Vec::new();
    for version in [1u16, 2] {
        bytes.extend(version.to_be_bytes());
        bytes.extend(count.to_be_bytes());
        for swatch in &palette.swatches {
            let (space, values) = words(swatch.color);
            bytes.extend(space.to_be_bytes());
            bytes.extend(values.iter().flat_map(|word| word.to_be_bytes()));
            if version == 2 {
                let units = units(".aco", &swatch.name)?;
                bytes.extend((units.len() as u32).to_be_bytes());
                put_units(&mut bytes, &units);
            }
        }
    }
    Ok(bytes)
}

/// The colour space and the four 16-bit words of a colour.
fn words(color: SwatchColor) -> (u16, [u16; 4]) {
    let share = |v: f64| (v.clamp(0.0, 1.0) * 65535.0).round() as u16;
    // Hundredths in two's complement.
    let hundredths = |v: f64| ((v * 100.0).round().clamp(-12800.0, 12700.0) as i16) as u16;
    match color {
        SwatchColor::Rgb(Rgb([r, g, b])) => (RGB, [share(r), share(g), share(b), 0]),
        SwatchColor::Lab(lab) => {
            let lightness = (lab.lightness * 100.0).round().clamp(0.0, 10000.0) as u16;
            (LAB, [lightness, hundredths(lab.a), hundredths(lab.b), 0])
        }
        // CMYK values are inverted: 0 is full ink.
        SwatchColor::Cmyk(inks) => (CMYK, inks.map(|ink| share(1.0 - ink))),
        SwatchColor::Grey(grey) => {
            (GREY, [(grey.clamp(0.0, 1.0) * 10000.0).round() as u16, 0, 0, 0])
        }
    }
}

/// Reads `bytes`, the content of `file`: its section of version 2 if there is one, otherwise
/// that of version 1, which has no names.
///
/// # Errors
/// [`SwatchFileError`] with the offset in bytes.
pub fn read_aco(file: &str, bytes: &[u8]) -> Result<SwatchFile, SwatchFileError> {
    let mut bytes = Bytes { file, rest: bytes, offset: 0 };
    let mut palette = None;
    while palette.is_none() || !bytes.rest.is_empty() {
        let offset = bytes.offset;
        let version = bytes.u16("version 1 or 2")?;
        if !(version == 2 || version == 1 && palette.is_none()) {
            return Err(bytes.wrong(offset, "version 1 or 2", version));
        }
        palette = Some(section(&mut bytes, version)?);
        if version == 2 {
            break;
        }
    }
    Ok(palette.unwrap_or_default())
}

fn section(bytes: &mut Bytes<'_>, version: u16) -> Result<SwatchFile, SwatchFileError> {
    let count = bytes.u16("the number of colours")?;
    let mut palette = SwatchFile::default();
    for _ in 0..count {
        let offset = bytes.offset;
        let space = bytes.u16("a colour space")?;
        let mut word = || bytes.u16("a colour of four words");
        let words = [word()?, word()?, word()?, word()?];
        let color = color(space, words)
            .ok_or_else(|| bytes.wrong(offset, "RGB, HSB, CMYK, Lab or grey", space))?;
        let name = if version == 2 {
            let length = bytes.u32("the length of a name")?;
            bytes.text(length as usize)?
        } else {
            String::new()
        };
        palette.swatches.push(SwatchEntry { name, group: String::new(), color });
    }
    Ok(palette)
}

/// The colour of a space and its words; `None` for other spaces, such as books of spot colours.
fn color(space: u16, words: [u16; 4]) -> Option<SwatchColor> {
    let shares = words.map(|word| f64::from(word) / 65535.0);
    let hundredths = |word: u16| f64::from(word as i16) / 100.0;
    Some(match space {
        RGB => SwatchColor::Rgb(Rgb([shares[0], shares[1], shares[2]])),
        HSB => SwatchColor::Rgb(rgb_from_hsb(shares[0], shares[1], shares[2])),
        CMYK => SwatchColor::Cmyk(shares.map(|share| 1.0 - share)),
        LAB => SwatchColor::Lab(Lab {
            lightness: f64::from(words[0]) / 100.0,
            a: hundredths(words[1]),
            b: hundredths(words[2]),
        }),
        GREY => SwatchColor::Grey(f64::from(words[0]) / 10000.0),
        _ => return None,
    })
}

/// RGB of hue (in turns), saturation and brightness (Smith 1978).
fn rgb_from_hsb(hue: f64, saturation: f64, brightness: f64) -> Rgb {
    Rgb([5.0, 3.0, 1.0].map(|shift| {
        let k = (shift + 6.0 * hue) % 6.0;
        brightness * (1.0 - saturation * k.min(4.0 - k).clamp(0.0, 1.0))
    }))
}
