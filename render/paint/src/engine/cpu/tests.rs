//! Tests of the paint engine on the processor. We check sub-steps with random contacts against a
//! slow reference, which we wrote from the specification in [`crate::motion`], and also drying,
//! layers, undo and rendering.

use graphics::field::Field;
use graphics::tile::{Rect, Tile, TileSet};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::CpuPaint;
use super::columns::HeadPaint;
use super::wick::Wick;
use crate::amount::{MAX_COLUMN, QUANTA_PER_CELL};
use crate::contact::{Contact, ExchangeRates, Touch, Wicking};
use crate::engine::cpu::penetration::Below;
use crate::engine::{BrushId, UndoSlot, View};
use crate::layer::{Cell, Layer, SLOTS};
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::motion::advect::{mobile_share, outflow};
use crate::motion::press::{
    CROWDED_VOLUME, Column, NO_CONTACT, avoid_crowded_columns, coat, dragged, flow, penetration,
    pressure, velocity,
};
use crate::motion::skin::{drying, stirred};
use crate::motion::transfer::{Exchange, exchange, leaving};
use crate::optics::{Gloss, Lamp, LayerOptics, NODES, Scene, SceneSurface};

/// Operations on the whole canvas, as [`crate::engine::PaintEngine`] has them.
impl CpuPaint {
    fn wet(&self) -> Layer {
        self.wet_in(self.bounds())
    }

    fn set_wet(&mut self, layer: &Layer) {
        self.set_wet_in(self.bounds(), layer);
    }

    fn dry_layer(&self, index: usize) -> Layer {
        self.dry_layer_in(index, self.bounds())
    }

    fn picture(&mut self) -> Field<[f32; 4]> {
        self.picture_in(View::First, self.bounds())
    }
}

const BRUSH: BrushId = BrushId(0);

fn random_layer(random: &mut ChaCha8Rng, width: usize, height: usize, highest: u32) -> Layer {
    let mut layer = Layer::empty(width, height);
    for index in 0..width * height {
        // A third of the cells stay bare, and most pigments are in few cells.
        if random.random_range(0..3) > 0 {
            let [pigments @ .., vehicle]: [u32; SLOTS + 1] =
                std::array::from_fn(|_| match random.random_range(0..4) {
                    0 => random.random_range(0..=highest / 9),
                    1 => random.random_range(0..100),
                    _ => 0,
                });
            layer.set_cell(index, Cell { pigments, vehicle });
        }
    }
    layer
}

/// A random layer in which a part of the cells has a skin.
fn random_films(random: &mut ChaCha8Rng, width: usize, height: usize, highest: u32) -> Layer {
    let mut layer = random_layer(random, width, height, highest / 2);
    let skin = random_layer(random, width, height, highest / 2);
    for index in (0..width * height).filter(|index| index / 5 % 3 > 0) {
        layer.set_films(index, [layer.cell(index), skin.cell(index)]);
    }
    layer
}

/// An engine with random paint up to four cells high on its canvas and on its brush.
fn painted(random: &mut ChaCha8Rng, canvas: (usize, usize), brush: (usize, usize)) -> CpuPaint {
    painted_to(4 * QUANTA_PER_CELL, random, canvas, brush)
}

/// An engine like [`painted`], but with paint on the canvas up to `highest` quanta high.
fn painted_to(
    highest: u32,
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
) -> CpuPaint {
    let heights = (0..canvas.0 * canvas.1).map(|_| random.random_range(-9999..300_000)).collect();
    let mut engine = CpuPaint::new(Field::from_values(canvas.0, canvas.1, heights));
    let wet = random_films(random, canvas.0, canvas.1, highest);
    engine.set_wet(&wet);
    engine.add_brush(brush.0, brush.1);
    let paint = random_layer(random, brush.0, brush.1, 4 * QUANTA_PER_CELL);
    engine.set_brush_paint(BRUSH, &paint);
    engine
}

