//! Plays a script on a world, step by step.
//!
//! We apply the events of the script in their steps. Events pick places in the first picture. You
//! save performances as files, from which they continue to the same bytes.

use documents::hint::Explain;
use glam::Vec3;
use graphics::camera::Camera;
use graphics::mesh::Mesh;
use graphics::surface::{NO_TRIANGLE, VisibilityBuffer, position_at, visible};

use crate::motion::{KeepIn, MotionError, MotionSettings, Push};
use crate::saved::{Kind, Reader, SavedError, Stored, file_of_state, identity, state_of_file};
use crate::script::{
    self, Action, Ball, Dry, Event, KeepTable, Place, Quantity, Script, seconds_of,
};
use crate::settings::Settings;
use crate::toml_text::{Fault, KeyPath, KeyStep, Source};
use crate::wetting::WettingError;
use crate::world::{
    Lift, Pour, Recipe, Single, StepDevice, Track, World, WorldError, WorldSettings,
};

/// A script cannot be played.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PerformanceError {
    /// The world cannot be made or go on.
    #[error(transparent)]
    World(#[from] WorldError),
    /// A setting does not fit the scene.
    #[error("{place}{fault}")]
    #[hint(with = fault.hint())]
    #[fault(Setting)]
    Setting {
        /// File and line, followed by a colon, where these are known.
        place: String,
        /// The setting.
        fault: Box<Fault>,
    },
    /// An event cannot be done.
    #[error("{place}: {error}")]
    #[hint(inner = error)]
    Event {
        /// The table of the event, with file and line where these are known.
        place: String,
        /// Path of the table in the script.
        table: KeyPath,
        /// Reason.
        error: WorldError,
    },
    /// The first picture shows nothing where paint is poured or lifted.
    #[error("{place}: the first picture shows no surface at {x:.3}, {y:.3}")]
    #[hint("choose a place on the subject, 0 to 1 across and down")]
    Bare {
        /// The table of the event, with file and line where these are known.
        place: String,
        /// Path of the table in the script.
        table: KeyPath,
        /// Share of the picture's width, from the left.
        x: f64,
        /// Share of its height, from the top.
        y: f64,
    },
    /// The volume that an event should split is not there.
    #[error("{place}: single volume {number} is not there")]
    #[hint("split a volume after it begins, and only once")]
    NoVolume {
        /// The table of the event, with file and line where these are known.
        place: String,
        /// Path of the table in the script.
        table: KeyPath,
        /// Number of the volume in the script, from 1.
        number: usize,
    },
}

impl PerformanceError {
    /// Adds the file from which you read the script, and the line of the event's table in its
    /// `text`.
    #[must_use]
    pub fn located(mut self, file: &str, text: &str) -> Self {
        let Ok(source) = Source::toml(file, text) else { return self };
        if let Self::Setting { place, fault } = &mut self {
            *place = format!("{file}, line {}: ", source.line(&fault.key));
        }
        match self.table().map(|table| (source.line(table), table.to_string())) {
            Some((line, table)) => self.placed(format!("{file}, line {line}: {table}")),
            None => self,
        }
    }

    /// Path of the event's table in the script. `None` if no event is at fault.
    #[must_use]
    pub fn table(&self) -> Option<&KeyPath> {
        match self {
            Self::World(_) | Self::Setting { .. } => None,
            Self::Event { table, .. } | Self::Bare { table, .. } | Self::NoVolume { table, .. } => {
                Some(table)
            }
        }
    }

    /// Replaces the words for the place of the event.
    #[must_use]
    pub fn placed(mut self, words: String) -> Self {
        match &mut self {
            Self::World(_) | Self::Setting { .. } => {}
            Self::Event { place, .. } | Self::Bare { place, .. } | Self::NoVolume { place, .. } => {
                *place = words;
            }
        }
        self
    }
}

