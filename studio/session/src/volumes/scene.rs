//! A scene at work: what was opened, its recording, the present moment, and its painters.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use pigment::library::PigmentLibrary;
use render::camera::Camera;
use render::encoding::linear_from_encoded;
use render::export::frame_of;
use render::field::Field;
use render::mesh::Mesh;
use render::paint::document::Document;
use render::volumes::performance::FirstView;
use render::volumes::pigments::FilmProfile;
use render::volumes::script::{Event, Recipe, Script, ScriptError};
use render::volumes::settings::Settings;
use render::volumes::toml_text::KeyPath;

use super::event::{Here, SceneRecording};
use super::gesture::{Hand, Timed};
use super::header::{
    FIRST_PICTURE, camera_table, first_camera, framed, resolve_picks, script_steps, tally, tubes,
};
use super::inspect::{color_at, found_at, told};
use super::look::Look;
use super::opened::OpenedScene;
use super::painters::{Painters, Quality, Sight};
use super::ray::{Hit, surface_at};
use super::recorded::Recorded;
use super::state::{SceneState, SceneTime, SceneTube};
use super::subject::Subject;
use super::timeline::Timeline;
use super::tool::{Grip, ScenePen, SceneTool};
use crate::failure::FileFailure;

/// A scene at work.
#[derive(Debug)]
pub(super) struct Scene {
    mesh: Mesh,
    flat: bool,
    /// The camera that frames the subject.
    framed: Camera,
    folder: PathBuf,
    file: Option<PathBuf>,
    settings: Settings,
    view: FirstView,
    recorded: Recorded,
    timeline: Timeline,
    hand: Option<Hand>,
    painters: Painters,
    tubes: Arc<Vec<SceneTube>>,
    look: Look,
    /// The last picture, in encoded sRGB.
    shown: Option<Field<[f32; 4]>>,
}

impl Scene {
    /// Opens a scene at its start.
    ///
    /// # Errors
    /// [`FileFailure`] that names the file, the place in a script, and the way out.
    pub(super) fn open(subject: &Subject) -> Result<Self, FileFailure> {
        let OpenedScene { mut script, source, mesh, flat, folder, file } =
            OpenedScene::read(subject)?;
        let located =
            |fault| FileFailure::explained(&ScriptError::located(&source.0, &source.1, fault));
        let settings = script.settings().map_err(located)?;
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let slots = script.slots(&library).map_err(located)?;
        let first = first_camera(&script, &mesh);
        let view = FirstView::new(&mesh, &first, FIRST_PICTURE);
        resolve_picks(&mut script, &mesh, &view);
        let recorded = Recorded::of(&script);
        let played = recorded.script(recorded.end_step());
        let mut timeline = Timeline::new(&played, &mesh, &settings, &view)?;
        timeline.reach(script_steps(&script).max(recorded.end_step().into()));
        let tubes = Arc::new(tubes(&script, &library, &slots)?);
        let painters = Painters::new(&script, &settings, (&library, slots));
        let look = Look::of(&script, &settings);
        let (hand, shown) = (None, None);
        Ok(Self {
            framed: framed(&mesh, flat),
            mesh,
            flat,
            folder,
            file,
            settings,
            view,
            recorded,
            timeline,
            hand,
            painters,
            tubes,
            look,
            shown,
        })
    }

