"""Golden values computed from spectra."""

import math

import colour
import numpy as np
from colour.colorimetry import planck_law
from colour.colorimetry.blackbody import CONSTANT_C2

import tables
from colours import to_lab
from common import (
    NM,
    REFLECTANCES,
    SUMMATION,
    bump,
    grid_of,
    illuminant_1nm,
    linear,
    near,
    observer_1nm,
    plain,
    reflectance,
    rise,
    sprague,
    tristimulus,
)


def xyz():
    reflectances = {name: dict(r) for name, r in REFLECTANCES.items()}
    names = list(reflectances)
    by_sprague = [sprague(r, NM) for r in reflectances.values()]
    by_line = [linear(r, NM) for r in reflectances.values()]
    observers = {key: observer_1nm(key) for key in tables.OBSERVERS}
    lights = {name: illuminant_1nm(name) for name in tables.ILLUMINANTS}

    def case(interpolation, light, key, rows):
        got = tristimulus([np.ones(NM.size), *rows], observers[key], lights[light])
        return {
            "illuminant": light,
            "observer": key,
            "interpolation": interpolation,
            "white": plain(got[0]),
            "samples": {name: plain(v) for name, v in zip(names, got[1:])},
        }

    cases = [case("sprague", l, o, by_sprague) for l in lights for o in observers]
    cases += [case("linear", "D65", o, by_line) for o in observers]
    return {
        "method": SUMMATION + "; reflectance brought to 1 nm from its own regular grid"
        " by the interpolation named in the case (sprague: CIE 167, or linear), end"
        " values held outside. Illuminants and observers are the columns and files of"
        " spectra/data. Exact sums of the products, which agree to 1e-12 with"
        " colour.colorimetry.sd_to_XYZ_integration on the same aligned data.",
        "tolerance": 1e-9,
        "reflectances": reflectances,
        "cases": cases,
    }


def resampling():
    spectra = {
        "blue_10": REFLECTANCES["blue_10"],
        "orange_20": REFLECTANCES["orange_20"],
        "constant": reflectance(400, 10, [0.25] * 31),
        # A step makes Sprague overshoot, below zero too.
        "step": reflectance(400, 10, [0.0] * 12 + [1.0] * 19),
        "zigzag": reflectance(400, 20, [0.1, 0.9] * 8),
        "six": reflectance(400, 20, [0.3, 0.1, 0.4, 0.15, 0.9, 0.26]),
        "fifth_degree": reflectance(
            500, 10, [round(((i - 4) / 5.0) ** 5 - 0.5 * (i / 5.0) ** 2, 5) for i in range(11)]
        ),
    }
    # spectrum, first, last, step
    targets = [
        ("blue_10", 400, 700, 1),
        ("orange_20", 400, 700, 5),
        ("constant", 400, 700, 10),
        ("step", 480, 540, 1),
        ("zigzag", 400, 700, 5),
        ("six", 400, 500, 2.5),
        ("fifth_degree", 500, 600, 2),
        ("blue_10", 380, 740, 20),
        ("orange_20", 403, 697, 7),
    ]
    cases = []
    for method, function in (("sprague", sprague), ("linear", linear)):
        for name, first, last, step in targets:
            to = np.arange(first, last + step / 2, step)
            source = spectra[name]
            values = function(source, to)
            at = [i for i, w in enumerate(to) if w in grid_of(source)]
            at_rows = np.interp(to[at], grid_of(source), source["values"])
            near(np.asarray(values)[at], at_rows)
            cases.append(
                {
                    "method": method,
                    "spectrum": name,
                    "to_start_nm": float(first),
                    "to_step_nm": float(step),
                    "values": plain(values),
                }
            )
    return {
        "method": "Resampling of regular spectra: sprague is the fifth-order method of"
        " CIE 167:2005 with two extrapolated points at each end"
        " (colour.SpragueInterpolator), linear is straight between neighbours; end"
        " values held outside. The number of values says where the target grid ends.",
        "tolerance": 1e-11,
        "spectra": spectra,
        "cases": cases,
    }


