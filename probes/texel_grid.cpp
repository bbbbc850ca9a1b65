#include "probes/texel_grid.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/elementary.h"

namespace etalon {

double cubeTexelSolidAngle_sr(int size, int x, int y) {
    // Of the corner between the face's middle and the point (s, t) of the face's plane.
    const auto corner = [&](int i, int j) {
        const double s = (2.0 * i - size) / size, t = (2.0 * j - size) / size;
        return atan2Of(s * t, std::sqrt(s * s + (t * t + 1.0)));
    };
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
            for (int y = 0; y < shape.height; y++)
                for (int x = 0; x < shape.width; x++)
                    cubeSolidAngle_sr_.push_back(cubeTexelSolidAngle_sr(shape.width, x, y));
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
