#include "numeric/emulated_format.h"

namespace etalon {

thread_local constinit EmulatedFormat emulatedFormat{kFp32};
thread_local constinit EmulatedItems emulatedItems{};

}  // namespace etalon
