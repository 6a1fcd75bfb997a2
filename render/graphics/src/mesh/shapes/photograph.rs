//! A photograph as a flat model.

use glam::{Vec2, Vec3};

use super::grid::GridSize;
use crate::field::Field;
use crate::mesh::model::{Material, Mesh, Texture};

impl Mesh {
    /// A picture, encoded sRGB with opacity in 0..1, as a rectangle of two triangles in the plane
    /// z = 0 around the origin, towards +z. Its longer side is 1; `camera::PictureView` has
    /// cameras that see it. Transparent parts are white.
    ///
    /// # Panics
    /// If the picture has no pixels, or a side of 2^32 or more.
    #[must_use]
    pub fn of_picture(picture: &Field<[f32; 4]>) -> Self {
        let width = picture.width();
        let height = picture.height();
        assert!(width > 0 && height > 0, "a picture of {width} x {height} pixels");
        let texture = Texture {
            width: u32::try_from(width).unwrap_or(u32::MAX),
            height: u32::try_from(height).unwrap_or(u32::MAX),
            texels: picture
                .values()
                .iter()
                .map(|&[r, g, b, opacity]: &[f32; 4]| {
                    let channel = |value: f32| {
                        ((value * opacity + 1.0 - opacity).clamp(0.0, 1.0) * 255.0).round() as u8
                    };
                    u32::from_le_bytes([channel(r), channel(g), channel(b), u8::MAX])
                })
                .collect(),
        };
        let material = Material { texture: Some(texture), ..Material::plain([1.0; 3]) };
        let mut mesh = Self { materials: vec![material], ..Self::default() };
        let sides = Vec2::new(width as f32, height as f32) / width.max(height) as f32;
        mesh.add_grid(GridSize { columns: 1, rows: 1 }, 0, |uv| {
            let at = (uv - 0.5) * sides;
            Vec3::new(at.x, -at.y, 0.0)
        });
        // Textures repeat: corners keep to the middles of the outer texels.
        let half = Vec2::new(0.5 / width as f32, 0.5 / height as f32);
        for at in &mut mesh.texture_coordinates {
            *at = Vec2::from(*at).clamp(half, Vec2::ONE - half).to_array();
        }
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_lies_upright_with_its_pixels_in_order() {
        let picture = Field::from_values(
            6,
            4,
            (0..24)
                .map(|i: usize| [(i % 6) as f32 / 5.0, (i / 6) as f32 / 3.0, 0.2, 1.0])
                .collect(),
        );
        let mesh = Mesh::of_picture(&picture);
        assert_eq!(mesh.check(), Ok(()));
        let upper_left = mesh.positions.iter().position(|&[x, y, _]| x < 0.0 && y > 0.0).unwrap();
        assert_eq!(mesh.positions[upper_left], [-0.5, 2.0 / 6.0, 0.0]);
        assert_eq!(mesh.texture_coordinates[upper_left], [0.5 / 6.0, 0.5 / 4.0]);
        assert!(mesh.normals.iter().all(|&normal| Vec3::from(normal).distance(Vec3::Z) < 1e-5));
        let texture = mesh.materials[0].texture.as_ref().unwrap();
        assert_eq!(texture.texels[6 + 5].to_le_bytes(), [255, 85, 51, 255]);
        let clear = Mesh::of_picture(&Field::filled(1, 1, [0.0; 4]));
        let texture = clear.materials[0].texture.as_ref().unwrap();
        assert_eq!(texture.texels, [u32::MAX]);
    }
}
