//! Many pictures: a folder of frames that can be taken up again, and one file of
//! them all.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use render::export::{Apng, ColorTable, Frame, FrameRate, Gif, Sequence, SequenceSettings};
use sha2::{Digest, Sha256};

use crate::console::Console;
use crate::failure::Refusal;
use crate::output::Output;
use crate::progress::Progress;

#[derive(Debug, Args)]
#[command(next_help_heading = "Animation")]
pub(super) struct MovingOptions {
    /// Write the pictures of a moving camera into one file: .gif, or .png (APNG, all colours)
    #[arg(long, value_name = "FILE")]
    animation: Option<PathBuf>,
    /// Keep each picture in this folder as PNG; a run that was broken off goes on from there
    /// [default: FILE.frames beside the animation]
    #[arg(long, value_name = "FOLDER")]
    frames: Option<PathBuf>,
    /// Pictures a second
    #[arg(long, value_name = "RATE", default_value_t = 25.0)]
    rate: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Format {
    Gif,
    Apng,
}

/// Where pictures go, known to be writable.
pub(super) struct Moving {
    animation: Option<(Output, Format)>,
    frames: PathBuf,
    rate: FrameRate,
}

/// Frames on their way.
pub(super) struct Shooting {
    moving: Moving,
    sequence: Sequence,
    /// How many, their width and their height.
    shots: (usize, usize, usize),
}

impl MovingOptions {
    /// Whether many pictures are wanted.
    pub(super) fn any(&self) -> bool {
        self.animation.is_some() || self.frames.is_some()
    }

    /// Checks that they can be written.
    pub(super) fn open(&self, inputs: &[PathBuf]) -> anyhow::Result<Option<Moving>> {
        let rate = FrameRate::new(self.rate)?;
        let animation = match &self.animation {
            None => None,
            Some(path) => Some((Output::open(path, inputs)?, format(path)?)),
        };
        let beside = self.animation.as_ref().map(|path| path.with_extension("frames"));
        let frames = self.frames.clone().or(beside);
        Ok(frames.map(|frames| Moving { animation, frames, rate }))
    }
}

fn format(path: &Path) -> anyhow::Result<Format> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("gif") => Ok(Format::Gif),
        Some("png" | "apng") => Ok(Format::Apng),
        _ => Err(Refusal::usage(
            format!("{}: an animation ends in .gif, .png or .apng", path.display()),
            format!("try {}", path.with_extension("gif").display()),
        )),
    }
}

/// What tells one wish for frames from another: the digest of all that makes them.
#[derive(Default)]
pub(super) struct Wish(Sha256);

impl Wish {
    /// Takes in what makes the frames.
    pub(super) fn and(mut self, what: &impl std::fmt::Debug) -> Self {
        // Hashing cannot fail.
        let _ = write!(self, "{what:?}");
        self.0.update([0]);
        self
    }
}

impl std::fmt::Write for Wish {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.update(text);
        Ok(())
    }
}

impl Moving {
    /// The file of all frames.
    pub(super) fn animation(&self) -> Option<&Output> {
        self.animation.as_ref().map(|(output, _)| output)
    }

    /// Looks which frames are there already, before the slow part; those of another wish
    /// go.
    pub(super) fn begin(
        self,
        wish: Wish,
        shots: (usize, usize, usize),
    ) -> anyhow::Result<Shooting> {
        let digest = wish.0.finalize();
        let settings = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        let (frames, width, height) = shots;
        let sequence =
            Sequence::open(&self.frames, SequenceSettings { settings, frames, width, height })?;
        Ok(Shooting { moving: self, sequence, shots })
    }
}

impl Shooting {
    /// Makes the frames that are not there yet by `picture`, then the animation; how
    /// many there were already.
    pub(super) fn make(
        self,
        console: &Console<'_>,
        mut picture: impl FnMut(usize) -> anyhow::Result<Frame>,
    ) -> anyhow::Result<usize> {
        let Self { moving, mut sequence, shots: (frames, width, height) } = self;
        let remaining = sequence.remaining().to_vec();
        let bar = Progress::new(remaining.len(), "painting", console.screen.progress);
        for &index in &remaining {
            sequence.write_frame(index, &picture(index)?)?;
            bar.step();
        }
        bar.done();
        if let Some((output, format)) = moving.animation {
            let bytes = match format {
                Format::Gif => gif(&sequence, (width, height), moving.rate)?,
                Format::Apng => apng(&sequence, (width, height), moving.rate, frames)?,
            };
            output.write(bytes)?;
        }
        Ok(frames - remaining.len())
    }
}

fn gif(sequence: &Sequence, size: (usize, usize), rate: FrameRate) -> anyhow::Result<Vec<u8>> {
    let table = ColorTable::of(sequence.frames())?;
    let mut gif = Gif::new(Vec::new(), size, rate, &table)?;
    for frame in sequence.frames() {
        gif.push(&frame?)?;
    }
    Ok(gif.finish()?)
}

fn apng(
    sequence: &Sequence,
    size: (usize, usize),
    rate: FrameRate,
    frames: usize,
) -> anyhow::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut apng = Apng::new(&mut bytes, size, rate, frames)?;
    for frame in sequence.frames() {
        apng.push(&frame?)?;
    }
    apng.finish()?;
    Ok(bytes)
}
