#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Joins what is required with what proves it, and writes docs/trace.md.

Required: the ids in the first column of the tables of docs/requirements.md and the decisions ADRn in
docs/decisions/. Proof: the TRACES("...") of the tests. An id without a test, a test that cites an unknown
id, and a trace.md that is out of date are faults. An NFR needs no test but a page that its row links to.

    check_trace.py [--write]     exit 1 if there is any fault"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
REQUIREMENTS = ROOT / "docs" / "requirements.md"
TRACE = ROOT / "docs" / "trace.md"
ROW = re.compile(r"^\| *([A-Z]+[0-9]*(?:-\w+)?) *\| *(.+?) *\| *(.+?) *\|$")
TEST = re.compile(r"^\s*(?:TEST|TEST_F|TEST_P|TYPED_TEST)\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.M)
CITES = re.compile(r"\bTRACES\(([^)]*)\)")
SUFFIXES = {".cpp", ".hpp", ".sh", ".py", ".mjs", ".js"}


def main() -> int:
    faults = check(write="--write" in sys.argv[1:])
    for fault in faults:
        print(fault)
    return 1 if faults else 0


def check(write: bool = False) -> list[str]:
    required, faults = read_requirements()
    proofs: dict[str, list[tuple[str, str]]] = {}
    for name, path, ids in read_tests():
        for one in ids:
            if one not in required:
                faults.append(f"{path}: {name} cites {one}, which nothing declares")
            proofs.setdefault(one, []).append((name, path))

    for one, (asks, shown) in required.items():
        if one.startswith("NFR"):
            pages = re.findall(r"\]\(([^)#]+)", shown)
            faults += [f"{one}: {page} is not there" for page in pages if not (REQUIREMENTS.parent / page).exists()]
            if not pages:
                faults.append(f"{one}: its row names no page that shows it")
        elif one not in proofs:
            faults.append(f"{one}: no test proves it ({asks})")

    text = table(required, proofs)
    if write:
        TRACE.write_text(text)
    elif not TRACE.exists() or TRACE.read_text() != text:
        faults.append("docs/trace.md is out of date: run ./dev check --fix")
    return faults


def read_requirements() -> tuple[dict[str, tuple[str, str]], list[str]]:
    required, faults = {}, []
    for number, line in enumerate(REQUIREMENTS.read_text().splitlines(), 1):
        if (match := ROW.match(line)) and match[1] != "ID":
            if match[1] in required:
                faults.append(f"docs/requirements.md:{number}: {match[1]} is there twice")
            required[match[1]] = (match[2], match[3])
    for path in sorted((ROOT / "docs" / "decisions").glob("ADR*.md")):
        number = re.match(r"ADR0*(\d+)", path.name)[1]
        title = path.read_text().splitlines()[0].lstrip("# ")
        required[f"ADR{number}"] = (title.split(": ", 1)[-1], f"[decision](decisions/{path.name})")
    return required, faults


def read_tests():
    """Yields (name of the test, path, ids) for each citation under tests/."""
    for path in sorted((ROOT / "tests").rglob("*")):
        if path.suffix not in SUFFIXES or "node_modules" in path.parts or path.name == "traces.hpp":
            continue
        text = path.read_text()
        names = [(match.start(), f"{match[1]}.{match[2]}") for match in TEST.finditer(text)]
        for match in CITES.finditer(text):
            before = [name for start, name in names if start < match.start()]
            ids = re.findall(r'["\']([^"\']+)["\']', match[1])
            yield (before[-1] if before else path.name, str(path.relative_to(ROOT)), ids)


def table(required, proofs) -> str:
    lines = ["<!-- Written by tools/check_trace.py; ./dev check --fix makes it anew. -->",
             "# What proves what", "",
             "Every id of [requirements.md](requirements.md) and of [decisions](decisions), and the tests that cite",
             "it. Each test runs in both precisions, unless its name or file says otherwise.", "",
             "| ID | asks | shown by |", "|---|---|---|"]
    for one, (asks, shown) in required.items():
        tests = sorted(set(proofs.get(one, [])))
        by_file: dict[str, list[str]] = {}
        for name, path in tests:
            by_file.setdefault(path, []).append(name)
        cells = [f"[{', '.join(names)}](../{path})" for path, names in by_file.items()]
        lines.append(f"| {one} | {asks} | {'<br>'.join(cells) if cells else shown} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
