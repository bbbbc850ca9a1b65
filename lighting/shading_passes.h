// The shading passes.
#pragma once

#include <memory>

#include "lighting/shade.h"

namespace etalon {

// Shades the fragments of tiles, one after the other; holds the scene's constants as its number type.
class TileShader {
  public:
    virtual ~TileShader() = default;
    // number: of the tile, row by row.
    virtual void run(size_t number, const PixelRectangle& rectangle, ShadedImages& images,
                     ShadeStatistics& statistics) = 0;
    // What fragmentPoints() has of a tile.
    virtual LitPoints points(const PixelRectangle& rectangle) = 0;
};

struct ShadingPasses {
    std::unique_ptr<TileShader> (*makeTileShader)(const ShadeJob& job);
};

}  // namespace etalon
