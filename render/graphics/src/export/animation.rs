//! GIF and APNG writers. You hand them frame after frame, so that memory holds one frame only.
//!
//! All frames of a GIF share one table of 255 colours, so that still pixels keep their index and
//! do not flicker. We cut boxes of colours at their median (Heckbert 1982), the box with the
//! greatest error first. Then each colour moves to the mean of the pixels nearest to it (Lloyd
//! 1982).

use std::borrow::Cow;
use std::io::Write;

use png::chunk::{ChunkType, IDAT, fcTL, fdAT};
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent, Writer};
use rayon::prelude::*;

use super::frame::{CompressedFrame, Frame, FrameError, FrameRate, check_size, encoder_failed};

/// Writer of an endlessly repeating GIF. It rounds frame durations to whole hundredths of a
/// second. The average rate stays exact.
#[expect(missing_debug_implementations, reason = "the encoder has none")]
pub struct Gif<'a, W: Write> {
    encoder: gif::Encoder<W>,
    rate: FrameRate,
    table: &'a ColorTable,
    size: [usize; 2],
    elapsed: usize,
    shown: Vec<u8>,
    /// Palette indices of the last frame in the file: [`UNCHANGED`] where a pixel kept its colour.
    written: Vec<u8>,
}

const UNCHANGED: u8 = COLORS as u8;

impl<'a, W: Write> Gif<'a, W> {
    /// Starts a GIF with the colours of `table`. It goes to the writer `to`.
    ///
    /// # Errors
    /// [`FrameError::Size`], [`FrameError::Encoder`].
    pub fn new(
        to: W,
        (width, height): (usize, usize),
        rate: FrameRate,
        table: &'a ColorTable,
    ) -> Result<Self, FrameError> {
        check_size("GIF", usize::from(u16::MAX), width, height)?;
        let mut colors = table.colors().as_flattened().to_vec();
        colors.resize(3 * (COLORS + 1), 0);
        let mut encoder = gif::Encoder::new(to, width as u16, height as u16, &colors)
            .map_err(|error| encoder_failed("GIF", &error))?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(|error| encoder_failed("GIF", &error))?;
        let shown = Vec::new();
        let written = vec![0; width * height];
        Ok(Self { encoder, rate, table, size: [width, height], elapsed: 0, shown, written })
    }

    /// Appends a frame.
    ///
    /// # Errors
    /// [`FrameError::Differs`] for another size, [`FrameError::Encoder`].
    pub fn push(&mut self, frame: &Frame) -> Result<(), FrameError> {
        self.push_held(frame, 1)
    }

