"""Golden values computed from XYZ and Lab."""

import math

import colour
import numpy as np
from colour.adaptation import CHROMATIC_ADAPTATION_TRANSFORMS
from colour.adaptation import matrix_chromatic_adaptation_VonKries
from colour.models import eotf_inverse_sRGB, eotf_sRGB

from common import SUMMATION, WHITE_PLACES, near, plain, rounded, white_of

CAT_NAMES = ("Bradford", "CAT16")


def to_lab(xyz, white):
    """Lab by colour-science, which takes the white as a chromaticity and Y from 0 to 1."""
    xyz, white = np.asarray(xyz, float), np.asarray(white, float)
    return colour.XYZ_to_Lab(xyz / 100, colour.XYZ_to_xy(white / 100))


def to_lch(lab):
    """LCh with the hue in degrees, 0 for near greys, where rounding determines it."""
    L, C, h = colour.models.Lab_to_LCHab(lab)
    return [L, C, h if C >= 0.01 else 0.0]


LAB_WHITES = (("D65", "cie-1931-2"), ("D50", "cie-1931-2"), ("A", "cie-1964-10"))

LAB_XYZ = [
    [0.0, 0.0, 0.0],
    [0.001, 0.001, 0.001],
    [0.2, 0.3, 0.1],
    [0.5, 0.88, 0.4],
    [0.9, 0.885, 0.9],
    [1.3, 0.6, 2.0],
    [4.0, 9.0, 0.05],
    [18.0, 18.0, 18.0],
    [20.654008, 12.197225, 5.136952],
    [14.222010, 23.042768, 10.495772],
    [41.24, 21.26, 1.93],
    [96.46, 103.7, 14.5],
    [5.0, 2.0, 60.0],
]

LAB_LAB = [
    [0.0, 0.0, 0.0],
    [100.0, 0.0, 0.0],
    [3.0, 2.0, -4.0],
    [7.9, -1.0, 1.5],
    [8.1, 1.0, -1.5],
    [25.0, 40.0, -60.0],
    [53.2, 80.1, 67.2],
    [60.0, -70.0, 30.0],
    [97.1, -21.6, 94.5],
]


def lab():
    from_xyz, from_lab = [], []
    for light, key in LAB_WHITES:
        white = white_of(light, key)
        xy = colour.XYZ_to_xy(np.array(white) / 100)
        for value in [*LAB_XYZ, white]:
            got = to_lab(value, white)
            # The rounded Lab must convert back to XYZ within a part of the tolerance.
            back = colour.Lab_to_XYZ(rounded(plain(got), 10), xy) * 100
            if np.abs(back - value).max() > 5e-10:
                raise ValueError(f"{value}: Lab leads back to {back}")
            x, y, Y = colour.XYZ_to_xyY(np.array(value) / 100)
            from_xyz.append(
                {
                    "white": white,
                    "XYZ": value,
                    "xyY": plain([x, y, Y * 100]) if sum(value) > 0 else None,
                    "Lab": plain(got),
                    "LCh": plain(to_lch(got)),
                }
            )
        for value in LAB_LAB:
            back = colour.Lab_to_XYZ(value, xy) * 100
            near(to_lab(back, white), value, 1e-11)
            from_lab.append(
                {
                    "white": white,
                    "Lab": value,
                    "LCh": plain(to_lch(value)),
                    "XYZ": plain(back),
                }
            )
    return {
        "method": "CIE 1976 Lab with the exact toe (24/116)^3 and 841/108, XYZ and white"
        " on the scale where the white has Y = 100; hue in degrees 0 to 360, recorded as"
        " 0 and not to be compared where C < 0.01; xyY keeps Y on the same scale and is"
        " null for XYZ of zero. from_xyz begins with XYZ, and its Lab leads back to its"
        " XYZ within the tolerance; from_lab begins with Lab, and because XYZ is rounded"
        " its dark colours do not lead back so closely.",
        "tolerance": 1e-9,
        "cases": {"from_xyz": from_xyz, "from_lab": from_lab},
    }


