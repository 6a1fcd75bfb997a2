//! A request that was checked, and painting it.

use documents::Task;
use graphics::compute::Compute;

use crate::error::PictureError;
use crate::exports::{Listener, Note, Written};
use crate::painterly_job::PainterlyJob;
use crate::request::{Device, PictureOutcome, PictureRequest, TechniqueRequest};
use crate::strokes_job::StrokesJob;
use crate::volumes_job::VolumesJob;
use crate::watercolor_job::WatercolorJob;

/// A picture that can be painted: the request was checked, and its outputs can be written.
#[derive(Debug)]
pub struct PictureJob {
    work: Work,
    device: Device,
    /// Files and remarks so far.
    written: Written,
}

#[derive(Debug)]
enum Work {
    Watercolor(Box<WatercolorJob>),
    Painterly(Box<PainterlyJob>),
    Strokes(Box<StrokesJob>),
    Volumes(Box<VolumesJob>),
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
        let compute = Compute::choose(job.device().into())?;
        job.paint(compute, task, &mut |_| {})
    }

    /// Does all work of [`Self::run`] before it opens a device. Use this if you want to open the device yourself
    /// ([`PictureJob::device`]), or to hear of each file when it is written.
    ///
    /// # Errors
    /// The errors of [`Self::run`].
    pub fn open(
        &self,
        task: &Task,
        listener: &mut Listener<'_>,
    ) -> Result<PictureJob, PictureError> {
        let mut written = Written::default();
        let mut collect = |note: Note| written.pass(note, listener);
        let work = match &self.technique {
            TechniqueRequest::Watercolor(own) => {
                Work::Watercolor(Box::new(WatercolorJob::open(self, own, &mut collect)?))
            }
            TechniqueRequest::Painterly(own) => {
                Work::Painterly(Box::new(PainterlyJob::open(self, own, task, &mut collect)?))
            }
            TechniqueRequest::Strokes(own) => {
                Work::Strokes(Box::new(StrokesJob::open(self, own, task, &mut collect)?))
            }
            TechniqueRequest::Volumes(own) => {
                Work::Volumes(Box::new(VolumesJob::open(self, own, &mut collect)?))
            }
        };
        let device = match &work {
            Work::Strokes(job) if !job.paints() => Device::Cpu,
            _ => self.device,
        };
        Ok(PictureJob { work, device, written })
    }
}

