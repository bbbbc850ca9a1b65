#include "lighting/shade_tile.h"

namespace etalon {

ArithmeticPasses passesFp32() { return passesOver<Lanes<float, kLanes>>(); }

}  // namespace etalon
