# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether an HTML file can stand alone: every element that is opened is closed, in order, and nothing is loaded from elsewhere.
Prints what is wrong and ends with status 1, or prints how many elements of each kind there are."""
import collections
import html.parser
import sys

# Elements without an end.
VOID = {"meta", "br", "hr", "img", "input", "link"}


class Check(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open = []
        self.counts = collections.Counter()
        self.faults = []

    def handle_starttag(self, tag, attributes):
        self.counts[tag] += 1
        for name, value in attributes:
            if name.startswith("on") or name in ("autofocus", "srcdoc", "formaction"):
                self.faults.append(f"line {self.getpos()[0]}: {tag} has the attribute {name}, which runs what it holds")
            if name in ("src", "href") and not value.startswith("#"):
                self.faults.append(f"line {self.getpos()[0]}: {tag} loads {value}")
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"line {self.getpos()[0]}: </{tag}> closes nothing")


check = Check()
with open(sys.argv[1], encoding="utf-8") as file:
    check.feed(file.read())
check.close()
check.faults += [f"<{tag}> is not closed" for tag in check.open]
print("\n".join(check.faults) if check.faults else dict(check.counts))
sys.exit(1 if check.faults else 0)
