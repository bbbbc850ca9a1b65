#include "lighting/shade_tile.h"
#include "numeric/rounded.h"

namespace etalon {

ArithmeticPasses passesBf16() { return passesOver<Rounded<kBf16, Native<double>>>(); }

}  // namespace etalon
