#!/usr/bin/python3
"""What other programs find in a run folder: xarray, h5py and netCDF4 open history.nc, openpyxl the workbook; all see the numbers of
the CSV export.

    archive_readers.py PROGRAM CASE

Ends with 77 and a sentence when one of the readers is not installed.
"""

import csv
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

try:
    import h5py
    import netCDF4
    import numpy
    import openpyxl
    import xarray
except ImportError as missing:
    print(f"skipped: {missing}; setup installs python3-xarray, python3-h5py, python3-netcdf4 and python3-openpyxl")
    sys.exit(77)


def run(*arguments, expect=(0,)):
    done = subprocess.run([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert done.returncode in expect, f"{arguments}: exit code {done.returncode}\n{done.stderr}"
    return done.stdout


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    header = rows[0]
    values = numpy.array([[float(cell) if cell else math.nan for cell in row] for row in rows[1:]])
    return header, values


def same(a, b):
    return numpy.array_equal(numpy.asarray(a), numpy.asarray(b), equal_nan=True)


def check_conventions(path):
    """CF-1.8: conventions, a title, a long name for every variable, units for every number that can have one, one time axis."""
    with netCDF4.Dataset(path) as data:
        assert data.Conventions == "CF-1.8"
        for name in ("title", "source", "history"):
            assert getattr(data, name), name
        channels = [v for v in data.variables.values() if "channel" in v.ncattrs()]
        assert len(channels) == len(data.dimensions["channel"])
        for variable in data.variables.values():
            assert variable.long_name, variable.name
            if "units" in variable.ncattrs():
                assert variable.units
        for variable in channels:
            assert variable.dimensions == ("time",), variable.name
            assert variable.units
        assert data["time"].dimensions == ("time",) and data["time"].units == "s"
        axis = data["time"][:]
        assert (numpy.diff(axis) > 0).all()


def check_values(folder, header, values):
    path = folder / "history.nc"
    raw = xarray.open_dataset(path, decode_times=False)
    by_channel = {v.attrs["channel"]: v for v in raw.data_vars.values() if "channel" in v.attrs}
    assert same(raw["time"], values[:, 0])
    with h5py.File(path, "r") as file:
        assert same(file["time"][()], values[:, 0])
        for column, title in enumerate(header[1:], 1):
            name, unit = title[:-1].rsplit(" [", 1)
            variable = by_channel[name]
            assert variable.attrs["units"] == unit
            assert same(variable, values[:, column]), name
            assert same(file[variable.name][()], values[:, column]), name
    assert raw.attrs["status"] == "completed"
    # With times decoded too, as xarray does by itself.
    decoded = xarray.open_dataset(path)
    assert decoded.sizes["time"] == len(values)
    raw.close()
    decoded.close()


def check_workbook(folder, header, values):
    book = openpyxl.load_workbook(folder / "history.xlsx", read_only=True)
    assert book.sheetnames == ["history", "metrics", "limits", "contacts"]
    rows = book["history"].iter_rows(values_only=True)
    assert list(next(rows)) == header
    for row, expected in zip(rows, values):
        for cell, value in zip(row, expected):
            # The workbook has 16 significant digits.
            assert (cell is None and math.isnan(value)) or abs(cell - value) <= 1e-15 * abs(value), (cell, value)
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    metrics = {row[0]: row[1:] for row in book["metrics"].iter_rows(min_row=2, values_only=True)}
    assert metrics.keys() == summary["metrics"].keys()
    for name, metric in summary["metrics"].items():
        assert abs(metrics[name][0] - metric["value"]) <= 1e-15 * abs(metric["value"])
        assert metrics[name][1] == metric["unit"]
    limits = list(book["limits"].iter_rows(min_row=2, values_only=True))
    assert [row[0] for row in limits] == [limit["name"] for limit in summary["limits"]]
    assert [row[6] == "yes" for row in limits] == [limit["pass"] for limit in summary["limits"]]
    contacts = list(book["contacts"].iter_rows(min_row=2, values_only=True))
    raw = xarray.open_dataset(folder / "history.nc", decode_times=False)
    assert len(contacts) == raw.sizes.get("contact_event", 0)
    for row, name, speed in zip(contacts, raw.get("contact_event_name", []), raw.get("contact_event_approach_speed", [])):
        assert row[0] == str(name.values)
        assert abs(row[5] - float(speed)) <= 1e-15 * abs(float(speed))
    raw.close()


def check_killed(folder, case):
    """What a killed run leaves opens as well, is finite as far as it says, and says that it is not complete."""
    child = subprocess.Popen([PROGRAM, "simulate", case, "--out", folder, "--quiet", "--set",
                              "operation.phases.settle.duration_s=100000", "--set", "solver.output_interval_s=5"])
    for _ in range(6000):
        if (folder / "history.nc").exists():
            break
        time.sleep(0.005)
    time.sleep(1.0)  # some seconds' work is left even on an idle machine, and some is done on a busy one
    child.send_signal(signal.SIGKILL)
    child.wait()
    path = folder / "history.nc"
    with xarray.open_dataset(path, decode_times=False) as data:
        assert data.attrs["status"] == "running"
        count = int(data["samples_written"])
        assert count >= 20
        with h5py.File(path, "r") as file:
            for variable in data.data_vars.values():
                if "channel" not in variable.attrs:
                    continue
                assert numpy.isfinite(variable[:count]).all(), variable.name
                assert same(file[variable.name][:count], variable[:count])
        assert (numpy.diff(data["time"][:count]) > 0).all()


def main():
    case = pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory(prefix="stillhook prøve ") as temporary:
        folder = pathlib.Path(temporary) / "løft – nr 1"
        run("simulate", case, "--out", folder, "--quiet")
        run("export", folder, "--csv")
        run("export", folder, "--xlsx")
        header, values = read_csv(folder / "history.csv")
        assert header[0] == "time [s]" and len(header) > 30 and len(values) > 100
        check_conventions(folder / "history.nc")
        check_values(folder, header, values)
        check_workbook(folder, header, values)
        check_killed(pathlib.Path(temporary) / "killed", case)
    print(f"{len(header) - 1} channels, {len(values)} samples: the same numbers everywhere")


PROGRAM = os.path.abspath(sys.argv[1])
main()
