#include "numeric/check.h"

namespace etalon {

void failCheck(const CheckPlace& place, const char* format, const TextValue* values, size_t count) {
    throw PreconditionError(formatText("{}:{}: precondition failed: {} ({})", place.file, place.line,
                                       place.condition, formatValues(format, values, count)));
}

}  // namespace etalon
