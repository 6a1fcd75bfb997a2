"""Measure real paint, calibrate it, and mix it: pigments of two-constant Kubelka-Munk theory.

Units: wavelengths in nm, reflectance as fractions from 0 to 1, XYZ with Y = 100 for the white. Amounts of
pigments are parts, of which only the ratios count, unless a library holds absolute amounts.
"""

from impasto import color
from impasto._native import __version__
from impasto.agreement import Comparison, compare
from impasto.books import ColorBook
from impasto.cube import Cube
from impasto.errors import Error, FileError, FindingWarning, FitError, ReadingError, RecipeError
from impasto.film import Film, film
from impasto.fitting import Fit, Surface, Validation, fit, validate
from impasto.identifying import Identified, Spot, identify
from impasto.library import Library, Pigment
from impasto.light import Light
from impasto.maps import PigmentMaps, Survey, pigment_map, survey
from impasto.matching import Match, Recipe
from impasto.planning import Plan, plan
from impasto.quadrature import Quadrature
from impasto.readings import Readings, read
from impasto.reporting import Report, report
from impasto.residuals import Residuals
from impasto.spectrum import Spectrum

__all__ = [
    "ColorBook",
    "Comparison",
    "Cube",
    "Error",
    "FileError",
    "Film",
    "FindingWarning",
    "Fit",
    "FitError",
    "Identified",
    "Library",
    "Light",
    "Match",
    "Pigment",
    "PigmentMaps",
    "Plan",
    "Quadrature",
    "ReadingError",
    "Readings",
    "Recipe",
    "RecipeError",
    "Report",
    "Residuals",
    "Spectrum",
    "Spot",
    "Surface",
    "Survey",
    "Validation",
    "__version__",
    "color",
    "compare",
    "film",
    "fit",
    "identify",
    "pigment_map",
    "plan",
    "read",
    "report",
    "survey",
    "validate",
]
