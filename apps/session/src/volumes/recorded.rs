//! The recording of a scene: its script, with the actions grouped by gesture. You can save it
//! together with its library, in the folder of its subject.

use std::path::{Path, PathBuf};

use documents::file::{disk, write_whole};
use documents::hint::Hint;
use glam::DVec3;
use volumes::script::{Action, Ball, Dry, Event, Recipe, Recorder, Script};

use super::command::SceneTool;
use super::event::{SceneEvent, SceneRecording};
use super::gesture::Timed;
use crate::failure::FileFailure;

/// Two drying actions belong to one gesture only if they begin at most this many steps apart.
const DRYING: u32 = 24;

/// The actions of one gesture, or actions of a script that belong together.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Gesture {
    actions: Vec<Timed>,
}

/// A script with its actions grouped by gesture, so that you can undo a whole gesture.
#[derive(Debug, Clone)]
pub(super) struct Recorded {
    base: Script,
    /// In the order in which they were added.
    gestures: Vec<Gesture>,
    revision: u64,
}

impl Recorded {
    /// Makes a recording of a script. Actions with the same kind and recipe that follow without a
    /// gap are one gesture.
    pub(super) fn of(script: &Script) -> Self {
        let mut base = script.rounded();
        let events = base.events();
        base.volumes.clear();
        base.pours.clear();
        base.pushes.clear();
        base.lifts.clear();
        base.splits.clear();
        base.dries.clear();
        let mut gestures: Vec<Gesture> = Vec::new();
        for Event { start, end, action, .. } in events {
            let timed = Timed { start, end, action };
            match gestures.iter_mut().find(|gesture| gesture.goes_on_with(&timed)) {
                Some(gesture) => gesture.actions.push(timed),
                None => gestures.push(Gesture { actions: vec![timed] }),
            }
        }
        Self { base, gestures, revision: 0 }
    }

    pub(super) fn base(&self) -> &Script {
        &self.base
    }

    pub(super) fn change_base(&mut self, change: impl FnOnce(&mut Script)) {
        change(&mut self.base);
        self.revision += 1;
    }

    /// Counts changes: if two numbers are equal, so are the recordings.
    pub(super) fn revision(&self) -> u64 {
        self.revision
    }

    /// Begins a gesture. The next actions belong to it.
    pub(super) fn begin(&mut self) {
        self.gestures.push(Gesture { actions: Vec::new() });
    }

    /// Adds an action to the last gesture.
    pub(super) fn add(&mut self, action: Timed) {
        if let Some(gesture) = self.gestures.last_mut() {
            gesture.actions.push(action);
            self.revision += 1;
        }
    }

    /// Whether the last gesture has done nothing yet.
    pub(super) fn last_is_empty(&self) -> bool {
        self.gestures.last().is_some_and(|gesture| gesture.actions.is_empty())
    }

    /// Removes the last gesture if it did nothing.
    pub(super) fn end(&mut self) {
        self.gestures.pop_if(|gesture| gesture.actions.is_empty());
    }

    /// Removes the gesture that was added last. Returns its first step.
    pub(super) fn undo(&mut self) -> Option<u32> {
        let gesture = self.gestures.pop()?;
        self.revision += 1;
        Some(gesture.start())
    }

    /// Removes the gesture with this number in the list of [`Recorded::events`]. Returns its first
    /// step.
    pub(super) fn remove(&mut self, number: usize) -> Option<u32> {
        let index = *self.by_time().get(number)?;
        self.revision += 1;
        Some(self.gestures.remove(index).start())
    }

    pub(super) fn end_step(&self) -> u32 {
        self.gestures.iter().map(Gesture::end).max().unwrap_or(0)
    }

    /// The script of all gestures. It lasts `steps` steps.
    pub(super) fn script(&self, steps: u32) -> Script {
        let mut recorder = Recorder::new(&self.base);
        for Timed { start, end, action } in self.gestures.iter().flat_map(|one| &one.actions) {
            recorder.record(*start, *end, action);
        }
        recorder.script(steps)
    }

