//! From reflectance to light: surface, relief and gloss.
