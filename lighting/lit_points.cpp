#include "lighting/lit_points.h"

namespace etalon {

LitPoints litPointsOf(const ShadeJob& job, const std::function<bool(const LitPoints&, size_t)>& keep) {
    LitPoints all;
    for (const LitPoints& tile : fragmentPoints(job))
        for (size_t i = 0; i < tile.size(); i++) {
            if (keep && !keep(tile, i)) continue;
            for (size_t k = 0; k < 3; k++) {
                all.position_m[k].push_back(tile.position_m[k][i]);
                all.normal[k].push_back(tile.normal[k][i]);
                all.faceNormal[k].push_back(tile.faceNormal[k][i]);
            }
            all.instance.push_back(tile.instance[i]);
            all.x_px.push_back(tile.x_px[i]), all.y_px.push_back(tile.y_px[i]);
        }
    return all;
}

}  // namespace etalon
