// Filters of shadow maps.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <set>

#include "numeric/door.h"
#include "numeric/emulated.h"
#include "numeric/isa.h"
#include "numeric/random.h"
#include "raster/depth.h"
#include "shadows/shadow_kernels.h"
#include "shadows/shadow_pattern.h"
#include "tests/shadows/shadow_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

template <class T>
struct TurnKernel {
#include "numeric/kernel_scope.inc"
#include "shadows/kernels/pattern_turn.glsl"
};

// A grid of small squares over a ground: shadows in every direction.
SurfaceScene confetti() {
    SurfaceScene scene;
    addObject(scene, tile({0, 0, 0}, 4), lambertian(0.5));
    for (int j = 0; j < 5; j++)
        for (int i = 0; i < 5; i++)
            addObject(scene,
                      tile({0.7f * static_cast<float>(i - 2), 0.3f + 0.1f * static_cast<float>(j),
                            0.7f * static_cast<float>(j - 2)},
                           0.3f),
                      lambertian(0.5));
    return scene;
}

// pcf by its definition in double: taps^2 bilinear samples, each of four comparisons.
double windowByDefinition(const ShadowMap& map, double u, double v, double depth, int taps) {
    const double levels = depthLevels(map.format());
    const bool isQuantised = map.settings.reference == ShadowReference::quantised;
    const auto isLit = [&](double x, double y) {
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y)),
                  w = map.projection.width;
        if (i < 0 || j < 0 || i >= w || j >= w) return 1.0;
        const uint32_t stored = map.layers[0].stored.at(i, j);
        if (isQuantised) return stored < std::floor(std::clamp(depth, 0.0, 1.0) * levels + 0.5) ? 0.0 : 1.0;
        return depthFromStored(map.format(), stored) < depth ? 0.0 : 1.0;
    };
    double sum = 0;
    for (int j = 0; j < taps; j++)
        for (int i = 0; i < taps; i++) {
            const double x = u - 0.5 + (i - (taps - 1) / 2.0), y = v - 0.5 + (j - (taps - 1) / 2.0);
            const double fx = x - std::floor(x), fy = y - std::floor(y);
            sum += (1 - fy) * ((1 - fx) * isLit(x, y) + fx * isLit(x + 1, y)) +
                   fy * ((1 - fx) * isLit(x, y + 1) + fx * isLit(x + 1, y + 1));
        }
    return sum / (taps * taps);
}

// What is nearer, farther or near to what was drawn, in rectangles and texel by texel.
void addNoise(ShadowMap& map, Random& random) {
    const bool isDistance = map.holdsDistance();
    for (ShadowLayer& layer : map.layers) {
        const int width = map.projection.width;
        if (layer.stored.empty() && layer.distance_m.empty()) continue;
        for (int k = 0; k < 30; k++) {
            const int x0 = random.integer(0, width - 1), y0 = random.integer(0, width - 1),
                      x1 = std::min(width, x0 + random.integer(1, 24)),
                      y1 = std::min(width, y0 + random.integer(1, 24));
            const double nearest = random.uniform(0, 1), spread = random.chance(0.5) ? 0 : 0.3;
            for (int y = y0; y < y1; y++)
                for (int x = x0; x < x1; x++) {
                    const double z = std::min(1.0, nearest + spread * random.uniform(0, 1));
                    if (isDistance)
                        layer.distance_m.at(x, y) = static_cast<float>(4 * z);
                    else if (map.format() == DepthFormat::d32f)
                        layer.stored.at(x, y) = std::bit_cast<uint32_t>(static_cast<float>(z));
                    else
                        layer.stored.at(x, y) = static_cast<uint32_t>(z * depthLevels(map.format()));
                }
        }
    }
}

}  // namespace

