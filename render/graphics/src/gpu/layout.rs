//! Structs that Rust and WGSL share.

/// Name, size and field offsets of a struct in Rust; a test compares them with the WGSL struct
/// of the same name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// Name of the struct, equal in both languages.
    pub name: &'static str,
    /// Size of the struct in bytes.
    pub bytes: usize,
    /// Name of each field and its offset in bytes.
    pub fields: &'static [(&'static str, usize)],
}

/// The [`Layout`] of a `repr(C)` struct. All its fields must be listed, in any order;
/// otherwise it does not compile.
#[macro_export]
macro_rules! layout {
    ($type:ident { $($field:ident),* $(,)? }) => {{
        const _: fn($type) = |value| { let $type { $($field: _),* } = value; };
        $crate::gpu::Layout {
            name: stringify!($type),
            bytes: size_of::<$type>(),
            fields: &[$((stringify!($field), std::mem::offset_of!($type, $field))),*],
        }
    }};
}
pub use layout;
