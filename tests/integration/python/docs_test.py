# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples of docs/python.md and docs/other_hosts.md run, one after the other."""
import contextlib
import io
import os
import pathlib
import re
import unittest

from support import InFolder

DOCS = pathlib.Path(os.environ["POLARGRAIN_SOURCE"]) / "docs"


class Pages(InFolder):
    def run_page(self, name):
        """@returns names that its examples leave, what they print"""
        page = (DOCS / name).read_text(encoding="utf-8")
        # With empty lines before each, so that an error names the line of the page.
        examples = ["\n" * page.count("\n", 0, found.start(1)) + found[1]
                    for found in re.finditer(r"^```python\n(.*?)^```", page, re.M | re.S)]
        names = {}
        before = os.getcwd()
        os.chdir(self.folder)
        said = io.StringIO()
        try:
            with contextlib.redirect_stdout(said):
                for example in examples:
                    exec(compile(example, name, "exec"), names)
        finally:
            os.chdir(before)
        return names, said.getvalue()

    def test_python(self):
        _, said = self.run_page("python.md")
        # What the page says that is printed, by its last example.
        self.assertIn("cell: unknown key 'dampin'; did you mean 'damping'?", said)

    def test_other_hosts(self):
        names, _ = self.run_page("other_hosts.md")
        self.assertEqual(sorted(names["MicroSimulation"](1).initialize())[:2], ["stress_1", "stress_2"])


if __name__ == "__main__":
    unittest.main()
