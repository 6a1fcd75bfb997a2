//! Marks from a picture of coloured lines over the painting.

use std::path::Path;

use graphics::field::Field;
use graphics::picture::Photograph;
use spectra::color::Rgb;

use super::error::MarksError;
use super::mark::{Mark, MarkedArea, Marks};

/// Largest number of lines: more colours come from soft brushes or from the painting itself.
const MOST_COLORS: usize = 64;

impl Marks {
    /// Reads a PNG of coloured lines on a transparent ground, as large as the painting. Each opaque
    /// colour is the scribble of one sample, named like `#c9a227`; pixels that are not quite opaque
    /// (soft edges of a line) are left out.
    ///
    /// # Errors
    /// [`MarksError`] if the file cannot be read, has another size, or holds no lines or more than
    /// 64 colours.
    pub fn from_overlay(path: &Path, painting: (usize, usize)) -> Result<Self, MarksError> {
        let photograph = Photograph::open(path)?;
        let file = path.display().to_string();
        let (width, height) = photograph.size();
        if (width, height) != painting {
            return Err(MarksError::OverlaySize { file, found: (width, height), wanted: painting });
        }
        Self::from_lines(&file, &photograph.with_opacity(width, height))
    }

    /// Marks of the lines in a picture of encoded sRGB with opacity, like [`Marks::from_overlay`].
    ///
    /// # Errors
    /// [`MarksError`] if there are no lines or more than 64 colours.
    pub fn from_lines(file: &str, lines: &Field<[f32; 4]>) -> Result<Self, MarksError> {
        let mut pixels: Vec<([u8; 3], u32)> = (0..)
            .zip(lines.values())
            .filter(|(_, [.., opacity])| *opacity > 1.0 - 0.5 / 255.0)
            .map(|(pixel, &[r, g, b, _])| (Rgb([r, g, b].map(f64::from)).to_bytes(), pixel))
            .collect();
        pixels.sort_unstable();
        let colors: Vec<&[([u8; 3], u32)]> = pixels.chunk_by(|a, b| a.0 == b.0).collect();
        let file = file.to_owned();
        if colors.is_empty() {
            return Err(MarksError::NoSamples { file });
        }
        if colors.len() > MOST_COLORS || pixels.len() == lines.values().len() {
            return Err(MarksError::OverlayColors { file, colors: colors.len() });
        }
        let width = lines.width() as u32;
        Ok(Self {
            file,
            painting: None,
            samples: colors
                .iter()
                .map(|line: &&[([u8; 3], u32)]| {
                    let name = Rgb(line[0].0.map(|byte| f64::from(byte) / 255.0)).to_hex();
                    let places =
                        line.iter().map(|(_, pixel)| [pixel % width, pixel / width]).collect();
                    Mark { name, area: MarkedArea::Pixels(places), spacing: None }
                })
                .collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines() -> Field<[f32; 4]> {
        let mut lines = Field::filled(12, 8, [0.0; 4]);
        for x in 2..9 {
            lines[(x, 2)] = [1.0, 0.0, 0.0, 1.0];
            lines[(x, 6)] = [0.0, 0.0, 1.0, 1.0];
        }
        lines[(9, 2)] = [0.9, 0.1, 0.0, 0.5];
        lines
    }

    #[test]
    fn each_opaque_color_is_a_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lines.png");
        let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), 12, 8);
        encoder.set_color(png::ColorType::Rgba);
        let lines = lines();
        let bytes = lines.values().iter().flatten().map(|v| (v * 255.0).round() as u8);
        encoder.write_header().unwrap().write_image_data(&bytes.collect::<Vec<u8>>()).unwrap();
        let marks = Marks::from_overlay(&path, (12, 8)).unwrap();
        let names: Vec<&str> = marks.samples.iter().map(|mark| mark.name.as_str()).collect();
        assert_eq!(names, ["#0000ff", "#ff0000"]);
        let places: Vec<[u32; 2]> = (2..9).map(|x| [x, 2]).collect();
        assert_eq!(marks.samples[1].area, MarkedArea::Pixels(places));
        let read = Marks::from_toml(&marks.file, &marks.to_toml()).unwrap();
        assert_eq!(read, marks, "and can be written as text");
        let error = Marks::from_overlay(&path, (12, 9)).unwrap_err().to_string();
        assert!(error.ends_with("12 x 8 pixels, but the painting has 12 x 9"), "{error}");
    }

    #[test]
    fn pictures_without_lines_are_refused() {
        let empty = Field::filled(5, 5, [0.3, 0.2, 0.1, 0.0]);
        let error = Marks::from_lines("l.png", &empty).unwrap_err();
        assert_eq!(error.to_string(), "l.png: there are no samples");
        let opaque = Field::filled(5, 5, [0.3, 0.2, 0.1, 1.0]);
        let error = Marks::from_lines("l.png", &opaque).unwrap_err();
        assert!(error.to_string().starts_with("l.png: 1 opaque colours"), "{error}");
        let mut many = Field::filled(100, 1, [0.0; 4]);
        (0..70).for_each(|x| many[(x, 0)] = [x as f32 / 100.0, 0.0, 0.0, 1.0]);
        let error = Marks::from_lines("l.png", &many).unwrap_err();
        assert!(error.to_string().starts_with("l.png: 70 opaque colours"), "{error}");
    }
}
