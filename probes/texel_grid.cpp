#include "probes/texel_grid.h"

#include <algorithm>
#include <cmath>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/vectors.h"
#include "probes/disc_solid_angle.h"

namespace etalon {
namespace {

// Of the corner between a cube face's middle and the point of its plane at border i and j.
double cubeCornerSolidAngle_sr(int size, int i, int j) {
    const double s = (2.0 * i - size) / size, t = (2.0 * j - size) / size;
    return atan2Of(s * t, std::sqrt(s * s + (t * t + 1.0)));
}

size_t indexOf(int width, int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
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
            const double corner = cubeCornerSolidAngle_sr(size, i, j);
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

template <class Pixel>
void checkLayers(const std::vector<Image<Pixel>>& layers, const ProbeShape& shape, int channels,
                 const char* what) {
    ETALON_CHECK(layers.size() == static_cast<size_t>(shape.layers()), "{} of {} layers, not {}", what,
                 layers.size(), shape.layers());
    for (const Image<Pixel>& layer : layers)
        ETALON_CHECK(
            layer.width() == shape.width && layer.height() == shape.height && layer.channels() == channels,
            "{} of {}x{} with {} channels, not {}x{} with {}", what, layer.width(), layer.height(),
            layer.channels(), shape.width, shape.height, channels);
}

}  // namespace

void checkShape(const ProbeShape& shape) {
    ETALON_CHECK(shape.width >= 1 && shape.height >= 1, "{}x{}", shape.width, shape.height);
    ETALON_CHECK(isLatLong(shape.mapping) || shape.width == shape.height, "images of {}x{} are not square",
                 shape.width, shape.height);
    ETALON_CHECK(shape.mapping != Mapping::mirrorBall || shape.ballDistance_radii >= kLeastBallDistance_radii,
                 "a mirror ball seen from {} radii", shape.ballDistance_radii);
}

void checkProbe(const Probe& probe) {
    checkShape(probe.shape);
    checkLayers(probe.radiance, probe.shape, 3, "radiance");
    if (!probe.distance_m.empty()) checkLayers(probe.distance_m, probe.shape, 1, "distance");
    if (!probe.valid.empty()) checkLayers(probe.valid, probe.shape, 1, "validity");
}

double cubeTexelSolidAngle_sr(int size, int x, int y) {
    const auto corner = [&](int i, int j) { return cubeCornerSolidAngle_sr(size, i, j); };
    return (corner(x + 1, y + 1) - corner(x, y + 1)) - (corner(x + 1, y) - corner(x, y));
}

bool showsDirection(const ProbeShape& shape, int x, int y) {
    if (!isDisc(shape.mapping)) return true;
    // From the middle to the nearest point of the texel, in half texels.
    const auto nearest = [&](int i) -> int64_t {
        return std::max({0, 2 * i - shape.width, shape.width - 2 * i - 2});
    };
    const int64_t size = shape.width;
    return nearest(x) * nearest(x) + nearest(y) * nearest(y) < size * size;
}

TexelGrid::TexelGrid(const ProbeShape& shape) : shape_(shape) {
    checkShape(shape);
    settings_ = mappingSettingsOf<MappingKernel<double>>(shape);
    if (isLatLong(shape.mapping)) latLong_.emplace(shape.width, shape.height);
    if (shape.mapping == Mapping::cube) solidAngle_sr_ = cubeSolidAngles_sr(shape.width);
    if (isDisc(shape.mapping)) solidAngle_sr_ = discSolidAngles_sr(shape);
}

glm::dvec3 TexelGrid::direction(int layer, int x, int y) const {
    MappingKernel<double> kernel;
    if (latLong_) {
        const glm::dvec3 d = latLong_->direction(x, y);
        return shape_.mapping == Mapping::latLong ? d : kernel.listingAxes(d);
    }
    const glm::dvec3 d = kernel.mappingDirection(layer, coordinateOf(x, 0, shape_.width, 1),
                                                 coordinateOf(y, 0, shape_.height, 1), settings_);
    return shape_.mapping == Mapping::cube ? d / std::sqrt(d.x * d.x + (d.y * d.y + d.z * d.z)) : d;
}

double TexelGrid::solidAngle_sr(int, int x, int y) const {
    if (latLong_) return latLong_->solidAngle_sr(y);
    if (shape_.mapping == Mapping::cube) return solidAngle_sr_[indexOf(shape_.width, x, y)];
    if (shape_.mapping == Mapping::octahedral)
        return 4.0 * kPi / (static_cast<double>(shape_.width) * shape_.width);
    return solidAngle_sr_[indexOf((shape_.width + 1) / 2, std::min(x, shape_.width - 1 - x),
                                  std::min(y, shape_.width - 1 - y))];
}

double latLongMidpointSolidAngle_sr(int width, int height, int y, RowAngle angle) {
    const double perRow_rad = kPi / height;
    const double theta_rad = angle == RowAngle::centre ? (y + 0.5) * perRow_rad : y * perRow_rad;
    return 2.0 * kPi / width * perRow_rad * sinOf(theta_rad);
}

double cubeMidpointSolidAngle_sr(int size, int x, int y) {
    const double s = (2.0 * x + 1.0 - size) / size, t = (2.0 * y + 1.0 - size) / size;
    const double square = s * s + (t * t + 1.0);
    return 4.0 / (static_cast<double>(size) * size * (square * std::sqrt(square)));
}

double angularMidpointSolidAngle_sr(int size, int x, int y) {
    const double s = (2.0 * x + 1.0 - size) / size, t = (2.0 * y + 1.0 - size) / size;
    const double radius = std::sqrt(s * s + t * t);
    if (radius > 1.0) return 0.0;
    const double theta_rad = kPi * radius, step = 2.0 * kPi / size;
    return step * step * (theta_rad > 0.0 ? sinOf(theta_rad) / theta_rad : 1.0);
}

}  // namespace etalon
