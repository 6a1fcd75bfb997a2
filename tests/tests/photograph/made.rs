//! The shipped oils on a white ground in daylight, separations, and random mixtures.

use std::sync::LazyLock;

use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::quadrature::EffectiveQuadrature;
use documents::Task;
use paint::document::{Medium, Slots};
use paint::layer::SLOTS;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use strokes::{FilmMaterials, PaintFilm, Picture, Separation, SeparationSettings};
use suite::program::repository;

/// The shipped oils, eight wavelengths for daylight, and a white ground.
pub(crate) struct Studio {
    pub(crate) library: PigmentLibrary,

    pub(crate) quadrature: EffectiveQuadrature,
    pub(crate) ground: Vec<f64>,
    /// White, black, a yellow, two reds, two blues and a green.
    pub(crate) slots: Slots,
}

pub(crate) static STUDIO: LazyLock<Studio> = LazyLock::new(|| {
    let path = repository("measurements/van-gogh-oils.pigments.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let library = PigmentLibrary::from_json(&path, &text).unwrap();
    let quadrature =
        EffectiveQuadrature::of(&Viewing::default(), &library, 8, &Task::default()).unwrap();
    let ground = vec![0.85; library.grid.count()];
    let slots = [
        "Zinc White",
        "Bone Black",
        "Chrome Yellow (Otero)",
        "Vermilion",
        "Eosin Lake",
        "Ultramarine",
        "Prussian Blue",
        "Viridian",
    ]
    .map(|name| Some(library.find(name).unwrap()));
    Studio { library, quadrature, ground, slots }
});

impl Studio {
    pub(crate) fn materials<'a>(&'a self, slots: &'a Slots) -> FilmMaterials<'a> {
        let scattering_per_mm = Medium::default().scattering_per_mm;
        FilmMaterials { library: &self.library, slots, ground: &self.ground, scattering_per_mm }
    }

    pub(crate) fn film(&self) -> PaintFilm {
        PaintFilm::at_nodes(self.materials(&self.slots), &self.quadrature)
    }
}

/// Separation with default settings, which prefer hiding films, but a coarser lattice.
pub(crate) static HIDING: LazyLock<Separation> = LazyLock::new(|| {
    let settings = SeparationSettings { lattice: 17, ..SeparationSettings::default() };
    Separation::new(STUDIO.film(), &settings).unwrap()
});

/// Separation into films that may be thin and show the ground.
pub(crate) static THIN: LazyLock<Separation> = LazyLock::new(|| {
    let settings =
        SeparationSettings { lattice: 17, hides: false, ..SeparationSettings::default() };
    Separation::new(STUDIO.film(), &settings).unwrap()
});

/// Random colours within sRGB. Each is a film of one to four pigments, `least_mm` to 0.3 mm high.
pub(crate) fn mixtures(seed: u64, count: usize, least_mm: f32) -> Picture {
    let film = STUDIO.film();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut colors = Vec::new();
    while colors.len() < count {
        let mut parts = [0.0_f32; SLOTS];
        for _ in 0..random.random_range(1..=4) {
            parts[random.random_range(0..SLOTS)] += random.random_range(0.05..1.0_f32).powi(3);
        }
        let height = random.random_range(least_mm..=0.3);
        let total: f32 = parts.iter().sum();
        let rgb = film.rgb(&parts.map(|part| part / total * height));
        if rgb.iter().all(|value| (0.0..=1.0).contains(value)) {
            colors.push(rgb);
        }
    }
    Picture::from_values(count, 1, colors)
}
