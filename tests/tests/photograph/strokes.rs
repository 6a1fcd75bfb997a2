//! Plans the strokes of a layer (direction, geometry, coverage, order and limits), and paints a
//! picture in strokes: the error falls from level to level, and the recorded script gives the same
//! painting.

use std::convert::Infallible;
use std::ops::ControlFlow;

use documents::Task;
use graphics::field::Field;
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::painting::Painting;
use paint::session::{PaintingSession, ReplayReport};
use paint::strokes::{Action, Canvas, PaletteSpec, StrokeScript};
use strokes::{
    LevelReport, Order, Painter, Picture, Plan, PlanError, PlannedStroke, black_compensated,
    plan_layer, rebuild_picture,
};

use crate::made::{HIDING, STUDIO};

const CELL_MM: f64 = 0.5;

/// A plan with two brushes for pictures of 80 x 60 mm.
fn plan() -> Plan {
    Plan { sizes_mm: vec![12.0, 4.0], ..Plan::default() }
}

/// The bare ground as a picture like `picture`.
fn blank(picture: &Picture) -> Picture {
    Field::filled(picture.width(), picture.height(), HIDING.film().rgb(&[0.0; 8]))
}

fn planned(picture: &Picture, level: usize) -> Vec<PlannedStroke> {
    plan_layer(picture, &blank(picture), &HIDING, &plan(), level, CELL_MM)
}

/// A sine grating of brown and cream. Its crests run at `degrees` from x towards y.
fn grating(degrees: f64) -> Picture {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Field::from_values(
        160,
        120,
        (0..160 * 120)
            .map(|i: usize| {
                let x = (i % 160) as f64;
                let y = (i / 160) as f64;
                let share = 0.5 + 0.5 * ((y * cos - x * sin) * 0.25).sin();
                [(0.2, 0.6), (0.15, 0.5), (0.1, 0.35)]
                    .map(|(low, high)| (low + share * (high - low)) as f32)
            })
            .collect(),
    )
}

#[test]
fn strokes_follow_a_grating() {
    for degrees in [0.0, 25.0, 90.0, 140.0_f64] {
        let strokes = planned(&grating(degrees), 1);
        assert!(strokes.len() > 50, "{} strokes", strokes.len());
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut off = Vec::new();
        for stroke in &strokes {
            let first = stroke.samples[0];
            let last = stroke.samples[stroke.samples.len() - 1];
            let x = last.x_mm - first.x_mm;
            let y = last.y_mm - first.y_mm;
            if x.hypot(y) > 3.0 {
                off.push(((y * cos - x * sin) / x.hypot(y)).abs().asin().to_degrees());
            }
        }
        assert!(off.len() > 30, "{} long strokes", off.len());
        off.sort_by(f64::total_cmp);
        assert!(off[off.len() * 9 / 10] < 10.0, "{degrees}: {}", off[off.len() * 9 / 10]);
    }
}

#[test]
fn strokes_stay_near_the_canvas_and_within_the_plan() {
    let picture = grating(60.0);
    for (level, size) in [12.0, 4.0].into_iter().enumerate() {
        let Plan { longest, pressure, lights_mm, .. } = plan();
        for stroke in planned(&picture, level) {
            assert_eq!(stroke.level, level);
            let mut length = 0.0;
            for pair in stroke.samples.windows(2) {
                length += (pair[1].x_mm - pair[0].x_mm).hypot(pair[1].y_mm - pair[0].y_mm);
                assert!(pair[1].seconds > pair[0].seconds);
            }
            assert!(length <= longest * size + 1e-6, "{length} mm by a brush of {size} mm");
            for sample in &stroke.samples {
                assert!((-size..=80.0 + size).contains(&sample.x_mm), "{sample:?}");
                assert!((-size..=60.0 + size).contains(&sample.y_mm), "{sample:?}");
                assert!((0.0..=pressure).contains(&sample.pressure), "{sample:?}");
            }
            let shares: f64 = stroke.recipe.iter().sum();
            assert!((shares - 1.0).abs() < 1e-9 && stroke.recipe.iter().all(|s| *s >= 0.0));
            assert!((0.029_999..=lights_mm).contains(&stroke.height_mm), "{} mm", stroke.height_mm);
            assert!(stroke.amount_mm >= stroke.height_mm, "{} mm", stroke.amount_mm);
        }
    }
}

