// The texts of occlusion and of composed planar shadows over several number types.
#include "shadows/occlusion_kernels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "lighting/occlusion.h"
#include "numeric/random.h"
#include "numeric/truth.h"
#include "shadows/composition_kernel.h"

using namespace etalon;

namespace {

constexpr int kSize = 8, kPoints = 40, kViews = 12, kLights = 3, kTexels = 21;

// Views with random depths, a third of their texels empty, of points near the origin.
struct Views {
    Views() {
        for (int k = 0; k < kViews; k++) {
            RenderTarget& target = targets.emplace_back(kSize, kSize, RenderTargetFormat{});
            for (size_t i = 0; i < target.depth.values().size(); i++) {
                const double z = random.uniform(0, 1);
                target.depth.values()[i] = std::bit_cast<uint32_t>(static_cast<float>(z));
                target.id.values()[i] = random.chance(0.3) ? kNoTriangle : 0;
            }
            for (auto& row : rows.emplace_back())
                for (int c = 0; c < 4; c++) row[c] = random.uniform(-1, 1);
            towards.push_back(direction());
        }
        for (int i = 0; i < kPoints; i++) {
            const glm::dvec3 p = direction();
            points.push_back({p, direction()});
        }
        for (int y = 0; y < kSize * kSize; y++) weights.push_back(random.uniform(0, 0.01));
    }
    glm::dvec3 direction() {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(0.1, 1);
        const double length = std::sqrt(x * x + (y * y + z * z));
        return {x / length, y / length, z / length};
    }
    Random random{3};
    std::vector<RenderTarget> targets;
    std::vector<std::array<glm::dvec4, 3>> rows;
    std::vector<glm::dvec3> towards;
    std::vector<OcclusionPoint> points;
    std::vector<double> weights;
};

constexpr size_t kNumbers = 8;

// Of each point the open part and the bent normal from parallel views, and those from the views as the faces of
// a hemicube.
template <class T>
std::vector<double> occlusionOver(const Views& views) {
    using K = OcclusionKernels<T>;
    using vec3 = typename K::vec3;
    using vec4 = typename K::vec4;
    K kernels;
    const auto constant = [](const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); };
    const auto constant4 = [](const glm::dvec4& v) { return vec4(T(v.x), T(v.y), T(v.z), T(v.w)); };
    std::vector<typename K::View> parallel, faces;
    for (size_t k = 0; k < views.targets.size(); k++) {
        const auto& rows = views.rows[k];
        parallel.push_back({.target = &views.targets[k],
                            .parallel = {constant(views.towards[k]), constant4(rows[0]), constant4(rows[1]),
                                         constant4(rows[2]), kSize, T(0.01)}});
        if (k % 4 == 0)
            faces.push_back(
                {.target = &views.targets[k],
                 .face = {constant(views.towards[k]), constant({0.1, 0, 0}), constant({0, 0.1, 0}),
                          T(kSize / 2), T(kSize / 2), kSize, kSize, k % 8 == 0 ? 1 : 0},
                 .weights = views.weights});
    }
    std::vector<double> result(kNumbers * views.points.size());
    forEachLaneGroup<Number<T>::lanes>(views.points.size(), [&](size_t first, int active) {
        const auto load = [&](const glm::dvec3 OcclusionPoint::*member) {
            const auto component = [&](int c) {
                return Number<T>::generate([&](int i) {
                    return (views.points[first + static_cast<size_t>(std::min(i, active - 1))].*member)[c];
                });
            };
            return vec3(component(0), component(1), component(2));
        };
        const vec3 position = load(&OcclusionPoint::position_m), normal = load(&OcclusionPoint::normal);
        // In two ranges, from a part of the views that is kept.
        kernels.views = parallel;
        typename K::OcclusionSum sum =
            kernels.addParallelViews(kernels.noDirections(T(0.0)), position, normal, 0, 5);
        K kept;
        kept.views = std::span<const typename K::View>(parallel).subspan(3);
        kept.firstView = 3;
        sum = kept.addParallelViews(sum, position, normal, 5, kViews);
        kernels.views = faces;
        typename K::OcclusionSum ofFaces = kernels.addHemicubeFaces(kernels.noDirections(T(1.0)), 0, 1);
        ofFaces = kernels.addHemicubeFaces(ofFaces, 1, static_cast<int>(faces.size()));
        size_t number = 0;
        for (const auto& part : {kernels.openPart(sum, normal), kernels.openPart(ofFaces, normal)})
            for (const T& value : {part.open, part.bentNormal.x, part.bentNormal.y, part.bentNormal.z}) {
                for (int i = 0; i < active; i++)
                    result[(first + static_cast<size_t>(i)) * kNumbers + number] = numberLane(value, i);
                number++;
            }
    });
    return result;
}

// Of texels with random visibilities, what remains of lights with random shares.
template <class T>
std::vector<double> remainingOver(std::vector<double>* expected = nullptr) {
    Random random(4);
    CompositionKernel<T> kernel;
    kernel.texels = kTexels;
    for (int i = 0; i < kLights; i++) kernel.shares.push_back(random.uniform(0, 5));
    for (int i = 0; i < kLights * kTexels; i++) kernel.visibility.push_back(random.uniform(0, 1));
    std::vector<double> result;
    for (; kernel.texel < kTexels; kernel.texel++) {
        result.push_back(numberLane(kernel.remainingLight(kLights), 0));
        if (!expected) continue;
        double reaching = 0, all = 0;
        for (size_t i = 0; i < kLights; i++) {
            reaching += kernel.shares[i] * kernel.visibility[i * kTexels + kernel.texel];
            all += kernel.shares[i];
        }
        expected->push_back(reaching / all);
    }
    return result;
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i++) most = std::max(most, std::fabs(a[i] - b[i]));
    return most;
}

}  // namespace

TEST_CASE("OcclusionTextsGiveTheSameBitsInLanesAndTheTruthInDouble") {
    const Views views;
    const std::vector<double> inDouble = occlusionOver<double>(views);
    REQUIRE(inDouble.size() == kNumbers * kPoints);
    const auto isPartly = [](double value) { return value > 0 && value < 1; };
    for (const size_t number : {size_t{0}, kNumbers / 2}) {
        size_t partly = 0;
        for (size_t i = number; i < inDouble.size(); i += kNumbers) partly += isPartly(inDouble[i]) ? 1 : 0;
        CHECK(partly > kPoints / 2);
    }
    CHECK(inDouble == occlusionOver<Lanes<double, 2>>(views));
    CHECK(occlusionOver<float>(views) == occlusionOver<Lanes<float, 4>>(views));
    CHECK(largestDifference(inDouble, occlusionOver<Truth>(views)) < 1e-13);
}

TEST_CASE("CompositionTextGivesTheSameBitsInLanesAndTheReachingShareInDouble") {
    std::vector<double> expected;
    const std::vector<double> inDouble = remainingOver<double>(&expected);
    CHECK(largestDifference(inDouble, expected) < 1e-15);
    CHECK(inDouble == remainingOver<Lanes<double, 2>>());
    CHECK(remainingOver<float>() == remainingOver<Lanes<float, 4>>());
    CHECK(largestDifference(inDouble, remainingOver<Truth>()) < 1e-15);
}
