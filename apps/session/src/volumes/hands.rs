//! Records gestures on a scene as events of its script.

use volumes::script::{Action, Dry, Recipe};

use super::command::{Grip, ScenePen};
use super::gesture::{Hand, Hit, Timed, surface_at};
use super::painters::Sight;
use super::scene::Scene;
use crate::failure::FileFailure;

impl Scene {
    /// Sets the pen down with a tool. Returns whether there is a surface below it. Fails if the
    /// moment to show cannot be reached.
    pub(super) fn pen_down(
        &mut self,
        sight: &Sight,
        grip: Grip,
        pen: ScenePen,
    ) -> Result<bool, FileFailure> {
        self.pen_up()?;
        self.reach_moment()?;
        let Some(hit) = self.hit(sight, pen.at) else { return Ok(false) };
        let letter = self.recorded.base().palette.keys().nth(grip.tube);
        let recipe = letter.map(|letter| (letter.clone(), 1.0)).into_iter().collect::<Recipe>();
        let step = self.next_step();
        let at = (hit.place.as_dvec3(), f64::from(pen.pressure));
        let unit_mm = self.timeline.now().world().unit_mm();
        let mut hand = Hand::down(grip, recipe, unit_mm, at, step);
        hand.rest();
        self.hand = Some(hand);
        self.recorded.begin();
        Ok(true)
    }

    /// Moves the pen that is down. If it leaves the surface, it stays where it was.
    pub(super) fn pen_move(&mut self, sight: &Sight, pen: ScenePen) {
        let hit = self.hit(sight, pen.at);
        if let (Some(hand), Some(hit)) = (&mut self.hand, hit) {
            hand.move_to(hit.place.as_dvec3(), f64::from(pen.pressure));
        }
    }

    /// Lifts the pen. A gesture shorter than a step still acts once.
    pub(super) fn pen_up(&mut self) -> Result<(), FileFailure> {
        if self.hand.is_some() && self.recorded.last_is_empty() {
            self.step()?;
        }
        if self.hand.take().is_some() {
            self.recorded.end();
        }
        Ok(())
    }

    pub(super) fn is_at_work(&self) -> bool {
        self.hand.is_some()
    }

    /// Dries all paint. This is an event by itself.
    pub(super) fn dry_all(&mut self) -> Result<(), FileFailure> {
        self.pen_up()?;
        self.reach_moment()?;
        let start = self.next_step();
        self.recorded.begin();
        self.add(Timed { start, end: start + 1, action: Action::Dry(Dry::default()) });
        self.step()
    }

    /// Plays to the moment that the user went to.
    pub(super) fn reach_moment(&mut self) -> Result<(), FileFailure> {
        while self.is_behind() {
            self.timeline.step()?;
        }
        Ok(())
    }

    /// Number of the step that is taken next.
    fn next_step(&self) -> u32 {
        u32::try_from(self.moment()).unwrap_or(u32::MAX)
    }

    /// The surface at a place of the picture.
    pub(super) fn hit(&self, sight: &Sight, at: [f32; 2]) -> Option<Hit> {
        let [width, height] = sight.size;
        surface_at(&self.mesh, &sight.camera, width as f32 / height as f32, at)
    }

    /// Removes the event that was added last. Fails if the rest cannot be played.
    pub(super) fn undo(&mut self) -> Result<(), FileFailure> {
        self.pen_up()?;
        self.recorded.undo().map_or(Ok(()), |from| self.replay_from(from))
    }

    /// Removes an event by its number in the list. Fails if the rest cannot be played.
    pub(super) fn remove(&mut self, number: usize) -> Result<(), FileFailure> {
        self.pen_up()?;
        self.recorded.remove(number).map_or(Ok(()), |from| self.replay_from(from))
    }
}
