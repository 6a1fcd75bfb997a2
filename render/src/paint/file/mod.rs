//! Paintings as OpenEXR files.