#[test]
fn pressure_tapers_and_the_broad_side_lies_across() {
    let strokes = planned(&grating(0.0), 1);
    let Plan { pressure, ends, .. } = plan();
    let end = pressure * ends;
    let long = strokes.iter().find(|stroke| stroke.samples.len() > 20).unwrap();
    let pressures: Vec<f64> = long.samples.iter().map(|sample| sample.pressure).collect();
    assert!((pressures[0] - end).abs() < 1e-9 && (pressures[10] - pressure).abs() < 1e-9);
    assert!((pressures[pressures.len() - 1] - end).abs() < 1e-9, "{pressures:?}");
    for sample in &long.samples {
        let across = sample.twist_deg.rem_euclid(180.0);
        assert!((across - 90.0).abs() < 15.0, "{}", sample.twist_deg);
    }
}

#[test]
fn lights_are_thick_and_darks_are_thin() {
    let [lean, light, dark] = [(0, 0.7), (1, 0.7), (1, 0.05)].map(|(level, grey)| {
        let strokes = planned(&Field::filled(160, 120, [grey; 3]), level);
        strokes.iter().map(|stroke| stroke.height_mm).sum::<f64>() / strokes.len() as f64
    });
    assert!(light > 0.15 && dark < light / 1.5, "{light} mm of light, {dark} mm of dark");
    assert!(lean < light, "a first coat of {lean} mm under {light} mm");
}

#[test]
fn no_stroke_bends_tighter_than_its_brush() {
    // Rings around a point become tighter towards it.
    let colors = (0..160 * 120).map(|i| {
        let ring = ((i % 160) as f32 - 80.0).hypot((i / 160) as f32 - 60.0);
        [0.3 + 0.25 * (0.25 * ring).sin(); 3]
    });
    let strokes = planned(&Field::from_values(160, 120, colors.collect()), 0);
    let mut turned = 0.0_f64;
    for stroke in strokes.iter().filter(|stroke| stroke.samples.len() > 4) {
        for four in stroke.samples.windows(3) {
            let [(a, b), (c, d)] = [0, 1].map(|at: usize| {
                (four[at + 1].x_mm - four[at].x_mm, four[at + 1].y_mm - four[at].y_mm)
            });
            let turn = (a * d - b * c).atan2(a * c + b * d).abs();
            turned = turned.max(turn / c.hypot(d));
        }
    }
    assert!((0.5 / 12.0..1.001 / 12.0).contains(&turned), "{turned} radians a mm");
}

#[test]
fn one_level_covers_a_blank_canvas_with_about_two_coats_at_most() {
    let picture = Field::filled(160, 120, [0.25, 0.2, 0.1]);
    let strokes = planned(&picture, 1);
    let mut coats = Field::filled(160, 120, 0_u32);
    let mut area = 0.0;
    for stroke in &strokes {
        for pair in stroke.samples.windows(2) {
            area += 4.0 * (pair[1].x_mm - pair[0].x_mm).hypot(pair[1].y_mm - pair[0].y_mm);
        }
        for sample in &stroke.samples {
            let x = sample.x_mm / CELL_MM;
            let y = sample.y_mm / CELL_MM;
            for row in 0..120 {
                for column in 0..160 {
                    let apart = (column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y);
                    coats[(column, row)] += u32::from(apart <= 4.0);
                }
            }
        }
    }
    let bare = coats.values().iter().filter(|count| **count == 0).count();
    assert!(bare < 160 * 120 / 50, "{bare} bare cells");
    assert!(area < 2.6 * 80.0 * 60.0, "{area} mm2 of strokes");
}

#[test]
fn without_a_difference_there_is_no_stroke() {
    let picture = grating(30.0);
    assert_eq!(plan_layer(&picture, &picture, &HIDING, &plan(), 0, CELL_MM), []);
    // The same holds for a colour out of gamut, if the canvas has the nearest colour of the
    // palette.
    let vivid = Field::filled(160, 120, [0.0, 1.0, 0.0]);
    let reached = rebuild_picture(HIDING.film(), &HIDING.separate(&vivid));
    assert_eq!(plan_layer(&vivid, &reached, &HIDING, &plan(), 1, CELL_MM), []);
    assert_ne!(plan_layer(&vivid, &blank(&vivid), &HIDING, &plan(), 1, CELL_MM), []);
}

#[test]
fn only_what_is_off_is_painted() {
    let picture = grating(0.0);
    let mut current = picture.clone();
    for y in 0..60 {
        current.row_mut(y, 0, 80).fill([0.9; 3]);
    }
    let strokes = plan_layer(&picture, &current, &HIDING, &plan(), 1, CELL_MM);
    assert!(!strokes.is_empty());
    for stroke in strokes {
        let middle = stroke.samples[stroke.samples.len() / 2];
        assert!(middle.x_mm < 46.0 && middle.y_mm < 36.0, "{middle:?}");
    }
}

