#include "numeric/door.h"
#include "raster/blur.h"

namespace etalon {

template <class T>
constexpr BlurPasses kPassesOver<BlurPasses, T> = {blurGaussian<T>};
template const BlurPasses& ETALON_LEVEL::passesOf<BlurPasses>(NumberType);

}  // namespace etalon
