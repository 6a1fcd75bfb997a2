//! Executes commands in order, picks paint and reflectance at a position, and finds free places for
//! heaps of paint.

use std::sync::Arc;

use documents::hint::Hint;
use graphics::tile::Rect;
use paint::amount::mm_from_quanta;
use paint::layer::{Layer, SLOTS};
use paint::painting::{Painting, PaintingError};
use paint::session::{Outcome, PaintingSession};
use paint::strokes::{Action, Load, SampleDecimals, Squeeze, StrokeTool, SurfaceId};

use super::command::Command;
use super::event::{Event, KeptPainting, Picked, PickedLayer, Snapshot};
use super::outbox::{is_lifted, waiting_substeps};
use super::report::WorkerStatus;
use super::state::PaintingState;
use super::worker::{OpenPainting, WorkerLoop};

/// Message for a bug: every session of the worker has a palette.
const PALETTE: &str = "every session of the worker has a palette";

impl WorkerLoop<'_> {
    /// Executes one command while no stroke is open and nothing is played.
    pub(super) fn execute(&mut self, command: Command) -> Result<(), PaintingError> {
        match command {
            Command::Open(origin) => self.open(origin),
            Command::Replay { script, library, pace } => self.replay(*script, &library, pace),
            Command::SetUndoBytes(bytes) => {
                self.undo_bytes = bytes;
                if let Some(open) = &mut self.open {
                    open.prepared.session.set_undo_bytes(bytes);
                    self.state_stale = true;
                }
            }
            // A pen command without an open stroke belongs to a stroke that ended or could not
            // begin. The inbox handles `Cancel` and `Quit` itself.
            Command::PenMove(_) | Command::PenUp | Command::Cancel | Command::Quit => {}
            Command::BeginGroup | Command::EndGroup if self.open.is_none() => {}
            command if self.open.is_some() => return self.execute_on_painting(command),
            command => {
                let text = format!("no painting is open for {}", command.name());
                self.send_message(text, Some(Hint::new("open one, or begin a new one")), true);
            }
        }
        Ok(())
    }

    fn stroke_began(&mut self) {
        self.outbox.begin_stroke();
        self.sample_refused = false;
        self.state_stale = true;
    }

    /// Executes a command that needs a painting.
    fn execute_on_painting(&mut self, command: Command) -> Result<(), PaintingError> {
        match command {
            Command::ToolDown { tool, surface, brush } => {
                self.session().begin_stroke_as(tool, surface, &brush, SampleDecimals::PEN)?;
                self.stroke_began();
                Ok(())
            }
            Command::PenDown { surface, brush, decimals } => {
                self.session().begin_stroke_as(StrokeTool::Paint, surface, &brush, decimals)?;
                self.stroke_began();
                let OpenPainting { prepared, reporter, .. } = self.open_mut();
                reporter.stroke_begins(&mut prepared.session, &brush)
            }
            Command::SetBrush { name, spec } => {
                self.session().set_brush(&name, &spec)?;
                self.brush_changed(&name);
                Ok(())
            }
            Command::BeginGroup | Command::EndGroup => {
                let OpenPainting { prepared, groups, .. } = self.open_mut();
                let numbers = prepared.session.history_numbers();
                let (_, done) = prepared.session.history();
                match command {
                    Command::BeginGroup => groups.begin(&numbers, done),
                    _ => groups.end(&numbers, done),
                }
                Ok(())
            }
            Command::Apply(action) => self.apply(&action),
            Command::Adjust(action) => {
                self.open_mut().groups.give_up();
                self.session().adjust(&action)?;
                self.changed();
                Ok(())
            }
            Command::GoTo(done) => {
                let result = self.session().go_to(done);
                self.all_changed();
                result
            }
            Command::SetSecondLight(lighting) => {
                self.session().canvas_mut().set_second_light(lighting.clone())?;
                if let Some(palette) = self.session().painting_mut(SurfaceId::Palette) {
                    palette.set_second_light(lighting)?;
                }
                (self.picture_stale, self.state_stale) = (true, true);
                Ok(())
            }
            Command::LoadPicked { brush, picked, amount_mm } => {
                self.load_picked(brush, &picked, amount_mm)
            }
            Command::SqueezeInFreeSpace { recipe, vehicle, volume_mm3, places, reach_mm } => {
                let palette = self.session().painting_mut(SurfaceId::Palette).expect(PALETTE);
                let Some([x_mm, y_mm]) = freest_place(palette, &places, reach_mm)? else {
                    let hint = "squeeze it out of the tubes";
                    let text = "there is no place for it on the palette";
                    self.send_message(text.to_owned(), Some(Hint::new(hint)), true);
                    return Ok(());
                };
                let on = SurfaceId::Palette;
                let heap = Squeeze { on, recipe, vehicle, x_mm, y_mm, volume_mm3 };
                self.apply(&Action::Squeeze(heap))
            }
            question => self.answer(question),
        }
    }

    /// If the action would undo or repeat one stroke of a group, does this for the whole group.
    fn step_over_group(&mut self, action: &Action) -> Result<Option<Outcome>, PaintingError> {
        let OpenPainting { prepared, groups, .. } = self.open_mut();
        let session = &mut prepared.session;
        let numbers = session.history_numbers();
        let (_, done) = session.history();
        let to = match action {
            Action::Undo {} => groups.undo_target(&numbers, done),
            Action::Redo {} => groups.redo_target(&numbers, done),
            _ => None,
        };
        groups.give_up();
        let Some(done) = to else { return Ok(None) };
        session.go_to(done)?;
        Ok(Some(Outcome::Done))
    }

    fn apply(&mut self, action: &Action) -> Result<(), PaintingError> {
        let outcome = match self.step_over_group(action)? {
            Some(outcome) => outcome,
            None => self.session().apply(action)?,
        };
        match action {
            Action::Load(Load { brush, .. })
            | Action::Wipe { brush, .. }
            | Action::Wash { brush } => self.brush_changed(brush),
            action if outcome == Outcome::Nothing => {
                let text = match action {
                    Action::Dry { .. } => "there is no wet paint to dry",
                    Action::Undo {} => "there is nothing to undo",
                    Action::Redo {} => "there is nothing to redo",
                    Action::Mask(_) => "there is no mask",
                    _ => "there is nothing to do",
                };
                self.send_message(text.to_owned(), None, false);
            }
            _ => self.all_changed(),
        }
        Ok(())
    }

    fn load_picked(
        &mut self,
        brush: String,
        picked: &Picked,
        amount_mm: f64,
    ) -> Result<(), PaintingError> {
        let library = Arc::clone(&self.open_mut().prepared.library);
        let wet = picked.layers.last();
        let amounts = wet.map_or([0.0; SLOTS + 1], |wet| wet.amounts_mm);
        let total: f64 = amounts.iter().sum();
        if total <= 0.0 {
            let hint = "dry paint stays where it is; its recipe can be loaded from the tubes";
            self.send_message("there was no wet paint".to_owned(), Some(Hint::new(hint)), true);
            return Ok(());
        }
        let slots = wet.map_or([None; SLOTS], |wet| wet.slots);
        let named = slots.iter().zip(amounts).filter(|(_, amount)| *amount > 0.0);
        let recipe = named
            .filter_map(|(slot, amount)| Some((library[(*slot)?].name.clone(), amount / total)));
        let load =
            Load { brush, recipe: recipe.collect(), vehicle: amounts[SLOTS] / total, amount_mm };
        self.apply(&Action::Load(load))
    }

    /// Executes a command that changes no paint.
    pub(super) fn answer(&mut self, question: Command) -> Result<(), PaintingError> {
        if self.open.is_none() {
            return Ok(());
        }
        match question {
            Command::Snapshot(number) => {
                let snapshot = self.snapshot(number)?;
                (self.send)(Event::Snapshot(snapshot));
            }
            Command::Keep { number, recorded } => {
                let snapshot = self.snapshot(number)?;
                let session = self.session();
                let agrees = waiting_substeps(session) == 0 && !is_lifted(session);
                let recording = session.recording_from(recorded).filter(|_| agrees);
                let brushes = session.kept_heads()?;
                let mask = session.canvas().mask().cloned();
                let kept = KeptPainting { snapshot, recording, brushes, mask };
                (self.send)(Event::Kept(Arc::new(kept)));
            }
            Command::Recording(number) => match self.session().recording().cloned() {
                Some(script) => {
                    (self.send)(Event::Recording { number, script: Arc::new(script) });
                    self.open_mut().recording_stop_reported = false;
                    self.report_recording_stop();
                }
                None => {
                    let text = "a painting that was recovered has no recording";
                    self.send_message(
                        text.to_owned(),
                        Some(Hint::new("save the painting itself")),
                        true,
                    );
                }
            },
            Command::Pick { surface, x_mm, y_mm, radius_mm } => {
                let place = Place { surface, x_mm, y_mm, radius_mm };
                let painting = self.session().painting_mut(surface).expect(PALETTE);
                if let Some(picked) = pick(painting, place)? {
                    (self.send)(Event::Picked(Arc::new(picked)));
                }
            }
            Command::SetUndoBytes(bytes) => {
                self.undo_bytes = bytes;
                self.session().set_undo_bytes(bytes);
                self.state_stale = true;
            }
            Command::EndAdjustment => {
                self.session().end_adjustment();
                (self.state_stale, self.shot_revision) = (true, None);
            }
            other => unreachable!("`{}` changes paint", other.name()),
        }
        Ok(())
    }

    /// Canvas and palette as they are now.
    fn snapshot(&mut self, number: u64) -> Result<Snapshot, PaintingError> {
        let revision = self.revision;
        let (canvas, palette) = self.session().documents()?;
        let canvas = Arc::new(canvas);
        let palette = Arc::new(palette.expect(PALETTE));
        let brushes = Arc::new(self.session().kept_brushes()?);
        let snapshot = Snapshot { number, canvas, palette, brushes, revision };
        self.keep(&snapshot);
        Ok(snapshot)
    }

    /// State of the painting besides its pixels.
    pub(super) fn state(&mut self) -> Result<Option<Arc<PaintingState>>, PaintingError> {
        let Some(OpenPainting { prepared, reporter, shots, .. }) = &mut self.open else {
            return Ok(None);
        };
        shots.follow(&prepared.session.history_numbers());
        let history_shots = shots.report();
        let revision = self.revision;
        let stroke_open = prepared.session.open_stroke().is_some();
        let status = WorkerStatus { revision, stroke_open, history_shots };
        Ok(Some(Arc::new(reporter.state(prepared, &status, self.outbox.bytes())?)))
    }

    /// Session of the painting.
    pub(super) fn session(&mut self) -> &mut PaintingSession {
        &mut self.open_mut().prepared.session
    }

    pub(super) fn open_mut(&mut self) -> &mut OpenPainting {
        self.open.as_mut().expect("a painting is open")
    }

    fn brush_changed(&mut self, brush: &str) {
        self.open_mut().reporter.brush_changed(brush);
        self.state_stale = true;
    }

    fn changed(&mut self) {
        self.revision += 1;
        (self.picture_stale, self.state_stale) = (true, true);
    }

    pub(super) fn all_changed(&mut self) {
        self.open_mut().reporter.brushes_changed();
        self.changed();
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) surface: SurfaceId,
    pub(super) x_mm: f64,
    pub(super) y_mm: f64,
    pub(super) radius_mm: f64,
}

