#!/usr/bin/env python3
"""Writes era5_like_spectrum.nc: a swell across a wind sea as ECMWF's ERA5 gives 2-D spectra (variable d2fd), in the
classic NetCDF format. Made up, for the example crossed_seas.toml; needs nothing but Python."""
import math
import struct
import sys

FREQUENCIES = [0.03453 * 1.1**i for i in range(30)]  # Hz
DIRECTIONS = [7.5 + 15.0 * j for j in range(24)]     # deg clockwise from north, towards


def jonswap(f, height, period, gamma):
    fp = 1.0 / period
    sigma = 0.07 if f <= fp else 0.09
    peak = gamma ** math.exp(-0.5 * ((f - fp) / (sigma * fp)) ** 2)
    shape = f**-5 * math.exp(-1.25 * (f / fp) ** -4) * peak
    return shape * 5.0 / 16.0 * height**2 * fp**4 * (1.0 - 0.287 * math.log(gamma))


def system(height, period, gamma, towards, s):
    """Density in m2 s / rad over FREQUENCIES and DIRECTIONS, cos^2s of half the angle."""
    spread = [abs(math.cos(math.radians(d - towards) / 2.0)) ** (2.0 * s) for d in DIRECTIONS]
    total = sum(spread) * math.radians(15.0)
    return [[jonswap(f, height, period, gamma) * d / total for d in spread] for f in FREQUENCIES]


def name(text):
    data = text.encode()
    return struct.pack(">i", len(data)) + data + b"\0" * (-len(data) % 4)


def attribute(key, value):
    if isinstance(value, str):
        data = value.encode()
        return name(key) + struct.pack(">ii", 2, len(data)) + data + b"\0" * (-len(data) % 4)
    return name(key) + struct.pack(">iif", 5, 1, value)


def attributes(pairs):
    return struct.pack(">ii", 12, len(pairs)) + b"".join(attribute(k, v) for k, v in pairs)


def write(path, times, values, latitude, longitude):
    missing = -32767.0
    dimensions = [("time", len(times)), ("frequencyNumber", 30), ("directionNumber", 24), ("latitude", 1), ("longitude", 1)]
    variables = [
        ("time", 6, [0], [("units", "hours since 1900-01-01 00:00:00")], struct.pack(">%dd" % len(times), *times)),
        ("latitude", 6, [3], [("units", "degrees_north")], struct.pack(">d", latitude)),
        ("longitude", 6, [4], [("units", "degrees_east")], struct.pack(">d", longitude)),
        ("d2fd", 5, [0, 1, 2, 3, 4],
         [("units", "m**2 s radian**-1"), ("long_name", "log10 of 2-D wave spectra"), ("_FillValue", missing)],
         b"".join(struct.pack(">f", math.log10(v) if v > 1e-6 else missing) for v in values)),
    ]
    head = b"CDF\x01" + struct.pack(">i", 0)
    head += struct.pack(">ii", 10, len(dimensions)) + b"".join(name(n) + struct.pack(">i", s) for n, s in dimensions)
    head += attributes([("source", "made up by write_era5_spectrum.py")])
    head += struct.pack(">ii", 11, len(variables))
    entries = [name(n) + struct.pack(">i", len(d)) + struct.pack(">%di" % len(d), *d) + attributes(a) +
               struct.pack(">ii", t, len(data)) for n, t, d, a, data in variables]
    begin = len(head) + sum(len(e) + 4 for e in entries)
    body = b""
    for entry, variable in zip(entries, variables):
        head += entry + struct.pack(">i", begin + len(body))
        body += variable[4]
    with open(path, "wb") as out:
        out.write(head + body)


if __name__ == "__main__":
    values = []
    # Two times: the swell dies down while the wind sea grows.
    for swell_height, wind_height in ((0.9, 0.5), (0.7, 0.8)):
        swell = system(swell_height, 11.5, 5.0, 60.0, 30.0)  # from 240 deg
        wind_sea = system(wind_height, 5.5, 2.0, 150.0, 8.0)  # from 330 deg
        values += [a + b for rows in zip(swell, wind_sea) for a, b in zip(*rows)]
    # 2026-11-30 00:00 and 06:00, in hours since 1900-01-01.
    write(sys.argv[1] if len(sys.argv) > 1 else "era5_like_spectrum.nc", [1112496.0, 1112502.0], values, 54.5, 6.5)
