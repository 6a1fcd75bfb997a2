//! OpenRaster files: layers for painting programs.
//!
//! This follows the draft specification 0.0.5 of freedesktop.org. The file is a ZIP archive. It
//! begins with the uncompressed entry `mimetype`, then has `stack.xml` with the layers from the
//! uppermost, one PNG per layer, the merged picture and a reduced picture as thumbnail. PNG files
//! are compressed themselves, so we store all entries.

use std::io::{Cursor, Write};

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use rayon::prelude::*;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::picture_file::{Png, png8, png16, rgba16};
use super::{ExportError, check_cell, check_size};
use crate::field::Field;

const VERSION: &str = "0.0.5";

const THUMBNAIL_PX: usize = 256;

/// Writer of an OpenRaster file. You hand it layer after layer, the lowest first.
#[expect(missing_debug_implementations, reason = "the archive has none")]
pub struct OpenRaster {
    archive: ZipWriter<Cursor<Vec<u8>>>,
    size: (usize, usize),
    cell_mm: f64,
    layers: Vec<LayerName>,
}

struct LayerName {
    name: String,
    visible: bool,
}

impl OpenRaster {
    /// Starts a file for layers of `size` (width and height) pixels that are `cell_mm` wide.
    ///
    /// # Errors
    /// [`ExportError`] for an empty picture and a pixel size out of range.
    pub fn new(size: (usize, usize), cell_mm: f64) -> Result<Self, ExportError> {
        check_size(size.0, size.1)?;
        check_cell(cell_mm)?;
        let archive = ZipWriter::new(Cursor::new(Vec::new()));
        let mut file = Self { archive, size, cell_mm, layers: Vec::new() };
        file.entry("mimetype", b"image/openraster")?;
        Ok(file)
    }

    /// Adds a layer above those before, with red, green, blue and opacity in encoded sRGB, not
    /// premultiplied. If you pass false for `visible`, programs list the layer as hidden.
    ///
    /// # Errors
    /// [`ExportError`] for a layer of another size, or if the encoder fails.
    pub fn layer(
        &mut self,
        name: &str,
        visible: bool,
        pixels: &Field<[u16; 4]>,
    ) -> Result<(), ExportError> {
        let (width, height) = self.size;
        if (pixels.width(), pixels.height()) != self.size {
            return Err(ExportError::Differs { plane: name.to_owned(), width, height });
        }
        let png = rgba16(pixels, self.cell_mm)?;
        self.entry(&file_of(self.layers.len()), &png)?;
        self.layers.push(LayerName { name: name.to_owned(), visible });
        Ok(())
    }

    /// Completes the file with the merged picture in linear sRGB, and returns its content.
    /// [`Png::outside`] counts the merged picture's pixels outside the gamut.
    ///
    /// # Errors
    /// [`ExportError`] for a picture of another size or with colours that are not finite, or if
    /// the encoder fails.
    pub fn finish(mut self, merged: &Field<[f32; 4]>) -> Result<Png, ExportError> {
        let (width, height) = self.size;
        if (merged.width(), merged.height()) != self.size {
            return Err(ExportError::Differs { plane: "merged".to_owned(), width, height });
        }
        let stack = self.stack().map_err(|error| failed(&error))?;
        self.entry("stack.xml", &stack)?;
        let Png { bytes, outside } = png16(merged, self.cell_mm)?;
        self.entry("mergedimage.png", &bytes)?;
        let thumbnail = png8(&reduced(merged, THUMBNAIL_PX), self.cell_mm)?;
        self.entry("Thumbnails/thumbnail.png", &thumbnail.bytes)?;
        let bytes = self.archive.finish().map_err(|error| failed(&error))?.into_inner();
        Ok(Png { bytes, outside })
    }

