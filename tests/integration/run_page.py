#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the commands of a page of the documentation as they stand there, in a folder of its own.

    tests/integration/run_page.py POLARGRAIN LIGGGHTS PYTHON_PACKAGE SOURCE PAGE

- Indented lines whose first word is a word in small letters are commands; a line that ends with a backslash goes on in the next one.
- A fenced block whose first line is a comment with a file name, "# case.yaml", is written to that file.
- <!-- check: COMMANDS --> are commands of the test, which readers do not see. They have three functions:
  value FILE COLUMN ROW (of a CSV file, rows from 1 behind the head, $ for the last one), near A B TOLERANCE (relative) and
  between A LOW HIGH (the magnitude of A).
- <!-- not run: REASON --> leaves out the indented block that follows.

A page without any command is a fault, unless it says "not run".
"""
import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from free_ports import free_ports

PRELUDE = r"""set -euo pipefail
fail() { echo "FAILED: $*" >&2; exit 1; }
value() { awk -F, -v name="$2" -v row="$3" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) c = k }
  NR > 1 { last = $c } NR == row + 1 { found = $c } END { print row == "$" ? last : found }' "$1"; }
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= t * (b < 0 ? -b : b)) }' ||
  fail "expected $2, found $1"; }
between() { awk -v a="$1" -v low="$2" -v high="$3" 'BEGIN { if (a < 0) a = -a; exit !(low < a && a < high) }' ||
  fail "$1 is not between $2 and $3"; }
"""
COMMENT = re.compile(r"<!-- (check|not run): (.*?) -->", re.S)
FILE = re.compile(r"^# ([\w./-]+\.\w+)\b")


def blocks(text):
    """Comments, fenced blocks and indented blocks of a page, in their order, as (kind, text)."""
    pattern = re.compile(r"<!--[\s\S]*?-->|^```\w*\n[\s\S]*?^```$|(?:^    .*\n?)+", re.M)
    for found in pattern.finditer(text):
        block = found.group(0)
        if block.startswith("<!--"):
            comment = COMMENT.match(block)
            if comment:
                yield comment.group(1), comment.group(2)
        elif block.startswith("```"):
            yield "file", block.split("\n", 1)[1].rsplit("\n", 1)[0] + "\n"
        else:
            yield "commands", block


def script(text):
    """@returns the script of a page, and how many commands of readers it has"""
    lines, commands, skip, reasons = [PRELUDE], 0, False, 0
    for kind, block in blocks(text):
        if kind == "check":
            lines.append(block)
        elif kind == "not run":
            skip, reasons = True, reasons + 1
        elif kind == "file":
            name = FILE.match(block)
            if name:
                lines.append(f"mkdir -p $(dirname {name[1]})\ncat >{name[1]} <<'END_OF_FILE'\n{block}END_OF_FILE")
        elif skip:
            skip = False
        else:
            for line in re.sub(r"\\\n\s*", "", block).splitlines():
                command = re.sub(r"\s{2,}#.*$", "", line.strip())
                if command and re.fullmatch(r"[a-z][\w./-]*", command.split()[0]):
                    lines += [f"echo {quoted('-- ' + command)}", command]
                    commands += 1
    return "\n".join(lines) + "\n", commands + reasons


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def main():
    program, engine, package, source, page = (pathlib.Path(name).resolve() for name in sys.argv[1:6])
    commands, count = script(page.read_text(encoding="utf-8"))
    if count == 0:
        sys.exit(f"{page}: the page has lost its commands")
    with tempfile.TemporaryDirectory(prefix="page_") as folder:
        tools = pathlib.Path(folder) / "bin"
        tools.mkdir()
        (tools / "polargrain").symlink_to(program)
        (tools / "polargrain-liggghts").symlink_to(engine)
        (tools / "python3").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
        (tools / "python3").chmod(0o755)
        work = pathlib.Path(folder) / "work"
        work.mkdir()
        environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "POLARGRAIN_DATA": str(source), "PYTHONPATH": str(package)}
        # Pages show one port; tests beside each other take others. A session of its own, so that what a page starts in
        # the background ends with it.
        running = subprocess.Popen(["bash", "-c", commands.replace(":5570", f":{free_ports()}")], cwd=work, env=environment, start_new_session=True)
        signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended by SIGTERM"))
        try:
            status = running.wait()
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(running.pid, signal.SIGKILL)
    sys.exit(status)


if __name__ == "__main__":
    main()
