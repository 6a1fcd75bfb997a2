//! Strokes that flow over a picture, as optical flow of the painted frames sees them.

use glam::{DMat2, DVec2};

use super::super::made_up::map;
use super::super::picture_form::FlowPicture;
use super::tests::{photograph, view};
use super::*;

/// Side of the windows in which motion is found, in pixels.
const WINDOW: usize = 60;

/// Motion of each window from one frame to another in pixels, by least squares over the gradients
/// (Lucas and Kanade 1981).
fn motions(before: &Field<f32>, after: &Field<f32>) -> Vec<DVec2> {
    let width = before.width();
    let height = before.height();
    let mut found = Vec::new();
    for top in (2..height - WINDOW).step_by(WINDOW) {
        for left in (2..width - WINDOW).step_by(WINDOW) {
            let mut squares = DMat2::ZERO;
            let mut wanted = DVec2::ZERO;
            for y in top..top + WINDOW {
                for x in left..left + WINDOW {
                    // Gradients of both frames, so that their mean counts.
                    let slope = |a: (usize, usize), b: (usize, usize)| {
                        f64::from(before[b] - before[a] + after[b] - after[a]) / 4.0
                    };
                    let slope =
                        DVec2::new(slope((x - 1, y), (x + 1, y)), slope((x, y - 1), (x, y + 1)));
                    let change = f64::from(after[(x, y)] - before[(x, y)]);
                    squares += DMat2::from_cols(slope * slope.x, slope * slope.y);
                    wanted -= slope * change;
                }
            }
            found.push(squares.inverse() * wanted);
        }
    }
    found
}

#[test]
fn texels_move_along_the_flow() {
    let even = photograph(320, 240, |_, _| [120; 3]);
    for degrees in [20.0_f32, 115.0, 250.0] {
        let wanted = Vec2::from_angle(degrees.to_radians());
        let flow = FlowPicture::of(Field::filled(2, 2, (0.9 * wanted).to_array()));
        let form = PictureForm { flow: Some(flow), ..PictureForm::default() };
        let mut settings = Settings { reference_px: 320.0, ..Settings::default() };
        settings.strokes.width_px = 14.0;
        (settings.flow.periods, settings.flow.loop_seconds) = (1, 100.0);
        let map = map(1);
        let brushwork = Brushwork::of(&map);
        let mut painter = Painter::of_picture_with(&even, &brushwork, &form, &settings).unwrap();
        let mut frame = |seconds: f64| {
            let color = painter.paint(&view(&even), (320, 240), seconds).unwrap().color;
            let greens = color.values().iter().map(|pixel| pixel[1]).collect();
            Field::from_values(320, 240, greens)
        };
        // The map is 180 px long; a half pixel of motion.
        let before = frame(10.0);
        let after = frame(10.3);
        let mut off: Vec<f64> = motions(&before, &after)
            .into_iter()
            .map(|motion| motion.angle_to(wanted.as_dvec2()).to_degrees().abs())
            .collect();
        off.sort_unstable_by(f64::total_cmp);
        let median = off[off.len() / 2];
        assert!(median < 5.0, "{degrees}: {median} of {off:?}");
    }
}
