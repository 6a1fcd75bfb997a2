//! A request that was checked, and painting it.

use documents::Task;
use graphics::compute::Compute;

use crate::error::PictureError;
use crate::exports::{Listener, Note};
use crate::painterly_job::PainterlyJob;
use crate::request::{PictureOutcome, PictureRequest, TechniqueRequest};
use crate::watercolor_job::WatercolorJob;

/// A picture that can be painted: the request was checked, and its outputs can be written.
#[derive(Debug)]
pub struct PictureJob {
    work: Work,
    /// Notes on the checks of the request.
    notes: Vec<Note>,
}

#[derive(Debug)]
enum Work {
    Watercolor(Box<WatercolorJob>),
    Painterly(Box<PainterlyJob>),
}

impl PictureRequest {
    /// Checks the request, paints it, and writes its files. Each file is written whole, none of them replaces a
    /// file that the request reads, and frames of an interrupted run are kept. Nothing is written before all
    /// of the request was checked. `task` may end the work.
    ///
    /// ```
    /// use documents::Task;
    /// use pictures::{Device, PictureRequest, TechniqueRequest, WatercolorRequest};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let technique = TechniqueRequest::Watercolor(WatercolorRequest::default());
    /// let mut request = PictureRequest::new("shape:sphere", technique);
    /// request.view.width = Some(32);
    /// request.exports.picture = Some(folder.path().join("sphere.png"));
    /// request.device = Device::Cpu;
    ///
    /// let outcome = request.run(&Task::default())?;
    /// assert_eq!((outcome.size, outcome.backend.as_str()), ((32, 24), "cpu"));
    /// assert_eq!(outcome.files, [folder.path().join("sphere.png")]);
    /// assert!(outcome.files[0].is_file());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`PictureError`] for a setting that cannot be used, a file that cannot be read or written, a subject that
    /// cannot be painted, and if `task` is cancelled.
    pub fn run(&self, task: &Task) -> Result<PictureOutcome, PictureError> {
        let job = self.open(task, &mut |_| {})?;
        job.paint(Compute::choose(self.device.into())?, task, &mut |_| {})
    }

    /// Does all work of [`Self::run`] before it opens a device. Use this if you want to open the device yourself,
    /// or to hear of each file when it is written.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn open(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<PictureJob, PictureError> {
        let mut notes = Vec::new();
        let mut kept = |note: Note| {
            notes.push(note.clone());
            listener(note);
        };
        let work = match &self.technique {
            TechniqueRequest::Watercolor(own) => {
                Work::Watercolor(Box::new(WatercolorJob::open(self, own, &mut kept)?))
            }
            TechniqueRequest::Painterly(own) => {
                Work::Painterly(Box::new(PainterlyJob::open(self, own, task, &mut kept)?))
            }
        };
        Ok(PictureJob { work, notes })
    }
}

