#include "lighting/shade_tile.h"
#include "numeric/rounded.h"

namespace etalon {

ArithmeticPasses passesFp16() { return passesOver<Rounded<kFp16, Native<double>>>(); }

}  // namespace etalon
