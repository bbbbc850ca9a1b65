#include "probes/convert.h"

#include <algorithm>
#include <optional>

#include "numeric/check.h"
#include "numeric/door.h"
#include "probes/mapping_passes.h"
#include "probes/texel_grid.h"

namespace etalon {
namespace {

// Images of the shape; those that fit are kept, with whatever they hold.
template <class Pixel>
void fitLayers(std::vector<Image<Pixel>>& layers, const ProbeShape& shape, int channels) {
    layers.resize(static_cast<size_t>(shape.layers()));
    for (Image<Pixel>& layer : layers)
        if (layer.width() != shape.width || layer.height() != shape.height || layer.channels() != channels)
            layer = Image<Pixel>(shape.width, shape.height, channels);
}

// 1 for texels with radiance, else 0; empty if all have it.
std::vector<Image<float>> shownTexels(const Probe& probe) {
    const bool disc = isDisc(probe.shape.mapping);
    if (!disc && probe.valid.empty()) return {};
    std::vector<Image<float>> shown;
    fitLayers(shown, probe.shape, 1);
    for (size_t layer = 0; layer < shown.size(); layer++)
        for (int y = 0; y < probe.shape.height; y++)
            for (int x = 0; x < probe.shape.width; x++) {
                const bool isValid = probe.valid.empty() || probe.valid[layer].at(x, y) != 0;
                shown[layer].at(x, y) = isValid && showsDirection(probe.shape, x, y) ? 1.0f : 0.0f;
            }
    return shown;
}

// The texels of a bilinear sample are at most one texel from it along each axis. Those whose centre is on the
// disc are shown; the rest is for the rounding of coarse arithmetics.
double wholeRadius(const ProbeShape& shape) { return std::max(0.0, 1.0 - 4.0 / shape.width); }

// True if all of a texel is on the disc.
bool isWholeTexel(const ProbeShape& disc, int x, int y) {
    const auto farthest = [&](int i) -> int64_t {
        return std::max(std::abs(2 * i - disc.width), std::abs(2 * i + 2 - disc.width));
    };
    const int64_t size = disc.width;
    return farthest(x) * farthest(x) + farthest(y) * farthest(y) <= size * size;
}

bool isIdentity(const glm::dmat3& m) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (m[i][j] != (i == j ? 1.0 : 0.0)) return false;
    return true;
}

// The inverse of `to` times `from`, both rotations.
glm::dmat3 turnBetween(const glm::dmat3& from, const glm::dmat3& to) {
    glm::dmat3 m;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++) {
            const glm::dvec3 a = to[row], b = from[column];
            m[column][row] = a.x * b.x + (a.y * b.y + a.z * b.z);
        }
    return m;
}

}  // namespace

Probe convertProbe(const Probe& source, const ProbeConversion& conversion, Arithmetic arithmetic,
                   int threads) {
    Probe result;
    convertProbe(result, source, conversion, arithmetic, threads);
    return result;
}