#[test]
fn the_same_seed_gives_the_same_strokes_and_another_gives_others() {
    let picture = grating(110.0);
    let [one, again, other] = [1, 1, 2].map(|seed| {
        let plan = Plan { seed, ..plan() };
        plan_layer(&picture, &blank(&picture), &HIDING, &plan, 1, CELL_MM)
    });
    assert_eq!(one, again);
    assert_ne!(one, other);
}

#[test]
fn strokes_are_bounded_and_may_go_from_dark_to_light() {
    let picture = grating(45.0);
    let plans = [Plan { most_strokes: 7, ..plan() }, Plan { order: Order::DarkToLight, ..plan() }];
    let [few, strokes] =
        plans.map(|plan| plan_layer(&picture, &blank(&picture), &HIDING, &plan, 1, CELL_MM));
    assert_eq!(few.len(), 7);
    let lightness = strokes.iter().map(|stroke| {
        let heights = stroke.recipe.map(|share| share * stroke.height_mm);
        HIDING.film().lab(&heights).lightness
    });
    for pair in lightness.collect::<Vec<_>>().windows(2) {
        assert!(pair[1] > pair[0] - 5.001);
    }
}

#[test]
fn plans_that_cannot_be_are_refused_by_field() {
    assert_eq!(plan().check(), Ok(()));
    assert_eq!(Plan::for_width(100.0).sizes_mm, [8.0, 4.0, 2.0, 1.0, 0.5]);
    assert_eq!(Plan { sizes_mm: vec![], ..plan() }.check(), Err(PlanError::NoBrush));
    for (plan, wanted) in [
        (Plan { sizes_mm: vec![4.0, f64::NAN], ..plan() }, "sizes_mm"),
        (Plan { longest: 1.0, ..plan() }, "longest"),
        (Plan { pressure: 1.5, ..plan() }, "pressure"),
        (Plan { spacing: 0.0, ..plan() }, "spacing"),
    ] {
        match plan.check() {
            Err(PlanError::Number { field, .. }) => assert_eq!(field, wanted),
            other => panic!("{other:?}"),
        }
    }
}

const PAINTED_CELL_MM: f64 = 0.5;

/// A red disc on blue over ochre, 48 x 36 cells.
fn target() -> Picture {
    let colors = (0..48 * 36).map(|i| {
        let x = (i % 48) as f32 - 20.0;
        let y = (i / 48) as f32 - 16.0;
        match (x.hypot(y) < 9.0, y > 6.0) {
            (true, _) => [0.5, 0.08 + 0.004 * (x + 10.0), 0.06],
            (_, true) => [0.45, 0.3, 0.12],
            _ => [0.12, 0.16, 0.3 + 0.005 * y],
        }
    });
    let picture = Field::from_values(48, 36, colors.collect());
    black_compensated(&picture, HIDING.black())
}

fn coarse_to_fine() -> Plan {
    Plan { sizes_mm: vec![5.0, 2.5, 1.5], seed: 3, ..Plan::default() }
}

/// A script without strokes on a smooth panel.
fn bare_script() -> StrokeScript {
    let canvas =
        r#"{"width_mm": 24, "height_mm": 18, "cell_mm": 0.5, "ground": {"kind": "panel"}}"#;
    let canvas: Canvas = serde_json::from_str(canvas).unwrap();
    let names = STUDIO.slots.iter().flatten().map(|&pigment| STUDIO.library[pigment].name.as_str());
    StrokeScript::new("disc", "CC0-1.0", canvas, PaletteSpec::from_names(names))
}

fn opened(script: &StrokeScript) -> Painting {
    let resolved = script.resolve(&STUDIO.library).unwrap();
    let (width, height) = script.canvas.cells();
    let ground =
        script.canvas.ground.build(width, height, PAINTED_CELL_MM, &STUDIO.library).unwrap();
    let engine = PaintEngine::on_cpu(ground.height.clone());
    Painting::open(script.bare(&STUDIO.library, &resolved, ground), engine, 0).unwrap()
}

struct Finished {
    script: StrokeScript,
    session: PaintingSession,
    levels: Vec<LevelReport>,
    /// Numbers of strokes that were planned and painted, as reported.
    counts: (usize, usize),
}