    /// Appends a frame and shows it as long as `durations` frames, 655 seconds at most. For
    /// example, use this to hold the last picture.
    ///
    /// # Errors
    /// [`FrameError::Differs`] for another size, [`FrameError::Encoder`].
    pub fn push_held(&mut self, frame: &Frame, durations: usize) -> Result<(), FrameError> {
        check_same(self.size, [frame.width(), frame.height()])?;
        let indices = frame.values().iter().map(|&pixel| self.table.index(pixel));
        if self.shown.is_empty() {
            self.shown.extend(indices);
            self.written.clone_from(&self.shown);
        } else {
            for ((index, shown), written) in indices.zip(&mut self.shown).zip(&mut self.written) {
                *written = if index == *shown { UNCHANGED } else { index };
                *shown = index;
            }
        }
        let delay = self.rate.duration(self.elapsed, durations, 100.0);
        self.elapsed += durations;
        let frame = gif::Frame {
            delay,
            dispose: gif::DisposalMethod::Keep,
            transparent: Some(UNCHANGED),
            width: self.size[0] as u16,
            height: self.size[1] as u16,
            buffer: Cow::Borrowed(&self.written),
            ..gif::Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(|error| encoder_failed("GIF", &error))
    }

    /// Completes the file and returns the writer.
    ///
    /// # Errors
    /// [`FrameError::Count`] if there is no frame, [`FrameError::Encoder`].
    pub fn finish(self) -> Result<W, FrameError> {
        if self.elapsed == 0 {
            return Err(FrameError::Count { wanted: 1, found: 0 });
        }
        self.encoder.into_inner().map_err(|error| encoder_failed("GIF", &error))
    }
}

/// Writer of an endlessly repeating animated PNG with all colours.
#[expect(missing_debug_implementations, reason = "the encoder has none")]
pub struct Apng<W: Write> {
    writer: Writer<W>,
    rate: FrameRate,
    size: [usize; 2],
    wanted: usize,
    count: usize,
    elapsed: usize,
    /// Number of frame chunks so far. The file numbers them.
    chunks: u32,
}

/// A chunk has at most this many bytes of pixels. The format allows nearly twice as many.
const CHUNK_BYTES: usize = 1 << 30;

/// An APNG stores durations in whole milliseconds.
const PARTS_PER_SECOND: u16 = 1000;

impl<W: Write> Apng<W> {
    /// Starts an APNG of `frames` frames. It goes to the writer `to`.
    ///
    /// # Errors
    /// [`FrameError::Size`], [`FrameError::Count`] for 0 frames, [`FrameError::Encoder`].
    pub fn new(
        to: W,
        (width, height): (usize, usize),
        rate: FrameRate,
        frames: usize,
    ) -> Result<Self, FrameError> {
        check_size("PNG", (1 << 30) - 2, width, height)?;
        let Some(count) = u32::try_from(frames).ok().filter(|&count| count > 0) else {
            return Err(FrameError::Count { wanted: 1, found: frames });
        };
        let mut encoder = Encoder::new(to, width as u32, height as u32);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
        let writer = encoder.set_animated(count, 0).and_then(|()| encoder.write_header());
        let writer = writer.map_err(|error| encoder_failed("APNG", &error))?;
        let size = [width, height];
        Ok(Self { writer, rate, size, wanted: frames, count: 0, elapsed: 0, chunks: 0 })
    }

    /// Appends a frame.
    ///
    /// # Errors
    /// [`FrameError::Differs`] for another size, [`FrameError::Count`] for one frame too
    /// many, [`FrameError::Encoder`].
    pub fn push(&mut self, frame: &Frame) -> Result<(), FrameError> {
        check_same(self.size, [frame.width(), frame.height()])?;
        self.push_held(&CompressedFrame::new(frame)?, 1)
    }

    /// Appends a frame and shows it as long as `durations` frames, 65 seconds at most.
    ///
    /// # Errors
    /// [`FrameError::Differs`] for another size, [`FrameError::Count`] for one frame too many,
    /// [`FrameError::Encoder`].
    pub fn push_held(
        &mut self,
        frame: &CompressedFrame,
        durations: usize,
    ) -> Result<(), FrameError> {
        check_same(self.size, [frame.width(), frame.height()])?;
        if self.count == self.wanted {
            return Err(FrameError::Count { wanted: self.wanted, found: self.count + 1 });
        }
        let delay = self.rate.duration(self.elapsed, durations, f64::from(PARTS_PER_SECOND));
        // Width, height, position, duration, then how the frame replaces the one before.
        let [width, height] = self.size.map(|size| size as u32);
        let mut control = [width, height, 0, 0].map(u32::to_be_bytes).as_flattened().to_vec();
        control.extend([delay, PARTS_PER_SECOND].map(u16::to_be_bytes).as_flattened());
        control.extend([0, 0]);
        self.numbered(fcTL, &control)?;
        for part in frame.zlib().chunks(CHUNK_BYTES) {
            match self.count {
                0 => self.chunk(IDAT, part)?,
                _ => self.numbered(fdAT, part)?,
            }
        }
        (self.count, self.elapsed) = (self.count + 1, self.elapsed + durations);
        Ok(())
    }

    fn numbered(&mut self, name: ChunkType, content: &[u8]) -> Result<(), FrameError> {
        let content = [&self.chunks.to_be_bytes(), content].concat();
        self.chunks += 1;
        self.chunk(name, &content)
    }

    fn chunk(&mut self, name: ChunkType, content: &[u8]) -> Result<(), FrameError> {
        let written = self.writer.write_chunk(name, content);
        written.map_err(|error| encoder_failed("APNG", &error))
    }

