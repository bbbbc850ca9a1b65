// The truth about shadows: whether a triangle stands between a point and a light, decided exactly, without
// the rasterizer.
//
// A point is lit unless the segment from it to the light crosses a triangle's plane strictly between its
// ends, inside the triangle or on its border. So:
//   - what touches an edge or a vertex is blocked, by every triangle there: closed meshes have no gaps, and a
//     ray that grazes a silhouette is blocked;
//   - a triangle that the point itself lies on (to the last bit) does not block it, neither does one that the
//     light lies on; points computed on a triangle miss it by a rounding: exclude that triangle by name;
//   - a triangle seen edge-on from the point or the light, and one without an area, blocks nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/light_visibility.h"
#include "lighting/surface_scene.h"

namespace etalon {

// Where light comes from: a point of the world, or (at infinity) a direction towards the light, of any
// length.
struct LightSource {
    glm::dvec3 place{0};
    bool atInfinity = false;
};
LightSource lightSourceOf(const SurfaceLight& light);

// A triangle of an instance.
struct TriangleName {
    uint32_t instance = UINT32_MAX, triangle = UINT32_MAX;
    friend bool operator==(const TriangleName&, const TriangleName&) = default;
};

struct WorldTriangle {
    std::array<glm::dvec3, 3> vertices;
    TriangleName name;
};

// The triangles of placed meshes; those of `excluded` are left out.
std::vector<WorldTriangle> worldTriangles(std::span<const PlacedMesh> placed,
                                          std::span<const uint32_t> excluded = {});

// An area light: the parallelogram centre +- u +- v. Zero lengths of u or v make it a segment or a point.
struct AreaLight {
    glm::dvec3 centre{0}, u{0}, v{0};
};

// The centres of its n x n equal cells, row by row: points whose mean converges to the area's. n >= 1. The
// visible fraction beside a straight edge is off by at most 1 / n, by less on average.
std::vector<glm::dvec3> stratifiedPoints(const AreaLight& light, int n);

class VisibilityOracle {
  public:
    // tree: skips what bounding boxes show to be beside the segment; allTriangles: tests each. The same
    // answers.
    enum class Search : uint8_t { tree, allTriangles };

    // Throws PreconditionError for coordinates outside the range of shadows/exact_side.h, NaN and infinity
    // among them; so do the functions below for points and lights.
    explicit VisibilityOracle(std::vector<WorldTriangle> triangles, Search search = Search::tree);

    // `receiver`: the triangle that the point lies on.
    bool isVisible(const glm::dvec3& point, const LightSource& light, TriangleName receiver = {}) const;
    // How many triangles stand in between.
    size_t blockers(const glm::dvec3& point, const LightSource& light, TriangleName receiver = {}) const;
    // The fraction of the light's points that is visible; at least one of them.
    double visibleFraction(const glm::dvec3& point, std::span<const glm::dvec3> lightPoints,
                           TriangleName receiver = {}) const;

    size_t size() const { return triangles_.size(); }

  private:
    // A box and what it holds: nodes [child, child + 2), or triangles [first, first + count).
    struct Node {
        glm::dvec3 centre, halfSize;  // the box is inside centre +- halfSize
        uint32_t child = 0, first = 0, count = 0;
    };
    void build(uint32_t node, uint32_t first, uint32_t count);
    template <class Visit>
    void visitBlockers(const glm::dvec3& point, const LightSource& light, TriangleName receiver,
                       Visit visit) const;

    std::vector<WorldTriangle> triangles_;
    std::vector<Node> nodes_;
    Search search_;
};

// The oracle as what shading asks: the exact shadows of the lights of a scene. Points that shading computes
// lie on their triangle up to roundings, and are therefore moved by offset_m along their face normal.
class OracleVisibility final : public LightVisibility {
  public:
    OracleVisibility(const VisibilityOracle& oracle, const SurfaceScene& scene, double offset_m);
    bool casts(size_t light) const override;
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override;

  private:
    const VisibilityOracle* oracle_;
    std::vector<LightSource> lights_;
    double offset_m_;
};

}  // namespace etalon
