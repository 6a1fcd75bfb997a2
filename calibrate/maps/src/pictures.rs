//! Pictures of maps: overviews at the size of a screen, as PNG files in colour. Look at these
//! first.

use std::ops::Range;

use documents::hint::Explain;
use pigment::PigmentLibrary;
use spectra::{Grid, InterpolateError, Viewing};

use crate::cube::CubeError;
use crate::pixel_maps::{BlockMaps, Mask, PixelCounts};
#[cfg(feature = "files")]
use crate::store::{StoreError, StoredMaps};
use crate::surveyed::SurveyedScan;

/// Means of maps over squares of pixels. A value is NaN if no pixel of the square is mapped.
#[derive(Debug, Clone, PartialEq)]
pub struct Overview {
    /// Pixels of the scan along each side of a square.
    pub step: usize,
    /// Number of squares in a row.
    pub width: usize,
    /// Number of rows of squares.
    pub height: usize,
    /// Names of the pigments.
    pub pigments: Vec<String>,
    /// Mean share of each pigment in each square. There is a list of all squares for each pigment.
    pub share: Vec<Vec<f32>>,
    /// Mean probability that each pigment is present in each square. The lists are as in `share`.
    pub presence: Vec<Vec<f32>>,
    /// Mean chi-square of each square, which includes pixels out of gamut.
    pub chi2: Vec<f32>,
    /// Mean residual of each square, which includes pixels out of gamut.
    pub rms: Vec<f32>,
    /// Mean share of each pigment over all mapped pixels.
    pub mean_share: Vec<f64>,
    /// Part of the mapped pixels in which each pigment is more likely present than not.
    pub present: Vec<f64>,
    /// Number of pixels by mask.
    pub pixels: PixelCounts,
}

/// Sums of the values of each square. You add maps block by block.
#[derive(Debug, Clone, PartialEq)]
pub struct OverviewSums {
    step: usize,
    width: usize,
    height: usize,
    pigments: Vec<String>,
    share: Vec<Vec<f64>>,
    presence: Vec<Vec<f64>>,
    chi2: Vec<f64>,
    rms: Vec<f64>,
    /// Mapped pixels of each square.
    counts: Vec<u32>,
    /// Pixels of each square that have a chi-square.
    compared: Vec<u32>,
    /// Pixels where each pigment is more likely present than not.
    present: Vec<u64>,
    pixels: PixelCounts,
}

impl OverviewSums {
    /// Empty sums for maps of `pigments` with these rows and columns, with at most `longest` squares
    /// along the longer side.
    #[must_use]
    pub fn new(pigments: &[String], (rows, columns): (usize, usize), longest: usize) -> Self {
        let step = rows.max(columns).div_ceil(longest.max(1)).max(1);
        let width = columns.div_ceil(step);
        let height = rows.div_ceil(step);
        let field = vec![0.0; width * height];
        Self {
            step,
            width,
            height,
            pigments: pigments.to_vec(),
            share: vec![field.clone(); pigments.len()],
            presence: vec![field.clone(); pigments.len()],
            chi2: field.clone(),
            rms: field,
            counts: vec![0; width * height],
            compared: vec![0; width * height],
            present: vec![0; pigments.len()],
            pixels: PixelCounts::default(),
        }
    }

    /// Adds the maps `block` of the pixels in `rows` and `columns`. Count these from the first
    /// pixel of the maps. This skips pixels outside the maps.
    pub fn add(&mut self, rows: Range<usize>, columns: Range<usize>, block: &BlockMaps) {
        self.pixels.add(&block.mask);
        let count = self.pigments.len();
        for (pixel, mask) in block.mask.iter().enumerate() {
            let row = rows.start + pixel / columns.len();
            let column = columns.start + pixel % columns.len();
            let square = row / self.step * self.width + column / self.step;
            if !mask.is_compared() || square >= self.compared.len() {
                continue;
            }
            self.compared[square] += 1;
            self.chi2[square] += f64::from(block.chi2[pixel]);
            self.rms[square] += f64::from(block.rms[pixel]);
            if *mask != Mask::Mapped {
                continue;
            }
            self.counts[square] += 1;
            for (pigment, present) in self.present.iter_mut().enumerate() {
                let at = pixel * count + pigment;
                self.share[pigment][square] += f64::from(block.share[at]);
                self.presence[pigment][square] += f64::from(block.presence[at]);
                *present += u64::from(block.presence[at] > 0.5);
            }
        }
    }

