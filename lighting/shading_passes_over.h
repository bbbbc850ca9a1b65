// The shading passes over a number type, for the sources that instantiate them.
#pragma once

#include "lighting/shade_tile.h"
#include "lighting/shading_passes.h"

namespace etalon {

template <class T>
ShadingPasses shadingPassesOver() {
    return {[](const ShadeJob& job) -> std::unique_ptr<TileShader> {
        return std::make_unique<TileShaderOf<T>>(job);
    }};
}

}  // namespace etalon