    /// Changes what is shown.
    pub(super) fn set_look(&mut self, look: Look) {
        let (before, settings) = (self.look, &self.settings);
        self.look = look;
        // The picture that is shown is no part of the script.
        if (Look { show: before.show, ..look }) != before {
            self.recorded.change_base(|script| look.write_to(script, settings));
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
    fn add(&mut self, timed: Timed) {
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

    /// Sets the pen down with a tool. Returns whether there is a surface below it.
    ///
    /// # Errors
    /// [`FileFailure`] if the moment that is sought cannot be reached.
    pub(super) fn pen_down(
        &mut self,
        sight: &Sight,
        grip: Grip,
        pen: ScenePen,
    ) -> Result<bool, FileFailure> {
        self.pen_up()?;
        while self.is_behind() {
            self.timeline.step()?;
        }
        let Some(hit) = self.hit(sight, pen.at) else { return Ok(false) };
        let letter = self.recorded.base().palette.keys().nth(grip.tube);
        let recipe = letter.map(|letter| (letter.clone(), 1.0)).into_iter().collect::<Recipe>();
        let step = u32::try_from(self.timeline.moment()).unwrap_or(u32::MAX);
        let at = (hit.place.as_dvec3(), f64::from(pen.pressure));
        let unit_mm = self.timeline.now().world().unit_mm();
        let mut hand = Hand::down(grip, recipe, unit_mm, at, step);
        hand.rest();
        self.hand = Some(hand);
        self.recorded.begin();
        Ok(true)
    }

    /// Moves the pen that is down. Off the surface it stays where it was.
    pub(super) fn pen_move(&mut self, sight: &Sight, pen: ScenePen) {
        let hit = self.hit(sight, pen.at);
        if let (Some(hand), Some(hit)) = (&mut self.hand, hit) {
            hand.move_to(hit.place.as_dvec3(), f64::from(pen.pressure));
        }
    }

    /// Lifts the pen. A gesture that was shorter than a step still acts once.
    ///
    /// # Errors
    /// [`FileFailure`] for a gesture that cannot be done.
    pub(super) fn pen_up(&mut self) -> Result<(), FileFailure> {
        if self.hand.is_some() && self.recorded.last_is_empty() {
            self.step()?;
        }
        if self.hand.take().is_some() {
            self.recorded.end();
        }
        Ok(())
    }

    /// Whether the pen is down with a tool that works as long as it is.
    pub(super) fn is_at_work(&self) -> bool {
        self.hand.as_ref().is_some_and(|hand| hand.tool() != SceneTool::Dry)
    }

    fn hit(&self, sight: &Sight, at: [f32; 2]) -> Option<Hit> {
        let [width, height] = sight.size;
        surface_at(&self.mesh, &sight.camera, width as f32 / height as f32, at)
    }

    /// Takes back the event that was added last.
    ///
    /// # Errors
    /// [`FileFailure`] if the rest cannot be played.
    pub(super) fn undo(&mut self) -> Result<(), FileFailure> {
        self.pen_up()?;
        let from = self.recorded.undo();
        self.replay_without(from)
    }

    /// Takes back an event by its number in the list.
    ///
    /// # Errors
    /// [`FileFailure`] if the rest cannot be played.
    pub(super) fn remove(&mut self, number: usize) -> Result<(), FileFailure> {
        self.pen_up()?;
        let from = self.recorded.remove(number);
        self.replay_without(from)
    }

    /// Plays the recording again from step `from` on, after an event that began there was removed.
    fn replay_without(&mut self, from: Option<u32>) -> Result<(), FileFailure> {
        let Some(from) = from else { return Ok(()) };
        let script = self.script();
        self.timeline.replay(from.into(), (&script, &self.mesh, &self.view))
    }

    /// The script of all events so far.
    fn script(&self) -> Script {
        self.recorded.script(u32::try_from(self.end()).unwrap_or(u32::MAX))
    }

    /// The picture with all samples, in linear sRGB.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn picture(&mut self, sight: &Sight) -> Result<Field<[f32; 4]>, FileFailure> {
        let scene = (&self.mesh, self.timeline.now().world());
        let picture = self.painters.picture(scene, sight, &self.look, Quality::BEST)?;
        Ok(linear_from_encoded(&picture))
    }

    /// The painting that the scene makes.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn painting(&mut self, sight: &Sight) -> Result<Document, FileFailure> {
        let scene = (&self.mesh, self.timeline.now().world());
        let title = &self.recorded.base().title;
        self.painters.painting(scene, sight, &self.look, title)
    }

    /// The bytes of the picture.
    ///
    /// # Errors
    /// [`FileFailure`] for settings or pigments that cannot be used.
    pub(super) fn pixels(
        &mut self,
        sight: &Sight,
        quality: Quality,
    ) -> Result<Vec<[u8; 4]>, FileFailure> {
        let scene = (&self.mesh, self.timeline.now().world());
        let picture = self.painters.picture(scene, sight, &self.look, quality)?;
        let frame = frame_of(&picture);
        self.shown = Some(picture);
        Ok(frame.values().iter().map(|&[red, green, blue]| [red, green, blue, 255]).collect())
    }

    /// Surface, paint and colour at a place of the picture.
    pub(super) fn here(&self, sight: &Sight, at: [f32; 2]) -> Here {
        let srgb = self.shown.as_ref().map_or([0; 3], |shown| color_at(shown, at));
        let drawing = &self.settings.drawing;
        let profile = FilmProfile { rim: drawing.rim, edge: drawing.edge, gate: drawing.gate };
        let found = self.hit(sight, at).map(|hit| {
            let found = found_at(self.timeline.now().world(), &hit, profile);
            (hit.place, found)
        });
        told(found, srgb, &self.tubes, &self.recorded.base().regions)
    }

    /// The script as it would be saved, seen by `camera`.
    ///
    /// # Errors
    /// [`FileFailure`] if the script is longer than one can be.
    pub(super) fn recording(&self, camera: Option<Camera>) -> Result<SceneRecording, FileFailure> {
        let mut script = self.script();
        script.camera = camera.map(|camera| camera_table(&camera)).or(script.camera);
        let text = script.to_text().map_err(|error| FileFailure::explained(&error))?;
        let (folder, subject) = (self.folder.clone(), self.file.clone());
        Ok(SceneRecording { text: text.into(), folder, subject, revision: self.revision() })
    }

    /// Counter of changes of the recording.
    fn revision(&self) -> u64 {
        self.recorded.revision()
    }

    /// The camera that the script names, if it does.
    pub(super) fn seen_from(&self) -> Option<Camera> {
        let base = self.recorded.base();
        base.camera.as_ref().map(|_| first_camera(base, &self.mesh))
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
            tubes: Arc::clone(&self.tubes),
            look: self.look,
            time,
            events: Arc::new(self.recorded.events()),
            tally: tally(&world.tally(), world.quantum_mm3(), world.volumes().len()),
            revision: self.revision(),
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
    pub(super) fn volumes(&self) -> &[render::volumes::volume::Volume] {
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
        first_camera(self.recorded.base(), &self.mesh)
    }
}
