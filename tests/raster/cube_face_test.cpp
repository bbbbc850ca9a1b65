#include "raster/cube_face.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "numeric/format.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

// The face table of [VulkanSpec, "Cube Map Face Selection"] as data: signed axes (1 x, 2 y, 3 z) of the major
// axis, of sc and of tc.
struct FaceRow {
    int major, sc, tc;
};
constexpr FaceRow kFaceTable[kCubeFaces] = {{1, -3, -2}, {-1, 3, -2}, {2, 1, 3},
                                            {-2, 1, -3}, {3, 1, -2},  {-3, -1, -2}};

template <class V>
auto component(const V& v, int signedAxis) {
    const auto value = v[signedAxis < 0 ? -signedAxis - 1 : signedAxis - 1];
    return signedAxis < 0 ? -value : value;
}

template <class T>
struct FacePoint {
    int face;
    T s, t;
    bool operator==(const FacePoint&) const = default;
};

// The table looked up: the last axis among the largest wins.
template <class T>
FacePoint<T> lookUp(const glm::vec<3, T>& d) {
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (std::abs(d[i]) >= std::abs(d[axis])) axis = i;
    for (int face = 0; face < kCubeFaces; face++) {
        const FaceRow& row = kFaceTable[face];
        if (std::abs(row.major) != axis + 1 || component(d, row.major) <= T(0)) continue;
        const T major = component(d, row.major);
        return {face, (component(d, row.sc) / major + T(1)) / T(2),
                (component(d, row.tc) / major + T(1)) / T(2)};
    }
    return {-1, T(0), T(0)};
}

template <class T>
FacePoint<T> mapped(const glm::vec<3, T>& d) {
    const auto c = CubeFaceKernel<T>{}.cubeCoordinates(d);
    return {c.face, c.s, c.t};
}

CubeMap<float> randomCube(int size, uint64_t seed) {
    RandomNumbers random(seed);
    CubeMap<float> cube(size, 3);
    for (auto& face : cube.faces)
        for (float& v : face.values()) v = static_cast<float>(random.uniform(0.0, 10.0));
    return cube;
}

template <class T>
glm::vec<3, T> sampled(const CubeMap<float>& cube, const glm::vec<3, T>& d,
                       const SamplerSettings& settings = {}) {
    using Kernel = CubeFaceKernel<T>;
    return Kernel{}.sampleCubeRgb(TextureView(cube), d,
                                  samplingOf<Kernel>(settings, cube.size(), cube.size()));
}

using Point = std::array<int, 3>;

// A texel's corner (i, j in [0, size]) as a lattice point on the cube [-size, size]^3, from the face table.
Point latticePoint(int face, int i, int j, int size) {
    const FaceRow& row = kFaceTable[face];
    Point p{};
    auto put = [&](int signedAxis, int value) {
        p[static_cast<size_t>(std::abs(signedAxis) - 1)] = signedAxis < 0 ? -value : value;
    };
    put(row.major, size);
    put(row.sc, 2 * i - size);
    put(row.tc, 2 * j - size);
    return p;
}

// All texels that touch both lattice points, by search over the whole cube.
using Edge = std::pair<Point, Point>;
using TexelId = std::array<int, 3>;
std::map<Edge, std::vector<TexelId>> texelsByEdge(int size) {
    std::map<Edge, std::vector<TexelId>> touching;
    for (int face = 0; face < kCubeFaces; face++)
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++) {
                const Point corners[4] = {latticePoint(face, x, y, size), latticePoint(face, x + 1, y, size),
                                          latticePoint(face, x + 1, y + 1, size),
                                          latticePoint(face, x, y + 1, size)};
                for (int i = 0; i < 4; i++)
                    touching[std::minmax(corners[i], corners[(i + 1) % 4])].push_back({face, x, y});
            }
    return touching;
}

}  // namespace

TEST_CASE_TEMPLATE("DirectionsMapAsInTheFaceTable", T, float, double) {
    RandomNumbers random(1);
    for (int i = 0; i < 100000; i++) {
        // Small whole numbers give many ties.
        glm::vec<3, T> d(0);
        for (int k = 0; k < 3; k++)
            d[k] = static_cast<T>(i % 2 == 0 ? random.uniform(-1.0, 1.0) : random.below(7) - 3);
        if (d == glm::vec<3, T>(0)) continue;
        REQUIRE(mapped(d) == lookUp(d));
    }
}

