//! The eyedropper: spectrum, Lab, recipe, thickness, and recipes for a colour.
