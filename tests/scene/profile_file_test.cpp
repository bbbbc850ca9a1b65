// Profiles that are composed in files, and what `etalon profiles` says of them.
#include "scene/profile_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "numeric/check.h"
#include "scene/profile_text.h"
#include "scene/scene.h"
#include "tests/support/scratch_folder.h"

using namespace etalon;
using test::ScratchFolder;

namespace {

std::filesystem::path written(const ScratchFolder& folder, const std::string& text,
                              const std::string& name = "own.toml") {
    std::ofstream(folder / name) << text;
    return folder / name;
}
Profile composed(const std::string& text) {
    const ScratchFolder folder;
    return readProfileFile(written(folder, text));
}
// What is refused, without the folder; empty if nothing is.
std::string refusal(const std::string& text) {
    const ScratchFolder folder;
    const std::filesystem::path file = written(folder, text);
    try {
        readProfileFile(file);
    } catch (const InputError& error) {
        const std::string message = error.what();
        CHECK(message.starts_with(file.string() + ":"));
        return message.substr(file.string().size() + 1);
    }
    return "";
}

// Equal but for the name and the meaning.
bool sameChoices(const Profile& a, const Profile& b) {
    return a.fragment == b.fragment && a.vertex == b.vertex && a.depth == b.depth &&
           a.depthRounding == b.depthRounding && a.depthOrder == b.depthOrder &&
           a.depthDirection == b.depthDirection && a.subpixelBits == b.subpixelBits &&
           a.textureFractionBits == b.textureFractionBits && a.textureFilter == b.textureFilter &&
           a.environment == b.environment && a.volumeStencil == b.volumeStencil && a.biasUnit == b.biasUnit &&
           a.filterRule == b.filterRule;
}

}  // namespace

TEST_CASE("EveryFieldOfAProfileIsComposed") {
    const Profile profile = composed(R"(
base = "d3d11"
vertex = "fp64"
depth = "d32f"
depth_rounding = "driver"
depth_direction = "reversed"
subpixel_bits = 5
texture_fraction_bits = 3
texture_filter = "nearest"
texture_format = "half"
filter_sum = "fixed-function"
environment = "fp16"
volume_stencil = "exact"
depth_bias_unit = "driver"
[fragment]
significand_bits = 24
min_exponent = -20
max_exponent = 31
rounding = "stochastic"
subnormals = "keep"
overflow = "saturate"
division = "reciprocal"
power = "exp2log2"
seed = 99
)");
    CHECK(profile.name == "own.toml");
    const Format expected{24,
                          -20,
                          31,
                          Rounding::stochastic,
                          Subnormals::keep,
                          Overflow::saturate,
                          Division::reciprocal,
                          Power::exp2log2,
                          99};
    CHECK(profile.fragment == Arithmetic(expected));
    CHECK(profile.vertex == RasterReal::fp64);
    CHECK(profile.depth == DepthFormat::d32f);
    CHECK(profile.depthRounding == DepthRounding::driver);
    CHECK(profile.depthDirection == DepthDirection::reversed);
    CHECK(profile.depthOrder == DepthOrder::stored);
    CHECK(profile.subpixelBits == 5);
    CHECK(profile.textureFractionBits == 3);
    CHECK(profile.textureFilter == Filter::nearest);
    CHECK(profile.filterRule == FilterRule{FilterPosition::rounded, FilterWeights::bits8,
                                           FilterSum::fixedFunction, TexelFormat::float16});
    CHECK(profile.environment == Arithmetic::fp16);
    CHECK(profile.volumeStencil == VolumeStencil::exact);
    CHECK(profile.biasUnit == BiasUnit::driver);
    CHECK(composed("volume_stencil = '8-bit'").volumeStencil == VolumeStencil::bits8);
    CHECK(composed("texture_fraction_bits = 'exact'\nbase = 'vulkan-min'").textureFractionBits ==
          kExactFraction);
    CHECK(composed("base = 'd3d11'\nfilter_weights = 'product'").filterRule == FilterRule{});
    CHECK(composed("base = 'nvidia'\ntexture_format = 'unorm8'").filterRule.texels == TexelFormat::unorm8);
    CHECK(composed("depth_rounding = 'fixed-function'").depthRounding == DepthRounding::fixedFunction);
}

