//! Messages with which the program refuses what cannot be done, rightly.

/// Parts of these messages.
const REFUSALS: [&str; 17] = [
    "is too high for more",
    "is piled as high as it can be",
    "mm more at most, found",
    "is still wet, so it cannot leave the palette",
    "the layer has no ",
    " already",
    "is not on the palette now",
    "one of the two layers is hidden",
    "lies between the two layers",
    "a recipe needs parts above 0",
    "has no opacity of its own",
    "on top of all layers",
    "a painting is being opened",
    "is not a valid file name",
    // A brush that is made larger just after a change of the palette asks for the paint that it had.
    "recipe: pigments of the palette",
    // The panel shows a layer until the undo that was asked for before is done.
    "there is no layer ",
    // Marks of samples that are dropped on the window are no scene.
    "format takes \"paint-volumes\"",
];

/// Whether a message is a refusal.
pub(super) fn is_refusal(message: &str) -> bool {
    REFUSALS.iter().any(|part| message.contains(part))
}
