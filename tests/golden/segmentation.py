"""Pictures with known regions and how well OpenCV's mean shift finds them; modes of
small sets by scikit-learn.

The pictures are made by sums, products, quotients and square roots alone, so that their
bytes are the same in every language: the test makes them again.
"""

import math

import colour
import cv2
import numpy as np
import sklearn
from sklearn.cluster import MeanShift

WIDTH, HEIGHT = 160, 120
SETTINGS = {"spatial_radius_px": 8.0, "range_radius": 8.0, "least_region_px": 40}
# Range radii in RGB bytes: several, because none equals 8 in CIELUV for all colours.
OPENCV_RANGES = (10.0, 15.0, 20.0, 30.0)
# Largest colour difference of neighbours in one region, in range radii.
LINK = 0.5
OPENCV_LEVELS = 1
# Tolerance of the position of a boundary, in pixels.
REACH = 2
CHECKED = ("opencv-python-headless", "5.0.0")


def shape(kind, numbers, rgb, across=(0, 0, 0), down=(0, 0, 0), texture=0.0, period=4.0,
          soft=1.5):
    """A shape: its outline, its colour at the top left and the gain of that to the right
    and to the bottom, a triangular wave along the diagonal, and a soft edge."""
    return {"kind": kind, "numbers": numbers, "rgb": rgb, "across": across, "down": down,
            "texture": texture, "period": period, "soft": soft}


def everywhere(rgb, **more):
    return shape("everywhere", [], rgb, **more)


PICTURES = {
    "discs": (0.03, [
        everywhere([0.70, 0.66, 0.58], across=[-0.12, -0.10, -0.08]),
        shape("disc", [45, 45, 28], [0.62, 0.28, 0.22], down=[0.10, 0.10, 0.05]),
        shape("disc", [110, 40, 22], [0.25, 0.38, 0.60], across=[0.08, 0.08, 0.05]),
        shape("disc", [95, 88, 24], [0.40, 0.52, 0.25], across=[0.06, 0.08, 0.04]),
    ]),
    "thin": (0.02, [
        everywhere([0.55, 0.62, 0.70], down=[0.15, 0.10, 0.05]),
        shape("line", [0.6, 0.8, 70, 2.0], [0.22, 0.20, 0.18], soft=1.0),
        shape("line", [0.8, -0.6, 40, 1.5], [0.30, 0.16, 0.12], soft=1.0),
        shape("line", [1.0, 0.0, 130, 2.5], [0.85, 0.80, 0.60], soft=1.0),
        shape("line", [0.0, 1.0, 18, 1.5], [0.15, 0.25, 0.20], soft=1.0),
    ]),
    "faint": (0.02, [
        everywhere([0.50, 0.50, 0.50], across=[0.05, 0.05, 0.05]),
        shape("half", [1.0, 0.0, 90], [0.59, 0.58, 0.55], down=[0.04, 0.04, 0.04]),
        shape("disc", [45, 60, 26], [0.42, 0.45, 0.48]),
        shape("disc", [122, 70, 22], [0.70, 0.66, 0.60]),
    ]),
    "woven": (0.02, [
        everywhere([0.46, 0.40, 0.30], texture=0.06, period=5.0),
        shape("half", [0.6, -0.8, 10], [0.62, 0.60, 0.52], texture=0.05, period=4.0),
        shape("disc", [70, 70, 30], [0.28, 0.36, 0.44], texture=0.05, period=6.0, soft=2.0),
    ]),
    "hills": (0.025, [
        everywhere([0.62, 0.74, 0.90], down=[0.30, 0.20, 0.05], soft=2.0),
        shape("disc", [40, 150, 90], [0.42, 0.50, 0.46], across=[0.05, 0.05, 0.05], soft=2.5),
        shape("disc", [130, 165, 95], [0.30, 0.42, 0.26], across=[0.08, 0.06, 0.02], soft=2.0),
        shape("half", [0.0, 1.0, 104], [0.34, 0.26, 0.18], across=[0.10, 0.08, 0.05]),
    ]),
    "patches": (0.04, [
        everywhere([0.20, 0.22, 0.30]),
        shape("half", [0.6, 0.8, 60], [0.72, 0.68, 0.40]),
        shape("half", [0.8, -0.6, 30], [0.60, 0.30, 0.30]),
        shape("disc", [30, 95, 20], [0.85, 0.84, 0.80]),
        shape("disc", [80, 60, 14], [0.16, 0.40, 0.36]),
        shape("disc", [135, 25, 18], [0.90, 0.60, 0.20], soft=3.0),
        shape("line", [0.8, 0.6, 125, 4.0], [0.30, 0.20, 0.45]),
    ]),
}


class Noise:
    """Random numbers of 0 to 1: the upper 32 bits of a linear congruential generator."""

    def __init__(self, seed):
        self.state = seed

    def next(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 32) / 2**32


