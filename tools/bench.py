#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the benchmark suite and prints a table; with --peers, beside other engines. Started by ./dev bench.

Each engine is a program of its own that runs one scene and prints a line of JSON. The programs take turns,
so that a busy moment of the machine hits all alike; a ratio is taken within a turn, then the median over the
turns. With --page it writes docs/performance.md and its picture. Exit 0 done, 1 a program failed, 2 bad usage."""

import argparse
import json
import platform
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "performance.md"
PICTURE = ROOT / "docs" / "images" / "performance.svg"
PEERS = ["bench_box2d3", "bench_box2d2", "bench_chipmunk"]
OURS = "tamias_bench"


def main() -> int:
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="names or groups; all if none is given")
    parser.add_argument("--list", action="store_true", help="name the scenes")
    parser.add_argument("--peers", action="store_true", help="run the other engines that are built too")
    parser.add_argument("--turns", type=int, default=5, metavar="N", help="of all engines (default 5)")
    parser.add_argument("--patience", type=float, default=float("inf"), metavar="SECONDS",
                        help="an engine that takes longer for a scene has no further turn of it; another than ours "
                             "that takes 20 times as long is stopped")
    parser.add_argument("--steps", type=int, metavar="N", help="a scene, instead of its own number")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="for engines that have any (default 1)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures there")
    parser.add_argument("--page", action="store_true", help="write docs/performance.md and its picture")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", help=argparse.SUPPRESS)
    args = parser.parse_args()
    programs = args.build.resolve() / "bin"
    try:
        known = json.loads(subprocess.run([programs / OURS, "--list"], check=True, capture_output=True).stdout)
        if args.list:
            print("\n".join(f"{scene['name']:<16} {scene['group']}" for scene in known))
            return 0
        names = chosen(args.scenes, known, parser)
        engines = [OURS] + [name for name in PEERS if args.peers and (programs / name).exists()]
        results = {name: measure(name, engines, programs, args) for name in names}
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        print(f"bench: {error}", file=sys.stderr)
        return 1
    record = {"machine": machine(), "threads": args.threads, "turns": args.turns, "steps": args.steps,
              "scenes": results}
    if args.json:
        args.json.write_text(json.dumps(record, indent=1) + "\n")
    if args.page:
        import bench_chart  # wants matplotlib, which nothing else here does

        PAGE.write_text(page(record))
        bench_chart.draw(record, OURS, PICTURE)
        print(f"wrote {PAGE.relative_to(ROOT)} and {PICTURE.relative_to(ROOT)}")
    return 0


def chosen(wanted: list[str], known: list[dict], parser: argparse.ArgumentParser) -> list[str]:
    names = [scene["name"] for scene in known]
    groups = {scene["group"] for scene in known}
    for word in wanted:
        if word not in names and word not in groups:
            parser.error(f"no scene or group {word}; --list names them")
    return [scene["name"] for scene in known
            if not wanted or scene["name"] in wanted or scene["group"] in wanted]


# --- measuring


def measure(scene: str, engines: list[str], programs: Path, args) -> dict:
    runs = {engine: [] for engine in engines}
    dead, slow = {}, set()
    for _ in range(args.turns):
        for engine in engines:
            if engine in dead or engine in slow:
                continue
            begun = time.monotonic()
            try:
                runs[engine].append(run_once(programs / engine, scene, args))
                if time.monotonic() - begun > args.patience:
                    slow.add(engine)
            except subprocess.TimeoutExpired as error:
                dead[engine] = f"stopped after {error.timeout:.0f} s"
            except subprocess.CalledProcessError as error:
                if engine == OURS:
                    raise
                dead[engine] = end_of(error)
    found = {}
    for engine, lines in runs.items():
        if engine in dead:
            found[engine] = {"engine": engine.removeprefix("bench_"), "died": dead[engine]}
            print(f"{scene:<15} {found[engine]['engine'][:16]:<16} {dead[engine]}", flush=True)
            continue
        times = [line["stepMs"] for line in lines]
        ratios = [line["stepMs"] / ours["stepMs"] for line, ours in zip(lines, runs[OURS])]
        middle = min(lines, key=lambda line: abs(line["stepMs"] - statistics.median(times)))
        found[engine] = middle | {"stepMs": statistics.median(times), "ratio": statistics.median(ratios),
                                  "ratioFrom": min(ratios), "ratioTo": max(ratios), "turns": len(lines)}
        print(row(scene, found[engine]), flush=True)
    return found


def end_of(error: subprocess.CalledProcessError) -> str:
    """How a program that another engine is linked to ended: most often it wanted more memory than there is."""
    if error.returncode < 0:
        return f"killed by {signal.Signals(-error.returncode).name}"
    return f"failed with exit code {error.returncode}"


def run_once(program: Path, scene: str, args) -> dict:
    command = [program, scene, "--threads", str(args.threads)]
    if args.steps:
        command += ["--steps", str(args.steps)]
    limited = program.name != OURS and args.patience < float("inf")
    limit = 20 * args.patience if limited else None
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=limit)
    return json.loads(done.stdout.splitlines()[-1])  # Chipmunk greets first


def row(scene: str, r: dict) -> str:
    phases = " ".join(f"{name} {time:.3g}" for name, time in r["phasesMs"].items())
    return (f"{scene:<15} {r['engine'][:16]:<16} {r['stepMs']:10.4f} ms  x{r['ratio']:<7.3f}"
            f" deepest {r['deepest']:.1e} KE {r['kineticEnergyPerBody']:.1e}  {phases}")


def machine() -> str:
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text().splitlines():
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
    return model


# --- the page


HOW_TO_READ = """\
<!-- Written by tools/bench.py; `./dev bench --peers --page` makes it anew. -->
# Performance

