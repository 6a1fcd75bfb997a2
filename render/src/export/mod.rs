//! Pictures for others: PNG, OpenEXR, spectral OpenEXR, pigment maps.
