#include "probes/dominant_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/vectors.h"
#include "probes/texel_grid.h"

namespace etalon {
namespace {

double counted(float value) {
    return value > 0.0f && value <= std::numeric_limits<float>::max() ? static_cast<double>(value) : 0.0;
}

// A texel of the coarse image: sums over its block of the probe's texels.
struct CoarseTexel {
    glm::dvec3 energy{0};
    double solidAngle_sr = 0, brightness = 0;
    glm::dvec3 direction{0};  // of its middle, in the world
    int group = -1;           // dark
};

struct CoarseImage {
    int width = 0, height = 0;
    bool wraps = false;
    std::vector<CoarseTexel> texels;

    CoarseTexel& at(int x, int y) { return texels[index(x, y)]; }
    size_t index(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    }
};

// Where block i of n begins among `size` texels.
int blockStart(int i, int n, int size) { return static_cast<int>(static_cast<int64_t>(i) * size / n); }

CoarseImage coarseImage(const Probe& probe, int width) {
    const ProbeShape& shape = probe.shape;
    CoarseImage coarse;
    coarse.width = std::min(width, shape.width);
    coarse.height =
        std::clamp(static_cast<int>((2 * static_cast<int64_t>(coarse.width) * shape.height + shape.width) /
                                    (2 * static_cast<int64_t>(shape.width))),
                   1, shape.height);
    coarse.wraps = shape.mapping == Mapping::latLong;
    coarse.texels.resize(static_cast<size_t>(coarse.width) * static_cast<size_t>(coarse.height));
    ProbeShape coarseShape = shape;
    coarseShape.width = coarse.width, coarseShape.height = coarse.height;
    const TexelGrid grid(shape), coarseGrid(coarseShape);
    const Image<float>& radiance = probe.radiance[0];
    for (int j = 0; j < coarse.height; j++)
        for (int i = 0; i < coarse.width; i++) {
            CoarseTexel& texel = coarse.at(i, j);
            texel.direction = probe.rotation * coarseGrid.direction(0, i, j);
            for (int y = blockStart(j, coarse.height, shape.height);
                 y < blockStart(j + 1, coarse.height, shape.height); y++)
                for (int x = blockStart(i, coarse.width, shape.width);
                     x < blockStart(i + 1, coarse.width, shape.width); x++) {
                    if (!probe.valid.empty() && probe.valid[0].at(x, y) == 0) continue;
                    const double w = grid.solidAngle_sr(0, x, y);
                    texel.solidAngle_sr += w;
                    for (int c = 0; c < 3; c++) texel.energy[c] += w * counted(radiance.at(x, y, c));
                }
            if (texel.solidAngle_sr > 0.0)
                texel.brightness = (texel.energy.x + (texel.energy.y + texel.energy.z)) / texel.solidAngle_sr;
        }
    return coarse;
}

// Gives the texel and all that are connected to it a group; bright texels of no group yet have group 0.
void fillGroup(CoarseImage& image, size_t start, int group) {
    std::vector<size_t> open = {start};
    image.texels[start].group = group;
    while (!open.empty()) {
        const int x = static_cast<int>(open.back() % static_cast<size_t>(image.width)),
                  y = static_cast<int>(open.back() / static_cast<size_t>(image.width));
        open.pop_back();
        for (int dy = -1; dy <= 1; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                int i = x + dx, j = y + dy;
                if (image.wraps) {
                    // Beyond a pole lies the pole's own row, half a turn further.
                    if (j < 0 || j >= image.height) i += image.width / 2, j = y;
                    i = (i + 2 * image.width) % image.width;
                }
                if (i < 0 || i >= image.width || j < 0 || j >= image.height) continue;
                CoarseTexel& next = image.at(i, j);
                if (next.group != 0) continue;
                next.group = group;
                open.push_back(image.index(i, j));
            }
    }
}

std::optional<glm::dvec3> positionOf(const Probe& probe, const CoarseImage& image, size_t texel) {
    if (probe.distance_m.empty()) return std::nullopt;
    const Image<float>& distance = probe.distance_m[0];
    const auto middle = [](int i, int n, int size) {
        return (blockStart(i, n, size) + blockStart(i + 1, n, size)) / 2;
    };
    const int x = static_cast<int>(texel % static_cast<size_t>(image.width)),
              y = static_cast<int>(texel / static_cast<size_t>(image.width));
    const double metres =
        distance.at(middle(x, image.width, distance.width()), middle(y, image.height, distance.height()));
    if (!(metres > 0.0 && metres <= std::numeric_limits<double>::max())) return std::nullopt;
    return probe.position_m + metres * image.texels[texel].direction;
}

// The light of a group, whose texels are in their order.
DominantLight lightOf(const Probe& probe, const CoarseImage& image, const std::vector<size_t>& texels) {
    DominantLight result;
    result.texels = static_cast<int>(texels.size());
    ProbeLight& light = result.light;
    light.region = {image.width, image.height, 0, 0};
    size_t brightest = texels[0];
    glm::dvec3 sum{0};
    for (const size_t i : texels) {
        const CoarseTexel& texel = image.texels[i];
        const int x = static_cast<int>(i % static_cast<size_t>(image.width)),
                  y = static_cast<int>(i / static_cast<size_t>(image.width));
        TexelRegion& r = light.region;
        r = {std::min(r.x0, x), std::min(r.y0, y), std::max(r.x1, x + 1), std::max(r.y1, y + 1)};
        light.energy += texel.energy;
        light.solidAngle_sr += texel.solidAngle_sr;
        sum += texel.brightness * texel.solidAngle_sr * texel.direction;
        if (texel.brightness > image.texels[brightest].brightness) brightest = i;
    }
    const double length = std::sqrt(sum.x * sum.x + (sum.y * sum.y + sum.z * sum.z));
    const bool cancels = !(length > 1e-9 * (light.energy.x + (light.energy.y + light.energy.z)));
    light.direction = cancels ? image.texels[brightest].direction : sum / length;
    light.position_m = positionOf(probe, image, brightest);
    result.peakBrightness = image.texels[brightest].brightness;
    // A cone of half angle a has 2 pi (1 - cos a) = 4 pi sin^2(a / 2).
    const double sine = std::sqrt(std::min(1.0, light.solidAngle_sr / (4.0 * kPi)));
    result.angularRadius_rad = 2.0 * atan2Of(sine, std::sqrt((1.0 - sine) * (1.0 + sine)));
    return result;
}

}  // namespace

std::vector<DominantLight> dominantLights(const Probe& probe, const DominantLightSearch& search) {
    ETALON_CHECK(probe.shape.mapping != Mapping::cube, "dominant lights of a cube map");
    ETALON_CHECK(search.width >= 1 && search.threshold > 0.0 && search.threshold <= 1.0 &&
                     search.minBrightness >= 0.0 && search.maxLights >= 1,
                 "width {}, threshold {}, brightness {}, {} lights", search.width, search.threshold,
                 search.minBrightness, search.maxLights);
    CoarseImage image = coarseImage(probe, search.width);
    const auto isSearched = [&](const CoarseTexel& t) {
        return t.brightness > 0.0 && (!search.upperHalf || t.direction.y > 0.0);
    };
    double peak = 0.0;
    for (const CoarseTexel& t : image.texels)
        if (isSearched(t)) peak = std::max(peak, t.brightness);
    const double least = std::max(search.threshold * peak, search.minBrightness);
    for (CoarseTexel& t : image.texels)
        if (isSearched(t) && t.brightness >= least) t.group = 0;

    int groups = 0;
    for (size_t i = 0; i < image.texels.size(); i++)
        if (image.texels[i].group == 0) fillGroup(image, i, ++groups);
    std::vector<std::vector<size_t>> texelsOf(static_cast<size_t>(groups));
    for (size_t i = 0; i < image.texels.size(); i++)
        if (image.texels[i].group > 0) texelsOf[static_cast<size_t>(image.texels[i].group - 1)].push_back(i);

    std::vector<DominantLight> lights;
    for (const std::vector<size_t>& texels : texelsOf) lights.push_back(lightOf(probe, image, texels));
    std::stable_sort(lights.begin(), lights.end(), [](const DominantLight& a, const DominantLight& b) {
        return energyOf(a.light.energy) > energyOf(b.light.energy);
    });
    if (lights.size() > static_cast<size_t>(search.maxLights))
        lights.resize(static_cast<size_t>(search.maxLights));
    return lights;
}

}  // namespace etalon
