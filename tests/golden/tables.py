"""Write the data tables of spectra/data from the data sets of colour-science.

    python tests/golden/tables.py

The values are those of the CIE, copied from colour-science. Do not edit the
tables by hand: change this file and run it again.
"""

import hashlib
import pathlib
import sys

import colour
from colour.quality.cfi2017 import load_TCS_CIE2017

VERSION = "0.4.7"
COMMAND = "python tests/golden/tables.py"
ROOT = pathlib.Path(__file__).resolve().parents[2]

OBSERVERS = {
    "cie-1931-2": "CIE 1931 2 Degree Standard Observer",
    "cie-1964-10": "CIE 1964 10 Degree Standard Observer",
    "cie-2015-2": "CIE 2015 2 Degree Standard Observer",
    "cie-2015-10": "CIE 2015 10 Degree Standard Observer",
}

ILLUMINANTS = (
    ["A", "B", "C", "D50", "D55", "D60", "D65", "D75", "E"]
    + [f"FL{i}" for i in range(1, 13)]
    + [f"FL3.{i}" for i in range(1, 16)]
    + [f"HP{i}" for i in range(1, 6)]
    + [f"LED-B{i}" for i in range(1, 6)]
    + ["LED-BH1", "LED-RGB1", "LED-V1", "LED-V2", "ID50", "ID65"]
)

FIRST_NM, LAST_NM, STEP_NM = 300, 830, 5

# The daylight functions are part of colour-science but not of its top module.
DAYLIGHT = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES


def check_version():
    if colour.__version__ != VERSION:
        sys.exit(f"needs colour-science {VERSION}, found {colour.__version__}")


def whole_nm(sd):
    """Wavelengths of a table as integers, refusing any that are not."""
    nm = [int(w) for w in sd.wavelengths]
    if nm != list(sd.wavelengths):
        raise ValueError(f"{sd.name}: wavelengths are not whole nanometres")
    return nm


def csv(header, rows):
    """Rows of (nm, values); None is an empty cell; shortest digits otherwise."""
    lines = [",".join(header)]
    for nm, values in rows:
        cells = ["" if v is None else repr(float(v)) for v in values]
        lines.append(",".join([str(nm), *cells]))
    return "\n".join(lines) + "\n"


def observer(name):
    cmfs = colour.MSDS_CMFS[name]
    nm = whole_nm(cmfs)
    if nm != list(range(nm[0], 831)):
        raise ValueError(f"{name}: expected 1 nm rows up to 830 nm")
    return csv(["nm", "x", "y", "z"], zip(nm, cmfs.values))


def illuminants():
    tables = []
    for name in ILLUMINANTS:
        sd = colour.SDS_ILLUMINANTS[name]
        table = dict(zip(whole_nm(sd), sd.values))
        # A 5 nm row that falls between source rows would be dropped unseen.
        if any((nm - FIRST_NM) % STEP_NM for nm in table):
            raise ValueError(f"{name}: not on the {STEP_NM} nm grid")
        if min(table) < FIRST_NM or max(table) > LAST_NM:
            raise ValueError(f"{name}: reaches outside the table")
        if len(table) != (max(table) - min(table)) // STEP_NM + 1:
            raise ValueError(f"{name}: has a hole")
        tables.append(table)
    rows = (
        (nm, [t.get(nm) for t in tables])
        for nm in range(FIRST_NM, LAST_NM + 1, STEP_NM)
    )
    return csv(["nm", *ILLUMINANTS], rows)


def daylight():
    s0, s1, s2 = DAYLIGHT["S0"], DAYLIGHT["S1"], DAYLIGHT["S2"]
    nm = whole_nm(s0)
    if whole_nm(s1) != nm or whole_nm(s2) != nm:
        raise ValueError("S0, S1 and S2 have different rows")
    return csv(
        ["nm", "S0", "S1", "S2"], zip(nm, zip(s0.values, s1.values, s2.values))
    )


def rendering_samples():
    """The 14 test colour samples of CIE 13.3."""
    sds = list(colour.quality.datasets.SDS_TCS["CIE 1995"].values())
    nm = whole_nm(sds[0])
    if len(sds) != 14 or any(whole_nm(sd) != nm for sd in sds):
        raise ValueError("CIE 13.3 has 14 samples on the same rows")
    names = [f"TCS{i:02}" for i in range(1, 15)]
    return csv(["nm", *names], zip(nm, zip(*(sd.values for sd in sds))))


def fidelity_samples():
    """The 99 colour evaluation samples of CIE 224 and TM-30."""
    sds = load_TCS_CIE2017(colour.SpectralShape(380, 780, 5))
    nm = whole_nm(sds)
    if sds.values.shape != (81, 99):
        raise ValueError("CIE 224 has 99 samples at 81 wavelengths")
    names = [f"CES{i:02}" for i in range(1, 100)]
    return csv(["nm", *names], zip(nm, sds.values))


def spans():
    """Span of wavelengths of the illuminants, grouped by span."""
    groups = {}
    for name in ILLUMINANTS:
        nm = whole_nm(colour.SDS_ILLUMINANTS[name])
        groups.setdefault((nm[0], nm[-1]), []).append(name)
    return "\n".join(
        f"  - {first} to {last} nm: {', '.join(names)}"
        for (first, last), names in sorted(groups.items())
    )


