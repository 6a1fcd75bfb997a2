//! Recipes with pigments that were measured as a masstone only, so that their S is assumed.

use calibrate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::MatchRequest;
use documents::Task;

use super::oils;

/// Three of the oils. Pigments of `masstones` have an assumed S.
fn three(masstones: &[&str]) -> PigmentLibrary {
    let mut library = oils();
    let kept = ["Zinc White", "Viridian", "Vermilion"];
    library.pigments.retain(|pigment| kept.contains(&pigment.name.as_str()));
    for pigment in &mut library.pigments {
        pigment.identified = !masstones.contains(&pigment.name.as_str());
    }
    library
}

/// Recipes of `library` for a mixture of three oils, as lists of names, and the warnings.
fn matched(
    library: &PigmentLibrary,
    request: &MatchRequest,
    parts: [(&str, f64); 2],
) -> (Vec<Vec<String>>, String) {
    let color = three(&[]).color(parts, &Viewing::default()).unwrap().hex();
    let found = request.run(library, &color.parse().unwrap(), &Task::default()).unwrap();
    let names = found.recipes.iter().map(|recipe| {
        recipe.shares.iter().map(|(id, _)| library[*id].name.clone()).collect::<Vec<String>>()
    });
    let warnings = found.remarks.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    (names.collect(), warnings)
}

#[test]
fn a_recipe_with_a_masstone_comes_last_where_no_other_reaches_the_colour() {
    let library = three(&["Vermilion"]);
    let request = MatchRequest::default();
    let red = [("Zinc White", 0.7), ("Vermilion", 0.3)];
    let (recipes, remarks) = matched(&library, &request, red);
    let has_red: Vec<bool> =
        recipes.iter().map(|recipe| recipe.contains(&"Vermilion".to_owned())).collect();
    assert!(has_red.len() > 1 && has_red[has_red.len() - 1], "{recipes:?}");
    assert!(has_red[..has_red.len() - 1].iter().all(|has| !has), "{recipes:?}");
    assert!(
        remarks.contains("the last recipe is a guess: S is not known of Vermilion"),
        "{remarks}"
    );
    let without = MatchRequest { without: vec!["Vermilion".to_owned()], ..request.clone() };
    for (request, parts) in [(&without, red), (&request, [("Zinc White", 0.7), ("Viridian", 0.3)])]
    {
        let (recipes, remarks) = matched(&library, request, parts);
        assert!(!recipes.concat().contains(&"Vermilion".to_owned()), "{recipes:?}");
        assert!(!remarks.contains("the last recipe is a guess"), "{remarks}");
    }
}

#[test]
fn masstones_beside_their_white_all_take_part() {
    let library = three(&["Viridian", "Vermilion"]);
    let grey = [("Viridian", 0.5), ("Vermilion", 0.5)];
    let (recipes, remarks) = matched(&library, &MatchRequest::default(), grey);
    assert!(recipes[0].contains(&"Viridian".to_owned()), "{recipes:?}");
    assert!(remarks.contains("recipes with it are a guess"), "{remarks}");
    assert_eq!(library.usual_pigments().len(), 3);
    assert_eq!(three(&["Vermilion"]).usual_pigments().len(), 2);
}
