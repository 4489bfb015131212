# SPDX-License-Identifier: MIT
"""Every verb, flag and exit code of the command `tamias2d`, from outside.

    python3 cli_test.py PATH/TO/tamias2d [unittest options]
"""

import csv
import io
import json
import os
import pathlib
import pty
import re
import select
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLI = str(pathlib.Path(sys.argv.pop(1)).resolve())
DONE, FAILED, WRONG = 0, 1, 2

BALL = """{"tamias2d": 1, "title": "A ball", "run": {"seconds": 0.5, "rate": 100, "substeps": 2},
 "bodies": [
  {"name": "ball, the \\"first\\" </script>", "position": [0, 5], "linearVelocity": [1, 0],
   "shapes": [{"circle": {"radius": 0.5}}]},
  {"name": "ground", "type": "static", "shapes": [{"segment": {"a": [-9, 0], "b": [9, 0]}}]}
 ]}"""


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name, text=None):
        path = pathlib.Path(self.folder.name) / name
        if text is not None:
            path.write_text(text, encoding="utf-8")
        return str(path)

    def run_cli(self, *arguments, code=DONE):
        done = subprocess.run([CLI, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder.name, check=False)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        if code == DONE:
            self.assertEqual(done.stderr, "")
        else:
            lines = done.stderr.splitlines()
            self.assertEqual(len(lines), 1, f"one clear line, not: {done.stderr}")
            self.assertTrue(lines[0].startswith("tamias2d: "), lines[0])
        return done

    def refusal(self, *arguments, code=WRONG):
        return self.run_cli(*arguments, code=code).stderr.strip()

    def report(self, *arguments):
        path = self.path("report.json")
        self.run_cli("run", *arguments, "--report", path, "--quiet")
        return json.loads(pathlib.Path(path).read_text())


class Run(Case):
    def test_prints_a_short_table(self):
        out = self.run_cli("run", "pyramid:base=3", "--steps", 10).stdout
        for label in ("steps", "ms/step", "energy", "momentum", "contacts", "hash"):
            self.assertRegex(out, rf"(?m)^  {label} ")
        self.assertIn("7 bodies", out)
        self.assertLess(len(out.splitlines()), 12)

    def test_quiet_prints_nothing(self):
        self.assertEqual(self.run_cli("run", "pyramid:base=3", "--steps", 10, "--quiet").stdout, "")

    def test_takes_length_and_rate_from_the_scene(self):
        report = self.report(self.path("ball.json", BALL))
        self.assertEqual(report["steps"], 50)
        self.assertAlmostEqual(report["time"], 0.5)

    def test_seconds_and_rate_overrule_the_scene(self):
        report = self.report(self.path("ball.json", BALL), "--seconds", 2, "--rate", 30)
        self.assertEqual(report["steps"], 60)
        self.assertAlmostEqual(report["time"], 2)

    def test_steps_overrule_the_scene(self):
        self.assertEqual(self.report(self.path("ball.json", BALL), "--steps", 7)["steps"], 7)
        self.assertEqual(self.report(self.path("ball.json", BALL), "--steps", 0)["steps"], 0)

    def test_threads_change_no_result(self):
        one = self.report("pyramid:base=15", "--steps", 20)
        many = self.report("pyramid:base=15", "--steps", 20, "--threads", 3)
        self.assertEqual(one["hash"], many["hash"])
        for wrong in (0, 65, "x"):
            self.assertIn("--threads", self.refusal("run", "pyramid", "--threads", wrong))

    def test_substeps_change_the_result_of_an_orbit(self):
        one = self.report("orbit", "--steps", 60, "--substeps", 1)
        many = self.report("orbit", "--steps", 60, "--substeps", 16)
        self.assertNotEqual(one["hash"], many["hash"])

    def test_profile_is_a_trace_whose_spans_nest(self):
        path = self.path("profile.json")
        report = self.report("pyramid:base=4", "--steps", 5, "--profile", path)
        events = json.loads(pathlib.Path(path).read_text())["traceEvents"]
        self.assertEqual(report["hash"], self.report("pyramid:base=4", "--steps", 5)["hash"])
        spans = [e for e in events if e["ph"] == "X"]
        self.assertEqual([e["args"]["step"] for e in spans if e["name"] == "step"], [1, 2, 3, 4, 5])
        self.assertEqual(sum(e["name"] == "tick" for e in spans), 5 * 8)
        for name in ("broad phase", "manifolds", "solve", "finalize", "passes"):
            self.assertIn(name, {e["name"] for e in spans})
        for thread in {e["tid"] for e in spans}:
            open_ends = []  # of the spans around this one; in nanoseconds, which are whole
            last = 0
            for e in [e for e in spans if e["tid"] == thread]:
                begin = round(1000 * e["ts"])
                end = begin + round(1000 * e["dur"])
                self.assertGreaterEqual(begin, last)
                self.assertGreaterEqual(end, begin)
                while open_ends and open_ends[-1] <= begin:
                    open_ends.pop()
                if open_ends:
                    self.assertLessEqual(end, open_ends[-1], e)
                open_ends.append(end)
                last = begin

    def test_both_precisions(self):
        single = self.report("bounce", "--steps", 100, "--precision", "f32")
        double = self.report("bounce", "--steps", 100, "--precision", "f64")
        self.assertEqual((single["precision"], double["precision"]), ("f32", "f64"))
        self.assertEqual(self.report("bounce", "--steps", 100)["precision"], "f32")
        a, b = (r["bodies"][1]["position"][1] for r in (single, double))
        self.assertNotEqual(single["hash"], double["hash"])
        self.assertAlmostEqual(a, b, places=3)

    def test_a_warning_free_run_of_every_scene_file(self):
        for file in sorted((ROOT / "scenes").glob("*.json")):
            with self.subTest(file=file.name):
                self.run_cli("run", file, "--steps", 5, "--quiet")


class Report(Case):
    def test_has_the_documented_fields(self):
        report = self.report("pile:count=10", "--steps", 60)
        self.assertEqual(list(report), ["steps", "time", "precision", "bodies", "energy", "momentum", "contacts",
                                        "deepestPenetration", "msPerStep", "hash"])
        self.assertEqual(list(report["bodies"][0]), ["name", "position", "angle", "velocity", "angularVelocity"])
        self.assertEqual(list(report["energy"]), ["initial", "final", "highest"])
        self.assertEqual(list(report["momentum"]), ["linear", "angular"])
        self.assertEqual(list(report["msPerStep"]), ["mean", "max"])
        self.assertRegex(report["hash"], r"^[0-9a-f]{16}$")

    def test_says_what_free_fall_says(self):
        # 0.5 s of fall from 5 m: y = 5 - g t^2 / 2, v = -g t; mass of a disc of radius 0.5: pi / 4.
        report = self.report(self.path("ball.json", BALL), "--precision", "f64")
        ball = report["bodies"][0]
        self.assertAlmostEqual(ball["position"][0], 0.5, places=12)
        self.assertAlmostEqual(ball["position"][1], 5 - 9.81 / 8, places=12)
        self.assertAlmostEqual(ball["velocity"][1], -9.81 / 2, places=12)
        mass = 3.141592653589793 / 4
        self.assertAlmostEqual(report["energy"]["initial"], mass * (0.5 + 9.81 * 5), places=9)
        self.assertAlmostEqual(report["energy"]["final"], report["energy"]["initial"], places=9)
        self.assertGreaterEqual(report["energy"]["highest"], report["energy"]["initial"])
        self.assertAlmostEqual(report["momentum"]["linear"][0], mass, places=12)
        self.assertEqual(report["contacts"], 0)
        self.assertEqual(report["deepestPenetration"], 0)

    def test_counts_what_touches(self):
        # Three boxes on the ground: three contacts.
        self.assertEqual(self.report("stack:boxes=3", "--steps", 30)["contacts"], 3)


class Trace(Case):
    def rows(self, *arguments):
        path = self.path("trace.csv")
        self.run_cli("run", *arguments, "--trace", path, "--quiet")
        return list(csv.DictReader(io.StringIO(pathlib.Path(path).read_text())))

    def test_has_every_moving_body_and_the_sum_at_every_step(self):
        rows = self.rows(self.path("ball.json", BALL), "--precision", "f64")
        self.assertEqual(list(rows[0]), ["time", "body", "name", "x", "y", "angle", "vx", "vy", "w", "kinetic",
                                         "potential", "px", "py", "L"])
        self.assertEqual(len(rows), 2 * 51)
        self.assertEqual(rows[0]["name"], 'ball, the "first" </script>')
        self.assertEqual({r["body"] for r in rows}, {"0", "*"})
        self.assertEqual(float(rows[0]["y"]), 5)
        for row in rows[::2]:
            t = float(row["time"])
            self.assertAlmostEqual(float(row["y"]), 5 - 9.81 / 2 * t * t, places=9)
            self.assertAlmostEqual(float(row["vy"]), -9.81 * t, places=9)
        totals = [float(r["kinetic"]) + float(r["potential"]) for r in rows[1::2]]
        self.assertAlmostEqual(min(totals), max(totals), places=9)


class Replay(Case):
    def data(self, *arguments):
        path = self.path("replay.html")
        self.run_cli("run", *arguments, "--replay", path, "--quiet")
        page = pathlib.Path(path).read_text(encoding="utf-8")
        self.assertNotIn("/*TAMIAS_REPLAY_DATA*/", page)
        self.assertNotRegex(page, r"(src|href)=[\"']?https?:", "no network")
        found = re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.S)
        return json.loads(found[1]), page

    def test_is_one_page_with_the_recording(self):
        data, page = self.data(self.path("ball.json", BALL))
        self.assertTrue(page.startswith("<!DOCTYPE html>"))
        self.assertEqual(data["title"], "A ball")
        self.assertEqual((data["precision"], data["rate"], data["substeps"]), ("f32", 100, 2))
        self.assertEqual(len(data["frames"]), 51)
        self.assertEqual([b["type"] for b in data["bodies"]], ["dynamic", "static"])
        self.assertEqual(data["bodies"][0]["name"], 'ball, the "first" </script>')
        self.assertEqual([b["shapes"][0]["kind"] for b in data["bodies"]], ["circle", "segment"])
        last = data["frames"][-1]
        self.assertAlmostEqual(last["t"], 0.5)
        self.assertEqual(len(last["poses"]), 6)
        self.assertAlmostEqual(last["poses"][1], 5 - 9.81 / 8, places=4)
        self.assertAlmostEqual(last["velocities"][1], -9.81 / 2, places=3)
        self.assertAlmostEqual(sum(last["energy"][:2]), last["energy"][2], places=4)

    def test_shapes_lie_where_they_are_in_the_body(self):
        scene = """{"tamias2d": 1, "bodies": [{"shapes": [
            {"box": {"width": 2, "height": 1, "radius": 0.1}, "offset": [3, 0], "angle": 1.5707963267948966}]}]}"""
        data, _ = self.data(self.path("s.json", scene), "--steps", 1)
        shape = data["bodies"][0]["shapes"][0]
        corners = sorted([round(x, 5), round(y, 5)] for x, y in shape["points"])
        self.assertEqual(corners, [[2.5, -1], [2.5, 1], [3.5, -1], [3.5, 1]])
        self.assertAlmostEqual(shape["radius"], 0.1, places=6)

    def test_contacts_and_hits_are_there(self):
        data, _ = self.data("bounce:height=1,restitution=0.5", "--seconds", 3)
        self.assertTrue(any(f["hits"] for f in data["frames"]))
        hit = next(f["hits"][0] for f in data["frames"] if f["hits"])
        self.assertEqual(len(hit), 5)
        self.assertAlmostEqual(abs(hit[3]), 1, places=3)
        self.assertTrue(data["frames"][-1]["contacts"])

    def test_a_long_run_is_thinned_out_and_keeps_its_end(self):
        data, page = self.data("cradle", "--steps", 4000)
        self.assertLessEqual(len(data["frames"]), 1502)
        self.assertAlmostEqual(data["dt"], 3 / 60, places=6)
        self.assertAlmostEqual(data["frames"][-1]["t"], 4000 / 60, places=4)
        self.assertLess(len(page), 20_000_000)


