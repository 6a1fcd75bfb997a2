//! The cells of surfaces of known form, and which of them surface joins.

use glam::Vec3;
use graphics::mesh::{Mesh, SampleModel};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::tests::{cell_at, level};
use super::*;
use crate::test_surfaces::{joined, sheet};

#[test]
fn links_do_not_depend_on_the_cut_into_triangles() {
    for turn in [Vec3::X, Vec3::new(0.8, 0.36, 0.48)] {
        let across = turn.cross(Vec3::new(0.1, -0.2, 0.97)).normalize();
        let plane = |squares| sheet(squares, |u, v| (turn * u * 9.0 + across * v * 9.0).to_array());
        let keys = |grid: &Grid| {
            let first = |cell| grid.samples.places[grid.samples.of_cell(cell).start];
            (0..grid.cells.len())
                .map(|cell| grid.samples.lattice.coordinates(first(cell)))
                .collect::<Vec<_>>()
        };
        let grids =
            [1, 100].map(|squares| Grid::of(&plane(squares), 1.0, SAMPLES_PER_CELL, 1).unwrap());
        let cells = grids.each_ref().map(keys);
        // A cell with a sliver of surface may have a sample of one cut and none of the other.
        let both: Vec<_> = cells[0].iter().filter(|at| cells[1].contains(at)).collect();
        assert!(both.len() * 20 > cells[0].len() * 19, "{} of {}", both.len(), cells[0].len());
        let links = |which: usize| {
            let of_cell = (0..cells[which].len()).flat_map(|cell| {
                let graph = &grids[which].graph;
                graph.links(cell).map(move |link| (cell, graph.others[link] as usize))
            });
            let mut links: Vec<_> =
                of_cell.map(|(a, b)| [a, b].map(|cell| cells[which][cell])).collect();
            links.retain(|ends| ends.iter().all(|end| both.contains(&end)));
            links.sort_unstable();
            links
        };
        assert_eq!(links(0), links(1));
        let grid = &grids[0];
        for (link, &back) in grid.graph.back.iter().enumerate() {
            assert_eq!(grid.graph.back[back as usize] as usize, link);
        }
        let inner = cell_at(grid, (turn * 4.5 + across * 4.5).to_array());
        assert!(grid.graph.links(inner).len() >= 8);
    }
}

#[test]
fn a_level_sheet_joins_eight_neighbours() {
    for squares in [1, 37] {
        let grid = Grid::of(&level(9.0, 0.0, squares), 1.0, SAMPLES_PER_CELL, 1).unwrap();
        let inner = cell_at(&grid, [4.5, 0.0, 4.5]);
        let axes: Vec<u8> = grid.graph.links(inner).map(|link| grid.graph.axes[link]).collect();
        assert_eq!(axes, [2, 1, 2, 1, 1, 2, 1, 2], "{squares}");
    }
}