impl From<&Settings> for WorldSettings {
    fn from(settings: &Settings) -> Self {
        let Settings { motion, grid, .. } = settings;
        Self {
            unit_mm: (settings.unit_mm > 0.0).then(|| f64::from(settings.unit_mm)),
            cell: grid.cell,
            samples: grid.samples as usize,
            film_mm: f64::from(grid.film_mm),
            rate: grid.rate,
            slope: grid.slope,
            seed: u64::from(settings.seed),
            motion: MotionSettings {
                pressure: motion.pressure,
                elastic: motion.elastic,
                cohesion: motion.cohesion,
                friction: motion.friction,
                kick: motion.kick,
                microstructure: motion.microstructure,
                grain: motion.grain,
                fastest: motion.fastest,
                surface_pull: motion.surface_pull,
                gravity: motion.gravity,
                keep: motion.keep,
            },
        }
    }
}

/// A script that you play. A clone is a snapshot: it continues to the same bytes.
#[derive(Debug, Clone)]
pub struct Performance {
    world: World,
    script: Script,
    events: Vec<Event>,
    next: usize,
    /// The place that each event picks in the first picture. `None` if it does not pick one.
    picked: Vec<Option<Vec3>>,
    /// Seed of each single volume (`[[volume]]`) of the script, by its index there. `None` until
    /// the volume is added to the world.
    singles: Vec<Option<u64>>,
}

impl Performance {
    /// Begins `script` on `scene` with these settings ([`Script::settings`]). `view` is the first
    /// picture, in which events pick places.
    ///
    /// # Errors
    /// [`PerformanceError`] for a world that cannot be made, walls out of range, picked places
    /// where the first picture shows nothing, and paint poured off the surface.
    pub fn new(
        script: &Script,
        scene: &Mesh,
        settings: &Settings,
        view: &FirstView,
    ) -> Result<Self, PerformanceError> {
        let mut world = World::of(scene, &WorldSettings::from(settings))
            .map_err(|error| of_settings(error, settings, scene))?;
        for keep in &script.keeps {
            world.keep(region(keep))?;
        }
        let events = script.events();
        let picked: Result<_, _> = events.iter().map(|event| picked(event, scene, view)).collect();
        let singles = vec![None; script.volumes.len()];
        let own = Self { world, script: script.clone(), events, next: 0, picked: picked?, singles };
        own.check_pours()?;
        Ok(own)
    }

    fn check_pours(&self) -> Result<(), PerformanceError> {
        for (index, event) in self.events.iter().enumerate() {
            let Action::Pour(pour) = &event.action else { continue };
            let track = self.track(&pour.place, index);
            track
                .and_then(|track: Track| {
                    let mut places = track.places();
                    places.try_for_each(|place| self.world.check_place(place))
                })
                .map_err(|error| at_event(event, error))?;
        }
        Ok(())
    }

    /// The world as it is now.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Number of steps that you have played.
    #[must_use]
    pub fn step(&self) -> u64 {
        self.world.steps()
    }

    /// Plays on until `step` steps are played. If they are already, this does nothing.
    ///
    /// # Errors
    /// [`PerformanceError`] for an event that cannot be done, such as paint poured off the
    /// surface.
    pub fn advance_to(&mut self, step: u64) -> Result<(), PerformanceError> {
        self.play(step, World::step)
    }

    /// Plays on like [`Self::advance_to`]. A graphics device moves large worlds
    /// ([`World::step_on`]).
    ///
    /// # Errors
    /// This fails like [`Self::advance_to`], and if the device fails.
    pub fn advance_on(
        &mut self,
        device: &mut StepDevice,
        step: u64,
    ) -> Result<(), PerformanceError> {
        self.play(step, |world| world.step_on(device))
    }

    fn play(
        &mut self,
        step: u64,
        mut go_on: impl FnMut(&mut World) -> Result<(), WorldError>,
    ) -> Result<(), PerformanceError> {
        while self.world.steps() < step {
            while let Some(event) = self.events.get(self.next) {
                if u64::from(event.start) > self.world.steps() {
                    break;
                }
                let event = event.clone();
                self.act(&event)?;
                self.next += 1;
            }
            go_on(&mut self.world)?;
        }
        Ok(())
    }

