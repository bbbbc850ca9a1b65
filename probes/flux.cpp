#include "probes/flux.h"

#include <algorithm>

#include "numeric/check.h"

namespace etalon {

TexelRow readRadiance(const Probe& probe, int layer, int y) {
    TexelRow row;
    row.width = probe.shape.width;
    row.padded = (row.width + kTexelGroup - 1) / kTexelGroup * kTexelGroup;
    const auto l = static_cast<size_t>(layer);
    for (int c = 0; c < 3; c++) {
        const std::span<const float> from = probe.radiance[l].row(y, c);
        std::vector<float>& to = row.radiance[static_cast<size_t>(c)];
        to.reserve(static_cast<size_t>(row.padded));
        to.assign(from.begin(), from.end());
        to.resize(static_cast<size_t>(row.padded));
        if (!probe.valid.empty())
            for (int x = 0; x < row.width; x++)
                if (probe.valid[l].at(x, y) == 0) to[static_cast<size_t>(x)] = 0;
    }
    return row;
}

void readWeights(const TexelGrid& grid, int layer, int y, TexelRow& row) {
    row.weight.resize(static_cast<size_t>(row.padded));
    for (int x = 0; x < row.width; x++) {
        const auto i = static_cast<size_t>(x);
        row.weight[i] = grid.solidAngle_sr(layer, x, y) * kFluxScale;
        if (!(row.weight[i] > 0))
            for (auto& channel : row.radiance) channel[i] = 0;
    }
}

void readDirections(const TexelGrid& grid, int layer, int y, TexelRow& row) {
    for (auto& component : row.direction) component.resize(static_cast<size_t>(row.padded));
    for (int x = 0; x < row.width; x++) {
        const glm::dvec3 d = grid.direction(layer, x, y);
        for (int c = 0; c < 3; c++) row.direction[static_cast<size_t>(c)][static_cast<size_t>(x)] = d[c];
    }
}

void turnDirections(const glm::dmat3& r, TexelRow& row) {
    if (r == glm::dmat3(1)) return;
    for (size_t i = 0; i < static_cast<size_t>(row.width); i++) {
        double &x = row.direction[0][i], &y = row.direction[1][i], &z = row.direction[2][i];
        const glm::dvec3 d(x, y, z);
        x = r[0].x * d.x + (r[1].x * d.y + r[2].x * d.z);
        y = r[0].y * d.x + (r[1].y * d.y + r[2].y * d.z);
        z = r[0].z * d.x + (r[1].z * d.y + r[2].z * d.z);
    }
}

}  // namespace etalon
