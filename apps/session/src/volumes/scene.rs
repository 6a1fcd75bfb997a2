//! An open scene: what it was opened from, its recording, the present moment, its painters, and
//! changes of its pigments and of the light on them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use documents::file::disk;
use documents::hint::Hint;
use graphics::camera::Camera;
use graphics::field::Field;
use graphics::mesh::Mesh;
use graphics::picture::Photograph;
use pigment::library::PigmentLibrary;
use volumes::performance::FirstView;
use volumes::script::{self, Event, Script, ScriptError};
use volumes::settings::{self, Settings};
use volumes::toml_text::KeyPath;
use web_time::Instant;

use super::command::{SHAPE, Subject};
use super::event::{SceneState, SceneTime};
use super::gesture::{Hand, Timed};
use super::header::{first_camera, first_size, framed, resolve_picks, script_steps, tally};
use super::look::{Inside, Look};
use super::materials::{Materials, fill_tubes, light_for_script};
use super::painters::Painters;
use super::recorded::Recorded;
use super::timeline::Timeline;
use crate::failure::FileFailure;

#[derive(Debug)]
pub(super) struct Scene {
    pub(super) mesh: Arc<Mesh>,
    flat: bool,
    framed: Camera,
    pub(super) folder: PathBuf,
    pub(super) file: Option<PathBuf>,
    pub(super) settings: Settings,
    /// The picture inside the volumes of each region, as the opened script sets it. `None` leaves
    /// it to the settings.
    insides: Vec<Option<settings::Inside>>,
    by_region: bool,
    view: FirstView,
    pub(super) recorded: Recorded,
    pub(super) timeline: Timeline,
    pub(super) hand: Option<Hand>,
    pub(super) painters: Painters,
    pub(super) materials: Materials,
    pub(super) look: Look,
    pub(super) shown: Option<Field<[f32; 4]>>,
}

impl Scene {
    /// Opens a scene at its start. The error names the file and the place in a script, and says
    /// what you can do.
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

    pub(super) fn set_look(&mut self, look: Look) {
        let before = self.look;
        let settings = &self.settings;
        let insides = &self.insides;
        let look = look.rounded();
        self.look = look;
        // The choice of the picture is not part of the script.
        if (Look { show: before.show, ..look }) != before {
            self.recorded.change_base(|script| look.write_to(script, settings, insides));
        }
    }

    /// The moment shown, in steps.
    pub(super) fn moment(&self) -> u64 {
        self.timeline.moment()
    }

    /// The last moment that was reached, or that an event needs.
    pub(super) fn end(&self) -> u64 {
        self.timeline.reached().max(self.recorded.end_step().into())
    }

    /// Whether it still plays towards the moment that the user went to.
    pub(super) fn is_behind(&self) -> bool {
        self.timeline.is_behind()
    }

    /// Plays towards the moment that the user went to, until `until`.
    pub(super) fn catch_up(&mut self, until: Instant) -> Result<(), FileFailure> {
        self.timeline.catch_up(until)
    }

    /// Takes one step, with the next action of the open gesture. If it fails, this removes the
    /// gesture.
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

    /// Adds an action of a gesture to the recording, and plays it.
    pub(super) fn add(&mut self, timed: Timed) {
        let Timed { start, end, action } = timed.clone();
        self.recorded.add(timed);
        self.timeline.add(Event { start, end, action, table: KeyPath::of("hand") });
    }

    /// Goes to a moment, but not beyond the last one.
    pub(super) fn go_to(&mut self, step: u64) -> Result<(), FileFailure> {
        self.pen_up()?;
        let script = self.script();
        let goal = step.min(self.end());
        self.timeline.seek(goal, (&script, &self.mesh, &self.view))
    }

    /// Plays the recording again from step `from`, after an event that began there was removed.
    pub(super) fn replay_from(&mut self, from: u32) -> Result<(), FileFailure> {
        let script = self.script();
        self.timeline.replay(from.into(), (&script, &self.mesh, &self.view))
    }

    /// The script of all events so far.
    pub(super) fn script(&self) -> Script {
        self.recorded.script(u32::try_from(self.end()).unwrap_or(u32::MAX))
    }

    /// The camera of the script, if it names one.
    pub(super) fn seen_from(&self) -> Option<Camera> {
        let base = self.recorded.base();
        base.camera.as_ref().map(|_| first_camera(base, &self.mesh, self.flat))
    }

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
    pub(super) fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    pub(super) fn volumes(&self) -> &[volumes::volume::Volume] {
        self.timeline.now().world().volumes()
    }

