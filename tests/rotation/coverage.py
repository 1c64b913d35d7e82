"""Lines of a room that its tests have run, by folder, from what gcov counted."""

import collections
import json
import subprocess
from pathlib import Path


def lines_of(source, objects, room):
    """file -> {line: times run}, over all objects: a line of a header counts where any of them ran it."""
    lines = collections.defaultdict(lambda: collections.defaultdict(int))
    for counts in sorted(objects.rglob("*.gcda")):
        done = subprocess.run(["gcov", "--json-format", "--stdout", "--object-directory", str(counts.parent), str(counts)],
                              capture_output=True, text=True)
        for text in done.stdout.splitlines():
            report = json.loads(text)
            for entry in report["files"]:
                path = Path(report["current_working_directory"], entry["file"]).resolve()
                if source / room in path.parents:
                    for line in entry["lines"]:
                        lines[path.relative_to(source)][line["line_number"]] += line["count"]
    return lines


def print_room(source, objects, room, say):
    lines = lines_of(source, objects, room)
    if not lines:
        say(f"coverage of {room}: gcov counted nothing")
        return
    folders = collections.defaultdict(lambda: [0, 0])
    for path, counts in lines.items():
        for total in (folders[str(path.parent)], folders[""]):
            total[0] += sum(1 for count in counts.values() if count)
            total[1] += len(counts)
    ran, known = folders.pop("")
    say(f"coverage of {room} by its own fast tests: {ran} of {known} lines, {100.0 * ran / known:.1f} %")
    for folder, (ran, known) in sorted(folders.items()):
        print(f"  {folder:28} {ran:6} of {known:6}  {100.0 * ran / known:5.1f} %")
    missed = sorted(lines, key=lambda path: sum(1 for count in lines[path].values() if not count), reverse=True)
    for path in missed[:5]:
        counts = lines[path].values()
        print(f"  most lines not run: {path}: {sum(1 for count in counts if not count)} of {len(counts)}")
