#include "lighting/shade_tile.h"
#include "numeric/rounded.h"

namespace etalon {

ArithmeticPasses passesFp16Nv40() { return passesOver<Rounded<kFp16Nv40, Native<double>>>(); }

}  // namespace etalon