impl PictureJob {
    /// Paints the picture on `compute` and writes its files.
    ///
    /// # Errors
    /// The errors of [`PictureRequest::run`].
    pub fn paint(
        self,
        compute: Compute,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<PictureOutcome, PictureError> {
        let Self { work, mut notes } = self;
        let mut kept = |note: Note| {
            notes.push(note.clone());
            listener(note);
        };
        let summary = match work {
            Work::Watercolor(job) => job.paint(compute, task, &mut kept)?,
            Work::Painterly(job) => job.paint(compute, task, &mut kept)?,
        };
        let mut outcome = PictureOutcome {
            size: summary.size,
            backend: summary.backend,
            technique: summary.technique,
            frames: summary.frames.map(|(frames, _)| frames),
            frames_found: summary.frames.map(|(_, found)| found),
            pigments: summary.pigments,
            remarks: Vec::new(),
            files: Vec::new(),
            streamed: None,
        };
        for note in notes {
            match note {
                Note::Remark(remark) => outcome.remarks.push(remark.to_string()),
                Note::Library { .. } => {}
                Note::Wrote(path) => outcome.files.push(path),
                Note::Streamed(content) => outcome.streamed = Some(content),
            }
        }
        Ok(outcome)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use documents::hint::Explain;

    use super::*;
    use crate::request::{Device, PainterlyRequest, TechniqueOutcome, WatercolorRequest};

    fn sphere(technique: TechniqueRequest, folder: &Path) -> PictureRequest {
        let mut request = PictureRequest::new("shape:sphere", technique);
        request.view.width = Some(24);
        request.exports.picture = Some(folder.join("a.png"));
        request.device = Device::Cpu;
        request
    }

    fn watercolor() -> TechniqueRequest {
        TechniqueRequest::Watercolor(WatercolorRequest::default())
    }

    fn refused(request: &PictureRequest) -> (String, String) {
        let error = request.run(&Task::default()).unwrap_err();
        (error.to_string(), error.hint().map(|hint| hint.to_string()).unwrap_or_default())
    }

    #[test]
    fn an_input_is_never_an_output_and_nothing_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let mut request = sphere(watercolor(), folder.path());
        let settings = folder.path().join("mine.png");
        std::fs::write(&settings, "[edges]\nstrength = 2").unwrap();
        request.style.settings = Some(settings.clone());
        request.stages = Some(folder.path().join("stages"));
        request.exports.picture = Some(settings.clone());
        let (message, _) = refused(&request);
        assert!(message.ends_with("mine.png: is an input file, which is never overwritten"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing was written");
        assert!(std::fs::read_to_string(&settings).unwrap().starts_with("[edges]"));
    }

    #[test]
    fn errors_name_keys_and_the_way_out() {
        let folder = tempfile::tempdir().unwrap();
        let request = sphere(watercolor(), folder.path());
        let mut wide = request.clone();
        wide.view.width = Some(1 << 40);
        assert_eq!(refused(&wide).0, "width takes 16 to 16384, found `1099511627776`");
        let mut layers = request.clone();
        layers.exports.layers = Some(folder.path().join("a.ora"));
        assert_eq!(refused(&layers).0, "layers needs pigments, but no library is given");
        let mut still = request.clone();
        still.animation.animation = Some(folder.path().join("a.gif"));
        let (message, hint) = refused(&still);
        assert_eq!(message, "animation and frames need a mesh and a camera that moves");
        assert!(hint.starts_with("add `turntable = 60`, or `camera = path.toml`"), "{hint}");
        let nothing = PictureRequest::new("shape:sphere", watercolor());
        assert_eq!(refused(&nothing).0, "nothing would be written");
        let painterly = PainterlyRequest { ground: "wood".to_owned(), ..Default::default() };
        let painterly = PainterlyRequest { with_pigments: true, ..painterly };
        let ground = sphere(TechniqueRequest::Painterly(painterly), folder.path());
        assert_eq!(refused(&ground).0, "ground takes linen, paper, panel, found `wood`");
    }

    #[test]
    fn frames_that_exist_are_found_and_cancelled_work_ends() {
        let folder = tempfile::tempdir().unwrap();
        let mut request = sphere(watercolor(), folder.path());
        request.view.turntable = Some(2);
        request.animation.animation = Some(folder.path().join("turning.gif"));
        let first = request.run(&Task::default()).unwrap();
        let wanted =
            ["a.png", "turning.frames", "turning.gif"].map(|name| folder.path().join(name));
        assert_eq!(first.files, wanted);
        assert_eq!((first.frames, first.frames_found), (Some(2), Some(0)));
        assert_eq!(first.technique, TechniqueOutcome::Watercolor { regions: None });
        let again = request.run(&Task::default()).unwrap();
        assert_eq!((again.frames, again.frames_found), (Some(2), Some(2)));
        let task = Task::default();
        task.cancel();
        let ended = request.run(&task).unwrap_err();
        assert!(matches!(ended, PictureError::Watercolor(_) | PictureError::Cancelled(_)));
    }
}
