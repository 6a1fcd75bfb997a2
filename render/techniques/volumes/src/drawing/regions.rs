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
    /// Colour that what lies below is multiplied by where the count is above 0, encoded sRGB in
    /// 0..1: [`Region::UNSTAINED`], or the one colour of a stained drawing.
    pub stain: [f32; 3],
}

impl Region {
    /// The stain that leaves everything as it is.
    pub const UNSTAINED: [f32; 3] = [1.0; 3];
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
        for value in region.stain {
            check_range("stain of a region", value, [0.0, 1.0])?;
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
        let region = |stain| Region {
            counts: Field::filled(1, 1, 0).into(),
            table: TintTable::hard(),
            inside: Inside::OwnColors,
            stain,
        };
        let own = region(Region::UNSTAINED);
        assert_eq!(checked_regions(&vec![own.clone(); 64]), Ok(()));
        let error = checked_regions(&vec![own; 65]).unwrap_err();
        assert_eq!(error.to_string(), "a picture has at most 64 regions, found `65`");
        let error = checked_regions(&[region([0.5, f32::NAN, 0.1])]);
        assert!(matches!(error, Err(DrawingError::Setting { .. })));
    }
}