    /// Means of everything that you added.
    #[must_use]
    pub fn finish(self) -> Overview {
        let mapped = self.pixels.of(Mask::Mapped);
        Overview {
            step: self.step,
            width: self.width,
            height: self.height,
            pigments: self.pigments,
            mean_share: self
                .share
                .iter()
                .map(|field: &Vec<f64>| field.iter().sum::<f64>() / mapped.max(1) as f64)
                .collect(),
            present: self
                .present
                .into_iter()
                .map(|pixels: u64| pixels as f64 / mapped.max(1) as f64)
                .collect(),
            // One field after another, so that sums and means of all never lie side by side.
            share: self.share.into_iter().map(|field| means_of(field, &self.counts)).collect(),
            presence: self.presence.into_iter().map(|it| means_of(it, &self.counts)).collect(),
            chi2: means_of(self.chi2, &self.compared),
            rms: means_of(self.rms, &self.compared),
            pixels: self.pixels,
        }
    }
}

fn means_of(field: Vec<f64>, counts: &[u32]) -> Vec<f32> {
    let pairs = field.iter().zip(counts);
    // No pixel gives 0 / 0, which is NaN.
    pairs.map(|(sum, count)| (sum / f64::from(*count)) as f32).collect()
}

/// If all channels of an ink are brighter than this, we darken it, so that you see pale pigments.
const DARKEST: u8 = 150;

/// Pictures of one pigment or group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PigmentPictures {
    /// Index in [`Overview::pigments`].
    pub place: usize,
    /// Name of the file of [`Self::presence`].
    pub presence_file: String,
    /// PNG of the probability that the pigment is present, by [`MapPictures::PRESENCE`].
    pub presence: Vec<u8>,
    /// Name of the file of [`Self::share`].
    pub share_file: String,
    /// PNG of the share of the pigment: white for 0, the ink of the pigment for 1.
    pub share: Vec<u8>,
}

/// Pictures of all maps of a scan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MapPictures {
    /// Pictures of pigments and groups. The ones that are present most often come first.
    pub pigments: Vec<PigmentPictures>,
    /// PNG of chi-square, by [`MapPictures::CHI2`].
    pub chi2: Vec<u8>,
    /// PNG of the residual, by [`MapPictures::RESIDUAL`].
    pub residual: Vec<u8>,
}

impl MapPictures {
    /// Name of the file of chi-square.
    pub const CHI2_FILE: &str = "chi2.png";
    /// Name of the file of the residual.
    pub const RESIDUAL_FILE: &str = "residual.png";
    /// Name of the file of the scan itself.
    pub const SCAN_FILE: &str = "scan.png";
    /// Colours of presence, the same for all pigments: white for 0, dark violet for 1.
    pub const PRESENCE: Ramp = Ramp { from: (0.0, [255; 3]), to: (1.0, [64, 16, 96]) };
    /// Colours of chi-square: white for 0, red for 4 and more.
    pub const CHI2: Ramp = Ramp { from: (0.0, [255; 3]), to: (4.0, [150, 20, 20]) };
    /// Colours of the residual: white for 0, blue for 0.05 and more of reflectance.
    pub const RESIDUAL: Ramp = Ramp { from: (0.0, [255; 3]), to: (0.05, [20, 20, 150]) };

    /// Draws the maps `overview` of `scan`. Pass the library of the survey as `library`.
    pub fn of(
        scan: &SurveyedScan,
        overview: &Overview,
        library: &PigmentLibrary,
    ) -> Result<Self, PictureError> {
        let size = (overview.width, overview.height);
        let mut order: Vec<usize> = (0..overview.pigments.len()).collect();
        order.sort_by(|&a, &b| overview.present[b].total_cmp(&overview.present[a]));
        Ok(Self {
            pigments: order
                .into_iter()
                .map(|place: usize| {
                    let name = &overview.pigments[place];
                    let file = file_name(name);
                    let ink = Ramp::of_ink(ink(library, scan, name));
                    Ok(PigmentPictures {
                        place,
                        presence_file: format!("presence-{file}.png"),
                        presence: picture_png(&overview.presence[place], size, &Self::PRESENCE)?,
                        share_file: format!("share-{file}.png"),
                        share: picture_png(&overview.share[place], size, &ink)?,
                    })
                })
                .collect::<Result<_, PictureError>>()?,
            chi2: picture_png(&overview.chi2, size, &Self::CHI2)?,
            residual: picture_png(&overview.rms, size, &Self::RESIDUAL)?,
        })
    }
}