def to_luv(xyz, white):
    """Luv by colour-science, checked against the formula."""
    xyz, white = np.asarray(xyz, float) / 100, np.asarray(white, float) / 100
    got = colour.XYZ_to_Luv(xyz, colour.XYZ_to_xy(white)) if sum(xyz) > 0 else np.zeros(3)
    share = [4 * xyz[0], 9 * xyz[1]] / (xyz @ [1, 15, 3]) if sum(xyz) > 0 else np.zeros(2)
    white_share = [4 * white[0], 9 * white[1]] / (white @ [1, 15, 3])
    L = 116 * np.cbrt(xyz[1]) - 16 if xyz[1] > 216 / 24389 else 24389 / 27 * xyz[1]
    near(got, [L, *(13 * L * (share - white_share))], 1e-11)
    return got


def luv():
    cases = []
    for light, key in LAB_WHITES:
        white = white_of(light, key)
        for value in [*LAB_XYZ, white]:
            got = plain(to_luv(value, white))
            cases.append({"white": white, "XYZ": value, "Luv": got})
    return {
        "method": "CIE 1976 Luv, XYZ and white on the scale where the white has Y = 100;"
        " XYZ of zero is Luv of zero.",
        "tolerance": 1e-9,
        "cases": cases,
    }


PAIRS = [
    ((50, 10, 10), (50, 10, 10)),
    ((0, 0, 0), (100, 0, 0)),
    ((0, 0, 0), (1, 0, 0)),
    ((50, 0, 0), (51, 0, 0)),
    ((50, 0, 0), (50, 1, 0)),
    ((50, 0, 0), (50, 0, -1)),
    ((50, 0.5, 0), (50, 0, 0.5)),
    ((10, 3, -4), (12, 3.5, -4.4)),
    ((15.9, 5, 5), (16.1, 5, 5)),
    ((16, 5, 5), (17, 5, 5)),
    ((16.1, 5, 5), (15.9, 5, 5)),
    ((52.3, 71.2, 58.9), (54.1, 69.0, 61.7)),
    ((54.1, 69.0, 61.7), (52.3, 71.2, 58.9)),
    ((88, -5, 85), (86.5, -3, 90)),
    ((46, -52, 26), (47, -48, 29)),
    ((46, -52, -1), (46, -52, 1)),
    ((60, -20, -35), (61, -24, -31)),
    ((32, 20, -60), (33, 14, -55)),
    ((32, 40, -95), (34, 35, -90)),
    ((28, 0.5, -45), (28, -0.5, -45)),
    ((40, 55, -3), (40, 55, 3)),
    ((40, 55, 3), (40, 55, -3)),
    ((40, 60, -15.5), (41, 58, -16.5)),
    ((70, 30, 40), (72, -30, 45)),
    ((70, 5, 80), (40, -60, 10)),
    ((30, 70, -20), (80, -40, 60)),
    ((95, -0.4, 1.2), (94.2, 0.3, 2.5)),
    ((99.5, 0.1, 0.1), (100, 0, 0)),
    ((55, 12, -18), (55.05, 12.04, -18.03)),
    ((20, 128, -128), (25, 120, -110)),
]

