//! Tests of brush heads: footprint, bending, velocity, and extreme poses.

use rand::{RngExt, SeedableRng};

use super::{BrushError, Head, HeadShape, NODES, Relief, SideBySide, StrokeTool};
use crate::amount::QUANTA_PER_CELL;
use crate::contact::{Contact, Touch};
use crate::pose::Pose;
use graphics::tile::Rect;

const BOUNDS: Rect = Rect { x: 0, y: 0, width: 320, height: 240 };
const POSE: Pose = Pose {
    x: 160.4,
    y: 120.4,
    pressure: 0.5,
    tilt_x_deg: 0.0,
    tilt_y_deg: 0.0,
    twist_deg: 0.0,
    speed_mm_s: 0.0,
};

fn head(shape: HeadShape) -> Head {
    Head::new(shape, 4.0, 0.1).unwrap()
}

fn plane() -> Relief {
    Relief::flat(BOUNDS.width, BOUNDS.height, 0.1)
}

fn nothing() -> Contact {
    Contact::default()
}

/// Contact of a new head that is set down in `pose`.
fn set_down(shape: HeadShape, pose: Pose) -> Contact {
    let mut head = head(shape);
    let mut contact = nothing();
    head.set_down(&pose, (0.0, 0.0), &plane());
    head.advance(&pose, &plane(), BOUNDS, &mut contact);
    contact
}

/// Column, row and touch of the cells at which the head is below the top of a film of `mm` mm. We
/// let its hair sink in by half of the allowed depth.
fn under(contact: &Contact, mm: f64) -> Vec<(usize, usize, Touch)> {
    let top = (mm / 0.1 * f64::from(QUANTA_PER_CELL)) as i32 + (contact.rates.sink / 2) as i32;
    let cells = contact.touches.iter().enumerate().filter(|(_, touch)| touch.height <= top);
    let rect = contact.rect;
    cells.map(|(i, &t)| (rect.x + i % rect.width, rect.y + i / rect.width, t)).collect()
}

fn mean_x(cells: &[(usize, usize, Touch)]) -> f64 {
    cells.iter().map(|cell| cell.0 as f64 + 0.5).sum::<f64>() / cells.len() as f64
}

#[test]
fn every_shape_touches_when_pressed_and_never_at_no_pressure() {
    for shape in HeadShape::ALL {
        for (tilt_x_deg, twist_deg) in [(0.0, 0.0), (40.0, 0.0), (-30.0, 90.0), (90.0, 45.0)] {
            for pressure in [0.2, 0.6, 1.0] {
                let pose = Pose { pressure, tilt_x_deg, twist_deg, ..POSE };
                let cells = under(&set_down(shape, pose), 0.05).len();
                assert!(cells >= 3, "{shape}, {pose:?}: {cells}");
            }
            let lifted = Pose { pressure: 0.0, tilt_x_deg, twist_deg, ..POSE };
            assert_eq!(set_down(shape, lifted), nothing(), "{shape}");
        }
    }
}

#[test]
fn the_smallest_heads_touch_too() {
    for shape in HeadShape::ALL {
        for cell_mm in [0.1, 0.5] {
            let mut head = Head::new(shape, 0.2, cell_mm).unwrap();
            let mut contact = nothing();
            let relief = Relief::flat(320, 240, cell_mm);
            head.advance(&Pose { pressure: 1.0, ..POSE }, &relief, BOUNDS, &mut contact);
            assert!(!under(&contact, 0.0).is_empty(), "{shape} over {cell_mm}");
        }
    }
}

#[test]
fn pressure_widens_the_footprint() {
    for shape in HeadShape::ALL {
        let mut before = 0;
        // A leaning knife may lie flat at any pressure.
        let tilt_y_deg = if shape == HeadShape::Knife { 0.0 } else { 20.0 };
        for step in 1..=10 {
            let pose = Pose { pressure: f64::from(step) / 10.0, tilt_y_deg, ..POSE };
            let cells = under(&set_down(shape, pose), 0.2).len();
            assert!(cells * 20 >= before * 19, "{shape} at {step}: {cells} after {before}");
            before = cells;
        }
        let light = Pose { pressure: 0.1, tilt_y_deg, ..POSE };
        let cells = under(&set_down(shape, light), 0.2).len();
        assert!(before > 2 * cells, "{shape}: {before} after {cells}");
    }
}

