//! Paint from tubes, sponges that take up wet paint, and single volumes outside of the grid. You
//! can split a single volume into volumes of the grid.

use glam::Vec3;
use paint::amount::MAX_COLUMN;
use paint::layer::{Cell, SLOTS};

use super::actions::{Lift, Pour, Single, Source, Timed};
use super::recipe::{Measured, Track, amounts_of, as_cell, fitting};
use super::settings::{STEPS_PER_SECOND, WorldError, in_range};
use super::state::{BIRTH, World, add};
use crate::containing::Inside;
use crate::motion::kick;
use crate::volume::Volume;
use crate::wetting::QUANTA_PER_FACE;

/// Level of detail of single volumes that begin where you pour paint.
const DETAIL: u8 = 3;

impl World {
    /// Lets paint flow from the next step on. Returns a number that you can pass to
    /// [`World::stop`] and [`World::move_source`].
    ///
    /// With a grid the paint goes to the cell of the surface nearest to the source. Without a
    /// grid, it goes to the volume with the nearest centre among the single volumes that hold the
    /// place, or begins a new one. Away from the surface nothing flows. If a full cell has no room
    /// for the paint, it stays in the tube, see [`Tally::in_tube`](super::Tally::in_tube).
    ///
    /// # Errors
    /// If a place of its track is farther than one cell from the surface, or the rate or the time
    /// is out of its range.
    pub fn pour(&mut self, pour: Pour) -> Result<u64, WorldError> {
        in_range("rate_mm3_s", pour.rate_mm3_s, [0.0, 1e9], "0 to 1e9")?;
        for place in pour.track.places() {
            self.surface_at(place)?;
        }
        let number = self.next_number();
        let for_s = pour.for_s;
        let source = Source { pour, measured: Measured::default(), flowing: 0, into: None };
        self.sources.push(Timed::new(number, source, for_s)?);
        Ok(number)
    }

    /// Moves a source to a place (in the unit of the scene), where it stays. If the number belongs
    /// to something that has ended, this does nothing.
    ///
    /// # Errors
    /// If the place is farther than one cell from the surface.
    pub fn move_source(&mut self, number: u64, place: Vec3) -> Result<(), WorldError> {
        self.surface_at(place)?;
        for source in self.sources.iter_mut().filter(|source| source.number == number) {
            source.what.pour.track = Track::at(place);
        }
        Ok(())
    }

    /// Checks that you can pour paint at a place, in the unit of the scene.
    ///
    /// # Errors
    /// [`WorldError::OffSurface`] if it is farther than one cell from the surface.
    pub fn check_place(&self, place: Vec3) -> Result<(), WorldError> {
        self.surface_at(place).map(|_| ())
    }

    fn surface_at(&self, place: Vec3) -> Result<usize, WorldError> {
        let nearest = self.grid.nearest(place);
        let (sample, distance) = nearest.unwrap_or((0, f32::INFINITY));
        let most = self.scale.cell;
        match distance <= most {
            true => Ok(sample),
            false => Err(WorldError::OffSurface { place, distance, most }),
        }
    }

    pub(super) fn flow(&mut self) -> Result<(), WorldError> {
        let mut sources = std::mem::take(&mut self.sources);
        let result = sources.iter_mut().try_for_each(|source| self.flow_from(source));
        sources.retain(|source| !source.has_ended());
        self.sources = sources;
        result
    }

    fn flow_from(&mut self, timed: &mut Timed<Source>) -> Result<(), WorldError> {
        let place = timed.what.pour.track.after(timed.seconds());
        timed.steps += 1;
        let ends = timed.has_ended();
        let Source { pour, measured, flowing, into } = &mut timed.what;
        let Ok(sample) = self.surface_at(place) else { return Ok(()) };
        *flowing += 1;
        // The last step completes the amount of its time to the quantum.
        let seconds = match ends && timed.most == Some(*flowing) {
            true => pour.for_s,
            false => *flowing as f64 / f64::from(STEPS_PER_SECOND),
        };
        let due = pour.rate_mm3_s * seconds / self.scale.quantum_mm3;
        let added = measured.up_to(&pour.recipe, due, ends);
        let wet = self.volumes.len();
        let index = match self.volume_under(sample, pour.region) {
            // There is no room for another volume.
            Err(WorldError::Full { .. }) => {
                add(&mut self.in_tube, added);
                return Ok(());
            }
            found => found?,
        };
        let volume = &self.volumes[index];
        let room = match volume.cell {
            Some(cell) => self.grid.cells.room(cell as usize),
            None => MAX_COLUMN,
        };
        let taken = fitting(added, room.saturating_sub(volume.paint.volume()));
        let paint = volume.paint.plus(&as_cell(taken));
        add(&mut self.poured, taken);
        add(&mut self.in_tube, std::array::from_fn(|i| added[i] - taken[i]));
        // Volumes have a kick at birth.
        if into.replace(volume.seed) != Some(volume.seed) && index < wet {
            kick(&mut self.volumes[index], self.settings.motion.kick, self.steps);
        }
        match self.volumes[index].cell {
            Some(_) => self.set_paint(index, paint),
            None => self.set_single_paint(index, paint),
        }
        Ok(())
    }

