#!/usr/bin/env python3
"""The verb compare and the command line itself, run as a user would. Usage: compare_cli.py PROGRAM"""
import json
import math
import os
import resource
import unittest

import cli_case
from cli_case import CliCase, pfm

VALUES = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


class CommandLine(CliCase):
    def test_version_and_help_succeed(self):
        self.assertRegex(self.expect(0, "--version").stdout, r"^etalon \d+\.\d+\.\d+\n$")
        self.assertIn("compare", self.expect(0, "--help").stdout)
        self.assertIn("--error-image", self.expect(0, "compare", "--help").stdout)

    def test_unknown_options_and_verbs_are_errors(self):
        for arguments in ([], ["paint"], ["--fast"], ["compare"], ["compare", "a", "b", "--fast"],
                          ["compare", "a", "b", "c"], ["compare", "a", "b", "--max-worst", "x"],
                          ["compare", "a", "b", "--max-worst", "-1"]):
            with self.subTest(arguments=arguments):
                self.expect(2, *arguments)


class Compare(CliCase):
    def setUp(self):
        super().setUp()
        self.a = self.write("a.pfm", pfm(2, 1, VALUES))
        self.b = self.write("b.pfm", pfm(2, 1, VALUES[:-1] + [6.5]))

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content)
        return path

    def test_same_is_0_different_is_1(self):
        self.assertTrue(self.expect(0, "compare", "a.pfm", "a.pfm").stdout.startswith("identical: "))
        text = self.expect(1, "compare", "a.pfm", "b.pfm").stdout
        self.assertTrue(text.startswith("different: a.pfm against b.pfm\n"), text)
        self.assertIn("(1, 0): 6 against 6.5, 1048576 ulp", text)

    def test_nan_and_infinity_differ(self):
        self.write("nan.pfm", pfm(2, 1, [math.nan] * 6))
        self.write("inf.pfm", pfm(2, 1, VALUES[:-1] + [math.inf]))
        self.expect(1, "compare", "a.pfm", "nan.pfm")
        self.expect(1, "compare", "a.pfm", "inf.pfm")
        self.expect(0, "compare", "nan.pfm", "nan.pfm")

    def test_shapes_differ(self):
        self.write("tall.pfm", pfm(1, 2, VALUES))
        self.assertIn("size: 2x1 against 1x2", self.expect(1, "compare", "a.pfm", "tall.pfm").stdout)

    def test_signs_of_zeros_count_with_bits(self):
        self.write("p.pfm", pfm(1, 1, [0.0, 0.0, 0.0]))
        self.write("n.pfm", pfm(1, 1, [-0.0, 0.0, 0.0]))
        self.assertIn("1 zeros of other sign", self.expect(0, "compare", "p.pfm", "n.pfm").stdout)
        self.expect(1, "compare", "p.pfm", "n.pfm", "--bits")
        self.expect(0, "compare", "p.pfm", "p.pfm", "--bits")

    def test_json(self):
        report = json.loads(self.expect(1, "compare", "a.pfm", "b.pfm", "--json", "--max-worst", 1).stdout)
        self.assertFalse(report["equal"])
        self.assertEqual([c["name"] for c in report["channels"]], ["R", "G", "B"])
        blue = report["channels"][2]
        self.assertEqual((blue["differing"], blue["max_absolute"], blue["max_ulp"]), (1, 0.5, 1 << 20))
        self.assertEqual(blue["worst"], [{"x": 1, "y": 0, "a": 6.0, "b": 6.5, "ulp": 1 << 20}])
        self.write("inf.pfm", pfm(2, 1, VALUES[:-1] + [-math.inf]))
        worst = json.loads(self.expect(1, "compare", "a.pfm", "inf.pfm", "--json").stdout)["channels"][2]["worst"]
        self.assertEqual((worst[0]["b"], worst[0]["ulp"]), ("-inf", None))

    def test_bad_files_are_errors(self):
        self.write("empty.exr", b"")
        self.write("text.exr", b"hello")
        self.write("cut.pfm", pfm(2, 1, VALUES)[:-1])
        self.write("cut.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")
        self.write("large.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 40000\n\2\2\0\0")
        for name, reason in [("missing.exr", "no such file"), (".", "directory"), ("empty.exr", "empty"),
                             ("text.exr", "not a readable image"), ("cut.pfm", "truncated"),
                             ("cut.png", "truncated"), ("large.hdr", "17.9 GiB")]:
            with self.subTest(name=name):
                self.expect_error(f"{name}: ", "compare", "a.pfm", name)
                self.expect_error(reason, "compare", name, "a.pfm")

    def test_truncated_exr_is_an_error(self):
        self.expect(1, "compare", "a.pfm", "b.pfm", "--error-image", "e.exr")
        content = (self.folder / "e.exr").read_bytes()
        self.write("e.exr", content[:-1])
        self.expect_error("e.exr: truncated", "compare", "e.exr", "a.pfm")

    def test_error_image_holds_the_difference(self):
        self.expect(1, "compare", "a.pfm", "b.pfm", "--error-image", "e.exr")
        self.write("expected.pfm", pfm(2, 1, [0, 0, 0, 0, 0, 0.5]))
        self.expect(0, "compare", "e.exr", "expected.pfm", "--bits")
        self.assertEqual(self.files(), ["a.pfm", "b.pfm", "e.exr", "expected.pfm"])

    def test_error_image_never_replaces_an_input(self):
        self.expect(1, "compare", "a.pfm", "b.pfm", "--error-image", "e.exr")
        before = (self.folder / "e.exr").read_bytes()
        self.expect_error("replace", "compare", "e.exr", "a.pfm", "--error-image", "./e.exr")
        self.expect_error("EXR", "compare", "a.pfm", "b.pfm", "--error-image", "e.png")
        self.assertEqual((self.folder / "e.exr").read_bytes(), before)

    def test_unwritable_outputs_leave_nothing(self):
        before = self.files()
        self.expect_error("No such file", "compare", "a.pfm", "b.pfm", "--error-image", "missing/e.exr")
        os.symlink("/dev/full", self.folder / "full.exr")
        self.expect_error("No space left", "compare", "a.pfm", "b.pfm", "--error-image", "full.exr")
        os.unlink(self.folder / "full.exr")
        limit = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))}
        self.expect_error("too large", "compare", "a.pfm", "b.pfm", "--error-image", "e.exr", **limit)
        self.assertEqual(self.files(), before)

    def test_read_only_outputs_leave_nothing(self):
        locked = self.folder / "locked"
        locked.mkdir()
        os.chmod(locked, 0o555)
        options = self.unprivileged()
        before = self.files()
        self.expect_error("Permission denied", "compare", "a.pfm", "b.pfm", "--error-image", "locked/e.exr", **options)
        os.chmod(self.a, 0o000)
        self.expect_error("cannot be opened", "compare", "a.pfm", "b.pfm", **options)
        self.assertEqual(self.files(), before)

    def test_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            self.expect_error("standard output", "compare", "a.pfm", "b.pfm", stdout=full)
            self.expect_error("standard output", "--help", stdout=full)


if __name__ == "__main__":
    cli_case.main()
