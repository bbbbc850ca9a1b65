#include "lighting/shade.h"

#include <algorithm>
#include <mutex>

#include "lighting/shading_passes.h"
#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/parallel.h"
#include "probes/mapping_passes.h"

namespace etalon {
namespace {

void checkJob(const ShadeJob& job) {
    ETALON_CHECK(job.scene && job.view && job.target && job.placed && job.profile && job.environment &&
                     job.sources.lights && job.sources.environment,
                 "a part of the job is missing");
    ETALON_CHECK(!job.sources.shows || job.sources.shows->size() == job.sources.lights->size(),
                 "{} of {} lights", job.sources.shows->size(), job.sources.lights->size());
    ETALON_CHECK(job.instanceOfDraw.size() == job.target->drawCount &&
                     job.sceneCubes.size() == job.scene->instances.size(),
                 "{} draws of {}, {} cubes of {} instances", job.instanceOfDraw.size(), job.target->drawCount,
                 job.sceneCubes.size(), job.scene->instances.size());
    ETALON_CHECK(job.tileSize >= 1, "tileSize = {}", job.tileSize);
}

struct Tiles {
    size_t columns, rows;
    size_t count() const { return columns * rows; }
};
Tiles tilesOf(const ShadeJob& job) {
    const auto along = [&](int pixels) {
        return static_cast<size_t>((pixels + job.tileSize - 1) / job.tileSize);
    };
    return {along(job.target->width()), along(job.target->height())};
}

// Calls visit(shader, number, rectangle) for every tile, with one shader per thread at work.
template <class Visit>
void forEachTile(const ShadeJob& job, const Visit& visit) {
    const auto passes = passesIn<ShadingPasses>(job.profile->fragment);
    const Tiles tiles = tilesOf(job);
    std::mutex mutex;
    std::vector<std::unique_ptr<TileShader>> idle;
    parallelFor(tiles.count(), job.threads, [&](size_t t) {
        std::unique_ptr<TileShader> shader;
        {
            const std::lock_guard lock(mutex);
            if (!idle.empty()) {
                shader = std::move(idle.back());
                idle.pop_back();
            }
        }
        if (!shader) shader = passes->makeTileShader(job);
        const int x0 = static_cast<int>(t % tiles.columns) * job.tileSize,
                  y0 = static_cast<int>(t / tiles.columns) * job.tileSize;
        visit(*shader, t,
              PixelRectangle{x0, y0, std::min(x0 + job.tileSize, job.target->width()),
                             std::min(y0 + job.tileSize, job.target->height())});
        const std::lock_guard lock(mutex);
        idle.push_back(std::move(shader));
    });
}

}  // namespace

int channelsOf(const ShadeJob& job, ShadeOutput output) {
    if (output == ShadeOutput::shadows) return static_cast<int>(job.shadowLights.size());
    const bool isNumber =
        output == ShadeOutput::distance || output == ShadeOutput::depth || output == ShadeOutput::open;
    return isNumber ? 1 : 3;
}

ShadedImages shade(const ShadeJob& job, ShadeStatistics* statistics) {
    checkJob(job);
    ETALON_CHECK(!job.occlusion || job.occlusion->size() == tilesOf(job).count(),
                 "occlusion of {} tiles of {}", job.occlusion->size(), tilesOf(job).count());
    const int width = job.target->width(), height = job.target->height();
    ShadedImages images;
    for (size_t o = 0; o < kShadeOutputs; o++) {
        const int channels = channelsOf(job, static_cast<ShadeOutput>(o));
        if (job.request.wanted[o] && channels > 0) images.images[o] = Image<float>(width, height, channels);
    }

    std::mutex mutex;
    ShadeStatistics total;
    forEachTile(job, [&](TileShader& shader, size_t number, const PixelRectangle& rectangle) {
        ShadeStatistics counts;
        shader.run(number, rectangle, images, counts);
        const std::lock_guard lock(mutex);
        total.surfaceFragments += counts.surfaceFragments;
        total.backgroundFragments += counts.backgroundFragments;
    });
    if (statistics) *statistics = total;
    return images;
}

std::vector<LitPoints> fragmentPoints(const ShadeJob& job) {
    checkJob(job);
    std::vector<LitPoints> points(tilesOf(job).count());
    forEachTile(job, [&](TileShader& shader, size_t number, const PixelRectangle& rectangle) {
        points[number] = shader.points(rectangle);
    });
    return points;
}

std::vector<bool> visibleInstances(const ShadeJob& job) {
    std::vector<bool> visible(job.scene->instances.size(), false);
    for (const uint32_t id : job.target->id.values())
        if (id != kNoTriangle) visible[job.instanceOfDraw[job.target->triangles[id].draw]] = true;
    return visible;
}

std::vector<VertexRadiance> lightVerticesOf(const ShadeJob& job,
                                            const std::vector<VertexOcclusion>& occlusion) {
    constexpr size_t kVerticesPerTask = 4096;
    std::vector<VertexRadiance> radiance(job.scene->instances.size());
    const std::vector<bool> visible = visibleInstances(job);
    for (size_t i = 0; i < radiance.size(); i++) {
        if (!visible[i]) continue;
        const PlacedMesh& placed = (*job.placed)[i];
        const size_t count = placed.positions.size();
        for (auto& side : radiance[i].sides) {
            side.diffuse.resize(count), side.specular.resize(count);
            if (!occlusion.empty()) side.open.resize(count);
        }
        const SurfaceMaterial& material = job.scene->materials[job.scene->instances[i].material];
        parallelFor((count + kVerticesPerTask - 1) / kVerticesPerTask, job.threads, [&](size_t task) {
            const size_t begin = task * kVerticesPerTask;
            levelPasses<VertexLightingPasses>().light(
                *job.profile, job.sources, material, placed, job.view->eye, begin,
                std::min(kVerticesPerTask, count - begin), occlusion.empty() ? nullptr : &occlusion[i],
                radiance[i]);
        });
    }
    return radiance;
}

CubeMap<float> environmentCube(const SurfaceEnvironment& environment, const Profile& profile, int threads) {
    CubeFromLatLong options;
    options.filter = profile.textureFilter;
    options.fractionBits = profile.textureFractionBits;
    options.rule = profile.filterRule;
    const int size = std::max(1, environment.latLong.width() / 4);
    return passesIn<MappingPasses>(profile.fragment)
        ->cubeFromLatLong(environment.latLong, size, options, threads);
}

}  // namespace etalon