    fn entry(&mut self, name: &str, bytes: &[u8]) -> Result<(), ExportError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::DEFAULT)
            .large_file(u32::try_from(bytes.len()).is_err());
        self.archive.start_file(name, options).map_err(|error| failed(&error))?;
        self.archive.write_all(bytes).map_err(|error| failed(&error))
    }

    fn stack(&self) -> std::io::Result<Vec<u8>> {
        let width = self.size.0.to_string();
        let height = self.size.1.to_string();
        let per_inch = (25.4 / self.cell_mm).round().max(1.0).to_string();
        let mut xml = Writer::new_with_indent(Vec::new(), b' ', 1);
        xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        let image = xml.create_element("image").with_attributes([
            ("version", VERSION),
            ("w", width.as_str()),
            ("h", height.as_str()),
            ("xres", per_inch.as_str()),
            ("yres", per_inch.as_str()),
        ]);
        image.write_inner_content(|xml| {
            xml.create_element("stack").write_inner_content(|xml| {
                for (index, LayerName { name, visible }) in self.layers.iter().enumerate().rev() {
                    let source = file_of(index);
                    let layer = xml.create_element("layer").with_attributes([
                        ("name", name.as_str()),
                        ("src", source.as_str()),
                        ("x", "0"),
                        ("y", "0"),
                        ("opacity", "1.0"),
                        ("visibility", if *visible { "visible" } else { "hidden" }),
                        ("composite-op", "svg:src-over"),
                    ]);
                    layer.write_empty()?;
                }
                Ok(())
            })?;
            Ok(())
        })?;
        let mut text = xml.into_inner();
        text.push(b'\n');
        Ok(text)
    }
}

fn file_of(index: usize) -> String {
    format!("data/layer{index:03}.png")
}

fn failed(error: &dyn std::error::Error) -> ExportError {
    ExportError::Encoder { format: "OpenRaster", reason: error.to_string() }
}

/// Width and height of a picture after reducing it until its longer side has at most `longest_px`
/// pixels. A smaller picture keeps its size.
#[must_use]
pub fn reduced_size((width, height): (usize, usize), longest_px: usize) -> (usize, usize) {
    let longest = width.max(height).max(1);
    if longest <= longest_px {
        return (width, height);
    }
    fn reduced(side: usize, longest: usize, longest_px: usize) -> usize {
        let exact = side as f64 * longest_px as f64 / longest as f64;
        (exact.round() as usize).max(usize::from(side > 0))
    }
    (reduced(width, longest, longest_px), reduced(height, longest, longest_px))
}

/// Reduces a picture in linear sRGB to [`reduced_size`]. Each pixel is the mean of the area that
/// it covers.
#[must_use]
pub fn reduced(picture: &Field<[f32; 4]>, longest_px: usize) -> Field<[f32; 4]> {
    let before = (picture.width(), picture.height());
    let (width, height) = reduced_size(before, longest_px);
    if (width, height) == before {
        return picture.clone();
    }
    let columns: Vec<_> = (0..width).map(|x| Covered::new(x, width, before.0)).collect();
    let mut out = Field::filled(width, height, [0.0; 4]);
    out.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let rows = Covered::new(y, height, before.1);
        for (pixel, columns) in row.iter_mut().zip(&columns) {
            let mut sum = [0.0_f64; 4];
            for (y, down) in rows.shares() {
                for (x, across) in columns.shares() {
                    for (sum, value) in sum.iter_mut().zip(picture[(x, y)]) {
                        *sum += down * across * f64::from(value);
                    }
                }
            }
            *pixel = sum.map(|sum| sum as f32);
        }
    });
    out
}

/// The stretch of pixels that one pixel of the reduced picture covers along an axis.
struct Covered {
    start: f64,
    end: f64,
}

impl Covered {
    fn new(index: usize, count: usize, before: usize) -> Self {
        fn edge(index: usize, before: usize, count: usize) -> f64 {
            index as f64 * before as f64 / count as f64
        }
        Self { start: edge(index, before, count), end: edge(index + 1, before, count) }
    }

