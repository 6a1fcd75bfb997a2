//! Paint that spills on surfaces of known form. Also their cells, and which of them surface joins.

use glam::Vec3;
use graphics::mesh::{Mesh, SampleModel};
use paint::layer::Cell;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::test_volumes::{joined, sheet};

pub(super) fn level(side: f32, height: f32, squares: u32) -> Mesh {
    sheet(squares, |u, v| [side * u, height, side * v])
}

fn totals(paint: &[Cell]) -> [u64; 9] {
    let mut totals = [0; 9];
    for cell in paint {
        for (total, amount) in totals.iter_mut().zip(cell.pigments.iter().chain([&cell.vehicle])) {
            *total += u64::from(*amount);
        }
    }
    totals
}

pub(super) fn cell_at(grid: &Grid, place: [f32; 3]) -> usize {
    grid.samples.cells[grid.nearest(place.into()).unwrap().0] as usize
}

fn of_slot(slot: usize, amount: u32) -> Cell {
    let mut cell = Cell::default();
    cell.pigments[slot] = amount;
    cell
}

#[test]
fn random_spills_keep_every_quantum_and_every_limit() {
    let random = &mut ChaCha8Rng::seed_from_u64(5);
    for slope in [0.0, 0.5, 40.0] {
        let grid = Grid::of(&SampleModel::StillLife.mesh(3000), 0.25, SAMPLES_PER_CELL, 1).unwrap();
        let Grid { cells, graph, .. } = &grid;
        let mut spilling = Spilling::new(cells, 0.25, FASTEST_RATE, slope).unwrap();
        let mut paint = vec![Cell::default(); cells.len()];
        for _ in 0..cells.len() / 4 {
            let at = random.random_range(0..cells.len());
            let slot = random.random_range(0..8);
            let amount = random.random_range(0..=cells.room(at));
            paint[at] = of_slot(slot, amount / 2);
            paint[at].vehicle = amount - amount / 2;
        }
        let before = totals(&paint);
        let mut wet: Vec<bool> = paint.iter().map(|cell| cell.volume() > 0).collect();
        for step in 0..400 {
            let births = step % 3 > 0;
            let born = spilling.step((graph, cells), &mut paint, births);
            assert!(births || born.is_empty());
            for Birth { cell, giver } in born {
                assert!(!std::mem::replace(&mut wet[cell as usize], true));
                assert!(graph.links(cell as usize).any(|link| graph.others[link] == giver));
            }
            for (cell, (own, wet)) in paint.iter().zip(&wet).enumerate() {
                let most = (16 * u64::from(cells.capacities[cell])).min(1 << 30);
                assert!(u64::from(own.volume()) <= most, "{cell} of slope {slope}");
                assert_eq!(own.volume() > 0, *wet);
            }
            assert_eq!(totals(&paint), before);
        }
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let grid = Grid::of(&level(60.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let runs = [1, 2, 8].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut paint = vec![Cell::default(); grid.cells.len()];
            for (slot, at) in [(0, 30.0), (1, 31.0), (5, 40.0)] {
                let cell = cell_at(&grid, [at, 0.0, 30.0]);
                paint[cell] = of_slot(slot, grid.cells.room(cell));
            }
            let mut spilling = Spilling::new(&grid.cells, 1.0, 0.04, 0.0).unwrap();
            let mut born = Vec::new();
            for _ in 0..300 {
                born.extend(spilling.step((&grid.graph, &grid.cells), &mut paint, true));
            }
            (paint, born)
        })
    });
    assert!(runs[0].1.len() > 20);
    assert!(runs[1..].iter().all(|run| *run == runs[0]));
}

