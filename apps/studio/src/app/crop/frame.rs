//! The rectangle that stays when a painting is cropped: pure geometry in cells.

use graphics::tile::Rect;

/// Fewest cells of a side.
const LEAST: f64 = 8.0;

/// One of the eight handles: -1, 0 or 1 for left, middle and right, and for top, middle and
/// bottom.
pub(super) type Handle = [i8; 2];

/// The handles, clockwise from the upper left.
pub(super) const HANDLES: [(Handle, &str); 8] = [
    ([-1, -1], "Crop upper left"),
    ([0, -1], "Crop top"),
    ([1, -1], "Crop upper right"),
    ([1, 0], "Crop right"),
    ([1, 1], "Crop lower right"),
    ([0, 1], "Crop bottom"),
    ([-1, 1], "Crop lower left"),
    ([-1, 0], "Crop left"),
];

/// Edges of a rectangle on a canvas: left and right, top and bottom, in cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CropFrame {
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
}

impl CropFrame {
    /// The whole canvas.
    pub(super) fn whole((width, height): (usize, usize)) -> Self {
        Self { x: [0.0, width as f64], y: [0.0, height as f64] }
    }

    /// Width and height in cells.
    pub(super) fn size(&self) -> [f64; 2] {
        [self.x[1] - self.x[0], self.y[1] - self.y[0]]
    }

    /// Place of a handle.
    pub(super) fn place(&self, [across, down]: Handle) -> [f64; 2] {
        let at = |[low, high]: [f64; 2], side: i8| match side {
            ..0 => low,
            0 => 0.5 * (low + high),
            1.. => high,
        };
        [at(self.x, across), at(self.y, down)]
    }

    /// Moved by `by` cells, as far as the canvas allows.
    pub(super) fn moved(self, by: [f64; 2], (width, height): (usize, usize)) -> Self {
        let shift = |[low, high]: [f64; 2], by: f64, most: usize| {
            let by = by.clamp(-low, most as f64 - high);
            [low + by, high + by]
        };
        Self { x: shift(self.x, by[0], width), y: shift(self.y, by[1], height) }
    }

    /// The frame with a handle dragged to `to`, on a canvas of `cells`. With `shape`, width over
    /// height stays that: the opposite corner holds still.
    pub(super) fn dragged(
        self,
        [across, down]: Handle,
        to: [f64; 2],
        shape: Option<f64>,
        (width, height): (usize, usize),
    ) -> Self {
        if let Some(shape) = shape {
            return self.dragged_in_shape([across, down], to, shape, (width, height));
        }
        let edge = |[low, high]: [f64; 2], side: i8, to: f64, most: usize| {
            let most = most as f64;
            match side {
                ..0 => [to.clamp(0.0, (high - LEAST).max(0.0)), high],
                0 => [low, high],
                1.. => [low, to.clamp((low + LEAST).min(most), most)],
            }
        };
        Self { x: edge(self.x, across, to[0], width), y: edge(self.y, down, to[1], height) }
    }

    fn dragged_in_shape(
        self,
        [across, down]: Handle,
        to: [f64; 2],
        shape: f64,
        (width, height): (usize, usize),
    ) -> Self {
        // A handle in the middle of an edge grows the frame to the right and downwards.
        let [right, lower] = [across >= 0, down >= 0];
        let fixed = [self.x[usize::from(!right)], self.y[usize::from(!lower)]];
        let room = |forward: bool, fixed: f64, most: usize| {
            if forward { most as f64 - fixed } else { fixed }
        };
        let room = [room(right, fixed[0], width), room(lower, fixed[1], height)];
        let reach = [0, 1].map(|axis: usize| (to[axis] - fixed[axis]).abs());
        let wanted = match (across, down) {
            (0, _) => reach[1] * shape,
            (_, 0) => reach[0],
            _ => reach[0].max(reach[1] * shape),
        };
        let most = room[0].min(room[1] * shape);
        let least = LEAST.max(LEAST * shape).min(most);
        let width = wanted.clamp(least, most);
        let side = |forward: bool, fixed: f64, length: f64| {
            if forward { [fixed, fixed + length] } else { [fixed - length, fixed] }
        };
        Self { x: side(right, fixed[0], width), y: side(lower, fixed[1], width / shape) }
    }

    /// Whole cells of the frame on a canvas of `cells`.
    pub(super) fn cells(&self, (width, height): (usize, usize)) -> Rect {
        let whole = |[low, high]: [f64; 2], most: usize| {
            let low = (low.round().max(0.0) as usize).min(most.saturating_sub(1));
            let high = (high.round().max(0.0) as usize).clamp(low + 1, most);
            (low, high - low)
        };
        let (x, width) = whole(self.x, width);
        let (y, height) = whole(self.y, height);
        Rect { x, y, width, height }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: (usize, usize) = (200, 100);

    #[test]
    fn handles_move_their_edges_and_stay_on_the_canvas() {
        let whole = CropFrame::whole(CELLS);
        let frame = whole.dragged([-1, -1], [20.4, 10.0], None, CELLS);
        assert_eq!(frame.cells(CELLS), Rect { x: 20, y: 10, width: 180, height: 90 });
        let frame = frame.dragged([1, 0], [150.0, 3.0], None, CELLS);
        assert_eq!(frame.cells(CELLS), Rect { x: 20, y: 10, width: 130, height: 90 });
        let out = frame.dragged([-1, 1], [-50.0, 500.0], None, CELLS);
        assert_eq!(out.cells(CELLS), Rect { x: 0, y: 10, width: 150, height: 90 });
        let shut = frame.dragged([-1, 0], [190.0, 0.0], None, CELLS);
        assert_eq!(shut.size()[0], LEAST, "it does not turn inside out");
    }

    #[test]
    fn a_kept_shape_stays_within_the_canvas() {
        let whole = CropFrame::whole(CELLS);
        for (handle, to) in [
            ([1, 1], [120.0, 20.0]),
            ([-1, -1], [150.0, 90.0]),
            ([1, -1], [900.0, -900.0]),
            ([0, 1], [0.0, 40.0]),
            ([-1, 0], [130.0, 0.0]),
        ] {
            let frame = whole.dragged(handle, to, Some(1.5), CELLS);
            let [width, height] = frame.size();
            assert!((width / height - 1.5).abs() < 1e-9, "{handle:?}: {frame:?}");
            assert!(frame.x[0] >= -1e-9 && frame.x[1] <= 200.0 + 1e-9, "{handle:?}: {frame:?}");
            assert!(frame.y[0] >= -1e-9 && frame.y[1] <= 100.0 + 1e-9, "{handle:?}: {frame:?}");
        }
        let frame = whole.dragged([1, 1], [120.0, 20.0], Some(1.5), CELLS);
        assert_eq!((frame.x, frame.y), ([0.0, 120.0], [0.0, 80.0]), "the upper left is still");
    }

    #[test]
    fn a_frame_moves_as_far_as_the_canvas() {
        let frame = CropFrame { x: [20.0, 60.0], y: [10.0, 50.0] };
        assert_eq!(frame.moved([5.0, 5.0], CELLS), CropFrame { x: [25.0, 65.0], y: [15.0, 55.0] });
        assert_eq!(
            frame.moved([-90.0, 90.0], CELLS),
            CropFrame { x: [0.0, 40.0], y: [60.0, 100.0] }
        );
        assert_eq!(frame.place([0, 1]), [40.0, 50.0]);
    }
}