#[test]
fn triangles_that_meet_at_a_wall_join_its_cells() {
    let wall =
        Grid::of(&level(9.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap().samples.lattice.origin.x;
    for beside in [-2e-6, 0.0, 2e-6] {
        let middle = wall + beside;
        let halves =
            sheet(2, |u, v| [if u == 0.5 { middle } else { 9.0 * u }, 0.0, 9.0 * (v - 0.04)]);
        let grid = Grid::of(&halves, 1.0, SAMPLES_PER_CELL, 1).unwrap();
        for side in [-0.5, 0.5] {
            let cell = cell_at(&grid, [wall + side, 0.0, 4.0]);
            assert_eq!(grid.graph.links(cell).len(), 8, "{beside} {side}");
        }
    }
}

#[test]
fn the_nearest_sample_is_that_of_a_search_through_all() {
    let grid = Grid::of(&SampleModel::Village.mesh(2000), 0.3, SAMPLES_PER_CELL, 1).unwrap();
    let random = &mut ChaCha8Rng::seed_from_u64(2);
    for _ in 0..200 {
        let place = Vec3::from([(); 3].map(|()| random.random_range(-2.0..2.0)));
        let distances = grid.samples.places.iter().map(|at| at.distance(place));
        let least = distances.fold(f32::INFINITY, f32::min);
        let (sample, distance) = grid.nearest(place).unwrap();
        assert_eq!(distance, least);
        assert_eq!(grid.samples.places[sample].distance(place), least);
    }
}

#[test]
fn cells_of_parallel_plates_are_not_joined() {
    for height in [1.0, 0.7, 1.3, 0.2] {
        let plates = joined(level(6.0, 0.0, 3), &level(6.0, height, 2));
        let grid = Grid::of(&plates, 1.0, SAMPLES_PER_CELL, 1).unwrap();
        let upper = |cell: usize| {
            let own = &grid.samples.places[grid.samples.of_cell(cell)];
            assert!(own.iter().all(|at| (at.y > 0.0) == (own[0].y > 0.0)), "a cell of both");
            own[0].y > 0.0
        };
        for cell in 0..grid.cells.len() {
            for link in grid.graph.links(cell) {
                assert_eq!(upper(cell), upper(grid.graph.others[link] as usize));
            }
        }
        assert_eq!(grid.bodies.of_triangles.iter().max(), Some(&2));
    }
}

#[test]
fn surfaces_touch_where_an_open_corner_is_between_them() {
    // A ball of radius 1 sunk into a sheet.
    for (sunk, bodies) in [(0.0, 2), (0.1, 2), (0.9, 1), (1.4, 1)] {
        let floor = level(6.0, sunk - 1.0, 12);
        let ball = Mesh::sphere(3000);
        let moved = |mesh: &Mesh, by: Vec3| {
            let mut mesh = mesh.clone();
            mesh.positions.iter_mut().for_each(|at| *at = (Vec3::from(*at) + by).to_array());
            mesh
        };
        let both = joined(moved(&floor, Vec3::new(-3.0, 0.0, -3.0)), &ball);
        let grid = Grid::of(&both, 0.5, SAMPLES_PER_CELL, 1).unwrap();
        let most = grid.bodies.of_triangles.iter().max();
        assert_eq!(most, Some(&bodies), "{sunk}");
        // A pane just over the sheet is one with it.
        let pane = moved(&level(1.0, sunk - 0.99, 1), Vec3::new(1.5, 0.0, 1.5));
        let grid = Grid::of(&joined(both, &pane), 0.5, SAMPLES_PER_CELL, 1).unwrap();
        let of = &grid.bodies.of_triangles;
        assert_eq!((of[0], of.iter().max()), (of[of.len() - 1], Some(&bodies)), "{sunk}");
        for cell in 0..grid.cells.len() {
            let own = &grid.samples.triangles[grid.samples.of_cell(cell)];
            let body = grid.bodies.of_cells[cell];
            assert!(own.iter().all(|&triangle| of[triangle as usize] == body));
            for link in grid.graph.links(cell) {
                assert_eq!(grid.bodies.of_cells[grid.graph.others[link] as usize], body);
            }
        }
    }
}

#[test]
fn sides_of_a_fold_are_joined_at_the_fold_alone() {
    // Two large triangles a side, 1.2 cells apart at the open end.
    let fold = sheet(2, |u, v| [8.0 * (u - 0.5).abs() * 2.0, 2.4 * (u - 0.5), 8.0 * v]);
    let grid = Grid::of(&fold, 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let side = |cell: usize| {
        let own = &grid.samples.places[grid.samples.of_cell(cell)];
        let above = own.iter().filter(|at| at.y > 0.0).count();
        if above == own.len() { 1 } else { -i32::from(above == 0) }
    };
    let mut seen = 0;
    for cell in (0..grid.cells.len()).filter(|&cell| grid.cells.centers[cell].x > 6.5) {
        for other in grid.graph.links(cell).map(|link| grid.graph.others[link] as usize) {
            assert_ne!(side(cell) * side(other), -1);
            seen += 1;
        }
    }
    assert!(seen > 20);
}
