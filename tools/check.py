#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Everything CI checks besides the tests, at your desk: ./dev check. Exit 0 all well, 1 a check failed."""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import check_layers
import check_trace
import doc_snippets
import instructions

ROOT = Path(__file__).resolve().parent.parent
CODE_FOLDERS = ("include", "src", "apps", "tests", "examples")
# The layers that must give the same bits everywhere, print nothing and never end the process.
FREE_LAYERS = ("scene",)

# The C library's transcendental functions differ in their last bits from one to the next, and a fused
# multiply-add rounds once where two operations round twice. sqrt, floor, fmod and their like are exact.
BANNED = {
    "libm": r"(?<![\w.>])(?:std::|::)?(?:a?(?:sin|cos|tan)h?|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|hypot|cbrt|"
            r"erfc?|[tl]gamma|fma)[fl]?\s*\(",
    "fused multiply-add": r"\b(?:__builtin_fma\w*|_mm\d*_f(?:n?m)(?:add|sub)\w*|FP_CONTRACT)\b",
    "output": r"\b(?:iostream|std::cout|std::cerr|f?printf|f?puts|putchar)\b",
    "end of the process": r"\b(?:std::)?(?:abort|exit|quick_exit|_Exit|terminate)\s*\(|\bassert\s*\(",
    "the environment": r"\bgetenv\b",
    "chance": r"\b(?:s?rand|drand48)\s*\(|<random>|std::random_device",
    "the clock": r"<chrono>|\bclock\s*\(\s*\)|\bgettimeofday\b|\btime\s*\(\s*(?:NULL|nullptr|0|&)",
}
ALLOWED = {("src/base/timer.hpp", "the clock"), ("src/base/timer.cpp", "the clock"),
           ("src/base/lane_width.cpp", "the environment")}


def main() -> int:
    checks = {
        "format": check_format, "layers": lambda a: check_layers.check(),
        "trace": lambda a: check_trace.check(write=a.fix), "banned": check_banned, "paths": check_paths,
        "links": check_links,
        "sizes": report_sizes, "one_unit": check_one_unit,
        "snippets": lambda a: doc_snippets.check(Path(a.build).resolve()), "tidy": check_tidy,
        "instructions": lambda a: instructions.check(Path(a.build)),
    }
    parser = argparse.ArgumentParser(prog="./dev check", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="checks to run; all if none is named")
    parser.add_argument("--build", default="build/release", help=argparse.SUPPRESS)
    parser.add_argument("--fix", action="store_true", help="rewrite what can be rewritten")
    parser.add_argument("--list", action="store_true", help="name the checks")
    args = parser.parse_args()
    if args.list:
        print("\n".join(checks))
        return 0
    if unknown := [name for name in args.names if name not in checks]:
        parser.error(f"no check named {', '.join(unknown)}; there are {', '.join(checks)}")

    failed = []
    for name in args.names or checks:
        start = time.monotonic()
        faults = checks[name](args)
        print(f"{name:<10} {'FAILED' if faults else 'ok':<7} {time.monotonic() - start:5.1f} s", flush=True)
        if faults:
            failed.append(name)
            print("\n".join("    " + line for fault in faults for line in fault.splitlines()), flush=True)
    print(f"{len(failed)} checks failed: {', '.join(failed)}" if failed else "All checks passed.")
    return 1 if failed else 0


