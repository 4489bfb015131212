# SPDX-License-Identifier: MIT
"""The published JSON Schema is a schema, every scene of the project follows it, and what the reader
refuses it refuses too. Run by ctest with Debian's python3-jsonschema."""

import copy
import json
import pathlib
import unittest

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "docs" / "scene.schema.json").read_text())
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

GOOD = {
    "tamias2d": 1,
    "world": {"gravity": [0, -9.81], "tuning": {"restGap": 0.001}},
    "run": {"seconds": 1, "rate": 60, "substeps": 4},
    "bodies": [
        {
            "$comment": "allowed anywhere",
            "name": "ball",
            "mass": {"mass": 1, "inertia": 0.1},
            "gravity": None,
            "shapes": [{"circle": {"radius": 0.5}, "restitution": 1}],
            "laws": [{"law": "springTo", "point": [0, 0], "stiffness": 3}, {"law": "wind"}],
        }
    ],
    "laws": [{"law": "drag", "linear": 1, "body": "ball"}],
}


def broken(path, value):
    """GOOD with the value at the path replaced, or added."""
    scene = copy.deepcopy(GOOD)
    place = scene
    for part in path[:-1]:
        place = place[part]
    place[path[-1]] = value
    return scene


class Schema(unittest.TestCase):
    def test_is_a_schema_of_the_2020_draft(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_accepts_every_scene_of_the_project(self):
        files = sorted((ROOT / "scenes").glob("*.json"))
        self.assertGreaterEqual(len(files), 10)
        for file in files:
            with self.subTest(file=file.name):
                errors = [f"{e.json_path}: {e.message}" for e in VALIDATOR.iter_errors(json.loads(file.read_text()))]
                self.assertEqual(errors, [])

    def test_accepts_a_good_scene_and_refuses_what_the_reader_refuses(self):
        self.assertTrue(VALIDATOR.is_valid(GOOD))
        shape = ["bodies", 0, "shapes", 0]
        cases = [
            (["tamias2d"], 2),
            (["bodeis"], []),
            (["run", "rate"], 0),
            (["run", "substeps"], 4.5),
            (["world", "gravity"], [0]),
            (["world", "tuning", "calmRate"], 1),
            (["bodies", 0, "type"], "dynamik"),
            (["bodies", 0, "mass", "mass"], 0),
            (["bodies", 0, "userData"], -1),
            (["bodies", 0, "gravity"], 3),
            (["bodies", 0, "laws", 0], {"law": "springTo", "point": [0, 0]}),
            (shape + ["restitution"], 1.1),
            (shape + ["restitution"], -0.1),
            (shape + ["friction"], -1),
            (shape + ["circle", "radius"], 0),
            (shape + ["box"], {}),
            (shape + ["filter"], {"group": 3e9}),
            (["bodies", 0, "shapes", 0], {}),
            (["builtin"], {"name": "pyramid", "base": 0}),
            (["builtin"], {"name": "pyramid", "basis": 3}),
            (["builtin"], {"name": "pyramyd"}),
        ]
        for path, value in cases:
            with self.subTest(path=path, value=value):
                self.assertFalse(VALIDATOR.is_valid(broken(path, value)))

    def test_every_number_has_a_unit_or_says_what_it_counts(self):
        def walk(node, path):
            if isinstance(node, dict):
                is_number = node.get("type") in ("number", "integer") and "description" in node
                if is_number and node["type"] == "number":
                    self.assertRegex(node["description"], r"\[.+\]", path)
                for key, value in node.items():
                    walk(value, f"{path}/{key}")
            elif isinstance(node, list):
                for i, value in enumerate(node):
                    walk(value, f"{path}/{i}")

        walk(SCHEMA, "")


if __name__ == "__main__":
    unittest.main()
