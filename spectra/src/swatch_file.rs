//! Swatch files of painting programs: named colours without spectra.
//!
//! | extension | program | content |
//! |------|----|-------|
//! | `.gpl` | GIMP, Inkscape, Krita | sRGB in 8 bits, in lines of `R G B<tab>name` after a header |
//! | `.ase` | Adobe programs | RGB, Lab, CMYK or grey as 32-bit floats, in big-endian blocks of colours and groups |
//! | `.aco` | Photoshop | RGB, HSB, Lab, CMYK or grey in 16 bits: a section of version 1 without names, then one of version 2 with names |
//!
//! None of the formats names its RGB space, so we take it for sRGB. Lab is under D50 for the 1931
//! observer, as in the graphic arts.
//!
//! Sources: GIMP developer documentation, "GIMP Palette (.gpl) File Format". Adobe, "Adobe
//! Photoshop File Formats Specification", section "Color Swatches". Adobe has not published the
//! format of `.ase`. We use the layout that other programs read and write (O. Berisha, "Adobe
//! Swatch Exchange file format", 2006).

use std::fmt::Write;

use documents::hint::Explain;
use documents::{excerpt, name_violation, plain_name};

use crate::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};
use crate::grid::Grid;
use crate::illuminant::{Illuminant, Observer};
use crate::interpolate::Interpolation;
use crate::viewing::TristimulusWeights;

/// A colour in one of the models of swatch files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SwatchColor {
    /// Encoded RGB, each channel 0 to 1. We take it for sRGB, because swatch files do not name the
    /// RGB space.
    Rgb(Rgb),
    /// CIELAB under D50 ([`d50_white`]).
    Lab(Lab),
    /// Amounts of ink, each 0 to 1. Without a colour profile they do not define a colour.
    Cmyk([f64; 4]),
    /// Grey, from 0 for black to 1 for white.
    Grey(f64),
}

impl SwatchColor {
    /// The colour in sRGB, not clipped to the gamut. Inks give `None`.
    #[must_use]
    pub fn srgb(self) -> Option<Rgb> {
        match self {
            Self::Rgb(rgb) => Some(rgb),
            Self::Lab(lab) => {
                let white = d50_white();
                let xyz = lab.to_xyz(white);
                Some(RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford))
            }
            Self::Cmyk(_) => None,
            Self::Grey(grey) => Some(Rgb([grey; 3])),
        }
    }
}

/// White point of Lab in swatch files: D50 for the observer of 1931.
#[must_use]
pub fn d50_white() -> Xyz {
    let light = Illuminant::named("D50").expect("D50 is in the table of CIE illuminants");
    let weights =
        TristimulusWeights::new(Grid::cie(), &light, Observer::default(), Interpolation::Linear);
    weights.expect("linear interpolation suits any grid").white()
}

/// One named colour of a swatch file.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchEntry {
    /// Name of the colour.
    pub name: String,
    /// Name of its group, empty for none. Only `.ase` files have groups.
    pub group: String,
    /// Value of the colour.
    pub color: SwatchColor,
}

/// The content of a swatch file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SwatchFile {
    /// Name of the whole palette. Only `.gpl` files have one.
    pub name: String,
    /// The colours in the order of the file.
    pub swatches: Vec<SwatchEntry>,
}

/// Reads `bytes`, the content of `file`, if it is a swatch file, otherwise gives `None`. The first
/// bytes decide this, or the name for `.aco`, which has no fixed first bytes.
pub fn read_swatch_file(file: &str, bytes: &[u8]) -> Result<Option<SwatchFile>, SwatchFileError> {
    let name = file.to_ascii_lowercase();
    if bytes.starts_with(b"ASEF") || name.ends_with(".ase") {
        return read_ase(file, bytes).map(Some);
    }
    if bytes.starts_with(b"GIMP Palette") || name.ends_with(".gpl") {
        return read_gpl(file, bytes).map(Some);
    }
    if name.ends_with(".aco") {
        return read_aco(file, bytes).map(Some);
    }
    Ok(None)
}