impl PictureJob {
    /// The device to paint on: the one of the request, or the processor if nothing is painted.
    #[must_use]
    pub fn device(&self) -> Device {
        self.device
    }

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
        let Self { work, mut written, .. } = self;
        let mut collect = |note: Note| written.pass(note, listener);
        let summary = match work {
            Work::Watercolor(job) => job.paint(compute, task, &mut collect)?,
            Work::Painterly(job) => job.paint(compute, task, &mut collect)?,
            Work::Strokes(job) => job.paint(compute, task, &mut collect)?,
            Work::Volumes(job) => job.paint(compute, task, &mut collect)?,
        };
        Ok(PictureOutcome {
            size: summary.size,
            backend: summary.backend,
            technique: summary.technique,
            frames: summary.frames.map(|(frames, _)| frames),
            frames_found: summary.frames.map(|(_, found)| found),
            pigments: summary.pigments,
            remarks: written.remarks,
            files: written.files,
            streamed: written.streamed,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use calibrate::library::PigmentLibrary;
    use documents::hint::Explain;
    use graphics::{export::png8, field::Field};
    use paint::strokes::StrokeScript;

    use super::*;
    use crate::request::{
        PainterlyRequest, StrokesRequest, TechniqueOutcome, VolumesRequest, WatercolorRequest,
    };

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

    /// A photograph of 12 x 9 pixels, red on the left and blue on the right, on a canvas of 24 x 18 cells.
    fn dusk(own: StrokesRequest, folder: &Path) -> PictureRequest {
        let colors = (0..12 * 9).map(|pixel| match pixel % 12 {
            0..6 => [0.3, 0.08, 0.08, 1.0],
            _ => [0.1, 0.1, 0.25, 1.0],
        });
        let picture = Field::from_values(12, 9, colors.collect());
        let photograph = folder.join("dusk.png");
        std::fs::write(&photograph, png8(&picture, 1.0).unwrap().bytes).unwrap();
        let brushes_mm = match own.brushes_mm.is_empty() {
            true => vec![2.0, 4.0],
            false => own.brushes_mm,
        };
        let own = StrokesRequest { width_mm: 12.0, cell_mm: 0.5, brushes_mm, ..own };
        let mut request = PictureRequest::new(photograph, TechniqueRequest::Strokes(own));
        request.pigments.palette = vec!["Zinc White, Vermilion".to_owned(), "Ultramarine".into()];
        request.device = Device::Cpu;
        request
    }

    /// The numbers of the strokes of an outcome: their count, whether there is a colour error of the painting,
    /// and one of the separation.
    fn strokes_of(outcome: &PictureOutcome) -> (u64, bool, bool) {
        let TechniqueOutcome::Strokes { strokes, levels, error, separation_error } =
            &outcome.technique
        else {
            panic!("{outcome:?}");
        };
        assert_eq!(levels.iter().map(|level| level.strokes).sum::<u64>(), *strokes);
        (*strokes, error.is_some(), separation_error.is_some())
    }

    fn script(path: &Path) -> StrokeScript {
        StrokeScript::from_json("a script", &std::fs::read(path).unwrap()).unwrap()
    }

    #[test]
    fn strokes_that_cannot_be_painted_are_refused_and_nothing_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| Some(folder.path().join(name));
        let own = StrokesRequest { separate: file("maps"), ..StrokesRequest::default() };
        let request = dusk(own.clone(), folder.path());
        type Change = fn(&mut PictureRequest);
        let changes: [(Change, &str, &str); 9] = [
            (|r| r.view.width = Some(64), "width is for other techniques", "`width_mm`"),
            (|r| r.view.camera = Some("9,0".into()), "camera is for", "leave it out"),
            (|r| r.style.preset = Some("oil".into()), "preset is for", "`tolerance = 3`"),
            (|r| r.style.set = vec!["tolerance=3".into()], "set is for", "`tolerance = 3`"),
            (|r| r.stages = Some("stages".into()), "stages is for", "`strokes_out`"),
            (|r| r.animation.frames = Some("f".into()), "frames is for", "`strokes_out`"),
            (|r| r.pigments.illuminant = Some("A".into()), "illuminant takes D65", "relight"),
            (|r| r.exports.picture = Some(r.subject.clone()), "an input file", "another file name"),
            (|r| r.pigments.palette = vec!["Mauvein".into()], "`Mauvein`", ""),
        ];
        for (change, message, hint) in changes {
            let mut changed = request.clone();
            change(&mut changed);
            let refused = refused(&changed);
            assert!(refused.0.contains(message) && refused.1.contains(hint), "{refused:?}");
        }
        let picture = file("a.png");
        for (own, exported, message) in [
            (StrokesRequest { separate: None, ..own.clone() }, None, "nothing would be written"),
            (
                StrokesRequest { tolerance: 0.1, ..own.clone() },
                None,
                "tolerance takes 0.5 to 100, found `0.1`",
            ),
            (
                StrokesRequest { brushes_mm: vec![0.5], ..own.clone() },
                None,
                "brushes_mm takes 1 to 12, found `0.5`",
            ),
            (
                StrokesRequest { ground: "wood".to_owned(), ..own.clone() },
                None,
                "ground takes linen, paper, panel, found `wood`",
            ),
            (
                StrokesRequest { thin: true, ..own.clone() },
                picture.clone(),
                "thin works only with separate: strokes overlap and must hide",
            ),
            (
                StrokesRequest { strokes_out: picture.clone(), ..own.clone() },
                picture.clone(),
                "a.png: two outputs have this file name",
            ),
        ] {
            let mut request = dusk(own, folder.path());
            request.exports.picture = exported;
            let (found, hint) = refused(&request);
            assert!(found.ends_with(message) && !hint.is_empty(), "{found} for {message}: {hint}");
        }
        let names = std::fs::read_dir(folder.path()).unwrap();
        assert_eq!(names.count(), 1, "only the photograph is there");
    }

    #[test]
    fn a_photograph_is_painted_and_its_script_names_the_library() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        let own = StrokesRequest { strokes_out: Some(file("a.json")), ..StrokesRequest::default() };
        let mut request = dusk(own, folder.path());
        request.exports.picture = Some(file("a.png"));
        let outcome = request.run(&Task::default()).unwrap();
        assert_eq!(outcome.files, [file("a.json"), file("a.png")]);
        assert_eq!(outcome.size, (24, 18));
        assert!(outcome.backend.starts_with("the processor"), "{}", outcome.backend);
        assert_eq!(outcome.pigments, ["Zinc White", "Vermilion", "Ultramarine"]);
        let (strokes, painted, separated) = strokes_of(&outcome);
        assert!(strokes > 2 && painted && !separated, "{outcome:?}");
        let first = script(&file("a.json"));
        assert_eq!(first.title, "dusk");
        assert_eq!(first.library, Some(PigmentLibrary::van_gogh_oils().title));

        let oils = "../../measurements/van-gogh-oils.pigments.json";
        let oils = Path::new(env!("CARGO_MANIFEST_DIR")).join(oils);
        request.pigments.library = Some(oils.clone());
        request.exports.picture = None;
        let again = request.run(&Task::default()).unwrap();
        assert_eq!((again.files, again.technique), (vec![file("a.json")], outcome.technique));
        let second = script(&file("a.json"));
        assert_eq!(second.library, Some(oils.display().to_string()));
        assert_eq!(second.actions, first.actions);
    }

