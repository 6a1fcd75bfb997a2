//! Files of earlier versions open, and hold what they held. `tests/fixtures/formats` has a file of every format that we
//! write or read back. Its README says which program wrote it. If a test here fails, do not write the file
//! anew: people have such files.

use std::path::{Path, PathBuf};

use artmap::map::ArtMap;
use artmap::painted::{Style, StylePreset};
use artmap::passages::Marks;
use artmap::sample::SampleSet;
use calibrate::Residuals;
use calibrate::library::PigmentLibrary;
use documents::file::{NamedFiles, Outside};
use graphics::camera::CameraPath;
use graphics::picture::Photograph;
use maps::Book;
use paint::document::Document;
use paint::file::read_table;
use painterly::guides::Guides;
use painterly::{RegionArea, Regions};
use session::LostSession;
use session::brushes::BrushSet;
use session::swatches::SwatchBook;
use suite::program::impasto;
use volumes::script::Script;

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/formats").join(name)
}

fn text(name: &str) -> String {
    std::fs::read_to_string(fixture(name)).unwrap()
}

/// Runs a command that must succeed.
fn succeeds(arguments: &[&str]) -> String {
    let run = impasto(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run.out
}

fn copy_folder(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy_folder(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}

#[test]
fn a_library_opens_and_is_written_byte_for_byte() {
    let library = PigmentLibrary::open(fixture("library.json")).unwrap();
    assert_eq!(library.to_json(), text("library.json"));
    assert_eq!((library.pigments.len(), library.grid.count()), (20, 7));
    let residuals = Residuals::open(fixture("residuals.json")).unwrap();
    assert_eq!(residuals.to_json(), text("residuals.json"));
}

/// Digest of the paint of the script of every action.
const PAINTED: &str = "1ea89535784f23e5acb875acad4f821131c9f9c28ca5f94044589e2e7d6f9991";

#[test]
fn a_script_of_every_action_paints_what_it_painted() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    std::fs::copy(fixture("every-action.json"), at("every-action.json")).unwrap();
    succeeds(&["paint", &at("every-action.json"), "-o", &at("painting.exr"), "--backend", "cpu"]);
    let painted =
        [at("painting.exr"), at("saved.exr")].map(|file| Document::open(Path::new(&file)));
    let earlier = Document::open(&fixture("painting.exr")).unwrap();
    for painted in painted {
        let painted = painted.unwrap();
        // Since then, paint laid on wet paint lies on it as a skin.
        assert_eq!(painted.digest_of_paint(), PAINTED, "other paint");
        let Document { wet, dry, .. } = earlier.clone();
        let painted = Document { wet, dry, ..painted };
        // The oils that ship were fitted anew since then. The ground is primed with one of them.
        let mut painted = Document { library: earlier.library.clone(), ..painted };
        let primer = painted.ground.reflectance.iter_mut().zip(&earlier.ground.reflectance);
        for (reflectance, earlier) in primer {
            assert!((*reflectance - earlier).abs() < 0.01, "another primer");
            *reflectance = *earlier;
        }
        assert!(painted == earlier, "another ground or light");
    }
}

#[test]
fn a_painting_shows_the_picture_that_it_showed() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("painting.png");
    let painting = fixture("painting.exr").display().to_string();
    succeeds(&["relight", &painting, "-o", &picture.display().to_string()]);
    let [found, wanted] =
        [picture, fixture("painting.png")].map(|file| Photograph::open(&file).unwrap());
    assert!(found == wanted, "another picture");
}

#[test]
fn palette_and_brushes_open_with_their_painting() {
    let bytes = std::fs::read(fixture("with-palette.exr")).unwrap();
    let table = read_table("with-palette.exr", &bytes).unwrap().unwrap();
    assert!(table.palette.wet.totals().iter().any(|total| *total > 0), "a bare palette");
    let brushes: Vec<_> =
        table.brushes.iter().map(|brush| (brush.name.as_str(), brush.paint.is_some())).collect();
    assert_eq!(brushes, [("flat", true), ("knife", false), ("mop", true)]);
}

#[test]
fn an_autosave_is_found_with_its_recording() {
    let folder = tempfile::tempdir().unwrap();
    copy_folder(&fixture("autosaves"), folder.path());
    let lost = LostSession::all(folder.path()).unwrap();
    assert_eq!(lost.len(), 1);
    assert_eq!((lost[0].meta.title.as_str(), lost[0].meta.seconds), ("Every action", 7));
    let work = lost[0].work().unwrap().unwrap();
    assert_eq!(work.session.brushes.len(), 3);
    let [canvas, palette] = lost[0].files().map(|file| Document::open(&file).unwrap());
    assert!(canvas == Document::open(&fixture("with-palette.exr")).unwrap(), "another canvas");
    assert!(palette.wet.totals().iter().any(|total| *total > 0), "a bare palette");
}

