#include "probes/cube_layout.h"

#include <ImathBox.h>
#include <ImathVec.h>
#include <OpenEXR/ImfEnvmap.h>
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "numeric/check.h"
#include "probes/texel_grid.h"

namespace etalon {
namespace {

constexpr CubeLayout kLayouts[] = {CubeLayout::openExrStrip, CubeLayout::verticalStrip,
                                   CubeLayout::horizontalCross, CubeLayout::verticalCross};

CubeMap<float> countedCube(int size) {
    CubeMap<float> cube(size, 2);
    float next = 1;
    for (Image<float>& face : cube.faces)
        for (float& v : face.values()) v = next++;
    return cube;
}

}  // namespace

TEST_CASE("LayoutsGiveTheirFacesBack") {
    for (const CubeLayout layout : kLayouts)
        for (const int size : {1, 2, 5}) {
            const CubeMap<float> cube = countedCube(size);
            CHECK(unpackCube(packCube(cube, layout), layout) == cube);
        }
    CHECK(layoutSize(CubeLayout::horizontalCross, 5) == LayoutSize{20, 15});
    CHECK(layoutSize(CubeLayout::verticalCross, 5) == LayoutSize{15, 20});
    CHECK_THROWS_AS(unpackCube(Image<float>(8, 5), CubeLayout::horizontalCross), PreconditionError);
    CHECK_THROWS_AS(unpackCube(Image<float>(0, 0), CubeLayout::openExrStrip), PreconditionError);
}

// Texels that are neighbours on a cross are neighbours on the cube: their directions differ by a texel at
// most.
TEST_CASE("CrossesHaveNoSeams") {
    constexpr int kSize = 8;
    const TexelGrid grid({Mapping::cube, kSize, kSize});
    for (const CubeLayout layout : {CubeLayout::horizontalCross, CubeLayout::verticalCross}) {
        const LayoutSize size = layoutSize(layout, kSize);
        std::vector<glm::dvec3> directions(static_cast<size_t>(size.width * size.height), glm::dvec3(0));
        const auto at = [&](int x, int y) -> glm::dvec3& {
            return directions[static_cast<size_t>(y * size.width + x)];
        };
        for (int face = 0; face < 6; face++)
            for (int y = 0; y < kSize; y++)
                for (int x = 0; x < kSize; x++) {
                    const LayoutTexel t = layoutTexel(layout, kSize, face, x, y);
                    at(t.x, t.y) = grid.direction(face, x, y);
                }
        int pairs = 0;
        const auto check = [&](const glm::dvec3& a, const glm::dvec3& b) {
            if (a == glm::dvec3(0) || b == glm::dvec3(0)) return;
            const glm::dvec3 d = a - b;
            REQUIRE(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z) <= 2.1 / kSize);
            pairs++;
        };
        for (int y = 0; y < size.height; y++)
            for (int x = 0; x < size.width; x++) {
                if (x > 0) check(at(x, y), at(x - 1, y));
                if (y > 0) check(at(x, y), at(x, y - 1));
            }
        // Inside the faces, and five inner edges.
        CHECK(pairs == 6 * 2 * kSize * (kSize - 1) + 5 * kSize);
    }
}

TEST_CASE("OpenExrStripHasOpenExrsFaces") {
    constexpr int kSize = 7;
    const Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(kSize - 1, 6 * kSize - 1));
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < kSize; y++)
            for (int x = 0; x < kSize; x++) {
                // Where OpenEXR sees our texel; its pixel positions stretch to the borders of the face.
                const glm::dvec3 d = TexelGrid({Mapping::cube, kSize, kSize}).direction(face, x, y);
                Imf::CubeMapFace theirs{};
                Imath::V2f inFace;
                Imf::CubeMap::faceAndPixelPosition(
                    {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}, window,
                    theirs, inFace);
                REQUIRE(static_cast<int>(theirs) == face);
                const Imath::V2f p = Imf::CubeMap::pixelPosition(theirs, window, inFace);
                const LayoutTexel t = layoutTexel(CubeLayout::openExrStrip, kSize, face, x, y);
                const auto stretched = [](double i) { return (i + 0.5) / kSize * (kSize - 1); };
                REQUIRE(std::abs(p.x - stretched(t.x)) <= 1e-4);
                REQUIRE(std::abs(p.y - (face * kSize + stretched(t.y - face * kSize))) <= 1e-4);
            }
}

}  // namespace etalon
