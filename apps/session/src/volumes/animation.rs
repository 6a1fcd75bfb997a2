//! Writes a scene from start to end as an animation.

use std::io::{BufWriter, Write};
use std::path::Path;

use documents::Task;
use documents::file::write_whole;
use graphics::encoding::encoded_from_linear;
use graphics::export::{Apng, ColorTable, Frame, FrameError, FrameRate, Gif, frame_of};

use super::command::Subject;
use super::event::SceneRecording;
use super::painters::Sight;
use super::scene::Scene;
use super::timeline::STEPS_A_SECOND;
use crate::failure::FileFailure;

const RATE: u64 = 24;

/// Longest side of an animation in pixels.
const LONGEST_PX: usize = 720;

/// The colours of a GIF come from its first frame and this many later ones at equal distances.
const SAMPLED: u64 = 12;

/// Steps per frame. Only whole steps are shown.
const FRAME_STEPS: u64 = STEPS_A_SECOND / RATE;

/// Writes all pictures of a recording from its start to its end in the file `path`: a GIF, or an
/// animated PNG if its name ends in `.png` or `.apng`. `size` is the picture's in the window, which
/// is reduced to at most 720 pixels. If `task` is cancelled, nothing is written.
///
/// # Errors
/// [`FileFailure`] if the recording cannot be played or the file cannot be written.
pub fn animation(
    recording: &SceneRecording,
    size: [usize; 2],
    path: &Path,
    task: &Task,
) -> Result<(), FileFailure> {
    let text = Subject::Text { text: recording.text.to_string(), folder: recording.folder.clone() };
    let mut player = Player { scene: Scene::open(&text)?, sight: None };
    let longest = size[0].max(size[1]).max(1);
    let size = size.map(|side: usize| (side * longest.min(LONGEST_PX) / longest).max(1));
    player.sight = player.scene.seen_from().map(|camera| Sight { camera, size });
    let last = player.scene.end() / FRAME_STEPS;
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let bytes = match ending.to_ascii_lowercase().as_str() {
        "png" | "apng" => apng(&mut player, size, last, task)?,
        _ => gif(&mut player, size, last, task)?,
    };
    match bytes {
        Some(bytes) => write_whole(path, &bytes).map_err(|error| FileFailure::explained(&error)),
        None => Ok(()),
    }
}

struct Player {
    scene: Scene,
    sight: Option<Sight>,
}

impl Player {
    fn frame(&mut self, number: u64) -> Result<Frame, FileFailure> {
        let sight = self.sight.ok_or_else(|| FileFailure {
            what: "the scene has no camera".to_owned(),
            hint: None,
        })?;
        self.scene.go_to(number * FRAME_STEPS)?;
        while self.scene.is_behind() {
            self.scene.step()?;
        }
        Ok(frame_of(&encoded_from_linear(&self.scene.picture(&sight)?)))
    }
}

fn rate() -> Result<FrameRate, FileFailure> {
    FrameRate::new(RATE as f64).map_err(failed)
}

fn failed(error: FrameError) -> FileFailure {
    FileFailure::explained(&error)
}

fn apng(
    player: &mut Player,
    [width, height]: [usize; 2],
    last: u64,
    task: &Task,
) -> Result<Option<Vec<u8>>, FileFailure> {
    let mut bytes = Vec::new();
    let mut file = BufWriter::new(&mut bytes);
    let mut apng =
        Apng::new(&mut file, (width, height), rate()?, last as usize + 1).map_err(failed)?;
    for number in 0..=last {
        if task.reach(number as f64 / (last + 1) as f64).is_err() {
            return Ok(None);
        }
        apng.push(&player.frame(number)?).map_err(failed)?;
    }
    apng.finish().map_err(failed)?;
    file.flush().map_err(|error| FileFailure::without_hint(&error))?;
    drop(file);
    Ok(Some(bytes))
}

fn gif(
    player: &mut Player,
    [width, height]: [usize; 2],
    last: u64,
    task: &Task,
) -> Result<Option<Vec<u8>>, FileFailure> {
    // The last frames have all colours, since colours only come in.
    let sampled = (0..=SAMPLED).map(|number| player.frame(last * number / SAMPLED));
    let table = ColorTable::of(sampled)?;
    let gif = Gif::new(Vec::new(), (width, height), rate()?, &table);
    let mut gif = gif.map_err(failed)?;
    for number in 0..=last {
        if task.reach(0.3 + 0.7 * number as f64 / (last + 1) as f64).is_err() {
            return Ok(None);
        }
        gif.push(&player.frame(number)?).map_err(failed)?;
    }
    Ok(Some(gif.finish().map_err(failed)?))
}
