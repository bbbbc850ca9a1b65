#include "lighting/shade_tile.h"

namespace etalon {

ArithmeticPasses passesFp32() { return passesOver<Native<float>>(); }

}  // namespace etalon