/// Mean reflectance and paint of the cells in the circle `place`. `painting` must be the one on
/// `place.surface`. Returns `None` if the centre is outside the surface.
pub(super) fn pick(painting: &mut Painting, place: Place) -> Result<Option<Picked>, PaintingError> {
    let cell_mm = painting.cell_mm();
    let rows = rows(painting.bounds(), cell_mm, place);
    let cells: usize = rows.iter().map(|row| row.width).sum();
    if cells == 0 {
        return Ok(None);
    }
    let mut reflectance = vec![0.0; painting.library().grid.count()];
    for &row in &rows {
        let share = row.width as f64 / cells as f64;
        for (sum, value) in reflectance.iter_mut().zip(painting.reflectance_in(row)?) {
            *sum += share * value;
        }
    }
    let state = painting.state().clone();
    let mut layers = Vec::with_capacity(state.dry.len() + 1);
    for (index, dry) in state.dry.iter().enumerate() {
        let amounts_mm = mean_mm(&rows, cell_mm, |row| painting.dry_in(index, row))?;
        let label = dry.label();
        let opacity = dry.shown_opacity();
        layers.push(PickedLayer { label, slots: dry.slots, amounts_mm, opacity });
    }
    let amounts_mm = mean_mm(&rows, cell_mm, |row| painting.wet_in(row))?;
    let label = "Wet".to_owned();
    layers.push(PickedLayer { label, slots: state.slots, amounts_mm, opacity: 1.0 });
    let Place { surface, x_mm, y_mm, .. } = place;
    Ok(Some(Picked { surface, x_mm, y_mm, reflectance, layers }))
}

