#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles and runs the programs in the docs: each ```cpp block with an `int main` in README.md and docs/.

What it prints must be the ```text block that follows it, if the next block is one. A block after the line
<!-- file: examples/x.cpp --> must be that file, word for word.

    doc_snippets.py --build BUILD_DIR        check all; exit 1 if there is any fault
    doc_snippets.py --extract FILE OUT_DIR   the first program of FILE to program.cpp, its output to expected.txt"""

import argparse
import difflib
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"^(?:<!-- file: (?P<file>\S+) -->\n)?```(?P<kind>\w*)[^\n]*\n(?P<text>.*?)^```$", re.M | re.S)


@dataclass
class Program:
    path: Path
    line: int
    text: str
    expected: str | None
    file: str | None

    @property
    def name(self) -> str:
        return f"{self.path.relative_to(ROOT)}:{self.line}"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build")
    parser.add_argument("--extract", nargs=2)
    args = parser.parse_args()
    if args.extract:
        program = programs(Path(args.extract[0]).resolve())[0]
        out = Path(args.extract[1])
        (out / "program.cpp").write_text(program.text)
        (out / "expected.txt").write_text(program.expected or "")
        return 0
    faults = check(Path(args.build).resolve())
    for fault in faults:
        print(fault)
    return 1 if faults else 0


def check(build: Path) -> list[str]:
    faults = []
    out = build / "snippets"
    out.mkdir(parents=True, exist_ok=True)
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
    found = [program for page in pages for program in programs(page)]
    with ThreadPoolExecutor(os.cpu_count() or 2) as pool:
        stems = (out / f"snippet{number}" for number in range(len(found)))
        runs = pool.map(lambda program, stem: compile_and_run(program, build, stem), found, stems)
        for program, fault in zip(found, runs):
            if program.file and (ROOT / program.file).read_text() != program.text:
                faults.append(f"{program.name}: is not what {program.file} says")
            if fault:
                faults.append(f"{program.name}: {fault}")
    return faults


def programs(page: Path) -> list[Program]:
    text = page.read_text()
    blocks = list(BLOCK.finditer(text))
    found = []
    for block, following in zip(blocks, blocks[1:] + [None]):
        if block["kind"] == "cpp" and "int main" in block["text"]:
            expected = following["text"] if following and following["kind"] == "text" else None
            line = text.count("\n", 0, block.start()) + 1
            found.append(Program(page, line, block["text"], expected, block["file"]))
    return found


def compile_and_run(program: Program, build: Path, stem: Path) -> str | None:
    suffix = "_f64" if "TAMIAS_F64" in program.text else ""
    libraries = [f"tamias2d{suffix}"]
    if "tamias2d/scene/" in program.text:
        libraries.insert(0, f"tamias2d_scene{suffix}")
    archives = [next(build.rglob(f"lib{name}.a"), None) for name in libraries]
    if missing := [name for name, archive in zip(libraries, archives) if archive is None]:
        return f"needs {' and '.join(missing)}, which {build} does not hold: build the target first"
    source = stem.with_suffix(".cpp")
    source.write_text(program.text)
    compiled = subprocess.run(
        ["c++", "-std=c++20", "-ffp-contract=off", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{ROOT / 'include'}", source,
         "-o", stem, *archives], capture_output=True, text=True)
    if compiled.returncode:
        return "does not compile:\n" + compiled.stderr
    try:
        ran = subprocess.run([stem], capture_output=True, text=True, timeout=60, cwd=ROOT)
    except subprocess.TimeoutExpired:
        return "runs for more than 60 s"
    if ran.returncode:
        return f"ends with exit code {ran.returncode}\n{ran.stderr}"
    if program.expected is not None and ran.stdout != program.expected:
        return "prints other lines than the page says\n" + "\n".join(difflib.unified_diff(
            program.expected.splitlines(), ran.stdout.splitlines(), "page", "program", lineterm="", n=0))
    return None


if __name__ == "__main__":
    sys.exit(main())