void convertProbe(Probe& result, const Probe& source, const ProbeConversion& conversion,
                  Arithmetic arithmetic, int threads) {
    ETALON_CHECK(&result != &source, "the result is the source");
    checkProbe(source);
    checkShape(conversion.shape);
    const std::vector<Image<float>> shown = shownTexels(source);
    ConversionJob job;
    job.source = source.shape;
    job.target = conversion.shape;
    job.radiance = source.radiance;
    job.shown = shown;
    job.distance_m = source.distance_m;
    if (source.valid.empty()) job.wholeRadius = wholeRadius(source.shape);
    // Equal rotations leave directions as they are, also where a rotation is not quite orthogonal.
    if (source.rotation != conversion.rotation) job.turn = turnBetween(conversion.rotation, source.rotation);
    job.isTurned = !isIdentity(job.turn);
    job.hasBlindSpots = !shown.empty() || isDisc(conversion.shape.mapping);
    job.resampling = conversion.resampling;
    std::optional<TexelOverlaps> overlaps;
    if (conversion.resampling == Resampling::area)
        job.overlaps = &overlaps.emplace(source.shape, conversion.shape, job.turn);
    job.fractionBits = conversion.fractionBits;
    job.rule = conversion.rule;
    job.threads = threads;

    result.shape = conversion.shape;
    result.rotation = conversion.rotation;
    result.position_m = source.position_m;
    fitLayers(result.radiance, conversion.shape, 3);
    if (source.distance_m.empty())
        result.distance_m.clear();
    else
        fitLayers(result.distance_m, conversion.shape, 1);
    if (job.hasBlindSpots)
        fitLayers(result.valid, conversion.shape, 1);
    else
        result.valid.clear();
    passesIn<MappingPasses>(arithmetic)->convertImages(job, result);

    const auto isWhole = [](const Image<uint8_t>& layer) {
        return std::all_of(layer.values().begin(), layer.values().end(), [](uint8_t v) { return v != 0; });
    };
    if (std::all_of(result.valid.begin(), result.valid.end(), isWhole)) result.valid.clear();
}

double minificationOf(const Probe& source, const ProbeConversion& conversion) {
    checkProbe(source);
    const ProbeShape &from = source.shape, &to = conversion.shape;
    const TexelGrid sourceGrid(from), grid(to);
    const MappingKernel<double>::MappingSettings settings = mappingSettingsOf<MappingKernel<double>>(from);
    const glm::dmat3 turn = turnBetween(conversion.rotation, source.rotation);
    MappingKernel<double> kernel;
    const auto texelOf = [](double u, int size) { return std::min(static_cast<int>(u * size), size - 1); };
    double largest = 0;
    for (int layer = 0; layer < to.layers(); layer++)
        for (int y = 0; y < to.height; y++)
            for (int x = 0; x < to.width; x++) {
                const glm::dvec3 d = grid.direction(layer, x, y);
                const auto p = kernel.mappingPoint({turn[0].x * d.x + (turn[1].x * d.y + turn[2].x * d.z),
                                                    turn[0].y * d.x + (turn[1].y * d.y + turn[2].y * d.z),
                                                    turn[0].z * d.x + (turn[1].z * d.y + turn[2].z * d.z)},
                                                   settings);
                const int column = texelOf(p.u, from.width), row = texelOf(p.v, from.height);
                // The rim cuts texels off, which makes them no finer.
                if (isDisc(from.mapping) && !isWholeTexel(from, column, row)) continue;
                largest = std::max(largest, grid.solidAngle_sr(layer, x, y) /
                                                sourceGrid.solidAngle_sr(p.layer, column, row));
            }
    return largest;
}

Probe probeOf(const CubeMap<float>& cube) {
    Probe probe;
    probe.shape = {Mapping::cube, cube.size(), cube.size()};
    probe.radiance.assign(cube.faces.begin(), cube.faces.end());
    return probe;
}

Probe probeOf(const Image<float>& image, Mapping mapping) {
    Probe probe;
    probe.shape = {mapping, image.width(), image.height()};
    probe.radiance = {image};
    return probe;
}

CubeMap<float> cubeMapOf(Probe probe) {
    checkProbe(probe);
    ETALON_CHECK(probe.shape.mapping == Mapping::cube, "mapping {}", static_cast<int>(probe.shape.mapping));
    CubeMap<float> cube;
    std::move(probe.radiance.begin(), probe.radiance.end(), cube.faces.begin());
    return cube;
}

Image<float> latLongFromCube(const CubeMap<float>& cube, int width, int height,
                             const LatLongFromCube& options, Arithmetic arithmetic, int threads) {
    ETALON_CHECK(cube.channels() == 3 && width >= 1 && height >= 1, "{} channels, {}x{}", cube.channels(),
                 width, height);
    Image<float> latLong(width, height, 3);
    passesIn<MappingPasses>(arithmetic)->latLongFromCube(cube, options, threads, latLong);
    return latLong;
}

}  // namespace etalon