TEST_CASE("TiesGoToZThenYThenX") {
    using V = glm::vec<3, float>;
    CHECK(mapped(V(1, 1, 1)) == FacePoint<float>{4, 1.0f, 0.0f});
    CHECK(mapped(V(-1, 1, -1)) == FacePoint<float>{5, 1.0f, 0.0f});
    CHECK(mapped(V(1, -1, 0)) == FacePoint<float>{3, 1.0f, 0.5f});
    CHECK(mapped(V(-2, 2, 1)) == FacePoint<float>{2, 0.0f, 0.75f});
    CHECK(mapped(V(3, 0, -3)) == FacePoint<float>{5, 0.0f, 0.5f});
}

TEST_CASE("DegenerateDirectionsHaveADefinedFacePoint") {
    using V = glm::vec<3, float>;
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(mapped(V(0, 0, 0)) == FacePoint<float>{4, 0.5f, 0.5f});
    CHECK(mapped(V(-0.0f, -0.0f, -0.0f)) == FacePoint<float>{4, 0.5f, 0.5f});
    CHECK(mapped(V(inf, 3, 4)) == FacePoint<float>{0, 0.5f, 0.5f});
    CHECK(mapped(V(inf, -inf, 4)) == FacePoint<float>{3, 0.5f, 0.5f});
    CHECK(mapped(V(nan, nan, nan)) == FacePoint<float>{0, 0.5f, 0.5f});
    const CubeMap<float> cube = randomCube(4, 2);
    for (float x : {0.0f, 1.0f, inf, -inf, nan})
        for (float y : {0.0f, -1.0f, inf, -inf, nan})
            for (float z : {0.0f, 2.0f, inf, -inf, nan}) {
                const FacePoint<float> p = mapped(V(x, y, z));
                CHECK((p.face >= 0 && p.face < kCubeFaces && p.s >= 0 && p.s <= 1 && p.t >= 0 && p.t <= 1));
                CHECK(std::isfinite(sampled(cube, V(x, y, z)).x));
            }
}

TEST_CASE("EveryTexelCentreMapsBackToItsTexel") {
    CubeFaceKernel<float> kernel;
    for (int size : {1, 2, 3, 5, 16, 17, 31, 64, 100})
        for (int face = 0; face < kCubeFaces; face++)
            for (int y = 0; y < size; y++)
                for (int x = 0; x < size; x++) {
                    const auto n = static_cast<float>(size);
                    const auto d = kernel.cubeDirection(face, (static_cast<float>(x) + 0.5f) / n,
                                                        (static_cast<float>(y) + 0.5f) / n);
                    for (float scale : {1.0f, 0.37f, 1000.1f}) {
                        const FacePoint<float> p = mapped(d * scale);
                        REQUIRE(p.face == face);
                        REQUIRE(kernel.nearestTexel(p.s, size, {}) == x);
                        REQUIRE(kernel.nearestTexel(p.t, size, {}) == y);
                    }
                }
}

TEST_CASE("TexelsBeyondAnEdgeAreThoseThatShareIt") {
    CubeFaceKernel<float> kernel;
    for (int size : {1, 2, 3, 8}) {
        const auto touching = texelsByEdge(size);
        for (int face = 0; face < kCubeFaces; face++)
            for (int i = 0; i < size; i++) {
                // The four borders: outside texel, and the two corner points of the edge that it shares.
                struct Side {
                    int x, y, i0, j0, i1, j1, xIn, yIn;
                };
                const Side sides[4] = {{-1, i, 0, i, 0, i + 1, 0, i},
                                       {size, i, size, i, size, i + 1, size - 1, i},
                                       {i, -1, i, 0, i + 1, 0, i, 0},
                                       {i, size, i, size, i + 1, size, i, size - 1}};
                for (const Side& side : sides) {
                    const Edge edge = std::minmax(latticePoint(face, side.i0, side.j0, size),
                                                  latticePoint(face, side.i1, side.j1, size));
                    const std::vector<TexelId>& both = touching.at(edge);
                    REQUIRE(both.size() == 2);
                    const TexelId own{face, side.xIn, side.yIn};
                    const TexelId other = both[0] == own ? both[1] : both[0];
                    const auto w = kernel.wrapCubeTexel(face, side.x, side.y, size);
                    REQUIRE(TexelId{w.face, w.x, w.y} == other);
                }
            }
    }
}

