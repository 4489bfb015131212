# SPDX-License-Identifier: MIT
"""The picture of docs/performance.md: for each scene, how many times as long another engine takes as Tamias2D.
On its own: bench_chart.py FILE.json PICTURE.svg draws what `./dev bench --json FILE.json` wrote."""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402: the backend comes first


def draw(record: dict, ours: str, picture: Path) -> None:
    scenes = list(record["scenes"])
    peers = [name for name in next(iter(record["scenes"].values())) if name != ours]
    matplotlib.rcParams["svg.hashsalt"] = "tamias2d"  # the same figures give the same file
    figure, axes = plt.subplots(figsize=(8, 0.6 + 0.16 * len(scenes) * (len(peers) + 1)), layout="constrained")
    height = 0.8 / max(len(peers), 1)
    for i, peer in enumerate(peers):
        known = [(k, record["scenes"][scene][peer]) for k, scene in enumerate(scenes)
                 if "ratio" in record["scenes"][scene].get(peer, {})]
        if not known:
            continue
        places = [k + (i - (len(peers) - 1) / 2) * height for k, _ in known]
        bars = axes.barh(places, [r["ratio"] for _, r in known], height * 0.9, label=known[0][1]["engine"])
        axes.bar_label(bars, [f"{r['ratio']:.2g}" for _, r in known], padding=2, fontsize=6)
    axes.axvline(1, color="black", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yticks(range(len(scenes)), scenes, fontsize=8)
    axes.set_ylim(len(scenes) - 0.4, -0.6)
    axes.set_xlabel("time over that of Tamias2D, median of the turns: right of 1, Tamias2D is faster", fontsize=8)
    axes.legend(fontsize=7)
    figure.savefig(picture, metadata={"Date": None})


if __name__ == "__main__":
    draw(json.loads(Path(sys.argv[1]).read_text()), "tamias_bench", Path(sys.argv[2]))
