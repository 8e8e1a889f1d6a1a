#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens the files of result_writer with h5py and compares numbers, units, XDMF references and the
shapes that VTK expects. Usage: check_results.py RESULT_WRITER"""
import hashlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np

PARTICLES, FIRST_BODY, FRAMES = 300, 100, 6
FIELDS = {  # name: (components written, components stored, unit)
    "position": (3, 3, "m"),
    "pressure": (1, 1, "Pa"),
    "velocity": (2, 3, "m/s"),
    "strain": (6, 6, "1"),
    "stress": (9, 9, "Pa"),
}


def expected(k, written, stored):
    """The numbers of result_writer; vectors of two components get z = 0."""
    particle, component = np.arange(PARTICLES)[:, None], np.arange(written)[None, :]
    values = np.zeros((PARTICLES, stored))
    values[:, :written] = k + particle / 512 + component / 8
    return values[:, 0] if stored == 1 else values


def equal(a, b, what):
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape, f"{what}: shape {a.shape}, expected {b.shape}"
    assert np.array_equal(a, b), f"{what}: values differ"


def check_frames(file, dtype):
    assert sorted(file["steps"], key=int) == [str(k) for k in range(FRAMES)]
    for k in range(FRAMES):
        frame = file[f"steps/{k}"]
        assert frame.attrs["step"] == 10 * k and frame.attrs["time"] == 0.5 * k
        assert set(frame) == set(FIELDS) | {"state"}
        for name, (written, stored, unit) in FIELDS.items():
            equal(frame[name], expected(k, written, stored), f"frame {k} {name}")
            assert frame[name].dtype == dtype and frame[name].attrs["units"].decode() == unit
        equal(frame["state/velocity"], expected(k, 3, 3).ravel(), "state")
        assert frame["state/velocity"].dtype == np.float64


def check_reference_and_meta(file):
    X = expected(0, 3, 3)
    equal(file["reference/drop/X"], X[:FIRST_BODY], "X of drop")
    equal(file["reference/wall/X"], X[FIRST_BODY:], "X of wall")
    assert file["reference/wall"].attrs["first_particle"] == FIRST_BODY
    text = file["meta/input"][()]
    assert text.decode("utf-8") == "dimension = 3\n# γ = 0.0728 N/m\n"
    meta = {name: value for name, value in file["meta"].attrs.items()}
    assert meta["input_sha256"].decode() == hashlib.sha256(text).hexdigest()
    for name in ("version", "git_hash", "git_dirty", "compiler", "threads", "command_line",
                 "started_utc", "Eigen", "HDF5"):
        assert name in meta, f"/meta lacks {name}"


def check_units(file):
    def visit(name, node):
        if isinstance(node, h5py.Dataset):
            assert "units" in node.attrs, f"{name} has no units"
    file.visititems(visit)


def hexahedra():
    """Corners of the cells that result_writer writes."""
    first = [*range(FIRST_BODY - 7), *range(FIRST_BODY, PARTICLES - 7)]
    return np.array(first)[:, None] + np.arange(8)


def check_vtkhdf(file):
    """VTKHDF 2.0: UnstructuredGrid, temporal."""
    view, n = file["VTKHDF"], PARTICLES
    assert view.attrs["Type"] == b"UnstructuredGrid" and list(view.attrs["Version"]) == [2, 0]
    assert h5py.check_string_dtype(view.attrs.get_id("Type").dtype).encoding == "ascii"
    steps = view["Steps"]
    assert steps.attrs["NSteps"] == FRAMES
    k = np.arange(FRAMES)
    equal(steps["Values"], 0.5 * k, "times")
    equal(steps["PartOffsets"], 0 * k, "PartOffsets")
    equal(steps["NumberOfParts"], np.ones(FRAMES), "NumberOfParts")
    equal(steps["PointOffsets"], n * k, "PointOffsets")
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        equal(steps[name], np.zeros(FRAMES), name)
    cells = hexahedra()
    equal(view["NumberOfPoints"], [n], "NumberOfPoints")
    equal(view["NumberOfCells"], [len(cells)], "NumberOfCells")
    equal(view["NumberOfConnectivityIds"], [cells.size], "NumberOfConnectivityIds")
    equal(view["Connectivity"], cells.ravel(), "Connectivity")
    equal(view["Offsets"], 8 * np.arange(len(cells) + 1), "Offsets")
    equal(view["Types"], np.full(len(cells), 12), "Types")
    assert view["Types"].dtype == np.uint8
    assert set(view["PointData"]) == set(FIELDS) - {"position"} | {"body", "surface"}
    assert set(steps["PointDataOffsets"]) == set(view["PointData"])
    particle = np.arange(n)
    equal(view["PointData/body"], particle >= FIRST_BODY, "body")
    equal(view["PointData/surface"], particle - FIRST_BODY * (particle >= FIRST_BODY) < 4, "surface")
    for name, (written, stored, unit) in FIELDS.items():
        data = view["Points"] if name == "position" else view["PointData"][name]
        equal(data, np.concatenate([expected(i, written, stored) for i in k]), name)
        assert data.is_virtual and data.attrs["units"].decode() == unit
        if name != "position":
            equal(steps["PointDataOffsets"][name], n * k, f"offsets of {name}")


def check_xdmf(directory, dtype):
    text = (directory / "run.xdmf").read_text()
    assert str(directory) not in text and "HyperSlab" not in text
    grids = ElementTree.fromstring(text).findall("./Domain/Grid/Grid")
    assert len(grids) == FRAMES
    types = {1: "Scalar", 3: "Vector", 6: "Matrix", 9: "Tensor"}
    for k, grid in enumerate(grids):
        assert float(grid.find("Time").attrib["Value"]) == 0.5 * k
        topology = grid.find("Topology").attrib
        assert topology["TopologyType"] == "Hexahedron"
        assert int(topology["NumberOfElements"]) == len(hexahedra())
        for item in grid.iter("DataItem"):
            name, path = item.text.strip().split(":")
            assert name == "run.h5", f"{name} is not a name beside the sidecar"
            with h5py.File(directory / name) as file:
                data = file[path]
                assert tuple(map(int, item.attrib["Dimensions"].split())) == data.shape
                assert int(item.attrib["Precision"]) == data.dtype.itemsize
                assert (item.attrib["NumberType"] == "Int") == (data.dtype.kind == "i")
        equal_name = {a.attrib["Name"]: a for a in grid.findall("Attribute")}
        assert set(equal_name) == set(FIELDS) - {"position"} | {"body", "surface"}
        for name, attribute in equal_name.items():
            components = FIELDS[name][1] if name in FIELDS else 1
            assert attribute.attrib["AttributeType"] == types[components]
            if name in FIELDS:
                assert attribute.find("DataItem").text == f"run.h5:/steps/{k}/{name}"


def check_checkpoints(directory):
    serials = {}
    for letter in "ab":
        path = directory / f"checkpoint-{letter}.h5"
        if path.exists():
            head = path.read_bytes()[:512].decode()
            serials[letter] = int(re.search(r"serial (\d+)", head).group(1))
            with h5py.File(path) as file:
                check_units(file)
                assert file.attrs["step"] == 30
                equal(file["state/velocity"], expected(3, 3, 3).ravel(), "checkpoint")
    assert serials == {"a": 1}


def check_history(directory):
    lines = (directory / "history.csv").read_text().splitlines()
    assert lines[:2] == ["# time,kinetic_energy", "# s,J"]
    rows = np.loadtxt(directory / "history.csv", delimiter=",")
    equal(rows, [[0.5 * k, 1 / 3] for k in range(FRAMES)], "history")


def main():
    writer = sys.argv[1]
    for precision, compression in (("float64", 0), ("float32", 6), ("float64", 1)):
        with tempfile.TemporaryDirectory() as temporary:
            directory = Path(temporary) / "results"
            subprocess.run([writer, directory, str(FRAMES), precision, str(compression)],
                           check=True, stdout=subprocess.DEVNULL)
            with h5py.File(directory / "run.h5") as file:
                check_frames(file, np.dtype(precision))
                assert file["steps/0/position"].compression == ("gzip" if compression else None)
                check_reference_and_meta(file)
                check_units(file)
                check_vtkhdf(file)
            check_xdmf(directory, precision)
            check_checkpoints(directory)
            check_history(directory)
            names = {path.name for path in directory.iterdir()}
            assert names == {"run.h5", "run.vtkhdf", "run.xdmf", "history.csv", "checkpoint-a.h5"}, names
            with h5py.File(directory / "run.vtkhdf") as file:
                equal(file["VTKHDF/Steps/Values"], 0.5 * np.arange(FRAMES), "times of run.vtkhdf")
    print("results are as written")


if __name__ == "__main__":
    main()
