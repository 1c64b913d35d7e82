#!/usr/bin/python3
"""Runs the commands of a documentation page as a reader would, in an empty folder.

    run_commands.py PAGE PROGRAM SOURCE_DIR [CACHE_DIR]

Every ```sh block runs, in order, in one folder; a block fails on the first command that fails. What stands in a comment
on the line before a block steers it:

    <!-- not run: why -->        the block is left out
    <!-- exit: 0 3 -->           its last command may end with one of these codes
    <!-- run with: OPTIONS -->   added to each of its `stillhook plan` commands, e.g. a smaller budget
    <!-- file: NAME -->          the block is the content of a file, <!-- append: NAME --> goes to its end
    <!-- prints -->              each line of the block must have been printed by the commands before it (spaces aside)
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile


class Block:
    def __init__(self, line, language, note, text):
        self.line, self.language, self.note, self.text = line, language, note, text


def blocks_of(page):
    blocks, note, fence = [], "", None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if fence is not None:
            if line.startswith("```"):
                blocks.append(Block(fence[0], fence[1], fence[2], "".join(fence[3])))
                fence = None
            else:
                fence[3].append(line + "\n")
        elif line.startswith("```"):
            fence, note = (number, line[3:].strip(), note, []), ""
        else:
            match = re.fullmatch(r"<!-- (.*) -->", line.strip())
            note = match[1] if match else ""
    if fence is not None:
        sys.exit(f"{page}:{fence[0]}: a block that is not closed")
    return blocks


def words(line):
    return " ".join(line.split())


class Reader:
    def __init__(self, page, program, source, cache):
        self.page, self.printed, self.ran = page, [], 0
        self.folder = tempfile.TemporaryDirectory(prefix="stillhook-docs-")
        self.path = pathlib.Path(self.folder.name)
        (self.path / "bin").mkdir()
        (self.path / "build").mkdir()
        for link in (self.path / "bin" / "stillhook", self.path / "build" / "stillhook"):
            link.symlink_to(program)
        for folder in ("problems", "docs"):
            (self.path / folder).symlink_to(source / folder)
        self.environment = dict(os.environ, PATH=f"{self.path}/bin:{os.environ['PATH']}", NO_COLOR="1")
        if cache:
            self.environment["STILLHOOK_CACHE"] = str(cache)

    def fail(self, block, why):
        sys.exit(f"{self.page}:{block.line}: {why}")

    def run(self, block):
        kind, _, value = block.note.partition(": ")
        commands, allowed = block.text, {0}
        if kind == "not run":
            return
        if kind == "exit":
            allowed = {int(code) for code in value.split()}
        if kind == "run with":
            commands = re.sub(r"(?m)^(\S*stillhook plan .*?)\s*(#.*)?$", rf"\1 {value}", commands)
        script = "set -eo pipefail\n" + commands
        done = subprocess.run(["bash", "-c", script], cwd=self.path, env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=900)
        if done.returncode not in allowed:
            self.fail(block, f"exit code {done.returncode}\n{commands}\n{done.stdout}")
        self.printed = [words(line) for line in done.stdout.splitlines()]
        self.ran += 1

    def take(self, block):
        kind, _, value = block.note.partition(": ")
        if block.language == "sh":
            self.run(block)
        elif kind in ("file", "append"):
            target = self.path / value
            before = target.read_text(encoding="utf-8") + "\n" if kind == "append" else ""
            target.write_text(before + block.text, encoding="utf-8")
        elif kind == "prints":
            for line in filter(None, map(words, block.text.splitlines())):
                if not any(printed.startswith(line) for printed in self.printed):
                    self.fail(block, f'"{line}" is not what the commands print:\n' + "\n".join(self.printed))


def main():
    page, program, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    reader = Reader(page, program, source, pathlib.Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None)
    for block in blocks_of(page):
        reader.take(block)
    if reader.ran == 0:
        sys.exit(f"{page}: holds no command that runs")
    print(f"{page.name}: {reader.ran} blocks ran")


if __name__ == "__main__":
    main()