const HEAD: &str = "GIMP Palette";

/// Writes a `.gpl` file. This clips colours outside sRGB and turns control characters in names into
/// spaces.
///
/// # Errors
/// [`SwatchFileError::Color`] for inks, which do not define a colour.
pub fn write_gpl(palette: &SwatchFile) -> Result<String, SwatchFileError> {
    let name = one_line(&palette.name);
    let mut text = format!("{HEAD}\nName: {name}\nColumns: 0\n#\n");
    for swatch in &palette.swatches {
        let rgb = swatch
            .color
            .srgb()
            .ok_or_else(|| SwatchFileError::Color { format: ".gpl", name: swatch.name.clone() })?;
        let [r, g, b] = rgb.to_bytes();
        let name = one_line(&swatch.name);
        writeln!(text, "{r:3} {g:3} {b:3}\t{name}").expect("writing to a string succeeds");
    }
    Ok(text)
}

/// Reads `bytes`, the content of `file`.
pub fn read_gpl(file: &str, bytes: &[u8]) -> Result<SwatchFile, SwatchFileError> {
    let text = std::str::from_utf8(bytes).map_err(|error| SwatchFileError::Bytes {
        file: file.to_owned(),
        offset: error.valid_up_to(),
        expected: "text in UTF-8",
        found: format!("{:#04x}", bytes[error.valid_up_to()]),
    })?;
    let wrong = |line: usize, expected, text: &str| SwatchFileError::Line {
        file: file.to_owned(),
        line,
        expected,
        text: text.escape_default().take(40).collect(),
    };
    let mut lines = text.trim_start_matches('\u{feff}').lines().zip(1..);
    let head = lines.next().map_or("", |(line, _)| line.trim());
    if head != HEAD {
        return Err(wrong(1, "`GIMP Palette`", head));
    }
    let mut palette = SwatchFile::default();
    for (line, number) in lines {
        let line = line.trim();
        if let Some(name) = line.strip_prefix("Name:") {
            name.trim().clone_into(&mut palette.name);
        } else if !(line.is_empty() || line.starts_with('#') || line.starts_with("Columns:")) {
            let mut rest = line;
            let mut channels = [0.0; 3];
            for channel in &mut channels {
                let (word, after) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
                let byte: u8 = word
                    .parse()
                    .map_err(|_| wrong(number, "three numbers from 0 to 255, then a name", line))?;
                *channel = f64::from(byte) / 255.0;
                rest = after.trim_start();
            }
            let name = plain_name(rest);
            if let Some(wanted) = name_violation(&name).filter(|_| !name.is_empty()) {
                return Err(wrong(number, wanted, rest));
            }
            palette.swatches.push(SwatchEntry {
                name,
                group: String::new(),
                color: SwatchColor::Rgb(Rgb(channels)),
            });
        }
    }
    Ok(palette)
}

fn one_line(name: &str) -> String {
    plain_name(name)
}

const COLOR: u16 = 0x0001;
const GROUP_START: u16 = 0xc001;
const GROUP_END: u16 = 0xc002;
/// Type of an ordinary colour, which is neither global nor a spot colour.
const NORMAL: u16 = 2;
/// The four letters of a colour model, and its values.
type Model<'a> = (&'a [u8; 4], Vec<f64>);

/// Writes an `.ase` file. This writes adjacent colours of one group as a group, and clips RGB to
/// the gamut.
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

/// Reads `bytes`, the content of `file`. This skips blocks of other kinds.
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

const RGB: u16 = 0;
const HSB: u16 = 1;
const CMYK: u16 = 2;
const LAB: u16 = 7;
const GREY: u16 = 8;

