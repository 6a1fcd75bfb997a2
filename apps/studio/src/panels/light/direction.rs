//! Two pads of the light panel: the light direction on a shaded hemisphere seen from above, and
//! gloss. In the gloss pad the exponent grows to the right and the strength upwards.

use std::f64::consts::{FRAC_PI_2, TAU};

use eframe::egui::{
    Color32, Mesh, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, lerp, pos2,
    remap_clamp, vec2,
};
use paint::optics::Gloss;
use spectra::color::Rgb;

use super::super::context::Edit;
use super::super::controls::arrow_keys;
use crate::language::{tr, tr_format};
use crate::theme;

/// Minimum elevation of the light, in degrees.
const LOWEST_DEG: f64 = 5.0;

/// Change of direction by an arrow key, in degrees.
const STEP_DEG: f64 = 5.0;

/// Rings of the hemisphere's mesh, from pole to rim.
const RINGS: usize = 14;

/// Vertices of each ring.
const SPOKES: usize = 48;

/// Direction of the light: azimuth clockwise from the top of the canvas and elevation above it, in
/// degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::panels) struct Direction {
    pub(in crate::panels) azimuth_deg: f64,
    pub(in crate::panels) elevation_deg: f64,
}

impl Direction {
    /// Position on the unit disc seen from above, x right and y down.
    fn on_disc(self) -> [f64; 2] {
        let (sin, cos) = self.azimuth_deg.to_radians().sin_cos();
        let out = self.elevation_deg.to_radians().cos();
        [out * sin, -out * cos]
    }

    /// Direction of a position on the unit disc. Outside the disc the elevation is minimal. At the
    /// centre the azimuth is undefined, so it stays unchanged.
    fn at(self, [x, y]: [f64; 2]) -> Self {
        let out = x.hypot(y);
        let elevation_deg = out.min(1.0).acos().to_degrees().max(LOWEST_DEG);
        let turned = x.atan2(-y).rem_euclid(TAU).to_degrees();
        let azimuth_deg = if out < 1e-3 { self.azimuth_deg } else { turned };
        Self { azimuth_deg: rounded(azimuth_deg) % 360.0, elevation_deg: rounded(elevation_deg) }
    }

    /// Direction after a number of arrow key steps.
    fn stepped(self, clockwise: f64, up: f64) -> Self {
        let elevation_deg = (self.elevation_deg + STEP_DEG * up).clamp(LOWEST_DEG, 90.0);
        let azimuth_deg = (self.azimuth_deg + STEP_DEG * clockwise).rem_euclid(360.0);
        Self { azimuth_deg, elevation_deg }
    }
}

fn rounded(degrees: f64) -> f64 {
    (degrees * 10.0).round() / 10.0
}

/// Draws the hemisphere and updates `direction` when you drag it or use arrow keys. The share
/// `ambient` of the light, 0 to 1, is undirected.
pub(in crate::panels) fn direction_control(
    ui: &mut Ui,
    size: f32,
    direction: &mut Direction,
    ambient: f64,
) -> (Response, Edit) {
    let (rect, mut response) = ui.allocate_exact_size(Vec2::splat(size), Sense::drag());
    let centre = rect.center();
    let radius = size / 2.0 - 4.0;
    let before = *direction;
    if let Some(pointer) = response.interact_pointer_pos() {
        let from_centre = (pointer - centre) / radius;
        *direction = direction.at([f64::from(from_centre.x), f64::from(from_centre.y)]);
    }
    let (clockwise, up) = arrow_keys(ui, &response);
    if (clockwise, up) != (0.0, 0.0) {
        *direction = direction.stepped(clockwise, up);
    }
    if *direction != before {
        response.mark_changed();
    }
    response.widget_info(|| {
        let mut info =
            WidgetInfo::slider(ui.is_enabled(), direction.azimuth_deg, tr("Light direction"));
        info.current_text_value = Some(direction_text(*direction));
        info
    });
    if ui.is_rect_visible(rect) {
        ui.painter().add(shaded(centre, radius, *direction, ambient));
        ui.painter().circle_stroke(centre, radius, Stroke::new(1.0, theme::colors(ui.ctx()).line));
        let [x, y] = direction.on_disc();
        let handle = centre + radius * vec2(x as f32, y as f32);
        // The light sphere needs a dark line in both themes.
        ui.painter().line_segment([centre, handle], Stroke::new(1.0, theme::DARK.bar));
        ui.painter().circle(
            handle,
            5.0,
            theme::colors(ui.ctx()).strong,
            Stroke::new(1.5, theme::colors(ui.ctx()).bar),
        );
        if response.has_focus() {
            ui.painter().circle_stroke(
                centre,
                radius + 2.0,
                Stroke::new(1.0, theme::colors(ui.ctx()).strong),
            );
        }
    }
    let edit = Edit::of(&response);
    (response, edit)
}

