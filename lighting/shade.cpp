#include "lighting/shade.h"

#include <algorithm>
#include <mutex>

#include "lighting/lighting_passes.h"
#include "numeric/check.h"
#include "numeric/parallel.h"
#include "probes/mapping_passes.h"

namespace etalon {
namespace {

int channelsOf(ShadeOutput output) { return output == ShadeOutput::distance ? 1 : 3; }

}  // namespace

ShadedImages shade(const ShadeJob& job, ShadeStatistics* statistics) {
    ETALON_CHECK(job.scene && job.view && job.target && job.placed && job.profile,
                 "a part of the job is missing");
    ETALON_CHECK(job.instanceOfDraw.size() == job.target->drawCount &&
                     job.sceneCubes.size() == job.scene->instances.size(),
                 "{} draws of {}, {} cubes of {} instances", job.instanceOfDraw.size(), job.target->drawCount,
                 job.sceneCubes.size(), job.scene->instances.size());
    ETALON_CHECK(job.tileSize >= 1, "tileSize = {}", job.tileSize);
    const int width = job.target->width(), height = job.target->height();
    ShadedImages images;
    for (size_t o = 0; o < kShadeOutputs; o++)
        if (job.request.wanted[o])
            images.images[o] = Image<float>(width, height, channelsOf(static_cast<ShadeOutput>(o)));

    // One shader per thread at work; the sums of the counts do not depend on who counted.
    const ShadingPasses passes = shadingPasses(job.profile->fragment);
    std::mutex mutex;
    std::vector<std::unique_ptr<TileShader>> idle;
    ShadeStatistics total;
    const int columns = (width + job.tileSize - 1) / job.tileSize,
              rows = (height + job.tileSize - 1) / job.tileSize;
    parallelFor(static_cast<size_t>(columns) * static_cast<size_t>(rows), job.threads, [&](size_t t) {
        std::unique_ptr<TileShader> shader;
        {
            const std::lock_guard lock(mutex);
            if (!idle.empty()) {
                shader = std::move(idle.back());
                idle.pop_back();
            }
        }
        if (!shader) shader = passes.makeTileShader(job);
        const int x0 = static_cast<int>(t) % columns * job.tileSize,
                  y0 = static_cast<int>(t) / columns * job.tileSize;
        ShadeStatistics counts;
        shader->run({x0, y0, std::min(x0 + job.tileSize, width), std::min(y0 + job.tileSize, height)}, images,
                    counts);
        const std::lock_guard lock(mutex);
        total.surfaceFragments += counts.surfaceFragments;
        total.backgroundFragments += counts.backgroundFragments;
        idle.push_back(std::move(shader));
    });
    if (statistics) *statistics = total;
    return images;
}

std::vector<VertexRadiance> lightVerticesOf(const ShadeJob& job) {
    constexpr size_t kVerticesPerTask = 4096;
    std::vector<VertexRadiance> radiance(job.scene->instances.size());
    std::vector<bool> visible(radiance.size(), false);
    for (const uint32_t id : job.target->id.values())
        if (id != kNoTriangle) visible[job.instanceOfDraw[job.target->triangles[id].draw]] = true;
    for (size_t i = 0; i < radiance.size(); i++) {
        if (!visible[i]) continue;
        const PlacedMesh& placed = (*job.placed)[i];
        const size_t count = placed.positions.size();
        for (auto& side : radiance[i].sides) side.diffuse.resize(count), side.specular.resize(count);
        const SurfaceMaterial& material = job.scene->materials[job.scene->instances[i].material];
        parallelFor((count + kVerticesPerTask - 1) / kVerticesPerTask, job.threads, [&](size_t task) {
            const size_t begin = task * kVerticesPerTask;
            lightingPasses().lightVertices(*job.profile, *job.scene, material, placed, job.view->eye, begin,
                                           std::min(kVerticesPerTask, count - begin), radiance[i]);
        });
    }
    return radiance;
}

CubeMap<float> environmentCube(const SurfaceEnvironment& environment, const Profile& profile, int threads) {
    CubeFromLatLong options;
    options.filter = profile.textureFilter;
    options.fractionBits = profile.textureFractionBits;
    const int size = std::max(1, environment.latLong.width() / 4);
    return mappingPasses(profile.fragment).cubeFromLatLong(environment.latLong, size, options, threads);
}

}  // namespace etalon
