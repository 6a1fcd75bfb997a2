//! A lit piece of the ground, made on another thread than the window's.

use std::sync::Arc;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use paint::document::{Document, Lighting, Medium};
use paint::ground::GroundRelief;
use paint::layer::SLOTS;
use paint::light::Light;
use paint::scene::{picture, scene};
use paint::strokes::Canvas;
use pigment::library::PigmentLibrary;
use strokes::Picture;

use crate::files::job::{Job, JobError};
use crate::files::picture_file::on_screen;
use crate::files::problem::Problem;
use crate::language::tr;

/// Columns and rows of cells of the piece.
pub(super) const CELLS: [usize; 2] = [264, 200];

/// Pigments and light for the ground.
#[derive(Debug, Clone)]
pub(super) struct PreviewLight {
    pub(super) library: Arc<PigmentLibrary>,
    pub(super) lighting: Lighting,
    /// The light for `library`. If this is `None`, we compute it from `lighting`.
    pub(super) light: Option<Arc<Light>>,
}

/// The lit piece of the ground that you see, and the one being made.
#[derive(Default)]
pub(super) struct Preview {
    pub(super) texture: Option<TextureHandle>,
    /// Why we cannot make the ground.
    pub(super) problem: Option<Problem>,
    /// The canvas that we last asked for, and whether it used the painting's own pigments.
    asked: Option<(Canvas, bool)>,
    making: Option<Job<ColorImage>>,
}

impl std::fmt::Debug for Preview {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Preview").field("asked", &self.asked).finish_non_exhaustive()
    }
}

impl Preview {
    /// Takes the finished piece. Begins another one if `canvas` or `same` have changed since.
    /// `same` says whether to use the painting's own pigments.
    pub(super) fn update(
        &mut self,
        context: &Context,
        canvas: &Canvas,
        same: bool,
        light: impl FnOnce() -> PreviewLight,
    ) {
        if let Some(made) = self.making.as_mut().and_then(Job::poll) {
            self.making = None;
            match made {
                Ok(image) => {
                    self.problem = None;
                    let load = context.load_texture("ground", image, TextureOptions::LINEAR);
                    self.texture = Some(load);
                }
                Err(JobError::Failed(problem)) => self.problem = Some(problem),
                Err(JobError::Cancelled) => {}
            }
        }
        let wanted = self.asked.as_ref().is_none_or(|(asked, own)| asked != canvas || *own != same);
        if !wanted || self.making.is_some() {
            return;
        }
        self.asked = Some((canvas.clone(), same));
        let wake = context.clone();
        let canvas = canvas.clone();
        let light = light();
        let job = Job::start(
            tr("the ground"),
            move || wake.request_repaint(),
            move |_| Ok(piece(&canvas, &light)?),
        );
        self.making = Some(job);
    }
}

/// A piece of the canvas from its upper left corner, one pixel per cell. If the relief comes from a
/// picture, this is the whole canvas.
fn piece(canvas: &Canvas, light: &PreviewLight) -> Result<ColorImage, Problem> {
    let PreviewLight { library, lighting, light } = light;
    let light = match light {
        Some(light) => Arc::clone(light),
        None => Light::named(library, &lighting.illuminant, &lighting.observer)
            .map(Arc::new)
            .map_err(|error| Problem::from_error(&error))?,
    };
    let part = part_of(canvas);
    let ground = part.ground(library).map_err(|error| Problem::from_error(&error))?;
    let bare = Document::bare(
        "",
        part.cell_mm,
        ground,
        PigmentLibrary::clone(library),
        Medium::of(library),
        [None; SLOTS],
        lighting.clone(),
    );
    let shown = picture(&bare, &scene(&bare, &light));
    let values = shown.values().iter().map(|&[red, green, blue, _]| [red, green, blue]);
    let linear = Picture::from_values(shown.width(), shown.height(), values.collect());
    Ok(on_screen(&linear, |rgb| rgb))
}

/// The canvas that we compute in place of `canvas`. It has at most [`CELLS`].
fn part_of(canvas: &Canvas) -> Canvas {
    let mut part = canvas.clone();
    let [columns, rows] = CELLS.map(|cells| cells as f64);
    if let GroundRelief::Image(_) = part.ground.relief {
        let needed = (canvas.width_mm / columns).max(canvas.height_mm / rows);
        part.cell_mm = part.cell_mm.max(needed);
    } else {
        part.width_mm = part.width_mm.min(columns * part.cell_mm);
        part.height_mm = part.height_mm.min(rows * part.cell_mm);
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use paint::ground::{GroundKind, PictureRelief, Primer};

    fn light() -> PreviewLight {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        PreviewLight { library, lighting: Lighting::default(), light: None }
    }

    fn mean(image: &ColorImage) -> f64 {
        let sum: u64 = image.pixels.iter().map(|pixel| u64::from(pixel.g())).sum();
        sum as f64 / image.pixels.len() as f64
    }

    #[test]
    fn a_piece_shows_the_ground_and_its_color() {
        let mut canvas = Canvas { width_mm: 12.0, ..Canvas::default() };
        let white = piece(&canvas, &light()).unwrap();
        assert_eq!(white.size, [120, 200], "no larger than the canvas");
        canvas.ground.reflectance = Some(Primer::Grey(0.2));
        let grey = piece(&canvas, &light()).unwrap();
        assert!(mean(&grey) < mean(&white) - 60.0, "{} {}", mean(&grey), mean(&white));
        fn spread(image: &ColorImage) -> u8 {
            let greens = image.pixels.iter().map(|pixel| pixel.g());
            greens.clone().max().unwrap() - greens.min().unwrap()
        }
        canvas.ground = GroundKind::Panel.spec(1);
        let panel = piece(&canvas, &light()).unwrap();
        assert!(spread(&white) > spread(&panel), "linen has more relief than a panel");
    }

    #[test]
    fn a_relief_from_a_picture_is_shown_whole() {
        let relief = PictureRelief { path: "none.png".to_owned(), depth_mm: 0.2 };
        let ground = GroundRelief::Image(relief).into();
        let canvas = Canvas { width_mm: 528.0, height_mm: 100.0, cell_mm: 0.1, ground };
        let part = part_of(&canvas);
        assert_eq!((part.cells().0, part.width_mm), (264, 528.0));
        let problem = piece(&canvas, &light()).unwrap_err();
        assert!(problem.text.contains("none.png"), "{problem:?}");
    }
}
