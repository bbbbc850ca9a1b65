#include "lighting/shade_tile.h"
#include "numeric/rounded.h"

namespace etalon {

ArithmeticPasses passesFp32Nv40() { return passesOver<Rounded<kFp32Nv40, Native<double>>>(); }

}  // namespace etalon