def distance(kind, n, x, y):
    """Distance of a place from the outline of a shape; negative inside."""
    if kind == "everywhere":
        return -1e6
    if kind == "disc":
        return math.sqrt((x - n[0]) * (x - n[0]) + (y - n[1]) * (y - n[1])) - n[2]
    if kind == "half":
        return n[2] - (n[0] * x + n[1] * y)
    return abs(n[0] * x + n[1] * y - n[2]) - n[3]


def made(noise, shapes, seed):
    """Bytes in rows, and the shape that is uppermost at each pixel."""
    random = Noise(seed)
    picture = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    truth = np.zeros((HEIGHT, WIDTH), int)
    for y in range(HEIGHT):
        for x in range(WIDTH):
            colours = [0.0, 0.0, 0.0]
            for number, s in enumerate(shapes):
                away = distance(s["kind"], s["numbers"], x, y)
                if away < 0:
                    truth[y, x] = number
                t = min(max(0.5 - away / (2.0 * s["soft"]), 0.0), 1.0)
                cover = t * t * (3.0 - 2.0 * t)
                turn = (x + 2.0 * y) / s["period"]
                turn = turn - float(int(turn))
                wave = s["texture"] * (4.0 * abs(turn - 0.5) - 1.0)
                for i in range(3):
                    own = s["rgb"][i] + s["across"][i] * (x / WIDTH)
                    own = own + s["down"][i] * (y / HEIGHT) + wave
                    colours[i] = colours[i] + cover * (own - colours[i])
            for i in range(3):
                draws = random.next() + random.next() + random.next() + random.next()
                value = colours[i] + noise * 1.75 * (draws - 2.0)
                picture[y, x, i] = int(min(max(value, 0.0), 1.0) * 255.0 + 0.5)
    return picture, truth


def fnv(picture):
    """FNV-1a of the bytes, 32 bits."""
    value = 2166136261
    for byte in picture.tobytes():
        value = ((value ^ byte) * 16777619) % 2**32
    return value


def luv_of(picture):
    space = colour.RGB_COLOURSPACES["sRGB"]
    matrix = colour.normalised_primary_matrix(space.primaries, space.whitepoint)
    linear = colour.models.eotf_sRGB(picture / 255.0)
    return colour.XYZ_to_Luv(linear @ matrix.T, space.whitepoint)


def linked(luv, near):
    """Labels of regions: neighbours in rows and columns with near colours share one."""
    parents = list(range(WIDTH * HEIGHT))

    def root(i):
        while parents[i] != i:
            parents[i] = parents[parents[i]]
            i = parents[i]
        return i

    right = np.linalg.norm(luv[:, 1:] - luv[:, :-1], axis=2) <= near
    down = np.linalg.norm(luv[1:] - luv[:-1], axis=2) <= near
    for found, step in ((right, 1), (down, WIDTH)):
        for y, x in np.argwhere(found):
            one, other = root(y * WIDTH + x), root(y * WIDTH + x + step)
            parents[max(one, other)] = min(one, other)
    return np.array([root(i) for i in range(WIDTH * HEIGHT)]).reshape(HEIGHT, WIDTH)


def pruned(labels, luv, least):
    """Join small regions to the neighbour nearest in colour, the smallest first."""
    labels = labels.copy()
    while True:
        names, counts = np.unique(labels, return_counts=True)
        if counts.min() >= least or len(names) == 1:
            return labels
        region = names[counts.argmin()]
        inside = labels == region
        around = np.zeros_like(inside)
        around[1:] |= inside[:-1]
        around[:-1] |= inside[1:]
        around[:, 1:] |= inside[:, :-1]
        around[:, :-1] |= inside[:, 1:]
        own = luv[inside].mean(axis=0)
        others = np.unique(labels[around & ~inside])
        far = [np.linalg.norm(luv[labels == other].mean(axis=0) - own) for other in others]
        labels[inside] = others[int(np.argmin(far))]


def joined(labels, luv, range_radius):
    """Join neighbouring regions of near mean colours, the nearest first."""
    labels = labels.copy()
    while True:
        across = np.stack([labels[:, :-1].ravel(), labels[:, 1:].ravel()], axis=1)
        down = np.stack([labels[:-1].ravel(), labels[1:].ravel()], axis=1)
        pairs = np.unique(np.sort(np.concatenate([across, down]), axis=1), axis=0)
        pairs = pairs[pairs[:, 0] != pairs[:, 1]]
        means = {name: luv[labels == name].mean(axis=0) for name in np.unique(labels)}
        apart = [np.linalg.norm(means[a] - means[b]) for a, b in pairs]
        if not apart or min(apart) > range_radius:
            return labels
        one, other = pairs[int(np.argmin(apart))]
        labels[labels == other] = one


