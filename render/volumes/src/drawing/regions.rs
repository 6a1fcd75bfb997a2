//! Regions: volumes that are counted together and bring one colour.

use graphics::compute::{ColorImage, Image};

use super::error::{DrawingError, check_range};
use super::shells::TintTable;

/// Most regions of a picture.
pub const MOST_REGIONS: usize = 64;

/// Colours that are seen inside of the volumes of a region.
#[derive(Debug, Clone)]
pub enum Inside {
    /// The surface's own colour.
    OwnColors,
    /// The surface's own colour times one colour, encoded sRGB in 0..1.
    Multiplied([f32; 3]),
    /// A picture of the size of the shaded one, encoded sRGB; its fourth value is not used. This
    /// is where films of pigment come in.
    Picture(ColorImage),
}

/// A region of a picture.
#[derive(Debug, Clone)]
pub struct Region {
    /// Volumes and shells that hold what each sample shows, as many as the shaded picture has
    /// pixels.
    pub counts: Image<i32>,
    /// Share of the colour inside, by count.
    pub table: TintTable,
    /// Colours inside.
    pub inside: Inside,
}

/// Checks the number of regions and their colours.
///
/// # Errors
/// [`DrawingError::Regions`]; [`DrawingError::Setting`] for a colour out of 0..1 or no number.
pub fn checked_regions(regions: &[Region]) -> Result<(), DrawingError> {
    if regions.len() > MOST_REGIONS {
        return Err(DrawingError::Regions { most: MOST_REGIONS, found: regions.len() });
    }
    for region in regions {
        if let Inside::Multiplied(color) = region.inside {
            for value in color {
                check_range("colour of a region", value, [0.0, 1.0])?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::field::Field;

    #[test]
    fn too_many_regions_and_colours_that_are_none_are_refused() {
        let region = |inside| Region {
            counts: Field::filled(1, 1, 0).into(),
            table: TintTable::hard(),
            inside,
        };
        let own = region(Inside::OwnColors);
        assert_eq!(checked_regions(&vec![own.clone(); 64]), Ok(()));
        let error = checked_regions(&vec![own; 65]).unwrap_err();
        assert_eq!(error.to_string(), "a picture has at most 64 regions, found `65`");
        let error = checked_regions(&[region(Inside::Multiplied([0.5, f32::NAN, 0.1]))]);
        assert!(matches!(error, Err(DrawingError::Setting { .. })));
    }
}
