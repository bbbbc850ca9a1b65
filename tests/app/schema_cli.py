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

    def test_the_tables_list_the_keys_that_are_known_and_no_others(self):
        listed = {}
        for table in TABLE.findall(self.expect(0, "schema").stdout):
            first_cells = "".join(line.split("|")[1] for line in table.splitlines() if line.startswith("| `"))
            listed[re.match("<!-- schema: (.*?) -->", table).group(1)] = set(re.findall(r"`(\w+)`", first_cells))
        shadows = listed.pop('shadow = "map"') | listed.pop('shadow = "planar"')
        listed["[[light]]"] |= shadows
        listed["[environment]"] |= shadows | listed.pop("[environment] shadow")
        camera = ("[camera]\nwidth = 1\nheight = 1\nfov_y_deg = 40\nnear = 1\nfar = 2\nposition = [0, 0, 1]\n"
                  "look_at = [0, 0, 0]\n")
        for table, keys in listed.items():
            scene = {"the scene": "x = 1\n", "[camera]": "[camera]\nx = 1\n"}.get(
                table, camera + table.replace("NAME", "m") + "\nx = 1\n")
            (self.folder / "scene.toml").write_text(scene)
            error = self.expect(2, "plan", "scene.toml").stderr
            self.assertIn("unknown key 'x'", error)
            self.assertEqual(set(error.strip().split("known keys: ")[1].split(", ")), keys, table)


if __name__ == "__main__":
    DOCS = pathlib.Path(sys.argv.pop(2)).resolve()
    cli_case.main()
