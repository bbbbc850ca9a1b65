// The image of a probe as a plane in which areas become solid angles and texels are rectangles; for
// probes/texel_overlaps.h. In double.
//
// The sphere is cut by planes through its middle into patches, on each of which the plane's coordinates are smooth: the
// faces of a cube, the octants of octahedral images, the quarters between the poles of the others.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probes/mapping.h"

namespace etalon {

// Directions nearer to each other than this count as one, and to a plane as on it.
inline constexpr double kSameDirection = 1e-12;

class SourceChart {
  public:
    explicit SourceChart(const ProbeShape& shape);

    // Normals of the planes between patches.
    std::span<const glm::dvec3> planes() const { return planes_; }
    int patchOf(const glm::dvec3& d) const;
    // The corner of patches nearest to d.
    glm::dvec3 cornerNear(const glm::dvec3& d) const;
    // Directions that a whole border shows: the poles of lat-long images, -Z of discs.
    bool isSingular(const glm::dvec3& d) const;

    // Unit direction d, of a patch or its border, in texels to the right and downwards; of lat-long images the second
    // coordinate is minus the sine of the latitude.
    glm::dvec2 at(int patch, const glm::dvec3& d) const;
    // The point that shows the singular direction nearest to d and has the azimuth of `point`.
    glm::dvec2 singularPoint(const glm::dvec3& d, const glm::dvec2& point) const;
    // A singular direction's border is an arc of the rim; else it is straight.
    bool isDisc() const { return kind_ == Kind::disc; }
    glm::dvec2 rimPoint(const glm::dvec2& from, const glm::dvec2& to, double part) const;

    // Borders of columns and rows, in these coordinates.
    const std::vector<double>& columns() const { return columns_; }
    const std::vector<double>& rows() const { return rows_; }
    int layerOf(int patch) const { return kind_ == Kind::cube ? patch : 0; }

    // Solid angle per area at a point, for estimates.
    double density(const glm::dvec2& p) const;
    // Of a polygon, with the sign of its orientation.
    double solidAngle_sr(std::span<const glm::dvec2> polygon) const;

  private:
    enum class Kind : uint8_t { latLong, cube, octahedral, disc };
    // To and from [-1, 1], x to the right and y upwards.
    glm::dvec2 onSquare(const glm::dvec2& p) const {
        return {2.0 * p.x / size_ - 1.0, 1.0 - 2.0 * p.y / size_};
    }
    glm::dvec2 inTexels(double x, double y) const {
        return {(0.5 + 0.5 * x) * size_, (0.5 - 0.5 * y) * size_};
    }
    double cubeSolidAngle_sr(std::span<const glm::dvec2> polygon) const;
    double discSolidAngle_sr(std::span<const glm::dvec2> polygon) const;

    Kind kind_;
    bool isPedersen_, isAngular_, hasConstantDensity_;
    double size_;
    double constantDensity_ = 0;  // sr per area of the coordinates
    // Where -Z is. What a near ball does not show lies beyond its disc, where there is no density.
    double rimRadius_ = 1;
    MappingKernel<double>::MappingSettings settings_;
    std::vector<glm::dvec3> planes_;
    std::vector<double> columns_, rows_;
    struct FaceAxes {
        glm::dvec3 major, s, t;
    };
    std::vector<FaceAxes> faces_;
};

}  // namespace etalon
