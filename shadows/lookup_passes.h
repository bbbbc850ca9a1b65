// Look-ups in shadow maps.
#pragma once

#include <memory>
#include <span>

#include "lighting/light_visibility.h"
#include "shadows/shadow_map.h"

namespace etalon {

// A map whose texels are numbers of the arithmetic (each rounded once), ready for look-ups. The functions may
// be called from several threads at once.
class ShadowLookup {
  public:
    virtual ~ShadowLookup() = default;
    // visibility[i]: the part of the light that reaches point i by the map's filter; 1 outside the map,
    // behind the light, for positions that are not numbers, and for points of no instance.
    virtual void find(const LitPoints& points, std::span<double> visibility) const = 0;
    virtual uint64_t memory_bytes() const = 0;
};

// How pcf finds the lit texels of its windows with native numbers: side by side, in a faster arrangement
// (shadows/window_lookup.h), or as the kernel text says, one point per lane. The same visibility to the bit.
// All other numbers, all other filters and quantised references run the text.
enum class WindowSearch : uint8_t { sideBySide, text };

struct LookupPasses {
    // sampler: its fraction bits, and its rules of positions and weights, are those of pcf (raster/sampler.h).
    std::unique_ptr<ShadowLookup> (*makeLookup)(const ShadowMap& map, const SamplerSettings& sampler,
                                                int threads, WindowSearch search);
};

}  // namespace etalon
