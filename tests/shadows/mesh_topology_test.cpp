#include "shadows/mesh_topology.h"

#include <doctest/doctest.h>

#include <limits>

#include "bitcheck/inputs.h"
#include "shadows/shadow_volume.h"
#include "tests/support/shadow_meshes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

std::vector<glm::dvec3> positionsOf(const SurfaceMesh& mesh) {
    return {mesh.positions.begin(), mesh.positions.end()};
}
MeshTopology topologyOf(const SurfaceMesh& mesh) {
    return etalon::topologyOf(positionsOf(mesh), mesh.indices);
}

}  // namespace

TEST_CASE("ClosedMeshesHaveTwoTrianglesAtEachEdge") {
    // The box has 24 vertices, of which 8 places.
    const MeshTopology box = topologyOf(solidBox({1, 2, 3}, {0.5f, 1, 2}));
    CHECK(box.edges.size() == 18);
    for (const SurfaceMesh& mesh :
         {solidBox({0, 0, 0}, {1, 1, 1}), sphere(12, 7, {0, 0, 0}, 1), torusKnotMesh(24, 6)}) {
        const MeshTopology topology = topologyOf(mesh);
        CHECK(topology.isClosed == std::vector<uint8_t>{1});
        CHECK(topology.trianglesOf(0).size() * 3 == mesh.indices.size());
        CHECK(topology.openEdges + topology.crowdedEdges + topology.discordantEdges == 0);
        CHECK(topology.edges.size() * 2 == mesh.indices.size());
        CHECK(topology.uses.size() == mesh.indices.size());
    }
}

TEST_CASE("OpenCrowdedAndDiscordantEdgesAreCounted") {
    SurfaceMesh mesh = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    CHECK(topologyOf(mesh).openEdges == 4);
    CHECK(topologyOf(mesh).isClosed == std::vector<uint8_t>{0});
    // A third triangle at the diagonal.
    mesh.positions.emplace_back(0, 0, 1);
    mesh.indices.insert(mesh.indices.end(), {0, 2, 4});
    CHECK(topologyOf(mesh).crowdedEdges == 1);
    CHECK(topologyOf(mesh).openEdges == 6);
    // One of two triangles turned around.
    SurfaceMesh turned = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    std::swap(turned.indices[0], turned.indices[1]);
    CHECK(topologyOf(turned).discordantEdges == 1);
}

TEST_CASE("TrianglesWithoutPlaceAreNamed") {
    SurfaceMesh mesh = solidBox({0, 0, 0}, {1, 1, 1});
    // Minus zero is the same place as zero.
    mesh.positions.emplace_back(0.0f, 0, 5);
    mesh.positions.emplace_back(-0.0f, 0, 5);
    mesh.positions.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0, 0);
    mesh.indices.insert(mesh.indices.end(), {24, 25, 0, 26, 0, 1});
    const MeshTopology topology = topologyOf(mesh);
    CHECK(topology.degenerate == 1);
    CHECK(topology.leftOut == 1);
    CHECK(topology.isUsed[12] == 1);
    CHECK(topology.isUsed[13] == 0);
    CHECK(topology.isClosed == std::vector<uint8_t>{1});
    CHECK(topology.trianglesOfParts.size() == 12);
}

TEST_CASE("PartsAreTrianglesThatShareEdges") {
    // A box, a rectangle, and a box again.
    SurfaceMesh mesh = solidBox({0, 0, 0}, {1, 1, 1});
    for (const SurfaceMesh& other :
         {rectangle({5, 0, 0}, {1, 0, 0}, {0, 1, 0}), solidBox({9, 0, 0}, {1, 1, 1})}) {
        for (const uint32_t i : other.indices)
            mesh.indices.push_back(i + static_cast<uint32_t>(mesh.positions.size()));
        mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    }
    const MeshTopology topology = topologyOf(mesh);
    CHECK(topology.isClosed == std::vector<uint8_t>{1, 0, 1});
    CHECK(topology.firstOfPart == std::vector<uint32_t>{0, 12, 14, 26});
    CHECK(topology.trianglesOf(1)[0] == 12);
    // Which of them cast both sides, and the orientation of each.
    const std::vector<glm::dvec3> positions = positionsOf(mesh);
    CHECK(signedVolume(positions, mesh.indices, topology.trianglesOf(2)) == 8);
    CHECK(mayBeInside(positions, mesh.indices, topology.trianglesOf(0), {0.5, 0.5, 0.5}));
    CHECK_FALSE(mayBeInside(positions, mesh.indices, topology.trianglesOf(2), {0.5, 0.5, 0.5}));
    const auto volume = [&](const LightSource& light) {
        return shadowVolumeOf(positions, mesh.indices, topology, light, 1);
    };
    CHECK(volume({{0, 0, 1}, true}).closedParts == 2);
    CHECK(volume({{0, 0, 1}, true}).facing.size() == 6);
    CHECK(volume({{0.5, 0.5, 0.5}, false}).closedParts == 1);
    CHECK(volume({{0.5, 0.5, 0.5}, false}).away.size() == 12);
}