    /// Completes the file. You must have appended all frames.
    ///
    /// # Errors
    /// [`FrameError::Count`] if frames are missing, [`FrameError::Encoder`].
    pub fn finish(self) -> Result<(), FrameError> {
        if self.count < self.wanted {
            return Err(FrameError::Count { wanted: self.wanted, found: self.count });
        }
        self.writer.finish().map_err(|error| encoder_failed("APNG", &error))
    }
}

fn check_same(wanted: [usize; 2], found: [usize; 2]) -> Result<(), FrameError> {
    if wanted == found { Ok(()) } else { Err(FrameError::Differs { wanted, found }) }
}

/// A table has at most this many colours. We leave one more index of the GIF for pixels that do
/// not change.
pub(super) const COLORS: usize = 255;
/// Bits per channel by which we distinguish colours: 32,768 bins.
const BITS: usize = 5;
const SIDE: usize = 1 << BITS;
const ROUNDS: usize = 4;

/// Up to 255 colours, and a lookup of the nearest one for every colour. You need this table before
/// you write a [`Gif`].
#[derive(Debug, Clone)]
pub struct ColorTable {
    colors: Vec<[u8; 3]>,
    /// Index of the nearest colour, for each bin of the upper bits of red, green and blue.
    nearest: Vec<u8>,
}

#[derive(Debug, Clone)]
pub(super) struct Census {
    /// Sums of red, green, blue and count for each bin.
    cells: Vec<[u64; 4]>,
}

fn cell([r, g, b]: [u8; 3]) -> usize {
    fn upper(value: u8) -> usize {
        usize::from(value) >> (8 - BITS)
    }
    (upper(r) * SIDE + upper(g)) * SIDE + upper(b)
}

impl Census {
    pub(super) fn new() -> Self {
        Self { cells: vec![[0; 4]; SIDE.pow(3)] }
    }

    pub(super) fn count(&mut self, frame: &Frame) {
        for &pixel in frame.values() {
            let sums = &mut self.cells[cell(pixel)];
            for (sum, value) in sums.iter_mut().zip(pixel) {
                *sum += u64::from(value);
            }
            sums[3] += 1;
        }
    }
}

impl ColorTable {
    /// Makes the table for `frames`. This reads them once, one at a time.
    ///
    /// # Errors
    /// The first error that `frames` yields.
    pub fn of<E>(frames: impl IntoIterator<Item = Result<Frame, E>>) -> Result<Self, E> {
        let mut census = Census::new();
        for frame in frames {
            census.count(&frame?);
        }
        Ok(Self::from_census(&census))
    }

    fn from_census(census: &Census) -> Self {
        let mut found: Vec<([f32; 3], f32)> = census
            .cells
            .iter()
            .filter(|sums| sums[3] > 0)
            .map(|sums| {
                let count = sums[3] as f32;
                ([0, 1, 2].map(|i| sums[i] as f32 / count), count)
            })
            .collect();
        let mut colors = boxes(&mut found);
        for _ in 0..ROUNDS {
            let nearest: Vec<usize> =
                found.par_iter().map(|(color, _)| nearest(&colors, *color)).collect();
            let mut sums = vec![[0.0f64; 4]; colors.len()];
            for ((color, count), index) in found.iter().zip(nearest) {
                let count = f64::from(*count);
                for (sum, value) in sums[index].iter_mut().zip(color) {
                    *sum += f64::from(*value) * count;
                }
                sums[index][3] += count;
            }
            for (color, sums) in colors.iter_mut().zip(sums) {
                if sums[3] > 0.0 {
                    *color = [0, 1, 2].map(|i| (sums[i] / sums[3]) as f32);
                }
            }
        }
        let bytes: Vec<[u8; 3]> =
            colors.iter().map(|color| color.map(|value| value.round() as u8)).collect();
        fn middle(i: usize) -> f32 {
            ((i % SIDE) << (8 - BITS)) as f32 + 3.5
        }
        let nearest = (0..SIDE.pow(3))
            .into_par_iter()
            .map(|i| nearest(&colors, [middle(i / SIDE / SIDE), middle(i / SIDE), middle(i)]) as u8)
            .collect();
        Self { colors: bytes, nearest }
    }

