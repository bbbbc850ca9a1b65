// Profiles: sets of choices for arithmetic, storage and fixed function. What a run differs in from another run of the
// same scene is this, and nothing else. A profile is a value: named ones stand here, a user composes others in a file
// (scene/profile_file.h).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/arithmetic.h"
#include "raster/render_target.h"
#include "raster/sampler.h"

namespace etalon {

// What shadow volumes are counted in: as many bits as their triangles need, or the 8 bits of a stencil, which wrap: what is
// behind a multiple of 256 of them then counts as lit.
enum class VolumeStencil : uint8_t { exact, bits8 };

struct Profile {
    std::string name;
    std::string meaning;                   // one line
    Arithmetic fragment;                   // fragments and texels
    RasterReal vertex = RasterReal::fp32;  // vertex transforms and depth
    DepthFormat depth = DepthFormat::d32f;
    DepthRounding depthRounding = DepthRounding::exact;
    int subpixelBits = 8;
    int textureFractionBits = kExactFraction;
    Filter textureFilter = Filter::bilinear;    // of float textures
    Arithmetic environment = Arithmetic::fp64;  // of what is made of an environment to light surfaces with
    BiasUnit biasUnit = BiasUnit::step;         // of constant depth bias
    VolumeStencil volumeStencil = VolumeStencil::exact;
    FilterRule filterRule = {};  // of float textures, and of the weights of percentage-closer filtering
    DepthDirection depthDirection = DepthDirection::forward;  // of what is visible
    DepthOrder depthOrder = DepthOrder::stored;  // of what is visible; exact: with depths of d64f in fp64
};

// How float textures are sampled.
inline SamplerSettings samplerOf(const Profile& profile) {
    SamplerSettings settings;
    settings.filter = profile.textureFilter;
    settings.fractionBits = profile.textureFractionBits;
    settings.rule = profile.filterRule;
    return settings;
}

// The named profiles; the first is the default.
std::span<const Profile> profiles();

// Their names, in the same order.
std::vector<std::string_view> profileNames();

// The named profile, or null.
const Profile* findProfile(std::string_view name);

}  // namespace etalon
