//! Brush heads: bending spines that carry a surface with paint on it.
