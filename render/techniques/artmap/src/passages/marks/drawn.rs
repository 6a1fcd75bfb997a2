//! Marks drawn on a picture: the pixels under each line.

use super::error::{MarkFault, MarksError};
use super::mark::{Mark, MarkedArea, Marks};

/// The pixels of a mark, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum DrawnArea {
    /// Pixels of a line from which the sample is grown.
    Line(Vec<u32>),
    /// All pixels of the sample.
    Whole(Vec<u32>),
}

impl Marks {
    /// Checks that all marks lie on a picture of `width` x `height` pixels, and that no lines of two
    /// samples cross. No samples at all are no fault.
    ///
    /// # Errors
    /// [`MarksError`] with sample and place.
    pub fn check(&self, width: usize, height: usize) -> Result<(), MarksError> {
        self.lines(width, height).map(|_| ())
    }

    /// The pixels of each mark on a picture of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`MarksError`] if there are no samples, a place lies off the picture or two lines cross.
    pub(crate) fn drawn(&self, width: usize, height: usize) -> Result<Vec<DrawnArea>, MarksError> {
        if self.samples.is_empty() {
            return Err(MarksError::NoSamples { file: self.file.clone() });
        }
        let lines = self.lines(width, height)?.into_iter();
        let areas = lines.zip(&self.samples).map(|(line, mark)| match line {
            Some(pixels) => DrawnArea::Line(pixels),
            None => DrawnArea::Whole(mark.area.rectangle_pixels(width)),
        });
        Ok(areas.collect())
    }

    /// The pixels of each line; `None` for rectangles, which only have to lie on the picture.
    fn lines(&self, width: usize, height: usize) -> Result<Vec<Option<Vec<u32>>>, MarksError> {
        let fault = |mark: &Mark, key: &'static str, fault: MarkFault| MarksError::Sample {
            file: self.file.clone(),
            sample: mark.name.clone(),
            key,
            fault,
        };
        // Pixels of the lines so far and the numbers of their samples, by pixel.
        let mut owners: Vec<(u32, usize)> = Vec::new();
        let mut lines = Vec::new();
        for (number, mark) in self.samples.iter().enumerate() {
            let key = mark.area.key();
            let line = mark.area.line(width, height).map_err(|found| fault(mark, key, found))?;
            for &[x, y] in mark.spacing.iter().flatten() {
                inside(x, y, width, height).map_err(|found| fault(mark, "spacing", found))?;
            }
            for &pixel in line.iter().flatten() {
                if let Ok(at) = owners.binary_search_by_key(&pixel, |&(taken, _)| taken) {
                    let other = self.samples[owners[at].1].name.clone();
                    let x = pixel as usize % width;
                    let y = pixel as usize / width;
                    return Err(fault(mark, key, MarkFault::Crossing { other, x, y }));
                }
            }
            owners.extend(line.iter().flatten().map(|&pixel| (pixel, number)));
            owners.sort_unstable();
            lines.push(line);
        }
        Ok(lines)
    }
}

/// Whether a place lies on the picture.
fn inside(x: f64, y: f64, width: usize, height: usize) -> Result<(), MarkFault> {
    let within = |place: f64, size: usize| (0.0..size as f64).contains(&place);
    if within(x, width) && within(y, height) {
        return Ok(());
    }
    Err(MarkFault::OffPicture { x, y, width, height })
}

impl MarkedArea {
    /// The pixels of a line, in order and each once; `None` for a rectangle.
    fn line(&self, width: usize, height: usize) -> Result<Option<Vec<u32>>, MarkFault> {
        let mut pixels = Vec::new();
        let index = |x: usize, y: usize| (y * width + x) as u32;
        match self {
            Self::Scribble(points) => {
                points.iter().try_for_each(|&[x, y]| inside(x, y, width, height))?;
                let ends = points.iter().zip(points.iter().skip(1).chain(points.last()));
                for (&from, &to) in ends {
                    line(from, to, |x, y| pixels.push(index(x, y)));
                }
            }
            Self::Pixels(places) => {
                for &[x, y] in places {
                    inside(x.into(), y.into(), width, height)?;
                    pixels.push(index(x as usize, y as usize));
                }
            }
            &Self::Rectangle { x, y, width: across, height: down } => {
                inside(x.into(), y.into(), width, height)?;
                let right = f64::from(x) + f64::from(across) - 1.0;
                let below = f64::from(y) + f64::from(down) - 1.0;
                inside(right, below, width, height)?;
                return Ok(None);
            }
        }
        pixels.sort_unstable();
        pixels.dedup();
        Ok(Some(pixels))
    }

