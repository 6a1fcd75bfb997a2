//! Concentric shells of a volume, and the tint at each count of them.

use documents::counted_as;
use documents::hint::Explain;

/// Most shells of a volume.
pub const MOST_SHELLS: usize = 63;

/// Shells or tints that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
#[hint("give tints that rise from 0 to 1, such as 0, 0.25, 0.5, 0.75, 1")]
pub enum ShellError {
    /// There is no shell, or there are too many.
    #[error("a volume has 1 to {MOST_SHELLS} shells, found `{0}`")]
    #[hint("give one tint for outside and one for each shell")]
    Count(usize),
    /// The number of tints is not the number of shells plus 1.
    #[error(
        "{} {} tints, from outside to the core; found `{tints}`",
        counted_as(*shells, "shell wants", "shells want"),
        .shells + 1
    )]
    #[hint("give one tint for outside and one for each shell")]
    Lengths {
        /// Number of shells.
        shells: usize,
        /// Number of tints.
        tints: usize,
    },
    /// A scale is outside of its range or NaN.
    #[error("scale {index} of the shells is not above 0 and at most 1: `{found}`")]
    #[hint("give scales that fall from 1, such as 1, 0.93, 0.86, 0.79")]
    Scale {
        /// Index of the scale, from 0.
        index: usize,
        /// The scale that was given.
        found: f32,
    },
    /// A shell is not smaller than the one before.
    #[error("scale {index} of the shells is not below the one before it: `{found}`")]
    #[hint("give scales that fall from 1, such as 1, 0.93, 0.86, 0.79")]
    NotFalling {
        /// Index of the scale, from 0.
        index: usize,
        /// The scale that was given.
        found: f32,
    },
    /// A tint is outside of its range or NaN.
    #[error("tint {index} is not within 0 to 1: `{found}`")]
    Tint {
        /// Index of the tint, from 0.
        index: usize,
        /// The tint that was given.
        found: f32,
    },
    /// A tint is below the one before it.
    #[error("tint {index} falls below the one before it: `{found}`")]
    NotRising {
        /// Index of the tint, from 0.
        index: usize,
        /// The tint that was given.
        found: f32,
    },
    /// The tint outside of all volumes is not 0.
    #[error("the first tint, outside of all volumes, is 0, found `{0}`")]
    Outside(f32),
}

/// The share of colour at each count of volumes or shells that hold a point.
#[derive(Debug, Clone, PartialEq)]
pub struct TintTable {
    tints: Vec<f32>,
}

impl TintTable {
    /// A table of tints. You give the tints at counts of 0, 1, 2 and so on.
    ///
    /// # Errors
    /// [`ShellError`] if there are fewer than 2 or more than 64, the first is not 0, one is not
    /// within 0..1, or one falls below the one before.
    pub fn new(tints: Vec<f32>) -> Result<Self, ShellError> {
        if !(2..=MOST_SHELLS + 1).contains(&tints.len()) {
            return Err(ShellError::Count(tints.len().saturating_sub(1)));
        }
        for (index, &found) in tints.iter().enumerate() {
            if !(0.0..=1.0).contains(&found) {
                return Err(ShellError::Tint { index, found });
            }
            if index > 0 && found < tints[index - 1] {
                return Err(ShellError::NotRising { index, found });
            }
        }
        if tints[0] != 0.0 {
            return Err(ShellError::Outside(tints[0]));
        }
        Ok(Self { tints })
    }

    /// Full colour inside, without shells.
    #[must_use]
    pub fn hard() -> Self {
        Self { tints: vec![0.0, 1.0] }
    }

    /// The tint at a count. If the count is higher than the table, you get the last tint, and for
    /// a negative count the first.
    #[must_use]
    #[inline(always)]
    pub fn tint(&self, count: i32) -> f32 {
        let last = self.tints.len() - 1;
        self.tints[(count.max(0) as usize).min(last)]
    }

    /// All tints, from count 0 on.
    #[must_use]
    pub fn tints(&self) -> &[f32] {
        &self.tints
    }
}

/// Concentric copies of a volume's mesh, scaled about its centre. Their counts add up to softer
/// edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Shells {
    scales: Vec<f32>,
    table: TintTable,
}

