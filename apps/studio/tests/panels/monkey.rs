//! A monkey at the whole program: random actions, after each of which nothing may have failed, and
//! at the end of which no paint may be lost.

mod dice;
mod controls;
mod refusals;
mod paws;
mod acts;
mod accounts;
mod runs;