class OtherVerbs(Case):
    def test_check_accepts_a_good_scene(self):
        path = self.path("ball.json", BALL)
        self.assertIn("2 bodies, 2 shapes", self.run_cli("check", path).stdout)
        self.run_cli("check", "gas:discs=3", "--precision", "f64")

    def test_check_tells_line_path_value_and_rule(self):
        path = self.path("bad.json", BALL.replace('"radius": 0.5}', '"radius": 0.5}, "restitution": 1.1'))
        self.assertEqual(self.refusal("check", path),
                         f"tamias2d: {path}:4: /bodies/0/shapes/0/restitution = 1.1: must be in [0, 1]")

    def test_hash_is_the_hash_of_the_run(self):
        out = self.run_cli("hash", "pile:count=10", "--steps", 30).stdout.strip()
        self.assertRegex(out, r"^[0-9a-f]{16}$")
        self.assertEqual(out, self.report("pile:count=10", "--steps", 30)["hash"])
        self.assertEqual(out, self.run_cli("hash", "pile:count=10", "--steps", 30).stdout.strip())
        other = self.run_cli("hash", "pile:count=10", "--steps", 30, "--precision", "f64", "--rate", 120,
                             "--substeps", 2).stdout.strip()
        self.assertNotEqual(out, other)

    def test_scenes_lists_names_and_parameters(self):
        out = self.run_cli("scenes").stdout
        for name in ("stack", "pyramid", "gas", "tiles", "pile"):
            self.assertRegex(out, rf"(?m)^{name} ")
        self.assertIn("base=20", out)

    def test_version_and_help(self):
        self.assertRegex(self.run_cli("--version").stdout, r"^tamias2d \d+\.\d+\.\d+\n$")
        self.assertIn("Exit codes", self.run_cli("--help").stdout)
        for verb in ("run", "check", "hash", "scenes"):
            self.run_cli(verb, "--help")


