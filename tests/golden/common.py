"""Helpers of the golden values: plain numbers, and spectra at 1 nm."""

import math

import colour
import numpy as np
from colour.colorimetry import sd_to_XYZ_integration

import tables

# Decimals of a white point, which is an input of other cases.
WHITE_PLACES = 10

NM = np.arange(360, 831)
SHAPE = colour.SpectralShape(360, 830, 1)


def plain(x):
    """Convert numbers and arrays to plain floats."""
    if isinstance(x, (list, tuple, np.ndarray)):
        return [plain(v) for v in x]
    x = float(x)
    if not math.isfinite(x):
        raise ValueError("a golden value is not finite")
    return x


def rounded(value, places):
    """Round all floats of a record to `places` decimals; keep other values."""
    if isinstance(value, dict):
        return {k: rounded(v, places) for k, v in value.items()}
    if isinstance(value, list):
        return [rounded(v, places) for v in value]
    if isinstance(value, float):
        # The sum makes a negative zero positive.
        return round(value, places) + 0.0
    return value


def near(a, b, relative=1e-12):
    """Raise an error unless two computations of a value agree."""
    if not np.allclose(a, b, rtol=relative, atol=relative):
        raise ValueError(f"two ways disagree: {a} and {b}")


def reflectance(start, step, values):
    return {"start_nm": start, "step_nm": step, "values": values}


def made_up(start, step, last, function):
    """A made-up spectrum of four decimals on a regular grid."""
    nm = range(start, last + 1, step)
    return reflectance(start, step, [round(function(w), 4) for w in nm])


def bump(w, centre, width):
    return math.exp(-(((w - centre) / width) ** 2))


def rise(w, middle, width):
    return 1.0 / (1.0 + math.exp(-(w - middle) / width))


REFLECTANCES = {
    "blue_10": made_up(
        400, 10, 700, lambda w: 0.04 + 0.52 * bump(w, 455, 48) + 0.1 * rise(w, 690, 12)
    ),
    "orange_20": made_up(400, 20, 700, lambda w: 0.05 + 0.72 * rise(w, 575, 17)),
    "green_5": made_up(
        380, 5, 780, lambda w: 0.03 + 0.36 * bump(w, 528, 42) + 0.31 * rise(w, 735, 15)
    ),
}


def grid_of(spectrum):
    first, step = spectrum["start_nm"], spectrum["step_nm"]
    return first + step * np.arange(len(spectrum["values"]))


def sprague(spectrum, to):
    """Sprague interpolation inside the band, end values held outside."""
    x = grid_of(spectrum)
    f = colour.SpragueInterpolator(x, spectrum["values"])
    return np.asarray(f(np.clip(np.asarray(to, float), x[0], x[-1])))


def linear(spectrum, to):
    x = grid_of(spectrum)
    f = colour.LinearInterpolator(x, spectrum["values"])
    return np.asarray(f(np.clip(np.asarray(to, float), x[0], x[-1])))


def illuminant_1nm(name):
    """Illuminant at 1 nm: linear between rows, end values held; checked against NumPy."""
    sd = colour.SDS_ILLUMINANTS[name]
    straight = np.interp(NM, sd.wavelengths, sd.values)
    aligned = sd.copy().align(
        SHAPE,
        interpolator=colour.LinearInterpolator,
        extrapolator=colour.Extrapolator,
        extrapolator_kwargs={"method": "Constant", "left": None, "right": None},
    )
    near(aligned.values, straight)
    return aligned


def observer_1nm(key):
    cmfs = colour.MSDS_CMFS[tables.OBSERVERS[key]]
    values = np.zeros((NM.size, 3))
    values[int(cmfs.wavelengths[0]) - NM[0] :] = cmfs.values
    return colour.MultiSpectralDistributions(values, NM, labels=["x", "y", "z"])


def tristimulus(rows, cmfs, illuminant):
    """XYZ of rows of 1 nm reflectances: exact sums, checked against colour-science.

    The exact sums are the same on every machine; those of colour-science depend on the
    order in which a linear algebra library adds.
    """
    rows = np.atleast_2d(rows)
    by_colour = sd_to_XYZ_integration(rows, cmfs, illuminant, shape=SHAPE)
    weights = cmfs.values.T * illuminant.values
    k = 100.0 / math.fsum(weights[1])
    xyz = np.array([[k * math.fsum(row * w) for w in weights] for row in rows])
    near(xyz, by_colour)
    return xyz


def white_of(illuminant, observer="cie-1931-2"):
    """White point, rounded as in the files so that tests start from the same values."""
    xyz = tristimulus(
        np.ones(NM.size), observer_1nm(observer), illuminant_1nm(illuminant)
    )
    return rounded(plain(xyz[0]), WHITE_PLACES)


SUMMATION = (
    "CIE 15 summation at 1 nm over 360 to 830 nm, k = 100 / sum(E ybar); illuminant"
    " brought to 1 nm linearly, end values held; observer zero outside its table"
)
