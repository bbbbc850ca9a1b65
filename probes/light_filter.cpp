#include "probes/light_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "numeric/check.h"
#include "numeric/elementary.h"

namespace etalon {
namespace {

constexpr size_t kNone = std::numeric_limits<size_t>::max();

double squareOf(const glm::dvec3& v) { return v.x * v.x + (v.y * v.y + v.z * v.z); }

// Which column each row takes so that the sum of cost(row, column) is smallest; rows <= columns, costs are
// finite. By shortest augmenting paths [Jonker1987]; row and column 0 of the working arrays stand
// for none.
template <class Cost>
std::vector<size_t> assignRows(size_t rows, size_t columns, Cost&& cost) {
    std::vector<double> rowPrice(rows + 1, 0.0), columnPrice(columns + 1, 0.0);
    std::vector<size_t> rowOf(columns + 1, 0), before(columns + 1, 0);
    for (size_t row = 1; row <= rows; row++) {
        rowOf[0] = row;
        size_t column = 0;
        std::vector<double> least(columns + 1, std::numeric_limits<double>::infinity());
        std::vector<bool> done(columns + 1, false);
        do {
            done[column] = true;
            const size_t from = rowOf[column];
            size_t next = 0;
            double step = std::numeric_limits<double>::infinity();
            for (size_t j = 1; j <= columns; j++) {
                if (done[j]) continue;
                const double reduced = (cost(from - 1, j - 1) - rowPrice[from]) - columnPrice[j];
                if (reduced < least[j]) least[j] = reduced, before[j] = column;
                if (least[j] < step) step = least[j], next = j;
            }
            for (size_t j = 0; j <= columns; j++)
                if (done[j])
                    rowPrice[rowOf[j]] += step, columnPrice[j] -= step;
                else
                    least[j] -= step;
            column = next;
        } while (rowOf[column] != 0);
        for (; column != 0; column = before[column]) rowOf[column] = rowOf[before[column]];
    }
    std::vector<size_t> columnOf(rows, kNone);
    for (size_t j = 1; j <= columns; j++)
        if (rowOf[j] != 0) columnOf[rowOf[j] - 1] = j - 1;
    return columnOf;
}

}  // namespace

std::vector<std::pair<size_t, size_t>> matchLights(std::span<const ProbeLight> a,
                                                   std::span<const ProbeLight> b, double maxMotion_rad) {
    ETALON_CHECK(maxMotion_rad > 0.0 && maxMotion_rad <= 3.1415927, "motion of {} rad", maxMotion_rad);
    if (a.size() > b.size()) {
        auto pairs = matchLights(b, a, maxMotion_rad);
        for (auto& pair : pairs) std::swap(pair.first, pair.second);
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }
    const double sine = 2.0 * sinOf(0.5 * maxMotion_rad), limit = sine * sine;
    // What the transport saves where the two are a pair.
    const auto saved = [&](size_t i, size_t j) {
        const double energy = std::min(energyOf(a[i].energy), energyOf(b[j].energy));
        return energy * std::max(0.0, limit - squareOf(a[i].direction - b[j].direction));
    };
    const std::vector<size_t> partner =
        assignRows(a.size(), b.size(), [&](size_t i, size_t j) { return -saved(i, j); });
    std::vector<std::pair<size_t, size_t>> pairs;
    for (size_t i = 0; i < a.size(); i++)
        if (saved(i, partner[i]) > 0.0) pairs.emplace_back(i, partner[i]);
    return pairs;
}

Flicker flickerBetween(std::span<const ProbeLight> a, std::span<const ProbeLight> b, double maxMotion_rad) {
    double total = 0.0, unchanged = 0.0, angle = 0.0;
    for (const ProbeLight& light : a) total += energyOf(light.energy);
    for (const ProbeLight& light : b) total += energyOf(light.energy);
    for (const auto& pair : matchLights(a, b, maxMotion_rad)) {
        const ProbeLight &from = a[pair.first], &to = b[pair.second];
        const double energy = std::min(energyOf(from.energy), energyOf(to.energy));
        // Exact for small angles, where an arc cosine is not.
        const double sine = 0.5 * std::sqrt(squareOf(from.direction - to.direction));
        angle += energy * 2.0 * atan2Of(sine, std::sqrt(std::max(0.0, (1.0 - sine) * (1.0 + sine))));
        unchanged += energy;
    }
    Flicker result;
    if (unchanged > 0.0) result.angle_rad = angle / unchanged;
    // |x - y| is x + y - 2 min(x, y).
    if (total > 0.0) result.intensity = std::max(0.0, 2.0 * (total - 2.0 * unchanged) / total);
    return result;
}

Flicker meanFlicker(std::span<const std::vector<ProbeLight>> frames, double maxMotion_rad) {
    Flicker mean;
    if (frames.size() < 2) return mean;
    for (size_t i = 1; i < frames.size(); i++) {
        const Flicker step = flickerBetween(frames[i - 1], frames[i], maxMotion_rad);
        mean.angle_rad += step.angle_rad, mean.intensity += step.intensity;
    }
    const double steps = static_cast<double>(frames.size() - 1);
    return {mean.angle_rad / steps, mean.intensity / steps};
}

LightFilter::LightFilter(double blend, double maxMotion_rad) : blend_(blend), maxMotion_rad_(maxMotion_rad) {
    ETALON_CHECK(blend > 0.0 && blend <= 1.0, "blend {}", blend);
}

const std::vector<TrackedLight>& LightFilter::add(std::span<const ProbeLight> frame) {
    // Tracks by id and the partners that they have in this frame.
    std::map<uint64_t, size_t> partnerOf;
    std::vector<uint64_t> ids(frame.size(), 0);
    std::vector<bool> isKnown(frame.size(), false);
    for (const auto& pair : matchLights(lastFrame_, frame, maxMotion_rad_)) {
        partnerOf[lastIds_[pair.first]] = pair.second;
        ids[pair.second] = lastIds_[pair.first];
        isKnown[pair.second] = true;
    }
    double total = 0.0;
    for (const ProbeLight& light : frame) total += energyOf(light.energy);

    for (TrackedLight& track : tracks_) {
        ProbeLight& light = track.light;
        light.energy *= 1.0 - blend_;
        const auto found = partnerOf.find(track.id);
        if (found == partnerOf.end()) continue;
        const ProbeLight& partner = frame[found->second];
        light.energy += blend_ * partner.energy;
        const glm::dvec3 sum = (1.0 - blend_) * light.direction + blend_ * partner.direction;
        const double square = squareOf(sum);
        light.direction = square > 1e-18 ? sum / std::sqrt(square) : partner.direction;
        light.position_m = light.position_m && partner.position_m
                               ? (1.0 - blend_) * *light.position_m + blend_ * *partner.position_m
                               : partner.position_m;
        light.region = partner.region;
        light.solidAngle_sr = partner.solidAngle_sr;
    }
    std::erase_if(tracks_, [&](const TrackedLight& track) {
        return !partnerOf.contains(track.id) && !(energyOf(track.light.energy) > kFadedLight * total);
    });
    for (size_t i = 0; i < frame.size(); i++) {
        if (isKnown[i]) continue;
        ids[i] = nextId_++;
        tracks_.push_back({ids[i], frame[i]});
        if (started_) tracks_.back().light.energy *= blend_;
    }
    started_ = true;
    lastFrame_.assign(frame.begin(), frame.end());
    lastIds_ = std::move(ids);
    return tracks_;
}

}  // namespace etalon
