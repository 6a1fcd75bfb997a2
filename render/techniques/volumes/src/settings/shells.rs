//! Concentric shells of a volume and the tint of a place by the number of shells that hold it.

use documents::counted;

use crate::drawing::MOST_SHELLS;
use crate::toml_text::{Checked, Fault, KeyPath};

/// Even steps from 0 to 1 for `shells` shells: the tint in no shell, in one, and so on.
#[must_use]
pub fn even_tints(shells: usize) -> Vec<f64> {
    (0..=shells).map(|count| count as f64 / shells.max(1) as f64).collect()
}

/// Checks shells and the tints that go with them, of which none stands for even steps. `table` is
/// the path of the table that holds both.
pub(crate) fn check_shells(table: &KeyPath, shells: &[f64], tints: &[f64]) -> Checked {
    let list = |numbers: &[f64]| {
        let numbers: Vec<String> = numbers.iter().map(f64::to_string).collect();
        format!("[{}]", numbers.join(", "))
    };
    let key = table.key("shells");
    if !(1..=MOST_SHELLS).contains(&shells.len()) {
        let wanted = format!("1 to {MOST_SHELLS} sizes");
        return Err(Fault::new(&key, wanted, list(shells), "[1.0] is a single shell"));
    }
    let falling = shells.windows(2).all(|pair| pair[0] > pair[1]);
    if !(falling && shells.iter().all(|size| (0.01..=1.0).contains(size))) {
        let hint = "[1.0, 0.93, 0.86, 0.79] is usual";
        return Err(Fault::new(&key, "sizes that fall from 1 to 0.01", list(shells), hint));
    }
    let key = table.key("tint");
    let even = format!("{} is even, and so is []", list(&even_tints(shells.len())));
    if !tints.is_empty() && tints.len() != shells.len() + 1 {
        let wanted = format!("{} shares for {}", shells.len() + 1, counted(shells.len(), "shell"));
        return Err(Fault::new(&key, wanted, list(tints), even));
    }
    let rising = tints.windows(2).all(|pair| pair[0] <= pair[1]);
    if !(rising && tints.iter().all(|tint| (0.0..=1.0).contains(tint))) {
        return Err(Fault::new(&key, "shares that rise from 0 to 1", list(tints), even));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tints_rise_and_shells_fall() {
        let check = |shells: &[f64], tints: &[f64]| {
            check_shells(&KeyPath::of("drawing"), shells, tints).map_err(|fault| fault.to_string())
        };
        assert_eq!(even_tints(4), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(check(&[1.0, 0.9], &[]), Ok(()));
        assert_eq!(check(&[1.0, 0.9], &[0.0, 1.0, 1.0]), Ok(()));
        for (shells, tints, wanted) in [
            (&[][..], &[][..], "drawing.shells takes 1 to 63 sizes, found `[]`"),
            (&[0.9, 1.0], &[], "drawing.shells takes sizes that fall"),
            (&[1.0, f64::NAN], &[], "drawing.shells takes sizes that fall"),
            (&[1.0, 0.001], &[], "drawing.shells takes sizes that fall"),
            (&[1.0], &[0.0, 0.5, 1.0], "drawing.tint takes 2 shares for 1 shell"),
            (&[1.0], &[1.0, 0.0], "drawing.tint takes shares that rise"),
            (&[1.0], &[0.0, f64::NAN], "drawing.tint takes shares that rise"),
        ] {
            let fault = check(shells, tints).unwrap_err();
            assert!(fault.starts_with(wanted), "{fault}");
        }
    }
}
