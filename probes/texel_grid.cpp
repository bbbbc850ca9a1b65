#include "probes/texel_grid.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/elementary.h"

namespace etalon {

namespace {

// The solid angle between the middle of a cube face and the point (i, j) of its corners of texels, with the
// signs of both distances from the middle.
double cornerSolidAngle_sr(int size, int i, int j) {
    const double s = (2.0 * i - size) / size, t = (2.0 * j - size) / size;
    return atan2Of(s * t, std::sqrt(s * s + (t * t + 1.0)));
}

// Of all texels of a face. Corners are odd in both directions: a quarter of them is computed.
std::vector<double> cubeSolidAngles_sr(int size) {
    const auto across = static_cast<size_t>(size) + 1;
    std::vector<double> corners(across * across);
    const auto cornerOf = [&](int i, int j) -> double& {
        return corners[static_cast<size_t>(j) * across + static_cast<size_t>(i)];
    };
    for (int j = size; 2 * j >= size; j--)
        for (int i = size; 2 * i >= size; i--) {
            const double corner = cornerSolidAngle_sr(size, i, j);
            cornerOf(size - i, size - j) = corner;
            cornerOf(size - i, j) = -corner;
            cornerOf(i, size - j) = -corner;
            cornerOf(i, j) = corner;
        }
    std::vector<double> texels;
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            texels.push_back((cornerOf(x + 1, y + 1) - cornerOf(x, y + 1)) -
                             (cornerOf(x + 1, y) - cornerOf(x, y)));
    return texels;
}

}  // namespace

double cubeTexelSolidAngle_sr(int size, int x, int y) {
    const auto corner = [&](int i, int j) { return cornerSolidAngle_sr(size, i, j); };
    return (corner(x + 1, y + 1) - corner(x, y + 1)) - (corner(x + 1, y) - corner(x, y));
}

TexelGrid::TexelGrid(const ProbeShape& shape) : shape_(shape) {
    ETALON_CHECK(shape.width >= 1 && shape.height >= 1, "{}x{}", shape.width, shape.height);
    switch (shape.mapping) {
        case Mapping::latLong:
            latLong_.emplace(shape.width, shape.height);
            return;
        case Mapping::cube:
            ETALON_CHECK(shape.width == shape.height, "faces of {}x{}", shape.width, shape.height);
            cubeSolidAngle_sr_ = cubeSolidAngles_sr(shape.width);
            return;
        case Mapping::angular:
        case Mapping::mirrorBall:
        case Mapping::octahedral:
            break;
    }
    ETALON_CHECK(false, "mapping {}", static_cast<int>(shape.mapping));
}

glm::dvec3 TexelGrid::direction(int layer, int x, int y) const {
    if (latLong_) return latLong_->direction(x, y);
    const glm::dvec3 d =
        CubeFaceKernel<double>{}.cubeDirection(layer, (x + 0.5) / shape_.width, (y + 0.5) / shape_.height);
    return d / std::sqrt(d.x * d.x + (d.y * d.y + d.z * d.z));
}

double TexelGrid::solidAngle_sr(int, int x, int y) const {
    if (latLong_) return latLong_->solidAngle_sr(y);
    return cubeSolidAngle_sr_[static_cast<size_t>(y) * static_cast<size_t>(shape_.width) +
                              static_cast<size_t>(x)];
}

}  // namespace etalon
