#include "shadows/volume_shadows.h"

#include <algorithm>
#include <numeric>

#include "numeric/check.h"
#include "numeric/kernel_types.h"
#include "numeric/progress.h"

namespace etalon {
namespace {

// The kernel text of the masks, over the samples of a pixel.
template <class T>
struct VolumeMaskKernel {
#include "numeric/kernel_scope.inc"
    // The GLSL counterpart is shadows/kernels/volume_scope.glsl; the two say the same.
    boolean isLitSample(int s) const { return boolean(mask.at(x, y, s) != 0); }
    boolean isOwnSample(int s) const { return boolean(instance.at(x, y, s) == pointInstance); }
#include "shadows/kernels/volume_mask.glsl"

    const Image<uint8_t>& mask;
    const Image<uint32_t>& instance;
    int x = 0, y = 0;
    uint32_t pointInstance = 0;
};

// A caster in the view: what does not depend on the light.
struct Caster {
    const PlacedMesh* placed;
    MeshTopology topology;
    UninitializedVector<ClipVertex> near;  // its vertices
};

// One caster's volume on the screen.
struct DrawnVolume {
    ShadowVolume volume;
    std::vector<ClipVertex> vertices;  // numbered as the volume's
};

// The vertices infinitely far behind the mesh.
void addFarVertices(const Caster& caster, const LightSource& light, const View& view, RasterReal real,
                    int threads, std::vector<ClipVertex>& vertices) {
    // Directions have no place: the last column of the matrix does not apply.
    View directions = view;
    for (glm::dvec4& row : directions.worldToClip) row.w = 0;
    PlacedMesh behind;
    if (light.atInfinity) {
        behind.positions = {-light.place};
    } else {
        behind.positions.reserve(caster.placed->positions.size());
        for (const glm::dvec3& p : caster.placed->positions) behind.positions.push_back(p - light.place);
    }
    UninitializedVector<ClipVertex> far;
    toClipSpace(behind, directions, real, threads, far);
    vertices.insert(vertices.end(), far.begin(), far.end());
}

DrawState stateOf(VolumeCounting counting, bool frontIsClockwise, DepthDirection direction) {
    DrawState state;
    state.depthCompare = nearerThan(direction);
    state.cull = CullMode::none;
    state.frontIsClockwise = frontIsClockwise;
    state.depthWrite = state.idWrite = false;
    state.stencil.enabled = true;
    if (counting == VolumeCounting::zFail) {
        state.stencil.front.onDepthFail = StencilOperation::decrementWrap;
        state.stencil.back.onDepthFail = StencilOperation::incrementWrap;
    } else {
        state.stencil.front.onPass = StencilOperation::incrementWrap;
        state.stencil.back.onPass = StencilOperation::decrementWrap;
    }
    return state;
}

void addDraws(const DrawnVolume& drawn, const Caster& caster, const LightSource& light,
              const VolumeShadowOptions& options, bool mirroredView, DepthDirection direction,
              std::vector<Draw>& draws) {
    const ShadowVolume& volume = drawn.volume;
    const std::span<const ClipVertex> all = drawn.vertices;
    const size_t count = caster.placed->positions.size();
    // The near plane cuts caps as it cuts what is visible, to the same depths. Of the sides behind zFail's
    // samples it takes nothing; those in front of zPass's begin at the eye.
    // Caps keep the order of their vertices, so that clipping cuts them as it cuts what is visible; triangles
    // that face away from the light are seen from their other side.
    const auto addCap = [&](std::span<const ClipVertex> vertices, const std::vector<uint32_t>& triangles,
                            bool reversed) {
        if (triangles.empty()) return;
        Draw draw{vertices, caster.placed->mesh->indices,
                  stateOf(options.counting, mirroredView != reversed, direction), triangles};
        draws.push_back(draw);
    };
    addCap(all.first(count), volume.facing, false);
    addCap(all.first(count), volume.away, true);
    // The dark cap of a light at infinity is a point, and with zPass it is never in front.
    if (!light.atInfinity && options.counting == VolumeCounting::zFail) {
        addCap(all.subspan(count), volume.facing, true);
        addCap(all.subspan(count), volume.away, false);
    }
    if (volume.sides.empty()) return;
    draws.push_back({all, volume.sides, stateOf(options.counting, mirroredView, direction), {}});
    draws.back().state.depthClamp = options.counting == VolumeCounting::zPass;
}

// Where nothing is visible nothing needs to be counted: there the depths make every sample of a volume pass
// with zFail, and fail with zPass.
void leaveOutBackground(RenderTarget& target, VolumeCounting counting) {
    const uint32_t depth =
        counting == VolumeCounting::zFail ? depthBehindAll(target.format) : nearestDepth(target.format);
    const std::span<const uint32_t> ids = target.id.values();
    for (size_t i = 0; i < ids.size(); i++)
        if (ids[i] == kNoTriangle) target.depth.values()[i] = depth;
}

Image<uint32_t> visibleInstances(const VisibleScene& visible) {
    const RenderTarget& target = visible.target;
    Image<uint32_t> instances(target.width(), target.height(), target.format.samples);
    for (size_t i = 0; i < instances.values().size(); i++) {
        const uint32_t id = target.id.values()[i];
        instances.values()[i] =
            id == kNoTriangle ? kNoInstance : visible.instanceOfDraw[target.triangles[id].draw];
    }
    return instances;
}

}  // namespace

VolumeShadows::VolumeShadows(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                             const View& view, const Profile& profile, const VolumeShadowOptions& options,
                             const RasterOptions& raster) {
    const std::vector<SurfaceLight>& lights = options.lights ? *options.lights : scene.lights;
    lit_.resize(lights.size());
    ETALON_CHECK(!options.casters || options.casters->size() == lights.size(), "{} lights of {}",
                 options.casters ? options.casters->size() : 0, lights.size());
    const View infinite = inDirection(withInfiniteFar(view), profile.depthDirection);
    VisibleScene visible =
        findVisible(scene, placed, infinite, profile, options.samples, raster, options.excluded);
    instance_ = visibleInstances(visible);

    leaveOutBackground(visible.target, options.counting);

    std::vector<std::optional<Caster>> prepared(placed.size());
    const auto casterOf = [&](uint32_t instance) -> const Caster& {
        std::optional<Caster>& caster = prepared[instance];
        if (caster) return *caster;
        const PlacedMesh& mesh = placed[instance];
        caster.emplace(Caster{&mesh, topologyOf(mesh.positions, mesh.mesh->indices), {}});
        toClipSpace(mesh, infinite, profile.vertex, raster.threads, caster->near);
        statistics_.openEdges += caster->topology.openEdges;
        statistics_.crowdedEdges += caster->topology.crowdedEdges;
        statistics_.discordantEdges += caster->topology.discordantEdges;
        statistics_.leftOut += caster->topology.leftOut;
        return *caster;
    };
    std::vector<uint32_t> all(placed.size());
    std::iota(all.begin(), all.end(), 0u);

    const RenderTarget::Drawn whatIsVisible = visible.target.drawn();
    ProgressLoop progress(lights.size());
    for (size_t l = 0; l < lights.size(); l++, progress.next()) {
        const std::vector<uint32_t>& casters = options.casters ? (*options.casters)[l] : all;
        const LightSource light = lightSourceOf(lights[l]);
        std::vector<DrawnVolume> volumes(casters.size());
        std::vector<Draw> draws;
        for (size_t c = 0; c < casters.size(); c++) {
            DrawnVolume& drawn = volumes[c];
            const Caster& caster = casterOf(casters[c]);
            drawn.volume = shadowVolumeOf(caster.placed->positions, caster.placed->mesh->indices,
                                          caster.topology, light, raster.threads);
            if (drawn.volume.empty()) continue;
            drawn.vertices.assign(caster.near.begin(), caster.near.end());
            addFarVertices(caster, light, infinite, profile.vertex, raster.threads, drawn.vertices);
            addDraws(drawn, caster, light, options, view.mirrored, profile.depthDirection, draws);
            statistics_.caps += drawn.volume.facing.size() + drawn.volume.away.size();
            statistics_.sides += drawn.volume.sides.size() / 3;
            statistics_.silhouetteEdges += drawn.volume.silhouetteEdges;
        }
        if (draws.empty()) continue;
        // Depths stay, and what is visible; the triangles of the volumes are not kept.
        RenderTarget& target = visible.target;
        target.forgetTriangles(whatIsVisible);
        uint64_t triangles = 0;
        for (const Draw& draw : draws) triangles += draw.triangleCount();
        constexpr uint64_t kCountedIn8Bits = 255;
        target.setStencil(profile.volumeStencil == VolumeStencil::bits8 || triangles <= kCountedIn8Bits ? 8
                                                                                                        : 32);
        statistics_.raster = rasterize(target, {0, 0, view.width, view.height}, draws, raster);
        lit_[l] = Image<uint8_t>(target.width(), target.height(), target.format.samples);
        const auto mark = [&](const auto& counts) {
            for (size_t i = 0; i < counts.size(); i++)
                lit_[l].values()[i] = counts[i] == 0 || instance_.values()[i] == kNoInstance ? 1 : 0;
        };
        if (target.format.stencilBits == 8)
            mark(target.stencil.values());
        else
            mark(target.wideStencil.values());
    }
}

void VolumeShadows::find(size_t light, const LitPoints& points, std::span<double> visibility) const {
    const int samples = lit_[light].channels();
    VolumeMaskKernel<double> kernel{lit_[light], instance_};
    for (size_t i = 0; i < points.size(); i++) {
        kernel.x = static_cast<int>(points.x_px[i]), kernel.y = static_cast<int>(points.y_px[i]);
        kernel.pointInstance = points.instance[i];
        visibility[i] = kernel.litPartOfSamples(samples);
    }
}

uint64_t VolumeShadows::memory_bytes() const {
    uint64_t bytes = instance_.values().size_bytes();
    for (const Image<uint8_t>& lit : lit_) bytes += lit.values().size_bytes();
    return bytes;
}

}  // namespace etalon
