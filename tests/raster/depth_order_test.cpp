// Rules 5 and 6: how close two surfaces may be and still be told apart.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "numeric/text.h"
#include "tests/support/draw_triangles.h"

using namespace etalon;

namespace {

constexpr double kNear = 0.1, kFar = 1000;
constexpr double kTilt = 0.05;
constexpr int kSize = 48;
constexpr double kUnresolved = HUGE_VAL;
constexpr double kGridStep = 0x1.d5818dcfba487p-1;  // an eighth of an octave

// The plane whose distance is `distance` in the middle of the screen and whose 1/w grows by kTilt to the
// right.
std::vector<ClipVertex> tiltedPlane(double distance) {
    const auto corner = [&](double x, double y) {
        const double w = distance / (1 + kTilt * x);
        return ClipVertex{x * w, y * w, kFar * (w - kNear) / (kFar - kNear), w};
    };
    // The diagonals of two planes run differently, so that no two triangles agree.
    return {corner(-1, -1), corner(1, -1), corner(-1, 1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

// Whether the nearer plane is in front at every pixel, whichever is drawn first.
bool resolved(double near, double far, const RenderTargetFormat& format) {
    const Viewport viewport{0, 0, kSize, kSize};
    DrawState state = alwaysState();
    const RenderTarget a = drawTriangles(viewport, tiltedPlane(near), state, format);
    const RenderTarget b = drawTriangles(viewport, tiltedPlane(far), state, format);
    for (size_t i = 0; i < a.depth.values().size(); i++)
        if (!(a.depth.values()[i] < b.depth.values()[i])) return false;
    return true;
}

// The smallest distance between the planes, on a grid of eighths of an octave, from which on the order is
// right.
double smallestResolved(double distance, const RenderTargetFormat& format) {
    double smallest = kUnresolved;
    for (double delta = (kFar * (1 - kTilt) - distance); delta > distance * 0x1p-50; delta *= kGridStep) {
        if (!resolved(distance, distance + delta, format)) break;
        smallest = delta;
    }
    return smallest;
}

// The distance between planes whose depths differ by `step` at `distance`: z = f (w - n) / (w (f - n)).
double predicted(double distance, double step) {
    const double slope = kFar * kNear / (kFar - kNear);
    return step * distance * distance / (slope - step * distance);
}

}  // namespace

TEST_CASE("TwoPlaneOrderSweep") {
    struct Column {
        const char* name;
        RenderTargetFormat format;
        // Unit of depth, and between which multiples of it the smallest resolved difference lies. One step of
        // a UNORM format is 1; floats below 0.5 are finer; two depths in fp32 (rule 5) are off by up to 8
        // each, but by less than 2 in these scenes.
        double unit, lowest, highest;
    };
    const auto exact = DepthRounding::exact;
    const Column columns[] = {
        {"D16 fp32", {1, 8, DepthFormat::d16, exact, RasterReal::fp32}, 0x1p-16, 0.9, 1.25},
        {"D16 fp64", {1, 8, DepthFormat::d16, exact, RasterReal::fp64}, 0x1p-16, 0.9, 1.25},
        {"D24 fp32", {1, 8, DepthFormat::d24, exact, RasterReal::fp32}, 0x1p-24, 0.9, 4.5},
        {"D24 fp64", {1, 8, DepthFormat::d24, exact, RasterReal::fp64}, 0x1p-24, 0.9, 1.25},
        {"D32F fp32", {1, 8, DepthFormat::d32f, exact, RasterReal::fp32}, 0x1p-24, 0.2, 4.5},
        {"D32F fp64", {1, 8, DepthFormat::d32f, exact, RasterReal::fp64}, 0x1p-24, 0.2, 1.25},
    };
    std::string table = formatText("smallest distance [m] in the right order; near {} m, far {} m\n{:>10}",
                                   kNear, kFar, "at [m]");
    for (const Column& column : columns) table += formatText("{:>12}", column.name);
    for (double distance : {0.12, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 900.0}) {
        table += formatText("\n{:>10}", distance);
        std::array<double, 6> smallest;
        for (size_t i = 0; i < 6; i++) {
            smallest[i] = smallestResolved(distance, columns[i].format);
            table +=
                smallest[i] == kUnresolved ? formatText("{:>12}", "-") : formatText("{:>12.3g}", smallest[i]);
            // The far side of the tilted plane is the least resolved.
            const Column& c = columns[i];
            const double bound = predicted(distance / (1 - kTilt), c.unit * c.highest);
            if (bound > 0 && distance + bound < kFar * (1 - kTilt)) CHECK(smallest[i] <= bound);
            CHECK(smallest[i] >= predicted(distance, c.unit * c.lowest));
        }
        // Up to the grid's step: D24 is finer than D16, and D32F and fp64 are never coarser.
        for (size_t real = 0; real < 2; real++) {
            CHECK((smallest[2 + real] < smallest[real] || smallest[real] == kUnresolved));
            CHECK(smallest[4 + real] <= smallest[2 + real] / kGridStep);
        }
        for (size_t i = 0; i < 6; i += 2) CHECK(smallest[i + 1] <= smallest[i] / kGridStep);
    }
    MESSAGE(table);
}
