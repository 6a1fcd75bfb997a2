//! Paintings made by code for tests: textures of strokes with known masks, directions and
//! spacings.

use graphics::field::Field;
use graphics::picture::Picture;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::marks::{Mark, MarkedArea, Marks};

const VALUES: usize = 1 << 12;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Brush {
    /// Broad strokes with dark furrows between them.
    Flat,
    /// Strokes with a light middle.
    Round,
    /// Strokes of uneven width.
    Loose,
    /// Thin dark lines on a light ground.
    Hatching,
    /// Dots at random places: neither direction nor distance.
    Specks,
}

impl Brush {
    pub(super) const ALL: [Self; 5] =
        [Self::Flat, Self::Round, Self::Loose, Self::Hatching, Self::Specks];

    pub(super) fn has_direction(self) -> bool {
        self != Self::Specks
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Texture {
    pub(super) brush: Brush,
    pub(super) degrees: f64,
    pub(super) spacing: f64,
    /// Encoded mean of red, green and blue.
    pub(super) color: [f64; 3],
    /// Difference of light and dark parts, encoded.
    pub(super) contrast: f64,
}

impl Default for Texture {
    fn default() -> Self {
        let color = [0.5, 0.4, 0.3];
        Self { brush: Brush::Flat, degrees: 90.0, spacing: 10.0, color, contrast: 0.2 }
    }
}

impl Texture {
    /// Encoded colour at a place. Pass numbers from -1 to 1 as `random`.
    fn at(&self, x: f64, y: f64, random: &[f64]) -> [f64; 3] {
        fn noise(a: i64, b: i64, channel: i64, random: &[f64]) -> f64 {
            let mixed = (a * 0x9E37_79B1 + b * 0x85EB_CA77 + channel * 0xC2B2_AE3D) as u64;
            random[(mixed ^ (mixed >> 15)) as usize % VALUES]
        }
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        let across = (y * cos - x * sin) / self.spacing;
        let along = (x * cos + y * sin) / self.spacing;
        let (profile, row, part) = if self.brush == Brush::Specks {
            let mut found = (-0.5, 0, 0);
            for (i, j) in (0..9).map(|i| (across as i64 - 1 + i % 3, along as i64 - 1 + i / 3)) {
                let middle = [0, 1].map(|k| 0.5 + 0.5 * noise(i, j, 7 + k, random));
                let off = (across - i as f64 - middle[0]).hypot(along - j as f64 - middle[1]);
                let value = (-(off / 0.3).powi(2)).exp() - 0.5;
                if value > found.0 {
                    found = (value, i, j);
                }
            }
            found
        } else {
            let uneven = if self.brush == Brush::Loose { 0.12 } else { 0.0 };
            let edge = |row: i64| row as f64 + uneven * noise(row, 0, 9, random);
            let mut row = across.floor() as i64;
            row += i64::from(across >= edge(row + 1)) - i64::from(across < edge(row));
            let place = (across - edge(row)) / (edge(row + 1) - edge(row));
            let profile = match self.brush {
                Brush::Flat | Brush::Loose => (std::f64::consts::PI * place).sin().powf(0.6) - 0.7,
                Brush::Round => (-((place - 0.5) / 0.25).powi(2)).exp() - 0.5,
                Brush::Hatching | Brush::Specks => 0.2 - (-((place - 0.5) / 0.15).powi(2)).exp(),
            };
            let part = (along / 6.0 + 3.0 * noise(row, 1, 8, random)).floor() as i64;
            (profile, row, part)
        };
        [0, 1, 2].map(|channel| {
            let uneven = 0.25 * noise(row, part, 4, random)
                + 0.12 * noise(row, part, channel as i64, random);
            (self.color[channel] + self.contrast * (profile + uneven)).clamp(0.0, 1.0)
        })
    }
}

/// A picture in linear light. `texture_at` gives the texture of each pixel.
pub(super) fn textured(
    width: usize,
    height: usize,
    seed: u64,
    textures: &[Texture],
    texture_at: impl Fn(usize, usize) -> usize,
) -> Picture {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let values: Vec<f64> = (0..VALUES).map(|_| random.random_range(-1.0..1.0)).collect();
    let grain: Vec<f64> = (0..VALUES).map(|_| random.random_range(-0.012..0.012)).collect();
    Field::from_values(
        width,
        height,
        (0..width * height)
            .map(|i: usize| {
                let x = i % width;
                let y = i / width;
                let texture = &textures[texture_at(x, y)];
                let mut sum = [0.0; 3];
                for k in 0..4 {
                    fn place(at: usize, half: usize) -> f64 {
                        at as f64 + 0.5 * half as f64 - 0.25
                    }
                    // We stay away from 0, so that truncating is rounding down.
                    let color = texture.at(place(x, k % 2) + 1e3, place(y, k / 2) + 1e3, &values);
                    (0..3).for_each(|channel| sum[channel] += color[channel] / 4.0);
                }
                let grain = grain[(x * 7919 + y * 104_729) % VALUES];
                sum.map(|value| (value + grain).clamp(0.0, 1.0).powf(2.2) as f32)
            })
            .collect(),
    )
}

pub(super) struct Painting {
    pub(super) name: &'static str,
    pub(super) textures: Vec<Texture>,
    texture_of: fn(f64, f64) -> usize,
    /// Ends of the scribble of each texture, in shares of width and height.
    scribbles: Vec<[[f64; 2]; 2]>,
}

pub(super) const WIDTH: usize = 260;
pub(super) const HEIGHT: usize = 200;

fn texture(brush: Brush, degrees: f64, spacing: f64, color: [f64; 3]) -> Texture {
    Texture { brush, degrees, spacing, color, contrast: 0.18 }
}

impl Painting {
    pub(super) fn all() -> Vec<Self> {
        vec![
            Self::halves(),
            Self::turned(),
            Self::stripes(),
            Self::disc(),
            Self::quarters(),
            Self::landscape(),
        ]
    }

    /// Two tones with a wavy border.
    fn halves() -> Self {
        Self {
            name: "halves",
            textures: vec![
                texture(Brush::Flat, 20.0, 9.0, [0.30, 0.25, 0.35]),
                texture(Brush::Round, 100.0, 11.0, [0.65, 0.60, 0.45]),
            ],
            texture_of: |x, y| usize::from(x > 0.5 + 0.06 * (9.0 * y).sin()),
            scribbles: vec![[[0.1, 0.2], [0.35, 0.8]], [[0.65, 0.2], [0.9, 0.8]]],
        }
    }

    /// One tone in two directions, with a change of hue.
    fn turned() -> Self {
        Self {
            name: "turned",
            textures: vec![
                texture(Brush::Flat, 0.0, 10.0, [0.55, 0.45, 0.30]),
                texture(Brush::Flat, 70.0, 10.0, [0.30, 0.50, 0.52]),
            ],
            texture_of: |x, y| usize::from(y > 0.35 + 0.3 * x),
            scribbles: vec![[[0.2, 0.1], [0.8, 0.3]], [[0.1, 0.6], [0.7, 0.8]]],
        }
    }

    pub(super) fn stripes() -> Self {
        Self {
            name: "stripes",
            textures: vec![
                texture(Brush::Flat, 85.0, 8.0, [0.25, 0.22, 0.30]),
                texture(Brush::Loose, 30.0, 10.0, [0.60, 0.35, 0.25]),
                texture(Brush::Round, 150.0, 9.0, [0.75, 0.72, 0.60]),
            ],
            texture_of: |x, _| usize::from(x > 0.35) + usize::from(x > 0.68),
            scribbles: vec![
                [[0.1, 0.1], [0.25, 0.9]],
                [[0.45, 0.1], [0.6, 0.9]],
                [[0.78, 0.1], [0.9, 0.9]],
            ],
        }
    }

    fn disc() -> Self {
        Self {
            name: "disc",
            textures: vec![
                texture(Brush::Flat, 5.0, 9.0, [0.35, 0.45, 0.60]),
                texture(Brush::Round, 60.0, 8.0, [0.80, 0.65, 0.30]),
                texture(Brush::Hatching, 120.0, 7.0, [0.35, 0.40, 0.22]),
            ],
            texture_of: |x, y| match (1.3 * (x - 0.5)).hypot(y - 0.38) < 0.3 {
                true => 1,
                false => 2 * usize::from(y > 0.75),
            },
            scribbles: vec![
                [[0.05, 0.05], [0.1, 0.65]],
                [[0.4, 0.3], [0.6, 0.5]],
                [[0.2, 0.88], [0.8, 0.92]],
            ],
        }
    }

    pub(super) fn quarters() -> Self {
        Self {
            name: "quarters",
            textures: vec![
                texture(Brush::Flat, 40.0, 9.0, [0.22, 0.28, 0.40]),
                texture(Brush::Specks, 0.0, 7.0, [0.60, 0.55, 0.30]),
                texture(Brush::Round, 170.0, 10.0, [0.55, 0.30, 0.25]),
                texture(Brush::Loose, 110.0, 8.0, [0.80, 0.78, 0.72]),
            ],
            texture_of: |x, y| usize::from(x > 0.52) + 2 * usize::from(y > 0.48),
            scribbles: vec![
                [[0.1, 0.1], [0.4, 0.4]],
                [[0.65, 0.1], [0.9, 0.4]],
                [[0.1, 0.6], [0.4, 0.9]],
                [[0.65, 0.6], [0.9, 0.9]],
            ],
        }
    }

    /// Sky, sun, hill, field and path.
    fn landscape() -> Self {
        Self {
            name: "landscape",
            textures: vec![
                texture(Brush::Flat, 2.0, 8.0, [0.50, 0.60, 0.75]),
                texture(Brush::Specks, 0.0, 6.0, [0.90, 0.78, 0.40]),
                texture(Brush::Round, 35.0, 9.0, [0.28, 0.38, 0.30]),
                texture(Brush::Loose, 95.0, 7.0, [0.62, 0.55, 0.20]),
                texture(Brush::Flat, 130.0, 8.0, [0.45, 0.30, 0.25]),
            ],
            texture_of: |x, y| {
                if (1.3 * (x - 0.75)).hypot(y - 0.2) < 0.17 {
                    return 1;
                }
                match y {
                    _ if y < 0.42 + 0.1 * (5.0 * x).sin() => 0,
                    _ if y < 0.68 => 2,
                    _ => 3 + usize::from(x > 0.55 + 0.15 * (y - 0.68)),
                }
            },
            scribbles: vec![
                [[0.1, 0.1], [0.5, 0.3]],
                [[0.7, 0.15], [0.8, 0.25]],
                [[0.45, 0.55], [0.9, 0.55]],
                [[0.1, 0.8], [0.45, 0.9]],
                [[0.7, 0.8], [0.9, 0.9]],
            ],
        }
    }

    pub(super) fn texture_at(&self, x: usize, y: usize) -> usize {
        (self.texture_of)((x as f64 + 0.5) / WIDTH as f64, (y as f64 + 0.5) / HEIGHT as f64)
    }

    pub(super) fn picture(&self) -> Picture {
        textured(WIDTH, HEIGHT, 7, &self.textures, |x, y| self.texture_at(x, y))
    }

    /// Scribbles with the true spacings, named by the number of their texture.
    pub(super) fn marks(&self) -> Marks {
        let samples = self.textures.iter().zip(&self.scribbles).enumerate();
        let samples = samples.map(|(number, (texture, line))| Mark {
            name: number.to_string(),
            area: MarkedArea::Scribble(
                line.map(|[x, y]: [f64; 2]| [x * WIDTH as f64, y * HEIGHT as f64]).to_vec(),
            ),
            spacing: Some([[10.0, 10.0], [10.0 + texture.spacing, 10.0]]),
        });
        Marks { file: self.name.to_owned(), painting: None, samples: samples.collect() }
    }
}
