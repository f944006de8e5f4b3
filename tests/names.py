#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Refuses names that two files of one library hide in nameless namespaces: such files cannot be compiled as one.

Which files are compiled together changes with every new file; a name that is its own stays so. Functions may share a name
where their parameters differ, aliases where they name the same.
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Comments, and all that may hold braces and is no code.
TEXTS = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|//[^\n]*', re.DOTALL)
LIBRARIES = ["app", "band", "common", "coupler", "dem", "element", "fem", "grains_io"]


def hidden_declarations(text):
    """Beginnings of the declarations in the nameless namespaces of a source: what stands before a body, or before a semicolon."""
    text = TEXTS.sub("", text)
    for opened in re.finditer(r"^namespace \{$", text, re.MULTILINE):
        depth, declaration = 1, ""
        for letter in text[opened.end():]:
            if depth == 1 and letter in "{;":
                yield " ".join(declaration.split())
                declaration = ""
            elif depth == 1 and letter != "}":
                declaration += letter
            depth += (letter == "{") - (letter == "}")
            if depth == 0:
                break


def hidden_name(declaration):
    """What a declaration takes for itself, or nothing: 'class Reader', 'kFar', 'name_of(fem::Dof)'."""
    plain = re.sub(r"^template <[^>]*> ?", "", declaration)
    if found := re.match(r"(?:class|struct|enum class) (\w+)", plain):
        return f"class {found[1]}"
    if found := re.match(r"(?:inline |static )*(?:constexpr|const) [^(]*?(k[A-Z]\w*)", plain):
        return found[1]
    if found := re.match(r"(?!using)[^=(]*[ &*](\w+)\((.*)\)(?: noexcept)?$", plain):
        types = re.sub(r"<[^<>]*>", "", re.sub(r"<[^<>]*>", "", found[2]))
        # Without namespaces: a type may be written with and without.
        kinds = [re.sub(r"\s*\w+$|\w+::", "", kind.split("=")[0].strip()) for kind in types.split(",")]
        return f"{found[1]}({', '.join(kinds)})" if not plain.startswith("TEST") else None
    return None


def libraries():
    """The files that may be compiled together, by library: those of the program, and those that share an executable of the tests."""
    found = {name: sorted((ROOT / name).rglob("*.cpp")) for name in LIBRARIES}
    for topic in sorted((ROOT / "tests").glob("*/*.cmake")):
        for kind, library, files in re.findall(r"polargrain_tests\((\w+) (\w+)(?: MAIN \S+)?\s+([^)]*)\)", topic.read_text()):
            found.setdefault(f"tests, {kind} of {library}", []).extend(ROOT / "tests" / name for name in files.split())
        for name, files in re.findall(r"polargrain_test\((\w+) \w+\s+([^)]*?)(?: LIBS [^)]*)?\)", topic.read_text()):
            found[f"tests, {name}"] = [ROOT / "tests" / file for file in files.split() if file.endswith(".cpp")]
    return found


faults = 0
for library, files in libraries().items():
    owners = collections.defaultdict(dict)
    for file in files:
        for name in map(hidden_name, hidden_declarations(file.read_text())):
            if name:
                owners[name][file.relative_to(ROOT)] = True
    for name, owned in owners.items():
        if len(owned) > 1:
            faults += 1
            print(f"{library}: '{name}' is hidden in {' and in '.join(map(str, owned))}: call one of them otherwise")
sys.exit(1 if faults else 0)
