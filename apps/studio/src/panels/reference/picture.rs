//! The pixels of a reference picture, read on a background thread, and its view in the panel and
//! over the canvas (pure geometry in mm).

use std::path::Path;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use eframe::egui::{ColorImage, Pos2, Rect, Vec2, pos2, vec2};
use paint::file::MEMORY_LIMIT;
use session::thread;
use spectra::color::RgbSpace;
use strokes::Picture as Linear;

use crate::files::{ReadPicture, on_screen, read_picture};
use crate::language::tr;

/// Longest side in pixels. We reduce larger pictures.
const LONGEST: usize = 2048;

/// A picture in linear sRGB, reduced if it is large. All places are in pixels of its file.
#[derive(Debug, Clone)]
pub(super) struct Picture {
    linear: Linear,
    file_size: [usize; 2],
    scene_linear: bool,
}

impl Picture {
    /// Reads a photograph, linear OpenEXR or painting. This reduces it in linear light if it is too
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

    fn size(&self) -> [usize; 2] {
        [self.linear.width(), self.linear.height()]
    }

    /// Whether the values are scene-referred, so that an exposure decides what is white.
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

    /// Mean in linear sRGB, at an exposure in stops, of the pixels with centres within `radius` of
    /// a position, all in pixels. This always includes the pixel at the position. `None` outside
    /// the picture.
    pub(super) fn mean(&self, [x, y]: [f32; 2], radius: f32, exposure: f32) -> Option<[f64; 3]> {
        let [width, height] = self.size();
        let reduction = width as f32 / self.file_size[0] as f32;
        let x = x * reduction;
        let y = y * (height as f32 / self.file_size[1] as f32);
        let radius = radius * reduction;
        if !(0.0..width as f32).contains(&x) || !(0.0..height as f32).contains(&y) {
            return None;
        }
        let [columns, rows] = [(x, width), (y, height)].map(|(at, count)| {
            let first = (at - radius).floor().max(0.0) as usize;
            first..=((at + radius).floor() as usize).min(count - 1)
        });
        let mut sum = [0.0; 3];
        let mut count = 0.0;
        for row in rows {
            for column in columns.clone() {
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
    /// Starts to read. The thread calls `wake` at its end.
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

/// Minimum and maximum zoom, in points for each pixel.
const ZOOM: (f32, f32) = (0.02, 64.0);

/// Position, zoom and mirroring of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PictureView {
    /// Picture position at the centre of the panel, in pixels.
    pub(super) center: Vec2,
    /// Zoom in points for each pixel.
    pub(super) zoom: f32,
    /// Whether the picture is mirrored horizontally.
    pub(super) flipped: bool,
}

impl PictureView {
    /// Fits a picture of `size` pixels into a panel of `panel_size` points.
    pub(super) fn fit(size: Vec2, panel_size: Vec2, flipped: bool) -> Self {
        let zoom = (panel_size.x / size.x).min(panel_size.y / size.y).clamp(ZOOM.0, ZOOM.1);
        Self { center: size / 2.0, zoom, flipped }
    }

    fn side(self) -> f32 {
        if self.flipped { -1.0 } else { 1.0 }
    }

    /// Converts a picture position in pixels to a point of the window.
    pub(super) fn point(self, panel: Rect, place: Vec2) -> Pos2 {
        let offset = (place - self.center) * self.zoom;
        panel.center() + vec2(self.side() * offset.x, offset.y)
    }

    /// Converts a point of the window to a picture position in pixels.
    pub(super) fn place(self, panel: Rect, point: Pos2) -> Vec2 {
        let offset = (point - panel.center()) / self.zoom;
        self.center + vec2(self.side() * offset.x, offset.y)
    }

    /// Returns the view moved by a drag, in points.
    pub(super) fn panned(self, by: Vec2) -> Self {
        let offset = by / self.zoom;
        Self { center: self.center - vec2(self.side() * offset.x, offset.y), ..self }
    }

    /// Returns the view zoomed by a factor about a fixed point.
    pub(super) fn zoomed(self, panel: Rect, about: Pos2, factor: f32) -> Self {
        let zoom = (self.zoom * factor).clamp(ZOOM.0, ZOOM.1);
        let fixed = self.place(panel, about);
        let moved = Self { zoom, ..self };
        let now = moved.place(panel, about);
        Self { center: moved.center + fixed - now, ..moved }
    }

    /// Rectangle of the whole picture of `size` pixels in the window, and its texture
    /// coordinates.
    pub(super) fn rects(self, panel: Rect, size: Vec2) -> (Rect, Rect) {
        let rect = Rect::from_two_pos(self.point(panel, Vec2::ZERO), self.point(panel, size));
        let (left, right) = if self.flipped { (1.0, 0.0) } else { (0.0, 1.0) };
        (rect, Rect { min: pos2(left, 0.0), max: pos2(right, 1.0) })
    }
}

/// Shortest width of a picture over the canvas, in mm.
const LEAST_MM: f64 = 2.0;

/// Middle, width and turn of a picture over the canvas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OverlayPlace {
    pub(super) center: [f64; 2],
    pub(super) width_mm: f64,
    /// Clockwise turn in radians.
    pub(super) turn: f64,
}

/// How the picture lies over the canvas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OverCanvas {
    /// Whether it is shown there.
    pub(super) shown: bool,
    /// Opacity, 0 to 1.
    pub(super) opacity: f32,
    /// Whether the pointer moves it instead of painting.
    pub(super) moving: bool,
    /// Its place. If you have not moved it, it is fitted to the canvas.
    pub(super) place: Option<OverlayPlace>,
}

impl Default for OverCanvas {
    fn default() -> Self {
        Self { shown: false, opacity: 0.4, moving: false, place: None }
    }
}

impl OverlayPlace {
    /// Fits the picture into the middle of a canvas of `canvas_mm`, without stretching. `aspect` is
    /// its width divided by its height.
    pub(super) fn fitted(canvas_mm: [f64; 2], aspect: f64) -> Self {
        let [width, height] = canvas_mm;
        let center = [0.5 * width, 0.5 * height];
        Self { center, width_mm: width.min(height * aspect), turn: 0.0 }
    }