def tracked(*patterns: str) -> list[str]:
    """The files of the repository, new ones included, ignored ones not."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "--", *patterns], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\n")
    return sorted({name for name in listed if name and (ROOT / name).is_file()})


def code() -> list[str]:
    return [name for name in tracked(*CODE_FOLDERS) if name.endswith((".hpp", ".cpp"))]


def check_format(args) -> list[str]:
    tool = shutil.which("clang-format-22")
    if tool is None:
        return ["clang-format-22 is not here: apt-get install clang-format-22"]
    how = ["-i"] if args.fix else ["--dry-run", "-Werror"]
    cores, names = os.cpu_count() or 2, code()
    with ThreadPoolExecutor(cores) as pool:
        runs = list(pool.map(lambda part: subprocess.run([tool, *how, *names[part::cores]], cwd=ROOT,
                                                         capture_output=True, text=True), range(cores)))
    errors = "".join(run.stderr for run in runs)
    wrong = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error", errors, re.M)))
    if any(run.returncode for run in runs) and not wrong:
        return [errors]
    return [f"{name}: not as clang-format writes it; ./dev check --fix does" for name in wrong]


def check_tidy(args) -> list[str]:
    tool = shutil.which("clang-tidy-22")
    if tool is None:
        return ["clang-tidy-22 is not here: apt-get install clang-tidy-22"]
    # One precision is enough, and half the time. Tests build the core with other switches, too: not those.
    commands = {entry["file"]: entry for entry in json.loads((ROOT / args.build / "compile_commands.json").read_text())
                if not re.search(r"_f64\.dir|tests/CMakeFiles", entry["command"])
                and Path(entry["file"]).is_relative_to(ROOT / "src")}
    # Whether warnings are errors is for the compiler that builds; clang knows not every switch of g++.
    for entry in commands.values():
        entry["command"] = re.sub(r" -Werror(?=\s)", "", entry["command"])
    database = ROOT / args.build / "tidy"
    database.mkdir(exist_ok=True)
    units = tidy_units(commands, database)
    (database / "compile_commands.json").write_text(json.dumps(units))

    def run(unit: dict) -> str:
        done = subprocess.run([tool, "-p", database, f"--config-file={ROOT / '.clang-tidy'}", "--quiet",
                               "--warnings-as-errors=*", "--checks=-bugprone-suspicious-include",
                               r"--header-filter=(include|src)/.*\.[ch]pp", unit["file"]], cwd=ROOT,
                              capture_output=True, text=True)
        return done.stdout or done.stderr if done.returncode else ""

    with ThreadPoolExecutor(os.cpu_count() or 2) as pool:
        return sorted({text for text in pool.map(run, units) if text})


def tidy_units(commands: dict, folder: Path) -> list[dict]:
    """The sources of the core, some dozens to a unit that includes them: most of the time goes into headers. Each
    switch has units of its own, as has each source of a layer that is not made to be one unit with others."""
    groups: dict[str, list[str]] = {}
    for name, entry in sorted(commands.items()):
        switches = re.sub(r" -o \S+ -c \S+", "", entry["command"])
        alone = Path(name).relative_to(ROOT / "src").parts[0] in FREE_LAYERS
        groups.setdefault(switches + (" # " + name if alone else ""), []).append(name)
    units = []
    for switches, names in groups.items():
        parts = max(1, round(len(names) / 24))
        for part in range(parts):
            unit = folder / f"unit{len(units)}.cpp"
            included = names[len(names) * part // parts:len(names) * (part + 1) // parts]
            unit.write_text("".join(f'#include "{name}"\n' for name in included))
            units.append({"directory": commands[names[0]]["directory"], "file": str(unit),
                          "command": f"{switches.split(' # ')[0]} -o {unit}.o -c {unit}"})
    return units


def check_one_unit(args) -> list[str]:
    """The core may be built as one unit (the matrix of builds does so): no two of its files give things of their own
    one name."""
    compiler = shutil.which("clang++-22") or shutil.which("g++")
    if compiler is None:
        return ["clang++-22 is not here: apt-get install clang-22"]
    names = [name for name in tracked("src/*.cpp") if name.split("/")[1] not in FREE_LAYERS]
    command = [compiler, "-std=c++20", "-fsyntax-only", "-Iinclude", "-Isrc", "-Wno-psabi", "-x", "c++", "-"]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True,
                         input="".join(f'#include "{ROOT / name}"\n' for name in names))
    errors = [line.replace(f"{ROOT}/", "") for line in run.stderr.splitlines() if ": error: " in line]
    return errors or ([run.stderr] if run.returncode else [])


def check_banned(args) -> list[str]:
    faults = []
    for name in tracked("src"):
        if not name.endswith((".hpp", ".cpp")) or name.split("/")[1] in FREE_LAYERS:
            continue
        for number, line in enumerate(without_comments((ROOT / name).read_text()).splitlines(), 1):
            for what, pattern in BANNED.items():
                if (match := re.search(pattern, line)) and (name, what) not in ALLOWED:
                    faults.append(f"{name}:{number}: {match[0].strip()} is banned from the core ({what})")
    return faults


def without_comments(text: str) -> str:
    """The code with comments and string literals blanked, line for line."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
    return pattern.sub(lambda m: m[0] if m[0].startswith('"') and "include" in line_start(m)
                       else "\n" * m[0].count("\n"), text)


def line_start(match: re.Match) -> str:
    text = match.string
    return text[text.rfind("\n", 0, match.start()) + 1:match.start()]


def check_paths(args) -> list[str]:
    """No file names a place of one machine."""
    place = re.compile(r"(?<![\w.:/~}])/(?:work|home|root|Users)/\w")
    faults = []
    for name in tracked():
        try:
            lines = (ROOT / name).read_text().splitlines()
        except UnicodeDecodeError:
            continue
        faults += [f"{name}:{number}: an absolute path: {line.strip()[:80]}" for number, line in enumerate(lines, 1)
                   if place.search(line)]
    return faults


def check_links(args) -> list[str]:
    """Every file that a page links to, or shows, is there."""
    link = re.compile(r"\]\((?!https?:|mailto:|#)([^)\s#]+)")
    # Code is no prose: a lambda looks like a link. A fence may be indented, in a list.
    code = re.compile(r"^ *(?P<fence>```+|~~~+).*?^ *(?P=fence)|`[^`\n]*`", re.M | re.S)
    faults = []
    for page in tracked("*.md"):
        prose = code.sub(lambda block: "\n" * block[0].count("\n"), (ROOT / page).read_text())
        for number, line in enumerate(prose.splitlines(), 1):
            faults += [f"{page}:{number}: {target} is not there" for target in link.findall(line)
                       if not ((ROOT / page).parent / target).exists()]
    return faults


def report_sizes(args) -> list[str]:
    """Says which files are over 500 lines, where a reviewer asks which two things they are. Never fails."""
    for name in code():
        lines = (ROOT / name).read_text().count("\n")
        if lines > 500:
            print(f"    {name}: {lines} lines")
    return []


if __name__ == "__main__":
    sys.exit(main())
