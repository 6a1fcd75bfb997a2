//! Plays scripts on worlds.

use documents::hint::Explain;
use graphics::camera::{Camera, Framing};
use graphics::compute::Compute;
use graphics::mesh::{Mesh, SampleModel};

use super::*;
use crate::containing::Inside;
use crate::saved::SavedError;
use crate::script::Script;
use crate::test_volumes::device;
use crate::world::StepDevice;

const SIZE: (usize, usize) = (75, 57);

const HEAD: &str = "format = \"paint-volumes\"\nversion = 1\nsubject = \"shape:still-life\"\n\
                    seconds = 4.0\n";

fn mesh() -> Mesh {
    SampleModel::StillLife.mesh(3000)
}

fn camera(scene: &Mesh) -> Camera {
    let aspect = SIZE.0 as f32 / SIZE.1 as f32;
    Framing { aspect, ..Framing::default() }.fit(&scene.positions)
}

/// The beginning of a script: [`HEAD`], which has four lines, and these tables.
fn begun(tables: &str) -> Result<Performance, PerformanceError> {
    let text = format!("{HEAD}{tables}");
    let script = Script::from_text("test.toml", &text).unwrap();
    let scene = mesh();
    let view = FirstView::new(&scene, &camera(&scene), SIZE);
    Performance::new(&script, &scene, &script.settings().unwrap(), &view)
}

fn refused(tables: &str) -> PerformanceError {
    let played = begun(tables).and_then(|mut performance| performance.advance_to(480));
    played.unwrap_err().located("test.toml", &format!("{HEAD}{tables}"))
}

const BUSY: &str = r#"
[[volume]]
centre = [0.0, 0.2, 0.0]
radius = 0.3
detail = 3

[[pour]]
picked = [0.45, 0.6]
for_s = 1.5
amount_mm3 = 60

[[pour]]
picked = [0.55, 0.55]
from_s = 0.25
for_s = 1.0
rate_mm3_s = 80

[[push]]
at = [0.0, 0.2, 0.0]
towards = [1.0, 0.0, 0.5]
radius = 0.5
strength = 30.0
from_s = 0.5
for_s = 0.5

[[lift]]
picked = [0.5, 0.6]
radius = 0.2
rate = 3.0
from_s = 1.0
for_s = 0.5
"#;

#[test]
fn a_script_played_in_pieces_or_from_a_snapshot_ends_in_the_same_bytes() {
    let mut whole = begun(BUSY).unwrap();
    whole.advance_to(240).unwrap();
    let mut parts = begun(BUSY).unwrap();
    let mut snapshots = Vec::new();
    for step in [1, 2, 31, 60, 61, 119, 150, 239, 240] {
        parts.advance_to(step).unwrap();
        assert_eq!(parts.step(), step);
        snapshots.push(parts.clone());
    }
    snapshots.push(parts);
    for mut played in snapshots {
        played.advance_to(240).unwrap();
        assert_eq!(played.world().volumes(), whole.world().volumes());
        assert_eq!(played.world().tally(), whole.world().tally());
    }
    assert!(whole.world().volumes().len() > 5);
    assert!(whole.world().tally().lifted.iter().sum::<u64>() > 0, "the sponge took nothing");
    for played in [1, 31, 60, 150, 239] {
        let mut before = begun(BUSY).unwrap();
        before.advance_to(played).unwrap();
        let file = before.saved("busy");
        let mut resumed = begun(BUSY).unwrap().resumed(&file, "busy").unwrap();
        assert_eq!((resumed.step(), resumed.saved("busy")), (played, file));
        resumed.advance_to(240).unwrap();
        assert_eq!(resumed.saved("busy"), whole.saved("busy"), "from step {played}");
    }
    // You cannot go back in time.
    whole.advance_to(12).unwrap();
    assert_eq!(whole.step(), 240);
}

