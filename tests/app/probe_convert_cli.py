"""etalon probe convert and info: mappings, layouts, attributes, energy, bad files and options."""
import json
import math

import cli_case


def pfm(width, height, pixel):
    """RGB; pixel(x, y) with y from the top down."""
    return cli_case.pfm(width, height,
                        [value for y in reversed(range(height)) for x in range(width) for value in pixel(x, y)])


class ProbeConvert(cli_case.CliCase):
    def setUp(self):
        super().setUp()
        (self.folder / "sky.pfm").write_bytes(
            pfm(32, 16, lambda x, y: (1.0 + x, 2.0 if y < 8 else 1.0, 3.0)))

    def info(self, *arguments):
        return json.loads(self.expect(0, "probe", "info", *arguments, "--json").stdout)

    def convert(self, *arguments):
        self.expect(0, "probe", "convert", *arguments)

    def test_info_says_what_a_probe_holds(self):
        report = self.info("sky.pfm")
        self.assertEqual((report["mapping"], report["width"], report["height"]), ("latlong", 32, 16))
        self.assertEqual((report["smallest"], report["largest"]), (1.0, 32.0))
        self.assertEqual(report["dynamic_range_stops"], 5.0)
        for found, mean in zip(report["mean_radiance"], (16.5, 1.5, 3.0)):
            self.assertAlmostEqual(found, mean, places=12)
        self.assertAlmostEqual(report["solid_angle_sr"], 4 * math.pi, places=12)
        # The sky is twice as bright as the ground; the midpoint rule of 16 rows is off by 1 %.
        self.assertAlmostEqual(report["irradiance"]["+y"][1], 2 * math.pi, delta=0.06)
        self.assertAlmostEqual(report["irradiance"]["-y"][1], math.pi, delta=0.03)
        self.assertEqual((report["negative"], report["infinite"], report["nan"]), (0, 0, 0))

    def test_progress_shows_on_a_terminal_after_a_second(self):
        convert = ("probe", "convert", "sky.pfm", "--to", "mirror_ball", "-o", "a.exr", "--threads", 1)
        self.assertEqual(self.on_terminal(*convert), "")
        text = self.on_slow_terminal(
            r"converting: (step \d+, )?\d+ %, \d+ s left",
            lambda width: (*convert, "--width", width), (400, 600, 900, 1400, 2100))
        self.assertTrue(text.endswith("\x1b[K"))

    def test_what_is_no_radiance_is_counted(self):
        values = {(0, 0): (-1.0, math.nan, math.inf), (1, 0): (math.nan, 1.0, 1.0)}
        (self.folder / "bad.pfm").write_bytes(pfm(8, 4, lambda x, y: values.get((x, y), (1.0, 1.0, 1.0))))
        report = self.info("bad.pfm")
        self.assertEqual((report["negative"], report["infinite"], report["nan"]), (1, 1, 2))
        self.assertEqual(report["mean_radiance"][2], "inf")

    def test_every_mapping_is_written_and_told_by_its_file(self):
        for mapping in ("latlong", "cube", "angular", "mirror_ball", "octahedral", "latlong_pedersen"):
            self.convert("sky.pfm", "--to", mapping, "-o", "a.exr")
            report = self.info("a.exr")
            self.assertEqual(report["mapping"], mapping)
            self.assertAlmostEqual(report["solid_angle_sr"], 4 * math.pi, delta=1e-6)
            for found, mean in zip(report["mean_radiance"], (16.5, 1.5, 3.0)):
                self.assertAlmostEqual(found, mean, delta=1e-5 * mean)
            # And back: the upper half is still the sky.
            self.convert("a.exr", "--to", "latlong", "--width", 32, "-o", "b.exr")
            up, down = (self.info("b.exr")["irradiance"][axis][1] for axis in ("+y", "-y"))
            self.assertAlmostEqual(up / down, 2.0, delta=0.05)

    def test_a_small_sun_is_kept_and_samples_that_lose_it_warn(self):
        sun = lambda x, y: (5e4, 5e4, 5e4) if (x, y) == (83, 41) else (1.0, 1.0, 1.0)
        (self.folder / "sun.pfm").write_bytes(pfm(256, 128, sun))
        mean = self.info("sun.pfm")["mean_radiance"][0]
        self.assertGreater(mean, 2)
        for mapping, width in (("latlong", 32), ("cube", 16), ("octahedral", 500)):
            with self.subTest(mapping=mapping):
                convert = ("probe", "convert", "sun.pfm", "--to", mapping, "--width", width, "-o", "a.exr")
                self.expect(0, *convert)
                self.assertAlmostEqual(self.info("a.exr")["mean_radiance"][0], mean, delta=1e-5 * mean)
        for resample in ("bilinear", "nearest"):
            convert = ("probe", "convert", "sun.pfm", "--to", "latlong", "--width", 32, "-o", "a.exr")
            result = self.run_program(*convert, "--resample", resample)
            self.assertEqual(result.returncode, 0)
            said = result.stderr
            found = self.info("a.exr")["mean_radiance"][0]
            self.assertLess(found, 0.6 * mean)
            self.assertEqual(said.count("\n"), 1)
            self.assertIn("etalon: warning: sun.pfm: " + resample, said)
            self.assertIn(f"was {mean:.6g} and is {found:.6g}", said)
        # Nothing is finer than the result's texels.
        self.expect(0, "probe", "convert", "sun.pfm", "--to", "latlong", "--width", 512, "-o", "a.exr",
                    "--resample", "bilinear")

    def test_cube_layouts_hold_the_same_probe(self):
        means = []
        for layout, shape in (("openexr", None), ("strip", "strip"), ("horizontal_cross", None),
                              ("vertical_cross", None)):
            self.convert("sky.pfm", "--to", "cube", "--width", 8, "--to-layout", layout, "-o", "a.exr")
            arguments = ["--layout", shape] if shape else []
            report = self.info("a.exr", *arguments)
            self.assertEqual(report["width"], 8)
            means.append((report["mean_radiance"], report["irradiance"]))
        self.assertEqual(means.count(means[0]), 4)

    def test_orientation_is_kept_and_honoured(self):
        # A quarter turn of the frame: the file's own axes show another picture, the world the same.
        self.convert("sky.pfm", "--to", "latlong", "--rotate-y-deg", 90, "-o", "turned.exr")
        self.convert("turned.exr", "--to", "latlong", "--upright", "-o", "back.exr")
        self.convert("sky.pfm", "--to", "latlong", "-o", "same.exr")
        before, turned, after = (self.info(name)["irradiance"] for name in ("same.exr", "turned.exr", "back.exr"))
        for axis in before:
            for a, b, c in zip(before[axis], turned[axis], after[axis]):
                self.assertAlmostEqual(a, b, delta=1e-5 * a)
                self.assertAlmostEqual(a, c, delta=1e-5 * a)
        self.expect(1, "compare", "same.exr", "turned.exr")

    def test_bad_input_is_named(self):
        (self.folder / "square.pfm").write_bytes(pfm(4, 4, lambda x, y: (1.0, 1.0, 1.0)))
        (self.folder / "odd.pfm").write_bytes(pfm(5, 3, lambda x, y: (1.0, 1.0, 1.0)))
        (self.folder / "cut.pfm").write_bytes((self.folder / "sky.pfm").read_bytes()[:-9])
        (self.folder / "empty.pfm").write_bytes(b"")
        self.expect_error("square.pfm: 4x4 may be any mapping", "probe", "info", "square.pfm")
        self.expect_error("odd.pfm: 5x3 is not square", "probe", "info", "odd.pfm", "--mapping", "angular")
        self.expect_error("odd.pfm: 5x3 is no strip", "probe", "info", "odd.pfm", "--mapping", "cube")
        self.expect_error("sky.pfm: 32x16", "probe", "info", "sky.pfm", "--layout", "openexr")
        self.expect_error("cut.pfm", "probe", "info", "cut.pfm")
        self.expect_error("empty.pfm: the file is empty", "probe", "info", "empty.pfm")
        self.expect_error("missing.exr: no such file", "probe", "info", "missing.exr")
        self.expect_error("a.png", "probe", "convert", "sky.pfm", "--to", "cube", "-o", "a.png")
        self.expect_error("--height 3", "probe", "convert", "sky.pfm", "--to", "cube", "--height", 3, "-o", "a.exr")
        self.expect_error("", "probe", "convert", "sky.pfm", "--to", "spiral", "-o", "a.exr")
        self.expect_error("", "probe")
        self.assertFalse((self.folder / "a.exr").exists())


if __name__ == "__main__":
    cli_case.main()