    /// The pixels of a rectangle on a picture of this width; none of other areas.
    fn rectangle_pixels(&self, width: usize) -> Vec<u32> {
        let &Self::Rectangle { x, y, width: across, height: down } = self else {
            return Vec::new();
        };
        let rows = (y..y + down).map(|y| y as usize * width);
        let columns = (x..x + across).map(|x| x as usize);
        rows.flat_map(|row| columns.clone().map(move |x| (row + x) as u32)).collect()
    }
}

/// Calls `at` for the pixels of a line, each in the same row or column as the one before, so that
/// lines that cross share a pixel.
fn line([x, y]: [f64; 2], [to_x, to_y]: [f64; 2], mut at: impl FnMut(usize, usize)) {
    let steps = (to_x - x).abs().max((to_y - y).abs()).ceil().max(1.0);
    let mut row = y as usize;
    for step in 0..=steps as usize {
        let share = step as f64 / steps;
        // Both ends lie on the picture, so all places between them do.
        let place = [x + share * (to_x - x), y + share * (to_y - y)].map(|place| place as usize);
        at(place[0], row);
        row = place[1];
        at(place[0], row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marks(areas: Vec<MarkedArea>) -> Marks {
        let name = |number: usize| ["one", "two", "three"][number].to_owned();
        let samples = areas.into_iter().enumerate();
        let samples =
            samples.map(|(number, area)| Mark { name: name(number), area, spacing: None });
        Marks { file: "marks.toml".to_owned(), painting: None, samples: samples.collect() }
    }

    #[test]
    fn a_line_covers_each_row_that_it_passes() {
        let steep = marks(vec![MarkedArea::Scribble(vec![[2.0, 0.0], [4.9, 9.5]])]);
        let [DrawnArea::Line(pixels)] = &steep.drawn(10, 10).unwrap()[..] else {
            panic!("one line")
        };
        let rows: Vec<u32> = pixels.iter().map(|pixel| pixel / 10).collect();
        assert!((0..10).all(|row| rows.contains(&row)), "{pixels:?}");
        assert_eq!((pixels[0], pixels.last()), (2, Some(&94)));
    }

    #[test]
    fn a_rectangle_is_its_pixels() {
        let area = MarkedArea::Rectangle { x: 1, y: 2, width: 2, height: 2 };
        let drawn = marks(vec![area]).drawn(4, 4).unwrap();
        assert_eq!(drawn, [DrawnArea::Whole(vec![9, 10, 13, 14])]);
    }

    #[test]
    fn faults_name_file_sample_and_place() {
        let line = |from, to| MarkedArea::Scribble(vec![from, to]);
        let rectangle = MarkedArea::Rectangle { x: 5, y: 0, width: u32::MAX, height: 1 };
        let cases = [
            (
                marks(vec![line([1.0, 1.0], [8.0, 8.0]), line([8.0, 1.0], [1.0, 8.0])]),
                "marks.toml, sample `two`, scribble: crosses the line of sample `one` at [4, 4]",
            ),
            (
                marks(vec![line([1.0, 1.0], [10.0, 3.0])]),
                "marks.toml, sample `one`, scribble: [10, 3] lies off the picture of 10 x 10 pixels",
            ),
            (
                marks(vec![rectangle]),
                "marks.toml, sample `one`, rectangle: [4294967299, 0] lies off the picture of \
                 10 x 10 pixels",
            ),
            (
                marks(vec![MarkedArea::Pixels(vec![[3, 12]])]),
                "marks.toml, sample `one`, pixels: [3, 12] lies off the picture of 10 x 10 pixels",
            ),
            (marks(Vec::new()), "marks.toml: there are no samples"),
        ];
        for (marks, message) in cases {
            let error = marks.drawn(10, 10).unwrap_err();
            assert_eq!(error.to_string(), message);
            assert!(documents::hint::Explain::hint(&error).is_some(), "{message}");
            let checked = marks.check(10, 10).map_err(|error| error.to_string());
            let wanted = if marks.samples.is_empty() { Ok(()) } else { Err(message.to_owned()) };
            assert_eq!(checked, wanted, "{marks:?}");
        }
        let mut far = marks(vec![MarkedArea::Scribble(vec![[1.0, 1.0]])]);
        far.samples[0].spacing = Some([[1.0, 1.0], [1.0, -3.0]]);
        let message = far.drawn(10, 10).unwrap_err().to_string();
        assert!(message.contains("spacing: [1, -3] lies off"), "{message}");
    }
}
