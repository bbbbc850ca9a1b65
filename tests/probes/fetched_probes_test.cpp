// The eight environments that scripts/fetch_probes copies into scenes/probes/.
#include <ImfArray.h>
#include <ImfRgbaFile.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "probes/probe_errors.h"
#include "probes/spherical_harmonics.h"
#include "tests/probes/defined_harmonics.h"
#include "tests/probes/made_probes.h"

namespace etalon {

namespace {

constexpr const char* kNames[] = {"city",  "courtyard", "forest",  "interior",
                                  "night", "studio",    "sunrise", "sunset"};
// Five bands, as in the comparison with other programs.
constexpr int kDegree = 4;
constexpr auto kCount = static_cast<size_t>(harmonicCount(kDegree));

// Half floats, as they are stored; negative samples are 0.
Probe fetchedProbe(const std::string& name) {
    const std::string path = "scenes/probes/" + name + ".exr";
    if (!std::filesystem::exists(path)) FAIL("no " << path << ": run scripts/fetch_probes");
    Imf::RgbaInputFile file(path.c_str());
    const Imath::Box2i window = file.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    Imf::Array2D<Imf::Rgba> pixels(height, width);
    file.setFrameBuffer(&pixels[0][0] - window.min.x - static_cast<ptrdiff_t>(window.min.y) * width, 1,
                        static_cast<size_t>(width));
    file.readPixels(window.min.y, window.max.y);
    return madeProbe({Mapping::latLong, width, height}, [&](int, int x, int y, int c) {
        const Imf::Rgba& p = pixels[y][x];
        return std::max(0.0F, static_cast<float>(c == 0 ? p.r : c == 1 ? p.g : p.b));
    });
}

// The mean of each block of texels.
Probe reduced(const Probe& probe, int factor) {
    const ProbeShape shape{Mapping::latLong, probe.shape.width / factor, probe.shape.height / factor};
    return madeProbe(shape, [&](int, int x, int y, int c) {
        double sum = 0;
        for (int j = 0; j < factor; j++)
            for (int i = 0; i < factor; i++)
                sum += static_cast<double>(probe.radiance[0].at(x * factor + i, y * factor + j, c));
        return sum / (factor * factor);
    });
}

// The functions that the sum below takes, of Truth.
Truth sine(const Truth& a) { return ElementaryFunctions<Truth>::sinOf(a); }
Truth cosine(const Truth& a) { return ElementaryFunctions<Truth>::cosOf(a); }
long double sine(long double a) { return std::sin(a); }
long double cosine(long double a) { return std::cos(a); }

// Of each probe, all of one shape, the sum over all texels of radiance, solid angle and y_l^m at the texel's
// centre: three channels for each coefficient.
template <class Real>
std::vector<std::vector<Real>> directCoefficients(const std::vector<Probe>& probes, const Real& pi) {
    const auto harmonics = definedHarmonics<Real>(kDegree);
    const int width = probes[0].shape.width, height = probes[0].shape.height;
    const auto number = [](double a) { return Real(a); };
    std::vector<std::vector<Real>> sums(probes.size(), std::vector<Real>(3 * kCount, number(0)));
    std::vector<Real> sinLongitude, cosLongitude;
    for (int x = 0; x < width; x++) {
        const Real longitude = pi * number(width - 1.0 - 2.0 * x) / number(width);
        sinLongitude.push_back(sine(longitude));
        cosLongitude.push_back(cosine(longitude));
    }
    for (int y = 0; y < height; y++) {
        const Real latitude = pi * number(height - 1.0 - 2.0 * y) / number(2.0 * height);
        const Real above = pi * number(height - 2.0 * y) / number(2.0 * height);
        const Real below = pi * number(height - 2.0 - 2.0 * y) / number(2.0 * height);
        const Real solidAngle = number(2) * pi / number(width) * (sine(above) - sine(below));
        const Real dy = sine(latitude), ring = cosine(latitude);
        for (int x = 0; x < width; x++) {
            const auto column = static_cast<size_t>(x);
            for (size_t i = 0; i < kCount; i++) {
                const Real weighted = solidAngle * harmonics[i].at(ring * sinLongitude[column], dy,
                                                                   ring * cosLongitude[column]);
                for (size_t p = 0; p < probes.size(); p++)
                    for (size_t c = 0; c < 3; c++)
                        sums[p][3 * i + c] = sums[p][3 * i + c] +
                                             weighted * number(static_cast<double>(probes[p].radiance[0].at(
                                                            x, y, static_cast<int>(c))));
            }
        }
    }
    return sums;
}

double asDouble(const Truth& a) { return a.toDouble(); }
double asDouble(long double a) { return static_cast<double>(a); }

template <class Real>
double largestDifference(const SphericalHarmonics& f, const std::vector<Real>& direct) {
    double largest = 0;
    for (size_t i = 0; i < 3 * kCount; i++) {
        const Real ours(f.coefficients[i / 3][static_cast<glm::length_t>(i % 3)]);
        largest = std::max(largest, std::abs(asDouble(ours - direct[i])));
    }
    return largest;
}

std::vector<Probe> fetchedProbes() {
    std::vector<Probe> probes;
    for (const char* name : kNames) probes.push_back(fetchedProbe(name));
    return probes;
}
double largestRadiance(const Probe& probe) {
    const auto values = probe.radiance[0].values();
    return static_cast<double>(*std::max_element(values.begin(), values.end()));
}

}  // namespace

TEST_CASE("HarmonicsOfFetchedProbesAreTheDirectSum") {
    const std::vector<Probe> probes = fetchedProbes();
    const auto direct = directCoefficients<long double>(probes, 3.14159265358979323846264338327950288L);
    for (size_t p = 0; p < probes.size(); p++) {
        CAPTURE(kNames[p]);
        const double error = largestDifference(projectHarmonics(probes[p], kDegree), direct[p]);
        const double perTexel =
            largestDifference(projectHarmonics(probes[p], kDegree, Arithmetic::fp64), direct[p]);
        CHECK(error <= kProjectionDoubleError * largestRadiance(probes[p]));
        CHECK(perTexel <= kProjectionDoubleError * largestRadiance(probes[p]));
        // In units of the mean.
        CHECK(error <= 1e-14 * asDouble(direct[p][0]));
    }
}

TEST_CASE("HarmonicsOfFetchedProbesKeepTheBoundOfEachArithmetic") {
    std::vector<Probe> probes;
    for (const Probe& probe : fetchedProbes()) probes.push_back(reduced(probe, 16));
    const auto direct = directCoefficients<Truth>(probes, truthPi());
    for (size_t p = 0; p < probes.size(); p++)
        for (const Arithmetic a : kAllArithmetics) {
            CAPTURE(kNames[p]);
            CAPTURE(arithmeticName(a));
            const SphericalHarmonics f = projectHarmonics(probes[p], kDegree, a);
            double mean = 0;
            for (size_t c = 0; c < 3; c++) mean = std::max(mean, asDouble(direct[p][c]));
            const double error = largestDifference(f, direct[p]) / mean;
            CAPTURE(error);
            CHECK(error <= 4 * probeErrors(a).harmonic);
        }
}

}  // namespace etalon
