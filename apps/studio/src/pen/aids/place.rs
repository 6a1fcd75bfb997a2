//! Places and directions in the plane of the canvas.

/// A place on the canvas or a way on it: right and down, in mm.
pub(super) type Place = [f64; 2];

/// The place at this way from another one.
pub(super) fn moved([x, y]: Place, [right, down]: Place, by: f64) -> Place {
    [x + right * by, y + down * by]
}

/// The way from one place to another.
pub(super) fn way([from_x, from_y]: Place, [to_x, to_y]: Place) -> Place {
    [to_x - from_x, to_y - from_y]
}

/// Scalar product of two ways.
pub(super) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// A way turned by a quarter, clockwise.
pub(super) fn across([right, down]: Place) -> Place {
    [-down, right]
}

/// Length of a way in mm.
pub(super) fn length([right, down]: Place) -> f64 {
    right.hypot(down)
}

/// The direction of a way as a way of length 1; `None` for a way without length.
pub(super) fn unit(of: Place) -> Option<Place> {
    let length = length(of);
    (length > 1e-9).then(|| of.map(|part| part / length))
}

/// Sine and cosine of an angle in degrees, exact at quarter turns.
pub(super) fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}
