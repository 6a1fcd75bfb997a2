//! A sub-step written directly from the specification in [`crate::motion`], cell by
//! cell. Tests compare the fast implementation with it.

use crate::contact::{Contact, Touch};
use crate::layer::{Cell, Layer};
use crate::motion::MotionConstants;
use crate::motion::advect::{mobile_share, outflow};
use crate::motion::press::{
    CROWDED_VOLUME, NO_CONTACT, avoid_crowded_columns, penetration, velocity,
};
use crate::motion::transfer::{Exchange, Source, exchange};
use graphics::field::Field;

/// Applies one sub-step to `wet` and `brush`.
pub(super) fn sub_step(
    motion: &MotionConstants,
    contact: &Contact,
    floor: &Field<i32>,
    wet: &mut Layer,
    brush: &mut Layer,
) {
    let Contact { rect, touches } = contact;
    let (width, height) = (floor.width(), floor.height());
    let start = wet.clone();
    // Signed coordinates, so that cells beyond the canvas can be queried.
    let touch = |x: i64, y: i64| -> Touch {
        let (x, y) = (x - rect.x as i64, y - rect.y as i64);
        let inside = x >= 0 && y >= 0 && x < rect.width as i64 && y < rect.height as i64;
        if inside { touches[y as usize * rect.width + x as usize] } else { Touch::NONE }
    };
    let pressed = |x: i64, y: i64| -> i32 {
        if touch(x, y) == Touch::NONE {
            return NO_CONTACT;
        }
        let (x, y) = (x as usize, y as usize);
        penetration(touch(x as i64, y as i64), floor[(x, y)], start.cell(y * width + x).volume())
    };
    let depth = |x: i64, y: i64| pressed(x, y).max(0);
    let change = |wet: &mut Layer, x: i64, y: i64, act: &dyn Fn(&Cell) -> Cell| {
        let index = y as usize * width + x as usize;
        let cell = act(&wet.cell(index));
        wet.set_cell(index, cell);
    };
    let moving = rect.grown(1, floor.bounds());
    for y in moving.y as i64..(moving.y + moving.height) as i64 {
        for x in moving.x as i64..(moving.x + moving.width) as i64 {
            let slopes = (depth(x + 1, y) - depth(x - 1, y), depth(x, y + 1) - depth(x, y - 1));
            let (mut right, mut down) = velocity(motion, touch(x, y), pressed(x, y), slopes);
            if (x == 0 && right < 0) || (x + 1 == width as i64 && right > 0) {
                right = 0;
            }
            if (y == 0 && down < 0) || (y + 1 == height as i64 && down > 0) {
                down = 0;
            }
            let (right, down) = avoid_crowded_columns((right, down), |to_x, to_y| {
                let at = (y + i64::from(to_y)) as usize * width + (x + i64::from(to_x)) as usize;
                start.cell(at).volume() > CROWDED_VOLUME
            });
            let cell = start.cell(y as usize * width + x as usize);
            let mobile = mobile_share(motion, cell.volume());
            let out = outflow(&cell, mobile, (right.unsigned_abs(), down.unsigned_abs()));
            let (in_x, in_y) = (x + i64::from(right.signum()), y + i64::from(down.signum()));
            for (to_x, to_y, part) in
                [(in_x, y, out.in_x), (x, in_y, out.in_y), (in_x, in_y, out.diagonal)]
            {
                change(wet, x, y, &|cell| cell.minus(&part));
                change(wet, to_x, to_y, &|cell| cell.plus(&part));
            }
        }
    }
    let head = brush.clone();
    for y in rect.y as i64..(rect.y + rect.height) as i64 {
        for x in rect.x as i64..(rect.x + rect.width) as i64 {
            let (here, deep) = (touch(x, y), pressed(x, y));
            if deep == NO_CONTACT {
                continue;
            }
            let at = here.brush_cell as usize;
            let canvas = wet.cell(y as usize * width + x as usize);
            let brush_volume = head.cell(at).volume();
            let Exchange { source, share } =
                exchange(motion, here, deep as u32, canvas.volume(), brush_volume);
            let now = brush.cell(at);
            match source {
                Source::Brush => {
                    let part = head.cell(at).share_of_65536(share);
                    change(wet, x, y, &|cell| cell.plus(&part));
                    brush.set_cell(at, now.minus(&part));
                }
                Source::Canvas => {
                    let part = canvas.share_of_65536(share);
                    change(wet, x, y, &|cell| cell.minus(&part));
                    brush.set_cell(at, now.plus(&part));
                }
            }
        }
    }
}
