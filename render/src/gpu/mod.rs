//! The graphics device: adapters, buffers, kernels, readback. Knows nothing of paint.
