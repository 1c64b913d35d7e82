#!/usr/bin/env python3
"""Ordinary hulls in ordinary seas at default settings: how many are accepted, and what they cost.

A sample of barges (boxes), ships (parabolic waterlines and sections) and sheerlegs (wide boxes) of 30 to 250 m, each in
a JONSWAP sea of a peak period between 4 and 16 s, is given to `stillhook check`. Every hull is one that an engineer
would write down without a [panel_method] section, so a refusal is a fault. Prints a line a hull and the sums; the exit
code is 1 when a hull is refused or costs more than the limits allow.

    python3 tests/campaign/ordinary_hulls.py build/stillhook --count 60 --seed 1

Processor time and memory are those of the child process (resource.wait4), with nothing in the cache.
"""
import argparse
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

LIMIT_SECONDS, LIMIT_BYTES = 60.0, 1e9  # of processor time and of memory, a hull


def hull_of(kind, rng):
    """Length, breadth, draft and depth, m, in the ranges of ordinary vessels of each kind."""
    if kind == "barge":
        length = math.exp(rng.uniform(math.log(30.0), math.log(180.0)))
        breadth = min(length, length / rng.uniform(1.0, 5.0))
        breadth = max(breadth, 9.0)
        draft = breadth / rng.uniform(4.0, 12.0)
    elif kind == "ship":
        length = math.exp(rng.uniform(math.log(60.0), math.log(250.0)))
        breadth = length / rng.uniform(4.5, 7.0)
        draft = breadth / rng.uniform(2.2, 4.0)
    else:
        length = math.exp(rng.uniform(math.log(45.0), math.log(110.0)))
        breadth = length / rng.uniform(1.7, 2.6)
        draft = breadth / rng.uniform(6.0, 11.0)
    return [round(x, 1) for x in (length, breadth, max(draft, 1.0), max(draft, 1.0) + 4.0)]


def ship_mesh(path, length, breadth, draft, depth, stations=24, levels=5):
    """A closed hull about midships, z from the water plane: half breadth B/2 (1 - |2x/L|^3) (1 - (z/T)^4), walls above.

    Returns the displaced volume of the polyhedron, m3.
    """
    xs = [length * (i / stations - 0.5) for i in range(stations + 1)]
    zs = [-draft * (1.0 - j / levels) for j in range(levels)] + [0.0, depth - draft]
    z_low = 0.15  # the bottom keeps a flat of this share of the breadth

    def half(x, z):
        section = 1.0 if z >= 0.0 else z_low + (1.0 - z_low) * (1.0 - (z / draft) ** 4)
        return 0.5 * breadth * max(0.02, 1.0 - abs(2.0 * x / length) ** 3) * section

    points, index = [], {}
    for i, x in enumerate(xs):
        for j, z in enumerate(zs):
            for side in (1, -1):
                points.append((x, side * half(x, z), z))
                index[i, j, side] = len(points)
    quads = []
    last_x, last_z = len(xs) - 1, len(zs) - 1
    for i in range(last_x):
        for j in range(last_z):
            a = [index[i, j, 1], index[i + 1, j, 1], index[i + 1, j + 1, 1], index[i, j + 1, 1]]
            b = [index[i, j, -1], index[i + 1, j, -1], index[i + 1, j + 1, -1], index[i, j + 1, -1]]
            quads += [a[::-1], b]
        quads.append([index[i, 0, 1], index[i, 0, -1], index[i + 1, 0, -1], index[i + 1, 0, 1]][::-1])
        quads.append([index[i, last_z, 1], index[i, last_z, -1], index[i + 1, last_z, -1], index[i + 1, last_z, 1]])
    for j in range(last_z):
        quads.append([index[0, j, 1], index[0, j, -1], index[0, j + 1, -1], index[0, j + 1, 1]])
        quads.append([index[last_x, j, 1], index[last_x, j, -1], index[last_x, j + 1, -1],
                      index[last_x, j + 1, 1]][::-1])
    triangles = [t for q in quads for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]

    def volume(clip):
        total = 0.0
        for t in triangles:
            a, b, c = (points[k - 1] for k in t)
            a, b, c = ((p[0], p[1], min(p[2], clip)) for p in (a, b, c))
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                      + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6.0
        return total

    sign = 1 if volume(depth) > 0.0 else -1
    with open(path, "w", encoding="ascii") as out:
        for p in points:
            out.write("v %.6f %.6f %.6f\n" % p)
        for t in triangles:
            out.write("f %d %d %d\n" % (t if sign > 0 else t[::-1]))
    # Water planes coincide with a row of vertices, so that the clipped polyhedron is the wetted part with a flat lid.
    return abs(volume(0.0))


