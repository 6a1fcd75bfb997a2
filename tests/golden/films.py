"""Golden values of Kubelka-Munk films and Saunderson surfaces, from 50 digits."""

import mpmath


def km_layer(K, S, d, g):
    """Reflectance of a layer over a backing, by the textbook formula or its limits."""
    K, S, d, g = (mpmath.mpf(v) for v in (K, S, d, g))
    if d == 0:
        return g
    if S == 0:
        return g * mpmath.exp(-2 * K * d)
    if K == 0:
        return (g + S * d * (1 - g)) / (1 + S * d * (1 - g))
    a = 1 + K / S
    b = mpmath.sqrt(a * a - 1)
    bc = b * mpmath.coth(b * S * d)
    return (1 - g * (a - bc)) / (a - g + bc)


def km_free(K, S, d):
    """Reflectance and transmittance of a layer with nothing behind it."""
    K, S, d = (mpmath.mpf(v) for v in (K, S, d))
    if S == 0 or d == 0:
        return mpmath.mpf(0), mpmath.exp(-K * d)
    if K == 0:
        return S * d / (1 + S * d), 1 / (1 + S * d)
    a = 1 + K / S
    b = mpmath.sqrt(a * a - 1)
    # For a thick layer sinh and cosh overflow in doubles, but not in mpmath.
    sinh, cosh = mpmath.sinh(b * S * d), mpmath.cosh(b * S * d)
    below = a * sinh + b * cosh
    return sinh / below, b / below


def km():
    mpmath.mp.dps = 50

    def double(v):
        # float() alone may cut digits off instead of rounding.
        with mpmath.workprec(53):
            return float(+v)

    films = [
        (0.1, 1.0, 1.0), (1.0, 1.0, 1.0), (0.5, 3.0, 0.2), (2.0, 0.3, 0.7),
        (0.01, 20.0, 0.05), (0.003, 8.0, 2.5), (30.0, 5.0, 0.1), (1e6, 1.0, 1.0),
        (1e-3, 1.0, 1.0), (1e-5, 1.0, 1.0), (1e-8, 1.0, 1.0), (1e-12, 1.0, 1.0),
        (1e-15, 1.0, 1.0), (1e-12, 1.0, 1e6), (1e-12, 100.0, 10.0), (0.0, 1.0, 1.0),
        (0.0, 50.0, 3.0), (1.0, 1e-3, 1.0), (1.0, 1e-8, 1.0), (1.0, 1e-12, 1.0),
        (1.0, 0.0, 1.0), (0.25, 0.0, 4.0), (1e-9, 1e-9, 1.0), (1e-7, 1e-5, 2.0),
        (0.0, 0.0, 1.0), (0.4, 2.0, 0.0), (0.4, 2.0, 1e-9), (0.4, 2.0, 1e-4),
        (0.4, 2.0, 10.0), (0.4, 2.0, 300.0), (0.4, 2.0, 1e4), (1e-4, 0.5, 1e5),
        (5.0, 1e-6, 1e3), (1e-3, 1e3, 1e3),
    ]
    grounds = (0.0, 0.08, 0.5, 0.9, 1.0)
    layer, free = [], []
    for K, S, d in films:
        r, t = km_free(K, S, d)
        for g in grounds:
            got = km_layer(K, S, d, g)
            behind = r + t * t * g / (1 - r * g) if r * g != 1 else got
            if abs(got - behind) > mpmath.mpf(10) ** -25:
                raise ValueError(f"layer and free layer disagree: {K} {S} {d} {g}")
            layer.append({"K": K, "S": S, "d": d, "g": g, "R": double(got)})
        free.append({"K": K, "S": S, "d": d, "R": double(r), "T": double(t)})

    infinite = []
    for K, S in [(0.0, 1.0), (1e-12, 1.0), (1e-6, 1.0), (0.01, 2.0), (0.1, 1.0),
                 (1.0, 1.0), (3.0, 0.5), (50.0, 1.0), (1e4, 1.0), (1e8, 1.0)]:
        a = 1 + mpmath.mpf(K) / mpmath.mpf(S)
        infinite.append({"K": K, "S": S, "R": double(a - mpmath.sqrt(a * a - 1))})

    ratio = []
    for R in (0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 0.999999, 1.0):
        R_mp = mpmath.mpf(R)
        ratio.append({"R": R, "KS": double((1 - R_mp) ** 2 / (2 * R_mp))})

    saunderson = []
    for k1, k2 in ((0.0, 0.0), (0.04, 0.6), (0.035, 0.55), (0.0426, 0.596), (0.1, 0.4)):
        for R in (0.0, 0.001, 0.05, 0.3, 0.7, 0.95, 1.0):
            one, two, r = mpmath.mpf(k1), mpmath.mpf(k2), mpmath.mpf(R)
            inside = (1 - one) * (1 - two) * r / (1 - two * r)
            saunderson.append(
                {
                    "k1": k1,
                    "k2": k2,
                    "R": R,
                    "included": double(one + inside),
                    "excluded": double(inside),
                }
            )
    return {
        "method": "Kubelka-Munk in 50 digits by mpmath, the doubles of the case taken as"
        " exact and the result rounded once to a double. layer: (1 - g (a - b coth(b S d)))"
        " / (a - g + b coth(b S d)), a = 1 + K/S, b = sqrt(a^2 - 1); for S = 0 it is g"
        " exp(-2 K d), for K = 0 (g + S d (1 - g)) / (1 + S d (1 - g)). free: R and T of"
        " the same layer with nothing behind. infinite: R = a - b. ratio: K/S = (1 -"
        " R)^2 / (2 R). saunderson: included k1 + (1 - k1)(1 - k2) R / (1 - k2 R),"
        " excluded the same without the first k1.",
        "package": f"mpmath {mpmath.__version__}",
        "tolerance": 1e-12,
        "cases": {
            "layer": layer,
            "free": free,
            "infinite": infinite,
            "ratio": ratio,
            "saunderson": saunderson,
        },
    }
