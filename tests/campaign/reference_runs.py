#!/usr/bin/env python3
"""Runs the reference lift over waves, headings, hoist speeds, taglines and time steps, and prints the tables of
docs/validation.md ("The reference lift in motion") in the form that the page has them.

    tests/campaign/reference_runs.py [--program build/stillhook] [--only rehits,phases,taglines,steps]
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SPEED = "operation.phases.load_transfer.moves.hoist.speed_m_per_min"


class Runs:
    def __init__(self, program):
        self.program, self.folder = program, tempfile.TemporaryDirectory(prefix="stillhook-reference-")
        self.kept = {}

    def __call__(self, settings):
        key = json.dumps(settings, sort_keys=True)
        if key not in self.kept:
            out = Path(self.folder.name) / str(len(self.kept))
            command = [self.program, "simulate", str(SOURCE / "problems/box_installation.toml"), "--out", str(out), "--quiet"]
            for name, value in settings.items():
                command += ["--set", f"{name}={value}"]
            code = subprocess.run(command, stdout=subprocess.DEVNULL).returncode
            if code not in (0, 3, 4):
                raise SystemExit(f"exit code {code}: {' '.join(command)}")
            self.kept[key] = json.loads((out / "summary.json").read_text()) if code != 4 else None  # diverged
        return self.kept[key]


def sea(wave, heading, speed=1.0):
    return {"sea.active": wave, f"sea.states.{wave}.heading_deg": float(heading), SPEED: speed}


def value(summary, name):
    return summary["metrics"][name]["value"] if summary else float("nan")


def by_phase(summary, phase):
    return summary["metrics"]["daf_total"]["by_phase"].get(phase, float("nan")) if summary else float("nan")


def rehits(run):
    print("| wave, heading | quantity | 0.5 m/min | 1 | 2 | 2.6 |\n|---|---|---|---|---|---|")
    for wave in ("paper_table1", "paper_text"):
        for heading in (45, 135):
            all_ = [run(sea(wave, heading, speed)) for speed in (0.5, 1.0, 2.0, 2.6)]
            print(f"| `{wave}`, {heading} deg | re-hits | " + " | ".join(f"{value(s, 'rehits'):.0f}" for s in all_) + " |")
            print("| | fastest re-hit, m/s | " + " | ".join(f"{value(s, 'rehit_speed_max'):.2f}" for s in all_) + " |")
            print("| | daf_total | " + " | ".join(f"{value(s, 'daf_total'):.3f}" for s in all_) + " |")


def phases(run):
    names = ("hoist_up", "rotate_backstays", "rotate_booms", "hoist_down")
    print("| phase | 45 deg | 45 deg without taglines | 135 deg | 135 deg without taglines |\n|---|---|---|---|---|")
    columns = []
    for heading in (45, 135):
        columns += [run(sea("paper_text", heading)), run(dict(sea("paper_text", heading), **{"taglines.*.active": "false"}))]
    for name in names:
        print(f"| {name} | " + " | ".join(f"{by_phase(s, name):.3f}"
                                          for s in columns) + " |")


def taglines(run):
    print("| wave, heading | taglines | sway_rms m | sway_x_rms | sway_y_rms | saturated |\n|---|---|---|---|---|---|")
    rows = [("calm (amplitude 1e-6 m)", {"sea.active": "paper_table1", "sea.states.paper_table1.amplitude_m": 1e-6, SPEED: 1.0})]
    rows += [(f"`{wave}`, {heading} deg", sea(wave, heading)) for wave in ("paper_table1", "paper_text") for heading in (45, 135)]
    for name, settings in rows:
        for on in (True, False):
            s = run(dict(settings, **({} if on else {"taglines.*.active": "false"})))
            saturated = value(s, "tagline_saturated") if on else None
            print(f"| {name if on else ''} | {'on' if on else 'off'} | " +
                  " | ".join(f"{value(s, k):.3f}" for k in ("sway_rms", "sway_x_rms", "sway_y_rms")) +
                  f" | {'' if saturated is None else f'{100 * saturated:.0f} %'} |")


def steps(run):
    print("| dt s | daf_total | sway_rms m | sway_x_rms | sway_y_rms | re-hits |\n|---|---|---|---|---|---|")
    for dt in (0.1, 0.05, 0.025, 0.0125):
        s = run(dict(sea("paper_table1", 45), **{"solver.time_step_s": dt}))
        print(f"| {dt:g} | " + " | ".join(f"{value(s, k):.4f}" for k in ("daf_total", "sway_rms", "sway_x_rms", "sway_y_rms")) +
              f" | {value(s, 'rehits'):.0f} |")


def main():
    tables = {"rehits": rehits, "phases": phases, "taglines": taglines, "steps": steps}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(SOURCE / "build/stillhook"))
    parser.add_argument("--only", default=",".join(tables))
    arguments = parser.parse_args()
    run = Runs(arguments.program)
    for name in arguments.only.split(","):
        print(f"\n{name}", flush=True)
        tables[name](run)


if __name__ == "__main__":
    main()