    #[test]
    fn a_separation_alone_paints_nothing_and_needs_no_device() {
        let folder = tempfile::tempdir().unwrap();
        let maps = folder.path().join("maps");
        let own = StrokesRequest {
            separate: Some(maps.clone()),
            thin: true,
            ..StrokesRequest::default()
        };
        let mut request = dusk(own.clone(), folder.path());
        request.device = Device::Gpu;
        let job = request.open(&Task::default(), &mut |_| {}).unwrap();
        assert_eq!(job.device(), Device::Cpu);
        assert!(!maps.exists(), "the checks write nothing");
        let outcome = request.run(&Task::default()).unwrap();
        assert_eq!((outcome.size, &outcome.files), ((24, 18), &vec![maps.clone()]));
        assert_eq!(strokes_of(&outcome), (0, false, true));
        assert!(maps.join("separation.vermilion.png").is_file());

        let both =
            StrokesRequest { thin: false, strokes_out: Some(folder.path().join("a.json")), ..own };
        let both = dusk(both, folder.path()).run(&Task::default()).unwrap();
        assert_eq!(both.files, [maps, folder.path().join("a.json")]);
        let (strokes, painted, separated) = strokes_of(&both);
        assert!(strokes > 0 && painted && separated, "{both:?}");
    }

    /// A sphere over which paint is poured for a tenth of a second, in wide cells.
    fn poured(own: VolumesRequest, folder: &Path) -> PictureRequest {
        let pour = match own.pour.is_empty() {
            true => vec!["0.5,0.5,3000".to_owned()],
            false => own.pour,
        };
        let seconds = own.seconds.or(Some(0.1));
        let own = VolumesRequest { pour, seconds, ..own };
        let mut request = sphere(TechniqueRequest::Volumes(own), folder);
        request.style.set = vec!["grid.cell=0.25".to_owned(), "picture.samples=1".to_owned()];
        request
    }

    #[test]
    fn the_script_of_poured_paint_makes_the_same_picture() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        let own = VolumesRequest { script_out: Some(file("a.toml")), ..VolumesRequest::default() };
        let outcome = poured(own, folder.path()).run(&Task::default()).unwrap();
        assert_eq!(outcome.files, [file("a.png"), file("a.toml")]);
        assert_eq!((outcome.size, outcome.backend.as_str()), ((24, 18), "cpu"));
        let TechniqueOutcome::Volumes { volumes: 1.., paint_mm3, steps_computed: 12, .. } =
            outcome.technique
        else {
            panic!("{outcome:?}");
        };
        assert!((paint_mm3.on_scene + paint_mm3.in_tube - 3000.0).abs() < 0.01, "{paint_mm3:?}");