    /// Adds an event that begins with the next step or later. No other event of its kind may come
    /// after it in the script, and it cannot pick its place. This lets you play a performance while
    /// you write its script.
    pub fn add(&mut self, event: Event) {
        fn place(other: &Event) -> (u32, usize) {
            (other.start, other.action.rank())
        }
        let at = self.events.partition_point(|other| place(other) <= place(&event));
        let at = at.max(self.next);
        self.events.insert(at, event);
        self.picked.insert(at, None);
    }

    /// Continues by another script of the same scene, settings and walls. Its events before the
    /// present step must be the same. Pass `scene` and `view` as in [`Performance::new`].
    ///
    /// # Errors
    /// [`PerformanceError`] for picked places where the first picture shows nothing.
    pub fn go_on_by(
        &mut self,
        script: &Script,
        scene: &Mesh,
        view: &FirstView,
    ) -> Result<(), PerformanceError> {
        let events = script.events();
        let picked: Result<_, _> = events.iter().map(|event| picked(event, scene, view)).collect();
        self.picked = picked?;
        self.next = events.partition_point(|event| u64::from(event.start) < self.step());
        (self.events, self.script) = (events, script.clone());
        self.singles.resize(self.script.volumes.len(), None);
        Ok(())
    }

    fn act(&mut self, event: &Event) -> Result<(), PerformanceError> {
        let for_s = seconds_of(event.end - event.start);
        let failed = |error: WorldError| at_event(event, error);
        match &event.action {
            Action::Volume(volume) => {
                let recipe = self.recipe(&volume.recipe).map_err(failed)?;
                let index = self.world.add_volume(&Single {
                    center: narrow(volume.center),
                    radius: volume.radius as f32,
                    detail: volume.detail,
                    recipe: Some(recipe),
                    region: volume.region as u16,
                });
                let seed = self.world.volumes()[index.map_err(failed)?].seed;
                // The index of the table in the script is the number that `[[split]]` names.
                if let Some(KeyStep::Index(number)) = event.table.0.last() {
                    self.singles[*number] = Some(seed);
                }
            }
            Action::Pour(pour) => {
                let recipe = self.recipe(&pour.recipe).map_err(failed)?;
                let rate_mm3_s = match pour.quantity {
                    Quantity::Rate(rate) => rate,
                    Quantity::Amount(amount) => amount / for_s,
                };
                let track = self.track(&pour.place, self.next).map_err(failed)?;
                let region = pour.region as u16;
                let pour = Pour { track, rate_mm3_s, for_s, recipe, region };
                self.world.pour(pour).map_err(failed)?;
            }
            Action::Push(push) => {
                let pushed = Push {
                    center: narrow(push.at),
                    direction: narrow(push.towards).normalize_or_zero(),
                    radius: push.radius as f32,
                    strength: push.strength as f32,
                };
                self.world.push(pushed, for_s).map_err(failed)?;
            }
            Action::Lift(lift) => {
                let track = self.track(&lift.place, self.next).map_err(failed)?;
                let radius = lift.radius as f32;
                let rate = lift.rate as f32;
                self.world.lift(Lift { track, radius, rate, for_s }).map_err(failed)?;
            }
            Action::Split(split) => self.split(event, split.volume)?,
            Action::Dry(Dry { ball: None }) => self.world.dry(),
            Action::Dry(Dry { ball: Some(Ball { center, radius }) }) => {
                let dried = self.world.dry_within(narrow(*center), *radius as f32);
                dried.map(|_| ()).map_err(failed)?;
            }
        }
        Ok(())
    }

