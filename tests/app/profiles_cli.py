#!/usr/bin/env python3
"""The verb profiles, and profile files in scenes and options. Usage: profiles_cli.py PROGRAM SCENES_FOLDER"""
import json
import pathlib
import shutil
import sys

import cli_case
from cli_case import CliCase, pfm

SCENES = None
NAMES = ["f32", "f64", "truth", "d3d11", "vulkan-min", "nvidia", "nv40-fp32", "nv40-fp16", "r300-fp24", "fp16",
         "bf16"]
SCENE = """
[camera]
width = 32
height = 24
fov_y_deg = 45
near = 0.1
far = 10
position = [0, 0, 3.5]
look_at = [0, 0, 0]
[render]
{render}
[material.matt]
kind = "blinn_phong"
diffuse = [0.5, 0.4, 0.3]
specular = [0.3, 0.3, 0.3]
exponent = 20
[[mesh]]
file = "meshes/sphere.ply"
material = "matt"
[[plane]]
point = [0, -1, 0]
normal = [0, 1, 0]
size_m = [6, 6]
material = "matt"
[[light]]
kind = "directional"
direction = [-1, -1, -1]
irradiance = [3, 3, 3]
shadow = "map"
shadow_size = 64
shadow_taps = 2
"""


class Profiles(CliCase):
    def setUp(self):
        super().setUp()
        shutil.copytree(SCENES / "meshes", self.folder / "meshes")

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def render(self, image, *options, render=""):
        self.write("scene.toml", SCENE.format(render=render))
        self.expect(0, "render", "scene.toml", "-o", image, *options)

    def same(self, a, b):
        self.expect(0, "compare", a, b)

    def differ(self, a, b):
        self.expect(1, "compare", a, b)

    def test_all_profiles_are_explained(self):
        text = self.expect(0, "profiles").stdout
        report = json.loads(self.expect(0, "profiles", "--json").stdout)
        self.assertEqual([profile["name"] for profile in report], NAMES)
        for profile in report:
            self.assertIn(f"# {profile['name']}: {profile['meaning']}\n", text)
            keys = [field["key"] for field in profile["fields"]]
            for key in ("vertex", "depth", "depth_rounding", "depth_order", "depth_direction", "subpixel_bits", "texture_fraction_bits",
                        "texture_filter", "depth_bias_unit", "volume_stencil",
                        "environment"):
                self.assertIn(key, keys)
        old = next(profile for profile in report if profile["name"] == "r300-fp24")
        fields = {field["key"]: field for field in old["fields"]}
        self.assertEqual(fields["fragment.significand_bits"]["value"], 17)
        self.assertEqual(fields["fragment.division"]["value"], "exact")
        self.assertIn("MesaR300", fields["fragment.division"]["documented"])
        self.assertTrue(fields["fragment.division"]["assumed"])

    def test_one_profile_is_explained(self):
        text = self.expect(0, "profiles", "fp16").stdout
        self.assertTrue(text.startswith("# fp16: "))
        self.assertNotIn("bf16", text)
        self.assertEqual(len(json.loads(self.expect(0, "profiles", "fp16", "bf16", "--json").stdout)), 2)
        self.expect_error("did you mean", "profiles", "fp17")

    def test_what_is_printed_is_a_profile_file(self):
        self.write("copy.toml", self.expect(0, "profiles", "r300-fp24").stdout)
        self.render("a.exr", "--profile", "r300-fp24")
        self.render("b.exr", "--profile", "copy.toml")
        self.same("a.exr", "b.exr")
        self.assertTrue(self.expect(0, "profiles", "copy.toml").stdout.startswith("# copy.toml: "))

    def test_scene_and_option_take_a_file(self):
        (self.folder / "sub").mkdir()
        self.write("sub/half.toml", 'base = "fp16"\n')
        self.render("a.exr", "--profile", "fp16")
        self.render("b.exr", "--profile", "sub/half.toml")
        self.render("c.exr", render='profile = "sub/half.toml"')
        self.same("a.exr", "b.exr")
        self.same("a.exr", "c.exr")
        self.render("d.exr", "--profile", "f32", render='profile = "sub/half.toml"')
        self.differ("a.exr", "d.exr")
        self.expect(0, "plan", "scene.toml", "--profile", "sub/half.toml")

    def test_division_and_power_in_steps_show(self):
        self.write("steps.toml", '[fragment]\nformat = "fp24-r300"\ndivision = "reciprocal"\npower = "exp2log2"\n')
        self.write("once.toml", '[fragment]\nformat = "fp24-r300"\n')
        self.render("a.exr", "--profile", "steps.toml")
        self.render("b.exr", "--profile", "once.toml")
        self.differ("a.exr", "b.exr")

    def test_the_light_of_an_environment_has_an_arithmetic_of_its_own(self):
        (self.folder / "sky.pfm").write_bytes(pfm(16, 8, [i % 7 + 0.3 for i in range(3 * 16 * 8)]))
        self.write("half.toml", 'environment = "fp16"\n')
        self.write("same.toml", 'environment = "fp64"\n')
        for lighting in ("harmonics", "map", "exact", "lights", "blurred", "blurred_normalised"):
            sky = f'[environment]\nfile = "sky.pfm"\nlighting = "{lighting}"\n'
            if lighting in ("map", "blurred", "blurred_normalised"):
                sky += "map_size = 8\n"
            scene = self.write("sky.toml", SCENE.format(render="") + sky)
            with self.subTest(lighting=lighting):
                for image, profile in (("a.exr", "f32"), ("b.exr", "half.toml"), ("c.exr", "same.toml")):
                    self.expect(0, "render", scene, "-o", image, "--profile", profile)
                self.differ("a.exr", "b.exr")
                self.same("a.exr", "c.exr")
                for profile, arithmetic in (("f32", "fp64"), ("half.toml", "fp16")):
                    plan = json.loads(self.expect(0, "plan", scene, "--json", "--profile", profile).stdout)
                    light = next(one for one in plan["passes"] if one["name"] == "environment light")
                    self.assertTrue(light["runs"])
                    self.assertEqual(light["arithmetic"], arithmetic)

    def test_stochastic_rounding_is_the_same_for_threads_tiles_and_levels(self):
        self.write("draw.toml", '[fragment]\nformat = "fp16"\nrounding = "stochastic"\nseed = 5\n')
        self.write("other.toml", '[fragment]\nformat = "fp16"\nrounding = "stochastic"\nseed = 6\n')
        render = "samples = 4"
        self.render("a.exr", "--profile", "draw.toml", "--threads", "1", "--tile", "64", render=render)
        self.render("b.exr", "--profile", "draw.toml", "--threads", "3", "--tile", "16", render=render)
        self.render("c.exr", "--profile", "draw.toml", "--isa", self.lowest_level(), "--tile", "32", render=render)
        self.render("d.exr", "--profile", "other.toml", render=render)
        self.same("a.exr", "b.exr")
        self.same("a.exr", "c.exr")
        self.differ("a.exr", "d.exr")

    def test_bad_files_are_one_line(self):
        scene = self.write("scene.toml", SCENE.format(render=""))
        for text, message in (('base = "f31"', "own.toml:1: 'base'"),
                              ("subpixels = 4", "own.toml:1: unknown key 'subpixels'"),
                              ("[fragment]\nsignificand_bits = 53", "own.toml:2: 'significand_bits' in [fragment]"),
                              ("[fragment]\nmax_exponent = 3", "own.toml:2: 'max_exponent' in [fragment]"),
                              ('environment = "fp17"', "own.toml:1: 'environment'"),
                              ("[environment]\nrounding = 1", "own.toml:2: 'rounding' in [environment]"),
                              ("base", "own.toml:1: not valid TOML")):
            with self.subTest(text=text):
                self.write("own.toml", text + "\n")
                self.expect_error(message, "render", scene, "-o", "a.exr", "--profile", "own.toml")
                self.expect_error(message, "profiles", "own.toml")
                self.expect_error(message, "plan", self.write("b.toml", SCENE.format(render='profile = "own.toml"')))
        self.expect_error("none.toml: no such profile file", "profiles", "none.toml")
        self.expect_error("neither one of", "render", scene, "-o", "a.exr", "--profile", "f31")
        self.assertFalse((self.folder / "a.exr").exists())

    def test_the_smallest_formats_render_and_say_what_they_cannot_sample(self):
        self.write("tiny.toml", "[fragment]\nsignificand_bits = 2\nmin_exponent = -4\nmax_exponent = 5\n")
        self.render("a.exr", "--profile", "tiny.toml")
        for width, height, message in ((64, 32, "holds no 64"), (40, 20, "holds no 40"), (32, 16, "")):
            (self.folder / "sky.pfm").write_bytes(pfm(width, height, [1.0] * (3 * width * height)))
            scene = self.write("sky.toml", SCENE.format(render="") + '[environment]\nfile = "sky.pfm"\n')
            arguments = ("render", scene, "-o", "b.exr", "--profile", "tiny.toml")
            if message:
                self.expect_error(f"sky.toml:32: an environment of {width}x{height} texels cannot be sampled in the "
                                  f"profile tiny.toml: its format {message}", *arguments)
            else:
                self.expect(0, *arguments)


if __name__ == "__main__":
    SCENES = pathlib.Path(sys.argv.pop(2)).resolve()
    cli_case.main()
