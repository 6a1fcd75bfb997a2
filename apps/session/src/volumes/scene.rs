//! A scene at work: what was opened, its recording, the present moment, and its painters.

use std::path::PathBuf;
use std::sync::Arc;
use web_time::Instant;

use graphics::camera::Camera;
use graphics::field::Field;
use graphics::mesh::Mesh;
use volumes::performance::FirstView;
use volumes::script::{Event, Script, ScriptError};
use volumes::settings::{self, Settings};
use volumes::toml_text::KeyPath;

use super::gesture::{Hand, Timed};
use super::header::{first_camera, first_size, framed, resolve_picks, script_steps, tally};
use super::look::{Inside, Look};
use super::materials::Materials;
use super::opened::OpenedScene;
use super::painters::Painters;
use super::recorded::Recorded;
use super::state::{SceneState, SceneTime};
use super::subject::Subject;
use super::timeline::Timeline;
use crate::failure::FileFailure;

/// A scene at work.
#[derive(Debug)]
pub(super) struct Scene {
    pub(super) mesh: Arc<Mesh>,
    flat: bool,
    /// The camera that frames the subject.
    framed: Camera,
    pub(super) folder: PathBuf,
    pub(super) file: Option<PathBuf>,
    pub(super) settings: Settings,
    /// The choice of each region of the script when it was opened; `None` leaves it to the settings.
    insides: Vec<Option<settings::Inside>>,
    /// Whether they differed.
    by_region: bool,
    view: FirstView,
    pub(super) recorded: Recorded,
    pub(super) timeline: Timeline,
    pub(super) hand: Option<Hand>,
    pub(super) painters: Painters,
    pub(super) materials: Materials,
    pub(super) look: Look,
    /// The last picture, in encoded sRGB.
    pub(super) shown: Option<Field<[f32; 4]>>,
}

impl Scene {
    /// Opens a scene at its start.
    ///
    /// # Errors
    /// [`FileFailure`] that names the file, the place in a script, and the way out.
    pub(super) fn open(subject: &Subject) -> Result<Self, FileFailure> {
        let OpenedScene { mut script, source, materials, mesh, flat, folder, file } =
            OpenedScene::read(subject)?;
        let mesh = Arc::new(mesh);
        let settings = script.settings().map_err(|fault| {
            FileFailure::explained(&ScriptError::located(&source.0, &source.1, fault))
        })?;
        let first = first_camera(&script, &mesh, flat);
        let view = FirstView::new(&mesh, &first, first_size(&mesh, flat));
        resolve_picks(&mut script, &mesh, &view);
        let recorded = Recorded::of(&script);
        let played = recorded.script(recorded.end_step());
        let mut timeline = Timeline::new(&played, &mesh, &settings, &view)?;
        timeline.reach(script_steps(&script).max(recorded.end_step().into()));
        let painters = Painters::new(&mesh, &script, &settings, materials.painted(&script));
        let look = Look::of(&script, &settings);
        let insides = script.regions.iter().map(|region| region.inside).collect();
        let by_region = look.inside == Inside::ByRegion;
        let hand = None;
        let shown = None;
        Ok(Self {
            framed: framed(&mesh, flat),
            mesh,
            flat,
            folder,
            file,
            settings,
            insides,
            by_region,
            view,
            recorded,
            timeline,
            hand,
            painters,
            materials,
            look,
            shown,
        })
    }

    /// Changes what is shown.
    pub(super) fn set_look(&mut self, look: Look) {
        let before = self.look;
        let settings = &self.settings;
        let insides = &self.insides;
        let look = look.rounded();
        self.look = look;
        // The picture that is shown is no part of the script.
        if (Look { show: before.show, ..look }) != before {
            self.recorded.change_base(|script| look.write_to(script, settings, insides));
        }
    }

    /// The moment shown, in steps.
    pub(super) fn moment(&self) -> u64 {
        self.timeline.moment()
    }

    /// The last moment that was reached or that an event needs.
    pub(super) fn end(&self) -> u64 {
        self.timeline.reached().max(self.recorded.end_step().into())
    }

