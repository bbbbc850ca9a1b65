"""What the tests of the command share: run it in a new folder, look at exit code, messages and files."""
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

NOBODY = 65534  # user without rights, when the tests run as root, whom no permission stops


class CliCase(unittest.TestCase):
    program = None

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)
        os.chmod(self.folder, 0o755)

    def tearDown(self):
        for path in self.folder.rglob("*"):
            if path.is_dir():
                os.chmod(path, 0o755)
        self.scratch.cleanup()

    def run_program(self, *arguments, program=None, **options):
        return subprocess.run([program or self.program, *map(str, arguments)], cwd=self.folder, text=True,
                              stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE,
                              timeout=60, check=False, **options)

    def expect(self, code, *arguments, **options):
        """Runs and checks the exit code; errors are one line on standard error, success is silent there."""
        result = self.run_program(*arguments, **options)
        self.assertEqual(result.returncode, code, result.stdout or "" + result.stderr)
        lines = result.stderr.splitlines()
        if code in (2, 3):
            self.assertEqual(len(lines), 1, result.stderr)
            self.assertTrue(lines[0].startswith("etalon: "), lines[0])
        else:
            self.assertEqual(lines, [])
        return result

    def expect_error(self, text, *arguments, **options):
        result = self.expect(2, *arguments, **options)
        self.assertIn(text, result.stderr)
        return result

    def on_terminal(self, *arguments):
        """What a terminal as standard error gets to see; the exit code is 0."""
        master, terminal = pty.openpty()
        process = subprocess.Popen([self.program, *map(str, arguments)], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        text = b""
        try:
            while piece := os.read(master, 4096):
                text += piece
        except OSError:
            pass  # the other side is closed
        os.close(master)
        self.assertEqual(process.wait(), 0)
        return text.decode()

    def on_slow_terminal(self, pattern, arguments_of, sizes):
        """on_terminal for the first of the sizes that shows the pattern: one that takes a second on this machine."""
        for size in sizes:
            text = self.on_terminal(*arguments_of(size))
            if re.search(pattern, text):
                return text
        self.fail(f"no {pattern} in {text!r}")

    def lowest_level(self):
        """The first of the instruction set levels that are built."""
        return re.search(r"--isa TEXT:\{(\w+)", self.run_program("bits", "--help").stdout).group(1)

    def unprivileged(self):
        """Options of run_program that run a copy of the program as a user whom permissions stop."""
        if os.geteuid() != 0:
            return {}
        return {"program": self.installed_copy()[0], "preexec_fn": lambda: os.setuid(NOBODY)}

    def installed_copy(self):
        """Copies of the program and of its image module, placed to each other as in an installation."""
        program = pathlib.Path(self.program).resolve()
        prefix = program.parent.parent
        copies = []
        for source in (program, next(prefix.glob("lib*/**/etalon_image_io.so"))):
            copies.append(self.folder / "prefix" / source.relative_to(prefix))
            copies[-1].parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, copies[-1])
            os.chmod(copies[-1], 0o755)
        return copies

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file())


def pfm(width, height, values):
    """The bytes of a colour PFM file, rows from the bottom up."""
    return f"PF\n{width} {height}\n-1.0\n".encode() + struct.pack(f"<{len(values)}f", *values)


def main():
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} PROGRAM [unittest options]")
    CliCase.program = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], module="__main__")