        let own = TechniqueRequest::Volumes(VolumesRequest::default());
        let mut again = PictureRequest { subject: file("a.toml"), ..sphere(own, folder.path()) };
        again.exports.picture = Some(file("b.png"));
        let json = serde_json::to_string(&again).unwrap();
        let again: PictureRequest = documents::request::request_from_json(&json).unwrap();
        let again = again.run(&Task::default()).unwrap();
        assert_eq!((again.files, again.technique), (vec![file("b.png")], outcome.technique));
        let [first, second] = ["a.png", "b.png"].map(|name| std::fs::read(file(name)).unwrap());
        assert!(first == second, "the script makes another picture");
        // Without paint in sight the picture is another.
        let own = VolumesRequest { at: Some(0.0), ..VolumesRequest::default() };
        poured(own, folder.path()).run(&Task::default()).unwrap();
        assert!(first != std::fs::read(file("a.png")).unwrap(), "paint brings colour");
    }

    #[test]
    fn volumes_and_frames_of_poured_paint_are_written_and_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        let own = VolumesRequest { volumes: Some(file("meshes")), ..VolumesRequest::default() };
        let mut request = poured(own, folder.path());
        request.animation.rate = 10.0;
        request.animation.animation = Some(file("a.gif"));
        let first = request.run(&Task::default()).unwrap();
        assert_eq!(first.files, ["a.png", "meshes", "a.frames", "a.gif"].map(file));
        assert_eq!((first.frames, first.frames_found), (Some(2), Some(0)));
        assert!(file("meshes").join("frame-0002.ply").is_file());
        let again = request.run(&Task::default()).unwrap();
        assert_eq!((again.frames, again.frames_found), (Some(2), Some(2)));
        let task = Task::default();
        task.cancel();
        let ended = request.run(&task).unwrap_err();
        assert!(matches!(ended, PictureError::Volumes(_) | PictureError::Cancelled(_)), "{ended}");
    }

    #[test]
    fn paint_that_cannot_be_poured_is_refused_and_nothing_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let usual = VolumesRequest::default();
        let text = |text: &str| Some(text.to_owned());
        let texts = |text: &str| vec![text.to_owned()];
        for (own, message, hint) in [
            (
                VolumesRequest { pour: texts("0.5"), ..usual.clone() },
                "pour takes X,Y or X,Y,MM3 with shares of 0 to 1 and more than 0 mm3, found `0.5`",
                "try `pour = 0.5,0.6` or `pour = 0.5,0.6,200`",
            ),
            (
                VolumesRequest { pour: texts("0.01,0.02"), ..usual.clone() },
                "pour number 1: the first picture shows no surface at 0.010, 0.020",
                "choose a place on the subject, 0 to 1 across and down",
            ),
            (
                VolumesRequest { seconds: Some(-1.0), ..usual.clone() },
                "seconds takes 0 to 3600, found `-1`",
                "",
            ),
            (
                VolumesRequest { at: Some(9.0), ..usual.clone() },
                "at takes 0 to 0.1 s, found `9`",
                "give more `seconds`",
            ),
            (
                VolumesRequest { show: "all".to_owned(), ..usual.clone() },
                "show takes final, volumes, mask, grey, colour, hatching, found `all`",
                "try `show = final`",
            ),
            (
                VolumesRequest { ground: text("wood"), ..usual.clone() },
                "ground takes linen, paper, panel, found `wood`",
                "try `ground = panel`",
            ),
            (
                VolumesRequest { over: text("0.8"), ..usual.clone() },
                "over needs pigments, but no library is given",
                "name a `library` after the subject, and give `palette`",
            ),
            (
                VolumesRequest { paint: texts("Ultramarine"), ..usual.clone() },
                "paint needs pigments, but no library is given",
                "name a `library`",
            ),
            (
                VolumesRequest { mask: Some(folder.path().join("a.png")), ..usual.clone() },
                "a.png: two outputs have this file name",
                "",
            ),
        ] {
            let (found, way_out) = refused(&poured(own, folder.path()));
            assert!(found.ends_with(message), "{found} for {message}");
            assert!(!way_out.is_empty() && way_out.contains(hint), "{way_out} for {hint}");
        }
        let bare = sphere(TechniqueRequest::Volumes(usual.clone()), folder.path());
        let wanted = "add `pour = 0.5,0.5`, or a script with [[pour]]";
        assert_eq!(refused(&bare), ("shape:sphere: nothing is poured".into(), wanted.into()));
        let mut layers = poured(VolumesRequest { show: "grey".into(), ..usual }, folder.path());
        layers.exports.layers = Some(folder.path().join("a.ora"));
        assert_eq!(refused(&layers).0, "layers needs pigments, but no library is given");
        let oils = "../../measurements/van-gogh-oils.pigments.json";
        layers.pigments.library = Some(Path::new(env!("CARGO_MANIFEST_DIR")).join(oils));
        layers.pigments.palette = texts("Ultramarine");
        let wanted = "layers is of the painting, and show grey is not";
        assert_eq!(refused(&layers), (wanted.into(), "leave out `layers` or `show`".into()));
        layers.pigments.palette = texts("Mauve");
        let (message, _) = refused(&layers);
        assert!(message.starts_with("palette or paint takes a pigment of the"), "{message}");
        layers.exports = Default::default();
        assert_eq!(refused(&layers).0, "nothing would be written");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing was written");
    }

    #[test]
    fn an_input_in_the_folder_of_the_separation_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let own = StrokesRequest {
            separate: Some(folder.path().to_owned()),
            ..StrokesRequest::default()
        };
        let mut request = dusk(own, folder.path());
        let photograph = folder.path().join("separation.rebuilt.png");
        std::fs::rename(&request.subject, &photograph).unwrap();
        request.subject = photograph;
        let (message, _) = refused(&request);
        assert!(message.ends_with("is an input file, which is never overwritten"), "{message}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing was written");
    }
}
