#include "lighting/shade_tile.h"
#include "numeric/rounded.h"

namespace etalon {

ArithmeticPasses passesFp32Flush() { return passesOver<Rounded<kFp32Flush, Native<double>>>(); }

}  // namespace etalon
