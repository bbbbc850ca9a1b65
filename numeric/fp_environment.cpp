#include "numeric/fp_environment.h"

#include <cfenv>
#include <cstdint>

#include "numeric/check.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace etalon {
namespace {

#if defined(__x86_64__)
constexpr unsigned kRoundingAndFlushBits = 0xE040;  // MXCSR: FTZ (15), rounding (14:13), DAZ (6)
constexpr unsigned kFlushBits = 0x8040;
uint64_t readControlWord() { return _mm_getcsr(); }
void writeControlWord(uint64_t word) { _mm_setcsr(static_cast<unsigned>(word)); }
#elif defined(__aarch64__)
constexpr uint64_t kRoundingAndFlushBits = 0x3C80000;  // FPCR: DN (25), FZ (24), RMode (23:22), FZ16 (19)
constexpr uint64_t kFlushBits = 0x1000000;
uint64_t readControlWord() {
    uint64_t word;
    __asm__ volatile("mrs %0, fpcr" : "=r"(word));
    return word;
}
void writeControlWord(uint64_t word) { __asm__ volatile("msr fpcr, %0" : : "r"(word)); }
#else
#error "name the floating-point control word of this architecture here"
#endif

}  // namespace

bool fpEnvironmentIsDefault() {
    return (readControlWord() & kRoundingAndFlushBits) == 0 && std::fegetround() == FE_TONEAREST;
}

void requireDefaultFpEnvironment() {
    ETALON_CHECK(fpEnvironmentIsDefault(), "floating-point control word is {:#x}", readControlWord());
}

FlushToZeroScope::FlushToZeroScope() : saved_(readControlWord()) { writeControlWord(saved_ | kFlushBits); }
FlushToZeroScope::~FlushToZeroScope() { writeControlWord(saved_); }

}  // namespace etalon