#[test]
fn the_tip_trails_behind_the_motion() {
    for shape in HeadShape::ALL.into_iter().filter(|&shape| shape != HeadShape::Knife) {
        for way in [1.0, -1.0] {
            let mut head = head(shape);
            let mut contact = nothing();
            head.set_down(&pose_at(0.0, way), (-way, 0.0), &plane());
            for step in 0..=90 {
                head.advance(&pose_at(f64::from(step), way), &plane(), BOUNDS, &mut contact);
            }
            let behind = f64::from(head.spines.node(0, 0).x - head.spines.node(0, NODES - 1).x);
            assert!(behind * way > 5.0, "{shape}, {way}: {behind}");
            // The pen leads the place where the hair touches.
            let middle = mean_x(&under(&contact, 0.0));
            assert!((middle - 160.0).abs() < 5.0, "{shape}, {way}: {middle}");
        }

        /// Pose at `step` of a stroke along x in the direction `way`. Before it, the head is set
        /// down bent for the opposite direction.
        fn pose_at(step: f64, way: f64) -> Pose {
            Pose { x: 160.0 + way * (step - 90.0), twist_deg: 90.0, ..POSE }
        }
    }
}

#[test]
fn the_surface_moves_with_the_handle() {
    let mut head = head(HeadShape::Flat);
    let mut contact = nothing();
    for step in 0..100 {
        let pose = Pose { x: 60.0 + f64::from(step), twist_deg: 90.0, ..POSE };
        head.advance(&pose, &plane(), BOUNDS, &mut contact);
    }
    let rows = under(&contact, 0.0).into_iter().map(|(_, y, _)| y);
    let first = rows.clone().min().unwrap();
    let last = rows.max().unwrap();
    // At its sides the surface is slowed, see `sides`.
    for (x, y, touch) in
        under(&contact, 0.0).into_iter().filter(|(_, y, _)| (first + 2..last - 1).contains(y))
    {
        let (right, down) = touch.velocity();
        let grasp = touch.transfer_weight() as i32;
        assert!((right - grasp).abs() < 8 && down.abs() < 8, "{x} {y}: {right} {down}, {grasp}");
    }
    let cells = under(&contact, 0.0);
    assert!(
        cells
            .iter()
            .filter(|cell: &&(usize, usize, Touch)| cell.2.transfer_weight() == 256)
            .count()
            * 2
            > cells.len(),
        "hair hardly grasps paint"
    );
    // At rest the head exchanges no paint.
    let rest = Pose { x: 159.0, twist_deg: 90.0, ..POSE };
    for _ in 0..100 {
        head.advance(&rest, &plane(), BOUNDS, &mut contact);
    }
    assert!(under(&contact, 0.0).iter().all(|cell| cell.2.transfer_weight() == 0));
}

#[test]
fn a_head_set_down_leaning_lies_away_from_the_lean() {
    for shape in HeadShape::ALL {
        for (tilt_y_deg, side) in [(30.0, 1.0), (-30.0, -1.0)] {
            let mut head = head(shape);
            head.set_down(&Pose { tilt_y_deg, ..POSE }, (0.0, 0.0), &plane());
            let over = head.spines.node(0, 0).y - head.spines.node(0, NODES - 1).y;
            assert!(over * side > 2.0, "{shape}, {tilt_y_deg}: {over}");
        }
    }
}

