//! Segmentation and morphology.
