#include "files/mesh.h"

#include <bit>
#include <glm/vec3.hpp>

#include "numeric/check.h"
#include "numeric/transform.h"

namespace etalon {

namespace {

// Twice the area times the unit normal of triangle t.
glm::dvec3 areaVector(const Mesh& mesh, size_t t) {
    const glm::dvec3 a(mesh.positions[mesh.indices[3 * t]]);
    const glm::dvec3 b(mesh.positions[mesh.indices[3 * t + 1]]);
    const glm::dvec3 c(mesh.positions[mesh.indices[3 * t + 2]]);
    return crossOf({b.x - a.x, b.y - a.y, b.z - a.z}, {c.x - a.x, c.y - a.y, c.z - a.z});
}

bool isZero(const glm::dvec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

// Mixes the bits of a position; only the speed depends on it (the finalizer of MurmurHash3).
uint64_t hashOf(const glm::vec3& p) {
    uint64_t h = std::bit_cast<uint32_t>(p.x);
    for (const float c : {p.y, p.z}) {
        h = (h << 32 | h >> 32) ^ std::bit_cast<uint32_t>(c);
        h ^= h >> 33;
        h *= 0xff51afd7ed558ccdULL;
        h ^= h >> 33;
        h *= 0xc4ceb9fe1a85ec53ULL;
        h ^= h >> 33;
    }
    return h;
}

// For each vertex the first vertex at exactly its position: an open hash table, at most half full.
std::vector<uint32_t> firstAtSamePosition(const std::vector<glm::vec3>& positions) {
    constexpr uint32_t kFree = UINT32_MAX;
    const size_t slots = std::bit_ceil(2 * positions.size() + 1);
    std::vector<uint32_t> table(slots, kFree), first(positions.size());
    for (size_t i = 0; i < positions.size(); i++) {
        size_t slot = hashOf(positions[i]) & (slots - 1);
        while (table[slot] != kFree && positions[table[slot]] != positions[i])
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == kFree) table[slot] = static_cast<uint32_t>(i);
        first[i] = table[slot];
    }
    return first;
}

}  // namespace

size_t fillSmoothNormals(Mesh& mesh, const std::vector<uint8_t>& missing) {
    ETALON_CHECK(missing.size() == mesh.positions.size(), "{} flags for {} vertices", missing.size(),
                 mesh.positions.size());
    mesh.normals.resize(mesh.positions.size());
    const std::vector<uint32_t> first = firstAtSamePosition(mesh.positions);
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (size_t t = 0; t < mesh.triangleCount(); t++) {
        const glm::dvec3 area = areaVector(mesh, t);
        for (size_t corner = 0; corner < 3; corner++) {
            glm::dvec3& sum = sums[first[mesh.indices[3 * t + corner]]];
            sum = {sum.x + area.x, sum.y + area.y, sum.z + area.z};
        }
    }
    size_t undefined = 0;
    for (size_t i = 0; i < mesh.positions.size(); i++) {
        if (missing[i] == 0) continue;
        glm::dvec3 normal = unitOf(sums[first[i]]);
        if (isZero(normal)) {
            normal = {0, 1, 0};
            undefined++;
        }
        mesh.normals[i] = glm::vec3(normal);
    }
    return undefined;
}

size_t countZeroAreaTriangles(const Mesh& mesh) {
    size_t count = 0;
    for (size_t t = 0; t < mesh.triangleCount(); t++) count += isZero(areaVector(mesh, t)) ? 1 : 0;
    return count;
}

}  // namespace etalon