    /// The colours of the table, encoded sRGB.
    #[must_use]
    pub fn colors(&self) -> &[[u8; 3]] {
        &self.colors
    }

    /// Index of the table's colour nearest to `pixel`.
    #[must_use]
    pub fn index(&self, pixel: [u8; 3]) -> u8 {
        self.nearest[cell(pixel)]
    }
}

/// Squared distance with channels weighted by about their share of lightness.
fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    [2.0, 4.0, 1.0].iter().zip(a).zip(b).map(|((weight, a), b)| weight * (a - b) * (a - b)).sum()
}

fn nearest(colors: &[[f32; 3]], wanted: [f32; 3]) -> usize {
    let distances = colors.iter().map(|&color| distance(color, wanted));
    distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}

fn boxes(found: &mut [([f32; 3], f32)]) -> Vec<[f32; 3]> {
    let mut open: Vec<&mut [([f32; 3], f32)]> = vec![found];
    while open.len() < COLORS {
        let widest = open.iter().enumerate().map(|(i, colors)| (i, spread(colors)));
        let Some((index, (channel, spread))) = widest.max_by(|a, b| a.1.1.total_cmp(&b.1.1)) else {
            break;
        };
        if spread <= 0.0 {
            break;
        }
        let colors = open.swap_remove(index);
        colors.sort_by(|a, b| a.0[channel].total_cmp(&b.0[channel]));
        let half = colors.iter().map(|color| color.1).sum::<f32>() / 2.0;
        let mut before = 0.0;
        let cut = colors.iter().position(|color| {
            before += color.1;
            before >= half
        });
        let cut = cut.unwrap_or(0).clamp(1, colors.len() - 1);
        let (lower, upper) = colors.split_at_mut(cut);
        open.extend([lower, upper]);
    }
    let means = open.iter().filter(|colors| !colors.is_empty()).map(|colors| mean(colors));
    means.collect()
}

fn mean(colors: &[([f32; 3], f32)]) -> [f32; 3] {
    let count: f32 = colors.iter().map(|color| color.1).sum();
    [0, 1, 2].map(|i| colors.iter().map(|color| color.0[i] * color.1).sum::<f32>() / count)
}

