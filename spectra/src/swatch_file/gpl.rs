//! GIMP palettes (.gpl): a header, then lines of `R G B<tab>name`.
//!
//! GIMP developer documentation, "GIMP Palette (.gpl) File Format".

use std::fmt::Write;

use super::entries::{SwatchColor, SwatchEntry, SwatchFile};
use super::error::SwatchFileError;
use crate::color::Rgb;

const HEAD: &str = "GIMP Palette";

/// Writes a `.gpl` file. Colours outside sRGB are clipped, and control characters in names
/// become spaces.
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
///
/// # Errors
/// [`SwatchFileError`] with the line, or the offset in bytes.
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
            palette.swatches.push(SwatchEntry {
                name: rest.to_owned(),
                group: String::new(),
                color: SwatchColor::Rgb(Rgb(channels)),
            });
        }
    }
    Ok(palette)
}

fn one_line(name: &str) -> String {
    name.replace(char::is_control, " ").trim().to_owned()
}