    /// The volume to which paint on a sample of the surface goes. It may begin there.
    fn volume_under(&mut self, sample: usize, region: u16) -> Result<usize, WorldError> {
        let samples = &self.grid.samples;
        let place = samples.places[sample];
        let normal = samples.normals[sample];
        let cell = samples.cells[sample] as usize;
        if self.settings.cell > 0.0 {
            return self.volume_in(cell, place, region);
        }
        let distance = |index: &usize| self.volumes[*index].center.distance_squared(place);
        let holding = (0..self.volumes.len()).filter(|index| {
            let volume = &self.volumes[*index];
            !volume.dry && distance(index) <= volume.radius * volume.radius
        });
        if let Some(index) = holding.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
            return Ok(index);
        }
        let index = self.begin(place, BIRTH * self.scale.cell, DETAIL)?;
        let volume = &mut self.volumes[index];
        (volume.region, volume.normal) = (region, normal);
        Ok(index)
    }
}

impl World {
    /// Sets a sponge down. It takes up wet paint from the next step on. Returns a number that you
    /// can pass to [`World::stop`].
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

    /// Takes up a share, 0 to 1, of the paint of one volume. The volume shrinks, and vanishes if
    /// it loses all its paint. A volume without paint shrinks by the share of its radius.
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
            volume.target_radius = if target < BIRTH * self.scale.cell { 0.0 } else { target };
            volume.rests_under = 0;
            return Ok(());
        }
        self.take_share(index, share);
        Ok(())
    }

    /// Moves a share of a volume's paint to the sponge. This rounds up.
    fn take_share(&mut self, index: usize, share: f32) {
        let kept = ((1.0 - share) * 65536.0).clamp(0.0, 65536.0) as u32;
        if kept < 65536 {
            let before = self.volumes[index].paint;
            let after = before.share_of_65536(kept);
            add(&mut self.lifted, amounts_of(&before.minus(&after)));
            self.give(index, after);
        }
    }

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

    /// Share of a volume's surface samples within its radius for which `below` is true.
    pub(super) fn share_below(&self, index: usize, below: impl Fn(Vec3) -> bool) -> f32 {
        let volume = &self.volumes[index];
        let samples = &self.grid.samples;
        let own = match volume.cell {
            Some(cell) => samples.of_cell(cell as usize),
            None => 0..samples.len(),
        };
        let mut all = 0_u32;
        let mut found = 0_u32;
        for place in samples.places[own]
            .iter()
            .filter(|at| at.distance_squared(volume.center) <= volume.radius * volume.radius)
        {
            all += 1;
            found += u32::from(below(*place));
        }
        match all {
            // The volume is too small to hold a sample.
            0 => f32::from(u8::from(below(volume.center))),
            _ => found as f32 / all as f32,
        }
    }

    pub(super) fn give(&mut self, index: usize, paint: Cell) {
        match self.volumes[index].cell {
            Some(_) => self.set_paint(index, paint),
            None => self.set_single_paint(index, paint),
        }
    }
}

impl World {
    /// Adds a volume with as much paint of its recipe as makes a film on all surface within its
    /// radius. Returns its index.
    ///
    /// # Errors
    /// If a number is out of its range or there are too many volumes.
    pub fn add_volume(&mut self, single: &Single) -> Result<usize, WorldError> {
        let index = self.begin(single.center, single.radius, single.detail)?;
        let (normal, amount) = self.surface_within(single.center, single.radius);
        let volume = &mut self.volumes[index];
        (volume.region, volume.normal) = (single.region, normal);
        if let Some(recipe) = &single.recipe {
            volume.paint = recipe.measured(amount);
            add(&mut self.poured, amounts_of(&volume.paint));
        }
        Ok(index)
    }

    /// Mean normal of the surface within a ball, and quanta of a film on it.
    fn surface_within(&self, center: Vec3, radius: f32) -> (Vec3, u32) {
        let samples = &self.grid.samples;
        let mut normal = Vec3::ZERO;
        let mut count = 0_u32;
        for (place, own) in samples.places.iter().zip(&samples.normals) {
            if place.distance_squared(center) < radius * radius {
                normal += *own;
                count += 1;
            }
        }
        let quanta = (self.quanta_per_sample() * f64::from(count)).round();
        (normal.normalize_or_zero(), quanta.min(f64::from(MAX_COLUMN)) as u32)
    }

