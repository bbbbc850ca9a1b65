#include "shadows/mesh_topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "numeric/check.h"
#include "shadows/exact_side.h"

namespace etalon {
namespace {

// For each vertex the first one in the same place.
std::vector<uint32_t> weldedVertices(std::span<const glm::dvec3> positions) {
    const auto key = [&](uint32_t v) {
        const glm::dvec3& p = positions[v];
        return std::array<uint64_t, 3>{std::bit_cast<uint64_t>(p.x + 0.0), std::bit_cast<uint64_t>(p.y + 0.0),
                                       std::bit_cast<uint64_t>(p.z + 0.0)};
    };
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        const auto ka = key(a), kb = key(b);
        return ka != kb ? ka < kb : a < b;
    });
    std::vector<uint32_t> welded(positions.size());
    for (size_t i = 0; i < order.size(); i++) {
        const bool isSame = i > 0 && key(order[i]) == key(order[i - 1]);
        welded[order[i]] = isSame ? welded[order[i - 1]] : order[i];
    }
    return welded;
}

struct DirectedEdge {
    uint32_t from, to;
    EdgeUse use;
};

std::vector<DirectedEdge> edgesOfTriangles(std::span<const glm::dvec3> positions,
                                           std::span<const uint32_t> indices, MeshTopology& topology) {
    const std::vector<uint32_t> welded = weldedVertices(positions);
    std::vector<DirectedEdge> edges;
    edges.reserve(indices.size());
    for (uint32_t t = 0; t < indices.size() / 3; t++) {
        std::array<uint32_t, 3> corner;
        for (size_t i = 0; i < 3; i++) {
            ETALON_CHECK(indices[3 * size_t{t} + i] < positions.size(), "triangle {}: vertex {} of {}", t,
                         indices[3 * size_t{t} + i], positions.size());
            corner[i] = welded[indices[3 * size_t{t} + i]];
        }
        topology.isUsed[t] =
            std::all_of(corner.begin(), corner.end(), [&](uint32_t v) { return isExactPoint(positions[v]); });
        if (!topology.isUsed[t]) {
            topology.leftOut++;
            continue;
        }
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) {
            topology.degenerate++;
            continue;
        }
        for (size_t i = 0; i < 3; i++) {
            const uint32_t a = corner[i], b = corner[(i + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), {t, a < b ? 1 : -1}});
        }
    }
    return edges;
}

// Counts the edges by kind; for each the sum of the directions.
std::vector<int> classifyEdges(MeshTopology& topology) {
    std::vector<int> sums;
    sums.reserve(topology.edges.size());
    for (const MeshEdge& edge : topology.edges) {
        int sum = 0;
        for (uint32_t i = 0; i < edge.useCount; i++) sum += topology.uses[edge.firstUse + i].direction;
        if (edge.useCount == 1) topology.openEdges++;
        if (edge.useCount == 2 && sum != 0) topology.discordantEdges++;
        if (edge.useCount > 2) topology.crowdedEdges++;
        sums.push_back(sum);
    }
    return sums;
}

// Triangles in sets that grow together; each set is known by its first triangle.
class TriangleSets {
  public:
    explicit TriangleSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    uint32_t first(uint32_t t) {
        while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
        return t;
    }
    void unite(uint32_t a, uint32_t b) {
        a = first(a), b = first(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<uint32_t> parent_;
};

void findParts(MeshTopology& topology, const std::vector<int>& sums) {
    constexpr uint32_t kNone = UINT32_MAX;
    const size_t count = topology.isUsed.size();
    TriangleSets sets(count);
    std::vector<uint8_t> hasEdges(count, 0);
    for (const EdgeUse& use : topology.uses) hasEdges[use.triangle] = 1;
    for (const MeshEdge& edge : topology.edges)
        for (uint32_t i = 1; i < edge.useCount; i++)
            sets.unite(topology.uses[edge.firstUse].triangle, topology.uses[edge.firstUse + i].triangle);

    // Parts in the order of their first triangles, then the triangles sorted by part.
    std::vector<uint32_t> part(count, kNone), size;
    for (uint32_t t = 0; t < count; t++) {
        if (!hasEdges[t]) continue;
        const uint32_t first = sets.first(t);
        if (first == t) {
            part[t] = static_cast<uint32_t>(size.size());
            size.push_back(0);
        }
        part[t] = part[first];
        size[part[t]]++;
    }
    topology.firstOfPart.assign(size.size() + 1, 0);
    std::partial_sum(size.begin(), size.end(), topology.firstOfPart.begin() + 1);
    std::vector<uint32_t> next = topology.firstOfPart;
    topology.trianglesOfParts.resize(topology.firstOfPart.back());
    for (uint32_t t = 0; t < count; t++)
        if (part[t] != kNone) topology.trianglesOfParts[next[part[t]]++] = t;

    topology.isClosed.assign(size.size(), 1);
    for (size_t e = 0; e < sums.size(); e++)
        if (sums[e] != 0) topology.isClosed[part[topology.uses[topology.edges[e].firstUse].triangle]] = 0;
}

}  // namespace

MeshTopology topologyOf(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices) {
    MeshTopology topology;
    topology.isUsed.resize(indices.size() / 3);
    std::vector<DirectedEdge> directed = edgesOfTriangles(positions, indices, topology);
    std::sort(directed.begin(), directed.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        if (a.from != b.from) return a.from < b.from;
        return a.to != b.to ? a.to < b.to : a.use.triangle < b.use.triangle;
    });
    topology.uses.reserve(directed.size());
    for (const DirectedEdge& d : directed) {
        const bool isNew = topology.edges.empty() || topology.edges.back().from != d.from ||
                           topology.edges.back().to != d.to;
        if (isNew) topology.edges.push_back({d.from, d.to, static_cast<uint32_t>(topology.uses.size()), 0});
        topology.edges.back().useCount++;
        topology.uses.push_back(d.use);
    }
    findParts(topology, classifyEdges(topology));
    return topology;
}

}  // namespace etalon
