#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What the words and links of the Markdown pages must keep to.

    tests/pages.py words [PAGE...]    no sentence over 30 words, 16 in the mean, 45,000 in all, no clauses without a subject;
                                      a page of docs/ begins with whom it is for
    tests/pages.py links [PAGE...]    every link leads to a file and to a heading of it; every page of docs/ is two clicks from README.md
    tests/pages.py comments         comments and texts of the sources: no clauses without a subject
    tests/pages.py paper              docs/paper has the head, sections, words and references that JOSS asks for
    tests/pages.py made               performance.md, verification.md, hard_cases.md and figures of README.md are as commands write them
    tests/pages.py keys               the reference holds every key that the code reads and every command and option that it offers

Without PAGE: all pages that git knows. Tables, code and headings are no sentences; code and the bars of tables are no words.
The paper (docs/paper) is not documentation: its words are not in the sum.
"""
import collections
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST_WORDS = 45000
LONGEST_SENTENCE = 30
MEAN_SENTENCE = 16.0
README_WORDS = 700
HEADLESS = re.compile(r"\b(is|are) none\b|\bwhat is not\b|, what is \w+ed\b|\bas is (none|what)\b|\bthat are none\b|^(What|None) (is|are|was|were|has|of) ", re.M)


# In comments and messages. A clause needs its noun: not "there is none", "empty: none", "@returns what ...", "those of the packing".
HEADLESS_IN_CODE = re.compile(
    r"(?<![`'\"\w:.<-])none\b(?![`'\"])"
    r"|, what is \w+ed\b|\bwhat (of it|is not)\b|\bas is what\b"
    r"|(^|[.;] |@returns? |@param \w+ |[:;] )(What|what|That of|that of|Those of|those of)\b(?![^.]*\?)"
    r"|(^|[,;:] |\band )what (?:[\w'-]+ ){1,9}(is|are|was|were|has|have|says?|belongs?|loads?) (no|not|an?|the|that|cut|gone|exact|void|one|nothing|there|left|only|said)\b")
# Words of a script or a case, not of a sentence.
TERMS = re.compile(r"-log none\b|\b0 none, 1 Voigt|\blp: none\b|^(none|what)$")


def without_code(text):
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"```.*?```", "", text, flags=re.S)
    return re.sub(r"^    .*$", "", text, flags=re.M)


def sentences(text):
    text = re.sub(r"^(\||#).*$", ".\n", without_code(text), flags=re.M)
    text = re.sub(r"^\s*([-*]|\d+\.) ", "\n\n", text, flags=re.M)
    found = re.split(r"(?<=[.!?:])\s+(?=[A-Z`*\"(\[])|\n\s*\n", text)
    return [sentence for sentence in found if len(sentence.split()) > 3]


def all_pages():
    listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.split()
    if not listed:  # sources without their history
        return [page for page in sorted(ROOT.rglob("*.md")) if "build" not in page.relative_to(ROOT).parts]
    return [ROOT / name for name in listed if (ROOT / name).is_file()]


def check_words(pages, whole):
    faults, lengths, total = [], [], 0
    for page in pages:
        text = page.read_text(encoding="utf-8")
        name = page.relative_to(ROOT)
        total += 0 if "paper" in name.parts else len(re.findall(r"\S*\w\S*", without_code(text)))  # bars of tables are no words
        if str(name) == "README.md" and len(text.split()) > README_WORDS:
            faults.append(f"{name}: {len(text.split())} words, at most {README_WORDS}")
        beginning = text.split("\n## ")[0][:700]
        if name.parts[0] == "docs" and "paper" not in name.parts and not re.search(r"\bFor [A-Za-z]", beginning):
            faults.append(f"{name}: its first lines do not say for whom it is")
        found = sentences(text)
        of_page = [len(sentence.split()) for sentence in found]
        lengths += of_page
        for sentence, length in zip(found, of_page):
            if length > LONGEST_SENTENCE:
                faults.append(f"{name}: a sentence of {length} words: {' '.join(sentence.split()[:9])} ...")
        for hit in HEADLESS.finditer(without_code(text)):
            faults.append(f"{name}: a clause without a subject: '{hit.group(0)}'")
    mean = sum(lengths) / max(1, len(lengths))
    if mean > MEAN_SENTENCE:
        faults.append(f"the mean sentence has {mean:.1f} words, at most {MEAN_SENTENCE:.0f}")
    if whole and total > MOST_WORDS:
        faults.append(f"{total} words in all, at most {MOST_WORDS}")
    print(f"{len(pages)} pages, {total} words, {len(lengths)} sentences, {mean:.1f} words in the mean")
    return faults


def anchor(heading):
    """The name that GitHub and mkdocs give a heading."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", plain.strip().lower()).replace(" ", "-")