/// PNG of the scan itself, with the squares of `overview`: the pixel in the middle of each, seen in
/// daylight (D65). Bands outside 360 to 830 nm do not count.
pub fn scan_png(scan: &SurveyedScan, overview: &Overview) -> Result<Vec<u8>, PictureError> {
    let cube = scan.cube();
    let nm = cube.wavelengths_nm();
    let seen: Vec<usize> = (0..nm.len()).filter(|&band| SEEN.contains(&nm[band])).collect();
    let ends = seen.first().zip(seen.last()).map(|(&first, &last)| (nm[first], nm[last]));
    let (start, end) = ends.unwrap_or((0.0, 0.0));
    let steps = ((end - start) / STEP_NM).floor() as usize;
    let grid = Grid::from_nm(start, STEP_NM, steps + 1).ok().filter(|_| steps > 0);
    let Some(grid) = grid else { return Err(PictureError::Unseen) };
    let weights = Viewing::default().weights(grid)?;
    // Each wavelength of the grid lies between two bands.
    let places: Vec<(usize, f64)> = grid
        .wavelengths_nm()
        .map(|at: f64| {
            let above = nm.partition_point(|nm| *nm < at).clamp(1, nm.len() - 1);
            (above, ((at - nm[above - 1]) / (nm[above] - nm[above - 1])).clamp(0.0, 1.0))
        })
        .collect();
    let about = scan.about();
    let mut colors = Vec::with_capacity(overview.width * overview.height);
    for row in 0..overview.height {
        let line = middle(row, overview.step, &about.rows);
        let block = cube.read(line..line + 1, about.columns.clone())?;
        for column in 0..overview.width {
            let at = middle(column, overview.step, &about.columns) - about.columns.start;
            let color = (block.mask[at] == Mask::Mapped).then(|| {
                let pixel = block.pixel(at);
                let reflectance: Vec<f64> = places
                    .iter()
                    .map(|&(above, part)| {
                        let [a, b] = [pixel[above - 1], pixel[above]].map(f64::from);
                        (a * (1.0 - part) + b * part).clamp(0.0, 1.0)
                    })
                    .collect();
                let [red, green, blue] = bytes(weights.color(&reflectance).srgb.0);
                [red, green, blue, 255]
            });
            colors.push(color.unwrap_or(hatched(column, row)));
        }
    }
    encoded(&colors, (overview.width, overview.height))
}

/// The pixel in the middle of a square, in rows or columns.
fn middle(square: usize, step: usize, range: &Range<usize>) -> usize {
    (range.start + square * step + step / 2).min(range.end - 1)
}

/// The eye sees light of these wavelengths in nm.
const SEEN: std::ops::RangeInclusive<f64> = 360.0..=830.0;
/// Distance of the wavelengths from which we compute the colour of the scan, in nm.
const STEP_NM: f64 = 10.0;

fn bytes(srgb: [f64; 3]) -> [u8; 3] {
    srgb.map(|value| (255.0 * value.clamp(0.0, 1.0)).round() as u8)
}

/// Colour of a square that is not mapped: grey stripes, which no ramp has.
fn hatched(column: usize, row: usize) -> [u8; 4] {
    let grey = if ((column + row) / 3).is_multiple_of(2) { 190 } else { 225 };
    [grey, grey, grey, 255]
}

/// The colour of a pigment's masstone, darkened so that you see it on white.
fn ink(library: &PigmentLibrary, scan: &SurveyedScan, column: &str) -> [u8; 3] {
    let columns = scan.mapper().columns();
    let first = columns.iter().find(|c| c.name == column).and_then(|c| c.pigments.first());
    let color = first.and_then(|name| library.color([(name, 1.0)], &Viewing::default()).ok());
    let rgb = color.map_or([0; 3], |color| bytes(color.srgb.0));
    let brightest = rgb.iter().copied().max().unwrap_or(0).max(1);
    match brightest > DARKEST && rgb.iter().copied().min().unwrap_or(0) > DARKEST {
        true => rgb.map(|v| (f64::from(v) * f64::from(DARKEST) / f64::from(brightest)) as u8),
        false => rgb,
    }
}

/// Makes a file name of letters and digits alone.
fn file_name(name: &str) -> String {
    let kept =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' });
    let text: String = kept.collect();
    text.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}

