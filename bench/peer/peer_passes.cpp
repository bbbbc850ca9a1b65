#include "bench/peer/peer_passes.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "bench/peer/shaders.h"
#include "numeric/vectors.h"
#include "raster/blur.h"

namespace etalon::bench {
namespace {

constexpr VkFormat kColour = VK_FORMAT_R32G32B32A32_SFLOAT, kOneChannel = VK_FORMAT_R32_SFLOAT;

// The layout of blinn_phong.frag's uniforms.
struct ShadingUniforms {
    std::array<float, 4> diffuse, specular, ambient;
    std::array<std::array<float, 4>, kMaxLights> toLight{}, irradiance{};
};

std::array<float, 4> toFloats(const glm::dvec3& v, double w = 0) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

// Vulkan's clip space has y downwards.
PushConstants pushOf(const View& view) {
    PushConstants push;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            push.worldToClip[4 * column + row] = static_cast<float>(
                (row == 1 ? -1.0 : 1.0) * view.worldToClip[static_cast<size_t>(row)][column]);
    std::ranges::copy(toFloats(view.eye), push.eye);
    return push;
}

}  // namespace

PeerPasses::MeshBuffers PeerPasses::upload(const SurfaceMesh& mesh) {
    return {device_.makeBuffer(std::as_bytes(std::span(mesh.positions))),
            device_.makeBuffer(std::as_bytes(std::span(mesh.normals))),
            device_.makeBuffer(std::as_bytes(std::span(mesh.indices))),
            static_cast<uint32_t>(mesh.indices.size())};
}

DeviceBuffer PeerPasses::shadingUniforms(const SurfaceScene& scene) {
    const SurfaceMaterial& m = scene.materials[0];
    ShadingUniforms uniforms;
    uniforms.diffuse = toFloats(m.diffuse / kPi, m.exponent);
    uniforms.specular = toFloats(m.specular * ((m.exponent + 8) / (8 * kPi)));
    uniforms.ambient = toFloats(m.diffuse * scene.ambient);
    for (size_t i = 0; i < scene.lights.size(); i++) {
        uniforms.toLight[i] = toFloats(scene.lights[i].toLight);
        uniforms.irradiance[i] = toFloats(scene.lights[i].irradiance);
    }
    return device_.makeBuffer(std::as_bytes(std::span(&uniforms, 1)));
}

DeviceImage PeerPasses::colourImage(int width, int height, int samples) {
    return device_.makeImage(kColour, static_cast<uint32_t>(width), static_cast<uint32_t>(height), samples);
}

DeviceImage PeerPasses::depthImage(int width, int height, int samples) {
    return device_.makeImage(VK_FORMAT_D32_SFLOAT, static_cast<uint32_t>(width),
                             static_cast<uint32_t>(height), samples);
}

// Channels that the image does not have are 0.
DeviceImage PeerPasses::sampledImage(const Image<float>& image, VkFormat format, int channels) {
    std::vector<float> texels(image.pixelCount() * static_cast<size_t>(channels));
    for (int c = 0; c < image.channels(); c++)
        for (size_t i = 0; i < image.pixelCount(); i++)
            texels[i * static_cast<size_t>(channels) + static_cast<size_t>(c)] = image.plane(c)[i];
    const DeviceImage made = device_.makeImage(format, static_cast<uint32_t>(image.width()),
                                               static_cast<uint32_t>(image.height()));
    device_.upload(made, std::as_bytes(std::span(texels)));
    return made;
}

void PeerPasses::draw(VkCommandBuffer commands, const MeshBuffers& mesh, bool withNormals) {
    const std::array<VkBuffer, 2> buffers = {mesh.positions.buffer, mesh.normals.buffer};
    constexpr std::array<VkDeviceSize, 2> kOffsets = {0, 0};
    vkCmdBindVertexBuffers(commands, 0, withNormals ? 2 : 1, buffers.data(), kOffsets.data());
    vkCmdBindIndexBuffer(commands, mesh.indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands, mesh.indexCount, 1, 0, 0, 0);
}

PeerPass PeerPasses::depth(const Workload& w, int samples) {
    const MeshBuffers mesh = upload(w.mesh());
    PipelineDescription d;
    d.vertexShader = kDepthVert;
    d.input = VertexInput::positions;
    d.depth = true;
    d.samples = samples;
    const Pipeline pipeline = makePipeline(device_, d);
    PeerPass pass;
    pass.depth = depthImage(w.view.width, w.view.height, samples);
    pass.commands = device_.record([&](VkCommandBuffer commands) {
        recordPass(commands, {.depth = &pass.depth}, pipeline, pushOf(w.view),
                   [&] { draw(commands, mesh, false); });
    });
    return pass;
}

Pipeline PeerPasses::shadedPipeline(const SurfaceScene& scene, bool frontIsClockwise, int samples) {
    const DeviceBuffer uniforms = shadingUniforms(scene);
    PipelineDescription d;
    d.vertexShader = kMeshVert;
    d.fragmentShader = kBlinnPhongFrag;
    d.constants = {static_cast<int32_t>(scene.lights.size())};
    d.input = VertexInput::positionsAndNormals;
    d.colour = kColour;
    d.depth = true;
    d.frontIsClockwise = frontIsClockwise;
    d.samples = samples;
    d.uniforms = &uniforms;
    return makePipeline(device_, d);
}

PeerPass PeerPasses::shaded(const Workload& w, int samples) {
    const MeshBuffers mesh = upload(w.mesh());
    const Pipeline pipeline = shadedPipeline(w.scene, w.view.mirrored, samples);
    PeerPass pass;
    pass.colour = colourImage(w.view.width, w.view.height, 1);
    pass.depth = depthImage(w.view.width, w.view.height, samples);
    PassTargets targets{.colour = &pass.colour, .depth = &pass.depth};
    DeviceImage manySamples;
    if (samples > 1) {
        manySamples = colourImage(w.view.width, w.view.height, samples);
        targets.colour = &manySamples;
        targets.resolved = &pass.colour;
    }
    pass.commands = device_.record([&](VkCommandBuffer commands) {
        recordPass(commands, targets, pipeline, pushOf(w.view), [&] { draw(commands, mesh, true); });
    });
    return pass;
}

PeerPass PeerPasses::cube(const Workload& w) {
    const MeshBuffers mesh = upload(w.mesh());
    const CubeRenderRequest request = cubeRequest();
    const Pipeline pipeline = shadedPipeline(w.scene, true, 1);
    PeerPass pass;
    pass.commands = device_.record([&](VkCommandBuffer commands) {
        for (int face = 0; face < kCubeFaces; face++) {
            pass.colour = colourImage(request.size, request.size, 1);
            pass.depth = depthImage(request.size, request.size, 1);
            const View view = cubeFaceView(static_cast<CubeFace>(face), request.size, request.centre,
                                           request.near_m, request.far_m);
            recordPass(commands, {.colour = &pass.colour, .depth = &pass.depth}, pipeline, pushOf(view),
                       [&] { draw(commands, mesh, true); });
        }
    });
    return pass;
}

PeerPass PeerPasses::blur() {
    const DeviceImage input = sampledImage(blurInput(), kOneChannel, 1);
    const DeviceImage between = device_.makeImage(kOneChannel, kBlurSize, kBlurSize);
    // As blur.frag has them: one weight in every four floats.
    std::array<std::array<float, 4>, 32> weights{};
    const std::vector<double> exact = gaussianWeights(kBlurRadius, kBlurSigma);
    for (size_t i = 0; i < exact.size(); i++) weights[i][0] = static_cast<float>(exact[i]);
    const DeviceBuffer uniforms = device_.makeBuffer(std::as_bytes(std::span(weights)));

    PipelineDescription d;
    d.vertexShader = kFullScreenVert;
    d.fragmentShader = kBlurFrag;
    d.colour = kOneChannel;
    d.uniforms = &uniforms;
    d.constants = {0, kBlurRadius};
    d.sampled = &input;
    const Pipeline alongX = makePipeline(device_, d);
    d.constants[0] = 1;
    d.sampled = &between;
    const Pipeline alongY = makePipeline(device_, d);

    PeerPass pass;
    pass.colour = device_.makeImage(kOneChannel, kBlurSize, kBlurSize);
    pass.commands = device_.record([&](VkCommandBuffer commands) {
        recordPass(commands, {.colour = &between}, alongX, {}, [&] { vkCmdDraw(commands, 3, 1, 0, 0); });
        recordPass(commands, {.colour = &pass.colour}, alongY, {}, [&] { vkCmdDraw(commands, 3, 1, 0, 0); });
    });
    return pass;
}

PeerPass PeerPasses::cubeFromLatLong() {
    const DeviceImage input = sampledImage(latLongInput(), kColour, 4);
    PipelineDescription d;
    d.vertexShader = kFullScreenVert;
    d.fragmentShader = kLatlongToCubeFrag;
    d.constants = {kLatLongCubeSize};
    d.colour = kColour;
    d.sampled = &input;
    const Pipeline pipeline = makePipeline(device_, d);
    PeerPass pass;
    pass.colour = colourImage(kLatLongCubeSize, kCubeFaces * kLatLongCubeSize, 1);
    pass.commands = device_.record([&](VkCommandBuffer commands) {
        recordPass(commands, {.colour = &pass.colour}, pipeline, {},
                   [&] { vkCmdDraw(commands, 3, 1, 0, 0); });
    });
    return pass;
}

}  // namespace etalon::bench
