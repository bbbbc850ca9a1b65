#!/usr/bin/env python3
"""The verb outputs, and that docs/outputs.md has what it prints. Usage: outputs_cli.py PROGRAM DOCS_FOLDER"""
import json
import pathlib
import re
import sys

import cli_case
from cli_case import CliCase

DOCS = None


class Outputs(CliCase):
    def test_the_document_has_the_table(self):
        table = self.expect(0, "outputs").stdout
        text = (DOCS / "outputs.md").read_text()
        begin, end = "<!-- etalon outputs -->\n", "<!-- end -->\n"
        self.assertEqual(text.count(begin), 1)
        self.assertEqual(text.split(begin)[1].split(end)[0], table)

    def test_json_names_what_the_command_takes(self):
        outputs = json.loads(self.expect(0, "outputs", "--json").stdout)
        taken = re.search(r"--outputs TEXT:\{([^}]*)\}", self.run_program("plan", "--help").stdout).group(1)
        self.assertEqual([output["name"] for output in outputs], taken.split(","))
        for output in outputs:
            self.assertTrue(output["parts"])
            for part in output["parts"]:
                self.assertTrue(part["channels"])

    def test_a_channel_has_one_output(self):
        channels = [channel for output in json.loads(self.expect(0, "outputs", "--json").stdout)
                    if not output["file"] for part in output["parts"] for channel in part["channels"]]
        self.assertEqual(len(channels), len(set(channels)))


if __name__ == "__main__":
    DOCS = pathlib.Path(sys.argv.pop(2)).resolve()
    cli_case.main()