    /// Place in mm of a point of the picture. Pass shares of its width and height, from the upper
    /// left corner.
    pub(super) fn point(&self, [across, down]: [f64; 2], aspect: f64) -> [f64; 2] {
        let x = (across - 0.5) * self.width_mm;
        let y = (down - 0.5) * self.width_mm / aspect;
        let (sin, cos) = self.turn.sin_cos();
        [self.center[0] + cos * x - sin * y, self.center[1] + sin * x + cos * y]
    }

    pub(super) fn moved(self, by: [f64; 2]) -> Self {
        Self { center: [self.center[0] + by[0], self.center[1] + by[1]], ..self }
    }

    /// Scales it about its middle, so that a corner is as far from the middle as `to`.
    pub(super) fn scaled_to(self, to: [f64; 2], aspect: f64) -> Self {
        let reach = (to[0] - self.center[0]).hypot(to[1] - self.center[1]);
        let width_mm = 2.0 * reach / 1.0_f64.hypot(1.0 / aspect);
        Self { width_mm: width_mm.max(LEAST_MM), ..self }
    }

    /// Turns it about its middle, so that its upper edge faces `to`.
    pub(super) fn turned_to(self, to: [f64; 2]) -> Self {
        let x = to[0] - self.center[0];
        let y = to[1] - self.center[1];
        if x.hypot(y) < 1e-9 { self } else { Self { turn: x.atan2(-y), ..self } }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum ReferenceMode {
    /// Picks colours.
    #[default]
    Pick,
    /// Marks samples of brushwork.
    Mark,
    Comb,
}

impl ReferenceMode {
    /// All modes in the order of their buttons.
    pub(super) const ALL: [Self; 3] = [Self::Pick, Self::Mark, Self::Comb];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Pick => tr("Pick colour"),
            Self::Mark => tr("Mark samples"),
            Self::Comb => tr("Comb"),
        }
    }

    pub(super) fn description(self) -> &'static str {
        match self {
            Self::Pick => tr("A click picks a colour to match"),
            Self::Mark => tr("Lines over passages of brushwork, from which samples are taken"),
            Self::Comb => tr("Lines along which strokes run on a model or a picture"),
        }
    }
}

#[cfg(test)]
mod place_tests {
    use super::*;

    fn near(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9
    }

