//! Mesh of a bent head, for drawing.

use super::b_spline::b_spline;
use super::net::{Net, Point};
use super::surface::SPANS;

/// Number of vertices for each span of the surface along the head.
const ALONG: usize = 3;

/// Minimum number of vertices around a head.
const AROUND: usize = 24;

/// Surface of a head over the canvas: rows of vertices around it, from the ferrule to the tip.
#[derive(Debug, Clone, PartialEq)]
pub struct HeadMesh {
    /// Number of vertices around the head; the last is next to the first.
    pub around: usize,
    /// Number of rows, from the open ferrule to the closed tip.
    pub along: usize,
    /// `around * along` vertices: x and y in cells of the canvas, height over its plane in
    /// cells. Where hair is pressed into the canvas they lie slightly below it.
    pub vertices: Vec<[f32; 3]>,
}

impl HeadMesh {
    /// Mesh of the surface of `net`, whose coordinates start at the cell `origin`: 300 to 600
    /// vertices.
    pub(super) fn of(net: &Net, origin: (i64, i64)) -> Self {
        let steps = AROUND.div_ceil(net.columns);
        let weights: Vec<_> = (0..steps).map(|i| b_spline(i as f32 / steps as f32)).collect();
        let around = net.columns * steps;
        let along = SPANS * ALONG + 1;
        let mut vertices = Vec::with_capacity(around * along);
        let mut line = vec![[0.0; 3]; net.columns];
        for row in 0..along {
            let span = (row / ALONG).min(SPANS - 1);
            let here = b_spline((row - span * ALONG) as f32 / ALONG as f32);
            for (column, point) in line.iter_mut().enumerate() {
                *point = combined(
                    here,
                    std::array::from_fn(|i: usize| {
                        first(&net.points[(span + i) * net.columns + column])
                    }),
                );
            }
            for column in 0..net.columns {
                let four = std::array::from_fn(|i: usize| {
                    line[(column + net.columns - 1 + i) % net.columns]
                });
                vertices.extend(weights.iter().map(|weights| {
                    let [x, y, z] = combined(*weights, four);
                    [x + origin.0 as f32, y + origin.1 as f32, z]
                }));
            }
        }
        Self { around, along, vertices }
    }
}

fn first(&[x, y, z, ..]: &Point) -> [f32; 3] {
    [x, y, z]
}

fn combined(weights: [f32; 4], points: [[f32; 3]; 4]) -> [f32; 3] {
    std::array::from_fn(|i| weights.iter().zip(&points).map(|(w, point)| w * point[i]).sum())
}

#[cfg(test)]
mod tests {
    use super::super::{Head, HeadShape, Relief};
    use crate::contact::Contact;
    use crate::pose::Pose;
    use graphics::tile::Rect;

    const POSE: Pose = Pose {
        x: 150.4,
        y: 100.2,
        pressure: 0.6,
        tilt_x_deg: 20.0,
        tilt_y_deg: 0.0,
        twist_deg: 90.0,
    };

    const BOUNDS: Rect = Rect { x: 0, y: 0, width: 400, height: 300 };

    /// Extent along x, y and height in cells.
    fn extent(vertices: &[[f32; 3]]) -> [(f32, f32); 3] {
        std::array::from_fn(|i| {
            let of = vertices.iter().map(|vertex| vertex[i]);
            (of.clone().fold(f32::INFINITY, f32::min), of.fold(f32::NEG_INFINITY, f32::max))
        })
    }

    #[test]
    fn a_hovering_head_stands_over_its_place_and_touches_nothing() {
        let relief = Relief::flat(400, 300, 0.1);
        for shape in HeadShape::ALL {
            let mut head = Head::new(shape, 4.0, 0.1).unwrap();
            assert_eq!(head.mesh(), None, "{shape} was never seen");
            head.hover(&Pose { tilt_x_deg: 0.0, ..POSE }, &relief);
            let mesh = head.mesh().unwrap();
            assert_eq!(mesh.vertices.len(), mesh.around * mesh.along, "{shape}");
            assert!((200..=600).contains(&mesh.vertices.len()), "{shape}: {}", mesh.vertices.len());
            let [x, y, height] = extent(&mesh.vertices);
            assert!((-0.5..2.5).contains(&height.0), "{shape}: {height:?}");
            assert!(height.1 > 10.0, "{shape}: {height:?}");
            // The tip is where the pen points.
            let tip = &mesh.vertices[mesh.around * (mesh.along - 1)..];
            let [tip_x, tip_y, _] = extent(tip);
            let inside = |(low, high): (f32, f32), at: f64| {
                low - 2.0 <= at as f32 && at as f32 <= high + 2.0
            };
            assert!(inside(tip_x, POSE.x) && inside(tip_y, POSE.y), "{shape}: {tip_x:?} {tip_y:?}");
            // 40 cells wide, and turned by 90 degrees.
            if shape != HeadShape::Knife {
                assert!((30.0..52.0).contains(&(y.1 - y.0)), "{shape}: {y:?}");
            }
            assert!(shape == HeadShape::Knife || x.1 - x.0 < 60.0, "{shape}: {x:?}");
        }
    }

    #[test]
    fn a_pressed_head_reaches_the_canvas_where_it_touches() {
        let relief = Relief::flat(400, 300, 0.1);
        for shape in HeadShape::ALL {
            let mut head = Head::new(shape, 4.0, 0.1).unwrap();
            let mut contact = Contact::default();
            head.set_down(&POSE, (1.0, 0.0), &relief);
            let mut pose = POSE;
            for _ in 0..20 {
                pose.x += 1.0;
                head.advance(&pose, &relief, BOUNDS, &mut contact);
            }
            let mesh = head.mesh().unwrap();
            let [x, y, height] = extent(&mesh.vertices);
            // Hair that gives way is drawn below the canvas, by up to half its thickness.
            assert!((-20.0..0.5).contains(&height.0), "{shape}: {height:?}");
            let rect = contact.rect;
            let left = rect.x as f32;
            let right = (rect.x + rect.width) as f32;
            let top = rect.y as f32;
            let bottom = (rect.y + rect.height) as f32;
            assert!(x.0 <= left + 2.0 && x.1 >= right - 2.0, "{shape}: {x:?} over {rect:?}");
            assert!(y.0 <= top + 2.0 && y.1 >= bottom - 2.0, "{shape}: {y:?} over {rect:?}");
            head.lift();
            assert_eq!(head.mesh(), None, "{shape} is lifted");
        }
    }

    #[test]
    fn hovering_before_a_stroke_leaves_no_trace_in_it() {
        let relief = Relief::flat(400, 300, 0.1);
        let contact = |hovers: bool| {
            let mut head = Head::new(HeadShape::Filbert, 4.0, 0.1).unwrap();
            if hovers {
                head.hover(&Pose { x: 20.0, twist_deg: 10.0, ..POSE }, &relief);
            }
            head.set_down(&POSE, (1.0, 0.0), &relief);
            let mut contact = Contact::default();
            head.advance(&Pose { x: POSE.x + 1.0, ..POSE }, &relief, BOUNDS, &mut contact);
            contact
        };
        assert!(contact(true) == contact(false), "another stroke");
    }
}
