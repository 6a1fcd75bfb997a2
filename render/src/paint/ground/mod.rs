//! What is painted on: linen, paper, panel, or a relief from a picture.
