// The solid angles that texels of one probe have in common with those of another, in double.
//
// The borders of a texel of the result are curves on the image of the source. Each is cut where the source's mapping
// bends (faces of a cube, octants, the meridians through its poles) and becomes a line of straight pieces: it is halved
// until the area between curve and line is small against the texel, where a piece counts the parabola through its
// ends and its middle. Neighbouring texels have the same line between them. So the texels of the result
// tile the source's image without gaps, and what a texel of the source gives to all of them adds up to its solid angle.
// The polygon of each texel is cut along the rows and columns of the source's image. The solid angle of a piece is its
// area in coordinates of constant density (lat-long: longitude and sine of latitude; octahedral; orthographic ball),
// that of the spherical polygon (cube), or the integral of 1 - cos(polar angle) along its border (other discs).
// Coarse texels are cut into cells of less than about 10 degrees first.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "probes/probe.h"

namespace etalon {

// A texel of the source and its part of a texel of the result: solid angles relative to the largest one.
struct TexelOverlap {
    int32_t layer, x, y;
    double weight;
};
// Of a row of texels of the result: those of texel x are overlaps[first[x]] to overlaps[first[x + 1] - 1], in the order
// of layers, rows and columns. None where a texel shows nothing of the source.
struct RowOverlaps {
    std::vector<size_t> first;
    std::vector<TexelOverlap> overlaps;
};

class TexelOverlaps {
  public:
    // turn: from directions of the result to directions of the source. Shapes that checkShape() accepts.
    TexelOverlaps(const ProbeShape& source, const ProbeShape& target, const glm::dmat3& turn);
    ~TexelOverlaps();
    TexelOverlaps(const TexelOverlaps&) = delete;
    TexelOverlaps& operator=(const TexelOverlaps&) = delete;

    // Of row y of a layer of the result; from any thread.
    RowOverlaps ofRow(int layer, int y) const;

  private:
    struct Shapes;
    std::unique_ptr<const Shapes> shapes_;
};

}  // namespace etalon
