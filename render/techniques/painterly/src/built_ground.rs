//! The ground of paintings of one size.

use paint::ground::{Ground, GroundError, GroundSpec};
use pigment::PigmentLibrary;

/// A ground, and what it was built from but for the library.
#[derive(Debug)]
pub(super) struct BuiltGround {
    spec: GroundSpec,
    size: (usize, usize),
    cell_mm: f64,
    ground: Ground,
}

impl BuiltGround {
    /// The ground of a painting of this size and width of cells. It is kept for the next one.
    pub(super) fn kept(
        kept: &mut Option<Self>,
        spec: &GroundSpec,
        (size, cell_mm): ((usize, usize), f64),
        library: &PigmentLibrary,
    ) -> Result<Ground, GroundError> {
        let same = |own: &&Self| own.spec == *spec && own.size == size && own.cell_mm == cell_mm;
        if let Some(own) = kept.as_ref().filter(same) {
            return Ok(own.ground.clone());
        }
        let ground = spec.build(size.0, size.1, cell_mm, library)?;
        *kept = Some(Self { spec: spec.clone(), size, cell_mm, ground: ground.clone() });
        Ok(ground)
    }
}

#[cfg(test)]
mod tests {
    use paint::ground::GroundKind;

    use super::*;

    #[test]
    fn another_ground_or_size_is_built_anew() {
        let library = PigmentLibrary::van_gogh_oils();
        let mut kept = None;
        let mut built = |kind: GroundKind, size: (usize, usize), cell_mm: f64| {
            let spec = kind.spec(1);
            let found = BuiltGround::kept(&mut kept, &spec, (size, cell_mm), &library).unwrap();
            assert_eq!(found, spec.build(size.0, size.1, cell_mm, &library).unwrap());
        };
        for size in [(12, 9), (12, 9), (9, 12)] {
            built(GroundKind::Linen, size, 0.2);
        }
        built(GroundKind::Panel, (9, 12), 0.2);
        built(GroundKind::Panel, (9, 12), 0.3);
    }
}