#[test]
fn a_blade_that_turns_over_does_not_sweep_the_paint() {
    let mut head = head(HeadShape::Knife);
    let mut contact = nothing();
    for tilt_y_deg in [20.0, -20.0, -20.0] {
        head.advance(&Pose { tilt_y_deg, ..POSE }, &plane(), BOUNDS, &mut contact);
    }
    head.advance(&Pose { tilt_y_deg: 20.0, ..POSE }, &plane(), BOUNDS, &mut contact);
    let cells = under(&contact, 0.0);
    assert!(cells.len() > 20 && cells.iter().all(|cell| cell.2.velocity() == (0, 0)), "{cells:?}");
}

#[test]
fn whole_cells_of_way_move_the_contact_and_nothing_else() {
    let here = played(0, 0);
    assert!(!here.rect.is_empty());
    for (right, down) in [(1, 0), (77, 13), (-8, -20)] {
        let there = played(right, down);
        let x = (here.rect.x as i32 + right) as usize;
        let y = (here.rect.y as i32 + down) as usize;
        assert_eq!(there.rect, Rect { x, y, ..here.rect });
        // The locks of hair are others, as the stroke begins elsewhere.
        for (there, here) in there.touches.iter().zip(&here.touches) {
            let found = (there.brush_cell, there.velocity, there.sharers());
            assert_eq!(found, (here.brush_cell, here.velocity, here.sharers()));
        }
    }
}

fn played(right: i32, down: i32) -> Contact {
    let mut head = head(HeadShape::Filbert);
    let mut contact = nothing();
    for step in 0..40 {
        let t = f64::from(step);
        let x = 70.3 + f64::from(right) + 0.83 * t;
        let y = 90.7 + f64::from(down) + 0.4 * t;
        let pose = Pose { x, y, tilt_x_deg: t, twist_deg: 2.0 * t, ..POSE };
        head.advance(&pose, &plane(), BOUNDS, &mut contact);
    }
    contact
}

#[test]
fn touches_over_the_edge_are_cut_off_and_the_rest_stays() {
    for shape in HeadShape::ALL {
        let pose = Pose { pressure: 0.8, tilt_y_deg: 15.0, ..POSE };
        let whole = under(&set_down(shape, pose), 0.0);
        let edge = mean_x(&whole) as usize;
        let half = Rect { x: 0, y: 0, width: edge, height: 240 };
        let mut head = head(shape);
        let mut cut = nothing();
        head.set_down(&pose, (0.0, 0.0), &plane());
        head.advance(&pose, &plane(), half, &mut cut);
        assert!(cut.rect.x + cut.rect.width <= edge, "{shape}: {:?}", cut.rect);
        let kept: Vec<_> = whole.into_iter().filter(|cell| cell.0 < edge).collect();
        let found = under(&cut, 0.0);
        assert_eq!(found.len(), kept.len(), "{shape}");
        for (found, kept) in found.iter().zip(&kept) {
            // This tolerance in quanta allows for the rounding of sums that start at another cell.
            assert!((found.2.height - kept.2.height).abs() < 200, "{shape}: {found:?}, {kept:?}");
        }
        head.advance(&pose, &plane(), Rect { x: 4000, ..half }, &mut cut);
        assert_eq!((cut.rect, cut.touches), (Rect::default(), Vec::new()), "{shape}");
    }
}

#[test]
fn paint_flows_along_the_hair_off_the_canvas_but_not_in_the_air() {
    let mut head = head(HeadShape::Flat);
    let mut contact = nothing();
    let off = Rect { x: 4000, ..BOUNDS };
    head.advance(&POSE, &plane(), off, &mut contact);
    assert!(contact.wicking.share > 0 && contact.rect.is_empty(), "{contact:?}");
    head.advance(&Pose { pressure: 0.0, ..POSE }, &plane(), off, &mut contact);
    assert_eq!(contact, nothing());
}

