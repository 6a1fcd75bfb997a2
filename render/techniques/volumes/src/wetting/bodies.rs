//! Bodies: which parts of a model are one surface for paint.

use super::pieces::{Pieces, root_of, unite};

/// The bodies of a model, numbered from 1: surface that is connected or touches. 0 is any body:
/// the number of parts too small to take paint.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Bodies {
    /// The body of each cell.
    pub of_cells: Vec<u32>,
    /// The body of each triangle of the mesh.
    pub of_triangles: Vec<u32>,
}

impl Bodies {
    /// The bodies that `pieces` are joined to; the piece of each cell is in `of_cells`.
    pub(super) fn of(pieces: &Pieces, of_cells: &[u32]) -> Self {
        let mut roots: Vec<u32> = (0..pieces.keys.len() as u32).collect();
        for &(one, other) in &pieces.pairs {
            unite(&mut roots, one, other);
        }
        let mut numbers = vec![0; roots.len()];
        let mut count = 0;
        for &piece in of_cells {
            let number = &mut numbers[root_of(&roots, piece) as usize];
            if *number == 0 {
                count += 1;
                *number = count;
            }
        }
        let body = |piece: u32| numbers[root_of(&roots, piece) as usize];
        let of_triangle =
            |triangle| pieces.of_triangle(triangle).first().map_or(0, |&piece| body(piece));
        Self {
            of_cells: of_cells.iter().map(|&piece| body(piece)).collect(),
            of_triangles: (0..pieces.triangles()).map(of_triangle).collect(),
        }
    }
}
