#!/usr/bin/env python3
"""The verb bits, run with the cases of fake_render_main.cpp. Usage: bits_cli.py PROGRAM"""
import json
import re
import unittest

import cli_case
from cli_case import CliCase


class Bits(CliCase):
    def setUp(self):
        super().setUp()
        (self.folder / "golden").mkdir()
        self.reference = self.folder / "golden/bits.txt"
        self.expect(0, "bits", "--accept", "--reason", "first")

    def plant(self, threads):
        (self.folder / "planted.txt").write_text(str(threads))

    def test_same_bits(self):
        text = self.expect(0, "bits").stdout
        self.assertIn("same: count/one: numbers in a row; ", text)
        self.assertIn("2 of 2 cases have the bits of golden/bits.txt", text)
        self.assertIn("levels " + self.lowest_level(), text)
        self.assertEqual(self.files(), ["golden/bits.txt"])

    def test_choices_of_ways(self):
        report = json.loads(self.expect(0, "bits", "--isa", self.lowest_level(), "--threads", 3, "--tile", 24, "--json").stdout)
        self.assertEqual([result["ways"] for result in report["results"]], [1, 1])
        default, every = (json.loads(self.expect(0, "bits", "--json", *options).stdout)["results"][0]["ways"]
                          for options in ([], ["--all"]))
        self.assertEqual(every, 3 * default - 18)
        self.expect_error("--isa", "bits", "--isa", "v9")
        self.expect_error("--tile", "bits", "--tile", 20)
        self.expect_error("--threads", "bits", "--threads", -1)

    def test_planted_difference_is_named(self):
        self.plant(2)
        text = self.expect(1, "bits").stdout
        self.assertRegex(text, r"different: count/one: \w+, 2 threads, tile 64: plane numbers, tile at \(64, 32\), "
                               r"pixel \(66, 33\) channel 1: 45b7a800 \(5877\) instead of 45b7a000 \(5876\) "
                               r"as with \w+, 1 thread, tile 64; \d+ of \d+ ways differ\n")
        self.assertIn("0 of 2 cases have the bits", text)
        report = json.loads(self.expect(1, "bits", "--json", "--case", "*/two").stdout)
        self.assertEqual((report["checked"], report["same"]), (1, 0))
        difference = report["results"][0]["difference"]
        self.assertEqual(difference["tile"], [64, 32])
        self.assertEqual((difference["pixel"]["x"], difference["pixel"]["y"], difference["pixel"]["channel"]), (66, 33, 1))
        self.expect(0, "bits", "--threads", 1)

    def test_difference_of_every_way_is_named_by_words(self):
        self.expect(0, "bits", "--dump", "words.bin")
        self.plant(0)
        text = self.expect(1, "bits").stdout
        self.assertIn("plane numbers, tile at (64, 32): no way of this machine gives the expected hash", text)
        text = self.expect(1, "bits", "--against", "words.bin").stdout
        self.assertIn("pixel (66, 33) channel 1: 45b7a800 (5877) instead of 45b7a000 (5876); ", text)
        (self.folder / "planted.txt").unlink()
        self.expect(0, "bits", "--against", "words.bin")

    def test_damaged_words_are_bad_input(self):
        self.expect(0, "bits", "--dump", "words.bin")
        file = self.folder / "words.bin"
        words = file.read_bytes()
        for damaged, reason in ((words[:-1], "the file was cut"), (words[:-1] + b"\x7f", "are damaged"),
                                (words + b"\0", "1 bytes too many"), (words[:40], "was cut"), (b"", "the first line"),
                                (bytes(range(256)), "the first line")):
            file.write_bytes(damaged)
            self.expect_error(reason, "bits", "--against", "words.bin")
        self.expect_error("none.bin: no such file", "bits", "--against", "none.bin")
        self.expect_error("--dump", "bits", "--dump", "a.bin", "--against", "words.bin")

    def test_bad_reference_is_bad_input(self):
        text = self.reference.read_text()
        for damaged, reason in (("", ":1: the first line"), ("{}\n", ":1: the first line"),
                                (text[:-1], "was cut"), (text[:len(text) // 2], "golden/bits.txt:"),
                                (text.replace("float32", "float16"), ":5: unknown kind")):
            self.reference.write_text(damaged)
            self.expect_error(reason, "bits")
        self.reference.unlink()
        self.expect_error("golden/bits.txt: no such file", "bits")
        self.expect_error("golden: no such file, or it cannot be read", "bits", "--reference", "golden")

    def test_nothing_to_check(self):
        self.expect(3, "bits", "--case", "three/*")
        self.expect(3, "bits", "--case", "three/*", "--dump", "words.bin")
        self.assertEqual(self.files(), ["golden/bits.txt"])

    def test_accept_writes_only_changes_that_all_ways_agree_on(self):
        before = self.reference.read_bytes()
        self.assertIn("unchanged: golden/bits.txt", self.expect(0, "bits", "--accept", "--reason", "again").stdout)
        self.assertEqual(self.reference.read_bytes(), before)
        self.plant(7)
        text = self.expect(1, "bits", "--accept", "--reason", "worse").stdout
        self.assertIn("the ways of this machine do not agree: nothing was written", text)
        self.assertEqual(self.reference.read_bytes(), before)
        self.plant(0)
        self.assertIn("accepted: golden/bits.txt: 2 cases", self.expect(0, "bits", "--accept", "--reason", "new").stdout)
        self.assertIn("\nreason new\n", self.reference.read_text())
        self.expect(0, "bits")
        self.reference.write_text("damaged")
        self.expect(0, "bits", "--accept", "--reason", "repaired")
        self.expect(0, "bits")

    def test_accept_needs_a_reason_and_all_cases(self):
        before = self.reference.read_bytes()
        self.expect_error("--reason", "bits", "--accept")
        self.expect_error("reason", "bits", "--accept", "--reason", "  ")
        self.expect_error("one line", "bits", "--accept", "--reason", "a\nb")
        self.expect_error("--case", "bits", "--accept", "--reason", "a", "--case", "count/one")
        self.expect_error("--accept", "bits", "--reason", "a")
        self.assertEqual(self.reference.read_bytes(), before)

    def test_other_cases_and_rules_are_differences(self):
        text = self.reference.read_text()
        self.expect_error("not the hash of what stands above it", "bits", *self.rewritten(
            text[:text.index("case count/two")] + text[text.index("all "):]))
        self.assertIn("the reference was made under rules 999",
                      self.expect(1, "bits", *self.rewritten(re.sub(r"rules \d+\n", "rules 999\n", text))).stdout)

    def test_cases_that_one_side_lacks_are_differences(self):
        self.expect(0, "bits", "--dump", "one.bin", "--case", "count/one")
        text = self.expect(1, "bits", "--against", "one.bin").stdout
        self.assertIn("missing: count/two: the reference has no such case", text)
        self.expect(0, "bits", "--against", "one.bin", "--case", "count/one")

    def rewritten(self, text):
        (self.folder / "other.txt").write_text(text)
        return "--reference", "other.txt"

    def test_dump_into_a_missing_folder_is_bad_input(self):
        self.expect_error("none/words.bin", "bits", "--dump", "none/words.bin")


if __name__ == "__main__":
    cli_case.main()
