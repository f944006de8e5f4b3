#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds the documentation as pages that open offline, with search: mkdocs over all pages and what they link to.

    cmake/make_site.py SOURCE FOLDER [--code]

With --code and doxygen the pages of the code's interfaces are a part of it (under "The code" in the menu).
The pages open without a network; search needs a server, since browsers let no script read files:
python3 -m http.server -d FOLDER/site. Status 77 where there is no mkdocs. Links to folders lead to their README.md. A link that leads nowhere, or any warning of mkdocs, ends with status 1.
"""
import pathlib
import re
import shutil
import subprocess
import sys

LINK = re.compile(r"(\]\()([^)#\s]+)(#[^)\s]*)?\)")
MENU = {
    "Learn": ["README.md", "docs/tutorial.md", "docs/tutorial_yade.md", "docs/tutorial_fem.md", "docs/gallery.md"],
    "Do": ["docs/howto/README.md", "docs/settings.md", "docs/own_contact_law/README.md"],
    "Look up": ["docs/user_guide.md", "docs/element_tests.md", "docs/scripts.md", "docs/file_formats.md", "docs/running.md", "docs/python.md",
                "docs/other_hosts.md", "docs/remarks.md", "docs/questions.md", "docs/glossary.md", "docs/README.md"],
    "Trust": ["docs/verification.md", "docs/performance.md", "docs/adaptivity.md", "docs/hard_cases.md", "docs/hard_cells.md",
              "docs/trust.md"],
    "Theory": ["docs/theory.md", "docs/studies/README.md"],
    "Develop": ["CONTRIBUTING.md", "CHANGELOG.md"]}


def write_pages_of_the_code(source, target):
    """@returns whether doxygen is there and had nothing to say"""
    if shutil.which("doxygen") is None:
        return False
    target.mkdir(parents=True)
    settings = (source / "docs/Doxyfile").read_text() + f"\nOUTPUT_DIRECTORY = {target}\n"
    return subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=source, check=False).returncode == 0


def main(source, folder, code):
    if shutil.which("mkdocs") is None:
        print("skipped: there is no mkdocs")
        return 77
    pages = folder / "pages"
    shutil.rmtree(folder, ignore_errors=True)
    missing = []
    waiting = [source / name for names in MENU.values() for name in names]
    seen = set(waiting)
    while waiting:
        file = waiting.pop()
        target = pages / file.relative_to(source)
        target.parent.mkdir(parents=True, exist_ok=True)
        if file.suffix != ".md":
            shutil.copyfile(file, target)
            continue

        def followed(match):
            start, link, place = match.group(1), match.group(2), match.group(3) or ""
            if re.match(r"[a-z]+:", link):
                return match.group(0)
            to = (file.parent / link).resolve()
            if to.is_dir() and (to / "README.md").exists():
                to = to / "README.md"
                link = link.rstrip("/") + "/README.md"
            if not to.is_file() or not to.is_relative_to(source):
                if not to.is_dir():
                    missing.append(f"{file.relative_to(source)}: {link}")
                return match.group(0).split("](")[0] + "](#)" if to.is_dir() else match.group(0)
            if to not in seen:
                seen.add(to)
                waiting.append(to)
            return f"{start}{link}{place})"

        target.write_text(LINK.sub(followed, file.read_text()))
    menu = "".join(f"  - {title}:\n" + "".join(f"    - {name}\n" for name in names) for title, names in MENU.items())
    if code and write_pages_of_the_code(source, pages / "code"):
        menu += "    - The code: code/html/index.html\n"
    (folder / "mkdocs.yml").write_text(
        "site_name: polargrain\ndocs_dir: pages\nsite_dir: site\nuse_directory_urls: false\ntheme: {name: mkdocs, highlightjs: false}\n"
        f"plugins: [search]\nnav:\n{menu}")
    run = subprocess.run(["mkdocs", "build", "--quiet", "--strict", "-f", str(folder / "mkdocs.yml")], text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    for line in missing:
        print(f"no such file: {line}")
    print(run.stdout, end="")
    if not (missing or run.returncode):
        print(folder / "site/index.html")
    return 1 if missing or run.returncode else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), "--code" in sys.argv[3:]))