    /// Splits a single volume of the script. Without a `volume`, splits all that are there.
    fn split(&mut self, event: &Event, volume: Option<usize>) -> Result<(), PerformanceError> {
        let wanted: Vec<u64> = match volume {
            None => self.singles.iter().flatten().copied().collect(),
            Some(index) => {
                let seed = self.singles.get(index).copied().flatten();
                vec![seed.ok_or_else(|| PerformanceError::NoVolume {
                    place: event.table.to_string(),
                    table: event.table.clone(),
                    number: index + 1,
                })?]
            }
        };
        for seed in wanted {
            match self
                .world
                .volumes()
                .iter()
                .position(|own: &crate::volume::Volume| own.seed == seed && own.cell.is_none())
            {
                Some(index) => {
                    let split = self.world.split(index);
                    split.map_err(|error| at_event(event, error))?;
                }
                None if volume.is_none() => {}
                None => {
                    let number = volume.map_or(0, |index| index + 1);
                    return Err(PerformanceError::NoVolume {
                        place: event.table.to_string(),
                        table: event.table.clone(),
                        number,
                    });
                }
            }
        }
        Ok(())
    }

    /// Shares of the slots. If a recipe has no pigments, you get clear vehicle.
    fn recipe(&self, recipe: &script::Recipe) -> Result<Recipe, WorldError> {
        let shares = self.script.shares(recipe);
        let vehicle = if shares.iter().sum::<f64>() > 0.0 { 0.0 } else { 1.0 };
        let mut parts = [vehicle; 9];
        parts[..8].copy_from_slice(&shares);
        Recipe::of_parts(parts)
    }

    fn track(&self, place: &Place, index: usize) -> Result<Track, WorldError> {
        match place {
            Place::At(at) => Ok(Track::at(narrow(*at))),
            Place::Picked(_) => {
                // We found the place of this event when we made the performance.
                Ok(Track::at(self.picked[index].unwrap_or_default()))
            }
            Place::Path(points) => {
                Track::along(points.iter().map(|point| (point.seconds, narrow(point.at))).collect())
            }
        }
    }
}

fn at_event(event: &Event, error: WorldError) -> PerformanceError {
    PerformanceError::Event { place: event.table.to_string(), table: event.table.clone(), error }
}

/// The error of a world that cannot be made. It names the setting of the file that is at fault.
fn of_settings(error: WorldError, settings: &Settings, scene: &Mesh) -> PerformanceError {
    let [low, high] = scene.bounds();
    let longest = f64::from((high - low).max_element());
    let fault = match error {
        WorldError::Wetting(WettingError::TooManyCells { fits, .. }) => {
            let cell = settings.grid.cell.into();
            script::cells_too_small(cell, f64::from(fits) / longest)
        }
        WorldError::Motion(MotionError::TooFine { fitting_cell, .. }) => {
            let cell = settings.grid.cell.into();
            script::cells_too_small(cell, f64::from(fitting_cell) / longest)
        }
        WorldError::Wetting(WettingError::TooManySamples { found, fits }) => {
            script::samples_too_many(found, fits)
        }
        error => return PerformanceError::World(error),
    };
    PerformanceError::Setting { place: String::new(), fault }
}

fn narrow(place: [f64; 3]) -> Vec3 {
    Vec3::from(place.map(|along| along as f32))
}

/// The place that an event picks in the first picture. `None` if it does not pick one.
fn picked(event: &Event, scene: &Mesh, view: &FirstView) -> Result<Option<Vec3>, PerformanceError> {
    let place = match &event.action {
        Action::Pour(pour) => &pour.place,
        Action::Lift(lift) => &lift.place,
        _ => return Ok(None),
    };
    let Place::Picked(share) = place else { return Ok(None) };
    view.place(scene, *share).map(Some).ok_or_else(|| PerformanceError::Bare {
        place: event.table.to_string(),
        table: event.table.clone(),
        x: share[0],
        y: share[1],
    })
}

/// The region of a table. It has one of three keys.
fn region(keep: &KeepTable) -> KeepIn {
    match (&keep.cuboid, &keep.sphere, &keep.above) {
        (Some(cuboid), _, _) => KeepIn::Box { low: narrow(cuboid.0[0]), high: narrow(cuboid.0[1]) },
        (_, Some(sphere), _) => {
            KeepIn::Ball { center: narrow(sphere.center), radius: sphere.radius as f32 }
        }
        (_, _, above) => {
            let [point, normal] = above.map_or([[0.0; 3], [0.0, 1.0, 0.0]], |pair| pair.0);
            KeepIn::Above { point: narrow(point), normal: narrow(normal).normalize_or_zero() }
        }
    }
}

