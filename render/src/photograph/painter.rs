//! A photograph painted: level by level the strokes that what stands on the
//! canvas still wants.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::ops::ControlFlow;

use super::laydown::{Laydown, to_and_fro};
use super::plan::Plan;
use super::planned::{PlannedStroke, SIGHT, plan_layer};
use graphics::blurred;
use graphics::field::Field;
use graphics::picture::Picture;
use paint::brush::HeadShape;
use paint::painting::{Painting, PaintingError};
use paint::separation::ColorErrors;
use paint::separation::Separation;
use paint::session::{PaintingSession, ReplayError, ReplayReport};
use paint::strokes::{Action, BrushSpec, Load, Recipe, Stroke, StrokeScript, SurfaceId};

/// Brushes below this width in mm are rounds, those from it on filberts.
const ROUND_BELOW_MM: f64 = 3.0;
/// Parts of a pigment below this, of all parts 1, are left out of a recipe; strong
/// blues tint a white well below a thousandth.
const LEAST_PART: f64 = 1e-6;
/// How often a level looks at what stands and paints what is off.
const ROUNDS: u64 = 2;

/// What a photograph is painted after.
#[derive(Debug, Clone, Copy)]
pub struct Painter<'a> {
    /// What is wanted, in tones that paint reaches (see
    /// [`super::black_compensated`]); a colour for every cell of the canvas.
    pub target: &'a Picture,
    /// The palette's films.
    pub separation: &'a Separation,
    /// How it is painted.
    pub plan: &'a Plan,
}

/// What one level did.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct LevelReport {
    /// The shape of its brush.
    pub shape: HeadShape,
    /// The brush's width in mm.
    pub size_mm: f64,
    /// Strokes laid.
    pub strokes: u64,
    /// Sub-steps of them.
    pub substeps: u64,
    /// Mean CIEDE2000 of the whole picture afterwards, as the level's brush sees
    /// it.
    pub mean_error: f64,
}

/// How far a painter has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Painted {
    /// So many more strokes are to come.
    Planned(usize),
    /// A stroke was laid.
    Stroke,
}

impl Painter<'_> {
    /// Paints on the canvas of `session`, which is bare and that of `script`; what
    /// is done is added to the script, whose file gives the same painting, bit
    /// for bit.
    ///
    /// # Errors
    /// [`PainterError`] for brushes that do not suit the canvas, or if the device
    /// was lost.
    ///
    /// # Panics
    /// If the target has not the canvas's size, or the plan fails [`Plan::check`].
    pub fn paint(
        &self,
        session: &mut PaintingSession,
        script: &mut StrokeScript,
        mut told: impl FnMut(Painted),
    ) -> Result<Vec<LevelReport>, PainterError> {
        let mut reports = Vec::with_capacity(self.plan.sizes_mm.len());
        for (level, &size_mm) in self.plan.sizes_mm.iter().enumerate() {
            let brush = BrushSpec { shape: shape(size_mm), size_mm };
            let mut report = LevelReport {
                shape: brush.shape,
                size_mm,
                strokes: 0,
                substeps: 0,
                mean_error: 0.0,
            };
            let mut laydown = None;
            for round in 0..ROUNDS {
                let planned = self.planned(session.canvas_mut(), level, round)?;
                if planned.is_empty() {
                    break;
                }
                told(Painted::Planned(planned.len()));
                let laydown = match &laydown {
                    Some(laydown) => laydown,
                    None => laydown.insert(self.tried(session.canvas(), &brush, &planned)?),
                };
                let done = round_of(script, level, &brush, &planned, laydown);
                let played = play(done, session, script, &mut told)?;
                report.strokes += played.strokes;
                report.substeps += played.substeps;
            }
            let sight = SIGHT * size_mm / session.canvas().cell_mm();
            report.mean_error = self.errors(session.canvas_mut(), sight)?.mean;
            reports.push(report);
        }
        Ok(reports)
    }

    /// The colour error of what stands on the canvas, both pictures blurred by
    /// a Gaussian of `blur_cells`: 0 for cell by cell.
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

    /// The blur, in cells, through which a brush of `size_mm` sees.
    #[must_use]
    pub fn sight_cells(size_mm: f64, cell_mm: f64) -> f64 {
        SIGHT * size_mm / cell_mm
    }

    fn planned(
        &self,
        painting: &mut Painting,
        level: usize,
        round: u64,
    ) -> Result<Vec<PlannedStroke>, PaintingError> {
        let current = colors(painting)?;
        let plan = Plan { seed: self.plan.seed.wrapping_add(round), ..self.plan.clone() };
        let cell_mm = painting.cell_mm();
        Ok(plan_layer(self.target, &current, self.separation, &plan, level, cell_mm))
    }

    fn tried(
        &self,
        painting: &Painting,
        brush: &BrushSpec,
        planned: &[PlannedStroke],
    ) -> Result<Laydown, PaintingError> {
        let most_mm = planned.iter().map(|stroke| stroke.height_mm).fold(0.0, f64::max);
        Laydown::tried(brush.shape, brush.size_mm, painting.cell_mm(), self.plan, most_mm)
    }
}

