#!/usr/bin/env python3
"""The verb schema, and that docs/scene_format.md has what it prints. Usage: schema_cli.py PROGRAM DOCS_FOLDER"""
import pathlib
import re
import sys

import cli_case
from cli_case import CliCase

DOCS = None
TABLE = re.compile(r"<!-- schema: .*? -->\n.*?<!-- end -->\n", re.S)


class Schema(CliCase):
    def test_the_document_has_the_tables(self):
        text = self.expect(0, "schema").stdout
        tables = TABLE.findall(text)
        self.assertEqual("".join(tables), text)
        self.assertEqual(TABLE.findall((DOCS / "scene_format.md").read_text()), tables)

    def test_keys_that_are_listed_are_known(self):
        listed = set(re.findall(r"`(\w+)`", "".join(
            line.split("|")[1] for line in self.expect(0, "schema").stdout.splitlines() if line.startswith("| `"))))
        known = set()
        for text in ("x = 1\n", "[camera]\nx = 1\n", "[environment]\nx = 1\n", "[render]\nx = 1\n",
                     "[output]\nx = 1\n", "[[light]]\nx = 1\n", "[[mesh]]\nx = 1\n", "[[plane]]\nx = 1\n",
                     "[material.m]\nx = 1\n"):
            camera = ("[camera]\nwidth = 1\nheight = 1\nfov_y_deg = 40\nnear = 1\nfar = 2\nposition = [0, 0, 1]\n"
                      "look_at = [0, 0, 0]\n")
            (self.folder / "scene.toml").write_text(text if "[camera]" in text or text[0] == "x" else camera + text)
            error = self.expect(2, "plan", "scene.toml").stderr
            self.assertIn("unknown key 'x'", error)
            known |= set(error.strip().split("known keys: ")[1].split(", "))
        self.assertEqual(listed, known)


if __name__ == "__main__":
    DOCS = pathlib.Path(sys.argv.pop(2)).resolve()
    cli_case.main()
