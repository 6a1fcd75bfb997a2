//! An illuminant and an observer as eight wavelengths, and linear sRGB from them.