    #[test]
    fn a_fitted_picture_touches_two_edges_of_the_canvas() {
        let wide = OverlayPlace::fitted([200.0, 100.0], 4.0);
        assert!(near(wide.point([0.0, 0.0], 4.0), [0.0, 25.0]), "{wide:?}");
        assert!(near(wide.point([1.0, 1.0], 4.0), [200.0, 75.0]), "{wide:?}");
        let high = OverlayPlace::fitted([200.0, 100.0], 0.5);
        assert!(near(high.point([0.0, 0.0], 0.5), [75.0, 0.0]), "{high:?}");
    }

    #[test]
    fn handles_stay_under_the_pointer() {
        let place = OverlayPlace::fitted([200.0, 100.0], 2.0).moved([10.0, -5.0]);
        assert_eq!(place.center, [110.0, 45.0]);
        // A corner in the direction of the picture's own corner.
        let corner = [place.center[0] + 40.0, place.center[1] + 20.0];
        let scaled = place.scaled_to(corner, 2.0);
        assert!(near(scaled.point([1.0, 1.0], 2.0), corner), "{scaled:?}");
        let turned = place.turned_to([150.0, 45.0]);
        assert!((turned.turn - std::f64::consts::FRAC_PI_2).abs() < 1e-9, "a quarter clockwise");
        let top = turned.point([0.5, 0.0], 2.0);
        assert!(near(top, [160.0, 45.0]), "the upper edge is at the right: {top:?}");
        let down = place.turned_to([110.0, 90.0]);
        assert!((down.turn - std::f64::consts::PI).abs() < 1e-9, "upside down: {down:?}");
        assert_eq!(place.scaled_to(place.center, 2.0).width_mm, LEAST_MM);
        assert_eq!(place.turned_to(place.center), place);
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
        let [smaller, larger] =
            [1.9, 2.0].map(|radius| picture.mean([3.5, 3.5], radius, 0.0).unwrap()[1]);
        assert_eq!(smaller, 0.0, "the white pixel is two pixels away");
        // 13 pixel centres lie within a distance of 2 from a pixel centre.
        assert!((larger - 1.0 / 13.0).abs() < 1e-9, "{larger}");
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

    const PANEL: Rect = Rect { min: pos2(100.0, 50.0), max: pos2(500.0, 350.0) };

    fn near(a: Vec2, b: Vec2) -> bool {
        (a - b).length() < 1e-3
    }

    #[test]
    fn a_fitted_picture_touches_two_edges() {
        for flipped in [false, true] {
            let view = PictureView::fit(vec2(1600.0, 400.0), PANEL.size(), flipped);
            let (rect, _) = view.rects(PANEL, vec2(1600.0, 400.0));
            assert_eq!((rect.left(), rect.right()), (100.0, 500.0));
            assert!(rect.top() > 50.0 && rect.bottom() < 350.0, "{rect:?}");
        }
    }

    #[test]
    fn point_and_position_are_inverse_flipped_or_not() {
        for flipped in [false, true] {
            let view = PictureView { center: vec2(30.0, 70.0), zoom: 2.5, flipped };
            for place in [vec2(0.0, 0.0), vec2(31.0, 68.0), vec2(200.0, 10.0)] {
                let back = view.place(PANEL, view.point(PANEL, place));
                assert!(near(back, place), "{back:?} for {place:?}");
            }
        }
        let flipped = PictureView { center: vec2(30.0, 70.0), zoom: 2.0, flipped: true };
        let right = flipped.point(PANEL, vec2(40.0, 70.0));
        assert_eq!(right, PANEL.center() - vec2(20.0, 0.0), "what is right is shown left");
    }

    #[test]
    fn zoom_keeps_the_point_and_pan_follows_the_drag() {
        for flipped in [false, true] {
            let view = PictureView { center: vec2(30.0, 70.0), zoom: 1.0, flipped };
            let about = pos2(140.0, 300.0);
            let hand = vec2(25.0, -12.0);
            let zoomed = view.zoomed(PANEL, about, 3.0);
            assert!(near(zoomed.place(PANEL, about), view.place(PANEL, about)));
            assert_eq!(zoomed.zoom, 3.0);
            let panned = view.panned(hand);
            assert!(near(panned.place(PANEL, about + hand), view.place(PANEL, about)));
            assert_eq!(view.zoomed(PANEL, about, 1e9).zoom, ZOOM.1);
        }
    }
}