TEST_CASE("PercentageCloserFilteringComparesFirstAndWeightsAfter") {
    const SurfaceScene scene = confetti();
    const SurfaceLight light = sun({0.4, 1, 0.3});
    const LitPoints points = gridOn(0, -2, 2, 40);
    for (const ShadowReference reference : {ShadowReference::clamped, ShadowReference::quantised})
        for (const int taps : {1, 2, 3, 4, 7, 16}) {
            MapRequest request;
            request.profile = "f64";
            request.settings.size = 100;
            request.settings.taps = taps;
            request.settings.reference = reference;
            const ShadowMap map = mapOf(scene, light, request);
            const std::vector<double> visibility = lookUp(map, points, "f64");
            const ShadowProjection& p = map.projection;
            double worst = 0;
            std::set<double> values;
            for (size_t i = 0; i < points.size(); i++) {
                const glm::dvec3 d =
                    glm::dvec3(points.position_m[0][i], points.position_m[1][i], points.position_m[2][i]) -
                    p.origin;
                const auto along = [&](const glm::dvec3& a) { return a.x * d.x + (a.y * d.y + a.z * d.z); };
                const double expected = windowByDefinition(
                    map, p.centreU + p.scale * along(p.right), p.centreV + p.scale * along(p.down),
                    p.depthOffset + p.depthScale * along(p.forward), taps);
                worst = std::max(worst, std::fabs(visibility[i] - expected));
                values.insert(visibility[i]);
            }
            CAPTURE(taps);
            CHECK(worst < 1e-12);
            CHECK(values.size() > 20);
        }
}

// Native numbers compare the texels of a window side by side, or not at all where the range of their depths
// decides; the text compares one after the other. Points on and off the ground, some at places or with normals
// that are not numbers, in all formats, with every bias.
TEST_CASE("WindowsSideBySideGiveTheBitsOfTheText") {
    const SurfaceScene scene = confetti();
    LitPoints points = gridOn(0, -3, 3, 50);
    Random random(5);
    for (size_t i = 0; i < points.size(); i++) {
        if (random.chance(0.5)) points.position_m[1][i] = random.uniform(-0.2, 1);
        if (random.chance(0.3))
            for (auto& component : points.faceNormal) component[i] = random.uniform(-1, 1);
        if (random.chance(0.02)) points.position_m[static_cast<size_t>(random.integer(0, 2))][i] = NAN;
        if (random.chance(0.05))
            points.faceNormal[static_cast<size_t>(random.integer(0, 2))][i] =
                random.pick({double(NAN), double(INFINITY), 0.0, 1e-30});
        if (random.chance(0.02)) points.instance[i] = kNoInstance;
    }
    // The names' own, and with the positions and weights of rule 22.
    struct Choice {
        const char* profile;
        bool isHardware;
    };
    for (const auto& [profile, isHardware] :
         {Choice{"f32", false}, Choice{"f64", false}, Choice{"vulkan-min", false}, Choice{"f32", true},
          Choice{"f64", true}})
        for (const SurfaceLight& light :
             {sun({0.4, 1, 0.3}), bulb({0.3, 2, 0.2}), torch({0.3, 2, 0.2}, {0, -1, 0}, 0.7)})
            for (const ShadowDepth depth :
                 {ShadowDepth::d16, ShadowDepth::d24, ShadowDepth::d32f, ShadowDepth::linear})
                for (const int taps : {1, 4, 7, 8, 16}) {
                    MapRequest request;
                    request.profile = profile;
                    request.settings.size = 64;
                    request.settings.depth = depth;
                    request.settings.taps = taps;
                    request.settings.receiverPlane = random.chance(0.5);
                    if (random.chance(0.5))
                        request.settings.bias = {random.uniform(0, 8), random.uniform(0, 3), 0};
                    if (random.chance(0.5)) request.settings.depthOffset = random.uniform(0, 0.02);
                    if (random.chance(0.5)) request.settings.normalOffset_texels = random.uniform(0, 2);
                    ShadowMap map = mapOf(scene, light, request);
                    if (random.chance(0.7)) addNoise(map, random);
                    size_t partly = 0, different = 0;
                    Profile chosen = *findProfile(profile);
                    if (isHardware)
                        chosen.textureFractionBits = 8, chosen.filterRule = findProfile("nvidia")->filterRule;
                    const auto expected = lookUp(map, points, chosen, WindowSearch::text),
                               actual = lookUp(map, points, chosen);
                    for (size_t i = 0; i < points.size(); i++) {
                        different += actual[i] != expected[i];
                        partly += expected[i] > 0 && expected[i] < 1;
                    }
                    CAPTURE(profile);
                    CAPTURE(static_cast<int>(depth));
                    CAPTURE(taps);
                    CHECK(different == 0);
                    CHECK(partly > 0);
                }
}