TEST_CASE("TexelsInsideAFaceStayAndCornersStayInRange") {
    CubeFaceKernel<float> kernel;
    for (int size : {1, 2, 5})
        for (int face = 0; face < kCubeFaces; face++)
            for (int y = -1; y <= size; y++)
                for (int x = -1; x <= size; x++) {
                    const auto w = kernel.wrapCubeTexel(face, x, y, size);
                    REQUIRE((w.face >= 0 && w.face < kCubeFaces && w.x >= 0 && w.x < size && w.y >= 0 &&
                             w.y < size));
                    if (x >= 0 && x < size && y >= 0 && y < size)
                        REQUIRE((w.face == face && w.x == x && w.y == y));
                }
}

TEST_CASE("ConstantCubeSamplesToExactlyItsConstant") {
    RandomNumbers random(3);
    for (float constant : {0.1f, 1.3333334f, 7.77f})
        for (int size : {1, 2, 7}) {
            CubeMap<float> cube(size, 3);
            for (auto& face : cube.faces) face.fill(constant);
            for (int i = 0; i < 20000; i++) {
                // Directions near corners and edges among them.
                auto coordinate = [&] {
                    return random.below(3) == 0 ? random.below(3) - 1.0 : random.uniform(-1.0, 1.0);
                };
                const glm::vec<3, float> d(coordinate(), coordinate(), coordinate());
                for (Filter filter : {Filter::nearest, Filter::bilinear})
                    REQUIRE(sampled(cube, d, {filter}).x == constant);
            }
        }
}

TEST_CASE_TEMPLATE("OtherNumberTypesSampleAConstantCubeExactly", R, Rounded<kFp16>, Rounded<kBf16>,
                   Rounded<kFp24R300>, Truth) {
    RandomNumbers random(13);
    for (int size : {1, 2, 128}) {
        CubeMap<float> cube(size, 3);
        for (auto& face : cube.faces) face.fill(1.3333334f);
        for (int i = 0; i < 3000; i++) {
            auto coordinate = [&] {
                return R(random.below(3) == 0 ? random.below(3) - 1.0 : random.uniform(-1.0, 1.0));
            };
            const glm::vec<3, R> d(coordinate(), coordinate(), coordinate());
            REQUIRE(sampled(cube, d).x == R(1.3333334f));
        }
    }
}

TEST_CASE("FaceCoordinatesInFloatStayBelowTheirErrorBound") {
    RandomNumbers random(14);
    double worst = 0.0;
    for (int i = 0; i < 20000; i++) {
        const glm::vec<3, float> d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                   random.uniform(-1.0, 1.0));
        const auto a = CubeFaceKernel<float>{}.cubeCoordinates(d);
        const auto truth =
            CubeFaceKernel<Truth>{}.cubeCoordinates(glm::vec<3, Truth>(Truth(d.x), Truth(d.y), Truth(d.z)));
        REQUIRE(a.face == truth.face);
        worst = std::max(worst, std::abs((Truth(a.s) - truth.s).toDouble()));
        worst = std::max(worst, std::abs((Truth(a.t) - truth.t).toDouble()));
    }
    CHECK(worst <= kCubeCoordinateFloatError);
    CHECK(worst >= 0.25 * kCubeCoordinateFloatError);
}

TEST_CASE("SamplingIsContinuousAcrossEdges") {
    // Two directions on either side of an edge, 2 epsilon apart; values in [0, 10] change by at most
    // 10 size epsilon per axis, plus rounding.
    RandomNumbers random(4);
    const double epsilon = 1e-6;
    for (int size : {1, 2, 3, 16}) {
        const CubeMap<float> cube = randomCube(size, 5);
        const double bound = 2.0 * 10.0 * size * 2.0 * epsilon + 1e-12;
        for (int i = 0; i < 5000; i++) {
            const int along = i % 3, first = (along + 1) % 3, second = (along + 2) % 3;
            glm::vec<3, double> a(0);
            a[along] = i % 7 == 0 ? 1.0 - epsilon : random.uniform(-1.0, 1.0);
            a[first] = random.below(2) == 0 ? 1.0 : -1.0;
            a[second] = random.below(2) == 0 ? 1.0 : -1.0;
            glm::vec<3, double> b = a;
            a[first] *= 1.0 - epsilon;
            b[second] *= 1.0 - epsilon;
            REQUIRE(mapped(a).face != mapped(b).face);
            const auto va = sampled(cube, a), vb = sampled(cube, b);
            for (int c = 0; c < 3; c++) REQUIRE(std::abs(va[c] - vb[c]) <= bound);
        }
    }
}