/// The shape of the brush of a width.
fn shape(size_mm: f64) -> HeadShape {
    if size_mm < ROUND_BELOW_MM { HeadShape::Round } else { HeadShape::Filbert }
}

/// The colours that stand on the canvas, without relief and gloss.
fn colors(painting: &mut Painting) -> Result<Picture, PaintingError> {
    let flat = painting.flat_picture()?;
    let colors = flat.values().iter().map(|&[red, green, blue, _]| [red, green, blue]);
    Ok(Field::from_values(flat.width(), flat.height(), colors.collect()))
}

/// A script of one round alone.
fn round_of(
    script: &StrokeScript,
    level: usize,
    spec: &BrushSpec,
    planned: &[PlannedStroke],
    laydown: &Laydown,
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
        let touch = laydown.touch(stroke.height_mm, length);
        let used = stroke.recipe.iter().zip(&script.palette.pigments);
        let recipe: Recipe = used
            .filter(|(part, _)| **part >= LEAST_PART)
            .map(|(part, (_, name))| (name.clone(), *part))
            .collect();
        let samples = to_and_fro(&stroke.samples, touch.passes);
        round.actions.extend([
            Action::Wash { brush: brush.clone() },
            Action::Load(Load {
                brush: brush.clone(),
                recipe,
                vehicle: 0.0,
                amount_mm: touch.load_mm,
            }),
            Action::Stroke(Stroke { brush: brush.clone(), on: SurfaceId::Canvas, samples }),
        ]);
    }
    round.actions.push(Action::Dry { fraction: 1.0 });
    round.brushes = BTreeMap::from([(brush, spec.clone())]);
    round
}

/// Plays a round and adds it to the script.
fn play(
    round: StrokeScript,
    session: &mut PaintingSession,
    script: &mut StrokeScript,
    told: &mut impl FnMut(Painted),
) -> Result<ReplayReport, PainterError> {
    let mut kinds = round.actions.iter().map(Action::kind);
    let step = || {
        if kinds.next() == Some("stroke") {
            told(Painted::Stroke);
        }
        ControlFlow::Continue(())
    };
    let report = round.replay(session, |_, _| Ok(()), step)?;
    script.brushes.extend(round.brushes);
    script.actions.extend(round.actions);
    Ok(report)
}

/// Why a photograph could not be painted.
#[derive(Debug, thiserror::Error)]
pub enum PainterError {
    /// The painting refuses.
    #[error("the painting could not go on")]
    Painting(#[from] PaintingError),
    /// A stroke that the painting refuses.
    #[error("a stroke could not be painted")]
    Stroke(#[from] ReplayError<Infallible>),
}