class WrongUsage(Case):
    def test_is_refused_in_one_line(self):
        for arguments in ((), ("fly",), ("run",), ("run", "gas", "--speed"), ("run", "gas", "--rate", "fast"),
                          ("run", "gas", "--precision", "f16"), ("run", "gas", "--steps", 1, "--seconds", 1),
                          ("run", "gas", "--steps", "1.5"), ("run", "gas", "more"), ("hash", "gas"),
                          ("check",), ("scenes", "all")):
            with self.subTest(arguments=arguments):
                self.refusal(*arguments)

    def test_numbers_out_of_range_are_named_with_their_rule(self):
        cases = (("--rate", 0, "must be in [1, 1e6] Hz"), ("--rate", "nan", "must be in [1, 1e6] Hz"),
                 ("--substeps", 0, "must be in [1, 256]"), ("--substeps", 257, "must be in [1, 256]"),
                 ("--seconds", -1, "must be in [0, 1e9] s"), ("--seconds", "inf", "must be in [0, 1e9] s"),
                 ("--steps", -1, "must be in [0, 1e15]"))
        for flag, value, rule in cases:
            with self.subTest(flag=flag, value=value):
                self.assertEqual(self.refusal("run", "gas", f"{flag}={value}"), f"tamias2d: {flag} = {value}: {rule}")

    def test_scenes_that_are_none(self):
        self.assertIn("is neither a file nor a built-in scene", self.refusal("run", "nowhere.json"))
        self.assertIn('did you mean "pyramid"?', self.refusal("run", "pyramyd"))
        self.assertIn("must be a whole number in [1, 150]", self.refusal("run", "pyramid:base=0"))
        self.assertIn(":1:2: not valid JSON", self.refusal("run", self.path("bad.json", "no")))
        self.assertIn("cannot be read", self.refusal("run", self.folder.name))

    def test_files_that_cannot_be_written(self):
        for flag in ("--trace", "--report", "--replay"):
            with self.subTest(flag=flag):
                self.assertIn("nowhere/out: cannot be written: No such file or directory",
                              self.refusal("run", "gas", flag, "nowhere/out"))