/// The channel with the greatest squared error within a box, and this error. It is 0 for a box
/// that cannot be cut.
fn spread(colors: &[([f32; 3], f32)]) -> (usize, f32) {
    if colors.len() < 2 {
        return (0, 0.0);
    }
    let mean = mean(colors);
    let errors = [0, 1, 2].map(|i| {
        let squares = colors.iter().map(|(color, count)| count * (color[i] - mean[i]).powi(2));
        squares.sum::<f32>() * [2.0, 4.0, 1.0][i]
    });
    let widest = (0..3).max_by(|&a, &b| errors[a].total_cmp(&errors[b])).unwrap_or(0);
    (widest, errors[widest])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;
    use documents::hint::Explain;
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use image::codecs::png::PngDecoder;
    use std::io::Cursor;

    fn frames() -> Vec<Frame> {
        (0..5)
            .map(|at: usize| {
                Field::from_values(
                    8,
                    6,
                    (0..48)
                        .map(|i: usize| match (i % 8).abs_diff(at) < 2 && i / 8 < 4 {
                            true => [180, 20, 30],
                            false => [250, 248, 240 + (i % 3) as u8],
                        })
                        .collect(),
                )
            })
            .collect()
    }

    fn check(decoded: Vec<image::Frame>, tolerance: u8) {
        assert_eq!(decoded.len(), 5);
        let mut elapsed_ms = 0.0;
        for (decoded, frame) in decoded.iter().zip(frames()) {
            let (numerator, denominator) = decoded.delay().numer_denom_ms();
            elapsed_ms += f64::from(numerator) / f64::from(denominator);
            for (found, wanted) in decoded.buffer().pixels().zip(frame.values()) {
                let near = (0..3).all(|i| found.0[i].abs_diff(wanted[i]) <= tolerance);
                assert!(near && found.0[3] == 255, "{found:?}, {wanted:?}");
            }
        }
        // Five frames at 24 frames per second.
        assert!((elapsed_ms - 5000.0 / 24.0).abs() <= 5.0, "{elapsed_ms} ms");
    }

    #[test]
    fn a_gif_shows_its_frames() {
        let table = ColorTable::of::<()>(frames().into_iter().map(Ok)).unwrap();
        let mut gif = Gif::new(Vec::new(), (8, 6), FrameRate::new(24.0).unwrap(), &table).unwrap();
        frames().iter().for_each(|frame| gif.push(frame).unwrap());
        let bytes = gif.finish().unwrap();
        let decoder = GifDecoder::new(Cursor::new(bytes)).unwrap();
        check(decoder.into_frames().collect_frames().unwrap(), 1);
    }

    #[test]
    fn an_apng_shows_its_frames_as_they_are() {
        let mut bytes = Vec::new();
        let rate = FrameRate::new(24.0).unwrap();
        let mut apng = Apng::new(&mut bytes, (8, 6), rate, 5).unwrap();
        frames().iter().for_each(|frame| apng.push(frame).unwrap());
        let more = apng.push(&frames()[0]);
        assert_eq!(more, Err(FrameError::Count { wanted: 5, found: 6 }));
        apng.finish().unwrap();
        let decoder = PngDecoder::new(Cursor::new(bytes)).unwrap().apng().unwrap();
        check(decoder.into_frames().collect_frames().unwrap(), 0);
    }

    #[test]
    fn frames_of_another_size_and_missing_ones_are_refused() {
        let rate = FrameRate::new(10.0).unwrap();
        let mut apng = Apng::new(Vec::new(), (8, 6), rate, 2).unwrap();
        let other = Field::filled(3, 2, [0; 3]);
        let wanted = FrameError::Differs { wanted: [8, 6], found: [3, 2] };
        assert_eq!(apng.push(&other), Err(wanted));
        assert_eq!(apng.finish(), Err(FrameError::Count { wanted: 2, found: 0 }));
        let table = ColorTable::of::<()>(frames().into_iter().map(Ok)).unwrap();
        let large = Gif::new(Vec::new(), (70_000, 6), rate, &table);
        assert!(large.is_err_and(|error| error.hint().is_some()));
        let none = Gif::new(Vec::new(), (8, 6), rate, &table).unwrap().finish();
        assert!(matches!(none, Err(FrameError::Count { .. })));
    }

    fn table(pixels: Vec<[u8; 3]>) -> ColorTable {
        let frame = Field::from_values(pixels.len(), 1, pixels);
        ColorTable::of::<()>([Ok(frame)]).unwrap()
    }

    #[test]
    fn few_colors_are_kept_as_they_are() {
        let few = vec![[0, 0, 0], [255, 255, 255], [200, 10, 30], [200, 10, 30], [7, 90, 250]];
        let table = table(few.clone());
        assert_eq!(table.colors().len(), 4);
        for pixel in few {
            assert_eq!(table.colors()[usize::from(table.index(pixel))], pixel);
        }
    }

    #[test]
    fn many_colors_are_near_their_own() {
        let many: Vec<[u8; 3]> = (0..10_000u32)
            .map(|i| [(i % 100) as u8 + 100, (i / 100) as u8 + 60, (i % 37) as u8 + 20])
            .collect();
        let table = table(many.clone());
        assert_eq!(table.colors().len(), COLORS);
        let rms = (many
            .iter()
            .map(|pixel: &[u8; 3]| {
                let found = table.colors()[usize::from(table.index(*pixel))];
                (0..3).map(|i| f64::from(found[i].abs_diff(pixel[i])).powi(2)).sum::<f64>()
            })
            .sum::<f64>()
            / 30_000.0)
            .sqrt();
        // Measured: 3.9 of 255.
        assert!(rms < 4.5, "{rms}");
    }
}
