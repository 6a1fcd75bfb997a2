//! Crossings of eye rays with faces of closed surfaces, and what is summed over them.

/// A crossing of the ray from the eye through the centre of a pixel with a face of a closed
/// surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Index of the pixel, row by row.
    pub pixel: usize,
    /// Index of the surface.
    pub surface: u32,
    /// Depth as in [`crate::surface::Fragment`]; above 1 beyond the far plane.
    pub depth: f32,
    /// 1 where the ray leaves the surface (a back face), -1 where it enters.
    pub sign: i32,
    /// Shares of the face's corners in 1 / w of the clip coordinates.
    pub(super) inverse_w: [f32; 3],
}

impl Crossing {
    /// Distance from the eye along the viewing direction (not along the ray), above 0, in the
    /// unit of the model.
    #[must_use]
    #[inline]
    pub fn view_depth(&self) -> f32 {
        let [a, b, c] = self.inverse_w;
        1.0 / (a + b + c)
    }
}

/// A sum over the crossings of each pixel's eye ray.
///
/// Crossings of a pixel are added in the order of the triangles. A sum in whole numbers that
/// wrap does not depend on that order.
pub trait CrossingSum: Sync {
    /// The sum of a pixel; its default is the sum over no crossing.
    type Sum: Copy + Default + Send + Sync;

    /// Whether crossings before the seen point are added too, and those of pixels that show
    /// nothing. Otherwise only crossings at or behind the seen point are added.
    const EVERY_CROSSING: bool = false;

    /// Adds a crossing to the sum of its pixel.
    fn add(&self, sum: &mut Self::Sum, crossing: &Crossing);
}

/// The number of closed surfaces that hold the seen point; 0 where nothing is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Count;

impl CrossingSum for Count {
    type Sum = i32;

    #[inline]
    fn add(&self, sum: &mut i32, crossing: &Crossing) {
        *sum = sum.wrapping_add(crossing.sign);
    }
}

/// The sum of the weights of the closed surfaces that hold the seen point; 0 where nothing is
/// seen or no surface holds it.
///
/// The function gives the weight of a surface (first argument) at a pixel (second argument).
/// It must be a function of these two alone, so that the crossings of a surface that does not
/// hold the point cancel. Sums beyond the range of `i32` wrap.
#[derive(Debug, Clone, Copy)]
pub struct WeighedCount<W>(pub W);

impl<W: Fn(u32, usize) -> i32 + Sync> CrossingSum for WeighedCount<W> {
    type Sum = i32;

    #[inline]
    fn add(&self, sum: &mut i32, crossing: &Crossing) {
        let weight = (self.0)(crossing.surface, crossing.pixel);
        *sum = sum.wrapping_add(crossing.sign.wrapping_mul(weight));
    }
}