# CIEDE2000, published to four digits.
SHARMA = [
    (50, 2.6772, -79.7751, 50, 0, -82.7485, 2.0425),
    (50, 3.1571, -77.2803, 50, 0, -82.7485, 2.8615),
    (50, 2.8361, -74.0200, 50, 0, -82.7485, 3.4412),
    (50, -1.3802, -84.2814, 50, 0, -82.7485, 1.0000),
    (50, -1.1848, -84.8006, 50, 0, -82.7485, 1.0000),
    (50, -0.9009, -85.5211, 50, 0, -82.7485, 1.0000),
    (50, 0, 0, 50, -1, 2, 2.3669),
    (50, -1, 2, 50, 0, 0, 2.3669),
    (50, 2.4900, -0.0010, 50, -2.4900, 0.0009, 7.1792),
    (50, 2.4900, -0.0010, 50, -2.4900, 0.0010, 7.1792),
    (50, 2.4900, -0.0010, 50, -2.4900, 0.0011, 7.2195),
    (50, 2.4900, -0.0010, 50, -2.4900, 0.0012, 7.2195),
    (50, -0.0010, 2.4900, 50, 0.0009, -2.4900, 4.8045),
    (50, -0.0010, 2.4900, 50, 0.0010, -2.4900, 4.8045),
    (50, -0.0010, 2.4900, 50, 0.0011, -2.4900, 4.7461),
    (50, 2.5, 0, 50, 0, -2.5, 4.3065),
    (50, 2.5, 0, 73, 25, -18, 27.1492),
    (50, 2.5, 0, 61, -5, 29, 22.8977),
    (50, 2.5, 0, 56, -27, -3, 31.9030),
    (50, 2.5, 0, 58, 24, 15, 19.4535),
    (50, 2.5, 0, 50, 3.1736, 0.5854, 1.0000),
    (50, 2.5, 0, 50, 3.2972, 0, 1.0000),
    (50, 2.5, 0, 50, 1.8634, 0.5757, 1.0000),
    (50, 2.5, 0, 50, 3.2592, 0.3350, 1.0000),
    (60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644),
    (63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630),
    (61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731),
    (35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645),
    (22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373),
    (36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146),
    (90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441),
    (90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381),
    (6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377),
    (2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082),
]


def opposite(one, two):
    """Whether the hues differ by exactly 180 degrees, where CIEDE2000 branches."""
    chroma = math.hypot(*one[1:]) * math.hypot(*two[1:])
    # Both a* are scaled by the same factor, so opposite hues stay opposite.
    return chroma > 0 and one[1:] == [-v for v in two[1:]]


WHITENESS_XYZ = [
    [86.0, 90.0, 102.0],
    [84.0, 88.0, 95.0],
    [92.0, 97.0, 105.0],
    [80.0, 84.5, 99.0],
    [70.0, 73.5, 84.0],
]


def whiteness():
    cases = []
    for light in ("D65", "C"):
        for key, method_xy in (("cie-1931-2", "2"), ("cie-1964-10", "10")):
            white = white_of(light, key)
            for value in WHITENESS_XYZ:
                xy = colour.XYZ_to_xy(np.array(value) / 100)
                xy_n = colour.XYZ_to_xy(np.array(white) / 100)
                observer = f"CIE {'1931' if method_xy == '2' else '1964'} {method_xy} Degree Standard Observer"
                w, t = colour.colorimetry.whiteness_CIE2004(
                    xy, value[1], xy_n, observer=observer
                )
                x, y = xy_n - xy
                near(w, value[1] + 800 * x + 1700 * y)
                near(t, (1000 if method_xy == "2" else 900) * x - 650 * y)
                white_enough = 40 < w < 5 * value[1] - 280 and -4 < t < 2
                cases.append(
                    {
                        "illuminant": light,
                        "observer": key,
                        "white": white,
                        "XYZ": value,
                        "WT": plain([w, t]),
                        "white_enough": bool(white_enough),
                    }
                )
    return {
        "method": "CIE whiteness W and tint T, CIE 15, by"
        " colour.colorimetry.whiteness_CIE2004 and the formulas written out: W = Y + 800"
        " (xn - x) + 1700 (yn - y), T = k (xn - x) - 650 (yn - y), k 1000 for 2 degrees"
        " and 900 for 10. white_enough: 40 < W < 5 Y - 280 and -4 < T < 2.",
        "tolerance": 1e-8,
        "cases": cases,
    }


