//! The wash of a photograph: its flat colours after all effects that only photographs have.

use rayon::prelude::*;
use spectra::color::Rgb;

use super::enlarge::Enlarged;
use super::margin::Margin;
use super::wet::{mixed, running};
use crate::settings::Settings;
use graphics::field::Field;
use graphics::smoothstep;

/// The wash in `width` x `height` pixels. `original` and `flat` are the photograph and its flat
/// colours in the size of abstraction, at most this one; `abstraction` are the settings for that
/// size, `settings` those for the picture.
pub(crate) fn photograph_wash(
    (original, flat): (&Field<[f32; 4]>, &Field<[f32; 4]>),
    (width, height): (usize, usize),
    abstraction: &Settings,
    settings: &Settings,
) -> Field<[f32; 4]> {
    let running = running(original, flat, &abstraction.wet);
    let margin = Margin::new(width, height, &settings.margin);
    let dark = Rgb::from_hex(&settings.tones.dark).unwrap_or(Rgb([0.0; 3]));
    let dark = dark.0.map(|value| value as f32);
    let reserve = settings.tones.reserve;
    let enlarged = Enlarged::new(flat, width, height);
    let same = (flat.width(), flat.height()) == (width, height);
    let mut wash = Field::filled(width, height, [0.0; 4]);
    wash.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let mut color = if same { flat[(x, y)] } else { enlarged.at(x, y) };
            if let Some(running) = &running {
                let (ran, share) = match same {
                    true => (running.color[(x, y)], running.share[(x, y)]),
                    false => (
                        enlarged.smooth(&running.color, x, y),
                        enlarged.smooth(&running.share, x, y),
                    ),
                };
                color = mixed(color, ran, share[0]);
            }
            let [r, g, b, covered] = color;
            let mut covered = covered;
            if reserve < 1.0 {
                let bare = [reserve, reserve + (1.0 - reserve) / 2.0];
                covered *= 1.0 - smoothstep(bare, r.min(g).min(b));
            }
            if let Some(margin) = &margin {
                covered *= margin.painted(x, y);
            }
            let lifted = |i: usize| dark[i] + (1.0 - dark[i]) * color[i];
            *out = [lifted(0), lifted(1), lifted(2), covered];
        }
    });
    wash
}
