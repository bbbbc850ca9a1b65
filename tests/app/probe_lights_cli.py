"""etalon probe lights: lights of a probe as text and JSON, bad options and files."""
import json
import math

import cli_case


def pfm(width, height, pixels):
    """RGB pixels in rows from the top down."""
    rows = [pixels[y * width:(y + 1) * width] for y in range(height)]
    return cli_case.pfm(width, height, [value for row in reversed(rows) for pixel in row for value in pixel])


class ProbeLights(cli_case.CliCase):
    def setUp(self):
        super().setUp()
        pixels = [(1.0, 2.0, 3.0)] * (16 * 8)
        pixels[2 * 16 + 4] = (5000.0, 5000.0, 5000.0)
        def write(name, content):
            (self.folder / name).write_bytes(content)

        write("probe.pfm", pfm(16, 8, pixels))
        write("black.pfm", pfm(16, 8, [(0.0, 0.0, 0.0)] * 128))
        write("bad.pfm", pfm(16, 8, [(-1.0, math.nan, 1.0)] + [(1.0, 1.0, 1.0)] * 127))

    def lights(self, *arguments):
        result = self.run_program("probe", "lights", *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        for line in result.stderr.splitlines():
            self.assertRegex(line, "warning: .* of .* lights, because regions of one texel stay whole")
        return json.loads(result.stdout)

    def test_lights_add_up_to_the_probe(self):
        for count in (1, 2, 16, 128):
            report = self.lights("probe.pfm", "--count", count)
            # A region of one texel, here the sun, is not cut again.
            self.assertEqual(len(report["lights"]), {1: 1, 2: 2, 16: 16, 128: 92}[count])
            total = [sum(light["energy"][c] for light in report["lights"]) for c in range(3)]
            theta = math.pi / 8
            sun = math.pi / 8 * (math.cos(2 * theta) - math.cos(3 * theta))
            for c, sky in enumerate((1.0, 2.0, 3.0)):
                self.assertAlmostEqual(total[c], 4 * math.pi * sky + (5000 - sky) * sun, delta=1e-4)
                self.assertAlmostEqual(report["total_energy"][c], total[c], places=9)
            solid_angle = sum(light["solid_angle_sr"] for light in report["lights"])
            self.assertAlmostEqual(solid_angle, 4 * math.pi, places=12)
            for light in report["lights"]:
                self.assertAlmostEqual(math.hypot(*light["direction"]), 1.0, places=12)

    def test_log2_and_count_say_the_same(self):
        self.assertEqual(self.lights("probe.pfm", "--log2", 4), self.lights("probe.pfm", "--count", 16))
        self.assertEqual(len(self.lights("probe.pfm", "--log2", 20)["lights"]), 128)
        self.assertEqual(len(self.lights("black.pfm")["lights"]), 64)

    def test_fewer_lights_than_asked_for_are_named(self):
        result = self.run_program("probe", "lights", "probe.pfm", "--log2", 20)
        self.assertEqual(result.returncode, 0)
        self.assertIn("probe.pfm: 128 of 1048576 lights, because", result.stderr)
        self.expect(0, "probe", "lights", "probe.pfm", "--log2", 2)

    def test_threads_change_nothing(self):
        self.assertEqual(self.lights("probe.pfm", "--threads", 1), self.lights("probe.pfm", "--threads", 3))

    def test_variants_differ(self):
        base = self.lights("probe.pfm", "--count", 64)["lights"]
        for option in (("--cut", "angle"), ("--position", "centre"), ("--weights", "uniform")):
            self.assertNotEqual(self.lights("probe.pfm", "--count", 64, *option)["lights"], base, option)

    def test_text_has_a_line_per_light(self):
        lines = self.expect(0, "probe", "lights", "probe.pfm", "--count", 8).stdout.splitlines()
        self.assertEqual(len([line for line in lines if not line.startswith("#")]), 8)
        self.assertIn("8 lights", lines[-1])

    def test_dominant_light_is_the_sun(self):
        report = self.lights("probe.pfm", "--method", "dominant")
        self.assertEqual(len(report["lights"]), 1)
        light = report["lights"][0]
        self.assertEqual(light["region"], [4, 2, 5, 3])
        longitude, latitude = 2 * math.pi * (0.5 - 4.5 / 16), math.pi * (0.5 - 2.5 / 8)
        expected = (math.sin(longitude) * math.cos(latitude), math.sin(latitude),
                    math.cos(longitude) * math.cos(latitude))
        for got, want in zip(light["direction"], expected):
            self.assertAlmostEqual(got, want, places=12)
        self.assertEqual(self.lights("black.pfm", "--method", "dominant")["lights"], [])

    def test_what_is_no_radiance_is_a_warning(self):
        result = self.run_program("probe", "lights", "bad.pfm", "--json")
        self.assertEqual(result.returncode, 0)
        self.assertIn("bad.pfm: 2 negative, infinite or NaN values", result.stderr)
        self.assertAlmostEqual(json.loads(result.stdout)["total_energy"][2], 4 * math.pi, places=12)

    def test_bad_input_is_one_line(self):
        self.expect_error("not a power of two", "probe", "lights", "probe.pfm", "--count", 6)
        self.expect_error("--log2", "probe", "lights", "probe.pfm", "--log2", -1)
        self.expect_error("excludes", "probe", "lights", "probe.pfm", "--log2", 3, "--count", 8)
        self.expect_error("--cut", "probe", "lights", "probe.pfm", "--cut", "longest")
        self.expect_error("missing.pfm", "probe", "lights", "missing.pfm")


if __name__ == "__main__":
    cli_case.main()