TEST_CASE("WeightsHaveTheProfilesFractionBits") {
    MapRequest request;
    request.settings.size = 100;
    const LitPoints points = gridOn(0, -2, 2, 40);
    struct Bits {
        const char* profile;
        double step;  // of the product of two fractions, or of weights of 8 bits, over taps^2
    };
    for (const Bits& bits : {Bits{"nv40-fp32", 0x1p-20}, Bits{"vulkan-min", 0x1p-12}, Bits{"d3d11", 0x1p-12},
                             Bits{"nvidia", 0x1p-12}}) {
        request.profile = bits.profile;
        bool isFiner = false;
        for (const double v : visibilityOf(confetti(), sun({0.4, 1, 0.3}), points, request)) {
            CHECK(v / bits.step == std::floor(v / bits.step));
            isFiner = isFiner || v / (2 * bits.step) != std::floor(v / (2 * bits.step));
        }
        CHECK(isFiner);
    }
}

// Positions and weights of rule 22, in integers.
TEST_CASE("WindowsHaveThePositionsAndWeightsOfTheTextureUnit") {
    using K = ShadowKernels<float>;
    const ShadowMap none;
    const ShadowBuffers<float> buffers{ShadowTexels<float>(none, 1), {}, PatternTurns(0)};
    K kernels{buffers};
    Random random(7);
    for (const int width : {64, 100, 1000, 2048})
        for (const int taps : {1, 2, 3, 4, 16}) {
            const auto sampling = samplingOf<K>(samplerOf(*findProfile("nvidia")), width, width);
            for (int i = 0; i < 3000; i++) {
                const auto position = static_cast<float>(random.uniform(-9, width + 9));
                const K::TexelPair start = kernels.windowStart(position, taps, sampling);
                const float u = (position - static_cast<float>(taps - 1) * 0.5f) / static_cast<float>(width);
                const auto t = static_cast<int64_t>(std::floor(std::ldexp(static_cast<double>(u), 21)));
                const int64_t p = ((256 * t * width + (1 << 20)) >> 21) - 128;
                REQUIRE(start.first == p >> 8);
                REQUIRE(start.fraction * 256 == static_cast<float>(p & 255));
                REQUIRE(
                    kernels.texelOf(position, sampling).first ==
                    std::floor(std::floor(position / static_cast<float>(width) * 0x1p21) * width / 0x1p21));
                const int x = random.integer(0, 255), y = random.integer(0, 255), both = (x * y + 128) / 256;
                int lit[4];
                for (int& count : lit) count = random.integer(0, taps * taps);
                const int sum =
                    (256 - x - y + both) * lit[0] + (x - both) * lit[1] + (y - both) * lit[2] + both * lit[3];
                const float part = kernels.litPart(static_cast<float>(lit[0]), static_cast<float>(lit[1]),
                                                   static_cast<float>(lit[2]), static_cast<float>(lit[3]),
                                                   static_cast<float>(x) / 256.0f,
                                                   static_cast<float>(y) / 256.0f, taps, sampling);
                REQUIRE(part == static_cast<float>(sum) / static_cast<float>(256 * taps * taps));
            }
        }
}

