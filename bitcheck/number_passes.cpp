#include "bitcheck/number_tables.h"

#include "numeric/levels.h"

namespace etalon {

ETALON_PASSES_OF_ACTIVE_LEVEL(NumberPasses, numberPasses)

}  // namespace etalon
