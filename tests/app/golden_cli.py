#!/usr/bin/env python3
"""The verbs check and accept, run with the renderer of fake_render_main.cpp. Usage: golden_cli.py PROGRAM"""
import json
import unittest

import cli_case
from cli_case import CliCase, pfm


class Golden(CliCase):
    def setUp(self):
        super().setUp()
        self.golden = self.folder / "golden"
        self.golden.mkdir()
        cases = [{"name": name, "scene": f"../{name}.txt", "profile": "f32", "outputs": ["beauty", "depth"]}
                 for name in ("one", "two")]
        cases[1]["inputs"] = ["../probe.pfm"]
        (self.golden / "manifest.json").write_text(json.dumps({"cases": cases}))
        (self.folder / "probe.pfm").write_bytes(pfm(1, 1, [1, 2, 3]))
        self.scene("one", 1)
        self.scene("two", 2)

    def scene(self, name, value):
        (self.folder / f"{name}.txt").write_text(str(value))

    def content(self):
        return {name: (self.folder / name).read_bytes() for name in self.files()}

    def test_missing_golden_fails_until_accepted(self):
        self.assertIn("missing: one", self.expect(1, "check").stdout)
        self.assertEqual(self.expect(0, "accept", "*", "--reason", "first").stdout, "accepted: one\naccepted: two\n")
        self.assertIn("2 of 2 golden images are the same", self.expect(0, "check").stdout)
        self.assertEqual(self.files(), ["golden/manifest.json", "golden/one.exr", "golden/two.exr", "one.txt",
                                        "probe.pfm", "two.txt"])
        self.assertEqual(self.expect(0, "accept", "*", "--reason", "again").stdout, "unchanged: one\nunchanged: two\n")

    def test_difference_fails_and_nothing_is_written(self):
        self.expect(0, "accept", "*", "--reason", "first")
        self.scene("one", 1.5)
        before = self.content()
        text = self.expect(1, "check").stdout
        self.assertIn("different: one: RGBA differs", text)
        self.assertIn("same: two", text)
        report = json.loads(self.expect(1, "check", "--json").stdout)
        self.assertEqual((report["checked"], report["same"]), (2, 1))
        self.assertEqual(report["results"][0]["comparison"]["channels"][0]["max_absolute"], 0.5)
        self.expect(0, "check", "two")
        self.assertEqual(self.content(), before)

    def test_other_input_is_named(self):
        self.expect(0, "accept", "*", "--reason", "first")
        (self.folder / "probe.pfm").write_bytes(pfm(1, 1, [1, 2, 4]))
        self.assertIn("input differs: two: the input differs: ../probe.pfm", self.expect(1, "check").stdout)

    def test_bad_scene_is_bad_input(self):
        self.expect(0, "accept", "*", "--reason", "first")
        self.scene("one", "x")
        before = self.content()
        result = self.run_program("check")
        self.assertEqual((result.returncode, result.stderr), (2, ""))
        self.assertIn("failed: one: golden/../one.txt:1: not a number", result.stdout)
        self.expect_error("one.txt:1: not a number", "accept", "one", "--reason", "worse")
        self.assertEqual(self.content(), before)

    def test_unknown_pattern_is_nothing_to_check(self):
        self.expect(3, "check", "three")
        self.expect(3, "accept", "three", "--reason", "none")

    def test_accept_needs_a_reason(self):
        before = self.content()
        self.expect_error("--reason", "accept", "*")
        self.expect_error("reason", "accept", "*", "--reason", "")
        self.expect_error("reason", "accept", "*", "--reason", "  ")
        self.assertEqual(self.content(), before)

    def test_bad_manifest_is_bad_input(self):
        self.expect_error("none.json: no such file", "check", "--manifest", "none.json")
        (self.golden / "manifest.json").write_text("{")
        self.expect_error("golden/manifest.json: not valid JSON", "check")


if __name__ == "__main__":
    cli_case.main()