// Whatever the number type, where the map's depths are written by rule 22.
TEST_CASE_TEMPLATE("QuantisedReferencesAreWrittenAsTheMapIs", T, float, Lanes<float, 8>, Lanes<double, 2>,
                   Emulated<Lanes<double, 2>>) {
    const EmulatedScope scope(kFp32Flush);
    Random random(8);
    for (const ShadowDepth depth : {ShadowDepth::d16, ShadowDepth::d24}) {
        ShadowMap map;
        map.settings.depth = depth;
        map.settings.reference = ShadowReference::quantised;
        map.depthRounding = DepthRounding::fixedFunction;
        const ShadowTexels<T> texels(map, 1);
        const double levels = depthLevels(map.format());
        for (int i = 0; i < 20000; i++) {
            // Next to a tie, or one of D24's.
            auto z = static_cast<float>((random.integer(0, static_cast<int>(levels) - 1) + 0.5) / levels);
            if (i % 3 == 0) z = static_cast<float>(random.integer(0, 0xfffff) + 0.5) * 0x1p-24f;
            if (i % 5 == 0) z = static_cast<float>(random.uniform(0, 1));
            const int written =
                storedDepth(map.format(), DepthRounding::fixedFunction, Lanes<float, 1>(z))[0];
            const auto isBelow = [&](int stored) {
                return anyOf(texels.isBelowStored(T(static_cast<double>(stored)), T(static_cast<double>(z))));
            };
            REQUIRE(isBelow(written - 1));
            REQUIRE(!isBelow(written));
        }
    }
}

// As stored integers a reference that is not below the texel is lit; as numbers, one within half a unit may
// be shadowed.
TEST_CASE("QuantisedReferencesCompareAsStoredIntegers") {
    SurfaceScene scene;
    addObject(scene, tile({0, 0, 0}, 4), lambertian(0.5));
    addObject(scene, tile({0, 1, 0}, 1), lambertian(0.5));
    MapRequest request;
    request.settings.size = 32;
    request.settings.depth = ShadowDepth::d16;
    request.settings.filter = ShadowFilter::hard;
    const SurfaceLight light = sun({0, 1, 0});
    const ShadowMap map = mapOf(scene, light, request);
    const uint32_t stored = map.layers[0].stored.at(16, 16);
    // Depths of points below the middle of the square, around the stored one.
    int lit[2] = {0, 0};
    for (const ShadowReference reference : {ShadowReference::clamped, ShadowReference::quantised}) {
        ShadowMap other = map;
        other.settings.reference = reference;
        for (int k = -100; k <= 100; k++) {
            const double depth = (stored + k / 50.0) / 65535.0;
            LitPoints point = gridOn(0, 0.01, 0.01, 1);
            const ShadowProjection& p = map.projection;
            point.position_m[1][0] = p.origin.y - depth / p.depthScale;
            const bool isLit = lookUp(other, point, "f64")[0] == 1.0;
            const bool expected = reference == ShadowReference::clamped ? k <= 0 : k < 25;
            if (std::abs(k) > 1 && std::abs(k - 25) > 1) CHECK(isLit == expected);
            lit[static_cast<int>(reference)] += isLit ? 1 : 0;
        }
    }
    CHECK(lit[1] > lit[0] + 20);
}

TEST_CASE("TurnsAreThoseOfAHashOf64Bits") {
    Random random(5);
    std::set<int> seen;
    size_t wrong = 0;
    for (int i = 0; i < 20000; i++) {
        const uint64_t seed = random.next();
        const PatternTurns turns(seed);
        const auto end = [&](uint64_t v) {
            return i % 7 == 0 ? 0xffffffffu : i % 5 == 0 ? 0u : static_cast<uint32_t>(v);
        };
        const uint32_t x = end(random.next()), y = end(random.next() >> (i % 3 == 0 ? 52 : 32));
        uint64_t h = Random(seed).next() ^ (uint64_t{x} | uint64_t{y} << 32);
        h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
        h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
        const int expected = static_cast<int>((h >> 33) % kPatternTurns);
        const int turn =
            TurnKernel<float>().turnOfPixel({turns.keyHigh(), turns.keyLow()}, x, y, kPatternTurns);
        wrong += turn != expected;
        seen.insert(turn);
    }
    CHECK(wrong == 0);
    CHECK(seen.size() == kPatternTurns);
}