fn painted(plan: &Plan) -> Finished {
    let mut script = bare_script();
    let mut session = PaintingSession::new(opened(&script), None).unwrap();
    let target = target();
    let painter = Painter { target: &target, separation: &HIDING, plan };
    let task = Task::default();
    let levels = painter.paint(&mut session, &mut script, &task).unwrap();
    let progress = task.progress();
    let counts = (progress.of as usize, progress.done as usize);
    Finished { script, session, levels, counts }
}

fn replayed(text: &str) -> (Document, ReplayReport) {
    let script = StrokeScript::from_json("disc.json", text.as_bytes()).unwrap();
    let mut session = PaintingSession::new(opened(&script), None).unwrap();
    let report = script
        .replay(
            &mut session,
            |_: &str, _: &mut Painting| Ok::<_, Infallible>(()),
            || ControlFlow::Continue(()),
        )
        .unwrap();
    (session.documents().unwrap().0, report)
}

#[test]
fn a_painting_ends_at_a_quarter_of_the_difference_it_began_with() {
    let mut finished = painted(&coarse_to_fine());
    let target = target();
    let plan = coarse_to_fine();
    let painter = Painter { target: &target, separation: &HIDING, plan: &plan };
    let before = painter.errors(&mut opened(&bare_script()), 0.0).unwrap();
    let after = painter.errors(finished.session.canvas_mut(), 0.0).unwrap();
    assert!(after.mean < before.mean / 4.0, "{} of {}", after.mean, before.mean);
    let sizes: Vec<f64> = finished.levels.iter().map(|level| level.size_mm).collect();
    assert_eq!(sizes, plan.sizes_mm);
    for pair in finished.levels.windows(2) {
        assert!(pair[1].mean_error < 1.2 * pair[0].mean_error, "{:?}", finished.levels);
    }
    assert!(
        finished.session.canvas_mut().wet().unwrap().totals().iter().all(|total| *total == 0),
        "paint is still wet"
    );
}

#[test]
fn a_ground_of_the_color_of_the_picture_is_covered() {
    let bare = opened(&bare_script()).flat_picture().unwrap();
    let ground = bare.values()[0];
    let target = Field::filled(48, 36, [ground[0], ground[1], ground[2]]);
    let plan = coarse_to_fine();
    let painter = Painter { target: &target, separation: &HIDING, plan: &plan };
    let mut script = bare_script();
    let mut session = PaintingSession::new(opened(&script), None).unwrap();
    painter.paint(&mut session, &mut script, &Task::default()).unwrap();
    let layers = session.canvas_mut().document().unwrap().dry;
    let covered = (0..48 * 36)
        .filter(|&cell| layers.iter().any(|layer| layer.paint.cell(cell).volume() > 0))
        .count();
    assert!(covered > 48 * 36 * 98 / 100, "{covered} of {} cells", 48 * 36);
}

#[test]
fn the_recorded_strokes_paint_the_same_bit_for_bit() {
    let mut finished = painted(&coarse_to_fine());
    let strokes = finished.script.actions.iter().filter(|a| a.kind() == "stroke").count();
    let laid: u64 = finished.levels.iter().map(|level| level.strokes).sum();
    assert!(strokes > 20, "{strokes} strokes");
    assert_eq!((strokes, strokes), finished.counts);
    let text = finished.script.to_json().unwrap();
    let (document, report) = replayed(&text);
    let wanted = finished.session.canvas_mut().document().unwrap();
    assert!(wanted.dry.len() >= 3, "{} dry layers", wanted.dry.len());
    assert!(document.wet == wanted.wet && document.dry == wanted.dry, "the paintings differ");
    assert_eq!((report.strokes, report.strokes), (laid, strokes as u64));
    // The brush is washed and loaded before every stroke.
    for actions in finished.script.actions.windows(3) {
        if let [first, Action::Load(load), stroke] = actions {
            assert_eq!((first.kind(), stroke.kind()), ("wash", "stroke"));
            assert!(load.amount_mm > 0.0 && load.recipe.values().all(|part| *part >= 1e-6));
        }
    }
}

#[test]
fn a_seed_gives_the_same_bytes_and_another_gives_others() {
    let [first, again, other] =
        [3, 3, 4].map(|seed| painted(&Plan { seed, ..coarse_to_fine() }).script.to_json().unwrap());
    assert!(first == again, "the same seed, another script");
    assert!(first != other, "another seed, the same script");
}

#[test]
fn what_is_as_near_as_the_palette_comes_is_left_alone() {
    let target = target();
    let reached = rebuild_picture(HIDING.film(), &HIDING.separate(&target));
    assert_eq!(plan_layer(&target, &reached, &HIDING, &coarse_to_fine(), 2, PAINTED_CELL_MM), []);
}