def daylight_weights(xy):
    x, y = xy
    m = 0.0241 + 0.2562 * x - 0.7341 * y
    m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m
    m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m
    for weight in (m1, m2):
        # Rounding to three decimals must not depend on the last bit of a weight.
        if abs(math.fmod(abs(weight) * 1000, 1) - 0.5) < 1e-6:
            raise ValueError(f"daylight weight {weight} is halfway between decimals")
    return m1, m2


def daylight():
    # Nominal temperatures were set when c2 was 1.4380e-2.
    names = {"D50": 5000, "D55": 5500, "D65": 6500, "D75": 7500}
    nominal = {n: round(t * 1.4388 / 1.4380, 6) for n, t in names.items()}
    steps = [(None, t) for t in (4000, 5003, 6504, 7000, 7001, 9300, 12000, 25000)]
    cases = []
    for name, kelvin in sorted([*nominal.items(), *steps], key=lambda pair: pair[1]):
        xy = colour.temperature.CCT_to_xy_CIE_D(float(kelvin))
        exact = colour.sd_CIE_illuminant_D_series(xy, M1_M2_rounding=False)
        short = colour.sd_CIE_illuminant_D_series(xy, M1_M2_rounding=True)
        weights = daylight_weights(xy)
        s0, s1, s2 = (tables.DAYLIGHT[k].values for k in ("S0", "S1", "S2"))
        near(exact.values, s0 + weights[0] * s1 + weights[1] * s2)
        if name:
            table = colour.SDS_ILLUMINANTS[name].values
            off = np.abs(short.values[: table.size] - table).max()
            # The tables have three decimals; some interpolated rows are truncated.
            if off > 1e-3:
                raise ValueError(f"{name}: {off} from its table")
        cases.append(
            {
                "nominal": name,
                "kelvin": float(kelvin),
                "xy": plain(xy),
                "m1": plain(weights[0]),
                "m2": plain(weights[1]),
                "spd": plain(exact.values),
                "spd_rounded": plain(short.values),
            }
        )
    return {
        "method": "Phases of daylight from 4000 to 25000 K, CIE 15: chromaticity xD from"
        " the cubic in 1/T (one for T <= 7000 K, one above), yD = -3 xD^2 + 2.87 xD -"
        " 0.275, with no rounding of xD, yD (colour.temperature.CCT_to_xy_CIE_D); SPD"
        " S0 + M1 S1 + M2 S2 on the rows of spectra/data/daylight-components.csv, 300 to"
        " 830 nm by 5 nm (colour.sd_CIE_illuminant_D_series). spd leaves M1 and M2 as"
        " they come (m1, m2; M1_M2_rounding=False), spd_rounded rounds both to three"
        " decimals as CIE 15 asks (M1_M2_rounding=True). Temperatures are on the present"
        " scale. Nominal D50, D55, D65, D75 stand at 1.4388/1.4380 times 5000, 5500,"
        " 6500, 7500 K, about 5003, 5503, 6504, 7504 K; only that temperature, not the"
        " whole number, gives the printed table through the rounded weights, and the"
        " cases with a name were compared with it.",
        "tolerance": 1e-9,
        "start_nm": 300,
        "step_nm": 5,
        "cases": cases,
    }


def blackbody():
    nm = np.arange(360, 831, 10)
    cases = []
    for kelvin in (2000, 2856, 3200, 4000, 5003, 5600, 6504, 10000, 20000):
        spd = planck_law(nm * 1e-9, kelvin)
        spd = 100 * spd / planck_law(560e-9, kelvin)
        # Check against the formula stated in the method.
        c = CONSTANT_C2 * 1e9
        ratio = np.expm1(c / (560 * kelvin)) / np.expm1(c / (nm * kelvin))
        near(spd, 100 * (560 / nm) ** 5 * ratio)
        cases.append({"kelvin": float(kelvin), "spd": plain(spd)})
    return {
        "method": "Planck radiator per unit wavelength, 100 at 560 nm, in vacuum (n = 1):"
        " 100 (560/w)^5 expm1(c2/(560 T)) / expm1(c2/(w T)) with c2 = 1.4388e-2 m K"
        " (colour.colorimetry.planck_law); 360 to 830 nm by 10 nm. Standard illuminant A"
        " is not in here: it is defined with c2 = 1.435e-2 m K and T = 2848 K, and has its"
        " own column in spectra/data/illuminants.csv.",
        "tolerance": 1e-9,
        "c2_m_k": CONSTANT_C2,
        "start_nm": 360,
        "step_nm": 10,
        "cases": cases,
    }


