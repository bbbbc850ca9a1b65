#include "bitcheck/number_tables.h"
#include "numeric/levels.h"

namespace etalon {

#define ETALON_DECLARE(name)                \
    namespace level_##name {                \
        const NumberPasses& numberPasses(); \
    }
ETALON_FOR_EACH_LEVEL(ETALON_DECLARE)

const NumberPasses& numberPasses() {
    switch (activeIsa()) {
#define ETALON_CASE(name) \
    case IsaLevel::name:  \
        return level_##name::numberPasses();
        ETALON_FOR_EACH_LEVEL(ETALON_CASE)
        default:
            break;
    }
    ETALON_CHECK(false, "level {} is not built", isaName(activeIsa()));
    __builtin_unreachable();
}

}  // namespace etalon
