#!/usr/bin/env python3
"""The command on a processor that has none of the levels that are built: it says so in one line, and help and version
remain. Usage: no_level.py EMULATOR... PROGRAM"""
import subprocess
import sys
import unittest

COMMAND = []
COMPUTING = [["render", "scene.toml", "-o", "a.exr"], ["plan", "scene.toml"], ["check"], ["accept", "x", "--reason", "y"],
             ["bits"], ["probe", "convert", "a.exr", "-o", "b.exr", "--to", "cube"], ["probe", "info", "a.exr"],
             ["probe", "lights", "a.exr"], ["probe", "sh", "a.exr"]]


class NoLevel(unittest.TestCase):
    def run_command(self, *arguments):
        return subprocess.run([*COMMAND, *arguments], text=True, capture_output=True, timeout=60, check=False)

    def test_help_and_version_succeed(self):
        for arguments in (["--help"], ["--version"], *([*verb, "--help"] for verb in COMPUTING)):
            with self.subTest(arguments=arguments):
                result = self.run_command(*arguments)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertRegex(result.stdout, "etalon")

    def test_verbs_that_compute_are_refused_with_one_line(self):
        for arguments in COMPUTING:
            with self.subTest(arguments=arguments):
                result = self.run_command(*arguments)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertRegex(result.stderr, r"^etalon: this processor has none of the instruction set levels that are "
                                                r"built in:( v[234])+\n$")

    def test_no_level_can_be_chosen(self):
        result = self.run_command("plan", "scene.toml", "--isa", "v2")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"^etalon: --isa: [^\n]*\n$")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    COMMAND = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