class FailedRun(Case):
    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_a_full_disk_fails_the_run(self):
        line = self.refusal("run", "gas", "--steps", 5, "--trace", "/dev/full", "--quiet", code=FAILED)
        self.assertIn("the run failed: /dev/full: writing failed", line)

    def test_a_world_that_blows_up_fails_the_run(self):
        # A force law whose force no double can hold, once the body moves.
        scene = """{"tamias2d": 1, "world": {"gravity": [0, 0]}, "bodies": [
            {"name": "b", "position": [1, 0], "linearVelocity": [1e5, 0], "shapes": [{"circle": {}}],
             "laws": [{"law": "drag", "linear": 0, "quadratic": 1e308}]}]}"""
        path = self.path("wild.json", scene)
        line = self.refusal("run", path, "--quiet", code=FAILED)
        self.assertIn("the run failed: a force law gave no number in step 1", line)


class ProgressBar(Case):
    """On a terminal, and only for runs that last longer than a second."""

    def on_terminal(self, *arguments):
        leader, follower = pty.openpty()
        process = subprocess.Popen([CLI, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=follower)
        os.close(follower)
        seen, start = b"", time.monotonic()
        while time.monotonic() - start < 60:
            if select.select([leader], [], [], 0.2)[0]:
                try:
                    seen += os.read(leader, 4096)
                except OSError:
                    break
            elif process.poll() is not None:
                break
            if seen.count(b"%") > 2:
                break
        process.terminate()
        process.wait()
        os.close(leader)
        return seen.decode()

    def test_is_shown_in_a_long_run(self):
        shown = self.on_terminal("run", "bounce", "--steps", 10**9)
        self.assertRegex(shown, r"\[#*\.+\] +\d+ %, step \d+ of 1000000000, \d+ s left")

    def test_is_not_shown_in_a_short_run(self):
        self.assertEqual(self.on_terminal("run", "bounce", "--steps", 1), "")

    def test_is_not_shown_where_there_is_no_terminal(self):
        process = subprocess.Popen([CLI, "run", "bounce", "--steps", str(10**9)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE)
        time.sleep(2)
        process.terminate()
        self.assertEqual(process.communicate()[1], b"")


if __name__ == "__main__":
    unittest.main()