{machine}, {threads} thread(s), medians of {turns} interleaved turns (fewer where the table says so), {steps}.
Each engine runs the same scene, built
with the same numbers, in a program of its own ([apps/bench](../apps/bench)); all take 60 steps a second with
their defaults. A ratio is their time over ours: above 1, Tamias2D is faster. Overlap, joint error (the greatest
distance of two points that should be together), kinetic energy and top are measured at the end by one piece of
code for all engines; how many contacts touch is what each says. Box2D 2.4 has no springs on hinges: its ragdolls
do without.

![For each scene, the time of other engines over that of Tamias2D](images/performance.svg)
"""


def page(record: dict) -> str:
    head = ["Scene", "Engine", "turns", "ms a step", "ratio", "from - to", "ns a body", "deepest overlap [m]",
            "mean overlap [m]", "joint error [m]", "energy a body [J]", "fastest [m/s]", "top [m]", "touching"]
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    for scene, engines in record["scenes"].items():
        for r in engines.values():
            if "died" in r:
                lines.append("| " + " | ".join([scene, r["engine"], r["died"]] + [""] * (len(head) - 3)) + " |")
                continue
            cells = [scene, r["engine"], str(r["turns"]), f"{r['stepMs']:.4f}", f"{r['ratio']:.2f}",
                     f"{r['ratioFrom']:.2f} - {r['ratioTo']:.2f}", f"{1e6 * r['stepMs'] / max(r['bodies'], 1):.0f}",
                     f"{r['deepest']:.1e}", f"{r['mean']:.1e}", f"{r['jointError']:.1e}" if r["joints"] else "",
                     f"{r['kineticEnergyPerBody']:.1e}", f"{r['fastest']:.1e}", f"{r['top']:.2f}",
                     str(r["contactsAtEnd"]) if r["contactsAtEnd"] >= 0 else ""]
            lines.append("| " + " | ".join(cells) + " |")
    steps = f"the first {record['steps']} steps of each scene" if record["steps"] else "all steps of each scene"
    return HOW_TO_READ.format(**record | {"steps": steps}) + "\n" + "\n".join(lines) + "\n\n" + memory_page(record)


MEMORY = """\
## Memory

Bytes that the tables of Tamias2D hold at the end of a scene, by body that may move and by contact, as
`World::memory()` tells them ([guide](guide/memory.md)). What lasts is what a body and its shapes take whether they
move or not; the rest is what a step works with, and is kept from step to step.

"""


def memory_page(record: dict) -> str:
    """Bytes by body and by contact, of the scenes of which our program told."""
    lines = ["| Scene | bodies | contacts | lasting, a body | in a step, a body | a contact | all [MB] |", "|" + " --- |" * 7]
    for scene, engines in record["scenes"].items():
        r = engines.get(OURS, {})
        if "memoryBytes" not in r:
            continue
        of_contacts = sum(b for name, b in r["memoryBytes"].items() if name.startswith("contacts"))
        of_steps = sum(b for name, b in r["memoryBytes"].items() if name.endswith("in a step"))
        everything = sum(r["memoryBytes"].values())
        bodies, contacts = max(r["bodies"], 1), max(r["contactsAtEnd"], 1)
        lines.append(f"| {scene} | {r['bodies']} | {r['contactsAtEnd']} | {(everything - of_contacts - of_steps) / bodies:.0f} | "
                     f"{of_steps / bodies:.0f} | {of_contacts / contacts:.0f} | {everything / 1e6:.1f} |")
    return MEMORY + "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
