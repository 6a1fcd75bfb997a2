//! The file around a state.
//!
//! 16 bytes with the name of the format, 4 with its version, 32 with the SHA-256 digest of whose
//! state it is, the state, and 32 with the digest of all that.

use sha2::{Digest, Sha256};

use super::bytes::Stored;
use super::error::SavedError;

const DIGEST: usize = 32;

/// A kind of saved state.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind {
    /// Name of the format, the first bytes of a file.
    pub(crate) format: &'static [u8; 16],
    /// Version of the format.
    pub(crate) version: u32,
    /// Name of the state in errors.
    pub(crate) name: &'static str,
}

/// The digest of texts that say whose state it is.
pub(crate) fn identity<'t>(texts: impl IntoIterator<Item = &'t str>) -> [u8; DIGEST] {
    let mut digest = Sha256::new();
    for text in texts {
        digest.update(text);
        digest.update([0]);
    }
    digest.finalize().into()
}

/// A file with this state, given as bytes, of this `identity`.
pub(crate) fn sealed(kind: Kind, identity: &[u8; DIGEST], state: &[u8]) -> Vec<u8> {
    let mut file = Vec::with_capacity(kind.format.len() + 4 + 2 * DIGEST + state.len());
    file.extend_from_slice(kind.format);
    kind.version.store(&mut file);
    file.extend_from_slice(identity);
    file.extend_from_slice(state);
    let digest = Sha256::digest(&file);
    file.extend_from_slice(&digest);
    file
}

/// The bytes of the state in a file, if it is of this kind and `identity` and undamaged.
pub(crate) fn opened<'f>(
    kind: Kind,
    identity: &[u8; DIGEST],
    file: &'f [u8],
) -> Result<&'f [u8], SavedError> {
    let named = kind.format.len().min(file.len());
    if file[..named] != kind.format[..named] {
        return Err(SavedError::Foreign { kind: kind.name });
    }
    let part = file.get(named..).and_then(<[u8]>::split_first_chunk);
    let (version, rest) = part.ok_or(SavedError::Damaged)?;
    match u32::from_le_bytes(*version) {
        found if found == kind.version => {}
        found => {
            return Err(SavedError::Version { kind: kind.name, found, read: kind.version });
        }
    }
    let (state, digest) = rest.split_last_chunk::<DIGEST>().ok_or(SavedError::Damaged)?;
    let (of, state) = state.split_first_chunk::<DIGEST>().ok_or(SavedError::Damaged)?;
    let whole = &file[..file.len() - DIGEST];
    if Sha256::digest(whole)[..] != digest[..] {
        return Err(SavedError::Damaged);
    }
    if of == identity { Ok(state) } else { Err(SavedError::Other) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_opened_only_as_it_was_sealed() {
        let kind = Kind { format: b"impasto-of-tests", version: 3, name: "test" };
        let own = identity(["mine", "too"]);
        assert_ne!(own, identity(["minetoo"]));
        let file = sealed(kind, &own, b"state");
        assert_eq!(opened(kind, &own, &file), Ok(&b"state"[..]));
        assert_eq!(opened(kind, &identity(["yours"]), &file), Err(SavedError::Other));
        let newer = Kind { version: 4, ..kind };
        let version = SavedError::Version { kind: "test", found: 3, read: 4 };
        assert_eq!(opened(newer, &own, &file), Err(version));
        for cut in 0..file.len() {
            assert_eq!(opened(kind, &own, &file[..cut]), Err(SavedError::Damaged), "{cut}");
        }
        for at in 0..file.len() {
            let mut changed = file.clone();
            changed[at] ^= 4;
            assert!(opened(kind, &own, &changed).is_err(), "{at}");
        }
        let foreign = SavedError::Foreign { kind: "test" };
        assert_eq!(opened(kind, &own, b"a picture"), Err(foreign));
    }
}
