//! Pictures of bodies that lie on one another.

use glam::Vec3;
use graphics::camera::Framing;
use graphics::mesh::Mesh;

use super::*;
use crate::script::RegionStyle;
use crate::settings::{Inside, Settings};
use crate::test_surfaces::{joined, sheet};
use crate::world::{Pour, Recipe, World, WorldSettings};

/// Red and blue pixels after paint is poured beside a red ball on a blue sheet. The ball is sunk
/// into the sheet by this much.
fn red_and_blue(sunk: f32) -> [usize; 2] {
    // Smaller than a cell, so that volumes on the sheet reach above its middle.
    let mut ball = Mesh::sphere(2000);
    ball.positions.iter_mut().flatten().for_each(|along| *along *= 0.4);
    let floor = sheet(20, |u, v| [6.0 * (u - 0.5), sunk - 0.4, 6.0 * (v - 0.5)]);
    let mut mesh = joined(floor, &ball);
    let sheet_corners = 21 * 21;
    mesh.colors[..sheet_corners].fill([0.0, 0.0, 1.0]);
    mesh.colors[sheet_corners..].fill([1.0, 0.0, 0.0]);
    let mut world = World::of(&mesh, &WorldSettings::default()).unwrap();
    // 60 mm^3 fill eleven of 144 cells of the sheet.
    let place = Vec3::new(0.4, sunk - 0.4, 0.4);
    world.pour(Pour::at(place, 60.0, 1.0, Recipe::of_slot(0))).unwrap();
    (0..360).for_each(|_| world.step().unwrap());
    let style = RegionStyle {
        name: String::new(),
        inside: Inside::OwnColors,
        shells: vec![1.0],
        tints: vec![0.0, 1.0],
        stain: "#ffffff".to_owned(),
    };
    let mut painter = VolumePainter::new(&mesh, &Settings::default(), &[style]).unwrap();
    let framing = Framing { aspect: 1.25, ..Framing::default() };
    let picture = painter.paint(&world, &framing.fit(&mesh.positions), (150, 120)).unwrap();
    let above = |one: usize, other: usize| {
        picture.values().iter().filter(|color| color[one] > color[other] + 0.1).count()
    };
    [above(0, 2), above(2, 0)]
}

#[test]
fn paint_does_not_climb_from_a_cloth_onto_what_lies_on_it() {
    for sunk in [0.0, 0.012, 0.04] {
        let [red, blue] = red_and_blue(sunk);
        assert!(red == 0 && blue > 300, "{sunk}: {red} {blue}");
    }
    // A dome rises from the sheet at right angles.
    let [red, blue] = red_and_blue(0.4);
    assert!(red > 5 && blue > 100, "{red} {blue}");
}