/// Writes both versions of an `.aco` file. This leaves out groups.
///
/// # Errors
/// [`SwatchFileError::TooMany`] if the format cannot count the colours, or the letters of a name.
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
    match color {
        SwatchColor::Rgb(Rgb([r, g, b])) => {
            (RGB, [word_of_share(r), word_of_share(g), word_of_share(b), 0])
        }
        SwatchColor::Lab(lab) => {
            let lightness = (lab.lightness * 100.0).round().clamp(0.0, 10000.0) as u16;
            (LAB, [lightness, word_of_hundredths(lab.a), word_of_hundredths(lab.b), 0])
        }
        // CMYK values are inverted: 0 is full ink.
        SwatchColor::Cmyk(inks) => (CMYK, inks.map(|ink| word_of_share(1.0 - ink))),
        SwatchColor::Grey(grey) => {
            (GREY, [(grey.clamp(0.0, 1.0) * 10000.0).round() as u16, 0, 0, 0])
        }
    }
}

/// Hundredths in two's complement.
fn word_of_hundredths(v: f64) -> u16 {
    ((v * 100.0).round().clamp(-12800.0, 12700.0) as i16) as u16
}

fn word_of_share(v: f64) -> u16 {
    (v.clamp(0.0, 1.0) * 65535.0).round() as u16
}

/// Reads `bytes`, the content of `file`: its section of version 2, or if there is none, its section
/// of version 1, which has no names.
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
        let mut words = [0; 4];
        for word in &mut words {
            *word = bytes.u16("a colour of four words")?;
        }
        let color = aco_color(space, words)
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

/// The colour of a space and its words. Other spaces, for example books of spot colours, give
/// `None`.
fn aco_color(space: u16, words: [u16; 4]) -> Option<SwatchColor> {
    let shares = words.map(|word| f64::from(word) / 65535.0);
    Some(match space {
        RGB => SwatchColor::Rgb(Rgb([shares[0], shares[1], shares[2]])),
        HSB => SwatchColor::Rgb(rgb_from_hsb(shares[0], shares[1], shares[2])),
        CMYK => SwatchColor::Cmyk(shares.map(|share| 1.0 - share)),
        LAB => SwatchColor::Lab(Lab {
            lightness: f64::from(words[0]) / 100.0,
            a: hundredths_of_word(words[1]),
            b: hundredths_of_word(words[2]),
        }),
        GREY => SwatchColor::Grey(f64::from(words[0]) / 10000.0),
        _ => return None,
    })
}

fn hundredths_of_word(word: u16) -> f64 {
    f64::from(word as i16) / 100.0
}

/// RGB of hue (in turns), saturation and brightness (Smith 1978).
fn rgb_from_hsb(hue: f64, saturation: f64, brightness: f64) -> Rgb {
    Rgb([5.0, 3.0, 1.0].map(|shift| {
        let k = (shift + 6.0 * hue) % 6.0;
        brightness * (1.0 - saturation * k.min(4.0 - k).clamp(0.0, 1.0))
    }))
}

struct Bytes<'a> {
    file: &'a str,
    rest: &'a [u8],
    /// Offset of `rest` in the file, in bytes.
    offset: usize,
}

impl<'a> Bytes<'a> {
    fn wrong(
        &self,
        offset: usize,
        expected: &'static str,
        found: impl ToString,
    ) -> SwatchFileError {
        let file = self.file.to_owned();
        let found = found.to_string();
        SwatchFileError::Bytes { file, offset, expected, found }
    }

    /// Splits off the next `count` bytes.
    fn part(&mut self, count: usize, expected: &'static str) -> Result<Self, SwatchFileError> {
        let Some((head, rest)) = self.rest.split_at_checked(count) else {
            let found = format!("{} bytes before the end", self.rest.len());
            return Err(self.wrong(self.offset, expected, found));
        };
        let part = Bytes { file: self.file, rest: head, offset: self.offset };
        self.rest = rest;
        self.offset += count;
        Ok(part)
    }

    fn array<const N: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[u8; N], SwatchFileError> {
        let part = self.part(N, expected)?;
        Ok(part.rest.try_into().expect("a part has the requested length"))
    }

    fn u16(&mut self, expected: &'static str) -> Result<u16, SwatchFileError> {
        Ok(u16::from_be_bytes(self.array(expected)?))
    }

    fn u32(&mut self, expected: &'static str) -> Result<u32, SwatchFileError> {
        Ok(u32::from_be_bytes(self.array(expected)?))
    }