    /// All paint on the surfaces, in quanta.
    pub(super) fn on_scene(&self) -> u64 {
        self.timeline.now().world().tally().on_scene.iter().sum()
    }

    pub(super) fn events(&self) -> Vec<super::event::SceneEvent> {
        self.recorded.events()
    }

    pub(super) fn usual_camera(&self) -> Camera {
        first_camera(self.recorded.base(), &self.mesh, self.flat)
    }
}

/// Triangles of a model that comes with the program, as on the command line.
const TRIANGLES: usize = 60_000;

#[derive(Debug)]
pub(super) struct OpenedScene {
    /// The script. It has no events if only a subject was opened.
    pub(super) script: Script,
    /// Name and text of the script, for messages.
    pub(super) source: (String, String),
    pub(super) materials: Materials,
    pub(super) mesh: Mesh,
    pub(super) flat: bool,
    pub(super) folder: PathBuf,
    /// File of the subject. It is `None` for a model that comes with the program.
    pub(super) file: Option<PathBuf>,
}

impl OpenedScene {
    /// Reads `subject` and everything that it names. The error names the file and the place in a
    /// script.
    pub(super) fn read(subject: &Subject) -> Result<Self, FileFailure> {
        match subject {
            Subject::Shape(name) => Self::of_script(
                new_script(&format!("{SHAPE}{name}"), name)?,
                (format!("{SHAPE}{name}"), String::new()),
                Path::new(""),
            ),
            Subject::File(path) => {
                let path = absolute(path);
                let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
                let title = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
                let folder = path.parent().unwrap_or(Path::new(""));
                let source = (path.display().to_string(), String::new());
                Self::of_script(new_script(name, title)?, source, folder)
            }
            Subject::Script(path) => {
                let path = absolute(path);
                let script = Script::open(&path).map_err(|error| FileFailure::explained(&error))?;
                let text = disk::read_to_string(&path).unwrap_or_default();
                let folder = path.parent().unwrap_or(Path::new(""));
                Self::of_script(script, (path.display().to_string(), text), folder)
            }
            Subject::Text { text, folder } => {
                let name = "the recovered scene";
                let script = Script::from_own_text(name, text);
                let script = script.map_err(|error| FileFailure::explained(&error))?;
                Self::of_script(script, (name.to_owned(), text.clone()), folder)
            }
        }
    }

    fn of_script(
        script: Script,
        source: (String, String),
        folder: &Path,
    ) -> Result<Self, FileFailure> {
        let subject = script.subject_in(folder).map_err(|fault| {
            FileFailure::explained(&ScriptError::located(&source.0, &source.1, fault))
        })?;
        let (mesh, flat, file) = match subject {
            script::Subject::Shape(shape) => (shape.mesh(TRIANGLES), false, None),
            script::Subject::File(path) if is_mesh(&path) => {
                let mesh = Mesh::open(&path).map_err(|error| FileFailure::explained(&error))?;
                (mesh, false, Some(path))
            }
            script::Subject::File(path) => (photograph(&path)?, true, Some(path)),
        };
        let materials = Materials::of(&script, (&source.0, &source.1), folder)?;
        let mut script = script;
        if flat {
            script.light_of_its_own();
        }
        // Round it first, so that the screen shows what is saved.
        let script = script.rounded();
        Ok(Self { script, source, materials, mesh, flat, folder: folder.to_owned(), file })
    }
}

/// The script of a new scene.
fn new_script(subject: &str, title: &str) -> Result<Script, FileFailure> {
    let mut script = Script::new(subject, 0.0);
    script.title = title.to_owned();
    let library = PigmentLibrary::van_gogh_oils();
    fill_tubes(&mut script, &library)?;
    script.library = Some(library.title);
    Ok(script)
}

/// Whether a file name has the extension of a model.
fn is_mesh(path: &Path) -> bool {
    let endings = ["glb", "gltf", "obj", "ply"];
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| endings.contains(&ending.to_ascii_lowercase().as_str()))
}

