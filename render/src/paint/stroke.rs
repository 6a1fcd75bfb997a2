//! From samples of a pen to sub-steps of at most one cell.
