//! Reports how a sample was taken, and draws its marks and passages on the picture.

use graphics::field::Field;
use graphics::picture::Picture;
use serde::Serialize;

use super::marks::{DrawnArea, Marks, MarksError};
use super::upright::StrokeDirection;

/// Where we saw strokes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StrokesSeen {
    /// In the lightness of the colours.
    #[serde(rename = "colour")]
    Color,
    /// In the height of the paint, if you know it and did not guess it.
    Relief,
}

/// Where the distance between strokes comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpacingSource {
    /// Two points that you marked.
    Marked,
    /// A setting for all samples without marks that give a distance.
    Set,
    /// Estimated by autocorrelation across the strokes.
    Estimated {
        /// Difference of the first maximum of the autocorrelation and the minimum before it, 0.1
        /// to 2. A larger value is more reliable.
        sharpness: f64,
        /// Channel with the sharper maximum.
        seen: StrokesSeen,
    },
}

/// How one sample was taken.
#[derive(Debug, Clone, PartialEq)]
pub struct PassageReport {
    /// Name of the sample.
    pub name: String,
    /// Pixels of the passage in the picture.
    pub mask: Field<bool>,
    /// Number of regions under the scribble. For a rectangle, this is 0.
    pub regions_under: usize,
    /// Direction of the strokes.
    pub direction: StrokeDirection,
    /// Where we saw more of the gradients agree in direction.
    pub direction_seen: StrokesSeen,
    /// Distance of neighbouring strokes in pixels of the picture.
    pub spacing_px: f64,
    /// Where this distance comes from.
    pub spacing_source: SpacingSource,
    /// Texels of the sample per pixel of the picture, across and along the strokes.
    pub scale: [f64; 2],
    /// Mean CIELAB lightness, 0 to 100.
    pub lightness: f64,
}

impl PassageReport {
    /// Number of pixels of the passage.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.mask.values().iter().filter(|inside| **inside).count()
    }

    /// Column and row of the upper left corner of the passage, its width and height, in pixels.
    #[must_use]
    pub fn bounds(&self) -> [usize; 4] {
        let width = self.mask.width();
        let height = self.mask.height();
        let inside = (0..width * height).filter(|&pixel| self.mask.values()[pixel]);
        let [mut left, mut top, mut right, mut below] = [width, height, 0, 0];
        for (x, y) in inside.map(|pixel| (pixel % width, pixel / width)) {
            (left, top) = (left.min(x), top.min(y));
            (right, below) = (right.max(x + 1), below.max(y + 1));
        }
        [left, top, right.saturating_sub(left), below.saturating_sub(top)]
    }
}

/// Names and linear sRGB of the colours in which we draw marks. After the last colour we begin
/// again with the first. People with deficient colour vision can tell them apart (Okabe and Ito
/// 2008).
const COLORS: [(&str, [f32; 3]); 7] = [
    ("orange", [0.791, 0.347, 0.0]),
    ("sky blue", [0.093, 0.456, 0.814]),
    ("green", [0.0, 0.342, 0.171]),
    ("yellow", [0.871, 0.776, 0.054]),
    ("blue", [0.0, 0.168, 0.445]),
    ("vermilion", [0.665, 0.112, 0.0]),
    ("purple", [0.604, 0.191, 0.386]),
];

/// Everything beyond the passages fades towards this linear grey, by this share.
const FADED: (f32, f32) = (0.55, 0.7);

const RIM: [f32; 3] = [0.9; 3];

const LINE: f64 = 1.0 / 400.0;

/// Name of the colour in which [`marked_picture`] draws the mark number `index`, from 0.
#[must_use]
pub fn drawn_in(index: usize) -> &'static str {
    COLORS[index % COLORS.len()].0
}

/// Linear sRGB of the colour of the mark number `index`, from 0, see [`drawn_in`].
#[must_use]
pub fn color_of_mark(index: usize) -> [f32; 3] {
    COLORS[index % COLORS.len()].1
}

/// Draws each mark on the picture in a colour of its own. If you pass `passages` that were taken
/// by these marks, you also see their outlines. Everything beyond the passages fades.
///
/// # Errors
/// [`MarksError`] if a mark lies off the picture or two lines cross.
///
/// # Panics
/// If a passage has another size than the picture.
pub fn marked_picture(
    picture: &Picture,
    marks: &Marks,
    passages: &[PassageReport],
) -> Result<Picture, MarksError> {
    let width = picture.width();
    let height = picture.height();
    let areas = marks.drawn(width, height)?;
    let mut shown = picture.clone();
    if !passages.is_empty() {
        fade(&mut shown, passages);
    }
    let reach = (LINE * width.max(height) as f64 / 2.0).round().max(1.0) as usize;
    for (index, (mark, area)) in marks.samples.iter().zip(&areas).enumerate() {
        let color = color_of_mark(index);
        if let Some(passage) = passages.iter().find(|passage| passage.name == mark.name) {
            outline(&mut shown, &passage.mask, reach, color);
        }
        match area {
            DrawnArea::Line(pixels) => {
                // The rim separates a line from paint of the same colour.
                thick(&mut shown, pixels, reach + reach.div_ceil(2), RIM);
                thick(&mut shown, pixels, reach, color);
            }
            DrawnArea::Whole(pixels) => {
                let mut mask = Field::filled(width, height, false);
                pixels.iter().for_each(|&pixel| mask.values_mut()[pixel as usize] = true);
                outline(&mut shown, &mask, reach, color);
            }
        }
    }
    Ok(shown)
}