/// The first picture of a scene. A script picks places in this.
#[derive(Debug, Clone)]
pub struct FirstView {
    seen: VisibilityBuffer,
}

impl FirstView {
    /// Draws the view of `scene` by `camera` in a picture of this size.
    ///
    /// # Panics
    /// If a triangle has a corner that the mesh does not have.
    #[must_use]
    pub fn new(scene: &Mesh, camera: &Camera, (width, height): (usize, usize)) -> Self {
        Self { seen: visible(scene, camera, width, height) }
    }

    /// The place on `scene` at a share of the picture's width, from the left, and of its height,
    /// from the top. `None` where the picture shows no surface.
    #[must_use]
    pub fn place(&self, scene: &Mesh, share: [f64; 2]) -> Option<Vec3> {
        place_seen(scene, &self.seen, share)
    }
}

/// The place on `scene` that `seen`, a picture of it, shows at a share of its width and height.
/// `None` outside, and where you see no surface.
#[must_use]
pub fn place_seen(scene: &Mesh, seen: &VisibilityBuffer, share: [f64; 2]) -> Option<Vec3> {
    let width = seen.width();
    let height = seen.height();
    if !share.iter().all(|share| (0.0..=1.0).contains(share)) || width * height == 0 {
        return None;
    }
    fn at(share: f64, count: usize) -> usize {
        ((share * count as f64) as usize).min(count - 1)
    }
    let fragment = seen[(at(share[0], width), at(share[1], height))];
    (fragment.triangle != NO_TRIANGLE).then(|| position_at(scene, fragment))
}

const PERFORMANCE: Kind =
    Kind { format: b"impasto-played\0\0", version: 1, name: "moment of a script" };

impl Performance {
    /// The present moment as the bytes of a file: the world, and which events are over. As `wish`,
    /// pass words for what it belongs to, for example a digest of scene and settings. You need the
    /// same words for [`Performance::resumed`].
    #[must_use]
    pub fn saved(&self, wish: &str) -> Vec<u8> {
        let mut state = Vec::new();
        (self.next as u64).store(&mut state);
        self.singles.store(&mut state);
        self.world.store_state(&mut state);
        file_of_state(PERFORMANCE, &self.identity(wish), &state)
    }

    /// Resumes the moment that [`Performance::saved`] gave as `file`. This performance must play
    /// the same script on the same scene. It continues to the same bytes.
    ///
    /// # Errors
    /// [`SavedError`] if the file holds no such moment or one of another version, is damaged, or
    /// was saved over another scene, with other settings or events, or with another `wish`.
    pub fn resumed(&self, file: &[u8], wish: &str) -> Result<Self, SavedError> {
        let state = state_of_file(PERFORMANCE, &self.identity(wish), file)?;
        let mut reader = Reader::new(state);
        let moment = self.with_state(&mut reader).filter(|_| reader.is_empty());
        moment.ok_or(SavedError::Damaged)
    }

    fn with_state(&self, from: &mut Reader<'_>) -> Option<Self> {
        let next = usize::try_from(u64::read(from)?).ok()?;
        let singles = Vec::<Option<u64>>::read(from)?;
        if next > self.events.len() || singles.len() != self.singles.len() {
            return None;
        }
        let world = self.world.with_state(from)?;
        Some(Self { world, next, singles, ..self.clone() })
    }

    /// The digest of all that decides how the performance continues, except its state.
    fn identity(&self, wish: &str) -> [u8; 32] {
        let done = format!("{:?} {:?} {:?}", self.script, self.events, self.picked);
        identity([wish, &self.world.fingerprint(), &done])
    }
}

#[cfg(test)]
mod tests;