def metameric_pairs(cmfs, light):
    """Pairs of reflectances at 400 to 700 nm that match, or nearly, under one light."""
    nm = np.arange(400, 701, 10)
    weights = np.array(
        [
            tristimulus(sprague(reflectance(400, 10, list(unit)), NM), cmfs, light)[0]
            for unit in np.eye(nm.size)
        ]
    )

    def unseen(v):
        """The metameric black in v: its component with XYZ of 0 under this light."""
        seen, *_ = np.linalg.lstsq(weights.T, weights.T @ v, rcond=None)
        return v - seen

    def of(function):
        return np.array([function(float(w)) for w in nm])

    # Not flat: the hue of an exact neutral is rounding noise, which CIEDE2000 enlarges.
    grey = of(lambda w: 0.32 + 0.12 * rise(w, 580, 60))
    ochre = of(lambda w: 0.08 + 0.5 * rise(w, 560, 25))
    blue = of(lambda w: 0.1 + 0.4 * bump(w, 450, 60))
    wave = of(lambda w: math.sin((w - 400) / 21.0))
    ripple = of(lambda w: bump(w, 610, 22) - bump(w, 540, 30))
    pairs = {
        "grey": (grey, grey + 0.15 * unseen(wave)),
        "ochre": (ochre, ochre + 0.12 * unseen(ripple)),
        "ochre_off": (ochre, 1.03 * (ochre + 0.12 * unseen(ripple))),
        "blue_off": (blue, blue + 0.06 * unseen(wave) + 0.004),
    }
    # Rounding to six decimals leaves small mismatches, as in measured pairs.
    return {
        name: [[round(float(v), 6) for v in one] for one in pair]
        for name, pair in pairs.items()
    }


def metamerism():
    reference = "D65"
    lights = {n: illuminant_1nm(n) for n in (reference, "A", "FL11", "LED-B3")}
    pairs, cases = {}, []
    for key in ("cie-1931-2", "cie-1964-10"):
        cmfs = observer_1nm(key)
        for name, pair in metameric_pairs(cmfs, lights[reference]).items():
            if not all(0 < v < 1 for one in pair for v in one):
                raise ValueError(f"{name}: not a reflectance")
            label = f"{name} {key}"
            pairs[label] = {"start_nm": 400, "step_nm": 10, "one": pair[0], "two": pair[1]}
            rows = [sprague(reflectance(400, 10, one), NM) for one in pair]
            rows.append(np.ones(NM.size))
            r1, r2, rw = tristimulus(rows, cmfs, lights[reference])
            under = [to_lab(r1, rw), to_lab(r2, rw)]
            for test in [n for n in lights if n != reference]:
                t1, t2, tw = tristimulus(rows, cmfs, lights[test])
                mended = t2 * r1 / r2
                a, b = to_lab(t1, tw), to_lab(mended, tw)
                cases.append(
                    {
                        "pair": label,
                        "observer": key,
                        "reference": reference,
                        "test": test,
                        "reference_cie1976": plain(colour.delta_E(*under, method="CIE 1976")),
                        "reference_ciede2000": plain(
                            colour.delta_E(*under, method="CIE 2000")
                        ),
                        "corrected_XYZ": plain(mended),
                        "cie1976": plain(colour.delta_E(a, b, method="CIE 1976")),
                        "ciede2000": plain(colour.delta_E(a, b, method="CIE 2000")),
                    }
                )
    return {
        "method": "Special metamerism index, change of illuminant, CIE 15: XYZ of the two"
        " reflectances as in xyz.json (" + SUMMATION + "; Sprague to 1 nm, end values"
        " held). The second is corrected channel by channel, XYZ_t2 XYZ_r1 / XYZ_r2, and"
        " the index is the colour difference of one and corrected two under the test"
        " light, Lab against the white of the test light. The reference values are plain"
        " differences under the reference light. The correction is plain numpy on XYZ of"
        " colour.",
        "tolerance": 1e-8,
        "pairs": pairs,
        "cases": cases,
    }
