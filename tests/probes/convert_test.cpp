#include "probes/convert.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "numeric/check.h"
#include "numeric/door.h"
#include "probes/convert_over.h"
#include "probes/mapping_passes.h"
#include "probes/texel_grid.h"
#include "tests/probes/made_probes.h"

namespace etalon {
namespace {

const Mapping kMappings[] = {Mapping::latLong,    Mapping::cube,       Mapping::angular,
                             Mapping::mirrorBall, Mapping::octahedral, Mapping::latLongPedersen};

ProbeShape shapeOf(Mapping mapping, int size) {
    return {mapping, isLatLong(mapping) ? 2 * size : size, size};
}

// Texels hold f(direction) where they show one.
template <class F>
Probe probeOfFunction(const ProbeShape& shape, F&& f) {
    const TexelGrid grid(shape);
    Probe probe;
    probe.shape = shape;
    probe.radiance.assign(static_cast<size_t>(shape.layers()), Image<float>(shape.width, shape.height, 3));
    for (int layer = 0; layer < shape.layers(); layer++)
        for (int y = 0; y < shape.height; y++)
            for (int x = 0; x < shape.width; x++) {
                if (!showsDirection(shape, x, y)) continue;
                const glm::dvec3 value = f(grid.direction(layer, x, y));
                for (int c = 0; c < 3; c++)
                    probe.radiance[static_cast<size_t>(layer)].at(x, y, c) = static_cast<float>(value[c]);
            }
    return probe;
}

template <class F>
void forEachTexel(const Probe& probe, F&& f) {
    for (int layer = 0; layer < probe.shape.layers(); layer++)
        for (int y = 0; y < probe.shape.height; y++)
            for (int x = 0; x < probe.shape.width; x++) {
                const auto l = static_cast<size_t>(layer);
                const bool isValid = probe.valid.empty() || probe.valid[l].at(x, y) != 0;
                const Image<float>& image = probe.radiance[l];
                f(layer, x, y, isValid, glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)));
            }
}

bool sameBits(const Probe& a, const Probe& b) {
    if (a.radiance.size() != b.radiance.size() || a.valid != b.valid) return false;
    for (size_t l = 0; l < a.radiance.size(); l++) {
        const auto x = a.radiance[l].values(), y = b.radiance[l].values();
        if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size_bytes()) != 0) return false;
    }
    return true;
}

double length(const glm::dvec3& d) { return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z); }

// A polynomial of degree 4 with parts of every degree and parity.
glm::dvec3 analyticRadiance(const glm::dvec3& d) {
    const double x = d.x, y = d.y, z = d.z;
    return {2 + x + 0.5 * y * z + x * y * z + x * x * z * z,
            1.5 - z + x * z - y * y * y + 0.5 * x * x * x * x,
            3 + y - 0.7 * x * y + z * z * z + y * z * z * z};
}

glm::dmat3 rotationAboutAxis(int axis, double angle_rad) {
    glm::dmat3 m(1);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    m[a][a] = m[b][b] = std::cos(angle_rad);
    m[a][b] = std::sin(angle_rad);
    m[b][a] = -std::sin(angle_rad);
    return m;
}

}  // namespace