    /// Whether the moment that is sought has not been reached.
    pub(super) fn is_behind(&self) -> bool {
        self.timeline.is_behind()
    }

    /// Plays towards the moment that is sought until `until`.
    ///
    /// # Errors
    /// [`FileFailure`] for an event that cannot be done.
    pub(super) fn catch_up(&mut self, until: Instant) -> Result<(), FileFailure> {
        self.timeline.catch_up(until)
    }

    /// Takes one step, with what the hand does in it.
    ///
    /// # Errors
    /// [`FileFailure`] for an event that cannot be done; one of the hand is taken back.
    pub(super) fn step(&mut self) -> Result<(), FileFailure> {
        let step = u32::try_from(self.timeline.moment()).unwrap_or(u32::MAX);
        if let Some(timed) = self.hand.as_mut().and_then(|hand| hand.next_action(step)) {
            self.add(timed);
        }
        let stepped = self.timeline.step();
        if stepped.is_err() && self.hand.take().is_some() {
            self.undo()?;
        }
        stepped
    }

    /// Adds an action of the hand to the recording and to what is played.
    pub(super) fn add(&mut self, timed: Timed) {
        let Timed { start, end, action } = timed.clone();
        self.recorded.add(timed);
        self.timeline.add(Event { start, end, action, table: KeyPath::of("hand") });
    }

    /// Goes to a moment, at most the last one.
    ///
    /// # Errors
    /// [`FileFailure`] if the script cannot be played.
    pub(super) fn go_to(&mut self, step: u64) -> Result<(), FileFailure> {
        self.pen_up()?;
        let script = self.script();
        let goal = step.min(self.end());
        self.timeline.seek(goal, (&script, &self.mesh, &self.view))
    }

    /// Plays the recording again from step `from` on, after an event that began there was removed.
    ///
    /// # Errors
    /// [`FileFailure`] if it cannot be played.
    pub(super) fn replay_from(&mut self, from: u32) -> Result<(), FileFailure> {
        let script = self.script();
        self.timeline.replay(from.into(), (&script, &self.mesh, &self.view))
    }

    /// The script of all events so far.
    pub(super) fn script(&self) -> Script {
        self.recorded.script(u32::try_from(self.end()).unwrap_or(u32::MAX))
    }

    /// The camera that the script names, if it does.
    pub(super) fn seen_from(&self) -> Option<Camera> {
        let base = self.recorded.base();
        base.camera.as_ref().map(|_| first_camera(base, &self.mesh, self.flat))
    }

    /// State besides the picture.
    pub(super) fn state(&self, time: SceneTime) -> SceneState {
        let world = self.timeline.now().world();
        let base = self.recorded.base();
        SceneState {
            title: base.title.clone(),
            bounds: self.mesh.bounds(),
            triangles: self.mesh.triangles.len(),
            unit_mm: world.unit_mm(),
            flat: self.flat,
            framed: self.framed,
            seen_from: self.seen_from(),
            library: Arc::clone(&self.materials.library),
            light: Arc::clone(&self.materials.light),
            illuminant: self.materials.illuminant.clone(),
            tubes: Arc::clone(&self.materials.tubes),
            prepares: self.painters.is_making(),
            look: self.look,
            by_region: self.by_region,
            time,
            events: Arc::new(self.recorded.events()),
            tally: tally(&world.tally(), world.quantum_mm3(), world.volumes().len()),
            revision: self.recorded.revision(),
        }
    }
}

#[cfg(test)]
impl Scene {
    /// The surfaces of the subject.
    pub(super) fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The volumes at the present moment.
    pub(super) fn volumes(&self) -> &[volumes::volume::Volume] {
        self.timeline.now().world().volumes()
    }

    /// All paint on the surfaces, in quanta.
    pub(super) fn on_scene(&self) -> u64 {
        self.timeline.now().world().tally().on_scene.iter().sum()
    }

    /// All events by time.
    pub(super) fn events(&self) -> Vec<super::state::SceneEvent> {
        self.recorded.events()
    }

    /// The camera of the first picture.
    pub(super) fn usual_camera(&self) -> Camera {
        first_camera(self.recorded.base(), &self.mesh, self.flat)
    }
}
