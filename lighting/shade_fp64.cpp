#include "lighting/shade_tile.h"

namespace etalon {

ArithmeticPasses passesFp64() { return passesOver<Lanes<double>>(); }

}  // namespace etalon