#[test]
fn hair_is_uneven_across_a_flat_and_a_blade_is_not() {
    let [flat, knife] = [HeadShape::Flat, HeadShape::Knife].map(|shape| {
        let cells = under(&set_down(shape, POSE), 0.0);
        let beside = cells.windows(2).filter(|w| w[0].1 == w[1].1 && w[0].0 + 1 == w[1].0);
        let steps: Vec<f64> =
            beside.map(|w| f64::from((w[0].2.height - w[1].2.height).abs())).collect();
        steps.iter().sum::<f64>() / steps.len() as f64 / f64::from(QUANTA_PER_CELL)
    });
    assert!(flat > 0.02 && flat > 2.0 * knife, "{flat} cells, {knife}");
}

#[test]
fn sharers_are_those_that_name_the_same_cell() {
    for shape in HeadShape::ALL {
        let contact = set_down(shape, Pose { pressure: 0.9, twist_deg: 33.0, ..POSE });
        let (width, height) = head(shape).paint_grid();
        let mut count = vec![0; width * height];
        let touches = contact.touches.iter().filter(|t| t.height != Touch::NONE.height);
        let touches: Vec<&Touch> = touches.collect();
        for touch in &touches {
            count[touch.brush_cell as usize] += 1;
        }
        assert!(touches.len() > 20, "{shape}");
        for touch in touches {
            assert_eq!(touch.sharers(), count[touch.brush_cell as usize], "{shape}");
        }
    }
}

#[test]
fn a_round_leaves_no_hole_in_its_footprint() {
    for twist in 0..30 {
        let pose = Pose { pressure: 0.9, twist_deg: 3.7 * f64::from(twist), ..POSE };
        let cells = under(&set_down(HeadShape::Round, pose), 0.5);
        for y in 0..BOUNDS.height {
            let row: Vec<usize> = cells.iter().filter(|c| c.1 == y).map(|c| c.0).collect();
            let span = row.last().map_or(0, |last| last - row[0] + 1);
            assert_eq!(row.len(), span, "row {y} at {pose:?}");
        }
    }
}

#[test]
fn light_pressure_spares_the_valleys_of_a_weave_and_full_pressure_fills_most() {
    let floor = graphics::field::Field::from_values(
        320,
        240,
        (0..320 * 240)
            .map(|i: usize| {
                if (i % 320 / 2 + i / 320 / 2).is_multiple_of(2) {
                    0
                } else {
                    QUANTA_PER_CELL as i32
                }
            })
            .collect(),
    );
    let relief = Relief::from_floor(&floor, 0.1);
    let touched = |pressure: f64| {
        let mut head = head(HeadShape::Flat);
        let mut contact = nothing();
        let pose = Pose { pressure, ..POSE };
        head.set_down(&pose, (0.0, 1.0), &relief);
        head.advance(&pose, &relief, BOUNDS, &mut contact);
        let cells = under(&contact, 10.0);
        let sink = contact.rates.sink as i32;
        [true, false].map(|valley| {
            let side = cells.iter().filter(|c| (floor[(c.0, c.1)] == 0) == valley);
            side.filter(|c| c.2.height - sink <= floor[(c.0, c.1)]).count()
        })
    };
    let [valleys, crests] = touched(0.35);
    assert!(valleys == 0 && crests > 20, "{valleys} {crests}");
    let [valleys, crests] = touched(1.0);
    // Some do not: bristles that draw back do not reach the bottom of valleys this deep.
    assert!(valleys * 10 > crests * 6, "{valleys} {crests}");
}

