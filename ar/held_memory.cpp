#include "ar/held_memory.h"

namespace etalon {
namespace {

template <class List>
uint64_t bytesOf(const List& list) {
    return list.size() * sizeof(*list.data());
}
template <class T>
uint64_t bytesOf(const Image<T>& image) {
    return image.values().size_bytes();
}
template <class T>
uint64_t bytesOf(const CubeMap<T>& cube) {
    uint64_t bytes = 0;
    for (const Image<T>& face : cube.faces) bytes += bytesOf(face);
    return bytes;
}
uint64_t bytesOf(const std::vector<Channel>& channels) {
    uint64_t bytes = 0;
    for (const Channel& channel : channels)
        bytes += std::visit([](const auto& image) { return bytesOf(image); }, channel.values);
    return bytes;
}

}  // namespace

HeldMemory heldMemory(const Geometry& geometry) {
    uint64_t bytes = 0;
    for (const SurfaceMesh& mesh : geometry.surfaces.meshes)
        bytes += bytesOf(mesh.positions) + bytesOf(mesh.normals) + bytesOf(mesh.uv_m) + bytesOf(mesh.indices);
    for (const PlacedMesh& placed : geometry.placed)
        bytes += bytesOf(placed.positions) + bytesOf(placed.normals);
    return {0, bytes};
}

HeldMemory heldMemory(const VisibleView& visible) {
    if (!visible.scene) return {};
    const RenderTarget& target = visible.scene->target;
    return {bytesOf(target.depth) + bytesOf(target.lowDepth) + bytesOf(target.stencil) +
                bytesOf(target.wideStencil) + bytesOf(target.id),
            bytesOf(target.triangles) + bytesOf(target.vertices) + bytesOf(target.clippedVertices)};
}

HeldMemory heldMemory(const EnvironmentImage& image) { return {0, bytesOf(image.radiance.latLong)}; }

HeldMemory heldMemory(const EnvironmentIllumination& illumination) {
    const EnvironmentLight& light = illumination.diffuse;
    return {bytesOf(light.map), bytesOf(illumination.lights) + bytesOf(light.directions) +
                                    bytesOf(light.flux) + bytesOf(light.harmonics.coefficients)};
}

HeldMemory heldMemory(const SceneLights& lights) { return {0, bytesOf(lights.lights())}; }

HeldMemory heldMemory(const CastShadow& shadow) {
    HeldMemory held{shadow.memory_bytes, shadow.volume ? bytesOf(shadow.volume->casters) : 0};
    if (shadow.map)
        for (const ShadowLayer& layer : shadow.map->layers)
            held.planes_bytes += bytesOf(layer.stored) + bytesOf(layer.distance_m);
    return held;
}

HeldMemory heldMemory(const std::optional<CubeMap<float>>& environmentCube) {
    return {0, environmentCube ? bytesOf(*environmentCube) : 0};
}

HeldMemory heldMemory(const CubeRender& cube) { return {bytesOf(cube.radiance) + bytesOf(cube.distance), 0}; }

HeldMemory heldMemory(const SurfaceOcclusion& occlusion) {
    HeldMemory held;
    for (const auto& tile : occlusion.fragments) held.planes_bytes += bytesOf(tile);
    for (const VertexOcclusion& mesh : occlusion.vertices)
        for (const auto& side : mesh) held.lists_bytes += bytesOf(side);
    return held;
}

HeldMemory heldMemory(const std::vector<VertexRadiance>& vertices) {
    HeldMemory held;
    for (const VertexRadiance& mesh : vertices)
        for (const VertexRadiance::Side& side : mesh.sides)
            held.lists_bytes += bytesOf(side.diffuse) + bytesOf(side.specular) + bytesOf(side.open);
    return held;
}

HeldMemory heldMemory(const ViewShadows& shadows) { return {shadows.memory_bytes, 0}; }

HeldMemory heldMemory(const ShadeTerm&) { return {}; }

HeldMemory heldMemory(const Shading& shading) {
    HeldMemory held;
    for (const Image<float>& image : shading.images.images) held.planes_bytes += bytesOf(image);
    return held;
}

HeldMemory heldMemory(const OutputChannels& output) { return {bytesOf(output.channels), 0}; }

HeldMemory heldMemory(const Frame& frame) { return {bytesOf(frame.channels), 0}; }

HeldMemory heldMemory(const std::vector<OutputFile>& files) {
    HeldMemory held;
    for (const OutputFile& file : files) held.planes_bytes += bytesOf(file.frame.channels);
    return held;
}

HeldMemory heldMemory(const Image<uint8_t>& image) { return {bytesOf(image), 0}; }

}  // namespace etalon
