// The door between callers and what is compiled once per instruction set level (cmake/EtalonLevels.cmake).
//
// A family of passes is a kernel text, a header and one source. The header declares a table of functions,
//     struct BlurPasses { Image<float> (*blur)(const Image<float>& image, ...); };
// and the source, which CMake compiles once per level and for truth, fills it for every number type T and opens
// the door:
//     template <class T>
//     constexpr BlurPasses kPassesOver<BlurPasses, T> = {blurGaussian<T>};
//     template const BlurPasses& ETALON_LEVEL::passesOf<BlurPasses>(NumberType);
// Callers go through it with the arithmetic that they compute in:
//     passesIn<BlurPasses>(arithmetic)->blur(image, ...);
// A family that has no number types, but levels, is kPassesOver<TilePasses, void>, passesOf<TilePasses>() and
// levelPasses<TilePasses>().
//
// Nothing else of the objects of a level is visible outside them: everything but the entries is local to them.
#pragma once

#include "numeric/arithmetic.h"
#include "numeric/isa.h"

#if defined(ETALON_TRUTH)
#include "numeric/truth_elementary.h"
#elif defined(ETALON_LEVEL)
#include "numeric/narrow.h"
#else
#include "numeric/emulated_format.h"
#endif

namespace etalon {

// The table of a family over a number type; void: the family has none. Defined by the family's source.
template <class Table, class T>
extern const Table kPassesOver;

#define ETALON_DECLARE_LEVEL(level)         \
    namespace level {                       \
    template <class Table>                  \
    const Table& passesOf(NumberType type); \
    template <class Table>                  \
    const Table& passesOf();                \
    }
ETALON_DECLARE_LEVEL(level_truth)
ETALON_DECLARE_LEVEL(level_scalar)
ETALON_DECLARE_LEVEL(level_v2)
ETALON_DECLARE_LEVEL(level_v3)
ETALON_DECLARE_LEVEL(level_v4)
ETALON_DECLARE_LEVEL(level_neon)
#undef ETALON_DECLARE_LEVEL

#if defined(ETALON_LEVEL)
namespace ETALON_LEVEL {

template <class Table>
const Table& passesOf(NumberType type) {
#if defined(ETALON_TRUTH)
    static_cast<void>(type);
    return kPassesOver<Table, Truth>;
#else
    switch (type) {
        case NumberType::fp64:
            return kPassesOver<Table, Native<double> >;
        case NumberType::narrow:
            return kPassesOver<Table, Narrow<Native<float> > >;
        case NumberType::emulated:
            return kPassesOver<Table, Emulated<Native<double> > >;
        default:
            return kPassesOver<Table, Native<float> >;
    }
#endif
}
template <class Table>
const Table& passesOf() {
    return kPassesOver<Table, void>;
}

}  // namespace ETALON_LEVEL
#else

// The entry of the active level, with the arguments that it takes.
template <class Table, class... Types>
const Table& passesOfActiveLevel(Types... type) {
    switch (activeIsa()) {
#if defined(ETALON_HAS_scalar)
        case IsaLevel::scalar:
            return level_scalar::passesOf<Table>(type...);
#endif
#if defined(ETALON_HAS_v2)
        case IsaLevel::v2:
            return level_v2::passesOf<Table>(type...);
#endif
#if defined(ETALON_HAS_v3)
        case IsaLevel::v3:
            return level_v3::passesOf<Table>(type...);
#endif
#if defined(ETALON_HAS_v4)
        case IsaLevel::v4:
            return level_v4::passesOf<Table>(type...);
#endif
#if defined(ETALON_HAS_neon)
        case IsaLevel::neon:
            return level_neon::passesOf<Table>(type...);
#endif
        default:
            __builtin_unreachable();  // activeIsa() is a level that is built
    }
}

// The passes of a family in an arithmetic, for the calling thread and those that parallelFor starts, as long as
// the object lives: a temporary for one call, or a variable for a block.
template <class Table>
class PassesIn {
  public:
    explicit PassesIn(const Arithmetic& arithmetic)
        : format_(arithmetic.format.value_or(kFp32)),
          table_(arithmetic.type() == NumberType::truth ? level_truth::passesOf<Table>(arithmetic.type())
                                                        : passesOfActiveLevel<Table>(arithmetic.type())) {}
    const Table* operator->() const { return &table_; }

  private:
    EmulatedScope format_;
    EmulatedItemsScope items_;
    const Table& table_;
};
template <class Table>
PassesIn<Table> passesIn(const Arithmetic& arithmetic) {
    return PassesIn<Table>(arithmetic);
}
// Those of a family that has no number types.
template <class Table>
const Table& levelPasses() {
    return passesOfActiveLevel<Table>();
}

#endif

}  // namespace etalon