SOURCES = """\
# Sources of the tables

Written by `{command}`; do not edit the tables or this page by hand.
The values are those of the CIE (International Commission on Illumination),
copied from the data sets of colour-science {version}
(BSD-3-Clause, Copyright 2013 Colour Developers; its licence is at the end).

Rounding: none. Each value is the double of colour-science, written with the
fewest digits that read back as the same double. An empty cell means that the
source table has no value there; it does not mean zero.

## observers

Colour matching functions, header `nm,x,y,z`, one row per nm.

- `observers/cie-1931-2.csv`: CIE 1931 standard colorimetric observer (2
  degrees), 360 to 830 nm. CIE 15:2018; ISO/CIE 11664-1.
- `observers/cie-1964-10.csv`: CIE 1964 standard colorimetric observer (10
  degrees), 360 to 830 nm. CIE 15:2018; ISO/CIE 11664-1.
- `observers/cie-2015-2.csv`: cone-fundamental-based functions, 2 degrees, 390
  to 830 nm. CIE 170-2:2015, with the digits published by the Colour and Vision
  Research Laboratory (CVRL).
- `observers/cie-2015-10.csv`: cone-fundamental-based functions, 10 degrees;
  range and source as for 2 degrees.

## illuminants.csv

Relative spectral power, one column per illuminant, 300 to 830 nm in steps of
5 nm, in the scale of the source (most are 100 at 560 nm; the lamps are not).

- A, D50, D55, D65, D75, and B and C (which the CIE no longer recommends): CIE
  15:2018 and CIE 15:2004 tables.
- D60: computed by colour-science from the daylight functions; the CIE prints
  no such table.
- E: equal energy, 100 everywhere.
- FL1 to FL12, FL3.1 to FL3.15 (fluorescent lamps) and HP1 to HP5 (high
  pressure discharge lamps): CIE 15:2004 and CIE 15:2018 tables.
- LED-B1 to LED-B5, LED-BH1, LED-RGB1, LED-V1, LED-V2 (typical LED lamps): CIE
  15:2018.
- ID50 and ID65 (indoor daylight): CIE 15:2018, after CIE 184:2009.

The CIE tabulates some of these over a wider range than colour-science does (D65
to 830 nm, for example). The columns here cover:

{spans}

## daylight-components.csv

The functions S0, S1, S2 of which the phases of daylight are composed, {day_first} to
{day_last} nm in steps of {day_step} nm, as in colour-science. CIE 15:2018. The CIE
tabulates them in steps of 10 nm; the rows between are interpolated linearly, and
some of them show rounding to two decimals.

## rendering

Reflectances of the samples by which the colour rendering of lamps is judged, one column per
sample, in steps of 5 nm.

- `rendering/cie-13.3-samples.csv`: the 14 test colour samples TCS01 to TCS14, 360 to 830 nm. CIE
  13.3-1995, from the NIST CQS simulation 7.4 (Ohno and Davis 2008).
- `rendering/cie-224-samples.csv`: the 99 colour evaluation samples CES01 to CES99, 380 to 780 nm.
  CIE 224:2017 and ANSI/IES TM-30-18, from the 5 nm data set of CIE TC 1-90.

## SHA-256

{hashes}

The tables contain only the values of the source. How to interpolate between the
rows is left to the program that reads them (CIE 15:2018 recommends linear
interpolation for illuminants, CIE 167:2005 Sprague's for regular reflectance).

## Licence of colour-science

{licence}"""

# BSD-3-Clause requires this text with every copy.
LICENCE = """\
> Copyright 2013 Colour Developers
>
> Redistribution and use in source and binary forms, with or without
> modification, are permitted provided that the following conditions are met:
>
> 1. Redistributions of source code must retain the above copyright notice,
>    this list of conditions and the following disclaimer.
>
> 2. Redistributions in binary form must reproduce the above copyright notice,
>    this list of conditions and the following disclaimer in the documentation
>    and/or other materials provided with the distribution.
>
> 3. Neither the name of the copyright holder nor the names of its contributors
>    may be used to endorse or promote products derived from this software
>    without specific prior written permission.
>
> THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS"
> AND ANY EXPRESS OR IMPLIED WARRANTIES, INCLUDING, BUT NOT LIMITED TO, THE
> IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE
> ARE DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDER OR CONTRIBUTORS BE
> LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL, SPECIAL, EXEMPLARY, OR
> CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF
> SUBSTITUTE GOODS OR SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS
> INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY, WHETHER IN
> CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE)
> ARISING IN ANY WAY OUT OF THE USE OF THIS SOFTWARE, EVEN IF ADVISED OF THE
> POSSIBILITY OF SUCH DAMAGE.
"""


def files():
    """Text of every file under spectra/data, by path from the repository root."""
    check_version()
    base = "spectra/data"
    out = {f"{base}/observers/{key}.csv": observer(n) for key, n in OBSERVERS.items()}
    out[f"{base}/illuminants.csv"] = illuminants()
    out[f"{base}/daylight-components.csv"] = daylight()
    out[f"{base}/rendering/cie-13.3-samples.csv"] = rendering_samples()
    out[f"{base}/rendering/cie-224-samples.csv"] = fidelity_samples()
    hashes = "\n".join(
        f"- `{path.removeprefix(base + '/')}`:\n"
        f"  `{hashlib.sha256(text.encode('ascii')).hexdigest()}`"
        for path, text in sorted(out.items())
    )
    nm = whole_nm(DAYLIGHT["S0"])
    out[f"{base}/SOURCES.md"] = SOURCES.format(
        command=COMMAND,
        version=VERSION,
        spans=spans(),
        hashes=hashes,
        licence=LICENCE,
        day_first=nm[0],
        day_last=nm[-1],
        day_step=nm[1] - nm[0],
    )
    return out


def write(root, texts):
    for path, text in texts.items():
        target = pathlib.Path(root) / path
        target.parent.mkdir(parents=True, exist_ok=True)
        # Written as bytes, so that no platform changes the line ends.
        target.write_bytes(text.encode("ascii"))


if __name__ == "__main__":
    write(ROOT, files())