TEST_CASE("PatternsAreTheSameForTheSameSeed") {
    CHECK(discPattern(64, 7) == discPattern(64, 7));
    CHECK(discPattern(64, 7) != discPattern(64, 8));
    double nearest = 4;
    const std::vector<glm::dvec2> points = discPattern(64, 7);
    for (size_t i = 0; i < points.size(); i++) {
        CHECK(points[i].x * points[i].x + points[i].y * points[i].y <= 1);
        for (size_t j = 0; j < i; j++) {
            const double x = points[i].x - points[j].x, y = points[i].y - points[j].y;
            nearest = std::min(nearest, std::sqrt(x * x + y * y));
        }
    }
    CHECK(nearest > 0.08);  // 64 random points have pairs at 0.02
    MapRequest request;
    request.settings.size = 100;
    request.settings.filter = ShadowFilter::disc;
    request.settings.taps = 16;
    const LitPoints grid = gridOn(0, -2, 2, 30);
    const std::vector<double> first = visibilityOf(confetti(), sun({0.4, 1, 0.3}), grid, request);
    CHECK(first == visibilityOf(confetti(), sun({0.4, 1, 0.3}), grid, request));
    request.settings.seed = 1;
    CHECK(first != visibilityOf(confetti(), sun({0.4, 1, 0.3}), grid, request));
    for (const double v : first) CHECK(v * 16 == std::floor(v * 16));
}

// A window that crosses the edge of a cube face is compared in the plane of its own face: on both sides of
// the edge the light is the same, and it is that of a map that looks straight at the edge.
TEST_CASE("FiltersDoNotSeeTheEdgesOfTheCube") {
    SurfaceScene scene;
    addObject(scene, tile({0, 0, 0}, 8), lambertian(0.5));
    addObject(scene, tile({0.6f, 0.5f, 0.05f}, 0.9f), lambertian(0.5));
    // The faces +X and -Y meet in the direction (1, -1, 0): on the ground at x = 1 below a light at y = 1.
    for (const ShadowFilter filter : {ShadowFilter::pcf, ShadowFilter::disc})
        for (const ShadowDepth depth : {ShadowDepth::d32f, ShadowDepth::linear}) {
            MapRequest request;
            request.settings.size = 256;
            request.settings.filter = filter;
            request.settings.depth = depth;
            request.settings.taps = filter == ShadowFilter::pcf ? 8 : 64;
            request.settings.radius_texels = 6;
            request.settings.depthOffset = depth == ShadowDepth::linear ? 1e-3 : 1e-4;
            const ShadowMap map = mapOf(scene, bulb({0, 1, 0}), request);
            CHECK(map.projection.border > 0);
            LitPoints left = gridOn(0, -1, 1, 60), right = left;
            for (size_t i = 0; i < left.size(); i++) {
                left.position_m[0][i] = 1 - 1e-9, right.position_m[0][i] = 1 + 1e-9;
                right.x_px[i] = left.x_px[i], right.y_px[i] = left.y_px[i];
            }
            const std::vector<double> a = lookUp(map, left, "f64"), b = lookUp(map, right, "f64");
            double most = 0;
            int between = 0;
            for (size_t i = 0; i < a.size(); i++) {
                most = std::max(most, std::fabs(a[i] - b[i]));
                between += a[i] > 0 && a[i] < 1 ? 1 : 0;
            }
            CAPTURE(static_cast<int>(filter));
            CHECK(between > 10);
            CHECK(most <= (filter == ShadowFilter::pcf ? 0.1 : 0.35));
        }
}

