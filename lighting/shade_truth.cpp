#include "lighting/shade_tile.h"
#include "numeric/truth.h"
#include "numeric/truth_elementary.h"

namespace etalon {

ArithmeticPasses passesTruth() { return passesOver<Truth>(); }

}  // namespace etalon
