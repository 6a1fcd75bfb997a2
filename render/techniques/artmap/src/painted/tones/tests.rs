use super::*;

fn ladder(hue: &str, count: usize) -> ToneLadder {
    ToneLadder::new(Arc::new(PigmentLibrary::van_gogh_oils()), hue, count, 6.0).unwrap()
}

#[test]
fn tones_rise_in_even_steps_and_keep_the_hue() {
    for (hue, count) in [("#c9a227", 7), ("#3f6fa8", 5), ("#a04030", 6)] {
        let ladder = ladder(hue, count);
        let tones = ladder.tones();
        assert_eq!(tones.len(), count);
        let steps = tones.windows(2).map(|w| w[1].lab.lightness - w[0].lab.lightness);
        let steps: Vec<f64> = steps.collect();
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        assert!(mean > 4.0, "{hue}: steps of {mean}");
        assert!(steps.iter().all(|step| (step - mean).abs() < 1.0), "{hue}: {steps:?}");
        let base = hue.parse::<ColorCode>().unwrap().lab();
        for tone in tones {
            assert!(hue_difference(tone.lab, base) < 2.0 * HUE_TOLERANCE, "{hue}: {tone:?}");
            let even = shaded(base, tone.lab.lightness).to_lch().chroma;
            assert!(tone.lab.to_lch().chroma > 0.3 * even, "{hue}: {tone:?} is too grey");
            assert!((tone.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
            let again = ladder.lab_of(&tone.shares).unwrap();
            assert!((again.lightness - tone.lab.lightness).abs() < 1e-6, "{hue}");
        }
    }
}

#[test]
fn mixtures_between_tones_have_the_lightness_asked_for() {
    let ladder = ladder("#c9a227", 5);
    let [darkest, lightest] = ladder.range();
    for step in 0..=20 {
        let wanted = darkest + (lightest - darkest) * f64::from(step) / 20.0;
        let found = ladder.lab_of(&ladder.shares_at(wanted)).unwrap().lightness;
        assert!((found - wanted).abs() < 0.1, "{wanted}: {found}");
    }
    for tone in ladder.tones() {
        let [dark, light] = ladder.shares_about(tone.lab.lightness, 5.0);
        let mean = std::array::from_fn(|slot| (dark[slot] + light[slot]) / 2.0);
        let [dark, mean, light] = [dark, mean, light].map(|shares| ladder.lab_of(&shares));
        let off = mean.unwrap().lightness - tone.lab.lightness;
        assert!(off.abs() < 0.1, "{tone:?}: {off}");
        let span = light.unwrap().lightness - dark.unwrap().lightness;
        // Near the ends of the range there is less room.
        assert!((8.5..10.2).contains(&span), "{tone:?}: {span}");
    }
    assert_eq!(ladder.shares_at(0.0), ladder.rungs[0].shares);
    assert_eq!(ladder.shares_at(100.0), ladder.rungs[6].shares);
}

#[test]
fn impossible_tones_are_refused_with_a_way_out() {
    let library = Arc::new(PigmentLibrary::van_gogh_oils());
    let refused = |hue: &str, count, margin| {
        ToneLadder::new(Arc::clone(&library), hue, count, margin).unwrap_err()
    };
    assert!(matches!(refused("ochre", 7, 5.0), TonesError::Hue(_)));
    assert!(matches!(refused("#c9a227", 1, 5.0), TonesError::Count { found: 1 }));
    let narrow = refused("#c9a227", 7, 40.0);
    assert!(matches!(narrow, TonesError::Narrow { .. }), "{narrow}");
    assert!(narrow.hint().unwrap().to_string().contains("`hue`"));
    let mut washes = PigmentLibrary::van_gogh_oils();
    washes.amounts = AmountKind::Absolute;
    let error = ToneLadder::new(Arc::new(washes), "#c9a227", 7, 5.0).unwrap_err();
    assert!(matches!(error, TonesError::Absolute { .. }));
}