impl Shells {
    /// Shells of falling `scales` (above 0, at most 1). Pass one tint for outside and one for each
    /// count of shells.
    ///
    /// # Errors
    /// [`ShellError`] if the lists have other lengths or are not in order, or a value is out of its
    /// range.
    pub fn new(scales: Vec<f32>, tints: Vec<f32>) -> Result<Self, ShellError> {
        if !(1..=MOST_SHELLS).contains(&scales.len()) {
            return Err(ShellError::Count(scales.len()));
        }
        if tints.len() != scales.len() + 1 {
            return Err(ShellError::Lengths { shells: scales.len(), tints: tints.len() });
        }
        for (index, &found) in scales.iter().enumerate() {
            if !(found > 0.0 && found <= 1.0) {
                return Err(ShellError::Scale { index, found });
            }
            if index > 0 && found >= scales[index - 1] {
                return Err(ShellError::NotFalling { index, found });
            }
        }
        Ok(Self { scales, table: TintTable::new(tints)? })
    }

    /// One shell. This gives a hard edge.
    #[must_use]
    pub fn hard() -> Self {
        Self { scales: vec![1.0], table: TintTable::hard() }
    }

    /// Four shells, 7 % of the radius apart. Each brings a quarter of the colour.
    #[must_use]
    pub fn washed() -> Self {
        let tints = vec![0.0, 0.25, 0.5, 0.75, 1.0];
        Self { scales: vec![1.0, 0.93, 0.86, 0.79], table: TintTable { tints } }
    }

    /// Scales of the mesh about its centre, outermost first.
    #[must_use]
    pub fn scales(&self) -> &[f32] {
        &self.scales
    }

    /// Tints by count.
    #[must_use]
    pub fn table(&self) -> &TintTable {
        &self.table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_beyond_the_table_take_its_last_tint() {
        let washed = Shells::washed();
        let found = [-3, 0, 1, 3, 4, 5, i32::MAX].map(|count| washed.table().tint(count));
        assert_eq!(found, [0.0, 0.0, 0.25, 0.75, 1.0, 1.0, 1.0]);
        assert_eq!([0, 1, 2].map(|count| TintTable::hard().tint(count)), [0.0, 1.0, 1.0]);
        let again = Shells::new(washed.scales().to_vec(), washed.table().tints().to_vec());
        assert_eq!(again, Ok(washed));
    }

    #[test]
    fn lists_out_of_order_are_refused_with_their_place() {
        fn scales(scales: &[f32]) -> Result<Shells, ShellError> {
            Shells::new(scales.to_vec(), vec![0.0, 0.5, 1.0])
        }
        assert_eq!(scales(&[1.0, 0.9]).map(|shells| shells.scales().len()), Ok(2));
        assert_eq!(scales(&[0.9, 1.0]), Err(ShellError::NotFalling { index: 1, found: 1.0 }));
        assert_eq!(scales(&[1.0, 0.0]), Err(ShellError::Scale { index: 1, found: 0.0 }));
        assert!(matches!(scales(&[f32::NAN, 0.5]), Err(ShellError::Scale { index: 0, .. })));
        assert_eq!(scales(&[1.0]), Err(ShellError::Lengths { shells: 1, tints: 3 }));
        assert_eq!(scales(&[]), Err(ShellError::Count(0)));
        fn tints(tints: &[f32]) -> Result<TintTable, ShellError> {
            TintTable::new(tints.to_vec())
        }
        assert_eq!(tints(&[0.0, 0.6, 0.5]), Err(ShellError::NotRising { index: 2, found: 0.5 }));
        assert_eq!(tints(&[0.2, 0.6]), Err(ShellError::Outside(0.2)));
        assert_eq!(tints(&[0.0, 1.5]), Err(ShellError::Tint { index: 1, found: 1.5 }));
        assert!(matches!(tints(&[0.0, f32::NAN]), Err(ShellError::Tint { index: 1, .. })));
        assert_eq!(tints(&[0.0]), Err(ShellError::Count(0)));
        assert_eq!(tints(&[0.0; 65]), Err(ShellError::Count(64)));
    }
}
