#include "lighting/shade_tile.h"
#include "numeric/rounded.h"

namespace etalon {

ArithmeticPasses passesFp24R300() { return passesOver<Rounded<kFp24R300, Lanes<double>>>(); }

}  // namespace etalon
