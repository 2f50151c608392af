#!/usr/bin/env python3
"""Opens the example of example_test.cc without lanelight: h5py_test.py STATE DOCS/STATE.MD

Every value is compared with what its place says, in NumPy, and the program of the
documentation is run as it stands there. Ends with 77 where h5py is missing.
"""

import json
import re
import sys

try:
    import h5py
    import numpy
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

WINDOW = (-3, 2, 197, 142)
TILES = [(100, 2, 197, 100), (-3, 2, 100, 100), (-3, 100, 60, 142)]
DATASETS = {
    "identity": None, "report": None, "window": "<i4", "tiles": "<i4",
    "pixels/sums": "<f8", "pixels/bits": "<u8", "pixels/samples": "<i4",
    "pixels/gray": "<f4", "tables/table": "<u4",
}


def splitmix(n):
    n = (n + numpy.uint64(1)) * numpy.uint64(0x9E3779B97F4A7C15)
    n = (n ^ (n >> numpy.uint64(30))) * numpy.uint64(0xBF58476D1CE4E5B9)
    n = (n ^ (n >> numpy.uint64(27))) * numpy.uint64(0x94D049BB133111EB)
    return n ^ (n >> numpy.uint64(31))


def pixels():
    """x, y and index in the window of the pixels, in the order of the file."""
    x0, y0, x1, _ = WINDOW
    places = [(x, y) for tx0, ty0, tx1, ty1 in TILES
              for y in range(ty0, ty1) for x in range(tx0, tx1)]
    x, y = numpy.array(places).T
    return x, y, (y - y0) * (x1 - x0) + x - x0


def check_film(state):
    x, y, index = pixels()
    sums = x[:, None, None] + 1000 * y[:, None, None] + (
        numpy.arange(12).reshape(4, 3) / 16)
    expected = {"sums": sums, "bits": splitmix(index.astype("u8")), "samples": -index,
                "gray": x * y}
    assert set(state["pixels"]) == set(expected), list(state["pixels"])
    for name, values in expected.items():
        found = state["pixels"][name][:]
        assert found.shape == values.shape, (name, found.shape, values.shape)
        assert (found == values).all(), name
    assert (state["tables/table"][:] == 3 * numpy.arange(70001)).all()


def check_rest(state):
    assert state.attrs["schema"] == 1
    assert state.userblock_size == 512
    assert json.loads(state["identity"][()]) == {"scene": "K\u00f6ln.pbrt"}
    assert json.loads(state["report"][()]) == {"samples": 12}
    assert [tuple(t) for t in state["tiles"]] == TILES
    assert tuple(state["window"][0]) == WINDOW
    for name, kind in DATASETS.items():
        assert len(state[name].attrs["meaning"]) > 5, name
        assert kind is None or state[name].dtype == numpy.dtype(kind), name
    sums = state["pixels/sums"]
    assert sums.chunks[1:] == (1, 3), sums.chunks
    assert sums.shuffle and sums.compression == "gzip"
    assert sums.id.get_num_chunks() > 4


def check_documentation(path, page):
    """Runs the only Python program of the page on this file."""
    with open(page, encoding="utf-8") as file:
        programs = re.findall(r"```python\n(.*?)```", file.read(), re.S)
    assert len(programs) == 1, len(programs)
    program = programs[0]
    assert '"render.state"' in program and "pixels/samples" in program
    names = {}
    exec(program.replace('"render.state"', repr(path)), names)
    x, y, index = pixels()
    expected = numpy.full((140, 200), numpy.nan)
    expected[y - 2, x + 3] = -index
    numpy.testing.assert_array_equal(names["image"], expected)
    assert numpy.isnan(expected).sum() == 200 * 140 - index.size > 0


def main():
    path, page = sys.argv[1:3]
    with h5py.File(path, "r") as state:
        check_rest(state)
        check_film(state)
    check_documentation(path, page)
    print("the state, its", len(DATASETS), "datasets and the documentation's program: ok")


main()