def anchors(page):
    names, counts = set(), collections.Counter()
    for heading in re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S), re.M):
        name = anchor(heading)
        names.add(f"{name}-{counts[name]}" if counts[name] else name)
        counts[name] += 1
    return names


def links(page):
    """Pairs of a file and a place in it that a page leads to."""
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)):
        if not re.match(r"[a-z]+:", target):
            file, _, place = target.partition("#")
            to = (page.parent / file).resolve() if file else page
            yield target, (to / "README.md" if to.is_dir() and (to / "README.md").exists() else to), place


def check_links(pages, whole):
    faults = []
    for page in pages:
        for target, to, place in links(page):
            if not to.exists():
                faults.append(f"{page.relative_to(ROOT)}: there is no '{target}'")
            elif place and to.suffix == ".md" and place not in anchors(to):
                faults.append(f"{page.relative_to(ROOT)}: '{target}': there is no such heading")
    if whole:
        near = {ROOT / "README.md"}
        for _ in range(2):
            near |= {to for page in near if page.suffix == ".md" and page.exists() for _, to, _ in links(page)}
        faults += [f"{page.relative_to(ROOT)}: more than two clicks from README.md" for page in pages
                   if page.relative_to(ROOT).parts[0] == "docs" and page not in near]
    return faults


def texts_of(source):
    """Line and text of each comment, lines that follow one another joined, and of each string, of a source."""
    mark = r"//[/<]*" if source.suffix in (".cpp", ".hpp", ".js") else r"#"
    block, first = [], 0
    for number, line in enumerate(source.read_text(encoding="utf-8").splitlines() + [""], 1):
        whole = re.match(rf"\s*{mark}( .*|$)", line)
        if whole:
            first = first if block else number
            block.append(whole.group(1).strip())
            continue
        if block:
            yield first, " ".join(block)
            block = []
        comment = re.search(rf"\s{mark} (.*)", line)
        if comment:
            yield number, comment.group(1)
        for text in re.findall(r'"((?:[^"\\]|\\.)+)"', line):
            yield number, text


def check_comments(_, __):
    """Comments and messages of the product. Python's own None begins no fault."""
    faults, count = [], 0
    folders = ["app", "band", "bench", "common", "coupler", "dem", "element", "fem", "grains_io", "python/polargrain"]
    for source in sorted(file for folder in folders for kind in ("hpp", "cpp", "js", "py") for file in (ROOT / folder).rglob("*." + kind)):
        for line, text in texts_of(source):
            count += 1
            text = TERMS.sub("", text)
            for hit in HEADLESS_IN_CODE.finditer(text):
                if not (source.suffix == ".py" and "None" in hit.group(0)):
                    faults.append(f"{source.relative_to(ROOT)}:{line}: a clause without a subject: '{text[max(0, hit.start() - 30):hit.end() + 30]}'")
    print(f"{count} comments and texts")
    return faults


PAPER_SECTIONS = ["Summary", "Statement of need", "State of the field", "Software design", "Research impact statement", "AI usage disclosure",
                  "Acknowledgements", "References"]
PAPER_WORDS = range(750, 1751)


def check_paper(_, __):
    """What JOSS asks of a paper: metadata, sections, words, and references that are cited and can be found."""
    text = (ROOT / "docs/paper/paper.md").read_text(encoding="utf-8")
    _, head, body = text.split("---\n", 2)
    faults = [f"the head has no '{key}'" for key in ("title", "tags", "authors", "affiliations", "date", "bibliography")
              if not re.search(rf"^{key}:", head, re.M)]
    sections = re.findall(r"^# (.*)$", body, re.M)
    faults += [f"there is no section '{name}'" for name in PAPER_SECTIONS if name not in sections]
    words = len(body.split())
    if words not in PAPER_WORDS:
        faults.append(f"{words} words, expected {PAPER_WORDS[0]} to {PAPER_WORDS[-1]}")
    entries = dict(re.findall(r"^@\w+\{(\w+),(.*?)^\}", (ROOT / "docs/paper/paper.bib").read_text(encoding="utf-8"), re.M | re.S))
    cited = set(re.findall(r"@(\w+)", body))
    faults += [f"'{key}' is cited and not in paper.bib" for key in sorted(cited - set(entries))]
    faults += [f"'{key}' is in paper.bib and not cited" for key in sorted(set(entries) - cited)]
    for key, entry in entries.items():
        faults += [f"'{key}' has no {field}" for field in ("author", "title", "year", "doi|url") if not re.search(rf"\b({field}) = ", entry)]
    print(f"paper: {words} words, {len(entries)} references")
    return faults