    fn quanta_per_sample(&self) -> f64 {
        let cell = f64::from(self.scale.cell);
        let area = self.grid.samples.areas.first().copied().map_or(0.0, f64::from);
        f64::from(QUANTA_PER_FACE) * area / (cell * cell)
    }

    /// Radius of the ball about `center` in which a film on all surface has `amount` quanta.
    fn radius_of_film(&self, center: Vec3, amount: u32) -> f32 {
        let places = &self.grid.samples.places;
        let mut squares: Vec<f32> =
            places.iter().map(|place| place.distance_squared(center)).collect();
        if squares.is_empty() {
            return 0.0;
        }
        let covered = f64::from(amount) / self.quanta_per_sample();
        let last = squares.len() - 1;
        let (_, nth, _) =
            squares.select_nth_unstable_by(last.min(covered as usize), f32::total_cmp);
        // This is less than a sample, so we take a disk of its area around the nearest.
        nth.sqrt() * (covered.min(1.0) as f32).sqrt()
    }

    /// Gives a single volume its paint. With more paint it grows, with less it shrinks to where
    /// its film reaches.
    pub(super) fn set_single_paint(&mut self, index: usize, paint: Cell) {
        let Volume { center, target_radius, .. } = self.volumes[index];
        let before = self.volumes[index].paint.volume();
        let now = paint.volume();
        let film = self.radius_of_film(center, now).max(BIRTH * self.scale.cell);
        let volume = &mut self.volumes[index];
        volume.target_radius = match now {
            0 => 0.0,
            _ if now > before => target_radius.max(film),
            _ => target_radius.min(film),
        };
        volume.paint = paint;
        volume.rests_under = 0;
    }
}

impl World {
    /// Splits a single volume. We deal its paint to the cells of the surface samples inside of it,
    /// by area, in whole quanta, with the remainder to the first cell. The volume vanishes, unless
    /// cells have no room for some of its paint. Returns the number of cells.
    ///
    /// # Errors
    /// If there is no such volume, it is dry or already in the grid, it contains no surface, there
    /// is no grid, or there are too many volumes.
    pub fn split(&mut self, index: usize) -> Result<usize, WorldError> {
        let count = self.volumes.len();
        let refused = |why| Err(WorldError::Volume { index, count, why });
        let Some(volume) = self.volumes.get(index) else { return refused("does not exist") };
        if volume.cell.is_some() || volume.dry {
            return refused("is dry or already in the grid");
        }
        if self.settings.cell == 0.0 {
            return refused("cannot be split without a grid");
        }
        let region = volume.region;
        let center = volume.center;
        let paint = volume.paint;
        let parts = self.held_samples(index);
        let all: u64 = parts.iter().map(|(_, samples)| samples).sum();
        if all == 0 {
            return refused("contains no surface");
        }
        let whole = amounts_of(&paint);
        let mut dealt: Vec<[u64; SLOTS + 1]> =
            parts.iter().map(|part| whole.map(|amount| amount * part.1 / all)).collect();
        for slot in 0..=SLOTS {
            dealt[0][slot] += whole[slot] - dealt.iter().map(|amounts| amounts[slot]).sum::<u64>();
        }
        let mut left = [0; SLOTS + 1];
        for (&(cell, _), amounts) in parts.iter().zip(dealt) {
            // A volume begins at the surface of its cell nearest to the centre of the whole.
            let own = &self.grid.samples.places[self.grid.samples.of_cell(cell)];
            let nearest = own
                .iter()
                .min_by(|a, b| a.distance_squared(center).total_cmp(&b.distance_squared(center)));
            let place = nearest.copied().unwrap_or(center);
            let taker = self.volume_in(cell, place, region)?;
            let before = self.volumes[taker].paint;
            let room = self.grid.cells.room(cell).saturating_sub(before.volume());
            let taken = fitting(amounts, room);
            self.set_paint(taker, before.plus(&as_cell(taken)));
            for slot in 0..=SLOTS {
                left[slot] += amounts[slot] - taken[slot];
            }
            // Whatever happens next, we must not have paint twice.
            let rest = amounts_of(&self.volumes[index].paint);
            self.volumes[index].paint = as_cell(std::array::from_fn(|i| rest[i] - taken[i]));
        }
        self.set_single_paint(index, as_cell(left));
        Ok(parts.len())
    }

    fn held_samples(&self, index: usize) -> Vec<(usize, u64)> {
        let inside = Inside::of(&self.volumes[index]);
        let samples = &self.grid.samples;
        let wettable =
            (0..self.grid.cells.len()).filter(|&cell| self.grid.cells.capacities[cell] > 0);
        let held = wettable.map(|cell| {
            let own = samples.places[samples.of_cell(cell)].iter();
            (cell, own.filter(|&&place| inside.holds(place)).count() as u64)
        });
        held.filter(|(_, count)| *count > 0).collect()
    }
}