/// Mean height of each slot and then of the vehicle over the cells of `rows`, in mm.
fn mean_mm(
    rows: &[Rect],
    cell_mm: f64,
    mut read: impl FnMut(Rect) -> Result<Layer, PaintingError>,
) -> Result<[f64; SLOTS + 1], PaintingError> {
    let mut totals = [0_u64; SLOTS + 1];
    let mut cells = 0;
    for &row in rows {
        for (total, more) in totals.iter_mut().zip(read(row)?.totals()) {
            *total += more;
        }
        cells += row.width;
    }
    Ok(totals.map(|total| total as f64 / cells as f64 * mm_from_quanta(1, cell_mm)))
}

/// Cells with their centre in the circle, one rectangle per row, always including the cell under
/// the centre. There are none if the centre is outside `bounds`.
fn rows(bounds: Rect, cell_mm: f64, place: Place) -> Vec<Rect> {
    let [x, y, radius] = [place.x_mm, place.y_mm, place.radius_mm.max(0.0)].map(|mm| mm / cell_mm);
    if !(x >= 0.0 && y >= 0.0 && x < bounds.width as f64 && y < bounds.height as f64) {
        return Vec::new();
    }
    let own = (x.floor(), y.floor());
    let rows = (0..bounds.height).map(|row| {
        let away = row as f64 + 0.5 - y;
        let half = (radius * radius - away * away).max(0.0).sqrt();
        let mut first = (x - half - 0.5).ceil();
        let mut last = (x + half - 0.5).floor();
        if row as f64 == own.1 {
            (first, last) = (first.min(own.0), last.max(own.0));
        } else if away.abs() > radius {
            return Rect::default();
        }
        let first = first.max(0.0);
        let last = last.min(bounds.width as f64 - 1.0);
        if last < first {
            return Rect::default();
        }
        Rect { x: first as usize, y: row, width: (last - first) as usize + 1, height: 1 }
    });
    rows.filter(|row| !row.is_empty()).collect()
}

