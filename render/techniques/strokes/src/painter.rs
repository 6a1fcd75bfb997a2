//! Painting of a target picture: for each brush, coarse to fine, strokes where the canvas
//! still differs.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::ops::ControlFlow;

use super::deposit_curve::DepositCurve;
use super::planned_strokes::{BLUR_SIZES, LevelTarget, PlannedStroke, plan_strokes};
use super::settings::Plan;
use documents::hint::Explain;
use documents::{Cancelled, Task};
use graphics::blurred;
use graphics::field::Field;
use graphics::picture::Picture;
use paint::brush::HeadShape;
use paint::painting::{Painting, PaintingError};
use paint::separation::{ColorErrors, Separation};
use paint::session::{PaintingSession, ReplayError, ReplayReport};
use paint::strokes::{
    Action, BrushSpec, Load, Recipe, Stroke, StrokeScript, StrokeTool, SurfaceId,
};
use rayon::prelude::*;
use spectra::color::delta_e_ciede2000;

/// Brushes below this width in mm are rounds, others filberts (chosen by eye).
const ROUND_BELOW_MM: f64 = 3.0;
/// We leave out pigments with a smaller share than this. The limit is low because strong blues tint
/// white at shares far below 0.001.
const LEAST_PART: f64 = 1e-6;
/// Times that each brush compares the canvas with the target and paints the difference.
const ROUNDS: u64 = 2;

/// Paints a target picture on a bare canvas in strokes. If you have a photograph,
/// [`super::StrokePainter`] sets all of this up for you.
#[derive(Debug, Clone, Copy)]
pub struct Painter<'a> {
    /// Picture to paint, one colour per cell of the canvas, in tones that paint reaches (see
    /// [`super::black_compensated`]).
    pub target: &'a Picture,
    /// Films of the palette that come nearest to each colour.
    pub separation: &'a Separation,
    /// Brushes, and rules for their strokes.
    pub plan: &'a Plan,
}

/// Report of the strokes of one brush.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct LevelReport {
    /// Shape of the brush.
    pub shape: HeadShape,
    /// Width of the brush in mm.
    pub size_mm: f64,
    /// Number of strokes painted.
    pub strokes: u64,
    /// Number of sub-steps of these strokes.
    pub substeps: u64,
    /// Mean CIEDE2000 of the whole picture afterwards, at the scale of the brush (see
    /// [`Painter::blur_cells`]).
    pub mean_error: f64,
}

/// The count of strokes as a task shows it.
struct Count<'a> {
    task: &'a Task,
    painted: u64,
    planned: u64,
}

impl Count<'_> {
    /// This many more strokes are planned.
    fn expect(&mut self, strokes: usize) {
        self.planned += strokes as u64;
        self.task.done(self.painted, self.planned);
    }

    /// One stroke has been painted.
    fn step(&mut self) {
        self.painted += 1;
        self.task.done(self.painted, self.planned);
    }
}

impl Painter<'_> {
    /// Paints on the bare canvas of `session`, which `script` describes. We add all actions to the
    /// script. If you play it, you get this painting again, bit for bit. `task` shows how many of
    /// the strokes planned so far are painted.
    ///
    /// # Errors
    /// [`PainterError`] for brushes that do not suit the canvas, if the device was lost, or if
    /// `task` was cancelled.
    ///
    /// # Panics
    /// If the target and the canvas differ in size, or the plan fails [`Plan::check`].
    pub fn paint(
        &self,
        session: &mut PaintingSession,
        script: &mut StrokeScript,
        task: &Task,
    ) -> Result<Vec<LevelReport>, PainterError> {
        self.plan.check().expect("the plan is valid");
        let mut count = Count { task, painted: 0, planned: 0 };
        let mut reports = Vec::with_capacity(self.plan.sizes_mm.len());
        let cell_mm = session.canvas().cell_mm();
        let mut painted = colors(session.canvas_mut())?;
        for (level, &size_mm) in self.plan.sizes_mm.iter().enumerate() {
            let brush = BrushSpec { shape: shape(size_mm), size_mm };
            let mut report = LevelReport {
                shape: brush.shape,
                size_mm,
                strokes: 0,
                substeps: 0,
                mean_error: 0.0,
            };
            let target = LevelTarget::new(self.target, self.separation, size_mm / cell_mm, level);
            let mut curve = None;
            for round in 0..ROUNDS {
                task.check()?;
                let planned = self.planned(&target, &painted, round, cell_mm);
                if planned.is_empty() {
                    break;
                }
                count.expect(planned.len());
                let curve = match &curve {
                    Some(curve) => curve,
                    None => curve.insert(self.measured(session.canvas(), &brush)?),
                };
                let round = round_script(script, level, &brush, &planned, curve);
                let played = play(round, session, script, &mut count)?;
                report.strokes += played.strokes;
                report.substeps += played.substeps;
                painted = colors(session.canvas_mut())?;
            }
            report.mean_error = self.mean_error(&target, &painted);
            reports.push(report);
        }
        Ok(reports)
    }

    /// Colour error of the canvas against the target, both blurred by a Gaussian with
    /// standard deviation `blur_cells`. 0 compares cell by cell.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn errors(
        &self,
        painting: &mut Painting,
        blur_cells: f64,
    ) -> Result<ColorErrors, PaintingError> {
        let wanted = blurred(self.target, blur_cells);
        let painted = blurred(&colors(painting)?, blur_cells);
        Ok(ColorErrors::between(self.separation, &wanted, &painted))
    }

    /// Mean of [`Painter::errors`]. This is much faster, since it does not ask what is in gamut.
    fn mean_error(&self, target: &LevelTarget, painted: &Picture) -> f64 {
        let film = self.separation.film();
        let painted = blurred(painted, target.blur_cells);
        let pairs = target.picture.values().par_iter().zip(painted.values());
        let errors: Vec<f64> = pairs
            .map(|(&wanted, &painted)| {
                delta_e_ciede2000(film.lab_from_rgb(wanted), film.lab_from_rgb(painted))
            })
            .collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    }

    /// Standard deviation in cells of the blur at which pictures are compared for a brush of
    /// `size_mm`.
    #[must_use]
    pub fn blur_cells(size_mm: f64, cell_mm: f64) -> f64 {
        BLUR_SIZES * size_mm / cell_mm
    }

    /// Strokes of one round over the canvas that looks like `painted`.
    fn planned(
        &self,
        target: &LevelTarget,
        painted: &Picture,
        round: u64,
        cell_mm: f64,
    ) -> Vec<PlannedStroke> {
        let plan = Plan { seed: self.plan.seed.wrapping_add(round), ..self.plan.clone() };
        let unlike = (target.level == 0 && round == 0).then(|| unlike(self.target));
        let current = unlike.as_ref().unwrap_or(painted);
        plan_strokes(target, current, self.separation, &plan, cell_mm)
    }

    /// Measures how thick a film the brush lays, by its load.
    fn measured(
        &self,
        painting: &Painting,
        brush: &BrushSpec,
    ) -> Result<DepositCurve, PaintingError> {
        DepositCurve::measure(brush.shape, brush.size_mm, painting.cell_mm(), self.plan)
    }
}

