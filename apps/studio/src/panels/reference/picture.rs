//! The pixels of a reference picture, read on a background thread.

use std::path::Path;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use eframe::egui::ColorImage;
use paint::file::MEMORY_LIMIT;
use session::thread;
use spectra::color::RgbSpace;
use strokes::Picture as Linear;

use crate::files::{ReadPicture, on_screen, read_picture};
use crate::language::tr;

/// Maximum of the longer side in pixels; larger pictures are reduced.
const LONGEST: usize = 2048;

/// A picture in linear sRGB, reduced if it is large. All places are in pixels of its file.
#[derive(Debug, Clone)]
pub(super) struct Picture {
    linear: Linear,
    file_size: [usize; 2],
    scene_linear: bool,
}

impl Picture {
    /// Reads a photograph, linear OpenEXR or painting, and reduces it in linear light if it is too
    /// large.
    fn open(path: &Path) -> Result<Self, String> {
        let read = read_picture(path, LONGEST, MEMORY_LIMIT);
        let ReadPicture { linear, file_size, scene_linear } =
            read.map_err(|problem| match problem.hint {
                Some(hint) => format!("{}; {hint}", problem.text),
                None => problem.text,
            })?;
        Ok(Self { linear, file_size, scene_linear })
    }

    /// Width and height of the file in pixels.
    pub(super) fn file_size(&self) -> [usize; 2] {
        self.file_size
    }

    /// Width and height after reduction.
    fn size(&self) -> [usize; 2] {
        [self.linear.width(), self.linear.height()]
    }

    /// Whether the values are those of a scene, so that an exposure decides what is white.
    pub(super) fn is_scene_linear(&self) -> bool {
        self.scene_linear
    }

    /// Converts to an sRGB image at an exposure in stops, in colour or in grey of the same
    /// luminance.
    pub(super) fn on_screen(&self, grey: bool, exposure: f32) -> ColorImage {
        let luminance = RgbSpace::Srgb.xyz_from_linear().0[1].map(|share| share as f32 / 100.0);
        let gain = exposure.exp2();
        on_screen(&self.linear, |rgb| {
            let [red, green, blue] = rgb.map(|value| gain * value);
            if grey {
                let [r, g, b] = luminance;
                return [r * red + g * green + b * blue; 3];
            }
            [red, green, blue]
        })
    }

    /// Mean in linear sRGB, at an exposure in stops, of the pixels whose centres are within
    /// `radius` of a position, all in pixels. Always includes the pixel at the position; `None`
    /// outside the picture.
    pub(super) fn mean(&self, [x, y]: [f32; 2], radius: f32, exposure: f32) -> Option<[f64; 3]> {
        let [width, height] = self.size();
        let reduction = |side: usize, own: usize| side as f32 / own as f32;
        let x = x * reduction(width, self.file_size[0]);
        let y = y * reduction(height, self.file_size[1]);
        let radius = radius * reduction(width, self.file_size[0]);
        if !(0.0..width as f32).contains(&x) || !(0.0..height as f32).contains(&y) {
            return None;
        }
        let range = |at: f32, count: usize| {
            let first = (at - radius).floor().max(0.0) as usize;
            first..=((at + radius).floor() as usize).min(count - 1)
        };
        let mut sum = [0.0; 3];
        let mut count = 0.0;
        for row in range(y, height) {
            for column in range(x, width) {
                let distance = (column as f32 + 0.5 - x).hypot(row as f32 + 0.5 - y);
                if distance <= radius || (column, row) == (x as usize, y as usize) {
                    count += 1.0;
                    for (sum, value) in sum.iter_mut().zip(self.linear.row(row, column, 1)[0]) {
                        *sum += f64::from(value);
                    }
                }
            }
        }
        let gain = f64::from(exposure).exp2();
        Some(sum.map(|sum| gain * sum / count))
    }
}

/// A picture being read on its own thread.
#[derive(Debug)]
pub(super) struct PendingPicture {
    receiver: Receiver<Result<Picture, String>>,
}

impl PendingPicture {
    /// Starts to read; the thread calls `wake` when it ends.
    pub(super) fn start(path: &Path, wake: impl FnOnce() + Send + 'static) -> Self {
        let (sender, receiver) = channel();
        let path = path.to_owned();
        thread::start(move || {
            let _ = sender.send(Picture::open(&path));
            wake();
        });
        Self { receiver }
    }

