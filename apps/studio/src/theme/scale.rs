//! Scale of the interface: its steps, and what fits into a window.

use eframe::egui::Vec2;

/// Steps of the scale.
const STEPS: [f32; 11] = [0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0];

/// Width and height that the interface needs at least, in points: those of the smallest
/// window.
const NEEDED: Vec2 = Vec2::new(900.0, 600.0);

/// The next larger or smaller step of the scale; `scale` itself at the end of the steps.
#[must_use]
pub fn stepped_scale(scale: f32, larger: bool) -> f32 {
    const NEAR: f32 = 0.01;
    let found = match larger {
        true => STEPS.into_iter().find(|step| *step > scale + NEAR),
        false => STEPS.into_iter().rev().find(|step| *step < scale - NEAR),
    };
    found.unwrap_or(scale)
}

/// The scale at which the interface is drawn in a window of `size` points at scale 1: the
/// preferred scale, as far as all controls stay in the window.
#[must_use]
pub fn scale_in_window(preferred: f32, size: Vec2) -> f32 {
    let most = (size.x / NEEDED.x).min(size.y / NEEDED.y);
    // A window smaller than that is drawn at scale 1 or smaller, and a part of it is not seen.
    preferred.min(most.max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::vec2;

    #[test]
    fn steps_go_up_and_down_and_end() {
        let mut scale = 1.0;
        let mut up = Vec::new();
        for _ in 0..8 {
            scale = stepped_scale(scale, true);
            up.push(scale);
        }
        assert_eq!(up, [1.1, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.0]);
        assert_eq!(stepped_scale(1.0, false), 0.9);
        assert_eq!(stepped_scale(0.5, false), 0.5);
        // From a scale between the steps.
        assert_eq!((stepped_scale(1.3, true), stepped_scale(1.3, false)), (1.5, 1.25));
    }

    #[test]
    fn a_large_scale_yields_to_a_small_window() {
        assert_eq!(scale_in_window(3.0, vec2(3840.0, 2160.0)), 3.0);
        assert_eq!(scale_in_window(1.25, vec2(1280.0, 800.0)), 1.25);
        let small = scale_in_window(3.0, vec2(1280.0, 800.0));
        assert!((small - 800.0 / 600.0).abs() < 1e-6, "{small}");
        assert_eq!(scale_in_window(0.75, vec2(800.0, 500.0)), 0.75);
        assert_eq!(scale_in_window(2.0, vec2(800.0, 500.0)), 1.0);
    }
}