def difference():
    cases = []
    for one, two in PAIRS:
        one, two = [float(v) for v in one], [float(v) for v in two]
        if opposite(one, two):
            raise ValueError("a pair on the branch of CIEDE2000 belongs in sharma.json")
        a, b = np.array(one), np.array(two)
        cases.append(
            {
                "reference": one,
                "sample": two,
                "ciede2000": plain(colour.delta_E(a, b, method="CIE 2000")),
                "cie1976": plain(colour.delta_E(a, b, method="CIE 1976")),
                "cie94": plain(colour.delta_E(a, b, method="CIE 1994")),
                "cie94_textiles": plain(
                    colour.delta_E(a, b, method="CIE 1994", textiles=True)
                ),
                "cmc_2_1": plain(colour.delta_E(a, b, method="CMC", l=2, c=1)),
                "cmc_1_1": plain(colour.delta_E(a, b, method="CMC", l=1, c=1)),
            }
        )
    return {
        "method": "Colour differences of two Lab values. CIEDE2000 with kL = kC = kH = 1;"
        " CIE94 for graphic arts (kL 1, K1 0.045, K2 0.015) and textiles (kL 2, K1 0.048,"
        " K2 0.014), with the chroma of the reference (first) sample in SC and SH; CMC"
        " (l:c) of 2:1 and 1:1, with the reference first. CIE94 and CMC are not"
        " symmetric.",
        "tolerance": 1e-9,
        "cases": cases,
    }


def sharma():
    cases = []
    for number, row in enumerate(SHARMA, 1):
        one, two = [float(v) for v in row[:3]], [float(v) for v in row[3:6]]
        got = float(colour.delta_E(np.array(one), np.array(two), method="CIE 2000"))
        if abs(got - row[6]) > 5e-5:
            raise ValueError(f"pair {number}: {got}, published {row[6]}")
        cases.append(
            {
                "pair": number,
                "reference": one,
                "sample": two,
                "published": row[6],
                "ciede2000": plain(got),
                "branch": opposite(one, two),
            }
        )
    return {
        "method": "The 34 pairs of G. Sharma, W. Wu, E. N. Dalal, The CIEDE2000"
        " color-difference formula: implementation notes, supplementary test data, and"
        " mathematical observations, Color Research and Application 30 (2005) 21-30,"
        " table 1, with the CIEDE2000 printed there to four digits and the value of"
        " colour.delta_E in full. Where branch is true the hues are exactly half a turn"
        " apart: which side of the branch a program takes hangs on the last bit of its"
        " atan2, and the published side is the one for |h1 - h2| <= 180.",
        "tolerance": 5e-5,
        "cases": cases,
    }


CATS = {name: np.asarray(CHROMATIC_ADAPTATION_TRANSFORMS[name]) for name in CAT_NAMES}


def adapt(name, source, target):
    """Von Kries matrix by colour-science, checked against the formula."""
    got = matrix_chromatic_adaptation_VonKries(
        np.array(source), np.array(target), transform=name
    )
    m = CATS[name]
    gains = (m @ np.array(target)) / (m @ np.array(source))
    near(got, np.linalg.inv(m) @ np.diag(gains) @ m)
    return got


def adaptation():
    whites = {name: white_of(name) for name in ("A", "D50", "D65", "E", "FL11")}
    samples = [[20.654008, 12.197225, 5.136952], [14.22, 23.04, 10.5], [5.0, 2.0, 60.0]]
    routes = [("A", "D65"), ("D65", "A"), ("D50", "D65"), ("D65", "D50")]
    routes += [("FL11", "D50"), ("E", "D65"), ("D65", "D65")]
    cases = []
    for name in CAT_NAMES:
        for start, end in routes:
            m = adapt(name, whites[start], whites[end])
            cases.append(
                {
                    "transform": name,
                    "from": start,
                    "to": end,
                    "from_white": whites[start],
                    "to_white": whites[end],
                    "matrix": plain(m),
                    "samples": [
                        {"XYZ": s, "adapted": plain(m @ np.array(s))} for s in samples
                    ],
                }
            )
    return {
        "method": "Von Kries adaptation, complete (degree 1): inverse(M) diag(target /"
        " source) M, with the linear Bradford matrix and with that of CAT16 (forward"
        " below); the inverse is computed, not typed. Whites are those of the CIE 1931"
        " observer, " + SUMMATION + ". Matrices are rows, for a column XYZ.",
        "tolerance": 1e-9,
        "forward": {name: plain(m) for name, m in CATS.items()},
        "cases": cases,
    }


RGB_WHITE = (0.3127, 0.3290)

