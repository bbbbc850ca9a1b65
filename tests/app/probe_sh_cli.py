"""etalon probe sh: coefficients, windows, layouts, errors."""
import json
import math

from cli_case import CliCase, main, pfm

WIDTH, HEIGHT = 32, 16


class ProbeShTest(CliCase):
    def write(self, name, radiance):
        """A lat-long probe; radiance(x, y) with row 0 on top."""
        values = [v for y in reversed(range(HEIGHT)) for x in range(WIDTH) for v in radiance(x, y)]
        (self.folder / name).write_bytes(pfm(WIDTH, HEIGHT, values))

    def setUp(self):
        super().setUp()
        self.write("white.pfm", lambda x, y: (1, 0.5, 2))
        self.write("sun.pfm", lambda x, y: (1e3, 1e3, 1e3) if (x, y) == (8, 7) else (0.1, 0.1, 0.1))

    def sh(self, *arguments):
        return json.loads(self.expect(0, "probe", "sh", *arguments, "--json").stdout)

    def test_white_probe_is_its_mean(self):
        report = self.sh("white.pfm")
        self.assertEqual(len(report["coefficients"]), 27)
        for got, want in zip(report["coefficients"], (1, 0.5, 2)):
            self.assertAlmostEqual(got, want * 2 * math.sqrt(math.pi), places=6)
        self.assertLess(max(map(abs, report["coefficients"][3:])), 0.05)

    def test_irradiance_of_white_is_pi(self):
        report = self.sh("white.pfm", "--of", "irradiance", "--degree", "0")
        self.assertAlmostEqual(report["coefficients"][0] / (2 * math.sqrt(math.pi)), math.pi, places=6)

    def test_layouts_hold_the_same_numbers(self):
        interleaved = self.expect(0, "probe", "sh", "sun.pfm", "--coefficients", "interleaved").stdout.split()
        planar = self.expect(0, "probe", "sh", "sun.pfm", "--coefficients", "planar").stdout.split()
        self.assertEqual(len(planar), 27)
        self.assertEqual(interleaved, [planar[c * 9 + i] for i in range(9) for c in range(3)])

    def test_sun_on_the_left_is_at_plus_x(self):
        # Column 8 of 32 is a quarter from the left; y_1^1 is -0.4886 x.
        report = self.sh("sun.pfm", "--degree", "1")
        self.assertLess(report["coefficients"][9], 0)
        self.assertGreater(abs(report["coefficients"][9]), 5 * abs(report["coefficients"][6]))

    def test_minimal_window_removes_negative_values(self):
        before = self.sh("sun.pfm", "--degree", "4")
        self.assertLess(before["smallest_value"], 0)
        after = self.sh("sun.pfm", "--degree", "4", "--window", "minimal")
        self.assertGreaterEqual(after["smallest_value"], 0)
        self.assertGreater(after["window_strength"], 0)
        self.assertEqual(after["coefficients"][:3], before["coefficients"][:3])

    def test_windows_scale_bands(self):
        before = self.sh("sun.pfm")
        after = self.sh("sun.pfm", "--window", "hanning", "--window-width", "4")
        self.assertAlmostEqual(after["coefficients"][12] / before["coefficients"][12], 0.5, places=12)

    def test_table_names_degrees_and_orders(self):
        lines = self.expect(0, "probe", "sh", "white.pfm", "--degree", "1").stdout.splitlines()
        self.assertEqual([line.split()[:2] for line in lines[2:]], [["0", "0"], ["1", "-1"], ["1", "0"], ["1", "1"]])

    def test_bad_input_is_one_line(self):
        self.expect_error("missing.pfm", "probe", "sh", "missing.pfm")
        self.expect_error("--degree", "probe", "sh", "white.pfm", "--degree", "11")
        self.expect_error("--window", "probe", "sh", "white.pfm", "--window", "boxcar")
        self.write("nan.pfm", lambda x, y: (math.nan, 1, 1))
        self.expect_error("nan.pfm: NaN", "probe", "sh", "nan.pfm")


if __name__ == "__main__":
    main()
