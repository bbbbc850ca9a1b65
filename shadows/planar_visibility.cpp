#include "shadows/planar_visibility.h"

#include <algorithm>
#include <numeric>

#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/parallel.h"
#include "shadows/composition_kernel.h"

namespace etalon {
PlanarVisibility::PlanarVisibility(std::vector<Entry> entries, const Profile& profile)
    : entries_(std::move(entries)), profile_(&profile) {}

bool PlanarVisibility::casts(size_t light) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.light == light && !entry.shadow.shadow.empty();
    });
}

void PlanarVisibility::find(size_t light, const LitPoints& points, std::span<double> visibility) const {
    std::fill(visibility.begin(), visibility.end(), 1.0);
    const auto passes = passesIn<PlanarPasses>(profile_->fragment);
    std::vector<uint32_t> listed;
    for (const Entry& entry : entries_) {
        if (entry.light != light || entry.shadow.shadow.empty()) continue;
        listed.clear();
        for (uint32_t i = 0; i < points.size(); i++)
            if (points.instance[i] == entry.instance) listed.push_back(i);
        passes->visibility(entry.shadow, samplerOf(*profile_), points, listed, visibility);
    }
}

Image<float> composeShadows(const PlanarReceiver& receiver, const PlanarGrid& grid,
                            std::span<const WeightedShadow> lights, const Profile& profile,
                            const RasterOptions& raster) {
    Image<float> result(grid.width, grid.height);
    if (result.empty()) return result;
    std::vector<double> shares;
    for (const WeightedShadow& light : lights) {
        ETALON_CHECK(light.irradiance >= 0 && light.irradiance < 0x1p100, "irradiance {}", light.irradiance);
        shares.push_back(light.irradiance);
    }
    const auto passes = passesIn<PlanarPasses>(profile.fragment);
    const Image<uint8_t> mask = receiverMask(receiver, grid, profile, raster);
    parallelFor(static_cast<size_t>(grid.height), raster.threads, [&](size_t row) {
        const int y = static_cast<int>(row);
        const auto width = static_cast<size_t>(grid.width);
        LitPoints points;
        points.instance.assign(width, 0);
        for (auto& component : points.position_m) component.resize(width);
        for (size_t x = 0; x < width; x++) {
            const glm::dvec3 p = grid.toWorld(static_cast<double>(x) + 0.5, y + 0.5);
            for (int c = 0; c < 3; c++) points.position_m[static_cast<size_t>(c)][x] = p[c];
        }
        std::vector<uint32_t> listed(width);
        std::iota(listed.begin(), listed.end(), 0u);
        CompositionKernel<double> kernel{shares, std::vector<double>(lights.size() * width, 1.0), width};
        for (size_t i = 0; i < lights.size(); i++)
            if (!lights[i].shadow->shadow.empty())
                passes->visibility(*lights[i].shadow, samplerOf(profile), points, listed,
                                   std::span(kernel.visibility).subspan(i * width, width));
        for (size_t x = 0; x < width; x++) {
            kernel.texel = x;
            const bool isOutside = mask.at(static_cast<int>(x), y) == 0;
            result.at(static_cast<int>(x), y) =
                isOutside ? 1.0f : static_cast<float>(kernel.remainingLight(static_cast<int>(lights.size())));
        }
    });
    return result;
}

}  // namespace etalon
