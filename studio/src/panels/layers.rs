//! Wet and dry: drying, dry layers.
