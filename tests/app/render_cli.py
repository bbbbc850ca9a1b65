#!/usr/bin/env python3
"""The verbs render and plan, run as a user would. Usage: render_cli.py PROGRAM SCENES_FOLDER"""
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

import cli_case
from cli_case import CliCase, pfm

SCENES = None

SCENE = """
[camera]
width = {width}
height = {height}
fov_y_deg = 45
near = 0.1
far = 10
position = [0, 0, 3.5]
look_at = [0, 0, 0]
{more}
[material.matt]
kind = "lambert"
diffuse = [0.5, 0.5, 0.5]
[[mesh]]
file = "{mesh}"
material = "matt"
[[light]]
kind = "directional"
direction = [-1, -1, -1]
irradiance = [3, 3, 3]
"""


class Render(CliCase):
    def setUp(self):
        super().setUp()
        shutil.copytree(SCENES / "meshes", self.folder / "meshes")

    def scene(self, name="scene.toml", width=64, height=48, mesh="meshes/sphere.ply", more=""):
        (self.folder / name).write_text(SCENE.format(width=width, height=height, mesh=mesh, more=more))
        return name

    def images(self):
        return [name for name in self.files() if name.endswith((".exr", ".png")) or ".tmp" in name]

    def test_renders_exr_and_png(self):
        self.expect(0, "render", self.scene(), "-o", "a.exr", "-o", "a.png")
        self.assertEqual(self.images(), ["a.exr", "a.png"])
        self.assertEqual((self.folder / "a.png").read_bytes()[:4], b"\x89PNG")

    def test_two_renders_are_the_same_bits(self):
        self.scene()
        self.expect(0, "render", "scene.toml", "-o", "a.exr", "--threads", "1", "--tile", "16",
                    "--isa", self.lowest_level())
        self.expect(0, "render", "scene.toml", "-o", "b.exr", "--threads", "2", "--tile", "128")
        self.expect(0, "compare", "a.exr", "b.exr")
        self.assertEqual((self.folder / "a.exr").read_bytes(), (self.folder / "b.exr").read_bytes())

    def test_profiles_differ(self):
        self.scene()
        self.expect(0, "render", "scene.toml", "-o", "a.exr")
        self.expect(0, "render", "scene.toml", "-o", "b.exr", "--profile", "fp16")
        self.expect(1, "compare", "a.exr", "b.exr")

    def test_json_says_what_ran(self):
        report = json.loads(self.expect(0, "render", self.scene(), "-o", "a.exr", "--json").stdout)
        self.assertEqual(report["width"], 64)
        passes = {p["name"]: p for p in report["passes"]}
        self.assertTrue(passes["visibility"]["runs"])
        self.assertGreater(passes["visibility"]["memory_bytes"], 0)
        self.assertGreaterEqual(passes["shading"]["seconds"], 0)
        self.assertEqual(passes["shading"]["arithmetic"], "fp32")
        self.assertFalse(passes["mirror"]["runs"])
        self.assertIsNone(passes["mirror"]["seconds"])
        self.assertLessEqual(sum(p["seconds"] or 0 for p in passes.values()), report["seconds"])
        self.assertEqual(report["memory_bytes"], sum(p["memory_bytes"] for p in passes.values() if p["runs"]))

    def test_timings_have_a_line_for_each_pass_that_ran(self):
        text = self.expect(0, "render", self.scene(), "-o", "a.exr", "--timings").stdout
        names = [line.split("MiB", 1)[1].strip() for line in text.splitlines()[1:]]
        self.assertIn("shading", names)
        self.assertNotIn("mirror", names)
        self.expect(2, "render", "scene.toml", "-o", "a.exr", "--timings", "--json")

    def test_everything_changes_no_bit(self):
        self.expect(0, "render", self.scene(), "-o", "a.exr")
        report = json.loads(self.expect(0, "render", "scene.toml", "-o", "b.exr", "--everything", "--json").stdout)
        self.assertTrue(all(p["runs"] for p in report["passes"]))
        self.assertEqual((self.folder / "a.exr").read_bytes(), (self.folder / "b.exr").read_bytes())

    def test_outputs_that_are_files_lie_beside_the_image(self):
        light = '[[light]]\nkind = "directional"\ndirection = [-1, -1, -1]\nirradiance = [1, 1, 1]\nshadow = "map"\n'
        self.scene(more=light + "shadow_size = 64\n")
        report = json.loads(self.expect(0, "render", "scene.toml", "-o", "a.exr", "-o", "a.png", "--outputs",
                                        "beauty,shadow,shadow_map", "--json").stdout)
        self.assertEqual(report["files"], ["a.exr", "a.png", "a.shadow_map.light0.exr"])
        self.assertEqual(self.images(), ["a.exr", "a.png", "a.shadow_map.light0.exr"])
        self.expect(0, "compare", "a.shadow_map.light0.exr", "a.shadow_map.light0.exr")
        self.expect_error("has no channel", "render", "scene.toml", "-o", "b.exr", "--outputs", "shadow_map")
        self.assertNotIn("b.exr", self.images())

    def test_a_shadow_map_of_each_of_many_lights_is_a_file(self):
        light = '[[light]]\nkind = "directional"\ndirection = [{}, -9, -1]\nirradiance = [1, 1, 1]\nshadow = "map"\n'
        self.scene(more="".join(light.format(i) + "shadow_size = 16\n" for i in range(40)))
        self.expect(0, "render", "scene.toml", "-o", "a.exr", "--outputs", "beauty,shadow_map")
        self.assertEqual(len(self.images()), 41)

    def test_with_one_thread_there_is_one(self):
        """Looked at while it runs and writes: a look may come too late, but sees no thread that is not there."""
        scene, seen = self.scene(width=900, height=900), []
        with subprocess.Popen([self.program, "render", scene, "-o", "a.exr", "--threads", "1"], cwd=self.folder,
                              stdout=subprocess.DEVNULL) as process:
            while process.poll() is None:
                seen.append(len(os.listdir(f"/proc/{process.pid}/task")))
                time.sleep(0.001)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(max(seen), 1)

    def test_progress_shows_on_a_terminal_after_a_second(self):
        def arguments(width, more=""):
            self.scene(width=width, height=width, more="[render]\nsamples = 16\n" + more)
            return ["render", "scene.toml", "-o", "a.exr", "--threads", "1"]

        def occluded(directions):
            return arguments(200, f'occlusion = {directions}\n[environment]\nconstant = [1, 1, 1]\n'
                                  'lighting = "exact"\n')

        self.assertEqual(self.on_terminal(*arguments(16)), "")
        text = self.on_slow_terminal(r"(?s)shading \(\d+ of \d+\): \d+ %, \d+ s left.*writing a.exr: \d+ %, \d+ s left",
                                     arguments, (1000, 2000, 4000))
        self.assertTrue(text.endswith("\x1b[K"))
        self.on_slow_terminal(r"ambient occlusion \(\d+ of \d+\): step \d+, \d+ %, \d+ s left", occluded, (300, 3000))

    def test_plan_as_text_json_and_graph(self):
        self.scene()
        self.assertIn("visibility", self.expect(0, "plan", "scene.toml").stdout)
        passes = json.loads(self.expect(0, "plan", "scene.toml", "--json").stdout)["passes"]
        self.assertFalse(next(p for p in passes if p["name"] == "mirror")["runs"])
        self.assertTrue(self.expect(0, "plan", "scene.toml", "--dot").stdout.startswith("digraph"))
        self.expect(2, "plan", "scene.toml", "--dot", "--json")

    def test_usage_errors(self):
        self.scene()
        for arguments in (["render"], ["render", "scene.toml"], ["render", "scene.toml", "-o"],
                          ["render", "scene.toml", "-o", "a.exr", "--profile", "f31"],
                          ["render", "scene.toml", "-o", "a.exr", "--tile", "20"],
                          ["render", "scene.toml", "-o", "a.exr", "--tile", "0x0c"],
                          ["render", "scene.toml", "-o", "a.exr", "--tile", "many"],
                          ["render", "scene.toml", "-o", "a.exr", "--threads", "-1"],
                          ["render", "scene.toml", "-o", "a.exr", "--isa", "v9"],
                          ["render", "scene.toml", "-o", "a.exr", "--outputs", "beauty,glow"]):
            with self.subTest(arguments=arguments):
                self.expect(2, *arguments)
        self.assertEqual(self.images(), [])

    def test_bad_files_are_one_line_and_leave_nothing(self):
        (self.folder / "empty.toml").write_text("")
        (self.folder / "broken.toml").write_text("[camera\n")
        (self.folder / "empty.obj").write_text("")
        (self.folder / "short.ply").write_bytes((self.folder / "meshes/sphere.ply").read_bytes()[:5000])
        (self.folder / "empty.exr").write_bytes(b"")
        (self.folder / "short.pfm").write_bytes(pfm(8, 4, [1.0] * 96)[:-10])
        environment = '[environment]\nfile = "{}"\n'
        cases = [
            ("missing.toml", "missing.toml"),
            ("empty.toml", "empty.toml"),
            ("broken.toml", "broken.toml:1"),
            (self.scene("a.toml", mesh="empty.obj"), "empty.obj"),
            (self.scene("b.toml", mesh="short.ply"), "short.ply"),
            (self.scene("c.toml", mesh="none.obj"), "none.obj"),
            (self.scene("d.toml", more=environment.format("empty.exr")), "empty.exr"),
            (self.scene("e.toml", more=environment.format("short.pfm")), "short.pfm"),
            (self.scene("f.toml", more=environment.format("none.exr")), "none.exr"),
            (self.scene("g.toml", width=0, height=0), "g.toml:3"),
            (self.scene("h.toml", width=70000, height=70000), "h.toml:3"),
        ]
        for scene, text in cases:
            with self.subTest(scene=scene):
                self.expect_error(text, "render", scene, "-o", "out.exr")
        self.assertEqual(self.images(), ["empty.exr"])

    def test_an_image_beyond_the_memory_is_refused_with_its_size(self):
        self.scene(width=65536, height=65536, more="[render]\nsamples = 16\n")
        self.assertIn("GiB", self.expect_error("scene.toml", "render", "scene.toml", "-o", "out.exr").stderr)
        self.assertEqual(self.images(), [])

    def test_an_unknown_kind_of_image_is_refused(self):
        self.expect_error("a.jpg", "render", self.scene(), "-o", "a.jpg")

    def test_folders_that_refuse_files(self):
        self.scene()
        locked = self.folder / "locked"
        locked.mkdir()
        os.chmod(locked, 0o555)
        self.expect_error("locked/a.exr", "render", "scene.toml", "-o", "locked/a.exr", **self.unprivileged())
        self.expect_error("nowhere/a.exr", "render", "scene.toml", "-o", "nowhere/a.exr")
        self.assertEqual(self.images(), [])

    def test_a_full_disk_leaves_the_old_file(self):
        self.scene(width=256, height=256)
        (self.folder / "a.exr").write_bytes(b"old")
        self.expect_error("a.exr", "render", "scene.toml", "-o", "a.exr",
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.assertEqual((self.folder / "a.exr").read_bytes(), b"old")
        self.assertEqual(self.images(), ["a.exr"])

    def test_an_interrupted_render_leaves_nothing(self):
        self.scene(width=8192, height=8192)
        process = subprocess.Popen([self.program, "render", "scene.toml", "-o", "a.exr"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        # The temporary file appears before the work starts.
        for _ in range(200):
            if len(list(self.folder.glob("*a.exr*"))) + len(list(self.folder.glob(".*"))) > 0:
                break
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        self.assertEqual([p.name for p in self.folder.iterdir() if "a.exr" in p.name], [])

    def test_negative_radiance_warns_or_is_refused(self):
        (self.folder / "probe.pfm").write_bytes(pfm(4, 2, [-1.0] + [1.0] * 23))
        self.scene(more='[environment]\nfile = "probe.pfm"\n')
        result = self.run_program("render", "scene.toml", "-o", "a.exr")
        self.assertEqual(result.returncode, 0)
        self.assertIn("warning: ", result.stderr)
        self.assertIn("1 negative", result.stderr)
        self.expect_error("1 negative", "render", "scene.toml", "-o", "b.exr", "--strict")

    def test_zero_area_and_large_meshes(self):
        (self.folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
        self.scene("flat.toml", mesh="flat.obj")
        result = self.run_program("render", "flat.toml", "-o", "a.exr")
        self.assertEqual(result.returncode, 0)
        self.assertIn("flat.obj", result.stderr)

    def test_the_image_module_is_loaded_only_for_images(self):
        def loaded(*arguments):
            # The dynamic loader says on standard error which files it opens.
            result = self.run_program(*arguments, env={**os.environ, "LD_DEBUG": "files"})
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("libstdc++", result.stderr)
            return "etalon_image_io.so" in result.stderr or "libOpenImageIO" in result.stderr

        self.scene()
        self.assertFalse(loaded("--help"))
        self.assertFalse(loaded("plan", "scene.toml"))
        self.assertFalse(loaded("render", "scene.toml", "-o", "a.exr"))
        self.assertTrue(loaded("render", "scene.toml", "-o", "a.png"))
        (self.folder / "probe.pfm").write_bytes(pfm(4, 2, [1.0] * 24))
        self.scene("lit.toml", more='[environment]\nfile = "probe.pfm"\n')
        self.assertTrue(loaded("render", "lit.toml", "-o", "b.exr"))

    def test_a_missing_or_broken_image_module_is_one_line(self):
        program, module = self.installed_copy()
        arguments = ["render", self.scene(), "-o", "a.png"]
        self.expect(0, *arguments, program=program)
        os.unlink(self.folder / "a.png")
        module.write_bytes(b"")
        self.expect_error(f"{module}: cannot be loaded: ", *arguments, program=program)
        module.unlink()
        self.expect_error(f"{module}: no such module", *arguments, program=program)
        self.assertEqual(self.images(), [])
        self.expect(0, "render", "scene.toml", "-o", "a.exr", program=program)
        self.expect_error(f"{module}: no such module", "compare", "a.exr", "a.exr", program=program)


if __name__ == "__main__":
    SCENES = pathlib.Path(sys.argv.pop(2)).resolve()
    cli_case.main()
