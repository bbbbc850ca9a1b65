// The passes that exist once per fragment arithmetic; each number type is instantiated in a source of its own
// (shade_*.cpp).
#pragma once

#include <memory>

#include "lighting/latlong.h"
#include "lighting/shade.h"

namespace etalon {

// Shades the fragments of tiles, one after the other; holds the scene's constants as its number type.
class TileShader {
  public:
    virtual ~TileShader() = default;
    virtual void run(const PixelRectangle& rectangle, ShadedImages& images, ShadeStatistics& statistics) = 0;
};

struct ArithmeticPasses {
    std::unique_ptr<TileShader> (*makeTileShader)(const ShadeJob& job);
    CubeMap<float> (*cubeFromLatLong)(const Image<float>& latLong, int size, const CubeFromLatLong& options,
                                      int threads);
};

ArithmeticPasses passesTruth();
ArithmeticPasses passesFp64();
ArithmeticPasses passesFp32();
ArithmeticPasses passesFp32Flush();
ArithmeticPasses passesFp32Nv40();
ArithmeticPasses passesFp16();
ArithmeticPasses passesFp16Nv40();
ArithmeticPasses passesBf16();
ArithmeticPasses passesFp24R300();

// Those of an arithmetic.
ArithmeticPasses passesOf(FragmentArithmetic arithmetic);

}  // namespace etalon