/// A random contact of a head with holes. Each head cell covers up to 3 x 3 canvas cells. `speed`,
/// in parts of 256, is random if `None`.
fn random_contact(
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
    speed: Option<u16>,
) -> Contact {
    let width = random.random_range(1..=canvas.0.min(40));
    let height = random.random_range(1..=canvas.1.min(40));
    let x = random.random_range(0..=canvas.0 - width);
    let y = random.random_range(0..=canvas.1 - height);
    let coarse = random.random_range(1..=3);
    let cell = |i: usize| {
        ((i / width) / coarse % brush.1 * brush.0 + (i % width) / coarse % brush.0) as u32
    };
    let mut sharers = vec![0_u16; brush.0 * brush.1];
    (0..width * height).for_each(|i| sharers[cell(i) as usize] += 1);
    let lowest = random.random_range(-1..=2) * QUANTA_PER_CELL as i32;
    // Half of the heads are stripes across the rows.
    let stripes = random.random_bool(0.5);
    let touches = (0..width * height).map(|i| {
        let between = stripes && (i % width + 2 * (i / width)) % 16 > 3;
        if between || random.random_range(0..5) == 0 {
            return Touch::NONE;
        }
        let height = lowest + random.random_range(0..2 * QUANTA_PER_CELL as i32);
        let velocity = (random.random_range(-300..=300), random.random_range(-300..=300));
        let speed = speed.unwrap_or_else(|| random.random_range(0..=256));
        let mut touch = Touch::new(height, cell(i), velocity, speed, sharers[cell(i) as usize]);
        touch.set_release(random.random_range(0..128));
        touch
    });
    let touches = touches.collect();
    let mut share = || [0, 700, 65536, random.random_range(0..=65536)][random.random_range(0..4)];
    let wicking = Wicking {
        share: share(),
        first_row: share() % 3,
        hairs: share() % 4,
        ..Wicking::default()
    };
    let rates = ExchangeRates {
        release: share(),
        film: share(),
        deposit: share(),
        pick_up: share(),
        mixing: share(),
        sink: 8 * share(),
        drag: share() >> 8,
        bearing: share(),
        shear: share(),
        held: 8 * share(),
        carried: 8 * share(),
        padding: 0,
    };
    Contact { rect: Rect { x, y, width, height }, touches, rates, wicking }
}

fn totals(engine: &mut CpuPaint) -> [u64; SLOTS + 1] {
    let wet = engine.wet().totals();
    let brush = engine.brush_paint(BRUSH).totals();
    std::array::from_fn(|i| wet[i] + brush[i])
}

#[test]
fn over_ten_thousand_sub_steps_no_pigment_is_lost_or_made_and_no_cell_is_overfull() {
    let random = &mut ChaCha8Rng::seed_from_u64(1);
    let canvas = (60, 44);
    let brush = (24, 17);
    let mut engine = painted(random, canvas, brush);
    let before = totals(&mut engine);
    for _ in 0..100 {
        let contacts: Vec<_> =
            (0..100).map(|_| random_contact(random, canvas, brush, None)).collect();
        engine.apply_contacts(BRUSH, &MotionConstants::new(0.1, 0.7), &contacts);
    }
    assert_eq!(totals(&mut engine), before);
    let wet = engine.wet();
    let highest = (0..60 * 44).map(|i| wet.cell(i).volume()).max();
    assert!(highest.is_some_and(|highest| highest <= MAX_COLUMN), "{highest:?} in a cell");
}

