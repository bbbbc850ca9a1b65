// Images: planar, row 0 on top, pixel centres at +0.5.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "numeric/check.h"

namespace etalon {

// The largest width or height of an image that can be rendered to (see raster rule 2, guard band).
inline constexpr int kMaxImageSize = 65536;

// width x height pixels with `channels` planes; each plane is contiguous, row-major. Zero-initialised.
// An image of zero width or height is valid and empty.
template <class T>
class Image {
  public:
    Image() = default;
    Image(int width, int height, int channels = 1) : width_(width), height_(height), channels_(channels) {
        ETALON_CHECK(
            width >= 0 && width <= kMaxImageSize && height >= 0 && height <= kMaxImageSize && channels >= 1,
            "image of {}x{} with {} channels", width, height, channels);
        values_.resize(pixelCount() * static_cast<size_t>(channels));
    }

    int width() const { return width_; }
    int height() const { return height_; }
    int channels() const { return channels_; }
    size_t pixelCount() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }
    bool empty() const { return values_.empty(); }

    T& at(int x, int y, int channel = 0) { return values_[index(x, y, channel)]; }
    const T& at(int x, int y, int channel = 0) const { return values_[index(x, y, channel)]; }

    std::span<T> plane(int channel) {
        return std::span(values_).subspan(static_cast<size_t>(channel) * pixelCount(), pixelCount());
    }
    std::span<const T> plane(int channel) const {
        return std::span(values_).subspan(static_cast<size_t>(channel) * pixelCount(), pixelCount());
    }
    std::span<T> row(int y, int channel = 0) {
        return std::span(values_).subspan(index(0, y, channel), static_cast<size_t>(width_));
    }
    std::span<const T> row(int y, int channel = 0) const {
        return std::span(values_).subspan(index(0, y, channel), static_cast<size_t>(width_));
    }
    std::span<T> values() { return values_; }
    std::span<const T> values() const { return values_; }

    void fill(const T& value) { std::fill(values_.begin(), values_.end(), value); }

    friend bool operator==(const Image&, const Image&) = default;

  private:
    size_t index(int x, int y, int channel) const {
        return (static_cast<size_t>(channel) * static_cast<size_t>(height_) + static_cast<size_t>(y)) *
                   static_cast<size_t>(width_) +
               static_cast<size_t>(x);
    }

    int width_ = 0, height_ = 0, channels_ = 1;
    std::vector<T> values_;
};

// Six square faces in the order +X -X +Y -Y +Z -Z, laid out as the GL/Vulkan face table says
// (docs/conventions.md): face image row 0 is t = 0.
template <class T>
struct CubeMap {
    CubeMap() = default;
    CubeMap(int size, int channels) { faces.fill(Image<T>(size, size, channels)); }

    int size() const { return faces[0].width(); }
    int channels() const { return faces[0].channels(); }

    friend bool operator==(const CubeMap&, const CubeMap&) = default;

    std::array<Image<T>, 6> faces;
};

}  // namespace etalon