def edges(labels):
    found = np.zeros(labels.shape, bool)
    found[:, :-1] |= labels[:, 1:] != labels[:, :-1]
    found[:-1] |= labels[1:] != labels[:-1]
    return found


def near(found, wanted):
    """The share of `found` that has a pixel of `wanted` within reach."""
    places, others = np.argwhere(found), np.argwhere(wanted)
    if len(places) == 0 or len(others) == 0:
        return 0.0
    squared = ((places[:, None] - others[None]) ** 2).sum(axis=2).min(axis=1)
    return float((squared <= REACH * REACH).mean())


def pictures():
    cases = []
    for seed, (name, (noise, shapes)) in enumerate(PICTURES.items(), 1):
        picture, truth = made(noise, shapes, seed)
        true = edges(truth)
        opencv = []
        for opencv_range in OPENCV_RANGES:
            flat = cv2.pyrMeanShiftFiltering(
                np.ascontiguousarray(picture[:, :, ::-1]), SETTINGS["spatial_radius_px"],
                opencv_range, maxLevel=OPENCV_LEVELS)
            luv = luv_of(flat[:, :, ::-1].astype(float))
            range_radius = SETTINGS["range_radius"]
            labels = linked(luv, LINK * range_radius)
            labels = pruned(labels, luv, SETTINGS["least_region_px"])
            own = edges(joined(labels, luv, range_radius))
            regions = len(np.unique(joined(labels, luv, range_radius)))
            opencv.append({"range": opencv_range, "regions": regions,
                           "recall": near(true, own), "precision": near(own, true)})
        cases.append({"name": name, "seed": seed, "noise": noise, "shapes": shapes,
                      "fnv": fnv(picture), "opencv": opencv})
    return cases


def modes():
    """Mean-shift modes of pixels of tiny pictures in which only one radius matters."""
    random = Noise(7)
    rows = []
    # The window holds every pixel, so only the range radius matters.
    for spread, radius in ((0.10, 12.0), (0.18, 20.0)):
        picture = np.zeros((6, 8, 3), np.uint8)
        for y in range(6):
            for x in range(8):
                base = [0.3, 0.4, 0.5] if (x + y) % 2 else [0.6, 0.5, 0.35]
                for i in range(3):
                    value = base[i] + spread * (2.0 * random.next() - 1.0)
                    picture[y, x, i] = int(value * 255.0 + 0.5)
        points = luv_of(picture.astype(float)).reshape(-1, 3)
        rows.append(mode_case(picture, points, np.arange(48), 64.0, radius))
    # Pixels of one colour among pixels far from it, so only the spatial radius matters.
    picture = np.zeros((12, 16, 3), np.uint8)
    for y in range(12):
        for x in range(16):
            if random.next() < 0.3:
                picture[y, x] = (200, 120, 60)
    members = np.flatnonzero(picture[:, :, 0].reshape(-1))
    points = np.stack([members % 16, members // 16], axis=1).astype(float)
    rows.append(mode_case(picture, points, members, 3.0, 5.0))
    return rows


def mode_case(picture, points, members, spatial, range_radius):
    bandwidth = range_radius if points.shape[1] == 3 else spatial
    found = [MeanShift(bandwidth=bandwidth, seeds=[p]).fit(points).cluster_centers_[0]
             for p in points]
    return {
        "width": picture.shape[1], "bytes": picture.reshape(-1).tolist(),
        "spatial_radius_px": spatial, "range_radius": range_radius,
        "pixels": members.tolist(), "modes": [[float(v) for v in mode] for mode in found],
    }


def segmentation():
    if not cv2.__version__.startswith(CHECKED[1]):
        raise ValueError(f"{CHECKED[0]} {CHECKED[1]} is wanted, found {cv2.__version__}")
    return {
        "method": "pictures: made as segmentation.py says (shapes one over the other, soft"
        " edges, noise), fnv is FNV-1a of the RGB bytes. OpenCV's pyrMeanShiftFiltering of"
        " the bytes, spatial radius as in settings, several range radii, maxLevel 1; then as"
        " impasto does: neighbours in rows and columns within half the range radius in"
        " CIELUV are one region, regions below the least size join the neighbour nearest in"
        " colour, the smallest first, then neighbours within the range radius become one,"
        " the nearest first. A boundary pixel differs from its right or lower neighbour; recall is the"
        " share of true ones with a found one within 2 px, precision the reverse. modes:"
        " scikit-learn's MeanShift with each point as its only seed, in CIELUV where 3"
        " numbers, in pixels where 2.",
        "package": f"opencv-python-headless {cv2.__version__}, scikit-learn"
        f" {sklearn.__version__}, colour-science {colour.__version__}",
        "tolerance": 5e-4,
        "settings": SETTINGS,
        "cases": {"modes": modes(), "pictures": pictures()},
    }


if __name__ == "__main__":
    for case in pictures():
        print(case["name"], case["opencv"])