#[test]
fn the_fast_path_agrees_with_the_specification() {
    let random = &mut ChaCha8Rng::seed_from_u64(2);
    let low = 4 * QUANTA_PER_CELL;
    for (canvas, highest) in [
        ((50, 30), low),
        ((7, 90), low),
        ((1, 1), low),
        ((3, 2), low),
        ((90, 90), low),
        ((50, 30), 4 * CROWDED_VOLUME),
        ((1, 9), 4 * CROWDED_VOLUME),
    ] {
        let brush = (11, 13);
        let mut engine = painted_to(highest, random, canvas, brush);
        let masks = [None, Some(Mask::with_open(engine.bounds(), |cell| cell % 11 < 7))];
        let motions = [
            MotionConstants::new(0.1, 0.7),
            MotionConstants {
                push_share: 8192,
                squeeze_share: 65536,
                yield_quanta: 0,
                levelling_share: 8192,
                adhesion_quanta: 65535,
                everywhere: 0,
                skin_quanta: 100_000,
                padding: 0,
            },
            MotionConstants {
                push_share: 0,
                squeeze_share: 0,
                yield_quanta: 1 << 31,
                levelling_share: 0,
                adhesion_quanta: 0,
                everywhere: 1,
                skin_quanta: 0,
                padding: 0,
            },
        ];
        for (i, motion) in motions.iter().cycle().take(60).enumerate() {
            if i % 7 == 3 {
                engine.note_bed(engine.bounds(), motion);
            }
            engine.set_mask(masks[i / 5 % 2].as_ref());
            let contact = random_contact(random, canvas, brush, None);
            let mut wet = engine.wet();
            let mut head = engine.brushes[BRUSH.0].clone();
            let floor = engine.floor();
            let below = Below { floor: &floor, bed: &engine.bed, mask: engine.mask.as_ref() };
            sub_step(motion, &contact, below, &mut wet, &mut head);
            engine.apply_contacts(BRUSH, motion, &[contact]);
            assert!(engine.wet() == wet, "canvas {canvas:?}, sub-step {i}");
            assert!(engine.brush_paint(BRUSH) == *head.cells.layer(), "brush, sub-step {i}");
            let columns = (0..wet.vehicle.values().len()).map(|at| wet.cell(at).volume());
            assert!(engine.wet.volume().iter().copied().eq(columns), "volumes, sub-step {i}");
        }
    }
}

#[test]
fn columns_pushed_together_stay_below_full_and_whole() {
    let random = &mut ChaCha8Rng::seed_from_u64(8);
    let canvas = (40, 40);
    let brush = (9, 9);
    let mut engine = CpuPaint::new(Field::filled(40, 40, 0));
    let vehicle = Field::filled(40, 40, CROWDED_VOLUME - 1);
    let wet = Layer { vehicle, ..Layer::empty(40, 40) };
    engine.set_wet(&wet);
    engine.add_brush(brush.0, brush.1);
    let before = totals(&mut engine);
    let pushy =
        MotionConstants { push_share: 8192, yield_quanta: 0, ..MotionConstants::new(0.1, 0.7) };
    for _ in 0..400 {
        let contact = random_contact(random, canvas, brush, None);
        engine.apply_contacts(BRUSH, &pushy, &[contact]);
    }
    let wet = engine.wet();
    let highest = (0..40 * 40).map(|i| wet.cell(i).volume()).max().expect("cells");
    assert!((CROWDED_VOLUME..MAX_COLUMN).contains(&highest), "{highest} in a cell");
    assert_eq!(totals(&mut engine), before);
}

#[test]
fn a_still_brush_moves_no_paint_across_sides_and_leaves_the_adhesion() {
    let random = &mut ChaCha8Rng::seed_from_u64(3);
    let canvas = (40, 40);
    let brush = (9, 9);
    let mut engine = painted(random, canvas, brush);
    let motion = MotionConstants::new(0.1, 0.7);
    let head = engine.brush_paint(BRUSH);
    for _ in 0..200 {
        let before = engine.wet();
        let mut contact = random_contact(random, (38, 38), brush, Some(0));
        // Paint goes up onto a head that drags it over the edge, and flows along still hair.
        (contact.rect.x, contact.rect.y) = (contact.rect.x + 1, contact.rect.y + 1);
        contact.wicking = Wicking::default();
        engine.apply_contacts(BRUSH, &motion, &[contact]);
        let after = engine.wet();
        for index in 0..canvas.0 * canvas.1 {
            let stays = before.cell(index).volume().min(motion.adhesion_quanta);
            let volume = after.cell(index).volume();
            assert!(volume >= stays, "cell {index}: {volume} of {stays}");
        }
    }
    assert!(engine.brush_paint(BRUSH) == head, "the head's paint changed");
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let alone = played_on(1);
    for threads in [2, 3, 5] {
        assert!(played_on(threads) == alone, "{threads} threads");
    }
}

fn played_on(threads: usize) -> (Layer, Layer) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let random = &mut ChaCha8Rng::seed_from_u64(4);
        let canvas = (150, 130);
        let brush = (60, 60);
        let mut engine = painted(random, canvas, brush);
        let contacts: Vec<_> = (0..20).map(|_| whole_contact(random, canvas, brush)).collect();
        engine.apply_contacts(BRUSH, &MotionConstants::new(0.1, 0.7), &contacts);
        (engine.wet(), engine.brush_paint(BRUSH))
    })
}