TEST_CASE("WhatAProfileFileLeavesOutIsThatOfItsBase") {
    CHECK(sameChoices(composed(""), profiles().front()));
    for (const Profile& named : profiles())
        CHECK(sameChoices(composed("base = '" + named.name + "'"), named));
    // What an exact order needs is left out with it.
    CHECK(composed("base = 'truth'\ndepth = 'd24'").depthOrder == DepthOrder::stored);
    CHECK(composed("base = 'f64'\ndepth_order = 'exact'").depthOrder == DepthOrder::exact);
    // A table starts from the base's format, or from the one that it names.
    Format old = kFp24R300;
    old.division = Division::reciprocal;
    CHECK(composed("base = 'r300-fp24'\nfragment = {division = 'reciprocal'}").fragment == Arithmetic(old));
    CHECK(composed("fragment = {format = 'fp24-r300', division = 'reciprocal'}").fragment == Arithmetic(old));
    Format away = kFp32;
    away.rounding = Rounding::nearestAway;
    CHECK(composed("base = 'f64'\nfragment = {rounding = 'nearest-away'}").fragment == Arithmetic(away));
    // That of environments is independent of it, and double unless it is named.
    CHECK(composed("base = 'r300-fp24'").environment == Arithmetic::fp64);
    CHECK(composed("fragment = 'fp16'").environment == Arithmetic::fp64);
    Format cut = kFp16;
    cut.rounding = Rounding::towardZero;
    CHECK(composed("[environment]\nformat = 'fp16'\nrounding = 'toward-zero'").environment ==
          Arithmetic(cut));
    CHECK(composed("[environment]\nrounding = 'nearest-away'").environment == Arithmetic(away));
    // Names.
    CHECK(composed("fragment = 'fp32'").fragment == Arithmetic::fp32);
    CHECK(composed("fragment = 'fp64'").fragment == Arithmetic::fp64);
    CHECK(composed("fragment = 'truth'").fragment == Arithmetic::truth);
    for (const NamedFormat& named : namedFormats())
        if (named.name != "fp32")
            CHECK(composed("fragment = '" + std::string(named.name) + "'").fragment ==
                  Arithmetic(named.format));
}

