//! J of each pixel: how far the classes in a window around it lie apart.
//!
//! J = (S_T - S_W) / S_W, where S_T is the scatter of all places about their mean and S_W that
//! within the classes (Deng and Manjunath 2001, equations 1 to 5). Inside a texture the classes
//! are mixed and J is small; at a border of textures it is large.

use graphics::field::Field;
use rayon::prelude::*;

/// Radius of the window at the finest scale, so that it is 9 pixels wide.
const RADIUS: isize = 4;

/// Largest number of classes.
const MOST_CLASSES: usize = 32;

/// Largest value of J, of windows in which no class has two places.
const MOST: f32 = 100.0;

/// J of every pixel in a round window of 8 `step` + 1 pixels, of which each `step`-th pixel along
/// both axes is looked at: 69 places at every scale.
///
/// # Panics
/// If a class is 32 or above.
pub(super) fn j_values(classes: &Field<u8>, step: usize) -> Field<f32> {
    let width = classes.width() as isize;
    let height = classes.height() as isize;
    let step = step as isize;
    let disc: Vec<(isize, isize)> = (-RADIUS..=RADIUS)
        .flat_map(|y| (-RADIUS..=RADIUS).map(move |x| (x, y)))
        .filter(|(x, y)| x * x + y * y <= RADIUS * (RADIUS + 1))
        .collect();
    let mut found = Field::filled(classes.width(), classes.height(), 0.0);
    found.values_mut().par_chunks_mut(classes.width().max(1)).enumerate().for_each(|(y, row)| {
        let y = y as isize;
        for (x, j) in row.iter_mut().enumerate() {
            let x = x as isize;
            let mut window = Window::default();
            for &(dx, dy) in &disc {
                let px = x + dx * step;
                let py = y + dy * step;
                if px >= 0 && px < width && py >= 0 && py < height {
                    let class = classes[(px as usize, py as usize)];
                    window.add(class, dx as i32, dy as i32);
                }
            }
            *j = window.j();
        }
    });
    found
}

/// Sums of the places in a window by class: their number, x and y.
#[derive(Default)]
struct Window {
    by_class: [[i32; 3]; MOST_CLASSES],
    squares: i32,
}

impl Window {
    #[inline]
    fn add(&mut self, class: u8, x: i32, y: i32) {
        let sums = &mut self.by_class[class as usize];
        *sums = [sums[0] + 1, sums[1] + x, sums[2] + y];
        self.squares += x * x + y * y;
    }

    fn j(&self) -> f32 {
        let about = |[count, x, y]: [i32; 3]| match count {
            0 => 0.0,
            count => (x * x + y * y) as f32 / count as f32,
        };
        let mut whole = [0; 3];
        let mut means = 0.0;
        for class in self.by_class {
            whole = [0, 1, 2].map(|i| whole[i] + class[i]);
            means += about(class);
        }
        let total = self.squares as f32 - about(whole);
        let within = (self.squares as f32 - means).max(0.0);
        let between = (total - within).max(0.0);
        if between <= MOST * within { between / within.max(f32::MIN_POSITIVE) } else { MOST }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(width: usize, height: usize, class: impl Fn(usize, usize) -> u8) -> Field<u8> {
        let values = (0..width * height).map(|i| class(i % width, i / width)).collect();
        Field::from_values(width, height, values)
    }

    #[test]
    fn an_even_mixture_has_j_near_0_and_one_class_0() {
        let checks = j_values(&map(40, 40, |x, y| ((x + y) % 2) as u8), 1);
        assert!(checks[(20, 20)] < 0.01, "{}", checks[(20, 20)]);
        let even = j_values(&map(40, 40, |_, _| 3), 1);
        assert!(even.values().iter().all(|&j| j == 0.0), "one class");
    }

    #[test]
    fn two_half_discs_have_the_j_of_their_means() {
        let halves = map(40, 40, |x, _| u8::from(x > 20));
        // By the definition, from the places themselves.
        let mut places = Vec::new();
        for y in -4i32..=4 {
            for x in -4i32..=4 {
                if x * x + y * y <= 20 {
                    places.push((f64::from(x), f64::from(y), x > 0));
                }
            }
        }
        let scatter = |chosen: &dyn Fn(bool) -> bool| {
            let of: Vec<_> = places.iter().filter(|place| chosen(place.2)).collect();
            let count = of.len() as f64;
            let mean = of.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / count, m.1 + p.1 / count));
            of.iter().map(|p| (p.0 - mean.0).powi(2) + (p.1 - mean.1).powi(2)).sum::<f64>()
        };
        let within = scatter(&|right| right) + scatter(&|right| !right);
        let wanted = (scatter(&|_| true) - within) / within;
        let found = f64::from(j_values(&halves, 1)[(20, 20)]);
        assert!((found - wanted).abs() < 1e-4, "{found}, wanted {wanted}");
        assert!(found > 0.5, "{found}");
    }

    #[test]
    fn a_larger_window_sees_a_border_from_further_away() {
        let halves = map(80, 80, |x, _| u8::from(x > 40));
        assert_eq!(j_values(&halves, 1)[(30, 40)], 0.0);
        assert!(j_values(&halves, 4)[(30, 40)] > 0.1, "33 pixels wide");
    }
}
