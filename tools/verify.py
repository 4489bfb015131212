#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/verification.md: runs tamias_verify, runs Pymunk, and tables both. Started by ./dev verify.

verify.py [--build DIR] [--json FILE]     --json: take the figures of an earlier run instead of a new one
Exit 0 written, 1 an experiment or Pymunk could not be run, 2 bad usage."""

import argparse
import json
import math
import re
import subprocess
import sys
import venv
from pathlib import Path

import check_trace

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "verification.md"
PYMUNK = "pymunk==7.3.1"

HOW_TO_READ = """\
<!-- Written by tools/verify.py; ./dev verify makes it anew. -->
# Verification

Each experiment is one scene, built with the same numbers in every engine and measured by code that belongs
to none of them ([apps/verify](../apps/verify)). `./dev verify` makes this page anew; it takes some minutes.

* Behind each value stands its difference from the reference, in percent of the reference; where the
  reference is 0, in percent of what the text of the group says. `0 %` means equal in all bits that are kept.
* A reference is a closed form, or what an ideal rigid body does. "-" means that the engine
  cannot do it, or that there is nothing to measure as the stack fell.
* All engines take 60 steps a second, with their defaults and sleeping off. One step of each makes about as
  many passes over its contacts.
* Chipmunk and Box2D are Debian's packages. Chipmunk's core is the one that Pymunk grew from.
* Rows where another engine comes closer are listed [below](#where-another-engine-comes-closer), by the program.
"""

TIMES = """\
## Time

Milliseconds a step with Debian's builds of Chipmunk and Box2D (Chipmunk's has its run-time checks on), one
thread. The engines take turns five times; given are the medians, and of each turn's ratio to Chipmunk. The
ratio is for orientation: one machine, and the scenes of this page.
"""

CORES = """\
## Pymunk and Debian's Chipmunk

Pymunk {pymunk} from PyPI (its core calls itself {core}) runs three of the scenes, as Chipmunk 7.0.3 does
above. Given are the largest differences between the two in the place and the velocity of any body, and the
total energy of both. A gas is chaotic: a difference in the last bit grows until the places have nothing in
common; its energy is what can be compared.
"""

TRACE = """\
## Requirements

