#include "lighting/shade_tile.h"

namespace etalon {

ArithmeticPasses passesFp64() { return passesOver<Native<double>>(); }

}  // namespace etalon