// The half-shadow of an edge under a lamp of diameter L is L (receiver - edge) / edge wide.
TEST_CASE("SoftShadowsWidenWithTheDistanceFromTheCaster") {
    for (const bool isSun : {false, true})
        for (const float height : {0.25f, 0.5f, 1.0f}) {
            SurfaceScene scene;
            addObject(scene, tile({0, 0, 0}, 6), lambertian(0.5));
            addObject(scene, rectangle({-1.5f, height, 0}, {1.5f, 0, 0}, {0, 0, -3}), lambertian(0.5));
            MapRequest request;
            request.settings.size = 1024;
            request.settings.filter = ShadowFilter::soft;
            request.settings.taps = 256;
            request.settings.radius_texels = 64;
            request.settings.lightSize_m = 0.2;
            request.settings.tangentOfHalfAngle = 0.05;
            request.settings.depth = ShadowDepth::d32f;
            const SurfaceLight light = isSun ? sun({0, 1, 0}) : torch({0, 2, 0}, {0, -1, 0}, 0.5);
            const ShadowMap map = mapOf(scene, light, request);
            const LitPoints points = gridOn(0, -0.15, 0.15, 60);
            const std::vector<double> visibility = lookUp(map, points);
            // Mean over rows: the width between 10 and 90 % of a disc's edge is 0.69 of its diameter.
            double low = 1, high = -1;
            for (int i = 0; i < 60; i++) {
                double mean = 0;
                for (int j = 0; j < 60; j++) mean += visibility[static_cast<size_t>(j * 60 + i)] / 60;
                const double x = points.position_m[0][static_cast<size_t>(i)];
                if (mean > 0.1) low = std::min(low, x);
                if (mean < 0.9) high = std::max(high, x);
            }
            const double expected = 0.69 * (isSun ? 2 * 0.05 * height : 0.2 * height / (2 - height));
            CAPTURE(isSun);
            CAPTURE(height);
            CHECK(high - low > 0.6 * expected - 0.01);
            CHECK(high - low < 1.4 * expected + 0.01);
        }
}

// No number of the map depends on threads, nor on the level.
TEST_CASE("ShadowThreadsAndLevelsChangeNoBit") {
    const SurfaceScene scene = confetti();
    const LitPoints points = gridOn(0, -2, 2, 40);
    const IsaLevel before = activeIsa();
    for (const char* name : {"f32", "r300-fp24"})
        for (const ShadowFilter filter :
             {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::disc, ShadowFilter::soft})
            for (const ShadowDepth depth : {ShadowDepth::d24, ShadowDepth::linear}) {
                const Profile& profile = *findProfile(name);
                ShadowMapSettings settings;
                settings.size = 100;
                settings.filter = filter;
                settings.depth = depth;
                settings.receiverPlane = true;
                settings.normalOffset_texels = 1;
                settings.lightSize_m = 0.2;
                std::vector<std::vector<double>> all;
                for (const IsaLevel level : usableIsaLevels()) {
                    selectIsa(level);
                    for (const int threads : {1, 3}) {
                        const std::vector<PlacedMesh> placed = placeMeshes(scene, profile.vertex, threads);
                        const ShadowMap map =
                            renderShadowMap(scene, placed, bulb({0.3, 2, 0.2}), {}, settings, profile,
                                            {threads, threads == 1 ? 64 : 16, false});
                        std::vector<double> visibility(points.size());
                        passesIn<LookupPasses>(profile.fragment)
                            ->makeLookup(map, {.fractionBits = 8}, threads, WindowSearch::sideBySide)
                            ->find(points, visibility);
                        all.push_back(visibility);
                    }
                }
                selectIsa(before);
                for (const auto& other : all) CHECK(other == all.front());
            }
}