/// We cannot make a picture of a field.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PictureError {
    /// The number of values differs from the number of pixels, or there are none.
    #[error("{values} values for a picture of {width} x {height} pixels")]
    Size {
        /// Number of values.
        values: usize,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
    /// No two bands of the scan lie in visible light.
    #[error("the bands of the scan show no visible light")]
    Unseen,
    /// The scan cannot be read.
    #[error(transparent)]
    Cube(#[from] CubeError),
    /// The colour of a spectrum cannot be computed.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
    /// The encoder refuses it.
    #[error("the picture cannot be encoded")]
    Encoder(#[from] png::EncodingError),
}

/// Encodes `width` x `height` values as a PNG file, with the colours of `ramp`. NaN, which stands for
/// squares that are not mapped, becomes grey stripes.
///
/// # Errors
/// [`PictureError`] if the number of values differs from the number of pixels.
pub fn picture_png(
    values: &[f32],
    (width, height): (usize, usize),
    ramp: &Ramp,
) -> Result<Vec<u8>, PictureError> {
    let colors = values.iter().enumerate().map(|(index, value)| {
        ramp.color(*value).unwrap_or_else(|| hatched(index % width.max(1), index / width.max(1)))
    });
    encoded(&colors.collect::<Vec<[u8; 4]>>(), (width, height))
}

fn encoded(colors: &[[u8; 4]], (width, height): (usize, usize)) -> Result<Vec<u8>, PictureError> {
    let sizes = u32::try_from(width).ok().zip(u32::try_from(height).ok());
    let fits = width.checked_mul(height) == Some(colors.len()) && !colors.is_empty();
    let (Some((columns, rows)), true) = (sizes, fits) else {
        return Err(PictureError::Size { values: colors.len(), width, height });
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, columns, rows);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(colors.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

/// Colours from one value to another, linear in encoded sRGB. Values beyond the ends get the
/// colours of the ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    /// Value and encoded sRGB of the beginning.
    pub from: (f32, [u8; 3]),
    /// Value and encoded sRGB of the end.
    pub to: (f32, [u8; 3]),
}

impl Ramp {
    /// Shares or probabilities: white for none, `ink` for all.
    #[must_use]
    pub fn of_ink(ink: [u8; 3]) -> Self {
        Self { from: (0.0, [255; 3]), to: (1.0, ink) }
    }

    /// Encoded sRGB and opacity of a value, or `None` for NaN.
    #[must_use]
    pub fn color(&self, value: f32) -> Option<[u8; 4]> {
        if value.is_nan() {
            return None;
        }
        let way = ((value - self.from.0) / (self.to.0 - self.from.0)).clamp(0.0, 1.0);
        let mut color = [255; 4];
        let ends = self.from.1.map(f32::from).into_iter().zip(self.to.1.map(f32::from));
        for (channel, (from, to)) in color.iter_mut().zip(ends) {
            *channel = (from + way * (to - from)).round() as u8;
        }
        Some(color)
    }
}

/// We read this many rows and columns at once, so that wide scans take no more memory than others.
#[cfg(feature = "files")]
const ROWS: usize = 256;
#[cfg(feature = "files")]
const COLUMNS: usize = 2048;

#[cfg(feature = "files")]
impl Overview {
    /// Reads all of `maps`, with at most `longest` squares along the longer side.
    pub fn of(maps: &StoredMaps, longest: usize) -> Result<Self, StoreError> {
        let rows = maps.rows();
        let columns = maps.columns();
        let mut sums = OverviewSums::new(maps.pigments(), (rows.len(), columns.len()), longest);
        for start in rows.clone().step_by(ROWS) {
            let end = (start + ROWS).min(rows.end);
            for left in columns.clone().step_by(COLUMNS) {
                let right = (left + COLUMNS).min(columns.end);
                let block = maps.read(start..end, left..right)?;
                let across = inside(left, right, columns.start);
                sums.add(inside(start, end, rows.start), across, &block);
            }
        }
        Ok(sums.finish())
    }
}

#[cfg(feature = "files")]
fn inside(from: usize, to: usize, first: usize) -> Range<usize> {
    from - first..to - first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_between_the_ends_are_blended() {
        let ramp = Ramp::of_ink([55, 0, 155]);
        assert_eq!(ramp.color(0.0), Some([255; 4]));
        assert_eq!(ramp.color(0.5), Some([155, 128, 205, 255]));
        assert_eq!(ramp.color(7.0), Some([55, 0, 155, 255]));
        assert_eq!(ramp.color(-7.0), Some([255; 4]));
        assert_eq!(ramp.color(f32::NAN), None, "no value");
        let falling = Ramp { from: (4.0, [0; 3]), to: (2.0, [200; 3]) };
        assert_eq!(falling.color(3.0), Some([100, 100, 100, 255]));
    }

    #[test]
    fn squares_that_are_not_mapped_are_striped_and_opaque() {
        let ramp = Ramp::of_ink([0; 3]);
        let bytes = picture_png(&[f32::NAN; 36], (6, 6), &ramp).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut colors = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut colors).unwrap();
        let mut greys: Vec<[u8; 4]> = colors.as_chunks().0.to_vec();
        greys.sort_unstable();
        greys.dedup();
        assert_eq!(greys, [[190, 190, 190, 255], [225, 225, 225, 255]]);
    }
}
