#include "shadows/shadow_pattern.h"

#include <algorithm>
#include <limits>

#include "numeric/elementary.h"
#include "numeric/random.h"

namespace etalon {

std::vector<glm::dvec2> discPattern(int count, uint64_t seed) {
    constexpr int kCandidates = 16;
    Random random(seed);
    const auto inDisc = [&] {
        for (;;) {
            const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
            if (x * x + y * y <= 1) return glm::dvec2(x, y);
        }
    };
    std::vector<glm::dvec2> points;
    while (points.size() < static_cast<size_t>(count)) {
        glm::dvec2 best(0);
        double farthest = -1;
        for (int c = 0; c < kCandidates; c++) {
            const glm::dvec2 candidate = inDisc();
            double nearest = std::numeric_limits<double>::infinity();
            for (const glm::dvec2& p : points) {
                const double dx = p.x - candidate.x, dy = p.y - candidate.y;
                nearest = std::min(nearest, dx * dx + dy * dy);
            }
            if (nearest > farthest) farthest = nearest, best = candidate;
        }
        points.push_back(best);
    }
    return points;
}

PatternTurns::PatternTurns(uint64_t seed) : key_(Random(seed).next()) {
    constexpr double kTwoPi = 0x1.921fb54442d18p+2;
    for (size_t i = 0; i < turns_.size(); i++) {
        const double angle_rad = kTwoPi * static_cast<double>(i) / kPatternTurns;
        turns_[i] = {cosOf(angle_rad), sinOf(angle_rad)};
    }
}

}  // namespace etalon