/// Direction as text, e.g. 315 degrees, 50 degrees high.
pub(in crate::panels) fn direction_text(direction: Direction) -> String {
    let Direction { azimuth_deg, elevation_deg } = direction;
    tr_format!("{azimuth_deg:.0}\u{b0}, {elevation_deg:.0}\u{b0} high", azimuth_deg, elevation_deg)
}

/// Mesh of a matt hemisphere under the light, in screen greys.
fn shaded(centre: Pos2, radius: f32, light: Direction, ambient: f64) -> Shape {
    let [x, y] = light.on_disc();
    let z = light.elevation_deg.to_radians().sin();
    let grey = |u: f64, v: f64| {
        let up = (1.0 - u * u - v * v).max(0.0).sqrt();
        let direct = (u * x + v * y + up * z).max(0.0);
        let light = 0.75 * (ambient + (1.0 - ambient) * direct);
        let [grey, ..] = Rgb([light; 3]).encoded().to_bytes();
        Color32::from_gray(grey)
    };
    let mut mesh = Mesh::default();
    mesh.colored_vertex(centre, grey(0.0, 0.0));
    for ring in 1..=RINGS {
        // Equal angles between the rings give a shading as smooth at the rim as at the pole.
        let out = (FRAC_PI_2 * ring as f64 / RINGS as f64).sin();
        for spoke in 0..SPOKES {
            let (sin, cos) = (TAU * spoke as f64 / SPOKES as f64).sin_cos();
            let u = out * cos;
            let v = out * sin;
            let place = pos2(centre.x + radius * u as f32, centre.y + radius * v as f32);
            mesh.colored_vertex(place, grey(u, v));
        }
    }
    fn vertex(ring: usize, spoke: usize) -> u32 {
        match ring {
            0 => 0,
            _ => (1 + (ring - 1) * SPOKES + spoke % SPOKES) as u32,
        }
    }
    for ring in 0..RINGS {
        for spoke in 0..SPOKES {
            let outer = [vertex(ring + 1, spoke), vertex(ring + 1, spoke + 1)];
            mesh.add_triangle(vertex(ring, spoke), outer[0], outer[1]);
            if ring > 0 {
                mesh.add_triangle(vertex(ring, spoke), outer[1], vertex(ring, spoke + 1));
            }
        }
    }
    Shape::mesh(mesh)
}

/// Strength at the upper edge, as a share of a perfect white.
const STRONGEST: f32 = 1.0;

/// Exponents at the left and right edges. The scale is logarithmic.
const EXPONENTS: (f32, f32) = (2.0, 500.0);

/// Mesh cells of the drawn highlight along each side.
const CELLS: usize = 20;

/// Draws a pad with an accessible name and updates `gloss` when you drag it.
pub(super) fn gloss_pad(
    ui: &mut Ui,
    name: &str,
    size: Vec2,
    gloss: &mut Gloss,
) -> (Response, Edit) {
    let (rect, mut response) = ui.allocate_exact_size(size, Sense::drag());
    let inner = rect.shrink(6.0);
    if let Some(pointer) = response.interact_pointer_pos() {
        let chosen = gloss_at(inner, pointer);
        if chosen != *gloss {
            *gloss = chosen;
            response.mark_changed();
        }
    }
    response.widget_info(|| {
        let mut info = WidgetInfo::slider(ui.is_enabled(), f64::from(gloss.strength), name);
        info.current_text_value = Some(gloss_text(*gloss));
        info
    });
    if ui.is_rect_visible(rect) {
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, theme::CORNER_RADIUS, theme::colors(ui.ctx()).well);
        painter.add(highlight(rect.shrink(1.0), *gloss));
        let handle = place_of(inner, *gloss);
        painter.circle(
            handle,
            4.5,
            theme::colors(ui.ctx()).strong,
            Stroke::new(1.5, theme::colors(ui.ctx()).bar),
        );
        let edge = if response.has_focus() {
            theme::colors(ui.ctx()).strong
        } else {
            theme::colors(ui.ctx()).line
        };
        let line = Stroke::new(1.0, edge);
        painter.rect_stroke(rect, theme::CORNER_RADIUS, line, eframe::egui::StrokeKind::Inside);
    }
    let edit = Edit::of(&response);
    (response, edit)
}

/// Gloss as text, e.g. `strength 0.25, exponent 60`.
pub(super) fn gloss_text(gloss: Gloss) -> String {
    tr_format!(
        "strength {strength:.2}, exponent {exponent:.0}",
        strength = gloss.strength,
        exponent = gloss.exponent
    )
}

fn gloss_at(pad: Rect, place: Pos2) -> Gloss {
    let along = remap_clamp(place.x, pad.x_range(), 0.0..=1.0);
    let up = remap_clamp(place.y, pad.y_range(), 1.0..=0.0);
    let exponent = lerp(EXPONENTS.0.ln()..=EXPONENTS.1.ln(), along).exp();
    let strength = STRONGEST * up;
    // We round, because you would not see smaller differences.
    let digits = if exponent < 10.0 { 10.0 } else { 1.0 };
    Gloss {
        strength: (strength * 100.0).round() / 100.0,
        exponent: (exponent * digits).round() / digits,
    }
}

