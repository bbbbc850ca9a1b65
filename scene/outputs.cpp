#include "scene/outputs.h"

#include <algorithm>

namespace etalon {
namespace {

constexpr std::string_view kMean = "mean of the samples", kFirst = "sample 0";
constexpr std::string_view kRadiance = "W/(m^2 sr)", kNotNegative = "0 and above",
                           kUnitVector = "unit vector";
constexpr float kInfinity = std::numeric_limits<float>::infinity();

OutputPart radiance(std::vector<std::string_view> channels, ShadeOutput image,
                    std::string_view background = "0") {
    return {std::move(channels), image, 0, kRadiance, kNotNegative, kMean, background};
}

std::vector<OutputDescription> makeOutputs() {
    return {
        {"beauty",
         "the radiance that arrives: `ambient` + `diffuse` + `specular` + `mirror` + `background`, added in "
         "this order "
         "at each fragment",
         {radiance({"R", "G", "B"}, ShadeOutput::beauty, "the environment")}},
        {"alpha",
         "the part of the pixel that objects cover. R, G and B are not multiplied with it: they hold the "
         "background",
         {{{"A"}, {}, 0, "1", "[0, 1]", "samples covered / samples", "0"}}},
        {"depth",
         "`Z`, the distance along the optical axis, from the eye to the point that is shaded, dot(p - eye, "
         "forward) in "
         "the fragment arithmetic (lighting/kernels/view_depth.glsl)",
         {{{"Z"}, ShadeOutput::depth, kInfinity, "m", "[near, far]", kFirst, "infinity"}}},
        {"window_depth",
         "the depth that the depth test compares, as it is stored, as a fraction, rounded to float: 0 on the "
         "near plane, 1 on the far one, and the other way round with the profile's `depth_direction` "
         "reversed",
         {{{"depth.window"}, {}, 1, "1", "[0, 1]", kFirst, "the far plane's"}}},
        {"distance",
         "the distance from the eye to the point that is shaded",
         {{{"distance"}, ShadeOutput::distance, kInfinity, "m", "near and above", kFirst, "infinity"}}},
        {"normals",
         "the interpolated normal in world space, on the side that is seen",
         {{{"N.X", "N.Y", "N.Z"}, ShadeOutput::normals, 0, kUnitVector, "[-1, 1]", kFirst, "0"}}},
        {"ids",
         "whole numbers: the object, 1 for the first (meshes with all their instances in the file's order, "
         "then planes), "
         "and its triangle, 1 for the first",
         {{{"id.object", "id.triangle"}, {}, 0, "count", "1 and above", kFirst, "0"}}},
        {"coverage",
         "the numbers of `alpha` under a name that no viewer composites with",
         {{{"coverage"}, {}, 0, "1", "[0, 1]", "samples covered / samples", "0"}}},
        {"diffuse",
         "what lights and environment reflect diffusely",
         {radiance({"diffuse.R", "diffuse.G", "diffuse.B"}, ShadeOutput::diffuse)}},
        {"specular",
         "the gloss of lights",
         {radiance({"specular.R", "specular.G", "specular.B"}, ShadeOutput::specular)}},
        {"mirror",
         "what mirrors show",
         {radiance({"mirror.R", "mirror.G", "mirror.B"}, ShadeOutput::mirror)}},
        {"background",
         "the environment where it is seen",
         {radiance({"background.R", "background.G", "background.B"}, ShadeOutput::background,
                   "the environment")}},
        {"ambient",
         "what diffuse surfaces reflect of `ambient`",
         {radiance({"ambient.R", "ambient.G", "ambient.B"}, ShadeOutput::ambient)}},
        {"shadow",
         "for each light that casts shadows the part of it that reaches the surface: `light0` for the "
         "scene's first "
         "light, `environment0` for the first that the environment is cut into. 1 on surfaces that reflect "
         "no lights; "
         "on those that turn away from the light what its shadow method finds there",
         {{{"shadow.LIGHT"}, ShadeOutput::shadows, 1, "1", "[0, 1]", kMean, "1"}}},
        {"occlusion",
         "the part of its surroundings that the surface sees, weighted by the cosine, and the bent normal, "
         "the mean "
         "direction of what is open. Without `[render] occlusion` 1 and the normal",
         {{{"occlusion.open"}, ShadeOutput::open, 1, "1", "[0, 1]", kMean, "1"},
          {{"occlusion.X", "occlusion.Y", "occlusion.Z"},
           ShadeOutput::bentNormals,
           0,
           kUnitVector,
           "[-1, 1]",
           kFirst,
           "0"}}},
        {"irradiance",
         "what the surface receives from the environment (`[environment] lighting`), after occlusion and the "
         "shadows of "
         "the environment's lights, whatever it reflects",
         {{{"irradiance.R", "irradiance.G", "irradiance.B"},
           ShadeOutput::irradiance,
           0,
           "W/m^2",
           kNotNegative,
           kMean,
           "0"}}},
        {"environment",
         "what of `irradiance` the surface reflects diffusely: times its diffuse reflectance / pi. The "
         "environment's "
         "part of `diffuse`",
         {radiance({"environment.R", "environment.G", "environment.B"}, ShadeOutput::environment)}},
        {"cube_map",
         "for each mirror that is visible and shows the scene (`reflection = \"scene\"`) the cube map that "
         "it shows, as a "
         "light probe: a strip of faces in OpenEXR's layout, with the attribute `envmap`; ID is the mirror's "
         "`id.object`",
         {{{"R", "G", "B"}, {}, 0, kRadiance, kNotNegative, "one sample", "the environment"},
          {{"distance"}, {}, 0, "m", "near and above", "one sample", "infinity"}},
         "cube_map.ID"},
        {"shadow_map",
         "for each light with `shadow = \"map\"` what its map holds: depths as `depth.window` has them, or "
         "with "
         "`shadow_depth = \"linear\"`, but for directional lights, distances from the light. The six faces "
         "of a cube lie "
         "below each other, +X first, with their borders. The attribute `etalon.projection` says how points "
         "fall on it",
         {{{"depth"}, {}, 1, "1", "[0, 1]", "one sample", "1"},
          {{"distance"}, {}, 0, "m", "0 and above", "one sample", "infinity"}},
         "shadow_map.LIGHT"},
    };
}

}  // namespace

std::span<const OutputDescription> outputDescriptions() {
    static const std::vector<OutputDescription> outputs = makeOutputs();
    return outputs;
}

std::span<const std::string_view> outputNames() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> of;
        for (const OutputDescription& output : outputDescriptions()) of.push_back(output.name);
        return of;
    }();
    return names;
}

const OutputDescription* findOutput(std::string_view name) {
    const auto found = std::ranges::find(outputDescriptions(), name, &OutputDescription::name);
    return found == outputDescriptions().end() ? nullptr : &*found;
}

}  // namespace etalon
