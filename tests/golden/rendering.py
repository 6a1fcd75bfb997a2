"""Golden values of the colour rendering of lights."""

import functools
import unittest.mock

import colour
import numpy as np
from colour.colorimetry import planck_law
from colour.quality import cfi2017, cri, tm3018
from scipy.optimize import minimize_scalar

from common import (
    NM,
    SHAPE,
    illuminant_1nm,
    observer_1nm,
    plain,
    tristimulus,
)

LIGHTS = (
    ["A", "D50", "D65", "E"]
    + ["FL1", "FL2", "FL4", "FL7", "FL8", "FL11", "FL12", "FL3.4", "FL3.15"]
    + ["HP1", "HP3", "HP5", "LED-B1", "LED-B3", "LED-B5", "LED-RGB1", "LED-V1", "LED-V2"]
)


def uv_of(values):
    """CIE 1960 (u, v) of a light at 1 nm from 360 to 830 nm."""
    light = colour.SpectralDistribution(values, NM)
    X, Y, Z = tristimulus(np.ones(NM.size), observer_1nm("cie-1931-2"), light)[0]
    return np.array([4 * X, 6 * Y]) / (X + 15 * Y + 3 * Z)


def planck(kelvin):
    return planck_law(NM * 1e-9, kelvin) / planck_law(560e-9, kelvin)


def temperature(values):
    """Temperature of the nearest black body, by minimisation rather than by a table."""
    own = uv_of(values)
    away = lambda mired: np.hypot(*(own - uv_of(planck(1e6 / mired))))
    start = min(range(20, 1000, 10), key=away)
    found = minimize_scalar(
        away, bounds=(start - 10, start + 10), method="bounded", options={"xatol": 1e-6}
    )
    return 1e6 / found.x


def day(kelvin):
    xy = colour.temperature.CCT_to_xy_CIE_D(kelvin)
    sd = colour.sd_CIE_illuminant_D_series(xy, M1_M2_rounding=False)
    return np.interp(NM, sd.wavelengths, sd.values)


def luminance(values):
    return float(np.dot(values, observer_1nm("cie-1931-2").values[:, 1]))


def rendering_reference(kelvin):
    return planck(kelvin) if kelvin < 5000 else day(kelvin)


def fidelity_reference(kelvin):
    if kelvin <= 4000:
        return planck(kelvin)
    if kelvin >= 5000:
        return day(kelvin)
    share = (kelvin - 4000) / 1000
    body, light = planck(kelvin), day(kelvin)
    return (1 - share) * body / luminance(body) + share * light / luminance(light)


def rendering_indices(values, kelvin):
    """R1 to R14 with the functions of colour-science, at 1 nm from 360 to 830 nm."""
    lights = [
        colour.SpectralDistribution(v, NM) for v in (values, rendering_reference(kelvin))
    ]
    sds = {
        name: sd.copy().interpolate(SHAPE, colour.SpragueInterpolator)
        for name, sd in colour.quality.datasets.SDS_TCS["CIE 1995"].items()
    }
    sds = {sd.name: sd for sd in sds.values()}
    cmfs = observer_1nm("cie-1931-2")
    # The functions sum by ASTM E308, which ends at 780 nm.
    integrate = functools.partial(colour.sd_to_XYZ, method="Integration")
    with unittest.mock.patch.object(cri, "sd_to_XYZ", integrate):
        test = cri.tcs_colorimetry_data(*lights, sds, cmfs, chromatic_adaptation=True)
        reference = cri.tcs_colorimetry_data(lights[1], lights[1], sds, cmfs)
    found = cri.colour_rendering_indexes(test, reference)
    return [found[i].Q_a for i in range(1, 15)]