TEST_CASE("ConstantProbesKeepTheirConstantInEveryMappingAndArithmetic") {
    for (const Arithmetic arithmetic :
         {Arithmetic::truth, Arithmetic::fp64, Arithmetic::fp32, Arithmetic::fp32Flush, Arithmetic::fp32Nv40,
          Arithmetic::fp16, Arithmetic::fp16Nv40, Arithmetic::bf16, Arithmetic::fp24R300})
        for (const Mapping from : kMappings)
            for (const Mapping to : kMappings)
                for (const Resampling resampling :
                     {Resampling::nearest, Resampling::bilinear, Resampling::area}) {
                    // The solid angles of area are the same for all.
                    if (resampling == Resampling::area && arithmetic != Arithmetic::truth &&
                        arithmetic != Arithmetic::fp32 && arithmetic != Arithmetic::fp16)
                        continue;
                    CAPTURE(arithmeticName(arithmetic));
                    CAPTURE(static_cast<int>(from));
                    CAPTURE(static_cast<int>(to));
                    CAPTURE(static_cast<int>(resampling));
                    const Probe source = probeOfFunction(
                        shapeOf(from, 6), [](const glm::dvec3&) { return glm::dvec3(1, 0.75, 320); });
                    const Probe result =
                        convertProbe(source, {shapeOf(to, 9), glm::dmat3(1), resampling}, arithmetic, 1);
                    const bool hasRim = isDisc(to);
                    CHECK(result.valid.empty() == !hasRim);
                    bool isConstant = true;
                    forEachTexel(result, [&](int, int x, int y, bool isValid, const glm::dvec3& value) {
                        const bool isShown = showsDirection(result.shape, x, y);
                        isConstant = isConstant && isValid == isShown &&
                                     value == (isShown ? glm::dvec3(1, 0.75, 320) : glm::dvec3(0));
                    });
                    CHECK(isConstant);
                }
}

TEST_CASE("ConversionToACubeIsThePassOfMirrors") {
    RandomNumbers random(1);
    Image<float> image(24, 12, 3);
    for (float& v : image.values()) v = static_cast<float>(random.uniform(0, 10));
    const Probe source = probeOf(image, Mapping::latLong);
    for (const Arithmetic arithmetic : {Arithmetic::fp32, Arithmetic::fp16}) {
        for (const int size : {9, 16}) {
            const Probe cube = convertProbe(
                source, {{Mapping::cube, size, size}, glm::dmat3(1), Resampling::bilinear}, arithmetic, 2);
            CHECK(sameBits(
                cube, probeOf(passesIn<MappingPasses>(arithmetic)->cubeFromLatLong(image, size, {}, 1))));
        }
    }
}

// A turn by nothing goes texel by texel through the directions.
TEST_CASE("MirroredTexelsHaveTheBitsOfTheirOwnDirections") {
    RandomNumbers random(3);
    Image<float> image(37, 18, 3);
    for (float& v : image.values()) v = static_cast<float>(random.uniform(0, 10));
    const Probe source = probeOf(image, Mapping::latLong);
    for (const Mapping to : kMappings)
        for (const int size : {1, 2, 6, 16, 64, 100})
            for (const double distance_radii : {std::numeric_limits<double>::infinity(), 3.0})
                for (const Arithmetic arithmetic : {Arithmetic::fp32, Arithmetic::fp64, Arithmetic::fp16}) {
                    if (arithmetic == Arithmetic::fp16 && size > 16) continue;
                    for (const Resampling resampling : {Resampling::bilinear, Resampling::nearest}) {
                        ConversionJob job;
                        job.source = source.shape, job.target = shapeOf(to, size);
                        job.target.ballDistance_radii = distance_radii;
                        job.radiance = source.radiance;
                        job.hasBlindSpots = isDisc(to);
                        job.resampling = resampling;
                        Probe mirrored = constantProbe(job.target, -1), turned = mirrored;
                        for (Probe* p : {&mirrored, &turned})
                            if (isDisc(to)) p->valid = {Image<uint8_t>(size, size)};
                        passesIn<MappingPasses>(arithmetic)->convertImages(job, mirrored);
                        job.isTurned = true;
                        passesIn<MappingPasses>(arithmetic)->convertImages(job, turned);
                        CAPTURE(static_cast<int>(to));
                        CAPTURE(size);
                        CAPTURE(static_cast<int>(resampling));
                        CHECK(sameBits(mirrored, turned));
                    }
                }
}