def write_case(folder, number, kind, rng):
    length, breadth, draft, depth = hull_of(kind, rng)
    period = round(rng.uniform(4.0, 16.0), 1)
    volume = length * breadth * draft
    shape = f'shape = "box", size_m = [{length}, {breadth}, {depth}], centre_m = [0.0, 0.0, {0.5 * depth - draft:.3f}]'
    if kind == "ship":
        volume = ship_mesh(folder / f"hull_{number}.obj", length, breadth, draft, depth)
        shape = f'shape = "mesh", mesh_file = "hull_{number}.obj"'
    heading = rng.choice([90.0, 135.0, 180.0])
    high = 0.3 * breadth if kind == "sheerleg" else 0.1 * breadth
    path = folder / f"case_{number}.toml"
    path.write_text(f'''name = "case_{number}"

[sea]
active = "sea"

[[sea.states]]
name = "sea"
type = "jonswap"
significant_height_m = 1.0
peak_period_s = {period}
heading_deg = {heading}
seed = {number + 1}

[[bodies]]
name = "vessel"
mass_t = {1.025 * volume:.3f}
cog_m = [0.0, 0.0, {high:.3f}]
gyration_m = [{0.36 * breadth:.3f}, {0.25 * length:.3f}, {0.26 * length:.3f}]
hull = {{ {shape} }}
hydrodynamics = {{ kind = "panels" }}

[operation]
[[operation.phases]]
name = "wait"
duration_s = 20.0
''')
    return path, f"{kind:8} {length:6.1f} x {breadth:5.1f} x {draft:4.1f} m, Tp {period:4.1f} s"


def run(program, path, cache, limit):
    """Exit code, last error line, warnings, processor seconds, bytes."""
    environment = dict(os.environ, STILLHOOK_CACHE=str(cache))
    with open(path.with_suffix(".err"), "w+", encoding="utf-8") as err:
        child = subprocess.Popen([program, "check", path.name], cwd=path.parent, env=environment,
                                 stdout=subprocess.DEVNULL, stderr=err)
        end = time.monotonic() + limit
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() > end:
                child.kill()
                _, status, usage = os.wait4(child.pid, 0)
                break
            time.sleep(0.05)
        err.seek(0)
        lines = err.read().replace("\r", "\n").splitlines()
    code = os.waitstatus_to_exitcode(status)
    errors = [line for line in lines if line.startswith("error")]
    warnings = [line for line in lines if line.startswith("warning")]
    return code, errors[-1] if errors else "", warnings, usage.ru_utime + usage.ru_stime, 1024.0 * usage.ru_maxrss


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--first", type=int, default=0, help="skip the hulls before this one")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--timeout", type=float, default=600.0, help="s of wall time a hull")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    accepted, slow, large = 0, 0, 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number in range(arguments.first, arguments.count):
            # A generator a hull: any one of them can be looked at alone.
            rng = random.Random(1000 * arguments.seed + number)
            path, text = write_case(folder, number, ("barge", "ship", "sheerleg")[number % 3], rng)
            code, error, warnings, seconds, size = run(program, path, folder / f"cache_{number}", arguments.timeout)
            accepted += code == 0
            slow += seconds > LIMIT_SECONDS
            large += size > LIMIT_BYTES
            print(f"{number:3} {text}: {'accepted' if code == 0 else 'REFUSED'}, {seconds:5.1f} s, {size / 1e6:5.0f} MB"
                  + "".join("\n      " + line for line in warnings + ([error] if error else [])), flush=True)
    count = arguments.count - arguments.first
    print(f"{accepted} of {count} accepted; {slow} took more than {LIMIT_SECONDS:.0f} s of processor time, "
          f"{large} more than {LIMIT_BYTES / 1e9:.0f} GB")
    return 0 if accepted == count and slow == 0 and large == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