fn place_of(pad: Rect, gloss: Gloss) -> Pos2 {
    let logarithm = gloss.exponent.max(EXPONENTS.0).ln();
    let along = remap_clamp(logarithm, EXPONENTS.0.ln()..=EXPONENTS.1.ln(), 0.0..=1.0);
    let up = (gloss.strength / STRONGEST).clamp(0.0, 1.0);
    pos2(lerp(pad.left()..=pad.right(), along), lerp(pad.bottom()..=pad.top(), up))
}

/// Mesh of the highlight on a grey ball, in screen greys.
fn highlight(rect: Rect, gloss: Gloss) -> Shape {
    let mut mesh = Mesh::default();
    for row in 0..=CELLS {
        for column in 0..=CELLS {
            let u = column as f32 / CELLS as f32;
            let v = row as f32 / CELLS as f32;
            // The surface turns by 90 degrees from the upper to the lower edge: 0.785 is 45 degrees
            // in radians.
            let across = (2.0 * u - 1.0) * rect.width() / rect.height();
            let away = vec2(across, 2.0 * v - 1.0).length().min(2.0);
            let shine = gloss.strength * (away * 0.785).cos().powf(gloss.exponent);
            let light = f64::from(0.02 + 0.45 * shine.min(2.0));
            let [grey, ..] = Rgb([light; 3]).encoded().to_bytes();
            let place = rect.min + vec2(u * rect.width(), v * rect.height());
            mesh.colored_vertex(place, Color32::from_gray(grey));
        }
    }
    for row in 0..CELLS {
        for column in 0..CELLS {
            let upper = (row * (CELLS + 1) + column) as u32;
            let lower = upper + CELLS as u32 + 1;
            mesh.add_triangle(upper, upper + 1, lower + 1);
            mesh.add_triangle(upper, lower + 1, lower);
        }
    }
    Shape::mesh(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn disc_position_and_direction_are_inverse() {
        let any = Direction { azimuth_deg: 77.0, elevation_deg: 30.0 };
        for azimuth_deg in [0.0, 45.0, 90.0, 200.0, 315.0, 359.0] {
            for elevation_deg in [5.0, 30.0, 50.0, 85.0] {
                let direction = Direction { azimuth_deg, elevation_deg };
                let back = any.at(direction.on_disc());
                assert_eq!(back, direction);
            }
        }
    }

    #[test]
    fn azimuth_is_clockwise_from_the_top() {
        let any = Direction { azimuth_deg: 77.0, elevation_deg: 30.0 };
        assert_eq!(any.at([0.0, -0.5]).azimuth_deg, 0.0);
        assert_eq!(any.at([0.5, 0.0]).azimuth_deg, 90.0);
        assert_eq!(any.at([0.0, 0.5]).azimuth_deg, 180.0);
        assert_eq!(any.at([-0.5, 0.0]).azimuth_deg, 270.0);
    }

    #[test]
    fn the_centre_keeps_the_azimuth_and_outside_is_the_minimum() {
        let any = Direction { azimuth_deg: 77.0, elevation_deg: 30.0 };
        assert_eq!(any.at([0.0, 0.0]), Direction { azimuth_deg: 77.0, elevation_deg: 90.0 });
        assert_eq!(any.at([3.0, 0.0]), Direction { azimuth_deg: 90.0, elevation_deg: LOWEST_DEG });
        assert_eq!(any.stepped(-16.0, 99.0), Direction { azimuth_deg: 357.0, elevation_deg: 90.0 });
    }

    #[test]
    fn pad_position_and_gloss_are_inverse() {
        let pad = Rect::from_min_size(pos2(10.0, 20.0), vec2(100.0, 80.0));
        for gloss in [
            Gloss { strength: 0.25, exponent: 60.0 },
            Gloss { strength: 0.06, exponent: 20.0 },
            Gloss { strength: 1.0, exponent: 500.0 },
            Gloss { strength: 0.0, exponent: 2.0 },
        ] {
            assert_eq!(gloss_at(pad, place_of(pad, gloss)), gloss);
        }
    }

    #[test]
    fn right_is_sharper_and_up_is_stronger_up_to_the_edges() {
        let pad = Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 80.0));
        let low = gloss_at(pad, pos2(20.0, 70.0));
        let high = gloss_at(pad, pos2(80.0, 10.0));
        assert!(low.strength < high.strength && low.exponent < high.exponent, "{low:?} {high:?}");
        let beyond = gloss_at(pad, pos2(900.0, -50.0));
        assert_eq!(beyond, Gloss { strength: STRONGEST, exponent: EXPONENTS.1 });
    }
}
