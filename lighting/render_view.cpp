#include "lighting/render_view.h"

#include "lighting/cube_faces.h"
#include "numeric/progress.h"

namespace etalon {

namespace {

RenderTargetFormat formatOf(const Profile& profile, int samples) {
    RenderTargetFormat format;
    format.samples = samples;
    format.subpixelBits = profile.subpixelBits;
    format.depth = profile.depth;
    format.depthRounding = profile.depthRounding;
    format.real = profile.vertex;
    format.biasUnit = profile.biasUnit;
    format.depthOrder = profile.depthOrder;
    format.depthDirection = profile.depthDirection;
    return format;
}

}  // namespace

VisibleScene findVisible(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed, const View& view,
                         const Profile& profile, int samples, const RasterOptions& options,
                         uint32_t excluded) {
    VisibleScene visible{RenderTarget(view.width, view.height, formatOf(profile, samples)), {}, {}, {}};
    findVisible(visible, scene, placed, view, profile, samples, options, excluded);
    return visible;
}

void findVisible(VisibleScene& visible, const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                 const View& view, const Profile& profile, int samples, const RasterOptions& options,
                 uint32_t excluded, std::span<const std::vector<uint32_t>> only) {
    const RenderTargetFormat format = formatOf(profile, samples);
    RenderTarget& target = visible.target;
    if (target.width() != view.width || target.height() != view.height || target.format != format)
        target = RenderTarget(view.width, view.height, format);
    visible.instanceOfDraw.clear();
    visible.vertices.resize(scene.instances.size());

    const View drawn = inDirection(view, profile.depthDirection);
    std::vector<Draw> draws;
    for (uint32_t i = 0; i < scene.instances.size(); i++) {
        if (i == excluded) continue;
        toClipSpace(placed[i], drawn, profile.vertex, options.threads, visible.vertices[i]);
        Draw draw;
        draw.vertices = visible.vertices[i];
        draw.indices = placed[i].mesh->indices;
        if (!only.empty()) draw.only = only[i];
        draw.state.cull = scene.instances[i].twoSided ? CullMode::none : CullMode::back;
        draw.state.depthCompare = nearerThan(profile.depthDirection);
        draw.state.frontIsClockwise = view.mirrored != placed[i].mirrored;
        draws.push_back(draw);
        visible.instanceOfDraw.push_back(i);
    }
    RasterOptions cleared = options;
    cleared.clear = true;
    visible.statistics = rasterize(target, {0, 0, view.width, view.height}, draws, cleared);
}

ShadeJob shadeJobOf(const VisibleScene& visible, const SurfaceScene& scene,
                    const std::vector<PlacedMesh>& placed, const View& view, const Profile& profile,
                    const RasterOptions& options) {
    ShadeJob job;
    job.scene = &scene;
    job.sources = {&scene.lights, nullptr, &scene.environment.light};
    job.environment = &scene.environment;
    job.view = &view;
    job.target = &visible.target;
    job.placed = &placed;
    job.instanceOfDraw = visible.instanceOfDraw;
    job.sceneCubes.assign(scene.instances.size(), nullptr);
    job.profile = &profile;
    job.threads = options.threads;
    job.tileSize = options.tileSize;
    return job;
}

CubeRender renderCubeMap(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                         const CubeRenderRequest& request, const CubeMap<float>* environmentCube,
                         const Profile& profile, const RasterOptions& options) {
    // The triangles of each face, per instance.
    std::array<std::vector<std::vector<uint32_t>>, kCubeFaces> only;
    for (uint32_t i = 0; i < scene.instances.size(); i++) {
        std::array<std::vector<uint32_t>, kCubeFaces> lists;
        if (i != request.excluded) lists = trianglesOfFaces(placed[i], request.centre, options.threads);
        for (size_t face = 0; face < kCubeFaces; face++) only[face].push_back(std::move(lists[face]));
    }

    CubeRender cube;
    VisibleScene visible{RenderTarget(request.size, request.size, formatOf(profile, 1)), {}, {}, {}};
    ProgressLoop faces(kCubeFaces);
    for (int face = 0; face < kCubeFaces; face++) {
        const View view = cubeFaceView(static_cast<CubeFace>(face), request.size, request.centre,
                                       request.near_m, request.far_m);
        findVisible(visible, scene, placed, view, profile, 1, options, request.excluded,
                    only[static_cast<size_t>(face)]);
        ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, options);
        job.environmentCube = environmentCube;
        if (request.prepare) request.prepare(job);
        const std::shared_ptr<const LightVisibility> ofFace =
            request.visibilityOf ? request.visibilityOf(view) : nullptr;
        job.visibility = ofFace ? ofFace.get() : request.visibility;
        TileOcclusion occlusion;
        if (request.occlusionOf) {
            occlusion = request.occlusionOf(job);
            job.occlusion = &occlusion;
        }
        job.request[ShadeOutput::beauty] = true;
        job.request[ShadeOutput::distance] = true;
        ShadedImages images = shade(job);
        cube.radiance.faces[static_cast<size_t>(face)] = std::move(images[ShadeOutput::beauty]);
        cube.distance.faces[static_cast<size_t>(face)] = std::move(images[ShadeOutput::distance]);
        faces.next();
    }
    return cube;
}

}  // namespace etalon
