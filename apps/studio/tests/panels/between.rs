//! Parts of the window that a stroke changes between two frames, as a page shows them.

use std::time::Duration;
use web_time::Instant;

use eframe::egui::{Context, Pos2, Rect};
use image::{Rgba, RgbaImage};
use paint::strokes::SurfaceId;
use studio::app::Between;
use studio::pen::{Device, PointerState, Report, ReportKind};

use super::harness::Window;

fn hold(window: &mut Window, x_mm: f64, kind: impl Fn(PointerState) -> ReportKind) {
    let at = window.point(SurfaceId::Canvas, x_mm, 9.0);
    let state =
        PointerState { at, pressure: Some(0.6), tilt_deg: Some((15.0, 5.0)), twist_deg: Some(0.0) };
    let report = Report { device: Device::Pen, arrived: Instant::now(), kind: kind(state) };
    window.studio_mut().pen.feed(report);
}

/// A window with the stroke of a stylus that is open, and its context.
fn in_stroke(name: &'static str) -> (Window, Context) {
    let mut window = Window::open(name);
    window.click("Load brush");
    window.settle();
    hold(&mut window, 6.0, ReportKind::Pressed);
    window.frame(Vec::new());
    let context = window.harness().ctx.clone();
    (window, context)
}

/// Moves the stylus from 6 to 24 mm, without frames. Returns what was shown.
fn moved(window: &mut Window, context: &Context) -> Vec<Between> {
    let mut shown = Vec::new();
    let mut show = |window: &mut Window| {
        let part = window.studio_mut().between(context).expect("shown between frames");
        shown.extend(Some(part).filter(|part| part.patch.width > 0));
    };
    for step in 1..=36 {
        hold(window, 6.0 + 0.5 * f64::from(step), ReportKind::Moved);
        std::thread::sleep(Duration::from_millis(5));
        show(window);
    }
    // The last paint comes from the worker later.
    for _ in 0..60 {
        std::thread::sleep(Duration::from_millis(10));
        show(window);
    }
    shown
}

#[test]
fn parts_between_frames_show_the_pixels_of_the_next_frame() {
    for (turn, mirror) in [(0.0, false), (0.4, true)] {
        let (mut window, context) = in_stroke("between");
        window.studio_mut().canvas.view.rotation = turn;
        window.studio_mut().canvas.view.mirror = mirror;
        window.frame(Vec::new());
        let Some(mut shown) = window.picture() else { return };
        let before = shown.clone();
        let parts = moved(&mut window, &context);
        assert!(parts.len() > 5, "{} parts", parts.len());
        for Between { patch, .. } in &parts {
            let pixels =
                RgbaImage::from_raw(patch.width as u32, patch.height as u32, patch.rgba.clone());
            image::imageops::replace(
                &mut shown,
                &pixels.unwrap(),
                patch.left as i64,
                patch.top as i64,
            );
        }
        window.frame(Vec::new());
        let whole = window.picture().unwrap();
        let head = parts.last().and_then(|part| part.head.bounds()).unwrap().expand(2.0);
        let view = window.studio().canvas.rect();
        let mut painted = 0;
        let mut far = Vec::new();
        for (x, y, pixel) in whole.enumerate_pixels() {
            let at = Pos2::new(x as f32 + 0.5, y as f32 + 0.5);
            if !view.contains(at) || head.contains(at) {
                continue;
            }
            painted += usize::from(differ(pixel, before.get_pixel(x, y)) > 8);
            let by = differ(pixel, shown.get_pixel(x, y));
            far.extend((by > 3).then_some((x, y, by)));
        }
        assert!(painted > 2000, "the stroke is seen: {painted} pixels, turn {turn}");
        assert!(far.is_empty(), "{} pixels differ, turn {turn}: {:?}", far.len(), far.first());
    }
}

fn differ(a: &Rgba<u8>, b: &Rgba<u8>) -> u8 {
    a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

#[test]
fn a_part_has_the_whole_head_and_lies_within_the_canvas() {
    let (mut window, context) = in_stroke("between-head");
    // The stroke leaves the view.
    window.studio_mut().canvas.view.fitted = false;
    window.studio_mut().canvas.view.zoom = 8.0;
    window.frame(Vec::new());
    let view = window.studio().canvas.rect();
    for Between { patch, head } in moved(&mut window, &context) {
        let min = Pos2::new(patch.left as f32, patch.top as f32);
        let max = min + eframe::egui::vec2(patch.width as f32, patch.height as f32);
        let part = Rect::from_min_max(min, max);
        assert!(view.expand(1.0).contains_rect(part), "{part} within {view}");
        let bounds = head.bounds().map_or(part, |bounds| bounds.intersect(view));
        assert!(part.expand(1.0).contains_rect(bounds), "{bounds} within {part}");
    }
}

#[test]
fn frames_show_what_is_more_than_paint_and_head() {
    let (mut window, context) = in_stroke("between-more");
    assert!(window.studio_mut().between(&context).is_some());
    window.studio_mut().aids.symmetry.on = true;
    assert!(window.studio_mut().between(&context).is_none(), "the axis of symmetry lies over it");
    window.studio_mut().aids.symmetry.on = false;
    window.studio_mut().tools.figures = true;
    assert!(window.studio_mut().between(&context).is_none(), "and the figures");
    window.studio_mut().tools.figures = false;
    assert!(window.studio_mut().between(&context).is_some());
    hold(&mut window, 6.0, |_| ReportKind::Released);
    let _ = window.studio_mut().between(&context);
    assert!(!window.studio().pen.is_down(), "the pen is lifted without a frame");
    assert!(window.studio_mut().between(&context).is_none(), "no stroke is open");
}
