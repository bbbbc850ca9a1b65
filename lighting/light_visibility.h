// What stands between the lights and the points that they light.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace etalon {

// Points of surfaces, in world space: what fragments are lit at. One element per point in each
// array; the doubles hold numbers of the fragment arithmetic.
struct LitPoints {
    std::array<std::vector<double>, 3> position_m;
    std::array<std::vector<double>, 3> normal;      // unit, interpolated, towards the viewer
    std::array<std::vector<double>, 3> faceNormal;  // unit, of the triangle, towards the viewer
    std::vector<uint32_t> instance;
    std::vector<uint32_t> x_px, y_px;  // the pixel

    size_t size() const { return instance.size(); }
};

// The part of each light that reaches a point, 0 to 1. Implemented in shadows/. Its functions are called from
// several threads at once.
class LightVisibility {
  public:
    virtual ~LightVisibility() = default;
    // Whether anything may stand in the way of a light of the scene; if not, find() is not called for it.
    virtual bool casts(size_t light) const = 0;
    // visibility[i] is that of point i. Numbers of the fragment arithmetic.
    virtual void find(size_t light, const LitPoints& points, std::span<double> visibility) const = 0;
};

}  // namespace etalon
