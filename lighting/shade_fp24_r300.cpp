#include "lighting/shade_tile.h"
#include "numeric/rounded.h"

namespace etalon {

ArithmeticPasses passesFp24R300() { return passesOver<Rounded<kFp24R300, Native<double>>>(); }

}  // namespace etalon