#[test]
fn two_equal_cells_share_what_is_over_their_capacities() {
    let grid = Grid::of(&level(12.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let mut paint = vec![Cell::default(); grid.cells.len()];
    let at = cell_at(&grid, [6.0, 0.0, 6.0]);
    paint[at] = of_slot(3, 9 * grid.cells.capacities[at]);
    let mut spilling = Spilling::new(&grid.cells, 1.0, 0.04, 0.0).unwrap();
    spilling.step((&grid.graph, &grid.cells), &mut paint, true);
    for link in grid.graph.links(at) {
        let other = grid.graph.others[link] as usize;
        let smaller = grid.cells.capacities[at].min(grid.cells.capacities[other]);
        let wanted = 9.0 * 0.04 / f64::from(grid.graph.axes[link]) * f64::from(smaller);
        let found = f64::from(paint[other].volume());
        assert!((found / wanted - 1.0).abs() < 5e-3, "{found} for {wanted}");
    }
}

#[test]
fn the_giver_of_a_new_volume_is_the_neighbour_that_gave_most() {
    let grid = Grid::of(&level(12.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let [left, middle, right] = [5.0, 6.0, 7.0].map(|x| cell_at(&grid, [x, 0.0, 6.0]));
    for (most, least) in [(left, right), (right, left)] {
        let mut paint = vec![Cell::default(); grid.cells.len()];
        paint[most] = of_slot(0, 12 * grid.cells.capacities[most]);
        paint[least] = of_slot(1, 4 * grid.cells.capacities[least]);
        let mut spilling = Spilling::new(&grid.cells, 1.0, 0.04, 0.0).unwrap();
        let born = spilling.step((&grid.graph, &grid.cells), &mut paint, true);
        let birth = Birth { cell: middle as u32, giver: most as u32 };
        assert!(born.contains(&birth), "{birth:?} of {born:?}");
    }
}

#[test]
fn with_a_slope_paint_runs_down() {
    let tilted = sheet(1, |u, v| [16.0 * u, 8.0 * v, 16.0 * v]);
    let grid = Grid::of(&tilted, 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let source = cell_at(&grid, [8.0, 4.0, 8.0]);
    let [level, steep] = [0.0, 20.0].map(|slope: f32| {
        let mut paint = vec![Cell::default(); grid.cells.len()];
        paint[source] = of_slot(0, grid.cells.room(source));
        let mut spilling = Spilling::new(&grid.cells, 1.0, 0.04, slope).unwrap();
        for _ in 0..600 {
            spilling.step((&grid.graph, &grid.cells), &mut paint, true);
        }
        let all: f64 = paint.iter().map(|own| f64::from(own.volume())).sum();
        let heights = paint.iter().zip(&grid.cells.centers);
        heights.map(|(own, at)| f64::from(own.volume()) * f64::from(at.y)).sum::<f64>() / all
    });
    assert!((level - 4.0).abs() < 0.4, "{level}");
    assert!(steep < level - 0.6, "{steep} {level}");
}

fn held(grid: &Grid, paint: &[Cell]) -> Vec<Vec3> {
    let wet = (0..grid.cells.len()).filter(|&cell| paint[cell].volume() > 0);
    let balls: Vec<(Vec3, f32)> = wet
        .map(|cell| (grid.cells.centers[cell], grid.reach.radius(cell, paint[cell].volume(), 0.0)))
        .collect();
    grid.samples
        .places
        .iter()
        .filter(|at: &&Vec3| balls.iter().any(|(from, radius)| at.distance(*from) < *radius))
        .copied()
        .collect()
}

#[test]
fn paint_spreads_in_a_circle_and_its_area_grows_with_its_amount() {
    let grid = Grid::of(&level(40.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let source = cell_at(&grid, [20.1, 0.0, 20.1]);
    let middle = grid.cells.centers[source];
    let mut paint = vec![Cell::default(); grid.cells.len()];
    let mut spilling = Spilling::new(&grid.cells, 1.0, 0.04, 0.0).unwrap();
    let mut figures = Vec::new();
    for _ in 0..3 {
        for step in 0..2400 {
            if step < 600 {
                paint[source] = paint[source].plus(&of_slot(0, QUANTA_PER_FACE / 2));
            }
            spilling.step((&grid.graph, &grid.cells), &mut paint, true);
        }
        let poured = totals(&paint)[0] as f64 / f64::from(QUANTA_PER_FACE);
        let held = held(&grid, &paint);
        let of_sample = f64::from(grid.samples.areas[0]);
        let area = held.len() as f64 * of_sample;
        let mut sectors = [0.0; 16];
        for at in &held {
            let turn = (at.z - middle.z).atan2(at.x - middle.x) / std::f32::consts::TAU + 0.5;
            sectors[((turn * 16.0) as usize).min(15)] += of_sample;
        }
        let equal = area / 16.0;
        for sector in sectors {
            let rim = (sector / equal).sqrt();
            assert!((0.92..1.06).contains(&rim), "{rim} of the equal-area radius");
        }
        figures.push((poured, area));
    }
    for pair in figures.windows(2) {
        let growth = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
        assert!((0.97..1.03).contains(&growth), "{growth}");
    }
}

#[test]
fn full_cells_cover_all_surface() {
    for shape in SampleModel::ALL {
        let mesh = shape.mesh(6000);
        let [low, high] = mesh.bounds();
        let cell = (high - low).max_element() / 12.0;
        let grid = Grid::of(&mesh, cell, SAMPLES_PER_CELL, 1).unwrap();
        // These are other places, four times as many.
        let others = SurfaceSamples::of(&mesh, cell / 2.0, SAMPLES_PER_CELL, 99).unwrap();
        let radii: Vec<f32> = (0..grid.cells.len())
            .map(|cell| grid.reach.radius(cell, grid.cells.capacities[cell], 0.0))
            .collect();
        let bare = others.places.iter().filter(|at| {
            !grid
                .cells
                .centers
                .iter()
                .zip(&radii)
                .any(|(center, radius)| at.distance(*center) < *radius)
        });
        assert_eq!(bare.count(), 0, "{}", shape.name());
    }
}

#[test]
fn a_film_stays_as_thick_while_its_area_grows() {
    let grid = Grid::of(&level(12.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let cell = cell_at(&grid, [6.0, 0.0, 6.0]);
    let capacity = grid.cells.capacities[cell];
    for share in [0.3, 0.5, 0.7] {
        let amount = (f64::from(capacity) * share) as u32;
        let radius = f64::from(grid.reach.radius(cell, amount, 0.18));
        let flat = (f64::from(amount) / f64::from(QUANTA_PER_FACE) / std::f64::consts::PI).sqrt();
        assert!((radius / flat - 1.0).abs() < 0.08, "{share}: {radius} for {flat}");
    }
    assert_eq!(grid.reach.radius(cell, 0, 0.18), 0.0);
    let [full, over] = [1, 3].map(|films| grid.reach.radius(cell, films * capacity, 0.18));
    assert_eq!(full, over);
    assert!(full > 0.75 / 0.82 && full < 1.1);
}

#[test]
fn regions_cut_cells_out() {
    let grid = Grid::of(&level(12.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let kept = grid.within(|at| at.x < 6.0);
    assert_eq!(kept.cells.len(), grid.cells.len());
    let mut paint = vec![Cell::default(); grid.cells.len()];
    let at = cell_at(&kept, [3.0, 0.0, 6.0]);
    paint[at] = of_slot(0, 16 * kept.cells.capacities[at]);
    let mut spilling = Spilling::new(&kept.cells, 1.0, 0.06, 0.0).unwrap();
    for _ in 0..500 {
        spilling.step((&kept.graph, &kept.cells), &mut paint, true);
    }
    for (cell, own) in paint.iter().enumerate() {
        let first = grid.samples.places[grid.samples.of_cell(cell)].iter().all(|at| at.x >= 6.0);
        assert_eq!(first, kept.cells.capacities[cell] == 0);
        let mut others = kept.graph.links(cell).map(|link| kept.graph.others[link] as usize);
        assert!(others.all(|other| !first && kept.cells.capacities[other] > 0));
        assert!(!first || own.volume() == 0);
    }
}

#[test]
fn rates_and_slopes_out_of_range_are_refused() {
    let grid = Grid::of(&level(4.0, 0.0, 1), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    for (rate, slope) in [(0.068, 0.0), (-0.1, 0.0), (f32::NAN, 0.0), (0.04, -1.0), (0.04, 1e9)] {
        assert!(Spilling::new(&grid.cells, 1.0, rate, slope).is_err(), "{rate} {slope}");
    }
}

#[test]
fn links_do_not_depend_on_the_cut_into_triangles() {
    for turn in [Vec3::X, Vec3::new(0.8, 0.36, 0.48)] {
        let across = turn.cross(Vec3::new(0.1, -0.2, 0.97)).normalize();
        let grids = [1, 100].map(|squares| {
            let plane = sheet(squares, |u, v| (turn * u * 9.0 + across * v * 9.0).to_array());
            Grid::of(&plane, 1.0, SAMPLES_PER_CELL, 1).unwrap()
        });
        let cells = grids.each_ref().map(|grid: &Grid| {
            (0..grid.cells.len())
                .map(|cell| {
                    grid.samples
                        .lattice
                        .coordinates(grid.samples.places[grid.samples.of_cell(cell).start])
                })
                .collect::<Vec<_>>()
        });
        // A cell with a sliver of surface may have a sample of one cut and none of the other.
        let both: Vec<_> = cells[0].iter().filter(|at| cells[1].contains(at)).collect();
        assert!(both.len() * 20 > cells[0].len() * 19, "{} of {}", both.len(), cells[0].len());
        let [first, second] = [0, 1].map(|which: usize| {
            let of_cell = (0..cells[which].len()).flat_map(|cell| {
                let graph = &grids[which].graph;
                graph.links(cell).map(move |link| (cell, graph.others[link] as usize))
            });
            let mut links: Vec<_> =
                of_cell.map(|(a, b)| [a, b].map(|cell| cells[which][cell])).collect();
            links.retain(|ends| ends.iter().all(|end| both.contains(&end)));
            links.sort_unstable();
            links
        });
        assert_eq!(first, second);
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
    for (sunk, bodies) in [(0.0, 2), (0.1, 2), (0.9, 1), (1.4, 1)] {
        let floor = level(6.0, sunk - 1.0, 12);
        let ball = Mesh::sphere(3000);
        fn moved(mesh: &Mesh, by: Vec3) -> Mesh {
            let mut mesh = mesh.clone();
            mesh.positions.iter_mut().for_each(|at| *at = (Vec3::from(*at) + by).to_array());
            mesh
        }
        let both = joined(moved(&floor, Vec3::new(-3.0, 0.0, -3.0)), &ball);
        let grid = Grid::of(&both, 0.5, SAMPLES_PER_CELL, 1).unwrap();
        let most = grid.bodies.of_triangles.iter().max();
        assert_eq!(most, Some(&bodies), "{sunk}");
        // A pane just over the sheet forms one body with it.
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
    // This has two large triangles per side, 1.2 cells apart at the open end.
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
