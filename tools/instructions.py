#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many instructions a step of three scenes takes, by callgrind, beside what is recorded: unlike times,
these counts are the same in every run. A step that takes over 5 % more than recorded is a failure, until the
reason is recorded with --accept. Exit 0: within bounds; 1: more, or it cannot be measured."""

import argparse
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RECORD = ROOT / "tests/golden/instructions.json"
# Steps: enough that the bodies meet, few enough for callgrind, which is some fifty times slower.
SCENES = {"awake_300": 60, "polygons_1k": 40, "gas": 60}
BOUND = 0.05
# Lanes of one width on every machine: counts follow from it.
LANES = "16"


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/instructions.py", description=__doc__)
    parser.add_argument("--build", default="build/release", help="where bin/tamias_bench is")
    parser.add_argument("--accept", metavar="REASON", help="record the counts of now, and why they changed")
    args = parser.parse_args()
    faults = check(Path(args.build), args.accept)
    print("\n".join(faults), file=sys.stderr)
    return 1 if faults else 0


def check(build: Path, reason: str | None = None) -> list[str]:
    """What is wrong, a line each. Prints a row a scene."""
    program = ROOT / build / "bin/tamias_bench"
    if not program.exists():
        return [f"{program.name} is not there: ./dev build release -DTAMIAS_BUILD_BENCH=ON tamias_bench"]
    if shutil.which("valgrind") is None:
        return ["valgrind is not here: apt-get install valgrind"]
    try:
        with ThreadPoolExecutor(os.cpu_count() or 2) as pool:
            now = dict(zip(SCENES, pool.map(lambda scene: measure(program, scene, SCENES[scene]), SCENES)))
    except subprocess.CalledProcessError as error:
        return [f"{error.cmd[-3]}: callgrind failed: {(error.stderr or error.stdout)[-500:]}"]

    compiler = compiler_of(ROOT / build)
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {"accepted": []}
    for scene, counts in now.items():
        print(row(scene, counts, record.get("scenes", {}).get(scene)))
    if reason is not None:
        return accept(record, compiler, now, reason)
    if record.get("compiler") != compiler:
        print(f"    recorded with {record.get('compiler')}, this is {compiler}: shown, not compared")
        return []
    return [fault for scene in now for fault in compare(scene, now[scene], record["scenes"].get(scene))]


def measure(program: Path, scene: str, steps: int) -> dict:
    """Instructions of all steps, by body and by contact at the end."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--dump-instr=no",
                   "--collect-atstart=no", "--toggle-collect=tamias2d::f32::World::step(*", program, scene,
                   "--steps", str(steps)]
        done = subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True,
                              env=os.environ | {"TAMIAS_LANES": LANES})
        line = json.loads(done.stdout.splitlines()[-1])
        total = int(re.search(r"^(?:summary|totals): (\d+)", out.read_text(), re.M)[1])
    step = total / steps
    return {"steps": steps, "bodies": line["bodies"], "contacts": line["contactsAtEnd"],
            "perStep": round(step), "perBody": round(step / line["bodies"], 1),
            "perContact": round(step / line["contactsAtEnd"], 1) if line["contactsAtEnd"] >= 100 else None}


def compiler_of(build: Path) -> str:
    """The compiler and processor, as far as counts depend on them."""
    cache = (build / "CMakeCache.txt").read_text()
    path = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.M)[1]
    first = subprocess.run([path, "--version"], check=True, capture_output=True, text=True).stdout.splitlines()[0]
    return f"{first.split(' ', 1)[0].replace('c++', 'g++') if 'g++' not in first else 'g++'} " \
           f"{re.search(r'[0-9]+[.][0-9]+[.][0-9]+', first)[0]} {platform.machine()}"


def row(scene: str, now: dict, before: dict | None) -> str:
    change = f"{100 * (now['perStep'] / before['perStep'] - 1):+6.2f} %" if before else "   new  "
    contact = f"  {now['perContact']:>9,.0f} a contact" if now["perContact"] else ""
    return (f"    {scene:<15} {now['perStep']:>12,} instructions a step {change}  {now['perBody']:>9,.0f} a body"
            f"{contact}")


def compare(scene: str, now: dict, before: dict | None) -> list[str]:
    if before is None:
        return [f"{scene} has no record: tools/instructions.py --accept \"REASON\""]
    if now["perStep"] <= before["perStep"] * (1 + BOUND):
        return []
    return [f"{scene}: a step takes {now['perStep']:,} instructions, {before['perStep']:,} are recorded, "
            f"{100 * BOUND:.0f} % more would be accepted. If it is worth it, say why: "
            f"python3 tools/instructions.py --accept \"REASON\", and commit {RECORD.relative_to(ROOT)}."]


def accept(record: dict, compiler: str, now: dict, reason: str) -> list[str]:
    if len(reason.split()) < 3:
        return ["--accept wants a reason, in words"]
    before = record.get("scenes", {})
    changes = {scene: f"{100 * (counts['perStep'] / before[scene]['perStep'] - 1):+.1f} %"
               for scene, counts in now.items() if scene in before and record.get("compiler") == compiler}
    record["accepted"] = [*record.get("accepted", []), {"reason": reason, "changes": changes}]
    RECORD.write_text(json.dumps({"compiler": compiler, "scenes": now, "accepted": record["accepted"]}, indent=1) + "\n")
    print(f"    recorded in {RECORD.relative_to(ROOT)}")
    return []


if __name__ == "__main__":
    sys.exit(main())
