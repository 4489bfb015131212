#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the shared scenes of tamias_verify with Pymunk: verify_pymunk.py VERIFY.json OUT.json

tools/verify.py starts it with the Python of its own environment, where Pymunk is. For each scene it notes
how far Pymunk is from Debian's Chipmunk after the times that are sampled there."""

import json
import math
import sys

import pymunk


def main() -> int:
    shared = json.load(open(sys.argv[1]))["shared"]
    result = {"pymunk": pymunk.version, "core": pymunk.chipmunk_version,
              "rows": [row for scene in shared for row in compare(scene)]}
    with open(sys.argv[2], "w") as out:
        json.dump(result, out, indent=1)
    return 0


def compare(scene: dict):
    """Yields one row for each sampled time: the largest differences of any body, and both energies."""
    space, bodies = build(scene)
    steps = 0
    for sample in scene["chipmunk"]:
        while steps < round(sample["time"] * scene["rate"]):
            space.step(1 / scene["rate"])
            steps += 1
        place = speed = 0.0
        for body, (x, y, _, vx, vy, _) in zip(bodies, sample["states"]):
            place = max(place, math.hypot(body.position.x - x, body.position.y - y))
            speed = max(speed, math.hypot(body.velocity.x - vx, body.velocity.y - vy))
        yield {"scene": scene["title"], "time": sample["time"], "place": place, "speed": speed,
               "chipmunk": energy(scene, sample["states"]),
               "pymunk": energy(scene, [(*b.position, b.angle, *b.velocity, b.angular_velocity) for b in bodies])}


def build(scene: dict):
    space = pymunk.Space()
    space.gravity = scene["gravity"]
    bodies = []
    for source in scene["bodies"]:
        x, y, angle, vx, vy, spin = source["start"]
        if source["fixed"]:
            body = pymunk.Body(body_type=pymunk.Body.STATIC)
        else:
            body = pymunk.Body(source["mass"], source["inertia"])
        body.position, body.angle = (x, y), angle
        if source["corners"]:
            shape = pymunk.Poly(body, source["corners"], radius=source["radius"])
        else:
            shape = pymunk.Circle(body, source["radius"])
        # As for Chipmunk: the values of the two shapes are multiplied.
        shape.friction, shape.elasticity = math.sqrt(scene["friction"]), math.sqrt(scene["restitution"])
        space.add(body, shape)
        if not source["fixed"]:
            body.velocity, body.angular_velocity = (vx, vy), spin
        bodies.append(body)
    return space, bodies


def energy(scene: dict, states) -> float:
    """Kinetic and potential energy of the moving bodies [J]."""
    total = 0.0
    for source, (x, y, _, vx, vy, spin) in zip(scene["bodies"], states):
        if not source["fixed"]:
            total += source["mass"] * (vx * vx + vy * vy) / 2 + source["inertia"] * spin * spin / 2
            total -= source["mass"] * (scene["gravity"][0] * x + scene["gravity"][1] * y)
    return total


if __name__ == "__main__":
    sys.exit(main())