RGB_SPACES = {
    "srgb": ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06)),
    "display-p3": ((0.68, 0.32), (0.265, 0.69), (0.15, 0.06)),
}

RGB_XYZ = [
    [0.0, 0.0, 0.0],
    [0.02, 0.02, 0.02],
    [18.0, 18.0, 18.0],
    [20.654008, 12.197225, 5.136952],
    [14.22201, 23.042768, 10.495772],
    [41.24, 21.26, 1.93],
    [35.76, 71.52, 11.92],
    [18.05, 7.22, 95.05],
    [5.0, 2.0, 60.0],
    [3.0, 12.0, 8.0],
    [60.0, 35.0, 1.0],
    [120.0, 130.0, 110.0],
]


def encode(linear_rgb):
    return eotf_inverse_sRGB(np.asarray(linear_rgb))


def mirrored(linear_rgb):
    v = np.asarray(linear_rgb)
    return np.sign(v) * eotf_inverse_sRGB(np.abs(v))


def rgb():
    x, y = RGB_WHITE
    target = [x / y * 100, 100.0, (1 - x - y) / y * 100]
    spaces = {}
    for name, primaries in RGB_SPACES.items():
        to_xyz = colour.normalised_primary_matrix(np.array(primaries), np.array(RGB_WHITE))
        near(to_xyz @ np.ones(3), np.array(target) / 100)
        spaces[name] = {
            "primaries": [list(p) for p in primaries],
            "to_xyz": to_xyz,
            "from_xyz": np.linalg.inv(to_xyz),
        }

    sources = [(None, None, target)]
    sources += [(l, c, white_of(l)) for l in ("A", "D50") for c in CAT_NAMES]
    colours = []
    for light, cat, white in sources:
        move = np.eye(3) if cat is None else adapt(cat, white, target)
        # The source white itself must come out as (1, 1, 1).
        for value in [*RGB_XYZ, rounded(plain(white), WHITE_PLACES)]:
            case = {"transform": cat, "white": plain(white), "XYZ": value}
            for name, space in spaces.items():
                v = space["from_xyz"] @ (move @ np.array(value)) / 100
                case[name] = {
                    "linear": plain(v),
                    "encoded": plain(encode(v)),
                    "mirrored": plain(mirrored(v)),
                }
            colours.append(case)

    # No encoded value lies between 0.04044 and 0.04046, where definitions of the curve differ.
    levels = [-1.0, -0.25, -0.002, 0.0, 0.0001, 0.001, 0.003, 0.0032, 0.01, 0.05]
    levels += [0.18, 0.2140411, 0.5, 0.735, 1.0, 1.5, 12.0]
    transfer = []
    for v in levels:
        e = float(encode(v))
        near(float(eotf_sRGB(e)), v, 1e-11)
        transfer.append(
            {"linear": v, "encoded": plain(e), "mirrored": plain(float(mirrored(v)))}
        )
    return {
        "method": "XYZ (white has Y = 100) to unclipped sRGB and Display P3. Both spaces"
        " have the white xy = (0.3127, 0.3290) and a matrix computed at full precision"
        " from primaries and white (colour.normalised_primary_matrix), not the rounded"
        " matrix of IEC 61966-2-1. Where transform is null XYZ is taken as it stands;"
        " otherwise it is first carried from white to the white of the space by von Kries"
        " with Bradford or CAT16 (see adaptation.json). Both spaces share the transfer"
        " curve: 12.92 v up to v = 0.0031308, 1.055 v^(1/2.4) - 0.055 above. encoded runs"
        " the straight part on below zero (as colour does); mirrored is sign(v) f(|v|)."
        " They differ only for negative v.",
        "tolerance": 1e-10,
        "white_xy": list(RGB_WHITE),
        "spaces": {
            name: {
                "primaries": s["primaries"],
                "to_xyz": plain(s["to_xyz"]),
                "from_xyz": plain(s["from_xyz"]),
            }
            for name, s in spaces.items()
        },
        "cases": {"colours": colours, "transfer": transfer},
    }
