// How a library that is compiled once per instruction set level (cmake/EtalonLevels.cmake) reaches the
// objects of the active level. Such objects export one function each,
// etalon::level_<name>::<something>Passes(), which returns a table of functions; everything else in them,
// inline functions of the standard library included, is local to them.
#pragma once

#include "numeric/check.h"
#include "numeric/isa.h"

#if defined(ETALON_HAS_scalar)
#define ETALON_IF_scalar(X, ...) X(scalar __VA_OPT__(, ) __VA_ARGS__)
#else
#define ETALON_IF_scalar(X, ...)
#endif
#if defined(ETALON_HAS_v2)
#define ETALON_IF_v2(X, ...) X(v2 __VA_OPT__(, ) __VA_ARGS__)
#else
#define ETALON_IF_v2(X, ...)
#endif
#if defined(ETALON_HAS_v3)
#define ETALON_IF_v3(X, ...) X(v3 __VA_OPT__(, ) __VA_ARGS__)
#else
#define ETALON_IF_v3(X, ...)
#endif
#if defined(ETALON_HAS_v4)
#define ETALON_IF_v4(X, ...) X(v4 __VA_OPT__(, ) __VA_ARGS__)
#else
#define ETALON_IF_v4(X, ...)
#endif
#if defined(ETALON_HAS_neon)
#define ETALON_IF_neon(X, ...) X(neon __VA_OPT__(, ) __VA_ARGS__)
#else
#define ETALON_IF_neon(X, ...)
#endif

// Expands X(name, ...) for each level that is built, from narrow to wide.
#define ETALON_FOR_EACH_LEVEL(X, ...)                                                            \
    ETALON_IF_scalar(X, __VA_ARGS__) ETALON_IF_neon(X, __VA_ARGS__) ETALON_IF_v2(X, __VA_ARGS__) \
        ETALON_IF_v3(X, __VA_ARGS__) ETALON_IF_v4(X, __VA_ARGS__)

// Defines `const Table& function()`, the table of the active level. Stands in namespace etalon.
#define ETALON_PASSES_OF_ACTIVE_LEVEL(Table, function)                      \
    ETALON_FOR_EACH_LEVEL(ETALON_DECLARE_LEVEL, Table, function)            \
    const Table& function() {                                               \
        switch (activeIsa()) {                                              \
            ETALON_FOR_EACH_LEVEL(ETALON_LEVEL_CASE, function)              \
            default:                                                        \
                break;                                                      \
        }                                                                   \
        ETALON_CHECK(false, "level {} is not built", isaName(activeIsa())); \
        __builtin_unreachable();                                            \
    }
#define ETALON_DECLARE_LEVEL(name, Table, function) \
    namespace level_##name {                        \
        const Table& function();                    \
    }
#define ETALON_LEVEL_CASE(name, function) \
    case IsaLevel::name:                  \
        return level_##name::function();
