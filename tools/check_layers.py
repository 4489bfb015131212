#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that includes go downhill only: every layer includes just what tools/layers.toml lists for it,
public headers include public ones only, every folder is a layer, and neither headers nor units form a ring.
A unit is a .hpp with its .cpp; a public header counts by itself, as the contract its unit fulfils.
Prints each fault as path:line: what; exit 1 if there is any."""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PUBLIC = ROOT / "include" / "tamias2d"
PRIVATE = ROOT / "src"
UMBRELLA = PUBLIC / "tamias2d.hpp"
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def main() -> int:
    faults = check()
    for fault in faults:
        print(fault)
    return 1 if faults else 0


def check() -> list[str]:
    layers = tomllib.loads((ROOT / "tools" / "layers.toml").read_text())["layers"]
    files = sorted(p for top in (PUBLIC, PRIVATE) for p in top.rglob("*") if p.suffix in (".hpp", ".cpp"))
    faults = [f"{at(folder)}: not a layer of tools/layers.toml"
              for top in (PUBLIC, PRIVATE) for folder in sorted(top.iterdir())
              if folder.is_dir() and folder.name not in layers]

    headers: dict[Path, set[Path]] = {}
    units: dict[str, set[str]] = {}
    for path in files:
        if path == UMBRELLA or layer_of(path) not in layers:
            continue
        allowed = set(layers[layer_of(path)]) | {layer_of(path)}
        for number, quote, name in includes(path):
            here = f"{at(path)}:{number}"
            target = resolve(path, quote, name)
            if target is None:
                if quote == '"':
                    faults.append(f"{here}: no such header: {name}")
                continue
            if target == UMBRELLA:
                faults.append(f"{here}: nothing inside the library includes {name}")
                continue
            if path.is_relative_to(PUBLIC) and not target.is_relative_to(PUBLIC):
                faults.append(f"{here}: a public header includes the private {name}")
            if layer_of(target) not in allowed:
                faults.append(f"{here}: {layer_of(path)} may not include {layer_of(target)} ({name})")
            headers.setdefault(path, set()).add(target)
            if unit_of(path) != unit_of(target):
                units.setdefault(unit_of(path), set()).add(unit_of(target))

    faults += [f"ring of headers: {' -> '.join(at(p) for p in ring)}" for ring in rings(headers)]
    faults += [f"ring of units: {' -> '.join(ring)}" for ring in rings(units)]
    return faults


def includes(path: Path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1], match[2]


def resolve(path: Path, quote: str, name: str) -> Path | None:
    """The header of ours that an include means, if it is one of ours."""
    tops = [ROOT / "include"] if quote == "<" else [path.parent, PRIVATE, ROOT / "include"]
    return next((top / name for top in tops if (top / name).is_file()), None)


def layer_of(path: Path) -> str:
    top = PUBLIC if path.is_relative_to(PUBLIC) else PRIVATE
    return path.relative_to(top).parts[0]


def unit_of(path: Path) -> str:
    return at(path.with_suffix(""))


def rings(edges: dict) -> list[list]:
    """One ring for each edge that leads back to a node on the way."""
    found, state = [], {}

    def visit(node, way):
        state[node] = "open"
        for following in sorted(edges.get(node, ())):
            if state.get(following) == "open":
                found.append(way[way.index(following):] + [following])
            elif following not in state:
                visit(following, way + [following])
        state[node] = "done"

    for node in sorted(edges):
        if node not in state:
            visit(node, [node])
    return found


def at(path: Path) -> str:
    return str(path.relative_to(ROOT))


if __name__ == "__main__":
    sys.exit(main())
