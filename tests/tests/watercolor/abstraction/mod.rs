//! Segmentation, morphology, and the abstraction of photographs that uses both.

mod known;
mod segmentation;
mod quality;
mod morphology;
mod photographs;