/// Shape of a brush of this width.
fn shape(size_mm: f64) -> HeadShape {
    if size_mm < ROUND_BELOW_MM { HeadShape::Round } else { HeadShape::Filbert }
}

/// White where `picture` is dark and black elsewhere. With this the first coat also covers a ground
/// that looks like the picture.
fn unlike(picture: &Picture) -> Picture {
    let values = picture
        .values()
        .iter()
        .map(
            |&[red, green, blue]: &[f32; 3]| {
                if red + green + blue < 0.6 { [1.0; 3] } else { [0.0; 3] }
            },
        )
        .collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// Colours of the canvas without relief and gloss.
fn colors(painting: &mut Painting) -> Result<Picture, PaintingError> {
    let flat = painting.flat_picture()?;
    let colors = flat.values().iter().map(|&[red, green, blue, _]| [red, green, blue]);
    Ok(Field::from_values(flat.width(), flat.height(), colors.collect()))
}

/// Script of one round of one brush.
fn round_script(
    script: &StrokeScript,
    level: usize,
    spec: &BrushSpec,
    planned: &[PlannedStroke],
    curve: &DepositCurve,
) -> StrokeScript {
    let mut round = StrokeScript::new(
        &script.title,
        &script.licence,
        script.canvas.clone(),
        script.palette.clone(),
    );
    let brush = format!("{}-{}", level + 1, spec.shape);
    for stroke in planned {
        let length = stroke.amount_mm / stroke.height_mm - 1.0;
        let used = stroke.recipe.iter().zip(&script.palette.pigments);
        let recipe: Recipe = used
            .filter(|(part, _)| **part >= LEAST_PART)
            .map(|(part, (_, name))| (name.clone(), *part))
            .collect();
        round.actions.extend([
            Action::Wash { brush: brush.clone() },
            Action::Load(Load {
                brush: brush.clone(),
                recipe,
                vehicle: 0.0,
                amount_mm: curve.load_mm(stroke.height_mm, length),
            }),
            Action::Stroke(Stroke {
                brush: brush.clone(),
                on: SurfaceId::Canvas,
                tool: StrokeTool::Paint,
                samples: stroke.samples.clone(),
            }),
        ]);
    }
    round.actions.push(Action::Dry { fraction: 1.0 });
    round.brushes = BTreeMap::from([(brush, spec.clone())]);
    round
}

/// Plays the script of a round and adds its actions to `script`.
fn play(
    round: StrokeScript,
    session: &mut PaintingSession,
    script: &mut StrokeScript,
    count: &mut Count<'_>,
) -> Result<ReplayReport, PainterError> {
    let mut kinds = round.actions.iter().map(Action::kind);
    let report = round.replay(
        session,
        |_, _| Ok(()),
        || {
            if kinds.next() == Some("stroke") {
                count.step();
            }
            match count.task.is_cancelled() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        },
    )?;
    count.task.check()?;
    script.brushes.extend(round.brushes);
    script.actions.extend(round.actions);
    Ok(report)
}

/// A photograph cannot be painted.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PainterError {
    /// The picture of the canvas cannot be computed, or the brush cannot be measured.
    #[error("the painting could not go on")]
    #[hint(inner)]
    Painting(#[from] PaintingError),
    /// A stroke cannot be painted.
    #[error("a stroke could not be painted")]
    #[hint(inner)]
    Stroke(#[from] ReplayError<Infallible>),
    /// The task was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
