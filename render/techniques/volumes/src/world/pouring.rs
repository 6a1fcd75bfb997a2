//! Paint from tubes.

use glam::Vec3;
use paint::amount::MAX_COLUMN;

use super::actions::{Pour, Source, Timed};
use super::error::{WorldError, in_range};
use super::recipe::{Measured, as_cell, fitting};
use super::settings::STEPS_PER_SECOND;
use super::state::World;
use super::tally::add;
use super::track::Track;
use crate::motion::kick;

/// Level of detail of single volumes that begin where paint is poured.
const DETAIL: u8 = 3;

impl World {
    /// Lets paint flow from the next step on. Returns its number for [`World::stop`] and
    /// [`World::move_source`].
    ///
    /// With a grid the paint goes to the cell of the surface nearest to the source. Without, it
    /// goes to the single volume whose centre is nearest among those that hold the place, or
    /// begins a new one. Away from the surface nothing flows. What a full cell has no room for
    /// stays in the tube, see [`Tally::in_tube`](super::Tally::in_tube).
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

    /// Moves a source to a place (in the unit of the scene), where it stays. Numbers of what has
    /// ended do nothing.
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

    /// Checks that paint can be poured at a place, in the unit of the scene.
    ///
    /// # Errors
    /// [`WorldError::OffSurface`] if it is farther than one cell from the surface.
    pub fn check_place(&self, place: Vec3) -> Result<(), WorldError> {
        self.surface_at(place).map(|_| ())
    }

    /// The sample of the surface nearest to a place.
    fn surface_at(&self, place: Vec3) -> Result<usize, WorldError> {
        let nearest = self.grid.nearest(place);
        let (sample, distance) = nearest.unwrap_or((0, f32::INFINITY));
        let most = self.scale.cell;
        match distance <= most {
            true => Ok(sample),
            false => Err(WorldError::OffSurface { place, distance, most }),
        }
    }

    /// Lets all sources flow for this step.
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
            // No room for another volume.
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

    /// The volume that paint on a sample of the surface goes to, which may begin there.
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
        let index = self.begin(place, super::state::BIRTH * self.scale.cell, DETAIL)?;
        let volume = &mut self.volumes[index];
        (volume.region, volume.normal) = (region, normal);
        Ok(index)
    }
}
