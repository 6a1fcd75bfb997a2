//! Colours and sizes of the window: a dark neutral surround, as colour is judged here.