def fidelity_indices(values, kelvin):
    """Rf, Rg and Rf of each sample with the functions of colour-science, 380 to 780 nm."""
    shape = colour.SpectralShape(380, 780, 1)
    inside = (NM >= 380) & (NM <= 780)
    lights = [
        colour.SpectralDistribution(v[inside], NM[inside])
        for v in (values, fidelity_reference(kelvin))
    ]
    table = cfi2017.load_TCS_CIE2017(colour.SpectralShape(380, 780, 5))
    sds = [
        colour.SpragueInterpolator(table.wavelengths, column)(shape.wavelengths)
        for column in table.values.T
    ]
    sds = colour.MultiSpectralDistributions(
        np.transpose(sds), shape.wavelengths, labels=table.labels
    )
    cmfs = observer_1nm("cie-1964-10")
    cmfs = colour.MultiSpectralDistributions(
        cmfs.values[inside], NM[inside], labels=["x", "y", "z"]
    )
    test, reference = cfi2017.tcs_colorimetry_data(lights, sds, cmfs)
    off = colour.utilities.as_float_array(
        np.linalg.norm(test.Jpapbp - reference.Jpapbp, axis=1)
    )
    bins = np.floor(reference.JMh[:, 2] / 22.5).astype(int)
    corners = [
        np.array([data.Jpapbp[bins == i, 1:].mean(axis=0) for i in range(16)])
        for data in (test, reference)
    ]
    areas = [tm3018.averages_area(c) for c in corners]
    each = cfi2017.delta_E_to_R_f(off)
    by_hue = [float(cfi2017.delta_E_to_R_f(off[bins == i].mean())) for i in range(16)]
    whole = float(cfi2017.delta_E_to_R_f(off.mean()))
    return whole, 100 * areas[0] / areas[1], each, by_hue


def alike(name, what, found, known, within):
    """Stop if the published function of colour-science says something else."""
    if abs(found - known) > within:
        raise ValueError(f"{name}: {what} {found} here, {known} by colour-science")


def rendering():
    cases = []
    for name in LIGHTS:
        values = illuminant_1nm(name).values
        kelvin = temperature(values)
        special = rendering_indices(values, kelvin)
        fidelity, gamut, each, by_hue = fidelity_indices(values, kelvin)
        general = float(np.mean(special[:8]))
        sd = colour.SpectralDistribution(values, NM)
        # Temperatures by a table, other bands and rounded daylight account for the rest.
        alike(name, "Ra", general, colour.colour_rendering_index(sd), 0.15)
        known = tm3018.colour_fidelity_index_ANSIIESTM3018(
            sd.copy().trim(colour.SpectralShape(380, 780, 1)), additional_data=True
        )
        alike(name, "Rf", fidelity, known.R_f, 0.05)
        alike(name, "Rg", gamut, known.R_g, 0.05)
        cases.append(
            {
                "illuminant": name,
                "kelvin": round(float(kelvin), 2),
                "ra": general,
                "special": plain(special),
                "rf": fidelity,
                "rg": float(gamut),
                "samples": plain(each),
                "hue_bins": plain(by_hue),
            }
        )
    return {
        "method": "Colour rendering of the CIE illuminants at 1 nm (linear between rows). CCT:"
        " black body nearest in CIE 1960 (u, v), found by minimisation. ra and special: CIE"
        " 13.3, R1 to R14, colour.quality.cri.tcs_colorimetry_data and"
        " colour_rendering_indexes, samples by Sprague at 1 nm, summed from 360 to 830 nm; reference Planck below 5000"
        " K, else daylight with M1 and M2 not rounded. rf, rg, samples, hue_bins: CIE 224 and"
        " TM-30-18, colour.quality.cfi2017.tcs_colorimetry_data, 99 samples by Sprague from 5"
        " nm, 380 to 780 nm; reference mixed between 4000 and 5000 K. Compared with"
        " colour.colour_rendering_index (within 0.15) and"
        " colour_fidelity_index_ANSIIESTM3018 (within 0.05), which find the temperature by"
        " tables and round the daylight.",
        "tolerance": 9e-4,
        "cases": cases,
    }