/// A contact that repeats a random one over the whole canvas, large enough for many threads.
fn whole_contact(
    random: &mut ChaCha8Rng,
    canvas: (usize, usize),
    brush: (usize, usize),
) -> Contact {
    let part = random_contact(random, (40, 40), brush, None);
    let touches = (0..canvas.0 * canvas.1).map(|i| {
        let x = i % canvas.0 % part.rect.width;
        let y = i / canvas.0 % part.rect.height;
        let touch = part.touches[y * part.rect.width + x];
        let sharers = (canvas.0 * canvas.1) as u16;
        Touch { weights: touch.weights & 0xffff | u32::from(sharers) << 16, ..touch }
    });
    let rect = Rect { x: 0, y: 0, width: canvas.0, height: canvas.1 };
    Contact { rect, touches: touches.collect(), ..part.clone() }
}

#[test]
fn paint_dragged_over_the_edge_goes_onto_the_head_and_piles_up_nowhere() {
    for velocity in [(256, 256), (-256, 0), (0, -200)] {
        let film = QUANTA_PER_CELL / 4;
        let mut engine = CpuPaint::new(Field::filled(12, 9, 0));
        let vehicle = Field::filled(12, 9, film);
        engine.set_wet(&Layer { vehicle, ..Layer::empty(12, 9) });
        engine.add_brush(1, 1);
        let before = totals(&mut engine);
        let touch = Touch::new(0, 0, velocity, 0, 108);
        let rect = engine.bounds();
        let rates = ExchangeRates { drag: 128, ..ExchangeRates::default() };
        let contact = Contact { rect, touches: vec![touch; 108], rates, ..Contact::default() };
        let mut highest = 0;
        for _ in 0..100 {
            let now = std::slice::from_ref(&contact);
            engine.apply_contacts(BRUSH, &MotionConstants::new(0.1, 0.7), now);
            highest = highest.max(engine.wet.volume().iter().copied().max().unwrap_or(0));
        }
        assert_eq!(totals(&mut engine), before);
        assert!(highest < 10 * film, "{velocity:?}: {} films", highest / film);
        let kept: u64 = engine.brush_paint(BRUSH).totals().iter().sum();
        let all: u64 = before.iter().sum();
        assert!(kept * 10 > all * 9, "{velocity:?}: {kept} of {all} quanta on the head");
    }
}

const WIDTH: usize = 150;
const HEIGHT: usize = 100;

/// Paint in the cells of `rect` only, with different amounts in each cell.
fn paint_in(rect: Rect) -> Layer {
    let mut layer = Layer::empty(WIDTH, HEIGHT);
    for y in rect.y..rect.y + rect.height {
        for x in rect.x..rect.x + rect.width {
            let pigments = std::array::from_fn(|i| (x * 1000 + y * 7 + i * 10_000) as u32);
            let cell = Cell { pigments, vehicle: (y * 100) as u32 };
            // Every third cell has a skin.
            let skin = cell.share_of_65536(if (x + y) % 3 == 0 { 20_000 } else { 0 });
            layer.set_films(y * WIDTH + x, [cell.minus(&skin), skin]);
        }
    }
    layer
}

/// A rectangle that overlaps four of the six tiles.
const SPOT: Rect = Rect { x: 50, y: 40, width: 40, height: 40 };

fn engine() -> CpuPaint {
    let heights = (0..WIDTH * HEIGHT).map(|i| (i % 321) as i32 - 100).collect();
    let mut engine = CpuPaint::new(Field::from_values(WIDTH, HEIGHT, heights));
    engine.set_wet(&paint_in(SPOT));
    engine
}