#[test]
fn samples_open_and_make_the_art_map_that_they_made() {
    let samples = SampleSet::open(&fixture("samples.exr")).unwrap();
    assert_eq!((samples.samples.len(), samples.paint.is_some()), (2, true));
    let folder = tempfile::tempdir().unwrap();
    let made = folder.path().join("artmap.exr");
    let from = fixture("samples.exr").display().to_string();
    succeeds(&["artmap", "build", &from, "--size", "64", "-o", &made.display().to_string()]);
    let [made, earlier] = [made, fixture("artmap.exr")].map(|file| ArtMap::open(&file).unwrap());
    assert_eq!((earlier.keys.len(), earlier.paint.is_some()), (2, true));
    assert!(made == earlier, "another map");
}

#[test]
fn what_users_write_for_painterly_pictures_opens() {
    let marks = Marks::open(&fixture("marks.toml")).unwrap();
    assert_eq!(marks.samples.len(), 2);
    let guides = Guides::open(&fixture("guides.toml")).unwrap();
    assert_eq!((guides.size_px, guides.lines.len()), ([800, 600], 1));
    let path = fixture("regions.toml");
    let mut files = NamedFiles::of(&path, Outside::Refused);
    let regions = Regions::open(&path, &mut files).unwrap();
    let areas: Vec<_> = regions.list.iter().map(|region| &region.area).collect();
    let wanted = RegionArea::Label([0x3f, 0x7a, 0x20]);
    assert!(matches!(areas[..], [RegionArea::Polygon(_), label] if *label == wanted), "{areas:?}");
    let path = CameraPath::open(&fixture("camera.toml")).unwrap();
    assert_eq!((path.frames, path.keyframes.len()), (120, 2));
}

#[test]
fn settings_of_every_technique_are_still_those_of_their_preset() {
    let file = "landscape.toml";
    let settings = watercolor::Settings::from_toml(file, &text(file)).unwrap();
    assert_eq!(settings, watercolor::Preset::Landscape.settings());
    let settings = painterly::Settings::from_toml("night.toml", &text("night.toml")).unwrap();
    assert_eq!(settings, painterly::Preset::Night.settings());
    let settings =
        volumes::settings::Settings::from_toml("bleed.toml", &text("bleed.toml")).unwrap();
    assert_eq!(settings, volumes::settings::Preset::Bleed.settings());
    let style = Style::from_toml("dabs.toml", &text("dabs.toml")).unwrap();
    assert_eq!(style, StylePreset::Dabs.settings());
    let changed = watercolor::Settings::from_toml("rough.toml", &text("rough.toml")).unwrap();
    assert_eq!(changed.edges.strength, 5.0);
}

#[test]
fn scripts_of_volumes_open() {
    let script = Script::open(&fixture("village.toml")).unwrap();
    let counts = [script.regions.len(), script.pours.len(), script.lifts.len(), script.dries.len()];
    assert_eq!((script.seconds, counts), (6.0, [2, 2, 1, 1]));
    let recorded = Script::open(&fixture("poured.toml")).unwrap();
    assert_eq!(recorded.pours.len(), 1);
}

#[test]
fn frames_of_an_interrupted_animation_are_painted_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let frames = folder.path().join("turning.frames");
    copy_folder(&fixture("turning.frames"), &frames);
    std::fs::remove_file(frames.join("frame-0003.png")).unwrap();
    let animation = folder.path().join("turning.gif").display().to_string();
    let turning = ["watercolor", "shape:sphere", "--width", "32", "--backend", "cpu"];
    succeeds(&[&turning[..], &["--turntable", "3", "--animation", &animation]].concat());
    for name in ["frame-0001.png", "frame-0002.png", "frame-0003.png"] {
        let [found, wanted] = [frames.join(name), fixture("turning.frames").join(name)]
            .map(|file| Photograph::open(&file).unwrap());
        assert!(found == wanted, "{name}: another picture");
    }
}

#[test]
fn a_survey_opens() {
    let book = Book::from_json(&text("survey.json")).unwrap();
    assert_eq!((book.pigments.len(), book.sets.len(), book.entries.len()), (18, 41, 24));
    assert_eq!(Book::from_json(&book.to_json().unwrap()).unwrap(), book);
}

#[test]
fn own_brushes_and_kept_mixtures_open() {
    let brushes = BrushSet::of_json(&text("brushes.json"), "brushes.json").unwrap();
    let [preset] = brushes.presets() else { panic!("{brushes:?}") };
    assert_eq!((brushes.name(), preset.name.as_str()), ("Portraits", "soft filbert"));
    assert!(preset.load.is_some(), "no paint to load");
    let swatches = SwatchBook::from_json("swatches.json", &text("swatches.json")).unwrap();
    assert_eq!(swatches.swatches[0].recipe.len(), 2);
}
