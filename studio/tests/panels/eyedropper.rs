//! Of eyedropper.
