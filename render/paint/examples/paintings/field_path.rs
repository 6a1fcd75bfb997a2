//! Layout of the landscape: its size, the horizon and the path through the field.

/// Width of the canvas in mm.
pub(crate) const WIDTH: f64 = 200.0;
/// Height of the canvas in mm.
pub(crate) const HEIGHT: f64 = 140.0;

/// Distance of the horizon from the top in mm; the field begins there.
pub(crate) const HORIZON: f64 = 62.0;

/// Middle and half width of the path in mm, `y` mm below the top.
pub(crate) fn path(y: f64) -> (f64, f64) {
    let near = ((y - HORIZON) / (HEIGHT - HORIZON)).clamp(0.0, 1.2);
    (92.0 - 8.0 * (near * 3.6).sin() + 34.0 * near * near, 1.2 + 13.0 * near.powf(1.4))
}