TEST_CASE("LinearFunctionOnTheCubeIsSampledWithoutSeams") {
    // Texels hold a linear function of the point on the cube's surface: exact inside faces, and across an
    // edge within the half texel that the fold cuts off.
    const int size = 8;
    CubeFaceKernel<double> kernel;
    auto value = [](const glm::vec<3, double>& p) { return 3.0 + (p.x + (0.5 * p.y - 0.25 * p.z)); };
    CubeMap<float> cube(size, 3);
    for (int face = 0; face < kCubeFaces; face++)
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++)
                for (int c = 0; c < 3; c++)
                    cube.faces[static_cast<size_t>(face)].at(x, y, c) = static_cast<float>(
                        value(kernel.cubeDirection(face, (x + 0.5) / size, (y + 0.5) / size)));
    RandomNumbers random(6);
    for (int i = 0; i < 20000; i++) {
        const int face = random.below(kCubeFaces);
        const double s = random.uniform(0.0, 1.0), t = random.uniform(0.0, 1.0);
        const auto d = kernel.cubeDirection(face, s, t);
        const double error = std::abs(sampled(cube, d).x - value(d));
        const double border = 0.5 / size;
        const bool isInside = std::min({s, t, 1.0 - s, 1.0 - t}) >= border;
        REQUIRE(error <= (isInside ? 1e-14 : 1.75 / size));
    }
}

TEST_CASE("CornersAreTheMeanOfThreeTexels") {
    for (int size : {1, 2, 9}) {
        const CubeMap<float> cube = randomCube(size, 7);
        for (int corner = 0; corner < 8; corner++) {
            const glm::vec<3, double> d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            // The three texels at the corner, from the table.
            double sum = 0.0;
            for (int face = 0; face < kCubeFaces; face++) {
                const FaceRow& row = kFaceTable[face];
                if (component(d, row.major) < 0.0) continue;
                sum += cube.faces[static_cast<size_t>(face)].at(component(d, row.sc) < 0.0 ? 0 : size - 1,
                                                                component(d, row.tc) < 0.0 ? 0 : size - 1);
            }
            for (int axis = 0; axis < 3; axis++) {  // also from the two other faces
                glm::vec<3, double> towards = d;
                towards[axis] *= 1.0 + 0x1p-40;
                REQUIRE(std::abs(sampled(cube, towards).x - sum / 3.0) <= 1e-9);
            }
        }
    }
}

TEST_CASE_TEMPLATE("CubeSamplingInLanesGivesTheBitsOfScalars", L, Lanes<float, 4>, Lanes<float, 16>,
                   Lanes<double, 8>) {
    using S = typename L::Scalar;
    using Bits = std::conditional_t<sizeof(S) == 8, uint64_t, uint32_t>;
    const CubeMap<float> cube = randomCube(6, 8);
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    RandomNumbers random(9);
    for (int i = 0; i < 2000; i++) {
        std::array<std::array<S, 3>, L::size> d;
        for (auto& lane : d)
            for (S& x : lane) {
                const int kind = random.below(12);
                x = static_cast<S>(kind == 0   ? nan
                                   : kind == 1 ? inf
                                   : kind < 5  ? random.below(3) - 1
                                               : random.uniform(-1.0, 1.0));
            }
        auto lanesOf = [&](size_t k) {
            return L::generate([&](int lane) { return d[static_cast<size_t>(lane)][k]; });
        };
        const SamplerSettings settings{i % 2 == 0 ? Filter::nearest : Filter::bilinear, Wrap::clamp,
                                       Wrap::clamp, i % 3 == 0 ? 8 : kExactFraction};
        const auto lanes = sampled(cube, glm::vec<3, L>(lanesOf(0), lanesOf(1), lanesOf(2)), settings);
        for (int lane = 0; lane < L::size; lane++) {
            const auto& x = d[static_cast<size_t>(lane)];
            const auto scalar = sampled(cube, glm::vec<3, S>(x[0], x[1], x[2]), settings);
            for (int c = 0; c < 3; c++)
                REQUIRE(std::bit_cast<Bits>(lanes[c][lane]) == std::bit_cast<Bits>(scalar[c]));
        }
    }
}

}  // namespace etalon