TEST_CASE("ConversionsDependOnNoThreadsAndLanes") {
    const Probe cube = probeOfFunction(shapeOf(Mapping::cube, 7), analyticRadiance);
    for (const Mapping to : kMappings)
        for (const Resampling resampling : {Resampling::bilinear, Resampling::area}) {
            ProbeConversion conversion{shapeOf(to, 21), rotationAboutAxis(0, 0.3), resampling};
            conversion.shape.ballDistance_radii = 4;
            const Probe one = convertProbe(cube, conversion, Arithmetic::fp32, 1);
            CHECK(sameBits(one, convertProbe(cube, conversion, Arithmetic::fp32, 3)));
            ConversionJob job;
            job.source = cube.shape, job.target = conversion.shape, job.radiance = cube.radiance;
            job.turn = rotationAboutAxis(0, 0.3), job.isTurned = true, job.hasBlindSpots = isDisc(to);
            job.resampling = resampling, job.threads = 1;
            const TexelOverlaps overlaps(job.source, job.target, job.turn);
            if (resampling == Resampling::area) job.overlaps = &overlaps;
            Probe images = one;
            for (Image<float>& layer : images.radiance) layer.fill(-1);
            convertImages<float>(job, images);
            CHECK(images.radiance == one.radiance);
            CHECK(images.valid == one.valid);
        }
}

// The largest error of a sample's place on a source, in texels of the source.
constexpr double kGeometricError_texels = 0.005;

// Where blending the directions of neighbouring texels says nothing about the place, because the mapping
// bends within a texel: around a disc's rim, the edges of a cube (there up to a quarter of a texel along the
// edge), the folds and the middle of an octahedral image.
bool isBent(const ProbeShape& shape, double u, double v) {
    const double texel = 2.0 / shape.width, x = std::abs(2 * u - 1), y = std::abs(2 * v - 1);
    // The error of a chord next to a square root is 1 / (16 texels).
    if (isDisc(shape.mapping)) return std::sqrt(x * x + y * y) > 1 - 13 * texel;
    if (shape.mapping == Mapping::cube) return std::max(x, y) > 1 - texel;
    if (shape.mapping == Mapping::octahedral)
        return std::min({x, y, std::abs(x + y - 1), 1 - x, 1 - y}) < 4 * texel || x + y < 40 * texel ||
               x + y > 2 - 40 * texel;
    return false;
}

TEST_CASE("DirectionsSurviveConversionWithinTheirGeometricError") {
    for (const Mapping from : kMappings)
        for (const Mapping to : {Mapping::latLong, Mapping::cube, Mapping::octahedral}) {
            const ProbeShape shape = shapeOf(from, from == Mapping::cube ? 256 : 512);
            const Probe source = probeOfFunction(shape, [](const glm::dvec3& d) { return d; });
            const Probe result = convertProbe(source, {shapeOf(to, 45), glm::dmat3(1), Resampling::bilinear});
            const TexelGrid grid(result.shape);
            MappingKernel<double> kernel;
            const auto settings = mappingSettingsOf<MappingKernel<double>>(shape);
            double worst = 0;
            int counted = 0;
            forEachTexel(result, [&](int layer, int x, int y, bool isValid, const glm::dvec3& value) {
                const glm::dvec3 d = grid.direction(layer, x, y);
                const auto p = kernel.mappingPoint(d, settings);
                REQUIRE(isValid);
                // Blending directions shortens them; the angle remains.
                const auto q = kernel.mappingPoint(value, settings);
                if (q.layer != p.layer || isBent(shape, p.u, p.v)) return;
                double du = std::abs(q.u - p.u);
                // Longitudes shrink towards the poles.
                if (isLatLong(from)) du = std::min(du, 1 - du) * std::sqrt(d.x * d.x + d.z * d.z);
                worst = std::max({worst, du * shape.width, std::abs(q.v - p.v) * shape.height});
                counted++;
            });
            CAPTURE(static_cast<int>(from));
            CAPTURE(static_cast<int>(to));
            CHECK(worst <= kGeometricError_texels);
            CHECK(counted >= result.shape.layers() * result.shape.width * result.shape.height * 4 / 5);
        }
}

