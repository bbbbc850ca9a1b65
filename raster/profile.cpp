#include "raster/profile.h"

#include <array>

namespace etalon {
namespace {

// Sources: Direct3D 11.3 [D3D11.3, secs. 3, 7.18], Vulkan's minimum limits [VulkanSpec, "Required Limits"],
// R300 and NV40 as far as their vendors documented them (docs/references.md). What is documented of each field and what
// is assumed: scene/profile_text.cpp. Those that imitate hardware or a specification have its stencil of 8 bits: they are
// the ones whose depths are integers.
std::array<Profile, 11> namedProfiles() {
    std::array<Profile, 11> named = {{
        {"f32", "IEEE single precision, exact texture fractions, D32F", Arithmetic::fp32},
        {"f64", "IEEE double precision, exact texture fractions, depths of double", Arithmetic::fp64,
         RasterReal::fp64, DepthFormat::d64f},
        {"truth",
         "192-bit arithmetic for fragments, double for vertices, depths in their exact order; slow, to "
         "measure "
         "the others against",
         Arithmetic::truth, RasterReal::fp64, DepthFormat::d64f},
        {"d3d11",
         "single precision with flushed subnormals, 8-bit texture fractions, D24 [documented]; 8-bit weights",
         Arithmetic::fp32Flush, RasterReal::fp32, DepthFormat::d24, DepthRounding::exact, 8, 8},
        {"vulkan-min",
         "single precision, 4-bit subpixels and texture fractions, D16: the least a device may offer",
         Arithmetic::fp32, RasterReal::fp32, DepthFormat::d16, DepthRounding::exact, 4, 4},
        {"nvidia",
         "what an NVIDIA H100 computes: flushed subnormals, 8-bit texture weights, sums and writes of its "
         "fixed-function units, D24 [measured]",
         Arithmetic::fp32Flush, RasterReal::fp32, DepthFormat::d24, DepthRounding::fixedFunction, 8, 8,
         Filter::bilinear, Arithmetic::fp64, BiasUnit::driver, VolumeStencil::bits8,
         FilterRule{FilterPosition::fixedPoint, FilterWeights::bits8, FilterSum::fixedFunction}},
        {"nv40-fp32", "GeForce 6 single precision; flushed subnormals and nearest-even are assumed, D24",
         Arithmetic::fp32Nv40, RasterReal::fp32, DepthFormat::d24, DepthRounding::exact, 8, 8,
         Filter::nearest},
        {"nv40-fp16", "GeForce 6 half precision; nearest-even is assumed, 8-bit texture fractions, D24",
         Arithmetic::fp16Nv40, RasterReal::fp32, DepthFormat::d24, DepthRounding::exact, 8, 8},
        {"r300-fp24",
         "Radeon 9700-X800: 24-bit fragments, toward zero, float textures point-sampled, D24; quotients, "
         "roots "
         "and powers are exact and rounded once, not the documented reciprocals, log2 and exp2",
         Arithmetic::fp24R300, RasterReal::fp32, DepthFormat::d24, DepthRounding::exact, 8, 8,
         Filter::nearest},
        {"fp16", "IEEE half precision for fragments, single for vertices, D32F", Arithmetic::fp16},
        {"bf16", "bfloat16 for fragments, single for vertices, D32F", Arithmetic::bf16},
    }};
    for (Profile& profile : named) {
        if (profile.depth == DepthFormat::d16 || profile.depth == DepthFormat::d24)
            profile.volumeStencil = VolumeStencil::bits8;
        if (profile.fragment == Arithmetic::truth) profile.depthOrder = DepthOrder::exact;
        if (profile.name == "d3d11") profile.filterRule.weights = FilterWeights::bits8;
    }
    return named;
}

}  // namespace

std::span<const Profile> profiles() {
    static const std::array<Profile, 11> named = namedProfiles();
    return named;
}

std::vector<std::string_view> profileNames() {
    std::vector<std::string_view> names;
    for (const Profile& profile : profiles()) names.push_back(profile.name);
    return names;
}

const Profile* findProfile(std::string_view name) {
    for (const Profile& profile : profiles())
        if (profile.name == name) return &profile;
    return nullptr;
}

}  // namespace etalon
