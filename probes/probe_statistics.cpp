#include "probes/probe_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/elementary.h"
#include "numeric/progress.h"
#include "numeric/sum.h"
#include "probes/convert.h"
#include "probes/texel_grid.h"

namespace etalon {

ProbeStatistics statisticsOf(const Probe& probe, int threads) {
    checkProbe(probe);
    const TexelGrid grid(probe.shape);
    ProbeStatistics s;
    s.smallest = std::numeric_limits<double>::infinity();
    s.largest = -s.smallest;
    double smallestPositive = std::numeric_limits<double>::infinity();
    std::vector<double> weights, weighted[3];
    ProgressLoop rows(static_cast<size_t>(probe.shape.layers()) * static_cast<size_t>(probe.shape.height));
    for (int layer = 0; layer < probe.shape.layers(); layer++) {
        const auto l = static_cast<size_t>(layer);
        for (int y = 0; y < probe.shape.height; y++, rows.next()) {
            for (int x = 0; x < probe.shape.width; x++) {
                const double weight_sr = grid.solidAngle_sr(layer, x, y);
                if (weight_sr == 0 || (!probe.valid.empty() && probe.valid[l].at(x, y) == 0)) continue;
                weights.push_back(weight_sr);
                for (int c = 0; c < 3; c++) {
                    const double value = double{probe.radiance[l].at(x, y, c)};
                    weighted[c].push_back(value * weight_sr);
                    s.notANumber += std::isnan(value) ? 1 : 0;
                    s.infinite += std::isinf(value) ? 1 : 0;
                    s.negative += value < 0 ? 1 : 0;
                    if (!std::isfinite(value)) continue;
                    s.smallest = std::min(s.smallest, value);
                    s.largest = std::max(s.largest, value);
                    if (value > 0) smallestPositive = std::min(smallestPositive, value);
                }
            }
        }
    }
    if (s.smallest > s.largest) s.smallest = s.largest = 0;
    if (s.largest > 0) s.dynamicRange_stops = log2InDouble(s.largest) - log2InDouble(smallestPositive);
    if (weights.empty()) return s;
    s.solidAngle_sr = fixedSum(weights, threads);
    for (int c = 0; c < 3; c++) s.mean[c] = fixedSum(weighted[c], threads) / s.solidAngle_sr;
    return s;
}

}  // namespace etalon
