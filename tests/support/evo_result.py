#!/usr/bin/env python3
"""evo_result.py ARCHIVE: reads the result of an evaluation as evo does (evo/tools/file_interface.py, load_res_file) and
prints its mean and RMSE, in m. Ends with 1 and says why when parts are missing or contradict each other."""

import json
import math
import os
import re
import struct
import sys
import zipfile


def load_npy(data):
    """NumPy's format 1.0 (numpy.lib.format), one dimension of doubles."""
    if data[:8] != b"\x93NUMPY\x01\x00":
        sys.exit("not a .npy file of version 1.0")
    (header_bytes,) = struct.unpack("<H", data[8:10])
    header = data[10 : 10 + header_bytes].decode("latin1")
    match = re.fullmatch(r"\{'descr': '<f8', 'fortran_order': False, 'shape': \((\d+),\), \} *\n", header)
    if match is None:
        sys.exit(f"header of another kind: {header}")
    return struct.unpack(f"<{match[1]}d", data[10 + header_bytes :])


def load_tum(text):
    return [[float(field) for field in line.split(" ")] for line in text.splitlines()]


def load_res_file(path):
    with zipfile.ZipFile(path) as archive:
        read = {name: archive.read(name) for name in archive.namelist()}
    if not {"info.json", "stats.json"} <= set(read):
        sys.exit("no info.json and stats.json")
    info, stats = (json.loads(read[name].decode("utf-8")) for name in ("info.json", "stats.json"))
    stem = lambda name: os.path.splitext(os.path.basename(name))[0]
    arrays = {stem(name): load_npy(data) for name, data in read.items() if name.endswith(".npy")}
    trajectories = {stem(name): load_tum(data.decode()) for name, data in read.items() if name.endswith(".tum")}
    return info, stats, arrays, trajectories


def expect(condition, what):
    if not condition:
        sys.exit(what)


def main():
    info, stats, arrays, trajectories = load_res_file(sys.argv[1])
    # What evo_res needs: pandas_bridge.result_to_df and the axes of its plots.
    expect({"title", "label", "ref_name", "est_name"} <= set(info), f"info.json: {info}")
    expect({"rmse", "mean", "median", "std", "min", "max", "sse"} == set(stats), f"stats.json: {stats}")
    names = {"error_array", "timestamps", "seconds_from_start", "distances_from_start", "distances"}
    expect(names == set(arrays), f"arrays: {set(arrays)}")
    errors = arrays["error_array"]
    expect(all(len(array) == len(errors) > 0 for array in arrays.values()), "arrays of different length")

    # The statistics are those of the array, and the array is that of the trajectories.
    mean, rmse = sum(errors) / len(errors), math.sqrt(sum(e * e for e in errors) / len(errors))
    expect(abs(stats["mean"] - mean) < 1e-12 and abs(stats["rmse"] - rmse) < 1e-12, f"stats: {stats}, not {mean}, {rmse}")
    expect(abs(stats["sse"] - rmse * rmse * len(errors)) < 1e-9, f"sse: {stats}")
    estimate, reference = trajectories["estimate"], trajectories["reference"]
    expect(len(estimate) == len(reference) == len(errors), "trajectories of another length")
    for error, stamp_s, e, r in zip(errors, arrays["timestamps"], estimate, reference):
        expect(abs(math.dist(e[1:4], r[1:4]) - error) < 3e-9, f"at {stamp_s}: {error}")
        expect(abs(e[0] - stamp_s) < 1e-6 and e[0] == r[0], f"stamps {stamp_s}, {e[0]}, {r[0]}")
    print(f"{mean:.15f} {rmse:.15f}")


main()