    /// Returns the picture or an error message once reading has ended.
    pub(super) fn result(&self) -> Option<Result<Picture, String>> {
        match self.receiver.try_recv() {
            Ok(read) => Some(read),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                Some(Err(tr("the picture cannot be read").to_owned()))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Color32;
    use spectra::color::Rgb;

    fn two_by_two() -> Picture {
        let values = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.2, 0.2]];
        let mut linear = Linear::filled(2, 2, [0.0; 3]);
        linear.values_mut().copy_from_slice(&values);
        Picture { linear, file_size: [2, 2], scene_linear: true }
    }

    #[test]
    fn the_mean_is_computed_in_linear_light() {
        let picture = two_by_two();
        assert_eq!(picture.mean([0.5, 0.5], 0.0, 0.0), Some([1.0, 0.0, 0.0]));
        assert_eq!(
            picture.mean([0.9, 0.1], 0.0, 0.0),
            Some([1.0, 0.0, 0.0]),
            "anywhere in a pixel"
        );
        let all = picture.mean([1.0, 1.0], 1.0, 0.0).unwrap();
        for value in all {
            assert!((value - 0.3).abs() < 1e-7, "{all:?}");
        }
        for outside in [[-0.1, 0.5], [2.0, 0.5], [0.5, 2.1], [f32::NAN, 0.5]] {
            assert_eq!(picture.mean(outside, 3.0, 0.0), None, "{outside:?}");
        }
    }

    #[test]
    fn the_mean_includes_only_pixels_within_the_radius() {
        let mut linear = Linear::filled(7, 7, [0.0; 3]);
        linear.values_mut()[3 * 7 + 5] = [1.0; 3];
        let picture = Picture { linear, file_size: [7, 7], scene_linear: false };
        let green = |radius: f32| picture.mean([3.5, 3.5], radius, 0.0).unwrap()[1];
        assert_eq!(green(1.9), 0.0, "the white pixel is two pixels away");
        // 13 pixel centres lie within a distance of 2 from a pixel centre.
        assert!((green(2.0) - 1.0 / 13.0).abs() < 1e-9, "{}", green(2.0));
    }

    #[test]
    fn places_of_a_reduced_picture_are_those_of_its_file() {
        let picture = Picture { file_size: [20, 20], ..two_by_two() };
        assert_eq!(picture.mean([9.9, 5.0], 0.0, 0.0), Some([1.0, 0.0, 0.0]));
        assert_eq!(picture.mean([10.1, 5.0], 4.0, 0.0), Some([0.0, 1.0, 0.0]));
        assert_eq!(picture.mean([10.0, 20.1], 0.0, 0.0), None);
    }

    #[test]
    fn an_exposure_doubles_the_light_with_each_stop() {
        let picture = two_by_two();
        assert_eq!(
            picture.mean([1.5, 1.5], 0.0, 2.0),
            Some([0.2_f32; 3].map(|v| 4.0 * f64::from(v)))
        );
        let shown = picture.on_screen(false, 1.0);
        let [shade, ..] = Rgb([0.4; 3]).encoded().to_bytes();
        assert!(shown.pixels[3].r().abs_diff(shade) <= 1, "{:?}", shown.pixels[3]);
    }

    #[test]
    fn the_screen_shows_srgb_and_grey_of_the_same_luminance() {
        let picture = two_by_two();
        let color = picture.on_screen(false, 0.0);
        assert_eq!(color.pixels[0], Color32::from_rgb(255, 0, 0));
        let [shade, ..] = Rgb([0.2; 3]).encoded().to_bytes();
        assert_eq!(color.pixels[3], Color32::from_gray(shade));
        let grey = picture.on_screen(true, 0.0);
        assert_eq!(grey.pixels[3], Color32::from_gray(shade));
        // Y of the sRGB primaries, IEC 61966-2-1.
        for (pixel, luminance) in grey.pixels.iter().zip([0.2126, 0.7152, 0.0722]) {
            let [wanted, ..] = Rgb([luminance; 3]).encoded().to_bytes();
            assert!(pixel.r().abs_diff(wanted) <= 1, "{pixel:?} for {wanted}");
        }
    }
}