    fn f32(&mut self, expected: &'static str) -> Result<f64, SwatchFileError> {
        let offset = self.offset;
        let value = f32::from_be_bytes(self.array(expected)?);
        if value.is_finite() { Ok(value.into()) } else { Err(self.wrong(offset, expected, value)) }
    }

    /// Reads text of `count` UTF-16 units, including a closing zero.
    fn text(&mut self, count: usize) -> Result<String, SwatchFileError> {
        let expected = "a name in UTF-16";
        let mut part = self.part(count.saturating_mul(2), expected)?;
        let offset = part.offset;
        let mut units = Vec::with_capacity(count);
        while !part.rest.is_empty() {
            units.push(part.u16(expected)?);
        }
        if units.last() == Some(&0) {
            units.pop();
        }
        let text = String::from_utf16(&units)
            .map_err(|_| self.wrong(offset, expected, "half a surrogate pair"))?;
        let name = plain_name(&text);
        match name_violation(&name).filter(|_| !name.is_empty()) {
            Some(wanted) => Err(self.wrong(offset, wanted, excerpt(&name))),
            None => Ok(name),
        }
    }
}

/// `text` as UTF-16 units with a closing zero.
fn units(format: &'static str, text: &str) -> Result<Vec<u16>, SwatchFileError> {
    let mut units: Vec<u16> = text.encode_utf16().collect();
    units.push(0);
    if units.len() > usize::from(u16::MAX) {
        let what = "letters of a name";
        return Err(SwatchFileError::TooMany { format, what, found: units.len() });
    }
    Ok(units)
}

fn put_units(bytes: &mut Vec<u8>, units: &[u16]) {
    bytes.extend(units.iter().flat_map(|unit| unit.to_be_bytes()));
}

/// A swatch file that cannot be read or written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
pub enum SwatchFileError {
    /// Bytes do not follow the format.
    #[error("{file}, byte {offset}: expected {expected}, found `{found}`")]
    Bytes {
        /// Path of the file.
        file: String,
        /// Offset in bytes, from 0.
        offset: usize,
        /// Description of the expected content.
        expected: &'static str,
        /// The content that was found.
        found: String,
    },
    /// A line does not follow the format.
    #[error("{file}, line {line}: expected {expected}, found `{text}`")]
    Line {
        /// Path of the file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// Description of the expected content.
        expected: &'static str,
        /// The content of the line, shortened.
        text: String,
    },
    /// The format cannot represent a colour.
    #[error("{format} files cannot hold the colour of `{name}`")]
    Color {
        /// Extension of the format.
        format: &'static str,
        /// Name of the swatch.
        name: String,
    },
    /// There are more items than the format can count.
    #[error("{format} files hold up to 65535 {what}, found `{found}`")]
    TooMany {
        /// Extension of the format.
        format: &'static str,
        /// The things that are counted, in the plural.
        what: &'static str,
        /// Number of items.
        found: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    #[test]
    fn every_format_is_known_and_other_files_are_none() {
        let color = SwatchColor::Rgb(Rgb([1.0, 0.0, 0.0]));
        let red = SwatchEntry { name: "Red".to_owned(), group: String::new(), color };
        let palette = SwatchFile { name: "One".to_owned(), swatches: vec![red] };
        let files = [
            ("a.bin", write_ase(&palette).unwrap()),
            ("a.txt", write_gpl(&palette).unwrap().into_bytes()),
            ("a.ACO", write_aco(&palette).unwrap()),
        ];
        for (file, bytes) in files {
            let read = read_swatch_file(file, &bytes).unwrap().unwrap();
            assert_eq!(read.swatches[0].color.srgb().unwrap().to_hex(), "#ff0000", "{file}");
        }
        assert_eq!(read_swatch_file("a.csv", b"sample,400,410\n").unwrap(), None);
        let error = read_swatch_file("b.ase", b"no").unwrap_err().to_string();
        assert!(error.starts_with("b.ase, byte 0"), "{error}");
    }
}
