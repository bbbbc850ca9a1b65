// A brute-force oracle for rules 1 to 4 of docs/specification.md: clipping, snapping, facing and coverage of
// one triangle, written from the specification alone, one sample at a time and with 128-bit integers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "raster/draw.h"
#include "raster/rasterizer.h"

namespace etalon::oracle {

// Wide enough that no product of snapped coordinates can overflow, whatever clipping left behind.
using Wide = __int128;

// One piece of a polygon after rule 3; vertices 1 and 2 are exchanged where its area was negative.
struct Piece {
    std::array<Wide, 3> x_subpx{}, y_subpx{};
    Wide area = 0;                   // twice the area in subpixels, >= 0 after the exchange
    int sign = 0;                    // of the area before the exchange: -1, 0 or 1
    std::array<double, 3> z{}, w{};  // of the clip-space vertices
    std::array<std::array<double, 3>, 3> barycentric{};  // of the vertices in the source triangle
    std::array<int, 3> corner{};                         // index of the vertex in the polygon
};

enum class Fate : uint8_t {
    nonFinite,  // dropped by rule 1
    rejected,   // all three vertices outside one plane
    zeroArea,   // nothing to draw after snapping
    drawn,
};

struct Polygon {
    Fate fate = Fate::drawn;
    bool clipped = false;  // went through at least one plane
    int sign = 0;          // of the signed area: -1 is counter-clockwise on the screen
    std::vector<Piece> pieces;
};

// Rules 1 to 3 for one triangle. subpixelBits: 4 to 8.
Polygon preparePolygon(const std::array<ClipVertex, 3>& triangle, const Viewport& viewport, int subpixelBits,
                       bool depthClamp);

// E_i of rule 4 at a position in subpixels.
std::array<Wide, 3> edgeValues(const Piece& piece, Wide x_subpx, Wide y_subpx);

// Rule 4 for one piece.
bool pieceCovers(const Piece& piece, Wide x_subpx, Wide y_subpx);

// Rule 2: the index of the piece that a covered sample takes its depth from, or nothing where it is not
// covered.
std::optional<size_t> coveringPiece(const Polygon& polygon, Wide x_subpx, Wide y_subpx);

// Position of a sample of pixel (x, y) in subpixels. samples: 1, 4 or 16.
std::array<Wide, 2> samplePosition(int x, int y, int samples, int sample, int subpixelBits);

}  // namespace etalon::oracle
