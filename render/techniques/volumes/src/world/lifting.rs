//! Sponges that take up wet paint.

use paint::layer::Cell;

use super::actions::{Lift, Timed};
use super::error::{WorldError, in_range};
use super::recipe::amounts_of;
use super::settings::STEPS_PER_SECOND;
use super::state::{BIRTH, World};
use super::tally::add;

impl World {
    /// Sets a sponge down, which takes up wet paint from the next step on. Returns its number for
    /// [`World::stop`].
    ///
    /// # Errors
    /// If its radius, rate or time is out of its range.
    pub fn lift(&mut self, lift: Lift) -> Result<u64, WorldError> {
        in_range("radius", lift.radius.into(), [1e-15, 1e15], "above 0")?;
        let most = f64::from(STEPS_PER_SECOND);
        in_range("rate", lift.rate.into(), [0.0, most], "0 to 120")?;
        let number = self.next_number();
        let for_s = lift.for_s;
        self.sponges.push(Timed::new(number, lift, for_s)?);
        Ok(number)
    }

    /// Takes up a share, 0 to 1, of the paint of one volume, which shrinks; a volume that loses
    /// all its paint vanishes. A volume without paint shrinks by the share of its radius.
    ///
    /// # Errors
    /// If there is no such volume, it is dry, or the share is out of its range.
    pub fn shrink(&mut self, index: usize, share: f32) -> Result<(), WorldError> {
        in_range("share", share.into(), [0.0, 1.0], "0 to 1")?;
        let count = self.volumes.len();
        let refused = |why| Err(WorldError::Volume { index, count, why });
        let Some(volume) = self.volumes.get_mut(index) else { return refused("does not exist") };
        if volume.dry {
            return refused("is dry");
        }
        if volume.paint.volume() == 0 {
            let target = volume.target_radius * (1.0 - share);
            // Dots vanish.
            volume.target_radius = if target < BIRTH * self.scale.cell { 0.0 } else { target };
            volume.rests_under = 0;
            return Ok(());
        }
        self.take_share(index, share);
        Ok(())
    }

    /// Moves a share of a volume's paint to the sponge, rounded up.
    fn take_share(&mut self, index: usize, share: f32) {
        let kept = ((1.0 - share) * 65536.0).clamp(0.0, 65536.0) as u32;
        if kept < 65536 {
            let before = self.volumes[index].paint;
            let after = before.share_of_65536(kept);
            add(&mut self.lifted, amounts_of(&before.minus(&after)));
            self.give(index, after);
        }
    }

    /// Takes up the paint below all sponges for this step.
    pub(super) fn take_up(&mut self) {
        let mut sponges = std::mem::take(&mut self.sponges);
        for sponge in &mut sponges {
            self.take_up_with(sponge);
        }
        sponges.retain(|sponge| !sponge.has_ended());
        self.sponges = sponges;
    }

    fn take_up_with(&mut self, timed: &mut Timed<Lift>) {
        let Lift { track, radius, rate, .. } = &timed.what;
        let middle = track.after(timed.seconds());
        let radius = *radius;
        let rate = *rate / STEPS_PER_SECOND as f32;
        timed.steps += 1;
        for index in 0..self.volumes.len() {
            let volume = &self.volumes[index];
            let apart = volume.center.distance(middle);
            let far = radius + volume.radius.max(2.0 * self.scale.cell);
            if volume.dry || volume.paint.volume() == 0 || apart > far {
                continue;
            }
            let covered = self.share_below(index, |at| at.distance(middle) < radius);
            self.take_share(index, covered * rate);
        }
    }

    /// Share of the surface with paint of a volume that lies where `below` is true.
    pub(super) fn share_below(&self, index: usize, below: impl Fn(glam::Vec3) -> bool) -> f32 {
        let volume = &self.volumes[index];
        let samples = &self.grid.samples;
        let own = match volume.cell {
            Some(cell) => samples.of_cell(cell as usize),
            None => 0..samples.len(),
        };
        let held =
            |at: &glam::Vec3| at.distance_squared(volume.center) <= volume.radius * volume.radius;
        let mut all = 0_u32;
        let mut found = 0_u32;
        for place in samples.places[own].iter().filter(|place| held(place)) {
            all += 1;
            found += u32::from(below(*place));
        }
        match all {
            // Too small to hold a sample.
            0 => f32::from(u8::from(below(volume.center))),
            _ => found as f32 / all as f32,
        }
    }

    /// Gives a volume its paint.
    pub(super) fn give(&mut self, index: usize, paint: Cell) {
        match self.volumes[index].cell {
            Some(_) => self.set_paint(index, paint),
            None => self.set_single_paint(index, paint),
        }
    }
}