/// A photograph as a flat model, [`Photograph::usual_width_px`] pixels wide.
fn photograph(path: &Path) -> Result<Mesh, FileFailure> {
    let photograph = Photograph::open(path).map_err(|error| FileFailure::explained(&error))?;
    let (width, height) = photograph.size();
    let columns = photograph.usual_width_px();
    let rows = (columns as f64 * height as f64 / width as f64).round() as usize;
    Ok(Mesh::of_picture(&photograph.with_opacity(columns, rows.max(1))))
}

fn absolute(path: &Path) -> PathBuf {
    disk::absolute(path).unwrap_or_else(|_| path.to_owned())
}

impl Scene {
    /// Lights the pigments with another light. Fails if a script cannot name it.
    pub(super) fn set_illuminant(&mut self, illuminant: &str) -> Result<(), FileFailure> {
        let mut script = self.recorded.base().clone();
        script.illuminant = light_for_script(illuminant)?;
        let materials = self.materials.again(&script)?;
        self.take_up(script, materials);
        Ok(())
    }

    /// Fills the tubes from the painter's own library. Paint that was poured from a tube gets its
    /// new pigment. Fails for a file that is not a library, or has too few pigments.
    pub(super) fn set_library(&mut self, path: &Path) -> Result<(), FileFailure> {
        let library = PigmentLibrary::open(path);
        let library = library.map_err(|error| FileFailure::explained(&error))?;
        let mut script = self.recorded.base().clone();
        let is_bare = script.palette.is_empty();
        if is_bare && !self.recorded.events().is_empty() {
            let what = "paint was poured in this scene that has no pigments".to_owned();
            let hint = Some(Hint::new("begin a new scene for the library"));
            return Err(FileFailure { what, hint });
        }
        fill_tubes(&mut script, &library)?;
        let path = disk::absolute(path).unwrap_or_else(|_| path.to_owned());
        // A file below the folder of the subject is named relative to it.
        let named = path.strip_prefix(&self.folder).unwrap_or(&path);
        script.library = Some(named.to_string_lossy().into_owned());
        let materials = self.materials.with_library(&script, Arc::new(library), Some(path))?;
        self.take_up(script, materials);
        // The letters stay, so the paint keeps its slots.
        if is_bare { self.replay_from(0) } else { Ok(()) }
    }

    /// Puts another pigment of the library into a tube, by its number from 0. Paint that was poured
    /// from it gets the new pigment. Fails if the library lacks the pigment, or another tube has
    /// it.
    pub(super) fn set_tube(&mut self, number: usize, pigment: &str) -> Result<(), FileFailure> {
        let mut script = self.recorded.base().clone();
        if let Some(name) = script.palette.values_mut().nth(number) {
            pigment.clone_into(name);
        }
        let materials = self.materials.again(&script)?;
        self.take_up(script, materials);
        Ok(())
    }

    /// Continues with another palette or light.
    fn take_up(&mut self, script: Script, materials: Materials) {
        self.painters.set_pigments(materials.painted(&script));
        self.materials = materials;
        self.recorded.change_base(|base| *base = script);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_scene_has_the_tubes_of_the_easel() {
        let opened = OpenedScene::read(&Subject::Shape("sphere".to_owned())).unwrap();
        assert_eq!((opened.script.title.as_str(), opened.script.palette.len()), ("sphere", 8));
        assert!(opened.mesh.triangles.len() > 50_000 && opened.file.is_none());
    }

    #[test]
    fn what_cannot_be_opened_is_named_with_a_way_out() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path
        };
        let future = "format = \"paint-volumes\"\nversion = 9\nsubject = \"shape:village\"\n";
        let wrong = "format = \"paint-volumes\"\nversion = 1\nsubject = \"shape:vilage\"\n\
                     seconds = 1.0\n";
        for (subject, wanted) in [
            (Subject::Shape("vilage".to_owned()), "vilage"),
            (Subject::File(file("a.ply", "no ply")), "a.ply"),
            (Subject::File(file("b.png", "no picture")), "b.png"),
            (Subject::File(folder.path().join("missing.glb")), "missing.glb"),
            (Subject::Script(file("c.toml", "seconds = ")), "c.toml"),
            (Subject::Script(file("d.toml", future)), "line 2"),
            (Subject::Script(file("e.toml", wrong)), "line 3"),
        ] {
            let failure = OpenedScene::read(&subject).unwrap_err();
            assert!(failure.what.contains(wanted), "{subject:?}: {failure:?}");
            assert!(failure.hint.is_some(), "{subject:?}: {failure:?}");
        }
    }
}