#[test]
fn heads_stay_finite_and_alike_in_hostile_hands() {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let odd = [f64::NAN, f64::INFINITY, -1e300, 1e300, 1e9, -90.0, 90.0, 0.0];
    let mut floor = graphics::field::Field::filled(320, 240, 0);
    for height in floor.values_mut() {
        *height = random.random_range(0..QUANTA_PER_CELL as i32 * 30);
    }
    let relief = Relief::from_floor(&floor, 0.1);
    for round in 0..1000 {
        let shape = HeadShape::ALL[round % 8];
        let mut one = Head::new(shape, 1.5, 0.1).unwrap();
        let mut contact = nothing();
        let mut two = one.clone();
        let mut again = nothing();
        for _ in 0..12 {
            let mut number = |scale: f64, middle: f64| match random.random_range(0..12) {
                0 => odd[random.random_range(0..odd.len())],
                _ => middle + scale * (random.random::<f64>() - 0.5),
            };
            let pose = Pose {
                x: number(100.0, 160.0),
                y: number(100.0, 120.0),
                pressure: number(1.2, 0.5),
                tilt_x_deg: number(200.0, 0.0),
                tilt_y_deg: number(200.0, 0.0),
                twist_deg: number(1000.0, 0.0),
                speed_mm_s: number(4000.0, 1000.0),
            };
            one.advance(&pose, &relief, BOUNDS, &mut contact);
            two.advance(&pose, &relief, BOUNDS, &mut again);
            assert!(contact == again, "round {round}: {pose:?}");
            let nodes = one.spines.nodes.iter().flat_map(|node| [node.x, node.y, node.z]);
            assert!(nodes.into_iter().all(f32::is_finite), "round {round}: {pose:?}");
            assert_eq!(contact.touches.len(), contact.rect.width * contact.rect.height);
            let (width, height) = one.paint_grid();
            for touch in contact.touches.iter().filter(|t| t.height != Touch::NONE.height) {
                assert!((touch.brush_cell as usize) < width * height, "round {round}");
                // Nothing lies below the relief.
                assert!(touch.height >= 0, "{pose:?}: {touch:?}");
            }
        }
    }
}

#[test]
fn heads_that_cannot_be_are_refused() {
    for size_mm in [0.0, 0.19, 100.1, f64::NAN, -1.0] {
        let error = Head::new(HeadShape::Flat, size_mm, 0.1).unwrap_err();
        assert!(matches!(error, BrushError::Size(..)), "{error}");
    }
    assert!(matches!(Head::new(HeadShape::Mop, 1.0, 0.0), Err(BrushError::Cell(..))));
    assert!(matches!(Head::new(HeadShape::Mop, 90.0, 0.01), Err(BrushError::TooFine { .. })));
    assert!(Head::new(HeadShape::Rigger, 100.0, 0.1).is_ok());
}

#[test]
fn sub_steps_drawn_side_by_side_are_those_drawn_one_after_another() {
    let random = &mut rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let mut floor = graphics::field::Field::filled(320, 240, 0);
    for height in floor.values_mut() {
        *height = random.random_range(0..QUANTA_PER_CELL as i32 * 2);
    }
    let relief = Relief::from_floor(&floor, 0.1);
    let blend = StrokeTool::Blend { strength: 0.7 };
    for (shape, tool) in
        HeadShape::ALL.into_iter().zip([StrokeTool::Paint, blend].into_iter().cycle())
    {
        // Lifted at times, and moved so far that it is set down anew.
        let mut poses = Vec::new();
        for step in 0..120 {
            let pressure = if step % 37 == 20 { 0.0 } else { random.random_range(0.3..1.0) };
            let far = if step > 60 { 100.0 } else { 0.0 };
            let x = 60.0 + far + 0.8 * f64::from(step);
            let y = 120.0 + 0.3 * f64::from(step % 40);
            poses.push(Pose { x, y, pressure, twist_deg: 0.5 * f64::from(step), ..POSE });
        }
        let mut one = head(shape);
        let mut other = head(shape);
        let mut several = SideBySide::default();
        let mut place = 0;
        while place < poses.len() {
            let now = &poses[place..(place + random.random_range(1..6)).min(poses.len())];
            let mut drawn = vec![nothing(); now.len()];
            several.advance_as((&mut other, tool), now, &relief, BOUNDS, &mut drawn);
            for (pose, drawn) in now.iter().zip(&drawn) {
                let mut contact = nothing();
                one.advance_as(tool, pose, &relief, BOUNDS, &mut contact);
                assert_eq!(drawn, &contact, "{shape}, {pose:?}");
            }
            place += now.len();
        }
    }
}
