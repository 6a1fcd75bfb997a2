//! Thumbnails of files. One thread reads them one after the other, and we keep them in memory while
//! there is room.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use web_time::SystemTime;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use graphics::picture_formats::has_picture_ending;

use super::listing::Entry;
use crate::files::job::Job;
use crate::files::picture_file::{on_screen, read_picture};
use crate::language::tr;

/// Longest side of a picture, in pixels.
const LONGEST: usize = 192;

/// Most pictures that we keep. They take at most 37 MB.
const MOST_KEPT: usize = 256;

/// Largest file that we read for its picture, in bytes: 256 MiB.
const MOST_FILE_BYTES: u64 = 256 << 20;

/// Most memory that we use to read a painting for its picture, in bytes: 2 GiB.
const MOST_MEMORY: u64 = 2 << 30;

/// Size and time of a file. If these change, we read its picture again.
type Stamp = (u64, Option<SystemTime>);

/// The picture of a file, as far as we know it.
pub(crate) enum Thumbnail<'a> {
    /// Texture of the picture.
    Ready(&'a TextureHandle),
    /// We have not read it yet.
    Awaited,
    /// The file has no picture that we can read.
    Plain,
}

/// A file that we have read, with its picture if it has one.
struct Known {
    stamp: Stamp,
    picture: Option<TextureHandle>,
    /// Number of the last request for this file.
    asked: u64,
}

#[derive(Default)]
pub(crate) struct Thumbnails {
    known: BTreeMap<PathBuf, Known>,
    reading: Option<(PathBuf, Stamp, Job<ColorImage>)>,
    requests: u64,
}

impl fmt::Debug for Thumbnails {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Thumbnails").field("known", &self.known.len()).finish()
    }
}

impl Thumbnails {
    /// The picture of `entry` in `folder`. If we have not read it yet, we read it now, or after the
    /// one that we are reading. `context` repaints when the picture is there.
    pub(crate) fn of(&mut self, context: &Context, folder: &Path, entry: &Entry) -> Thumbnail<'_> {
        if entry.folder || !may_have_picture(&entry.name) || entry.bytes > MOST_FILE_BYTES {
            return Thumbnail::Plain;
        }
        self.collect(context);
        let path = folder.join(&entry.name);
        let stamp = (entry.bytes, entry.changed);
        let fresh = self.known.get(&path).is_some_and(|known| known.stamp == stamp);
        if !fresh {
            if self.reading.is_none() {
                self.read(context, path, stamp);
            }
            return Thumbnail::Awaited;
        }
        self.requests += 1;
        let asked = self.requests;
        match self.known.get_mut(&path) {
            Some(known) => {
                known.asked = asked;
                known.picture.as_ref().map_or(Thumbnail::Plain, Thumbnail::Ready)
            }
            None => Thumbnail::Plain,
        }
    }

    fn read(&mut self, context: &Context, path: PathBuf, stamp: Stamp) {
        let wake = context.clone();
        let file = path.clone();
        let job = Job::start(
            tr("reading a small picture"),
            move || wake.request_repaint(),
            move |_| Ok(small_picture(&file)?),
        );
        self.reading = Some((path, stamp, job));
    }

    /// Keeps the picture that was read last, once it is there.
    fn collect(&mut self, context: &Context) {
        let Some(result) = self.reading.as_mut().and_then(|(_, _, job)| job.poll()) else { return };
        let Some((path, stamp, _)) = self.reading.take() else { return };
        self.requests += 1;
        let known = Known {
            stamp,
            picture: result
                .ok()
                .map(|image| context.load_texture("thumbnail", image, TextureOptions::LINEAR)),
            asked: self.requests,
        };
        self.known.insert(path, known);
        if self.known.len() > MOST_KEPT {
            let oldest = self.known.iter().min_by_key(|(_, known)| known.asked);
            if let Some(path) = oldest.map(|(path, _)| path.clone()) {
                self.known.remove(&path);
            }
        }
        // We begin the next one in the next frame.
        context.request_repaint();
    }
}

/// Whether a file of this name may have a picture.
fn may_have_picture(name: &str) -> bool {
    let path = Path::new(name);
    let is_painting = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"));
    is_painting || has_picture_ending(path)
}

/// The picture of a file, at most [`LONGEST`] pixels a side.
fn small_picture(path: &Path) -> Result<ColorImage, crate::files::problem::Problem> {
    let read = read_picture(path, LONGEST, MOST_MEMORY)?;
    Ok(on_screen(&read.linear, |rgb| rgb))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(path: &Path) -> Entry {
        let found = std::fs::metadata(path).unwrap();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        Entry { name, folder: false, bytes: found.len(), changed: found.modified().ok() }
    }

    /// Size of the picture of a file once we have read it; `None` for a file without one.
    fn picture(thumbnails: &mut Thumbnails, path: &Path) -> Option<[usize; 2]> {
        let context = Context::default();
        loop {
            match thumbnails.of(&context, path.parent().unwrap(), &entry(path)) {
                Thumbnail::Ready(texture) => return Some(texture.size()),
                Thumbnail::Plain => return None,
                Thumbnail::Awaited => std::thread::yield_now(),
            }
        }
    }

    #[test]
    fn pictures_are_small_and_files_without_one_are_plain() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        for name in ["a.png", "a.tif", "a.WEBP"] {
            image::RgbImage::new(400, 200).save(path.join(name)).unwrap();
        }
        std::fs::write(path.join("b.exr"), "cut off").unwrap();
        std::fs::write(path.join("c.json"), "{}").unwrap();
        let mut thumbnails = Thumbnails::default();
        for name in ["a.png", "a.tif", "a.WEBP"] {
            assert_eq!(picture(&mut thumbnails, &path.join(name)), Some([192, 96]), "{name}");
        }
        assert_eq!(picture(&mut thumbnails, &path.join("b.exr")), None, "it cannot be read");
        assert_eq!(picture(&mut thumbnails, &path.join("c.json")), None, "it is not a picture");
        assert_eq!(thumbnails.known.len(), 4, "the JSON was not read");
    }

    #[test]
    fn a_file_that_changed_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        image::RgbImage::new(40, 20).save(&path).unwrap();
        let mut thumbnails = Thumbnails::default();
        assert_eq!(picture(&mut thumbnails, &path), Some([40, 20]));
        image::RgbImage::new(30, 60).save(&path).unwrap();
        assert_eq!(picture(&mut thumbnails, &path), Some([30, 60]));
        assert_eq!(thumbnails.known.len(), 1, "the old one is gone");
    }

    #[test]
    fn the_picture_that_was_not_asked_for_longest_makes_room() {
        let folder = tempfile::tempdir().unwrap();
        let first = folder.path().join("first.png");
        image::RgbImage::new(4, 4).save(&first).unwrap();
        let mut thumbnails = Thumbnails::default();
        picture(&mut thumbnails, &first);
        let stamp = (0, None);
        for index in 1..MOST_KEPT {
            let known = Known { stamp, picture: None, asked: 1 + index as u64 };
            thumbnails.known.insert(PathBuf::from(format!("/made/{index}")), known);
        }
        thumbnails.requests = MOST_KEPT as u64;
        picture(&mut thumbnails, &first);
        let last = folder.path().join("last.png");
        image::RgbImage::new(4, 4).save(&last).unwrap();
        picture(&mut thumbnails, &last);
        assert_eq!(thumbnails.known.len(), MOST_KEPT);
        assert!(thumbnails.known.contains_key(&first), "it was asked for lately");
        assert!(!thumbnails.known.contains_key(Path::new("/made/1")), "this one was not");
    }
}
