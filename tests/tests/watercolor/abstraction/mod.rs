//! Segmentation and morphology, and the door of photographs.

mod known;

mod segmentation;

mod quality;

mod morphology;

mod photographs;
