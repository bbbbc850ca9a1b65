#include "scene/profile_text.h"

#include <algorithm>
#include <string_view>

#include "numeric/format_names.h"
#include "numeric/text.h"
#include "raster/names.h"

namespace etalon {
namespace {

// What is known of a field of a named profile.
struct Note {
    std::string_view profile, key, documented, assumed;
};

// What was measured, and where.
#define NVIDIA_MEASURED "measured on an H100, driver 580.159.04"

// Profiles that imitate hardware or a specification. A key that ends in a dot is that of all fields below it that have
// no note of their own.
constexpr Note kNotes[] = {
    {"f32", "fragment", "binary32 of [IEEE754]", ""},
    {"f64", "fragment", "binary64 of [IEEE754]", ""},
    {"fp16", "fragment.", "binary16 of [IEEE754]", ""},
    {"bf16", "fragment.significand_bits", "binary32 with 8 significand bits", ""},
    {"bf16", "fragment.rounding", "", "each result is rounded; real units accumulate in binary32"},
    {"bf16", "fragment.subnormals", "", "kept; real units often flush"},

    {"d3d11", "fragment.", "binary32 [D3D11.3, sec. 3]", ""},
    {"d3d11", "fragment.rounding", "sums and products within 0.5 ULP [D3D11.3, sec. 3]", "ties to even"},
    {"d3d11", "fragment.subnormals", "flushed to a zero that keeps its sign [D3D11.3, sec. 3]", ""},
    {"d3d11", "fragment.overflow", "infinities and NaN [D3D11.3, sec. 3]", ""},
    {"d3d11", "fragment.division", "", "correctly rounded, where more error is allowed [D3D11.3, sec. 3]"},
    {"d3d11", "fragment.power", "", "within 0.51 ULP, where more error is allowed [D3D11.3, sec. 3]"},
    {"d3d11", "vertex", "binary32 [D3D11.3, sec. 3]", "subnormals kept"},
    {"d3d11", "depth", "", "24 bits, one of the formats that there are"},
    {"d3d11", "depth_rounding", "one half is added, then the fraction is cut off [D3D11.3]", ""},
    {"d3d11", "depth_order", "stored depths are compared [D3D11.3]", ""},
    {"d3d11", "depth_direction", "", "forward; the projection decides"},
    {"d3d11", "subpixel_bits", "8 [D3D11.3]", ""},
    {"d3d11", "texture_fraction_bits", "at least 8 [D3D11.3, sec. 7.18]", ""},
    {"d3d11", "texture_filter", "", "float textures are filtered"},
    {"d3d11", "texture_format", "", "32 bits"},
    {"d3d11", "filter_position", "u W - 1/2 in fixed point [D3D11.3, sec. 7.18]", "rounded half up"},
    {"d3d11", "filter_weights", "",
     "8 bits, as measured on an NVIDIA H100: 98 % of them are not the products of the fractions"},
    {"d3d11", "filter_sum", "", "in the arithmetic"},
    {"d3d11", "depth_bias_unit", "1 / (2^n - 1) [D3D11.3, sec. 15.10]", ""},
    {"d3d11", "volume_stencil", "D24 has a stencil of 8 bits [D3D11.3]", ""},
    {"d3d11", "environment", "", "made beforehand, by a host in double"},

    {"nvidia", "fragment.", "binary32, " NVIDIA_MEASURED, ""},
    {"nvidia", "fragment.rounding", "sums and products to nearest even, " NVIDIA_MEASURED, ""},
    {"nvidia", "fragment.subnormals", "inputs and results flushed, " NVIDIA_MEASURED,
     "what rounds up to the smallest normal number is kept"},
    {"nvidia", "fragment.overflow", "infinities and NaN, " NVIDIA_MEASURED, ""},
    {"nvidia", "fragment.division", "exact under the execution mode RoundingModeRTE, " NVIDIA_MEASURED,
     "that mode, and an exact root: the driver's quotients are off by up to 2 ULP in 22 % of cases, its "
     "roots by "
     "1 ULP in 8 %"},
    {"nvidia", "fragment.power", "", "within 0.51 ULP: the driver's are off by up to 66"},
    {"nvidia", "vertex", "binary32, " NVIDIA_MEASURED, "subnormals kept"},
    {"nvidia", "depth", "", "24 bits"},
    {"nvidia", "depth_rounding", "rule 22, " NVIDIA_MEASURED,
     "of depths interpolated by rule 5: the hardware's are up to 7 steps of D24 away, 34 in slivers"},
    {"nvidia", "depth_order", "stored depths are compared [VulkanSpec]", ""},
    {"nvidia", "depth_direction", "", "forward; the projection decides"},
    {"nvidia", "subpixel_bits", "8, to nearest even, " NVIDIA_MEASURED, ""},
    {"nvidia", "texture_fraction_bits", "8, " NVIDIA_MEASURED, ""},
    {"nvidia", "texture_filter", "float textures are filtered, " NVIDIA_MEASURED, ""},
    {"nvidia", "texture_format", "", "32 bits"},
    {"nvidia", "filter_position", "rule 22, " NVIDIA_MEASURED,
     "of cube coordinates by rule 9: in 0.2 % of recorded samples the hardware's are 1/256 of a texel away"},
    {"nvidia", "filter_weights", "rule 22, of textures and of comparisons, " NVIDIA_MEASURED,
     "at corners of cubes those of the mean of three texels, which the hardware does not take"},
    {"nvidia", "filter_sum", "rule 22, " NVIDIA_MEASURED, "a sum in double where a texel is not finite"},
    {"nvidia", "depth_bias_unit", "2^-(n - 1), " NVIDIA_MEASURED, ""},
    {"nvidia", "volume_stencil", "", "8 bits beside 24 of depth"},
    {"nvidia", "environment", "", "made beforehand, by a host in double"},

    {"vulkan-min", "fragment", "32 bits [VulkanSpec]",
     "nearest-even, subnormals kept, exact quotients and powers, where more error is allowed"},
    {"vulkan-min", "vertex", "32 bits [VulkanSpec]", "nearest-even, subnormals kept"},
    {"vulkan-min", "depth", "every device has it [VulkanSpec]", ""},
    {"vulkan-min", "depth_rounding", "", "exact"},
    {"vulkan-min", "depth_order", "stored depths are compared [VulkanSpec]", ""},
    {"vulkan-min", "depth_direction", "", "forward; the projection decides"},
    {"vulkan-min", "subpixel_bits", "the least subPixelPrecisionBits [VulkanSpec, \"Required Limits\"]", ""},
    {"vulkan-min", "texture_fraction_bits",
     "the least subTexelPrecisionBits [VulkanSpec, \"Required Limits\"]", ""},
    {"vulkan-min", "texture_filter", "", "float textures are filtered"},
    {"vulkan-min", "texture_format", "", "32 bits"},
    {"vulkan-min", "filter_position", "", "rounded half up to the fraction's bits"},
    {"vulkan-min", "filter_weights", "", "products of the fractions"},
    {"vulkan-min", "filter_sum", "", "in the arithmetic"},
    {"vulkan-min", "depth_bias_unit", "any constant of the format [VulkanSpec]", "a step"},
    {"vulkan-min", "volume_stencil", "every format with a stencil has 8 bits [VulkanSpec]", ""},
    {"vulkan-min", "environment", "", "made beforehand, by a host in double"},

    {"nv40-fp32", "fragment.significand_bits", "23 fraction bits [Kilgariff2005]", ""},
    {"nv40-fp32", "fragment.min_exponent", "8 exponent bits [Kilgariff2005]", ""},
    {"nv40-fp32", "fragment.max_exponent", "8 exponent bits [Kilgariff2005]", ""},
    {"nv40-fp32", "fragment.rounding", "", "nearest-even"},
    {"nv40-fp32", "fragment.subnormals", "", "flushed"},
    {"nv40-fp32", "fragment.overflow", "", "infinities and NaN"},
    {"nv40-fp32", "fragment.division", "", "one exact step"},
    {"nv40-fp32", "fragment.power", "", "one exact step"},
    {"nv40-fp32", "vertex", "32 bits [Kilgariff2005]", "nearest-even, subnormals kept"},
    {"nv40-fp32", "depth", "", "24 bits"},
    {"nv40-fp32", "depth_rounding", "", "exact"},
    {"nv40-fp32", "depth_order", "", "stored depths"},
    {"nv40-fp32", "depth_direction", "", "forward; the projection decides"},
    {"nv40-fp32", "subpixel_bits", "", "8"},
    {"nv40-fp32", "texture_fraction_bits", "", "8"},
    {"nv40-fp32", "texture_filter", "fp16 textures are filtered, not fp32 [Kilgariff2005]", ""},
    {"nv40-fp32", "texture_format", "", "32 bits"},
    {"nv40-fp32", "filter_position", "", "rounded half up to the fraction's bits"},
    {"nv40-fp32", "filter_weights", "", "products of the fractions"},
    {"nv40-fp32", "filter_sum", "", "in the arithmetic"},
    {"nv40-fp32", "depth_bias_unit", "", "a step"},
    {"nv40-fp32", "volume_stencil", "", "8 bits beside 24 of depth"},
    {"nv40-fp32", "environment", "", "made beforehand, by a host in double"},

    {"nv40-fp16", "fragment.significand_bits", "10 fraction bits [Kilgariff2005]", ""},
    {"nv40-fp16", "fragment.min_exponent", "5 exponent bits [Kilgariff2005]", ""},
    {"nv40-fp16", "fragment.max_exponent", "5 exponent bits [Kilgariff2005]", ""},
    {"nv40-fp16", "fragment.rounding", "", "nearest-even"},
    {"nv40-fp16", "fragment.subnormals", "", "kept"},
    {"nv40-fp16", "fragment.overflow", "", "infinities and NaN"},
    {"nv40-fp16", "fragment.division", "", "one exact step"},
    {"nv40-fp16", "fragment.power", "", "one exact step"},
    {"nv40-fp16", "vertex", "32 bits [Kilgariff2005]", "nearest-even, subnormals kept"},
    {"nv40-fp16", "depth", "", "24 bits"},
    {"nv40-fp16", "depth_rounding", "", "exact"},
    {"nv40-fp16", "depth_order", "", "stored depths"},
    {"nv40-fp16", "depth_direction", "", "forward; the projection decides"},
    {"nv40-fp16", "subpixel_bits", "", "8"},
    {"nv40-fp16", "texture_fraction_bits", "", "8"},
    {"nv40-fp16", "texture_filter", "fp16 textures are filtered [Kilgariff2005]", ""},
    {"nv40-fp16", "texture_format", "", "32 bits"},
    {"nv40-fp16", "filter_position", "", "rounded half up to the fraction's bits"},
    {"nv40-fp16", "filter_weights", "", "products of the fractions"},
    {"nv40-fp16", "filter_sum", "", "in the arithmetic"},
    {"nv40-fp16", "depth_bias_unit", "", "a step"},
    {"nv40-fp16", "volume_stencil", "", "8 bits beside 24 of depth"},
    {"nv40-fp16", "environment", "", "made beforehand, by a host in double"},

    {"r300-fp24", "fragment.significand_bits", "16 fraction bits, by a single source", ""},
    {"r300-fp24", "fragment.min_exponent", "7 exponent bits, by a single source",
     "all exponents but that of zero are numbers"},
    {"r300-fp24", "fragment.max_exponent", "7 exponent bits, by a single source",
     "all exponents but that of zero are numbers"},
    {"r300-fp24", "fragment.rounding", "truncation, by a single source", ""},
    {"r300-fp24", "fragment.subnormals", "none, by a single source", "a zero keeps its sign"},
    {"r300-fp24", "fragment.overflow", "no infinities and no NaN, by a single source", "0/0 is +0"},
    {"r300-fp24", "fragment.division", "not followed: the product with a reciprocal [MesaR300]",
     "one exact step"},
    {"r300-fp24", "fragment.power", "not followed: log2, product, exp2 [MesaR300]", "one exact step"},
    {"r300-fp24", "vertex", "", "32 bits, nearest-even"},
    {"r300-fp24", "depth", "", "24 bits"},
    {"r300-fp24", "depth_rounding", "", "exact"},
    {"r300-fp24", "depth_order", "", "stored depths"},
    {"r300-fp24", "depth_direction", "", "forward; the projection decides"},
    {"r300-fp24", "subpixel_bits", "", "8"},
    {"r300-fp24", "texture_fraction_bits", "", "8"},
    {"r300-fp24", "texture_filter", "float textures are not filtered, by a single source", ""},
    {"r300-fp24", "texture_format", "", "32 bits"},
    {"r300-fp24", "filter_position", "", "rounded half up to the fraction's bits"},
    {"r300-fp24", "filter_weights", "", "products of the fractions"},
    {"r300-fp24", "filter_sum", "", "in the arithmetic"},
    {"r300-fp24", "depth_bias_unit", "", "a step"},
    {"r300-fp24", "volume_stencil", "", "8 bits beside 24 of depth"},
    {"r300-fp24", "environment", "", "made beforehand, by a host in double"},
};

#undef NVIDIA_MEASURED

// The longest key that fits; null if none does.
const Note* noteOf(std::string_view profile, std::string_view key) {
    const Note* best = nullptr;
    for (const Note& note : kNotes) {
        if (note.profile != profile) continue;
        if (note.key != key && !(note.key.ends_with('.') && key.starts_with(note.key))) continue;
        if (best == nullptr || note.key.size() > best->key.size()) best = &note;
    }
    return best;
}

}  // namespace

std::vector<ProfileField> profileFields(const Profile& profile) {
    std::vector<ProfileField> fields;
    const auto add = [&](const std::string& key, std::string value, bool isNumber = false) {
        ProfileField field{key, std::move(value), isNumber, "", ""};
        if (const Note* note = noteOf(profile.name, key)) {
            field.documented = note->documented;
            field.assumed = note->assumed;
        }
        fields.push_back(std::move(field));
    };
    const auto addNumber = [&](const std::string& key, auto value) {
        add(key, formatText("{}", value), true);
    };
    const auto addName = [&](const std::string& key, auto value) { add(key, std::string(nameOf(value))); };
    const auto addArithmetic = [&](const std::string& key, const Arithmetic& arithmetic) {
        if (!arithmetic.format) return add(key, arithmeticName(arithmetic));
        const Format& f = *arithmetic.format;
        addNumber(key + ".significand_bits", f.significandBits);
        addNumber(key + ".min_exponent", f.minExponent);
        addNumber(key + ".max_exponent", f.maxExponent);
        addName(key + ".rounding", f.rounding);
        addName(key + ".subnormals", f.subnormals);
        addName(key + ".overflow", f.overflow);
        addName(key + ".division", f.division);
        addName(key + ".power", f.power);
        if (f.rounding == Rounding::stochastic) addNumber(key + ".seed", f.seed);
    };
    addArithmetic("fragment", profile.fragment);
    addName("vertex", profile.vertex);
    addName("depth", profile.depth);
    addName("depth_rounding", profile.depthRounding);
    addName("depth_order", profile.depthOrder);
    addName("depth_direction", profile.depthDirection);
    addNumber("subpixel_bits", profile.subpixelBits);
    if (profile.textureFractionBits == kExactFraction)
        add("texture_fraction_bits", "exact");
    else
        addNumber("texture_fraction_bits", profile.textureFractionBits);
    addName("texture_filter", profile.textureFilter);
    addName("texture_format", profile.filterRule.texels);
    addName("filter_position", profile.filterRule.position);
    addName("filter_weights", profile.filterRule.weights);
    addName("filter_sum", profile.filterRule.sum);
    addName("depth_bias_unit", profile.biasUnit);
    addName("volume_stencil", profile.volumeStencil);
    addArithmetic("environment", profile.environment);
    return fields;
}

std::string profileText(const Profile& profile) {
    const std::vector<ProfileField> fields = profileFields(profile);
    std::vector<std::string> lines;
    size_t width = 0;
    for (const ProfileField& field : fields) {
        lines.push_back(field.isNumber ? formatText("{} = {}", field.key, field.value)
                                       : formatText("{} = \"{}\"", field.key, field.value));
        width = std::max(width, lines.back().size());
    }
    std::string text = formatText("# {}: {}\n", profile.name, profile.meaning);
    for (size_t i = 0; i < fields.size(); i++) {
        const ProfileField& field = fields[i];
        std::string notes;
        if (!field.documented.empty()) notes = "documented: " + field.documented;
        if (!field.assumed.empty()) notes += (notes.empty() ? "assumed: " : "; assumed: ") + field.assumed;
        text += notes.empty() ? lines[i] + "\n" : formatText("{:{}}  # {}\n", lines[i], width, notes);
    }
    return text;
}

Json profilesJson(std::span<const Profile> profiles) {
    Json list = Json::list();
    for (const Profile& profile : profiles) {
        Json fields = Json::list();
        for (const ProfileField& field : profileFields(profile))
            fields.append({{"key", field.key},
                           {"value", field.isNumber ? Json(static_cast<int64_t>(std::stoll(field.value)))
                                                    : Json(field.value)},
                           {"documented", field.documented},
                           {"assumed", field.assumed}});
        list.append({{"name", profile.name}, {"meaning", profile.meaning}, {"fields", fields}});
    }
    return list;
}

}  // namespace etalon