#[test]
fn a_script_played_on_a_device_pours_the_same_paint() {
    let Some(compute) = device() else { return };
    let mut on_device = StepDevice::new(compute).above(0);
    let [mut own, mut other] = [begun(BUSY).unwrap(), begun(BUSY).unwrap()];
    own.advance_to(240).unwrap();
    other.advance_on(&mut on_device, 120).unwrap();
    assert!(other.step() == 120 && on_device.serves(other.world()));
    other.advance_on(&mut on_device, 240).unwrap();
    assert_eq!(own.world().tally(), other.world().tally());
    let [own, other] = [&own, &other].map(|played: &Performance| {
        let volumes = played.world().volumes().iter();
        volumes.map(|volume| (volume.paint, volume.center, volume.radius)).collect::<Vec<_>>()
    });
    assert_eq!(own, other);
    // Without one, the processor plays it.
    let [mut small, mut usual] = [begun(BUSY).unwrap(), begun(BUSY).unwrap()];
    let mut on_device = StepDevice::beside(&Compute::cpu());
    small.advance_on(&mut on_device, 60).unwrap();
    usual.advance_to(60).unwrap();
    assert_eq!(small.world().volumes(), usual.world().volumes());
}

#[test]
fn a_moment_of_another_script_or_wish_is_refused() {
    let mut played = begun(BUSY).unwrap();
    played.advance_to(20).unwrap();
    let file = played.saved("busy");
    let others = [BUSY.replace("0.45, 0.6", "0.45, 0.58"), BUSY.replace("= 60", "= 61")];
    for script in others {
        let refused = begun(&script).unwrap().resumed(&file, "busy").map(|own| own.step());
        assert_eq!(refused, Err(SavedError::Other));
    }
    let other = played.resumed(&file, "").map(|own| own.step());
    assert_eq!(other, Err(SavedError::Other));
    let world = played.world().saved("busy");
    let refused = played.resumed(&world, "busy").map(|own| own.step()).unwrap_err();
    assert!(refused.hint().is_some() && refused.to_string().starts_with("not a saved"));
    let damaged = played.resumed(&file[..file.len() - 40], "busy").map(|own| own.step());
    assert_eq!(damaged, Err(SavedError::Damaged));
}

#[test]
fn paint_is_poured_where_the_first_picture_was_picked() {
    let tables = "[[pour]]\npicked = [0.45, 0.6]\nfor_s = 0.1\namount_mm3 = 1\n";
    let mut played = begun(tables).unwrap();
    played.advance_to(12).unwrap();
    let scene = mesh();
    let view = FirstView::new(&scene, &camera(&scene), SIZE);
    let place = view.place(&scene, [0.45, 0.6]).unwrap();
    let aspect = SIZE.0 as f32 / SIZE.1 as f32;
    let at = camera(&scene).clip_from_model(aspect).project_point3(place);
    // You pick the middle of a pixel.
    let [across, down] = [0.5 + 0.5 * at.x - 0.45, 0.5 - 0.5 * at.y - 0.6];
    assert!(across.abs() <= 1.0 / SIZE.0 as f32 && down.abs() <= 1.0 / SIZE.1 as f32, "{at}");
    let world = played.world();
    assert_eq!(world.volumes().len(), 1);
    let (sample, distance) = world.grid().nearest(place).unwrap();
    assert!(distance < 0.2 * world.cell(), "{distance}");
    let cell = world.grid().samples.cells[sample];
    assert_eq!(world.volumes()[0].cell, Some(cell));
    assert!(world.volumes()[0].center.distance(place) < world.cell());
    // You pick places as shares of the picture. The upper left corner shows no surface.
    assert_eq!(view.place(&scene, [0.0, 0.0]), None);
    assert_eq!(view.place(&scene, [1.1, 0.5]), None);
    assert_eq!(view.place(&scene, [f64::NAN, 0.5]), None);
}

