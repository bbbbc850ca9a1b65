#include "lighting/shading_passes.h"

#include "lighting/shade_tile.h"
#include "numeric/door.h"

namespace etalon {

template <class T>
constexpr ShadingPasses kPassesOver<ShadingPasses, T> = {
    [](const ShadeJob& job) -> std::unique_ptr<TileShader> {
        return std::make_unique<TileShaderOf<T>>(job);
    }};
template const ShadingPasses& ETALON_LEVEL::passesOf<ShadingPasses>(NumberType);

}  // namespace etalon