/// The first of `places`, in mm, that has no wet paint in the square of half side `reach_mm` around
/// it. If there is paint at all of them, this is the place with the least. Returns `None` if no
/// place is on the surface.
pub(super) fn freest_place(
    painting: &mut Painting,
    places: &[[f64; 2]],
    reach_mm: f64,
) -> Result<Option<[f64; 2]>, PaintingError> {
    let mut best: Option<([f64; 2], u64)> = None;
    for &place in places {
        let Some(quanta) = wet_paint_around(painting, place, reach_mm)? else { continue };
        if best.is_none_or(|(_, least)| quanta < least) {
            best = Some((place, quanta));
        }
        if quanta == 0 {
            break;
        }
    }
    Ok(best.map(|(place, _)| place))
}

/// Wet paint in quanta within the square of half side `reach_mm` around a place. Returns `None` for
/// a place outside the surface.
fn wet_paint_around(
    painting: &mut Painting,
    [x_mm, y_mm]: [f64; 2],
    reach_mm: f64,
) -> Result<Option<u64>, PaintingError> {
    let bounds = painting.bounds();
    let cell_mm = painting.cell_mm();
    let ends = [(x_mm, bounds.width), (y_mm, bounds.height)];
    let [(x, right), (y, bottom)] = ends.map(|(at_mm, end)| {
        let first = ((at_mm - reach_mm) / cell_mm).floor().max(0.0) as usize;
        let last = ((at_mm + reach_mm) / cell_mm).ceil().clamp(0.0, end as f64) as usize;
        (first.min(end), last)
    });
    let inside = (0.0..=bounds.width as f64 * cell_mm).contains(&x_mm)
        && (0.0..=bounds.height as f64 * cell_mm).contains(&y_mm);
    if !inside || right <= x || bottom <= y {
        return Ok(None);
    }
    let rect = Rect { x, y, width: right - x, height: bottom - y };
    let wet = painting.wet_in(rect)?;
    Ok(Some((0..rect.width * rect.height).map(|cell| u64::from(wet.cell(cell).volume())).sum()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rect = Rect { x: 0, y: 0, width: 40, height: 30 };

    fn cells(x_mm: f64, y_mm: f64, radius_mm: f64) -> Vec<(usize, usize)> {
        let place = Place { surface: SurfaceId::Canvas, x_mm, y_mm, radius_mm };
        let rows = rows(BOUNDS, 0.1, place);
        rows.iter().flat_map(|row| (row.x..row.x + row.width).map(|x| (x, row.y))).collect()
    }

    #[test]
    fn a_place_is_the_cells_around_it() {
        assert_eq!(cells(0.51, 0.79, 0.0), [(5, 7)], "one cell");
        assert_eq!(cells(0.599, 0.701, 0.01), [(5, 7)], "one cell, though its middle is far");
        let around = cells(0.55, 0.75, 0.101);
        assert_eq!(around, [(5, 6), (4, 7), (5, 7), (6, 7), (5, 8)]);
        for (x, y) in cells(1.03, 1.48, 0.6) {
            let away = (0.1 * x as f64 + 0.05 - 1.03).hypot(0.1 * y as f64 + 0.05 - 1.48);
            assert!(away <= 0.6 || (x, y) == (10, 14), "column {x}, row {y}");
        }
        let area = cells(2.0, 1.5, 1.0).len() as f64;
        assert!((area - 314.0).abs() < 10.0, "a disc of 314 cells, found {area}");
    }

    #[test]
    fn beside_the_surface_lies_nothing() {
        for (x_mm, y_mm) in [(-0.01, 1.0), (1.0, 3.0), (4.0, 1.0), (f64::NAN, 1.0)] {
            assert!(cells(x_mm, y_mm, 2.0).is_empty(), "{x_mm} {y_mm}");
        }
        let corner = cells(0.0, 0.0, 0.2);
        assert!(corner.contains(&(0, 0)) && corner.len() == 3, "what is there: {corner:?}");
    }
}
