//! Where f32 begins: K and S of a palette at the eight wavelengths.
