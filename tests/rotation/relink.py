"""Links a target of one build again, with the objects of another build in place of some of its libraries."""

import shlex
import subprocess


def link_command(build, target):
    """The command that links the target, as ninja would run it in the build's folder."""
    steps = subprocess.run(["ninja", "-C", str(build), "-t", "commands", target], check=True, capture_output=True, text=True).stdout
    last = steps.strip().splitlines()[-1]
    # ": && c++ ... && what follows the link"
    return shlex.split(last.split("&&")[1])


def objects_of(folder, room):
    """The objects of a room's library, as ninja calls them; they need no library of another room."""
    listed = subprocess.run(["ninja", "-C", str(folder), "-t", "targets", "all"], check=True, capture_output=True, text=True).stdout
    begin = f"CMakeFiles/stillhook_{room}.dir/"
    return [line.split(":")[0] for line in listed.splitlines() if line.startswith(begin) and line.split(":")[0].endswith(".o")]


def relink(build, target, objects, flags, output, openmp=None):
    """objects: room -> the objects of its library. openmp: an object that takes libgomp's place."""
    command = link_command(build, target)
    kept = [command[0], *flags]
    for paths in objects.values():
        # First: of an inline function that several objects have, the linker takes the first, and that is to be the checked one.
        kept += [str(path) for path in paths]
    if openmp:
        kept.append(str(openmp))
    replaced = {f"libstillhook_{room}.a" for room in objects}
    skip = False
    for word in command[1:]:
        if skip:
            skip = False
        elif word == "-o":
            skip = True
        elif word.endswith("allocation_test.cpp.o"):
            pass  # counts requests for memory in a malloc of its own, which would take the sanitizer's place
        elif word not in replaced and not (openmp and word.endswith("libgomp.so")):
            kept.append(word)
    subprocess.run([*kept, "-o", str(output)], cwd=build, check=True)
