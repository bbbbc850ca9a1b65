// Look-ups in shadow maps over a number type, for the sources that instantiate them.
#pragma once

#include "shadows/lookup_of.h"
#include "shadows/lookup_passes.h"

namespace etalon {

template <class T>
LookupPasses lookupPassesOver() {
    return {[](const ShadowMap& map, int fractionBits, int threads,
               WindowSearch search) -> std::unique_ptr<ShadowLookup> {
        return std::make_unique<ShadowLookupOf<T>>(map, fractionBits, threads, search);
    }};
}

}  // namespace etalon
