#include "lighting/tone_map.h"
#include "numeric/door.h"

namespace etalon {

template <>
constexpr ToneMapPasses kPassesOver<ToneMapPasses, void> = {toneMap<Native<float>>};
template const ToneMapPasses& ETALON_LEVEL::passesOf<ToneMapPasses>();

}  // namespace etalon
