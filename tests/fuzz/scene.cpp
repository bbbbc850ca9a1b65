// A scene file, through everything up to its plan and, when it is small, its image: refused with one line, or
// planned and rendered. Beside the scene lie mesh.obj, mesh.ply and env.hdr.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "ar/render_scene.h"
#include "ar/surface_builder.h"
#include "scene/scene.h"
#include "tests/fuzz/fuzz.h"

using namespace etalon;

namespace {

// Larger scenes are legal; they are loaded and planned but not drawn, as drawing takes long.
constexpr int kMaxDrawnPixels = 1024, kMaxDrawnCubeSize = 16;
constexpr size_t kMaxDrawnObjects = 32;

class Folder {
  public:
    Folder() {
        fuzz::writeFile(scratch_ / "mesh.obj",
                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\n");
        fuzz::writeFile(
            scratch_ / "mesh.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        // Two texels, red and blue.
        constexpr char kEnvironment[] =
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\0\0\x82\0\0\x80\x82";
        fuzz::writeFile(scratch_ / "env.hdr", {kEnvironment, sizeof kEnvironment - 1});
    }
    std::filesystem::path scene() const { return scratch_ / "scene.toml"; }

  private:
    test::ScratchFolder scratch_;
};

bool isDrawn(const Scene& scene) {
    if (int64_t{scene.camera.width} * scene.camera.height * scene.render.samples > kMaxDrawnPixels)
        return false;
    for (const MeshObject& mesh : scene.meshes)
        if (mesh.cubeSize > kMaxDrawnCubeSize && mesh.reflection == Reflection::scene) return false;
    return sceneObjects(scene).size() <= kMaxDrawnObjects;
}

void checkPlan(const Plan& plan) {
    const std::string text = planText(plan);
    FUZZ_CHECK(std::ranges::count(text, '\n') == static_cast<std::ptrdiff_t>(plan.passes.size()) + 1);
    FUZZ_CHECK(!planDot(plan).empty());
    FUZZ_CHECK(nlohmann::json::accept(planJson(plan)));
    for (size_t i = 0; i < plan.passes.size(); i++)
        for (const size_t need : plan.passes[i].needs) FUZZ_CHECK(need < i);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const Folder folder;
    const std::filesystem::path file = folder.scene();
    fuzz::writeFile(file, fuzz::textOf(data, size));
    Scene scene;
    if (!fuzz::isAccepted(file, [&] { scene = loadScene(file); })) return 0;
    checkPlan(makePlan(scene, {}));
    if (!isDrawn(scene)) return 0;
    RenderOptions options;
    options.raster.threads = 1;
    fuzz::isAccepted(file, [&] {
        const RenderResult result = renderScene(scene, options);
        checkPlan(result.plan);
        checkFrame(result.frame);
    });
    return 0;
}
