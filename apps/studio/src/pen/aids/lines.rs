//! Lines that show the drawing aids.

use super::perspective::Perspective;
use super::place::{Place, across, dot, length, moved, unit, way};
use super::ruler::{Ruler, RulerShape};
use super::settings::{DrawingAids, GuideKind};

/// Lines of the fan of one vanishing point.
const FAN: usize = 16;

/// Lines beside a ruler of parallel lines, and ellipses around and in one, on each side.
const BESIDE: i8 = 3;

/// Pieces that an ellipse is drawn with.
const PIECES: usize = 96;

/// Polylines that show the drawing aids, in mm of the canvas. They reach beyond it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AidLines {
    /// The ruler, the horizon and the axes of symmetry.
    pub main: Vec<Vec<[f64; 2]>>,
    /// Fans of the vanishing points, parallel lines and ellipses of the same form.
    pub faint: Vec<Vec<[f64; 2]>>,
}

impl DrawingAids {
    /// Lines of all aids that are shown.
    #[must_use]
    pub fn lines(&self) -> AidLines {
        let mut lines = AidLines::default();
        // Far enough to leave the canvas from every place on it.
        let far = 2.0 * length(self.canvas_mm);
        match self.guide {
            Some(GuideKind::Ruler) => self.ruler.lines(self.canvas_mm, far, &mut lines),
            Some(GuideKind::Perspective) => {
                self.perspective.lines(self.canvas_mm, far, &mut lines);
            }
            None => {}
        }
        if self.symmetry.on {
            let centre = self.symmetry.centre;
            let rays = self.symmetry.rays().into_iter();
            lines.main.extend(rays.map(|ray| vec![centre, moved(centre, ray, far)]));
        }
        lines
    }
}

impl Ruler {
    fn lines(&self, [width, height]: Place, far: f64, lines: &mut AidLines) {
        if let RulerShape::Ellipse | RulerShape::Concentric = self.shape {
            let Some(axes) = self.axes() else { return };
            lines.main.push(ellipse(self.middle, axes, 1.0));
            if self.shape == RulerShape::Concentric {
                let scales = (1..=BESIDE).map(|at| f64::from(at) / f64::from(BESIDE + 1));
                let scales = scales.flat_map(|scale| [scale, 1.0 + scale]);
                lines.faint.extend(scales.map(|scale| ellipse(self.middle, axes, scale)));
            }
            return;
        }
        let Some(along) = unit(way(self.ends[0], self.ends[1])) else { return };
        let through = |at: Place| vec![moved(at, along, -far), moved(at, along, far)];
        lines.main.push(through(self.ends[0]));
        if self.shape == RulerShape::Parallel {
            let step = 0.12 * width.min(height);
            let places = (-BESIDE..=BESIDE).filter(|at| *at != 0);
            let places = places.map(|at| moved(self.ends[0], across(along), f64::from(at) * step));
            lines.faint.extend(places.map(through));
        }
    }
}

impl Perspective {
    fn lines(&self, canvas: Place, far: f64, lines: &mut AidLines) {
        let at = self.in_use()[0];
        let along = self.horizon();
        // The horizon crosses the canvas wherever its vanishing point is.
        let reach = far + self.in_use().iter().map(|&point| length(way(at, point))).sum::<f64>();
        let reach = reach + length(way(at, [0.0; 2]));
        lines.main.push(vec![moved(at, along, -reach), moved(at, along, reach)]);
        for &point in self.in_use() {
            lines.faint.extend(fan(point, canvas));
        }
    }
}

/// Lines from a vanishing point over a canvas: at even angles between its corners, or all around a
/// point on it.
fn fan(point: Place, [width, height]: Place) -> Vec<Vec<Place>> {
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    let far = corners.map(|corner| length(way(point, corner))).into_iter().fold(0.0, f64::max);
    let on = (0.0..=width).contains(&point[0]) && (0.0..=height).contains(&point[1]);
    let Some(middle) = unit(way(point, [0.5 * width, 0.5 * height])).filter(|_| !on) else {
        let step = std::f64::consts::TAU / (2 * FAN) as f64;
        return (0..2 * FAN)
            .map(|at: usize| {
                let (sin, cos) = (at as f64 * step).sin_cos();
                vec![point, moved(point, [cos, sin], far)]
            })
            .collect();
    };
    let angles = corners.map(|corner| {
        let to = way(point, corner);
        dot(across(middle), to).atan2(dot(middle, to))
    });
    let [least, most] =
        [angles.into_iter().fold(0.0, f64::min), angles.into_iter().fold(0.0, f64::max)];
    (0..=FAN)
        .map(|at: usize| {
            let (sin, cos) = (least + (most - least) * at as f64 / FAN as f64).sin_cos();
            let direction = moved(middle.map(|part| part * cos), across(middle), sin);
            vec![point, moved(point, direction, far)]
        })
        .collect()
}

/// The outline of an ellipse whose half axes are scaled.
fn ellipse(middle: Place, axes: [Place; 2], scale: f64) -> Vec<Place> {
    (0..=PIECES)
        .map(|piece: usize| {
            let (sin, cos) = (std::f64::consts::TAU * piece as f64 / PIECES as f64).sin_cos();
            moved(moved(middle, axes[0], scale * cos), axes[1], scale * sin)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fans_cover_the_canvas_from_corner_to_corner() {
        let canvas = [200.0, 100.0];
        for point in [[-300.0, 40.0], [260.0, -20.0], [100.0, 4000.0]] {
            let rays = fan(point, canvas);
            assert_eq!(rays.len(), FAN + 1);
            // The sides of every line on which corners lie: none is beyond the first and the last.
            for (ray, wanted) in [(&rays[0], 1.0), (&rays[FAN], -1.0)] {
                let along = unit(way(ray[0], ray[1])).unwrap();
                let sides = [[0.0, 0.0], [200.0, 0.0], [200.0, 100.0], [0.0, 100.0]]
                    .map(|corner| wanted * dot(across(along), way(point, corner)));
                assert!(sides.into_iter().all(|side| side > -1e-6), "{point:?}: {sides:?}");
                assert!(sides.into_iter().any(|side| side < 1e-6), "{point:?}: {sides:?}");
            }
        }
        assert_eq!(fan([100.0, 30.0], canvas).len(), 2 * FAN, "all around");
    }

    #[test]
    fn what_is_off_has_no_lines() {
        let mut aids = DrawingAids::default();
        aids.fit([200.0, 100.0]);
        assert_eq!(aids.lines(), AidLines::default());
        aids.symmetry.on = true;
        assert_eq!(aids.lines().main.len(), 2, "both halves of the axis");
        aids.toggle(GuideKind::Perspective);
        let lines = aids.lines();
        assert_eq!((lines.main.len(), lines.faint.is_empty()), (3, false), "and the horizon");
        aids.toggle(GuideKind::Ruler);
        aids.ruler.shape = RulerShape::Concentric;
        let lines = aids.lines();
        assert_eq!((lines.main.len(), lines.faint.len()), (3, 6));
        aids.ruler.half_width_mm = 0.0;
        assert_eq!(aids.lines().main.len(), 2, "an ellipse without extent");
    }
}
