"""A program as users write it, for the checks of types: it is checked, not run."""

from __future__ import annotations

import numpy as np

import impasto as im


def laboratory() -> im.Library:
    """From readings to a library."""
    readings = im.read("swatches.ti3", recipes="recipes.csv")
    fit = im.fit(readings, reference="Zinc White", surface=im.Surface(k1=0.03, k2=0.6), progress=print)
    errors: dict[str, float] = fit.delta_e
    assert errors["mean"] < 2
    validation = im.validate(readings, folds=5)
    print(validation.per_sample, fit.warnings)
    im.plan(["Cobalt Blue"], "Zinc White", prior=fit.library, swatches=16).save("form.csv")
    im.report(fit.library, readings).save("report")
    fit.library.save("oils.json")
    return fit.library


def studio(oils: im.Library) -> str:
    """Mixtures, colours and recipes."""
    one = oils.mix({"Zinc White": 9, "Cobalt Blue": 1})
    several = oils.mix([{"Zinc White": 9}, {"Viridian": 1}])
    rows = oils.mix(np.ones((3, len(oils))), thickness=0.5, over="white")
    light = im.Light("A")
    print(im.color.xyz(one, light), im.color.lab(several), im.color.display(rows))
    match = oils.match("#4a7d8c", lights={"D65": 1, "A": 0.5})
    best = match[0]
    parts: float = best.shares["Zinc White"]
    measured = oils.match(one, by="spectrum")
    found = measured if isinstance(measured, im.Match) else measured[0]
    rule = im.Quadrature.of(oils, illuminant=light, nodes=8)
    print(parts, found.nearest, rule.xyz(np.ones(8)), oils["Viridian"].absorption)
    try:
        oils.match((52.0, -10.5, 8.0), only=["Viridian"])
    except im.RecipeError as error:
        return error.hint or str(error)
    return best.hex


def conservation(oils: im.Library) -> im.PigmentMaps:
    """A scan and its maps."""
    cube = im.Cube.open("scan.hdr", white_reading="white.hdr", dark_reading="0")
    survey = im.survey(cube, oils, at_most=3, groups={"whites": ["Lead White", "Zinc White"]})
    values, mask = cube.read(slice(0, 10))
    print(survey.palette, values.shape, mask.dtype)
    return im.pigment_map(cube, oils, "maps.zarr", survey=survey, resume=True)
