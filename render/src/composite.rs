//! Kubelka-Munk films stacked over a ground, cell by cell.