def check_made(_, __):
    """Pages that a command writes hold the figures that it keeps."""
    sys.path.insert(0, str(ROOT / "docs"))
    import make_performance  # pylint: disable=import-outside-toplevel
    import make_verification  # pylint: disable=import-outside-toplevel
    made = {"performance.md": make_performance.page(), **make_verification.pages(make_verification.kept())}
    print(f"{len(made)} pages")
    faults = [f"docs/{name}: docs/make_*.py writes another text from the kept figures" for name, text in made.items()
              if (ROOT / "docs" / name).read_text(encoding="utf-8") != text]
    return faults + figures_of_readme()


def figures_of_readme():
    """README's figures against the kept outputs of the tests that it names."""
    printed = (ROOT / "docs/data/verification.txt").read_text(encoding="utf-8")
    paths = re.findall(r"path: largest error of a normal stress ([\d.]+) % in 3 increments, ([\d.]+) % in 10", printed)
    patches = [float(error) for error in re.findall(r"^E\.1 .* relative error (\S+)$", printed, re.M)]
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    short, long = (max(float(path[k]) for path in paths) for k in (0, 1))
    faults = [] if max(patches) < 2e-14 else [f"README.md: a patch test is {max(patches)} off"]
    told = f"{short:.1f} % in 3 increments, {long:.1f} % in 10"
    return faults + ([] if told in readme else [f"README.md: the tests of paths give {told}"])


KEY = re.compile(r"\.(?:quantity|quantity_or|quantity_if|quantity_or_word|flag|quantities|whole|whole_or|wholes|pairs|text|text_or|choice|choice_or|words|find|require)"
                 r"\(\s*\"([A-Za-z]\w*)\"")
TOLD_ONCE = re.compile(r"\bKey\{\s*\.name = \"(\w+)\"")  # coupler/case/keys.hpp
CHOICES = re.compile(r"\.choice(?:_or)?\(\s*\"\w+\",\s*\{([^}]*)\}")
KEYS_OF = ["coupler/case", "app/pack", "app/element", "app/calibrate"]
REFERENCE = ["docs/user_guide.md", "docs/element_tests.md", "docs/file_formats.md", "docs/scripts.md", "docs/running.md"]


def check_keys(_, __):
    told = "\n".join((ROOT / page).read_text(encoding="utf-8") for page in REFERENCE)
    howto = told + "\n".join(page.read_text(encoding="utf-8") for page in (ROOT / "docs/howto").glob("*.md"))
    faults, count = [], 0
    for folder in KEYS_OF:
        for source in sorted(file for kind in ("cpp", "hpp") for file in (ROOT / folder).rglob("*." + kind)):
            text = source.read_text(encoding="utf-8")
            words = {word for choices in CHOICES.findall(text) for word in re.findall(r"\"(\w+)\"", choices)}
            for key in sorted((set(KEY.findall(text)) | set(TOLD_ONCE.findall(text)) | words) - {"v_"}):  # a prefix of LIGGGHTS's
                count += 1
                if not re.search(rf"\b{key}\b", told):
                    faults.append(f"{source.relative_to(ROOT)}: the key or choice '{key}' is in no table of {', '.join(REFERENCE)}")
    for source in sorted((ROOT / "app/commands").glob("*.cpp")):
        text = source.read_text(encoding="utf-8")
        names = re.findall(r"add_subcommand\(\s*\"(\w+)\"", text)
        # Of an option with a letter, -o,--output, the letter will do.
        names += re.findall(r"add_(?:option|flag)\(\s*\"(-\w|--[\w-]+)", text)
        count += len(names)
        faults += [f"{source.relative_to(ROOT)}: '{name}' is told of nowhere" for name in names if not re.search(rf"(?<![\w-]){re.escape(name)}\b", howto)]
    print(f"{count} keys, commands and options")
    return faults


def main():
    checks = {"words": check_words, "links": check_links, "comments": check_comments, "keys": check_keys, "paper": check_paper, "made": check_made}
    if len(sys.argv) < 2 or sys.argv[1] not in checks:
        print(__doc__, file=sys.stderr)
        return 2
    named = [pathlib.Path(name).resolve() for name in sys.argv[2:]]
    faults = checks[sys.argv[1]](named or all_pages(), not named)
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
