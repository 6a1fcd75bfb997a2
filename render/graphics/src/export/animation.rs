//! GIF and APNG writers that take frame after frame, so that memory holds one frame only.

use std::borrow::Cow;
use std::io::Write;

use png::chunk::{ChunkType, IDAT, fcTL, fdAT};
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent, Writer};

use super::color_table::{COLORS, ColorTable};
use super::compressed::CompressedFrame;
use super::frame::{Frame, FrameError, FrameRate, check_size, encoder_failed};

/// Writer of an endlessly repeating GIF. Frame durations are rounded to whole hundredths
/// of a second such that the average rate is exact.
#[expect(missing_debug_implementations, reason = "the encoder has none")]
pub struct Gif<'a, W: Write> {
    encoder: gif::Encoder<W>,
    rate: FrameRate,
    table: &'a ColorTable,
    size: [usize; 2],
    /// Durations of a frame so far.
    elapsed: usize,
    /// Palette indices shown after the last frame.
    shown: Vec<u8>,
    /// Palette indices of the last frame as written: [`UNCHANGED`] where a pixel kept its colour.
    written: Vec<u8>,
}

/// Palette index of pixels that do not change.
const UNCHANGED: u8 = COLORS as u8;

impl<'a, W: Write> Gif<'a, W> {
    /// Starts a GIF with the colours of `table`, to be written to `to`.
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
        let failed = |error| encoder_failed("GIF", &error);
        let mut encoder =
            gif::Encoder::new(to, width as u16, height as u16, &colors).map_err(failed)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(failed)?;
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

    /// Appends a frame that is shown for `durations` durations of a frame, 655 seconds at most.
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
    /// Durations of a frame so far.
    elapsed: usize,
    /// Chunks of frames so far: they are numbered.
    chunks: u32,
}

/// Most bytes of pixels in a chunk. The format allows nearly twice as many.
const CHUNK_BYTES: usize = 1 << 30;

/// Durations of an APNG are stored in whole milliseconds.
const PARTS_PER_SECOND: u16 = 1000;

impl<W: Write> Apng<W> {
    /// Starts an APNG of `frames` frames, to be written to `to`.
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
        let begin = || {
            let mut encoder = Encoder::new(to, width as u32, height as u32);
            encoder.set_color(ColorType::Rgb);
            encoder.set_depth(BitDepth::Eight);
            encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
            encoder.set_animated(count, 0)?;
            encoder.write_header()
        };
        let writer = begin().map_err(|error| encoder_failed("APNG", &error))?;
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

    /// Appends a frame that is shown for `durations` durations of a frame, 65 seconds at most.
    ///
    /// # Errors
    /// [`FrameError::Differs`] for another size, [`FrameError::Count`] for one frame too
    /// many, [`FrameError::Encoder`].
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
        // Width, height, place, duration, then how the frame replaces the one before.
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

    /// Writes a chunk that begins with its number.
    fn numbered(&mut self, name: ChunkType, content: &[u8]) -> Result<(), FrameError> {
        let content = [&self.chunks.to_be_bytes(), content].concat();
        self.chunks += 1;
        self.chunk(name, &content)
    }

    fn chunk(&mut self, name: ChunkType, content: &[u8]) -> Result<(), FrameError> {
        let written = self.writer.write_chunk(name, content);
        written.map_err(|error| encoder_failed("APNG", &error))
    }

    /// Completes the file.
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

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use image::codecs::png::PngDecoder;

    use documents::hint::Explain;

    use super::*;
    use crate::field::Field;

    /// A red square that moves over white paper.
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
}
