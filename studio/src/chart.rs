//! Small curves over wavelength.