#[test]
fn faults_name_the_line_of_their_table_and_the_way_out() {
    let bare = refused("\n[[pour]]\npicked = [0.01, 0.02]\namount_mm3 = 1\nfor_s = 1.0\n");
    assert_eq!(
        bare.to_string(),
        "test.toml, line 6: [[pour]] 1: the first picture shows no surface at 0.010, 0.020"
    );
    let off = refused(
        "[[pour]]\npicked = [0.5, 0.6]\namount_mm3 = 1\nfor_s = 1.0\n\
         [[pour]]\nat = [0.0, 90.0, 0.0]\nfrom_s = 1.0\namount_mm3 = 1\nfor_s = 1.0\n",
    );
    assert!(off.to_string().starts_with("test.toml, line 9: [[pour]] 2: "), "{off}");
    let early = refused(
        "[[volume]]\ncentre = [0.0, 0.2, 0.0]\nradius = 0.3\nfrom_s = 2.0\n\
         [[split]]\nat_s = 1.0\nvolume = 1\n",
    );
    let expected = "test.toml, line 9: [[split]] 1: single volume 1 is not there";
    assert_eq!(early.to_string(), expected);
    for error in [bare, off, early] {
        assert!(error.hint().is_some(), "{error}");
    }
}

#[test]
fn a_split_volume_becomes_volumes_of_the_grid_and_dry_ones_rest() {
    let tables = r#"
[palette]
B = "Ultramarine"
[[volume]]
centre = [0.0, 0.2, 0.0]
radius = 0.3
detail = 3
recipe = { B = 1 }
[[split]]
at_s = 0.5
volume = 1
[[dry]]
at_s = 2.0
[[pour]]
picked = [0.45, 0.6]
from_s = 2.5
for_s = 1.0
amount_mm3 = 10
recipe = { B = 1 }
"#;
    let mut played = begun(tables).unwrap();
    played.advance_to(59).unwrap();
    let before = played.world().tally();
    assert!(played.world().volumes().len() == 1 && before.on_scene[0] > 0);
    played.advance_to(230).unwrap();
    let volumes = played.world().volumes();
    assert!(volumes.len() > 3, "{}", volumes.len());
    assert!(volumes.iter().all(|volume| volume.cell.is_some()));
    assert_eq!(played.world().tally(), before);
    played.advance_to(242).unwrap();
    let dried = played.world().volumes().to_vec();
    assert!(dried.iter().all(|volume| volume.dry));
    played.advance_to(480).unwrap();
    let (old, new) = played.world().volumes().split_at(dried.len());
    assert_eq!(old, dried);
    assert!(!new.is_empty() && new.iter().all(|volume| !volume.dry));
}

#[test]
fn a_dryer_with_a_radius_dries_what_lies_below_it() {
    let pour = "[[pour]]\npicked = [0.45, 0.6]\nfor_s = 1.0\namount_mm3 = 60\n";
    let mut played = begun(pour).unwrap();
    played.advance_to(240).unwrap();
    let cell = played.world().cell();
    let fullest = played.world().volumes().iter().max_by_key(|volume| volume.paint.volume());
    let place = fullest.unwrap().center;
    let radius = 1.5 * cell;
    let dry = format!("[[dry]]\nat_s = 2.0\nat = {:?}\nradius = {radius}\n", place.to_array());
    let mut played = begun(&format!("{pour}{dry}")).unwrap();
    played.advance_to(240).unwrap();
    assert!(played.world().volumes().iter().all(|volume| !volume.dry));
    played.advance_to(241).unwrap();
    let volumes = played.world().volumes();
    let (dry, wet): (Vec<_>, Vec<_>) = volumes.iter().partition(|volume| volume.dry);
    assert!(!dry.is_empty() && !wet.is_empty(), "{} and {}", dry.len(), wet.len());
    assert!(dry.iter().all(|volume| volume.center.distance(place) < radius + cell));
    assert!(wet.iter().all(|volume| volume.center.distance(place) > radius - cell));
}

#[test]
fn volumes_of_a_script_stay_in_its_regions() {
    let tables = "[[keep]]\nabove = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\n\
                  [[pour]]\npicked = [0.6, 0.6]\nfor_s = 1.0\namount_mm3 = 400\n";
    let mut played = begun(tables).unwrap();
    played.advance_to(360).unwrap();
    let world = played.world();
    let insides: Vec<Inside> = world.volumes().iter().map(Inside::of).collect();
    let mut held = world.grid().samples.places.clone();
    held.retain(|place| insides.iter().any(|inside| inside.holds(*place)));
    assert!(held.iter().all(|place| place.x >= 0.0));
    let near = held.iter().filter(|place| place.x < 0.5 * world.cell()).count();
    assert!(held.len() > 500 && near > 20, "{} {near}", held.len());
}
