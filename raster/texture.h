// Textures as kernel texts see them: a handle on stored texels and fetches by integer coordinates.
// The GLSL counterpart is raster/kernels/texture_scope.glsl (texelFetch of a sampler2DArray).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "numeric/kernel_types.h"
#include "numeric/narrow.h"
#include "numeric/number.h"
#include "raster/image.h"
#include "raster/texture_unit.h"

namespace etalon {

// A view of an image (one layer), of a cube map (six layers: the faces) or of several images of one shape,
// with texels stored as float or double. Does not own the texels: the images outlive the view.
class TextureView {
  public:
    static constexpr int kMaxLayers = 6;

    TextureView() = default;
    explicit TextureView(const Image<float>& image) {
        setShape(image), layers_[0].narrow = image.values().data();
    }
    explicit TextureView(const Image<double>& image) {
        setShape(image), isDouble_ = true, layers_[0].wide = image.values().data();
    }
    // All six faces have the same size and channels.
    explicit TextureView(const CubeMap<float>& cube) : TextureView(cube.faces[0]) {
        setFaces(std::span(cube.faces),
                 [](Layer& layer, const Image<float>& face) { layer.narrow = face.values().data(); });
    }
    explicit TextureView(const CubeMap<double>& cube) : TextureView(cube.faces[0]) {
        setFaces(std::span(cube.faces),
                 [](Layer& layer, const Image<double>& face) { layer.wide = face.values().data(); });
    }
    // 1 .. kMaxLayers images of one shape.
    explicit TextureView(std::span<const Image<float>> layers) {
        ETALON_CHECK(!layers.empty() && layers.size() <= kMaxLayers, "{} layers", layers.size());
        setShape(layers[0]);
        setFaces(layers,
                 [](Layer& layer, const Image<float>& image) { layer.narrow = image.values().data(); });
    }

    int width() const { return width_; }
    int height() const { return height_; }
    int channels() const { return channels_; }

    // The stored value; 0 <= layer < layers, 0 <= channel < channels(), 0 <= x < width(), 0 <= y < height().
    double stored(int layer, int channel, int x, int y) const {
        return storedAs<double>(layer, channel, x, y);
    }
    // The same, rounded once to S.
    template <class S>
    S storedAs(int layer, int channel, int x, int y) const {
        const size_t i =
            (static_cast<size_t>(channel) * static_cast<size_t>(height_) + static_cast<size_t>(y)) *
                static_cast<size_t>(width_) +
            static_cast<size_t>(x);
        const Layer& l = layers_[static_cast<size_t>(layer)];
        return isDouble_ ? static_cast<S>(l.wide[i]) : static_cast<S>(l.narrow[i]);
    }
    // The first channel of a layer stored as float; null where texels are doubles.
    const float* floats(int layer) const {
        return isDouble_ ? nullptr : layers_[static_cast<size_t>(layer)].narrow;
    }
    size_t planeSize() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }

  private:
    union Layer {
        const float* narrow = nullptr;
        const double* wide;
    };

    template <class S>
    void setShape(const Image<S>& image) {
        ETALON_CHECK(!image.empty(), "texture of {}x{}", image.width(), image.height());
        width_ = image.width(), height_ = image.height(), channels_ = image.channels();
    }
    template <class Images, class Set>
    void setFaces(const Images& images, Set set) {
        for (size_t f = 0; f < images.size(); f++) {
            const auto& face = images[f];
            ETALON_CHECK(face.width() == width_ && face.height() == height_ && face.channels() == channels_,
                         "layer {} is {}x{} with {} channels, layer 0 is {}x{} with {}", f, face.width(),
                         face.height(), face.channels(), width_, height_, channels_);
            set(layers_[f], face);
        }
    }

    std::array<Layer, kMaxLayers> layers_{};
    int width_ = 0, height_ = 0, channels_ = 0;
    bool isDouble_ = false;
};

// Texels as numbers of the type T, each rounded once to T.
template <class T>
struct TexelFetch {
    static constexpr int kCount = Number<T>::lanes;
    using Integer = typename NumberTraits<T>::Integer;

    // The texels at per-lane coordinates inside the texture.
    static T of(const TextureView& t, Integer layer, int channel, Integer x, Integer y) {
        if constexpr (kCount == 1)
            return T(t.stored(layer, channel, x, y));
        else if constexpr (std::is_same_v<T, Lanes<float, kCount>>)
            return T::generate([&](int i) { return t.storedAs<float>(layer[i], channel, x[i], y[i]); });
        else if constexpr (std::is_same_v<T, Narrow<Lanes<float, kCount>>>) {
            if (t.floats(0))
                return T(Lanes<float, kCount>::generate(
                    [&](int i) { return t.storedAs<float>(layer[i], channel, x[i], y[i]); }));
            return Number<T>::generate([&](int i) { return t.stored(layer[i], channel, x[i], y[i]); });
        } else
            return Number<T>::generate([&](int i) { return t.stored(layer[i], channel, x[i], y[i]); });
    }
    // The first three channels of two texels, if the second one is stored behind the first one in every lane,
    // texels are floats and T has lanes of float; else false, and nothing is written.
    static bool neighbours(const TextureView& t, Integer layer0, Integer x0, Integer y0, Integer layer1,
                           Integer x1, Integer y1, glm::vec<3, T>& first, glm::vec<3, T>& second) {
        using Floats = Lanes<float, kCount>;
        if constexpr (std::is_same_v<T, Floats> || std::is_same_v<T, Narrow<Floats>>) {
            constexpr size_t kLargest = size_t{1} << 31;
            if (t.planeSize() >= kLargest || !t.floats(0)) return false;
            const Integer width = Integer(static_cast<double>(t.width()));
            const Integer offset = y0 * width + x0;
            if (anyOf(offset + Integer(1.0) != y1 * width + x1 || layer0 != layer1)) return false;
            std::array<const float*, static_cast<size_t>(kCount)> texels;
            // Mostly all lanes read one layer.
            const bool isOneLayer = !anyOf(layer0 != Integer(static_cast<double>(layer0[0])));
            const float* layer = t.floats(layer0[0]);
            for (int i = 0; i < kCount; i++)
                texels[static_cast<size_t>(i)] = (isOneLayer ? layer : t.floats(layer0[i])) + offset[i];
            for (int c = 0; c < 3; c++) {
                const size_t channel = static_cast<size_t>(c) * t.planeSize();
                if constexpr (std::is_same_v<T, Floats>) {
                    loadPairs(texels, channel, first[c], second[c]);
                } else {
                    Floats a, b;
                    loadPairs(texels, channel, a, b);
                    first[c] = T(a), second[c] = T(b);
                }
            }
            return true;
        }
        return false;
    }
};

}  // namespace etalon
