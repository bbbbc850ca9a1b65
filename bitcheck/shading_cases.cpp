// The vertex stage, and what views see: every material in every profile, cube maps of the scene.
#include <bit>
#include <string>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "lighting/render_view.h"

namespace etalon {
namespace {

constexpr double kNear_m = 0.05, kFar_m = 50;
constexpr uint32_t kSceneMirror = 1;  // of demoScene()

// Rows of 64 points, a layer for each coordinate.
template <class Points>
BitPlane planeOfPoints(std::string name, const Points& points, int coordinates, auto coordinate) {
    constexpr size_t kWidth = 64;
    BitPlane plane{
        std::move(name), WordKind::float64, kWidth, static_cast<int>((points.size() + kWidth - 1) / kWidth),
        coordinates,     "coordinate",      {}};
    for (int c = 0; c < coordinates; c++)
        for (size_t i = 0; i < kWidth * static_cast<size_t>(plane.height); i++)
            plane.words.push_back(
                i < points.size() ? std::bit_cast<uint64_t>(double{coordinate(points[i], c)}) : 0);
    return plane;
}

std::vector<BitPlane> vertexStage(RasterReal real, int threads) {
    const SurfaceScene scene = demoScene();
    const auto placed = placeMeshes(scene, real, threads);
    UninitializedVector<ClipVertex> clip;
    toClipSpace(placed[0], demoView(128, 128), real, threads, clip);
    const auto axis = [](const glm::dvec3& p, int c) { return p[c]; };
    return {planeOfPoints("positions", placed[0].positions, 3, axis),
            planeOfPoints("normals", placed[0].normals, 3, axis),
            planeOfPoints("clip", clip, 4, [](const ClipVertex& p, int c) {
                return c == 0 ? p.x : c == 1 ? p.y : c == 2 ? p.z : p.w;
            })};
}

// How large and how fine a view of the scene is.
struct ViewSize {
    int width, height, samples, cubeSize;
};

CubeRender renderMirrorCube(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed, int size,
                            const CubeMap<float>& environment, const Profile& profile,
                            const RasterOptions& options) {
    CubeRenderRequest request;
    request.centre = scene.instances[kSceneMirror].cubeCentre_m;
    request.size = size;
    request.near_m = kNear_m;
    request.far_m = kFar_m;
    request.excluded = kSceneMirror;
    return renderCubeMap(scene, placed, request, &environment, profile, options);
}

std::vector<BitPlane> shadeScene(const Profile& profile, const ViewSize& size, bool hasComponents,
                                 const RasterOptions& options) {
    static constexpr const char* kOutputNames[] = {"ambient",    "diffuse", "specular", "mirror",
                                                   "background", "beauty",  "normals",  "distance"};
    const SurfaceScene scene = demoScene();
    const auto placed = placeMeshes(scene, profile.vertex, options.threads);
    const CubeMap<float> environment = environmentCube(scene.environment, profile, options.threads);
    const CubeRender mirrored = renderMirrorCube(scene, placed, size.cubeSize, environment, profile, options);
    const View view = demoView(size.width, size.height);
    const VisibleScene visible = findVisible(scene, placed, view, profile, size.samples, options);

    ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, options);
    job.environmentCube = &environment;
    job.sceneCubes[kSceneMirror] = &mirrored.radiance;
    for (size_t o = 0; o < std::size(kOutputNames); o++)
        job.request.wanted[o] = hasComponents || o >= kRadianceComponents;
    const ShadedImages images = shade(job);

    std::vector<BitPlane> planes = {planeOf("depth", visible.target.depth)};
    for (size_t o = 0; o < std::size(kOutputNames); o++)
        if (job.request.wanted[o]) planes.push_back(planeOf(kOutputNames[o], images.images[o]));
    return planes;
}

std::vector<BitPlane> cubeOfScene(const Profile& profile, int size, const RasterOptions& options) {
    const SurfaceScene scene = demoScene();
    const auto placed = placeMeshes(scene, profile.vertex, options.threads);
    const CubeMap<float> environment = environmentCube(scene.environment, profile, options.threads);
    const CubeRender cube = renderMirrorCube(scene, placed, size, environment, profile, options);
    std::vector<BitPlane> planes;
    for (size_t f = 0; f < kCubeFaces; f++) {
        planes.push_back(planeOf("radiance-" + std::to_string(f), cube.radiance.faces[f]));
        planes.push_back(planeOf("distance-" + std::to_string(f), cube.distance.faces[f]));
    }
    return planes;
}

}  // namespace

void addShadingCases(std::vector<BitCase>& cases) {
    const auto add = [&](std::string name, std::string what, bool hasTiles, auto run) {
        cases.push_back({std::move(name), std::move(what), true, true, hasTiles, std::move(run)});
    };
    for (const auto& [name, real] :
         {std::pair("fp32", RasterReal::fp32), std::pair("fp64", RasterReal::fp64)})
        add(std::string("vertices/") + name, "object space to world space to clip space", false,
            [real = real](const RasterOptions& options) { return vertexStage(real, options.threads); });
    const Profile& first = profiles().front();
    add("cube/" + std::string(first.name), "six faces of the scene with distances", true,
        [&first](const RasterOptions& options) { return cubeOfScene(first, 40, options); });
    add("shading/" + std::string(first.name) + "-4", "every output of a view, 4 samples", true,
        [&first](const RasterOptions& options) {
            return shadeScene(first, {96, 80, 4, 32}, true, options);
        });
    for (const Profile& profile : profiles()) {
        const bool isTruth = profile.fragment == Arithmetic::truth;
        const ViewSize size = isTruth ? ViewSize{24, 20, 1, 4} : ViewSize{96, 80, 1, 16};
        add("shading/" + std::string(profile.name),
            "Blinn-Phong, Lambert, checker, mirrors, environment, normals, distance", true,
            [&profile, size](const RasterOptions& options) {
                return shadeScene(profile, size, false, options);
            });
    }
}

}  // namespace etalon
