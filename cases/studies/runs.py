# SPDX-License-Identifier: GPL-2.0-or-later
"""The programs that a study runs: each with a log, and all of them ended by one signal."""
import os
import pathlib
import signal
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILT = [ROOT / "build/release/app", ROOT / "build/release/app/standalone"]


class Failed(Exception):
    """A program ended with an error; the end of its log."""


class Programs:
    """Those of `folders`, the first that has one."""

    def __init__(self, folders=None):
        self.folders = [pathlib.Path(folder).resolve() for folder in folders or BUILT]
        self.stopped = False
        self._running = set()

    def find(self, name):
        for folder in self.folders:
            if (folder / name).is_file():
                return folder / name
        sys.exit(f"there is no {name} in {', '.join(map(str, self.folders))}: build the project, or name its folder with --programs")

    def call(self, log, *command, folder=None):
        """Runs a command in a folder, its output appended to the log. @raises Failed"""
        log = pathlib.Path(log)
        with open(log, "a", encoding="utf-8") as out:
            print("$", *command, file=out, flush=True)
            begin = out.tell()
            # A group of its own, to be ended as one; in this session, whose priority it keeps.
            process = subprocess.Popen([str(word) for word in command], cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=subprocess.STDOUT, process_group=0)
            self._running.add(process)
            if self.stopped:  # the signal may have come before the process was known
                os.killpg(process.pid, signal.SIGTERM)
            status = process.wait()
            self._running.discard(process)
        if status != 0:
            lines = log.read_text(encoding="utf-8", errors="replace")[begin:].splitlines()[-8:]
            name = pathlib.Path(command[str(command[0]) == sys.executable]).name
            raise Failed(f"{name} ended with status {status}; the end of {log}:\n    " + "\n    ".join(lines))

    def stop(self, *_):
        """Ends what runs, once, however many signals come. Fit as a handler of signals."""
        if self.stopped:
            return
        self.stopped = True
        for process in list(self._running):
            os.killpg(process.pid, signal.SIGTERM)
