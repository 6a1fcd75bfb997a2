"""Checks scans and maps against the programs that people use: `check.py PROGRAM`.

PROGRAM is the built example `light_and_dark`. Scans are written by Spectral Python, xarray, zarr and
tifffile, mapped by PROGRAM, and the maps are opened by xarray, without a warning, and compared with
numpy. Needs the packages of requirements.txt.
"""

import pathlib
import subprocess
import sys
import tempfile
import warnings

import numpy as np
import spectral
import spectral.io.envi
import tifffile
import xarray as xr
import zarr

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
LINES, SAMPLES = 300, 270
NM = np.array([410.0, 500.0, 555.5, 620.0, 701.0])


def reflectances():
    """A cube of fractions with edges, so that a shifted row or column is seen."""
    rng = np.random.default_rng(1)
    cube = rng.uniform(0.02, 0.98, (LINES, SAMPLES, NM.size))
    cube[100:140, 30:200] *= 0.1
    return cube


def run(scan, out, *white):
    subprocess.run([PROGRAM, scan, out, *map(str, white)], check=True)


def check(out, cube, ignored=None, within=0.0):
    """Opens maps and compares them with the mean reflectance of `cube`."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ds = xr.open_zarr(out, chunks=None).load()
    assert set(ds.data_vars) == {"share", "share_sd", "presence", "chi2", "rms", "second", "mask"}, ds
    assert ds.share.dims == ("y", "x", "pigment") and ds.chi2.dims == ("y", "x")
    assert ds.share.dtype == np.float16 and ds.mask.dtype == np.uint8 and ds.second.dtype == np.uint64
    assert list(ds.pigment.values) == ["light", "dark"], ds.pigment
    assert (ds.y.values == np.arange(cube.shape[0])).all() and (ds.x.values == np.arange(cube.shape[1])).all()
    assert ds.attrs["pigments"] == ["light", "dark"] and ds.attrs["impasto_version"], ds.attrs
    light = cube.mean(axis=2)
    known = np.ones(light.shape, bool) if ignored is None else ~ignored
    assert (ds.mask.values[known] == 0).all() and (ds.mask.values[~known] == 1).all()
    far = np.abs(ds.chi2.values - light)[known].max()
    assert far <= within + 1e-6, far
    far = np.abs(ds.share.sel(pigment="light").values.astype(float) - light)[known].max()
    assert far <= within + 5e-4, far
    far = np.abs(ds.presence.sel(pigment="dark").values - (1 - light))[known].max()
    assert far <= within + 0.0021, far
    for name in ["share", "share_sd", "presence"]:
        assert np.isnan(ds[name].values[~known].astype(float)).all(), name
    assert np.isnan(ds.chi2.values[~known]).all()
    assert (ds.second.values[known] == 1).all() and (ds.second.values[~known] == 0).all()
    assert ds.mask.attrs["flag_meanings"].split()[0] == "mapped"


def envi(folder, cube):
    """Scans of Spectral Python, in every interleave and several types."""
    for interleave in ["bsq", "bil", "bip"]:
        for dtype, factor in [(np.float32, 1), (np.float64, 1), (np.uint16, 50000), (np.int16, 10000)]:
            for order in ["little", "big"]:
                name = f"{interleave}-{np.dtype(dtype).name}-{order}"
                path = folder / f"{name}.hdr"
                meta = {"wavelength": list(NM), "wavelength units": "Nanometers"}
                if factor > 1:
                    meta["reflectance scale factor"] = factor
                data = cube * factor if factor == 1 else np.rint(cube * factor)
                spectral.io.envi.save_image(
                    str(path), data.astype(dtype), interleave=interleave, byteorder=order, metadata=meta
                )
                run(path, folder / f"{name}.zarr")
                check(folder / f"{name}.zarr", cube, within=0.5 / factor if factor > 1 else 0)


def zarrs(folder, cube):
    """Cubes of xarray: its own packing, shards, scaled integers with a fill value."""
    coords = {"wavelength": ("wavelength", NM, {"units": "nm"})}
    array = xr.DataArray(cube.astype("f4"), dims=("y", "x", "wavelength"), coords=coords, name="reflectance")
    cases = {
        "own": {},
        "chunks": {"chunks": (64, 100, 2)},
        "shards": {"chunks": (32, 30, 5), "shards": (128, 90, 5)},
        "gzip": {"chunks": (100, 100, 5), "compressors": [zarr.codecs.GzipCodec(level=5)]},
        "zstd": {"chunks": (90, 90, 5), "compressors": [zarr.codecs.ZstdCodec(level=9, checksum=True)]},
        "order": {"chunks": (50, 40, 3), "filters": [zarr.codecs.TransposeCodec(order=(2, 1, 0))]},
    }
    for name, encoding in cases.items():
        path = folder / f"{name}.zarr"
        array.to_zarr(path, zarr_format=3, encoding={"reflectance": encoding})
        run(path, folder / f"{name}-maps.zarr")
        check(folder / f"{name}-maps.zarr", cube)
    turned = array.transpose("wavelength", "y", "x")
    turned.to_zarr(folder / "turned.zarr", zarr_format=3)
    run(folder / "turned.zarr", folder / "turned-maps.zarr")
    check(folder / "turned-maps.zarr", cube)
    ignored = np.zeros(cube.shape[:2], bool)
    ignored[5:9, 11:20] = True
    scaled = array.where(xr.DataArray(~ignored, dims=("y", "x")))
    encoding = {"dtype": "i2", "scale_factor": 1e-4, "_FillValue": -1}
    scaled.to_zarr(folder / "scaled.zarr", zarr_format=3, encoding={"reflectance": encoding})
    run(folder / "scaled.zarr", folder / "scaled-maps.zarr")
    check(folder / "scaled-maps.zarr", cube, ignored, within=5e-5)
    holes = scaled.astype("f4")
    holes.to_zarr(folder / "holes.zarr", zarr_format=3)
    run(folder / "holes.zarr", folder / "holes-maps.zarr")
    check(folder / "holes-maps.zarr", cube, ignored)


def pages(folder, cube):
    """Pages of TIFF files in tiles and strips."""
    counts = np.rint(cube * 50000).astype("u2")
    (folder / "wavelengths.txt").write_text("\n".join(map(str, NM)))
    for name, settings in {
        "strips": {"rowsperstrip": 7},
        "tiles": {"tile": (64, 48)},
        "packed": {"tile": (64, 48), "compression": "zlib"},
        "big": {"bigtiff": True, "byteorder": ">"},
    }.items():
        path = folder / f"{name}.tif"
        tifffile.imwrite(path, np.moveaxis(counts, 2, 0), photometric="minisblack", **settings)
        run(path, folder / f"{name}.zarr", 50000)
        check(folder / f"{name}.zarr", cube, within=1e-5)


cube = reflectances()
for part in [envi, zarrs, pages]:
    with tempfile.TemporaryDirectory() as folder:
        part(pathlib.Path(folder), cube)
    print(f"{part.__name__}: equal")