// The same without bends: texels that hold their own u and v, whose blend is the place itself.
TEST_CASE("PlacesSurviveConversionWithinTheirGeometricError") {
    for (const Mapping from : kMappings) {
        const ProbeShape shape = shapeOf(from, from == Mapping::cube ? 256 : 512);
        Probe source = probeOfFunction(shape, [](const glm::dvec3& d) { return d; });
        for (Image<float>& layer : source.radiance)
            for (int y = 0; y < shape.height; y++)
                for (int x = 0; x < shape.width; x++) {
                    layer.at(x, y, 0) = static_cast<float>(x + 0.5);
                    layer.at(x, y, 1) = static_cast<float>(y + 0.5);
                }
        const Probe result = convertProbe(
            source, {shapeOf(Mapping::cube, 45), rotationAboutAxis(1, 0.7), Resampling::bilinear});
        const TexelGrid grid(result.shape);
        MappingKernel<double> kernel;
        const auto settings = mappingSettingsOf<MappingKernel<double>>(shape);
        double worst = 0;
        forEachTexel(result, [&](int layer, int x, int y, bool, const glm::dvec3& value) {
            const auto p =
                kernel.mappingPoint(rotationAboutAxis(1, 0.7) * grid.direction(layer, x, y), settings);
            const double px = p.u * shape.width, py = p.v * shape.height;
            // Texels on both sides of an image's border hold other numbers; a disc has none beyond it.
            if (std::min({px, py, shape.width - px, shape.height - py}) < 1) return;
            const double rx = 2 * p.u - 1, ry = 2 * p.v - 1;
            if (isDisc(from) && std::sqrt(rx * rx + ry * ry) > 1 - 3.0 / shape.width) return;
            worst = std::max({worst, std::abs(value.x - px), std::abs(value.y - py)});
        });
        CAPTURE(static_cast<int>(from));
        CHECK(worst <= kGeometricError_texels);
    }
}

// LL -> X -> LL. Bilinear blending errs by the square of a texel, by a texel across the folds of an
// octahedral image (a share of the image that shrinks like a texel, so 3/2 in the mean square), and at the
// rim of a mirror ball, where a texel spans an angle like the square root of its width, by 1.
TEST_CASE("RoundTripsOfAnAnalyticRadianceConvergeAtTheirOrder") {
    const auto error = [](Mapping by, int size) {
        const Probe source = probeOfFunction(shapeOf(Mapping::latLong, size), analyticRadiance);
        const Probe there =
            convertProbe(source, {shapeOf(by, size), glm::dmat3(1), Resampling::bilinear}, Arithmetic::fp64);
        const Probe back =
            convertProbe(there, {source.shape, glm::dmat3(1), Resampling::bilinear}, Arithmetic::fp64);
        const TexelGrid grid(source.shape);
        double square = 0;
        forEachTexel(back, [&](int layer, int x, int y, bool isValid, const glm::dvec3& value) {
            REQUIRE(isValid);
            const double difference = length(value - analyticRadiance(grid.direction(layer, x, y)));
            square += grid.solidAngle_sr(layer, x, y) * difference * difference;
        });
        return std::sqrt(square / (4 * M_PI));
    };
    // RMS errors at 16, 32, 64 and 128 rows or texels along a face or image, of a radiance of about 2.
    struct Row {
        Mapping by;
        double order, errors[4];
    };
    const Row rows[] = {{Mapping::cube, 2, {1.29e-2, 3.72e-3, 9.12e-4, 2.28e-4}},
                        {Mapping::angular, 2, {6.18e-2, 1.60e-2, 4.03e-3, 1.01e-3}},
                        {Mapping::mirrorBall, 1, {7.86e-2, 3.11e-2, 1.31e-2, 6.47e-3}},
                        {Mapping::octahedral, 1.5, {4.25e-2, 1.33e-2, 4.25e-3, 1.41e-3}}};
    for (const Row& row : rows) {
        CAPTURE(static_cast<int>(row.by));
        double before = 0, rms = 0;
        for (int i = 0; i < 4; i++) {
            before = rms;
            rms = error(row.by, 16 << i);
            CHECK(std::abs(rms / row.errors[i] - 1) <= 0.01);
        }
        CHECK(std::abs(std::log2(before / rms) - row.order) <= 0.15);
    }
    // Its texels are those of latLong; only the storage as float rounds.
    CHECK(error(Mapping::latLongPedersen, 32) <= 1e-6);
}

}  // namespace etalon