    /// Indices of the gestures, sorted by the time at which they begin.
    fn by_time(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.gestures.len()).collect();
        order.sort_by_key(|&index| self.gestures[index].start());
        order
    }

    /// All gestures, sorted by the time at which they begin.
    pub(super) fn events(&self) -> Vec<SceneEvent> {
        let gestures = self.by_time().into_iter().map(|index| &self.gestures[index]);
        let filled = gestures.filter_map(|gesture| Some((gesture, gesture.actions.first()?)));
        filled
            .map(|(gesture, first): (&Gesture, &Timed)| {
                let (tool, label) = self.words(&first.action);
                let from = gesture.start().into();
                let to = gesture.end().into();
                SceneEvent { tool, label, from, to }
            })
            .collect()
    }

    fn words(&self, action: &Action) -> (Option<SceneTool>, String) {
        match action {
            Action::Pour(pour) => (Some(SceneTool::Pour), self.with_paint("pour", &pour.recipe)),
            Action::Volume(volume) => (None, self.with_paint("volume of", &volume.recipe)),
            Action::Push(_) => (Some(SceneTool::Push), "push".to_owned()),
            Action::Lift(_) => (Some(SceneTool::Lift), "lift".to_owned()),
            Action::Split(_) => (None, "split".to_owned()),
            Action::Dry(dry) => {
                let what = if dry.ball.is_some() { "dry" } else { "dry all paint" };
                (Some(SceneTool::Dry), what.to_owned())
            }
        }
    }

    /// `what`, followed by the pigments of a recipe, e.g. `pour Ultramarine`.
    fn with_paint(&self, what: &str, recipe: &Recipe) -> String {
        let names = recipe.keys().filter_map(|letter| self.base.palette.get(letter).cloned());
        let names: Vec<String> = names.collect();
        match names.is_empty() {
            true => format!("{what} colour"),
            false => format!("{what} {}", names.join(" and ")),
        }
    }
}

impl Gesture {
    fn start(&self) -> u32 {
        self.actions.first().map_or(0, |first| first.start)
    }

    fn end(&self) -> u32 {
        self.actions.iter().map(|action| action.end).max().unwrap_or(0)
    }

    /// Whether `next` follows without a gap, with the same tool and paint.
    fn goes_on_with(&self, next: &Timed) -> bool {
        let Some(last) = self.actions.last() else { return false };
        if let (Action::Dry(last_dry), Action::Dry(next_dry)) = (&last.action, &next.action) {
            return next.start - last.start <= DRYING && are_near(last_dry, next_dry);
        }
        let alike = match (&last.action, &next.action) {
            (Action::Pour(one), Action::Pour(other)) => one.recipe == other.recipe,
            (Action::Push(_), Action::Push(_)) | (Action::Lift(_), Action::Lift(_)) => true,
            _ => false,
        };
        alike && last.end == next.start
    }
}

/// Whether two drying actions are near enough that one drag may have made both.
fn are_near(one: &Dry, other: &Dry) -> bool {
    let (Some(one), Some(other)) = (one.ball, other.ball) else { return false };
    let Ball { center, radius } = one;
    let apart = DVec3::from(center).distance(DVec3::from(other.center));
    radius == other.radius && apart <= radius
}

impl SceneRecording {
    /// Writes the script to a file in the folder of its subject. Copies the painter's own library
    /// there too, unless it is there already.
    ///
    /// # Errors
    /// [`FileFailure`] if the file is in the folder of another subject, if it cannot be written, or
    /// if a different library has the same name there.
    pub fn save(&self, path: &Path) -> Result<(), FileFailure> {
        if let Some(subject) =
            self.subject.as_deref().filter(|own| folder_of(own) != folder_of(path))
        {
            let what = format!("{}: a script lies beside its subject", path.display());
            let folder = subject.parent().unwrap_or(Path::new(".")).display();
            let hint = Some(Hint::new(format!("save it in {folder}")));
            return Err(FileFailure { what, hint });
        }
        let text = match &self.library {
            None => self.text.to_string(),
            Some(library) => {
                let name = library.file_name().unwrap_or_default();
                copied(library, &path.with_file_name(name))?;
                let script = Script::from_own_text("the scene", &self.text);
                let mut script = script.map_err(|error| FileFailure::explained(&error))?;
                script.library = Some(name.to_string_lossy().into_owned());
                script.to_text().map_err(|error| FileFailure::explained(&error))?
            }
        };
        write_whole(path, text.as_bytes()).map_err(|error| FileFailure::explained(&error))
    }
}

fn folder_of(path: &Path) -> Option<PathBuf> {
    let path = disk::absolute(path).unwrap_or_else(|_| path.to_owned());
    path.parent().and_then(|folder| disk::canonicalize(folder).ok())
}

