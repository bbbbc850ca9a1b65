// What the results of a scene's passes hold, beside a few words each.
#pragma once

#include <optional>
#include <vector>

#include "ar/scene_passes.h"

namespace etalon {

HeldMemory heldMemory(const Geometry& geometry);
HeldMemory heldMemory(const VisibleView& visible);
HeldMemory heldMemory(const EnvironmentImage& image);
HeldMemory heldMemory(const EnvironmentIllumination& illumination);
HeldMemory heldMemory(const SceneLights& lights);
HeldMemory heldMemory(const CastShadow& shadow);
HeldMemory heldMemory(const std::optional<CubeMap<float>>& environmentCube);
HeldMemory heldMemory(const CubeRender& cube);
HeldMemory heldMemory(const SurfaceOcclusion& occlusion);
HeldMemory heldMemory(const std::vector<VertexRadiance>& vertices);
HeldMemory heldMemory(const ViewShadows& shadows);
HeldMemory heldMemory(const ShadeTerm& term);
HeldMemory heldMemory(const Shading& shading);
HeldMemory heldMemory(const OutputChannels& output);
HeldMemory heldMemory(const Frame& frame);
HeldMemory heldMemory(const std::vector<OutputFile>& files);
HeldMemory heldMemory(const Image<uint8_t>& image);

}  // namespace etalon
