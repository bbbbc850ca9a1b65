// How a library that is compiled once per instruction set level (cmake/EtalonLevels.cmake) reaches the
// objects of the active level. Such objects export one function each,
// etalon::level_<name>::<something>Passes(), which returns a table of functions; everything else in them,
// inline functions of the standard library included, is local to them.
#pragma once

#include "numeric/isa.h"

#if defined(ETALON_HAS_scalar)
#define ETALON_IF_scalar(X) X(scalar)
#else
#define ETALON_IF_scalar(X)
#endif
#if defined(ETALON_HAS_v2)
#define ETALON_IF_v2(X) X(v2)
#else
#define ETALON_IF_v2(X)
#endif
#if defined(ETALON_HAS_v3)
#define ETALON_IF_v3(X) X(v3)
#else
#define ETALON_IF_v3(X)
#endif
#if defined(ETALON_HAS_v4)
#define ETALON_IF_v4(X) X(v4)
#else
#define ETALON_IF_v4(X)
#endif
#if defined(ETALON_HAS_neon)
#define ETALON_IF_neon(X) X(neon)
#else
#define ETALON_IF_neon(X)
#endif

// Expands X(name) for each level that is built, from narrow to wide.
#define ETALON_FOR_EACH_LEVEL(X) \
    ETALON_IF_scalar(X) ETALON_IF_neon(X) ETALON_IF_v2(X) ETALON_IF_v3(X) ETALON_IF_v4(X)
