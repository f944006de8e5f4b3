# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples of docs/python.md run, one after the other."""
import contextlib
import io
import os
import pathlib
import re
import unittest

from support import InFolder

PAGE = pathlib.Path(os.environ["POLARGRAIN_SOURCE"]) / "docs/python.md"


class Page(InFolder):
    def test_runs(self):
        page = PAGE.read_text(encoding="utf-8")
        # With empty lines before each, so that an error names the line of the page.
        examples = ["\n" * page.count("\n", 0, found.start(1)) + found[1]
                    for found in re.finditer(r"^```python\n(.*?)^```", page, re.M | re.S)]
        self.assertGreater(len(examples), 5)
        names = {}
        before = os.getcwd()
        os.chdir(self.folder)
        said = io.StringIO()
        try:
            with contextlib.redirect_stdout(said):
                for example in examples:
                    exec(compile(example, str(PAGE), "exec"), names)
        finally:
            os.chdir(before)
        # What the page says that is printed.
        self.assertIn("cell: unknown key 'dampin'; did you mean 'damping'?", said.getvalue())


if __name__ == "__main__":
    unittest.main()
