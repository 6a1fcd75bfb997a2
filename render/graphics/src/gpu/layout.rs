//! Structs that Rust and WGSL share.

/// Name, size and offsets of a struct, as Rust lays it out; a test holds it
/// against the WGSL struct of the same name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// The struct's name, the same in both languages.
    pub name: &'static str,
    /// Its size.
    pub bytes: usize,
    /// Its fields, each with its offset.
    pub fields: &'static [(&'static str, usize)],
}

/// The [`Layout`] of a `repr(C)` struct. All its fields must be named, in any
/// order: else it does not compile.
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
