//! Digests that tell whether a file still holds what was written.

use sha2::{Digest, Sha256};

use super::part::PartPlanes;

/// SHA-256 of the numbers of a part, in hexadecimal digits: the channels sorted by name, each row
/// by row, four bytes a number, least first.
pub(crate) fn of_planes(part: &PartPlanes) -> String {
    let mut digest = Sha256::new();
    let mut bytes = Vec::with_capacity(size_of::<f32>() * part.plan.width);
    for row in part.planes.iter().flat_map(|plane| plane.chunks(part.plan.width)) {
        bytes.clear();
        bytes.extend(row.iter().flat_map(|number| number.to_le_bytes()));
        digest.update(&bytes);
    }
    hexadecimal(&digest.finalize())
}

/// SHA-256 of a text, in hexadecimal digits.
pub(crate) fn of_text(text: &str) -> String {
    hexadecimal(&Sha256::digest(text))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::super::part::PartPlan;
    use super::*;

    #[test]
    fn digests_are_sha_256_of_the_bytes() {
        // The example of FIPS 180-4, "abc", as text and as the bytes of a number after it.
        let wanted = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(of_text("abc"), wanted);
        let numbers = vec![f32::from_le_bytes(*b"abcd"), f32::from_le_bytes(*b"efgh")];
        let part = PartPlan::new("p", (1, 2), &["v"]).with(|_| numbers.clone());
        assert_eq!(of_planes(&part), of_text("abcdefgh"));
    }
}