#[test]
fn drying_parts_the_paint_and_raises_the_floor_by_what_dried() {
    let mut engine = engine();
    let wet = engine.wet();
    let floor = engine.floor();
    engine.dry(20_000);
    assert_eq!(engine.dry_layer_count(), 1);
    let rest = engine.wet();
    let dried = engine.dry_layer(0);
    let risen = engine.floor();
    for index in 0..WIDTH * HEIGHT {
        let [body, skin] = wet.films(index);
        let [of_body, of_skin] = drying(20_000, body.volume(), skin.volume());
        let films = [body.share_of_65536(of_body), skin.share_of_65536(of_skin)];
        assert_eq!(rest.cell(index).plus(&dried.cell(index)), wet.cell(index), "cell {index}");
        assert_eq!(dried.films(index), films, "cell {index}");
        let rise = risen.values()[index] - floor.values()[index];
        assert_eq!(rise, dried.cell(index).volume() as i32, "cell {index}");
    }
    assert!(engine.remove_dry_layer(0) == dried, "the popped layer differs");
    assert!(engine.floor() == floor, "floor without the layer");
    engine.insert_dry_layer(0, &dried);
    assert!(engine.floor() == risen, "floor with the layer");
    engine.dry(65_536);
    assert_eq!(engine.wet().totals(), [0; SLOTS + 1]);
}

#[test]
fn a_dry_layer_takes_memory_only_where_it_is_painted() {
    let mut engine = engine();
    engine.dry(65_536);
    engine.dry(65_536);
    let tiles: Vec<_> = engine.dry.iter().map(|layer| layer.tiles().count()).collect();
    assert_eq!(tiles, [4, 0]);
}

#[test]
fn a_tile_is_exchanged_with_what_was_saved_and_nothing_else_changes() {
    let mut engine = engine();
    let before = engine.wet();
    let tile = Tile { row: 1, column: 1 };
    engine.save_tile(tile, UndoSlot(3));
    engine.set_wet(&paint_in(Rect { x: 0, y: 0, width: WIDTH, height: HEIGHT }));
    let after = engine.wet();
    engine.swap_tile(tile, UndoSlot(3));
    let swapped = engine.wet();
    for index in 0..WIDTH * HEIGHT {
        let x = index % WIDTH;
        let y = index / WIDTH;
        let inside = (64..128).contains(&x) && y >= 64;
        let expected = if inside { before.films(index) } else { after.films(index) };
        assert_eq!(swapped.films(index), expected, "cell {x}, {y}");
    }
    engine.swap_tile(tile, UndoSlot(3));
    assert!(engine.wet() == after, "exchanged twice");
}

fn scene(layers: usize) -> Scene {
    Scene {
        ground: [0.8; NODES],
        dry: (0..layers).map(|i| layer_optics(1e-6 * (i + 1) as f32)).collect(),
        wet: layer_optics(2e-6),
        surface: SceneSurface { k1: 0.03, k2: 0.5, specular: 0.0 },
        rgb_from_nodes: std::array::from_fn(|node| [0.125, 0.02 * node as f32, 0.1]),
        lamp: Lamp {
            direction: [-0.5, -0.5, 0.707],
            relief: 1.0,
            ambient: 0.5,
            wet: gloss(0.3),
            dry: gloss(0.2),
            ground: gloss(0.1),
        },
        cell_mm: 0.1,
    }
}

fn layer_optics(strength: f32) -> LayerOptics {
    LayerOptics {
        absorption: std::array::from_fn(|slot| {
            std::array::from_fn(|node| strength * ((slot * 3 + node * 5) % 7) as f32)
        }),
        scattering: [[strength * 2.0; NODES]; SLOTS],
        covers: [5e-5; SLOTS + 1],
    }
}

fn gloss(strength: f32) -> Gloss {
    Gloss { strength, exponent: 20.0 }
}

