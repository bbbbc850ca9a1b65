#include "shadows/shadow_maps.h"

#include "numeric/check.h"
#include "numeric/door.h"

namespace etalon {

void ShadowMaps::set(size_t light, ShadowMap map, const Profile& profile, int threads) {
    ETALON_CHECK(light < entries_.size(), "light {} of {}", light, entries_.size());
    Entry& entry = entries_[light];
    entry.lookup.reset();
    entry.map.reset();
    if (map.layers.empty()) return;
    entry.map = std::make_unique<ShadowMap>(std::move(map));
    entry.lookup = passesIn<LookupPasses>(profile.fragment)
                       ->makeLookup(*entry.map, samplerOf(profile), threads, WindowSearch::sideBySide);
    // The look-up has its own copy.
    for (ShadowLayer& layer : entry.map->layers) layer = {};
}

uint64_t ShadowMaps::memory_bytes() const {
    uint64_t bytes = 0;
    for (const Entry& entry : entries_) bytes += entry.lookup ? entry.lookup->memory_bytes() : 0;
    return bytes;
}

}  // namespace etalon
