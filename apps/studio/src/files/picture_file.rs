//! Pictures of files in linear light: photographs, linear OpenEXR, and paintings under their
//! own light.

use std::path::Path;

use eframe::egui::{Color32, ColorImage};
use graphics::exr_picture::{is_exr, linear_picture, reduced};
use paint::document::Document;
use paint::file::{PaintingFileError, read_within};
use paint::light::Light;
use paint::scene::{picture, scene};
use rayon::prelude::*;
use spectra::color::Rgb;
use strokes::{Photograph, Picture};

use super::problem::Problem;

/// Number of steps of the table that converts linear light to sRGB.
const SHADES: usize = 4096;

/// A picture read from a file, reduced if it was large.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ReadPicture {
    /// Linear sRGB, white at 1.
    pub(crate) linear: Picture,
    /// Width and height of the file in pixels or cells.
    pub(crate) file_size: [usize; 2],
    /// Whether the values are scene-referred, so that no value means white.
    pub(crate) scene_linear: bool,
}

/// Reads a photograph, a linear OpenEXR, or a painting under its own light. Reduces it in linear
/// light so that no side is above `longest`. A painting may take `most_bytes` of memory.
///
/// # Errors
/// [`Problem`] if the file cannot be read as a picture.
pub(crate) fn read_picture(
    path: &Path,
    longest: usize,
    most_bytes: u64,
) -> Result<ReadPicture, Problem> {
    let bytes = documents::file::read(path)?;
    let name = path.display().to_string();
    if !is_exr(&bytes) {
        let photograph =
            Photograph::from_bytes(&name, &bytes).map_err(|error| Problem::from_error(&error))?;
        let (own_width, own_height) = photograph.size();
        let (width, height) = reduced_size((own_width, own_height), longest);
        let linear = photograph.on_canvas(width, height);
        let file_size = [own_width, own_height];
        return Ok(ReadPicture { linear, file_size, scene_linear: false });
    }
    let (linear, scene_linear) = match read_within(&name, &bytes, most_bytes) {
        Ok(document) => (lit(&document)?, false),
        Err(PaintingFileError::Format { .. }) => {
            let linear =
                linear_picture(&name, &bytes).map_err(|error| Problem::from_error(&error))?;
            (linear, true)
        }
        Err(error) => return Err(Problem::from_error(&error)),
    };
    let own = (linear.width(), linear.height());
    let (width, height) = reduced_size(own, longest);
    let linear = if (width, height) == own { linear } else { reduced(&linear, width, height) };
    Ok(ReadPicture { linear, file_size: [own.0, own.1], scene_linear })
}

/// The picture of a painting under its own light. If we do not know this light, we use the default
/// one.
fn lit(document: &Document) -> Result<Picture, Problem> {
    let lighting = &document.lighting;
    let named = Light::named(&document.library, &lighting.illuminant, &lighting.observer);
    let light = named.or_else(|_| {
        let usual = paint::document::Lighting::default();
        Light::named(&document.library, &usual.illuminant, &usual.observer)
    });
    let light = light.map_err(|error| Problem::from_error(&error))?;
    let picture = picture(document, &scene(document, &light));
    let values = picture.values().iter().map(|&[red, green, blue, _]| [red, green, blue]);
    Ok(Picture::from_values(picture.width(), picture.height(), values.collect()))
}

/// Size after reduction, so that no side is above `longest`.
pub(crate) fn reduced_size((width, height): (usize, usize), longest: usize) -> (usize, usize) {
    let scale = (longest as f64 / width.max(height).max(1) as f64).min(1.0);
    [width, height].map(|side| ((side as f64 * scale).round() as usize).max(1)).into()
}

/// Converts linear light to an sRGB picture. Each colour first passes through `change`.
pub(crate) fn on_screen(
    linear: &Picture,
    change: impl Fn([f32; 3]) -> [f32; 3] + Sync,
) -> ColorImage {
    let shades: Vec<u8> = (0..=SHADES)
        .map(|step| Rgb([step as f64 / SHADES as f64; 3]).encoded().to_bytes()[0])
        .collect();
    let pixels = linear.values().par_iter().map(|&rgb| {
        let [red, green, blue] = change(rgb)
            .map(|value: f32| shades[(value.clamp(0.0, 1.0) * SHADES as f32).round() as usize]);
        Color32::from_rgb(red, green, blue)
    });
    ColorImage::new([linear.width(), linear.height()], pixels.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::export::linear_exr;
    use graphics::field::Field;

    /// Memory that no picture of these tests needs.
    const AMPLE: u64 = 1 << 30;

    fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        (folder, path)
    }

    #[test]
    fn sizes_are_reduced_to_the_longest_side() {
        assert_eq!(reduced_size((4000, 3000), 2048), (2048, 1536));
        assert_eq!(reduced_size((640, 480), 2048), (640, 480));
        assert_eq!(reduced_size((100_000, 3), 2048), (2048, 1));
    }

    #[test]
    fn a_linear_exr_is_read_as_a_scene_and_reduced() {
        let mut picture = Field::filled(40, 20, [0.5, 0.5, 0.5, 1.0]);
        picture[(0, 0)] = [16.5, 0.5, 0.5, 1.0];
        let (_folder, path) = file("sky.png", &linear_exr(&picture, 0.1).unwrap());
        let read = read_picture(&path, 10, AMPLE).unwrap();
        assert!(read.scene_linear, "it has no white of its own");
        assert_eq!((read.file_size, read.linear.width(), read.linear.height()), ([40, 20], 10, 5));
        assert_eq!(read.linear[(0, 0)], [1.5, 0.5, 0.5], "the mean of 16 pixels");
    }

    #[test]
    fn a_file_that_is_no_picture_is_named() {
        for bytes in [&b"no picture"[..], b"\x76\x2f\x31\x01cut off"] {
            let (_folder, path) = file("a.exr", bytes);
            let problem = read_picture(&path, 10, AMPLE).unwrap_err();
            assert!(problem.text.contains("a.exr"), "{problem:?}");
        }
    }

    #[test]
    fn the_screen_shows_srgb() {
        let linear = Picture::from_values(2, 1, vec![[0.0, 1.0, 3.0], [0.25; 3]]);
        let shown = on_screen(&linear, |rgb| rgb);
        assert_eq!(shown.pixels[0], Color32::from_rgb(0, 255, 255));
        let halved = on_screen(&linear, |rgb| rgb.map(|value| value / 2.0));
        let wanted = Rgb([0.5; 3]).encoded().to_bytes()[0];
        assert_eq!(halved.pixels[0], Color32::from_rgb(0, wanted, 255));
    }
}