TEST_CASE("BadProfileFilesAreRefusedWithLineAndKey") {
    const auto refuses = [](const std::string& text, const std::string& start, const std::string& part = "") {
        const std::string message = refusal(text);
        CAPTURE(text);
        CAPTURE(message);
        CHECK(message.starts_with(start));
        CHECK(message.find(part) != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
    };
    refuses("base = 'f31'", "1: 'base'", "did you mean");
    refuses("\nbases = 'f32'", "2: unknown key 'bases'", "did you mean 'base'?");
    refuses("base = 3", "1: 'base'", "must be a string, not an integer");
    refuses("base = 'own.toml'", "1: 'base'");
    refuses("fragment = 'fp23'", "1: 'fragment'", "fp24-r300");
    refuses("fragment = 24", "1: 'fragment'", "a table");
    refuses("vertex = 'fp16'", "1: 'vertex'", "fp32, fp64");
    refuses("depth = 'd8'", "1: 'depth'");
    refuses("depth_rounding = true", "1: 'depth_rounding'", "a boolean");
    refuses("base = 'truth'\ndepth = 'd32f'\ndepth_order = 'exact'", "3: 'depth_order'", "d64f");
    refuses("depth_order = 'exact'", "1: 'depth_order'", "d64f");
    refuses("depth_direction = 'backward'", "1: 'depth_direction'", "reversed");
    refuses("subpixel_bits = 3", "1: 'subpixel_bits'", "[4, 8]");
    refuses("subpixel_bits = 8.0", "1: 'subpixel_bits'", "a number");
    refuses("texture_fraction_bits = 17", "1: 'texture_fraction_bits'", "[0, 16]");
    refuses("texture_fraction_bits = 'most'", "1: 'texture_fraction_bits'", "exact");
    refuses("texture_filter = 'cubic'", "1: 'texture_filter'");
    refuses("texture_format = 'fp16'", "1: 'texture_format'", "half");
    refuses("filter_position = 'fixed-point'", "1: 'filter_position'", "texture_fraction_bits = 8");
    refuses("filter_weights = '8-bit'", "1: 'filter_weights'", "at most 8");
    refuses("filter_sum = 'fixed-function'", "1: 'filter_sum'", "8-bit");
    refuses("base = 'd3d11'\ntexture_fraction_bits = 'exact'", "2: 'texture_fraction_bits'",
            "filter_weights");
    refuses("base = 'nvidia'\ntexture_fraction_bits = 4", "2: 'texture_fraction_bits'", "filter_position");
    refuses("base = 'nvidia'\nfragment = 'fp16'", "2: 'fragment'", "at least 24 significand bits");
    refuses("[fragment]\nbits = 3", "2: unknown key 'bits' in [fragment]");
    refuses("[fragment]\nsignificand_bits = 25", "2: 'significand_bits' in [fragment]", "[2, 24]");
    refuses("[fragment]\nsignificand_bits = 1", "2: 'significand_bits'");
    refuses("[fragment]\nmin_exponent = 1", "2: 'min_exponent'");
    refuses("[fragment]\nmin_exponent = -401", "2: 'min_exponent'");
    refuses("[fragment]\n\nmax_exponent = 401", "3: 'max_exponent'");
    refuses("[fragment]\nmax_exponent = 22", "2: 'max_exponent'", "at least 23 for 24 significand bits");
    refuses("[fragment]\nrounding = 'odd'", "2: 'rounding'", "stochastic");
    refuses("[fragment]\nsubnormals = 'kept'", "2: 'subnormals'");
    refuses("[fragment]\noverflow = 1", "2: 'overflow'");
    refuses("[fragment]\ndivision = 'fast'", "2: 'division'");
    refuses("[fragment]\npower = 'fast'", "2: 'power'");
    refuses("[fragment]\nseed = 1", "2: 'seed'", "needs rounding");
    refuses("[fragment]\nrounding = 'stochastic'\nseed = -1", "3: 'seed'");
    refuses("[fragment]\nformat = 'fp64'", "2: 'format'");
    refuses("[[fragment]]\n", "1: 'fragment'");
    refuses("\nenvironment = 'fp23'", "2: 'environment'", "fp24-r300");
    refuses("environment = 16", "1: 'environment'", "a table");
    refuses("[environment]\nbits = 3", "2: unknown key 'bits' in [environment]");
    refuses("[environment]\nsignificand_bits = 25", "2: 'significand_bits' in [environment]", "[2, 24]");
    refuses("base = ", "1: not valid TOML");
    CHECK_THROWS_AS(loadProfile("none.toml"), InputError);
    CHECK_THROWS_AS(loadProfile("f31"), InputError);
    CHECK(loadProfile("fp16").name == "fp16");
}

TEST_CASE("TheTextOfAProfileIsAFileThatComposesIt") {
    const ScratchFolder folder;
    for (const Profile& named : profiles()) {
        CAPTURE(named.name);
        CHECK(sameChoices(readProfileFile(written(folder, profileText(named))), named));
    }
    Profile own = *findProfile("bf16");
    Format format = kBf16;
    format.rounding = Rounding::stochastic;
    format.seed = 12345678901234;
    format.power = Power::exp2log2;
    own.fragment = Arithmetic(format);
    own.environment = Arithmetic(kFp24R300);
    own.depthRounding = DepthRounding::driver;
    CHECK(sameChoices(readProfileFile(written(folder, profileText(own))), own));
}

TEST_CASE("EveryFieldOfWhatImitatesHardwareIsDocumentedOrAssumed") {
    for (const char* name : {"d3d11", "nvidia", "nv40-fp32", "nv40-fp16", "r300-fp24", "vulkan-min"})
        for (const ProfileField& field : profileFields(*findProfile(name))) {
            CAPTURE(name);
            CAPTURE(field.key);
            CHECK(!(field.documented.empty() && field.assumed.empty()));
        }
}

TEST_CASE("ASceneNamesAProfileFileBesideIt") {
    const ScratchFolder folder;
    written(folder, "base = 'fp16'\nsubpixel_bits = 4");
    const auto sceneWith = [&](const std::string& profile) {
        return written(folder,
                       "[camera]\nwidth = 4\nheight = 4\nfov_y_deg = 45\nnear = 0.1\nfar = 10\n"
                       "position = [0, 0, 3]\nlook_at = [0, 0, 0]\n[render]\nprofile = '" +
                           profile + "'\n",
                       "scene.toml");
    };
    const Scene scene = loadScene(sceneWith("own.toml"));
    CHECK(scene.render.profile.name == "own.toml");
    CHECK(scene.render.profile.subpixelBits == 4);
    CHECK(scene.render.profile.fragment == Arithmetic::fp16);
    CHECK_THROWS_WITH_AS(loadScene(sceneWith("none.toml")),
                         doctest::Contains("scene.toml:10: 'profile' in [render]"), InputError);
    CHECK_THROWS_WITH_AS(loadScene(sceneWith("f31")),
                         doctest::Contains("scene.toml:10: 'profile' in [render]"), InputError);
    written(folder, "\nbase = 'f31'");
    CHECK_THROWS_WITH_AS(loadScene(sceneWith("own.toml")), doctest::Contains("own.toml:2: 'base'"),
                         InputError);
}