#[test]
fn lighting_what_changed_gives_the_picture_of_lighting_all() {
    let mut engine = engine();
    engine.dry(30_000);
    let all = TileSet::all(engine.bounds());
    let none = TileSet::default();
    engine.render(View::First, &scene(1), &all, &none);
    let first = engine.picture();
    // Replaces the wet paint of `SPOT` by paint in one of its four tiles, and later dries it.
    let stroke = Rect { x: 70, y: 70, width: 20, height: 20 };
    engine.set_wet(&paint_in(stroke));
    let mut spot = TileSet::default();
    spot.insert(SPOT);
    engine.render(View::First, &scene(1), &none, &spot);
    let shown = engine.picture();
    engine.render(View::First, &scene(1), &all, &none);
    assert!(engine.picture() == shown, "shown tiles alone");
    // Shading looks 8 cells of 0.1 mm far.
    for (index, (now, before)) in shown.values().iter().zip(first.values()).enumerate() {
        let x = index % WIDTH;
        let y = index / WIDTH;
        assert!(!(x >= 128 || !(32..88).contains(&y) && x < 42) || now == before, "cell {x}, {y}");
    }
    assert_ne!(shown[(80, 80)], first[(80, 80)]);
    engine.dry(65_536);
    engine.render(View::First, &scene(2), &spot, &none);
    let baked = engine.picture();
    engine.render(View::First, &scene(2), &all, &all);
    assert!(engine.picture() == baked, "baked tiles alone");
    assert!(baked.values().iter().all(|rgba| rgba.iter().all(|v| v.is_finite())), "finite");
}

#[test]
fn bare_ground_shows_what_an_instrument_would_read_of_it() {
    let mut engine = CpuPaint::new(Field::filled(WIDTH, HEIGHT, 0));
    let all = TileSet::all(engine.bounds());
    engine.render(View::First, &scene(0), &all, &all);
    let seen = engine.picture()[(7, 5)][0];
    // Internal reflectance 0.8, k1 = 0.03, k2 = 0.5. The weights of eight nodes sum to 1.
    let measured = 0.97 * 0.5 * 0.8 / (1.0 - 0.5 * 0.8);
    assert!((seen - measured).abs() < 1e-6, "{seen} {measured}");
}

#[test]
fn a_picture_before_any_light_is_dark() {
    let picture = engine().picture();
    assert!(picture.values().iter().all(|rgba| *rgba == [0.0, 0.0, 0.0, 1.0]), "not dark");
    assert_eq!((picture.width(), picture.height()), (WIDTH, HEIGHT));
}

