//! A sub-step written directly from the specification in [`crate::motion`], cell by
//! cell. Tests compare the fast implementation with it.

use super::below::Below;
use super::head_paint::HeadPaint;
use super::wick::Wick;
use crate::contact::{Contact, Touch};
use crate::layer::{Cell, Layer};
use crate::motion::MotionConstants;
use crate::motion::advect::{mobile_share, outflow};
use crate::motion::press::{
    CROWDED_VOLUME, Column, NO_CONTACT, avoid_crowded_columns, coat, dragged, flow, penetration,
    pressure, velocity,
};
use crate::motion::transfer::{Exchange, exchange, leaving};

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
    let covered =
        |x: i64, y: i64| mask.is_some_and(|mask| mask.covers(y as usize * width + x as usize));
    let pressed = |x: i64, y: i64| -> i32 {
        let here = touch(x, y);
        if here == Touch::NONE || covered(x, y) {
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
    // Flow from the cell at `(x, y)` to that one step on.
    let flow_from = |x: i64, y: i64, (right, down): (i64, i64)| -> i32 {
        let next = column(x + right, y + down);
        let before = top(x - right, y - down);
        let beyond = top(x + 2 * right, y + 2 * down);
        flow(motion, before, column(x, y), next, beyond)
    };
    let change = |wet: &mut Layer, x: i64, y: i64, act: &dyn Fn(&Cell) -> Cell| {
        let index = y as usize * width + x as usize;
        let cell = act(&wet.cell(index));
        wet.set_cell(index, cell);
    };
    let near = |x: i64, y: i64| {
        (-1..=1).any(|down| (-1..=1).any(|right| pressed(x + right, y + down) != NO_CONTACT))
    };
    let moving = rect.grown(1, floor.bounds());
    for y in moving.y as i64..(moving.y + moving.height) as i64 {
        for x in moving.x as i64..(moving.x + moving.width) as i64 {
            if motion.everywhere == 0 && !near(x, y) {
                continue;
            }
            let cell = start.cell(y as usize * width + x as usize);
            let volume = cell.volume();
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
                covered(x, y)
                    || start.cell(y as usize * width + x as usize).volume() > CROWDED_VOLUME
            });
            let mobile = mobile_share(motion, volume);
            let out = outflow(mobile, (right.unsigned_abs(), down.unsigned_abs()));
            let in_x = x + i64::from(right.signum());
            let in_y = y + i64::from(down.signum());
            for (to_x, to_y, share) in
                [(in_x, y, out.in_x), (x, in_y, out.in_y), (in_x, in_y, out.diagonal)]
            {
                let part = cell.share_of_65536(share);
                change(wet, x, y, &|cell| cell.minus(&part));
                change(wet, to_x, to_y, &|cell| cell.plus(&part));
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
            let canvas = wet.cell(y as usize * width + x as usize);
            let Exchange { down, up } = exchange(
                rates,
                here,
                deep,
                coat_at(x, y),
                canvas.volume(),
                head.cell(at).volume(),
                leaving(here, (x as usize, y as usize), floor.bounds()),
            );
            let laid = head.cell(at).share_of_65536(down);
            let taken = canvas.share_of_65536(up);
            change(wet, x, y, &|cell| cell.minus(&taken).plus(&laid));
            brush.set_cell(at, brush.cell(at).minus(&laid).plus(&taken));
        }
    }
}