fn fade(shown: &mut Picture, passages: &[PassageReport]) {
    let (grey, share) = FADED;
    for (index, pixel) in shown.values_mut().iter_mut().enumerate() {
        if passages.iter().all(|passage| !passage.mask.values()[index]) {
            *pixel = pixel.map(|value| value + share * (grey - value));
        }
    }
}

/// Colours the pixels of `mask` that lie within `reach` of its outline.
fn outline(shown: &mut Picture, mask: &Field<bool>, reach: usize, color: [f32; 3]) {
    let width = mask.width();
    let height = mask.height();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let around = [
            (x.checked_sub(reach), Some(y)),
            (Some(x + reach), Some(y)),
            (Some(x), y.checked_sub(reach)),
            (Some(x), Some(y + reach)),
        ];
        if mask[(x, y)]
            && around.into_iter().any(|(x, y)| {
                !(match (x, y) {
                    (Some(x), Some(y)) => x < width && y < height && mask[(x, y)],
                    _ => false,
                })
            })
        {
            shown[(x, y)] = color;
        }
    }
}

/// Colours squares of `reach` around the pixels of a line.
fn thick(shown: &mut Picture, pixels: &[u32], reach: usize, color: [f32; 3]) {
    let width = shown.width();
    let height = shown.height();
    for pixel in pixels.iter().map(|&pixel| pixel as usize) {
        let x = pixel % width;
        let y = pixel / width;
        let left = x.saturating_sub(reach);
        let across = (x + reach).min(width - 1) + 1 - left;
        for row in y.saturating_sub(reach)..=(y + reach).min(height - 1) {
            shown.row_mut(row, left, across).fill(color);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::marks::{Mark, MarkedArea};
    use super::super::upright::StrokeDirection;
    use super::*;

    fn marks() -> Marks {
        let line = MarkedArea::Scribble(vec![[10.0, 10.0], [20.0, 10.0]]);
        let rectangle = MarkedArea::Rectangle { x: 40, y: 5, width: 12, height: 15 };
        let samples = [("line", line), ("rectangle", rectangle)].into_iter();
        let samples =
            samples.map(|(name, area)| Mark { name: name.to_owned(), area, spacing: None });
        Marks { file: "m.toml".to_owned(), painting: None, samples: samples.collect() }
    }

    #[test]
    fn lines_and_outlines_have_the_color_of_their_mark_and_the_rest_is_faded() {
        let picture = Field::filled(60, 30, [0.1; 3]);
        let alone = marked_picture(&picture, &marks(), &[]).unwrap();
        let [orange, blue] = [COLORS[0].1, COLORS[1].1];
        assert_eq!((alone[(15, 10)], alone[(15, 11)], alone[(15, 12)]), (orange, orange, RIM));
        assert_eq!((alone[(15, 13)], alone[(23, 10)]), ([0.1; 3], [0.1; 3]));
        assert_eq!((alone[(40, 5)], alone[(51, 12)], alone[(45, 10)]), (blue, blue, [0.1; 3]));
        assert_eq!(alone[(0, 29)], [0.1; 3], "nothing is faded without passages");

        let mask = (0..1800).map(|i| i % 60 < 30 && i / 60 < 20).collect();
        let passage = PassageReport {
            name: "line".to_owned(),
            mask: Field::from_values(60, 30, mask),
            regions_under: 1,
            direction: StrokeDirection { degrees: 0.0, coherence: 0.0, turned: false },
            direction_seen: StrokesSeen::Color,
            spacing_px: 5.0,
            spacing_source: SpacingSource::Marked,
            scale: [1.0; 2],
            lightness: 50.0,
        };
        let shown = marked_picture(&picture, &marks(), &[passage]).unwrap();
        assert_eq!((shown[(29, 15)], shown[(0, 0)], shown[(5, 19)]), (orange, orange, orange));
        assert_eq!((shown[(5, 15)], shown[(15, 10)]), ([0.1; 3], orange));
        assert!(shown[(0, 29)][0] > 0.35, "{:?}", shown[(0, 29)]);
    }

    #[test]
    fn marks_off_the_picture_are_refused() {
        let error = marked_picture(&Field::filled(30, 30, [0.1; 3]), &marks(), &[]).unwrap_err();
        assert!(error.to_string().contains("`rectangle`"), "{error}");
        assert_eq!((drawn_in(0), drawn_in(8)), ("orange", "sky blue"));
        assert_eq!(color_of_mark(8), COLORS[1].1);
    }
}