/// Applies one sub-step to `wet` and `brush`.
pub(super) fn sub_step(
    motion: &MotionConstants,
    contact: &Contact,
    Below { floor, bed, mask }: Below<'_>,
    wet: &mut Layer,
    paint: &mut HeadPaint,
) {
    let Contact { rect, touches, rates, wicking } = contact;
    let width = floor.width();
    let height = floor.height();
    if wicking.share > 0 {
        Wick::default().apply(*wicking, paint);
    }
    let HeadPaint { cells: brush, means } = paint;
    let start = wet.clone();
    let head = brush.clone();
    // Signed coordinates, so that cells beyond the canvas can be queried.
    let touch = |x: i64, y: i64| -> Touch {
        let x = x - rect.x as i64;
        let y = y - rect.y as i64;
        let inside = x >= 0 && y >= 0 && x < rect.width as i64 && y < rect.height as i64;
        if inside { touches[y as usize * rect.width + x as usize] } else { Touch::NONE }
    };
    let coat_at = |x: i64, y: i64| -> u32 {
        let here = touch(x, y);
        coat(rates, here, means[here.brush_cell as usize])
    };
    let pressed = |x: i64, y: i64| -> i32 {
        let here = touch(x, y);
        if here == Touch::NONE
            || mask.is_some_and(|mask| mask.covers(y as usize * width + x as usize))
        {
            return NO_CONTACT;
        }
        let index = y as usize * width + x as usize;
        let paint = (floor.values()[index], start.cell(index).volume());
        penetration(rates, here, paint, bed.at((x as usize, y as usize)), coat_at(x, y))
    };
    let reach = rect.grown(2, floor.bounds());
    let top = |x: i64, y: i64| -> i32 {
        let x = x.clamp(reach.x as i64, (reach.x + reach.width) as i64 - 1) as usize;
        let y = y.clamp(reach.y as i64, (reach.y + reach.height) as i64 - 1) as usize;
        floor[(x, y)] + start.cell(y * width + x).volume() as i32
    };
    let column =
        |x: i64, y: i64| Column { top: top(x, y), pressure: pressure(motion, pressed(x, y)) };
    // Flow from the cell at `(x, y)` to the cell one step further.
    let flow_from = |x: i64, y: i64, (right, down): (i64, i64)| -> i32 {
        let next = column(x + right, y + down);
        let before = top(x - right, y - down);
        let beyond = top(x + 2 * right, y + 2 * down);
        flow(motion, before, column(x, y), next, beyond)
    };
    let change = |wet: &mut Layer, x: i64, y: i64, film: usize, act: &dyn Fn(&Cell) -> Cell| {
        let index = y as usize * width + x as usize;
        let mut films = wet.films(index);
        films[film] = act(&films[film]);
        wet.set_films(index, films);
    };
    let moving = rect.grown(1, floor.bounds());
    for y in moving.y as i64..(moving.y + moving.height) as i64 {
        for x in moving.x as i64..(moving.x + moving.width) as i64 {
            if motion.everywhere == 0
                && (-1..=1)
                    .all(|down| (-1..=1).all(|right| pressed(x + right, y + down) == NO_CONTACT))
            {
                continue;
            }
            let films = start.films(y as usize * width + x as usize);
            let volume = films[0].volume() + films[1].volume();
            let head = dragged(rates, touch(x, y), pressed(x, y), volume);
            let in_x = (flow_from(x - 1, y, (1, 0)), flow_from(x, y, (1, 0)));
            let in_y = (flow_from(x, y - 1, (0, 1)), flow_from(x, y, (0, 1)));
            let mut right = velocity(head.0, volume, in_x.0, in_x.1);
            let mut down = velocity(head.1, volume, in_y.0, in_y.1);
            if (x == 0 && right < 0) || (x + 1 == width as i64 && right > 0) {
                right = 0;
            }
            if (y == 0 && down < 0) || (y + 1 == height as i64 && down > 0) {
                down = 0;
            }
            let (right, down) = avoid_crowded_columns((right, down), |to_x, to_y| {
                let x = x + i64::from(to_x);
                let y = y + i64::from(to_y);
                mask.is_some_and(|mask| mask.covers(y as usize * width + x as usize))
                    || start.cell(y as usize * width + x as usize).volume() > CROWDED_VOLUME
            });
            let mobile = mobile_share(motion, volume);
            let out = outflow(mobile, (right.unsigned_abs(), down.unsigned_abs()));
            let in_x = x + i64::from(right.signum());
            let in_y = y + i64::from(down.signum());
            for (to_x, to_y, share) in
                [(in_x, y, out.in_x), (x, in_y, out.in_y), (in_x, in_y, out.diagonal)]
            {
                for (film, cell) in films.iter().enumerate() {
                    let part = cell.share_of_65536(share);
                    change(wet, x, y, film, &|cell| cell.minus(&part));
                    change(wet, to_x, to_y, film, &|cell| cell.plus(&part));
                }
            }
        }
    }
    for y in rect.y as i64..(rect.y + rect.height) as i64 {
        for x in rect.x as i64..(rect.x + rect.width) as i64 {
            let here = touch(x, y);
            let deep = pressed(x, y);
            if deep == NO_CONTACT {
                continue;
            }
            let at = here.brush_cell as usize;
            let [body, skin] = wet.films(y as usize * width + x as usize);
            let Exchange { down, up } = exchange(
                rates,
                here,
                deep,
                coat_at(x, y),
                [body.volume(), skin.volume()],
                head.cell(at).volume(),
                leaving(here, (x as usize, y as usize), floor.bounds()),
            );
            let laid = head.cell(at).share_of_65536(down);
            let taken = [body.share_of_65536(up[0]), skin.share_of_65536(up[1])];
            for (film, taken) in taken.iter().enumerate() {
                change(wet, x, y, film, &|cell| cell.minus(taken));
            }
            let upper = usize::from(bed.painted_at((x as usize, y as usize)));
            change(wet, x, y, upper, &|cell| cell.plus(&laid));
            brush.set_cell(at, brush.cell(at).minus(&laid).plus(&taken[0]).plus(&taken[1]));
            let [body, skin] = wet.films(y as usize * width + x as usize);
            let [sinks, rises] = stirred(rates, here, deep, body.volume(), skin.volume());
            let [risen, sunk] = [body.share_of_65536(sinks), skin.share_of_65536(rises)];
            change(wet, x, y, 0, &|cell| cell.minus(&risen).plus(&sunk));
            change(wet, x, y, 1, &|cell| cell.minus(&sunk).plus(&risen));
        }
    }
}