/// Copies a library to `to`, unless it is there.
fn copied(library: &Path, to: &Path) -> Result<(), FileFailure> {
    fn read(path: &Path) -> Result<Vec<u8>, FileFailure> {
        disk::read(path).map_err(|error| FileFailure::io(path, "read", &error))
    }
    let bytes = read(library)?;
    if disk::exists(to) {
        if read(to)? == bytes {
            return Ok(());
        }
        let what = format!("{}: another library has this name", to.display());
        let hint = Some(Hint::new("save the script in another folder"));
        return Err(FileFailure { what, hint });
    }
    write_whole(to, &bytes).map_err(|error| FileFailure::explained(&error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::volumes::command::Grip;
    use crate::volumes::gesture::Hand;

    /// A recording with a pour of 0.2 s from step 12 on, another pour at the same time, and a dry.
    fn recorded() -> Recorded {
        let mut script = Script::new("shape:village", 2.0);
        script.palette.insert("A".to_owned(), "Ultramarine".to_owned());
        script.palette.insert("B".to_owned(), "Vermilion".to_owned());
        let mut recorded = Recorded::of(&script);
        for (letter, place) in [("A", 0.1), ("B", 0.7)] {
            let recipe = Recipe::from([(letter.to_owned(), 1.0)]);
            let at = (DVec3::splat(place), 1.0);
            let mut hand = Hand::down(Grip::default(), recipe, 50.0, at, 12);
            recorded.begin();
            (12..36).filter_map(|step| hand.next_action(step)).for_each(|one| recorded.add(one));
            recorded.end();
        }
        recorded.begin();
        recorded.add(Timed { start: 6, end: 7, action: Action::Dry(Dry::default()) });
        recorded.begin();
        recorded.end();
        recorded
    }

    #[test]
    fn gestures_are_told_by_time_and_taken_back_as_they_were_added() {
        let mut recorded = recorded();
        fn summary(recorded: &Recorded) -> Vec<(String, u64, u64)> {
            let events = recorded.events().into_iter();
            events.map(|event| (event.label, event.from, event.to)).collect()
        }
        fn line(label: &str, from: u64, to: u64) -> (String, u64, u64) {
            (label.to_owned(), from, to)
        }
        let [dry, blue, red] = [
            line("dry all paint", 6, 7),
            line("pour Ultramarine", 12, 36),
            line("pour Vermilion", 12, 36),
        ];
        assert_eq!(summary(&recorded), [dry, blue.clone(), red.clone()]);
        assert_eq!(recorded.undo(), Some(6));
        assert_eq!(summary(&recorded), [blue, red.clone()]);
        let before = recorded.revision();
        assert_eq!(recorded.remove(0), Some(12));
        assert_eq!(summary(&recorded), [red]);
        assert!(recorded.revision() > before, "it changed");
        assert_eq!((recorded.remove(7), recorded.end_step()), (None, 36));
    }

    #[test]
    fn a_script_that_is_read_again_has_the_same_actions_and_gestures() {
        let recorded = recorded();
        let script = recorded.script(240);
        let read = Script::from_text("text", &script.to_text().unwrap()).unwrap();
        assert_eq!(read, script);
        assert_eq!(read.pours.len(), 8, "each pour has four portions");
        let again = Recorded::of(&read);
        assert_eq!(again.events(), recorded.events());
        assert_eq!(again.script(240).events(), read.events(), "in the same order");
    }

    #[test]
    fn a_drag_of_the_dryer_is_one_gesture_also_after_it_is_read() {
        let mut recorded = Recorded::of(&Script::new("shape:village", 2.0));
        fn dry(start: u32, x: f64) -> Timed {
            let ball = Some(Ball { center: [x, 0.0, 0.0], radius: 0.5 });
            Timed { start, end: start + 1, action: Action::Dry(Dry { ball }) }
        }
        for drag in [vec![dry(5, 0.0), dry(9, 0.2), dry(30, 0.4)], vec![dry(40, 3.0)]] {
            recorded.begin();
            drag.into_iter().for_each(|action| recorded.add(action));
        }
        recorded.begin();
        recorded.add(Timed { start: 41, end: 42, action: Action::Dry(Dry::default()) });
        let labels: Vec<String> = recorded.events().into_iter().map(|event| event.label).collect();
        assert_eq!(labels, ["dry", "dry", "dry all paint"]);
        let text = recorded.script(60).to_text().unwrap();
        let read = Recorded::of(&Script::from_text("text", &text).unwrap());
        assert_eq!(read.events(), recorded.events());
        assert_eq!(read.script(60), recorded.script(60));
    }
}
