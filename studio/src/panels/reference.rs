//! A picture pinned beside the canvas.
