//! Pictures with known regions, generated exactly as in `tests/golden/segmentation.py`.

use graphics::field::Field;
use serde::Deserialize;

pub(super) const WIDTH: usize = 160;
pub(super) const HEIGHT: usize = 120;

/// A shape with a soft outline, drawn over those before it. `across` and `down` are the changes of
/// colour to the right and to the bottom; `texture` is the amplitude of a diagonal wave.
#[derive(Deserialize)]
struct Shape {
    kind: String,
    numbers: Vec<f64>,
    rgb: [f64; 3],
    across: [f64; 3],
    down: [f64; 3],
    texture: f64,
    period: f64,
    soft: f64,
}

/// Number of regions found, with recall and precision of their boundaries.
#[derive(Deserialize, Debug)]
pub(super) struct Found {
    pub(super) regions: usize,
    pub(super) recall: f64,
    pub(super) precision: f64,
}

/// A picture as the golden file describes it, with OpenCV's results by range radius.
#[derive(Deserialize)]
pub(super) struct Told {
    pub(super) name: String,
    seed: u64,
    noise: f64,
    shapes: Vec<Shape>,
    fnv: u32,
    pub(super) opencv: Vec<Found>,
}

/// Linear congruential generator of numbers in 0..1.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 32) as f64 / 4294967296.0
    }
}

impl Shape {
    /// Signed distance of a position from the outline in pixels, negative inside.
    fn distance(&self, x: f64, y: f64) -> f64 {
        let n = &self.numbers;
        match self.kind.as_str() {
            "everywhere" => -1e6,
            "disc" => ((x - n[0]) * (x - n[0]) + (y - n[1]) * (y - n[1])).sqrt() - n[2],
            "half" => n[2] - (n[0] * x + n[1] * y),
            "line" => (n[0] * x + n[1] * y - n[2]).abs() - n[3],
            other => panic!("a shape of kind `{other}`"),
        }
    }
}

impl Told {
    /// The picture in encoded sRGB with coverage, and the index of the topmost shape by pixel.
    pub(super) fn made(&self) -> (Field<[f32; 4]>, Field<u32>) {
        let mut random = Noise(self.seed);
        let mut truth = Field::filled(WIDTH, HEIGHT, 0);
        let mut bytes = Vec::new();
        for row in 0..HEIGHT {
            for column in 0..WIDTH {
                let x = column as f64;
                let y = row as f64;
                let mut colors = [0.0; 3];
                for (number, shape) in (0..).zip(&self.shapes) {
                    let away = shape.distance(x, y);
                    if away < 0.0 {
                        truth[(column, row)] = number;
                    }
                    let t = (0.5 - away / (2.0 * shape.soft)).clamp(0.0, 1.0);
                    let cover = t * t * (3.0 - 2.0 * t);
                    let turn = (x + 2.0 * y) / shape.period;
                    let turn = turn - turn.trunc();
                    let wave = shape.texture * (4.0 * (turn - 0.5).abs() - 1.0);
                    for (i, color) in colors.iter_mut().enumerate() {
                        let own = shape.rgb[i] + shape.across[i] * (x / WIDTH as f64);
                        let own = own + shape.down[i] * (y / HEIGHT as f64) + wave;
                        *color += cover * (own - *color);
                    }
                }
                for color in colors {
                    let draws = random.next() + random.next() + random.next() + random.next();
                    let value: f64 = color + self.noise * 1.75 * (draws - 2.0);
                    bytes.push((value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
                }
            }
        }
        let found = bytes.iter().fold(2166136261, |sum: u32, &byte: &u8| {
            (sum ^ u32::from(byte)).wrapping_mul(16777619)
        });
        assert_eq!(found, self.fnv, "{}: not the picture given to OpenCV", self.name);
        (opaque(WIDTH, HEIGHT, &bytes), truth)
    }
}

/// An opaque picture of RGB bytes.
pub(super) fn opaque(width: usize, height: usize, bytes: &[u8]) -> Field<[f32; 4]> {
    Field::from_values(
        width,
        height,
        bytes
            .chunks_exact(3)
            .map(|rgb: &[u8]| [rgb[0], rgb[1], rgb[2], 255].map(|byte| f32::from(byte) / 255.0))
            .collect(),
    )
}