    fn shares(&self) -> impl Iterator<Item = (usize, f64)> {
        let Self { start, end } = *self;
        let last = end.ceil() as usize;
        (start.floor() as usize..last).filter_map(move |index| {
            let share = (end.min(index as f64 + 1.0) - start.max(index as f64)) / (end - start);
            (share > 0.0).then_some((index, share))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;
    use zip::ZipArchive;

    fn file() -> Vec<u8> {
        let mut file = OpenRaster::new((400, 2), 0.1).unwrap();
        file.layer("Ground", true, &Field::filled(400, 2, [65535, 65535, 60000, 65535])).unwrap();
        file.layer("Red & \"blue\" <1>", false, &Field::filled(400, 2, [9000, 0, 0, 1000]))
            .unwrap();
        file.finish(&Field::filled(400, 2, [0.5, 0.4, 0.3, 1.0])).unwrap().bytes
    }

    fn entry(archive: &mut ZipArchive<Cursor<Vec<u8>>>, name: &str) -> Vec<u8> {
        let mut bytes = Vec::new();
        archive.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    }

    #[test]
    fn the_archive_has_the_entries_of_the_specification() {
        let bytes = file();
        // Programs recognize the file by these bytes: the name at 30, its content at 38.
        assert_eq!(&bytes[30..54], b"mimetypeimage/openraster");
        assert_eq!(bytes, file(), "the same bytes every time");
        let mut archive = ZipArchive::new(Cursor::new(bytes)).unwrap();
        let names: Vec<String> =
            (0..6).map(|index| archive.by_index(index).unwrap().name().to_owned()).collect();
        assert_eq!(archive.len(), 6);
        let wanted = [
            "mimetype",
            "data/layer000.png",
            "data/layer001.png",
            "stack.xml",
            "mergedimage.png",
            "Thumbnails/thumbnail.png",
        ];
        assert_eq!(names, wanted);
        let text = String::from_utf8(entry(&mut archive, "stack.xml")).unwrap();
        let upper = text.find("layer001").unwrap();
        let lower = text.find("layer000").unwrap();
        assert!(upper < lower, "the uppermost comes first: {text}");
        assert!(text.contains("w=\"400\" h=\"2\" xres=\"254\" yres=\"254\""), "{text}");
        assert!(text.contains("Red &amp; &quot;blue&quot; &lt;1&gt;"), "{text}");
        let [[shown, hidden], [shown_ground, hidden_ground]] =
            ["Red &amp;", "Ground"].map(|name| {
                let layer = &text[text.find(name).unwrap()..];
                ["visible", "hidden"].map(|own| layer.find(&format!("visibility=\"{own}\"")))
            });
        assert!(hidden < shown, "the second layer is hidden: {text}");
        assert!(shown_ground.is_some() && hidden_ground.is_none(), "{text}");
    }

    #[test]
    fn layers_and_pictures_can_be_read_again() {
        let mut archive = ZipArchive::new(Cursor::new(file())).unwrap();
        let layer = image::load_from_memory(&entry(&mut archive, "data/layer001.png")).unwrap();
        assert_eq!(layer.into_rgba16().get_pixel(3, 1).0, [9000, 0, 0, 1000]);
        let thumbnail = image::load_from_memory(&entry(&mut archive, "Thumbnails/thumbnail.png"));
        assert_eq!(thumbnail.unwrap().width(), 256);
        let picture = Field::filled(400, 2, [0.5, 0.4, 0.3, 1.0]);
        let merged = png16(&picture, 0.1).unwrap().bytes;
        assert_eq!(entry(&mut archive, "mergedimage.png"), merged, "the picture as a PNG");
    }

    #[test]
    fn layers_of_another_size_are_refused() {
        let mut file = OpenRaster::new((4, 2), 0.1).unwrap();
        let other = file.layer("other", true, &Field::filled(3, 2, [0; 4]));
        assert!(matches!(other, Err(ExportError::Differs { .. })), "{other:?}");
        let merged = file.finish(&Field::filled(3, 2, [0.0; 4]));
        assert!(matches!(merged, Err(ExportError::Differs { .. })), "{merged:?}");
        assert!(OpenRaster::new((0, 2), 0.1).is_err());
    }

    #[test]
    fn a_picture_keeps_its_shape_and_a_small_one_its_size() {
        assert_eq!(reduced_size((300, 100), 400), (300, 100));
        assert_eq!(reduced_size((300, 100), 150), (150, 50));
        assert_eq!(reduced_size((1000, 1), 10), (10, 1));
        assert_eq!(reduced_size((0, 0), 10), (0, 0));
    }

    #[test]
    fn each_pixel_is_the_mean_of_what_it_covers() {
        let values = [0.0, 3.0, 6.0, 9.0, 12.0].map(|value| [value, 1.0, -value, 1.0]);
        let row = Field::from_values(5, 1, values.to_vec());
        let found = reduced(&row, 2);
        assert_eq!((found.width(), found.height()), (2, 1));
        // Two and a half pixels each: (0 + 3 + 6 / 2) / 2.5 and (6 / 2 + 9 + 12) / 2.5.
        for (found, wanted) in found.values().iter().zip([2.4_f32, 9.6]) {
            let [a, b, c, d] = *found;
            assert!((a - wanted).abs() < 1e-5 && (c + wanted).abs() < 1e-5, "{found:?}");
            assert!((b - 1.0).abs() < 1e-6 && (d - 1.0).abs() < 1e-6, "{found:?}");
        }
    }
}
