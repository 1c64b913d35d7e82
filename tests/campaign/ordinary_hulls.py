#!/usr/bin/env python3
"""Ordinary hulls in ordinary seas at default settings: how many are accepted, and what they cost.

A sample of barges (boxes), ships (parabolic waterlines and sections) and sheerlegs (wide boxes) of 30 to 250 m, each in
a JONSWAP sea of a peak period between 4 and 16 s, is given to `stillhook check`. Every hull is one that an engineer
would write down without a [panel_method] section, so a refusal is a fault. Prints a line a hull and the sums; the exit
code is 1 when a hull is refused or costs more than the limits allow.

    python3 tests/campaign/ordinary_hulls.py build/stillhook --count 60 --seed 1
    python3 tests/campaign/ordinary_hulls.py build/stillhook --hulls 0,1,2,6,22,39 --finer 1.4

The second computes each hull a second time with every panel and cell divided by 1.4, and prints how far A, B and X of the
first are from that: the largest difference over the band, in percent of the largest value of the curve. The exit code is
1 when one is outside the bands of docs/validation.md.

Processor time and memory are those of the child process (resource.wait4), with nothing in the cache.
"""
import argparse
import cmath
import math
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile

LIMIT_SECONDS, LIMIT_BYTES = 60.0, 1e9  # of processor time and of memory, a hull
MODES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
BANDS = (5.0, 5.0, 3.0, 3.0, 3.0, 5.0)  # %, as box hulls agree with two frequency-domain codes (docs/validation.md)


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
    # Above the still water.
    high = {"barge": 0.1, "ship": 0.02, "sheerleg": 0.3}[kind] * breadth
    if kind == "ship":
        # A metacentric height of a twentieth of the breadth at least, or a deep one turns over before it is computed:
        # of this form BM = 0.0775 B^2/T, and the centre of buoyancy is 0.432 T below the water.
        high = min(high, 0.0775 * breadth ** 2 / draft - 0.432 * draft - 0.05 * breadth)
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
gyration_m = [{0.36 * breadth:.3f}, {0.25 * length:.3f}, {0.25 * length:.3f}]
hull = {{ {shape} }}
hydrodynamics = {{ kind = "panels" }}

[operation]
[[operation.phases]]
name = "wait"
duration_s = 20.0
''')
    return path, f"{kind:8} {length:6.1f} x {breadth:5.1f} x {draft:4.1f} m, Tp {period:4.1f} s"


def curves(path):
    """A, B and X of a coefficient file: {(quantity, mode): {where: value}}, diagonals of A and B."""
    values = {}
    for line in path.read_text(encoding="ascii").splitlines():
        field = line.split(",")
        if field[0] in ("A", "B") and field[1] == field[2]:
            values.setdefault((field[0], int(field[1])), {})[field[3]] = float(field[4])
        elif field[0] == "X":
            where = field[2] + " deg, " + field[3]
            values.setdefault(("X", int(field[1])), {})[where] = cmath.rect(float(field[4]), math.radians(float(field[5])))
    return values


def compare(coarse, fine):
    """Lines of text, and how many differences are outside the bands."""
    lines, outside = [], 0
    ours, theirs = curves(coarse), curves(fine)
    for mode in range(1, 7):
        text = f"      {MODES[mode - 1]:5}"
        for quantity in ("A", "B", "X"):
            a, b = ours[quantity, mode], theirs[quantity, mode]
            common = a.keys() & b.keys()
            largest = max(abs(b[where]) for where in common)
            worst = max(common, key=lambda where: abs(a[where] - b[where]))
            share = 100.0 * abs(a[worst] - b[worst]) / largest
            bad = share > BANDS[mode - 1]
            outside += bad
            text += f"   {quantity} {share:4.1f} %{'!' if bad else ' '} at {worst:>20} rad/s"
        lines.append(text)
    return lines, outside


def run(program, path, cache, limit, overrides=()):
    """Exit code, last error line, warnings, processor seconds, bytes. `limit`: of processor time, s."""
    environment = dict(os.environ, STILLHOOK_CACHE=str(cache))
    with open(path.with_suffix(".err"), "w+", encoding="utf-8") as err:
        # A busy machine makes a hull no slower: the limit is of processor time, and what it ends says so.
        child = subprocess.Popen([program, "check", path.name, *overrides], cwd=path.parent, env=environment,
                                 stdout=subprocess.DEVNULL, stderr=err,
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)))
        _, status, usage = os.wait4(child.pid, 0)
        err.seek(0)
        lines = err.read().replace("\r", "\n").splitlines()
    code = os.waitstatus_to_exitcode(status)
    errors = [line for line in lines if line.startswith("error")]
    if code < 0:
        errors.append(f"ended by signal {-code} ({signal.strsignal(-code)}); {limit} s of processor time are allowed")
    warnings = [line for line in lines if line.startswith("warning")]
    return code, errors[-1] if errors else "", warnings, usage.ru_utime + usage.ru_stime, 1024.0 * usage.ru_maxrss


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--first", type=int, default=0, help="skip the hulls before this one")
    parser.add_argument("--hulls", default="", help="only these, by number, with commas in between")
    parser.add_argument("--finer", type=float, default=0.0, metavar="R", help="compare with panels divided by this")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--timeout", type=int, default=600, help="s of processor time a hull")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    accepted, slow, large, outside = 0, 0, 0, 0
    hulls = [int(n) for n in arguments.hulls.split(",")] if arguments.hulls else range(arguments.first, arguments.count)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number in hulls:
            # A generator a hull: any one of them can be looked at alone.
            rng = random.Random(1000 * arguments.seed + number)
            path, text = write_case(folder, number, ("barge", "ship", "sheerleg")[number % 3], rng)
            code, error, warnings, seconds, size = run(program, path, folder / f"cache_{number}", arguments.timeout)
            # A hull that floats otherwise than it is written down is another hull.
            elsewhere = any("from its given pose" in line for line in warnings)
            accepted += code == 0 and not elsewhere
            slow += seconds > LIMIT_SECONDS
            large += size > LIMIT_BYTES
            print(f"{number:3} {text}: {'REFUSED' if code else 'FLOATS OTHERWISE' if elsewhere else 'accepted'}, {seconds:5.1f} s, {size / 1e6:5.0f} MB"
                  + "".join("\n      " + line for line in warnings + ([error] if error else [])), flush=True)
            if arguments.finer and code == 0:
                coarse = list((folder / f"cache_{number}").glob("hull-*.csv"))[0]
                code, error, _, seconds, size = run(program, path, folder / f"finer_{number}", arguments.timeout,
                                                    ("--set", f"panel_method.refinement={arguments.finer}",
                                                     "--set", "panel_method.memory_gb=16"))
                fine = list((folder / f"finer_{number}").glob("hull-*.csv"))
                # A finer set is kept whether or not its self-checks pass: it is what the first is compared with.
                lines, bad = compare(coarse, fine[0]) if fine else ([f"      no finer set: {error}"], 1)
                outside += bad
                print(f"      finer: {seconds:.1f} s, {size / 1e6:.0f} MB", *lines, sep="\n", flush=True)
    count = len(hulls)
    print(f"{accepted} of {count} accepted; {slow} took more than {LIMIT_SECONDS:.0f} s of processor time, "
          f"{large} more than {LIMIT_BYTES / 1e9:.0f} GB")
    if arguments.finer:
        print(f"{outside} differences from the finer panels are outside the bands")
    return 0 if accepted == count and slow == 0 and large == 0 and outside == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