Every id of the SRS and the tests that prove it; `./dev test` runs them, in both precisions. The same table
with what each id asks is [trace.md](trace.md).
"""


def main() -> int:
    parser = argparse.ArgumentParser(prog="./dev verify", description=__doc__)
    parser.add_argument("--build", default="build/release", help="where tamias_verify was built")
    parser.add_argument("--json", help="take the figures of this file instead of running the experiments")
    args = parser.parse_args()
    build = Path(args.build).resolve()
    try:
        figures = Path(args.json) if args.json else run_experiments(build)
        results = json.loads(figures.read_text())
        text = page(results, run_pymunk(figures))
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        print(f"verify: {error}", file=sys.stderr)
        return 1
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(text)
    print(f"{PAGE.relative_to(ROOT)}: {len(all_rows(results))} rows")
    return 0


# --- running


def run_experiments(build: Path) -> Path:
    figures = build / "verify.json"
    subprocess.run([build / "bin" / "tamias_verify", "-o", figures], check=True)
    return figures


def run_pymunk(figures: Path) -> dict:
    """Pymunk lives in an environment of its own under build/, so that nothing else is touched."""
    folder, out = ROOT / "build" / "venv", figures.with_name("pymunk.json")
    python = folder / "bin" / "python"
    if not python.exists():
        venv.create(folder, with_pip=True)
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", PYMUNK], check=True)
    subprocess.run([python, ROOT / "tools" / "verify_pymunk.py", figures, out], check=True)
    return json.loads(out.read_text())


# --- the page


def page(results: dict, pymunk: dict) -> str:
    engines = results["engines"]
    parts = [HOW_TO_READ, table(["Engine", "a step", "calculates in"],
                                [[e["title"], e["settings"], e["precision"]] for e in engines]), overview(results)]
    for group in results["groups"]:
        parts.append(f"## {group['title']}\n\n{group['text']}\n")
        parts.append(table(["Experiment", "Quantity", "Reference", *(f"{e['title']} (diff)" for e in engines)],
                           group_rows(group["rows"], engines)))
    parts += [CORES.format(pymunk=pymunk["pymunk"], core=pymunk["core"].split("-")[0]), cores_table(pymunk["rows"]),
              TIMES, times_table(results), TRACE, trace_table()]
    return "\n".join(parts)


def group_rows(rows: list[dict], engines: list[dict]):
    before = None
    for row in rows:
        unit = f" [{row['unit']}]" if row["unit"] not in ("", "1") else ""
        cells = [row["experiment"] if row["experiment"] != before else "", row["quantity"] + unit,
                 number(row["reference"], row["unit"])]
        yield cells + [with_difference(row, e["key"]) for e in engines]
        before = row["experiment"]


def overview(results: dict) -> str:
    """How often each engine is within so much of the reference, and where a peer is ahead."""
    engines = results["engines"]
    rows = [row for row in all_rows(results) if difference(row, "f64") is not None]
    limits = (1e-6, 0.01, 0.1, 1.0, 10.0)
    counts = []
    for engine in engines:
        misses = [abs(d) for row in rows if (d := difference(row, engine["key"])) is not None]
        counts.append([engine["title"], *(str(sum(m <= limit for m in misses)) for limit in limits), str(len(misses))])
    header = ["rows within", *(f"{limit:g} %" for limit in limits), "of"]
    return "\n".join([table(header, counts), "### Where another engine comes closer", "",
                      "Rows in which Chipmunk or Box2D is nearer to the reference than Tamias2D f64, by more than",
                      "1e-6 %; for rows without a percentage, nearer to zero and above 1e-12.", "",
                      table(["Experiment", "Quantity", "Tamias2D f64", "closest"], list(behind(results)))])


def behind(results: dict):
    for row in all_rows(results):
        ours = miss(row, "f64")
        peers = [(miss(row, e["key"]), e) for e in results["engines"] if e["key"] not in ("f64", "f32")]
        peers = [(m, e) for m, e in peers if m is not None]
        if ours is None or not peers:
            continue
        best, engine = min(peers, key=lambda peer: peer[0])
        if ours > best + (1e-6 if difference(row, "f64") is not None else 1e-12):
            yield [row["experiment"], row["quantity"], with_difference(row, "f64"),
                   f"{engine['title']}: {with_difference(row, engine['key'])}"]


def cores_table(rows: list[dict]) -> str:
    cells = [[row["scene"], f"{row['time']:g} s", f"{row['place']:.3g} m", f"{row['speed']:.3g} m/s",
              f"{row['chipmunk']:.6g} J", f"{row['pymunk']:.6g} J",
              percent(100 * (row["pymunk"] - row["chipmunk"]) / row["chipmunk"])] for row in rows]
    return table(["Scene", "after", "places differ by", "velocities by", "Chipmunk's energy", "Pymunk's", "diff"],
                 cells)


def times_table(results: dict) -> str:
    engines = results["engines"]
    rows = [[row["scene"], *(f"{row['engines'][e['key']]['ms']:.3f} ms (x {row['engines'][e['key']]['ratio']:.2f})"
                             for e in engines)] for row in results["timing"]]
    return table(["Scene", *(f"{e['title']} (ratio)" for e in engines)], rows)


def trace_table() -> str:
    required, _ = check_trace.read_requirements()
    proofs: dict[str, dict[str, list[str]]] = {}
    for name, path, ids in check_trace.read_tests():
        for one in ids:
            proofs.setdefault(one, {}).setdefault(path, []).append(name)
    rows = []
    for one, (_, shown) in required.items():
        if one.startswith("ADR"):
            continue
        tests = [f"[{', '.join(sorted(set(names)))}](../{path})" for path, names in sorted(proofs.get(one, {}).items())]
        rows.append([one, "<br>".join(tests) or shown])
    return table(["ID", "proven by"], rows)


# --- figures


def all_rows(results: dict) -> list[dict]:
    return [row for group in results["groups"] for row in group["rows"]]


def difference(row: dict, engine: str) -> float | None:
    """In percent of the row's scale; None where the row has no percentage or the engine no value."""
    value, reference = row["values"][engine], row["reference"]
    scale = row["scale"] if row["scale"] is not None else abs(reference or 0)
    if value is None or reference is None or not scale:
        return None
    return 100 * (value - reference) / scale


def miss(row: dict, engine: str) -> float | None:
    """How far off, for comparing engines within a row."""
    if (percents := difference(row, engine)) is not None:
        return abs(percents)
    value = row["values"][engine]
    return None if value is None else abs(value - (row["reference"] or 0))


def with_difference(row: dict, engine: str) -> str:
    value, percents = row["values"][engine], difference(row, engine)
    text = number(value, row["unit"])
    return text if percents is None else f"{text} ({percent(percents)})"


def percent(value: float) -> str:
    return "0 %" if value == 0 else f"{value:+.2g} %" if abs(value) < 99.5 else f"{value:+.0f} %"


def number(value: float | None, unit: str) -> str:
    """Six digits; lengths in mm are read to the micrometre, no further."""
    if value is None:
        return "-"
    if not math.isfinite(value):
        return str(value)
    if unit == "mm":
        value = round(value, 3)
    return re.sub(r"e([+-])0?(\d)", r"e\1\2", f"{value + 0.0:.6g}")


def table(header: list[str], rows) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
