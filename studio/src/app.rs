//! The window: what is where, and what keys do.
