#include "scene/profile_file.h"

#include "numeric/check.h"
#include "numeric/format_names.h"
#include "numeric/text.h"
#include "raster/names.h"
#include "scene/toml_reader.h"

namespace etalon {
namespace {

// Replaces the value if the key is there.
template <Named E>
void read(const TableReader& reader, std::string_view key, E& value) {
    value = reader.member(key, value);
}
void read(const TableReader& reader, std::string_view key, int lo, int hi, int& value) {
    if (reader.has(key)) value = static_cast<int>(reader.integer(key, lo, hi));
}

// The table `key` of a format's fields; what it leaves out is as in `format`.
Format readFormat(const std::string& file, std::string_view key, const TomlValue& value, Format format) {
    const TableReader reader(file, value, formatText("[{}]", key),
                             {"format", "significand_bits", "min_exponent", "max_exponent", "rounding",
                              "subnormals", "overflow", "division", "power", "seed"});
    if (reader.has("format")) {
        std::vector<std::string_view> names;
        for (const NamedFormat& named : namedFormats()) names.push_back(named.name);
        const std::string given = reader.choice("format", names);
        for (const NamedFormat& named : namedFormats())
            if (named.name == given) format = named.format;
    }
    read(reader, "significand_bits", 2, kMaxSignificandBits, format.significandBits);
    read(reader, "min_exponent", -kMaxFormatExponent, 0, format.minExponent);
    read(reader, "max_exponent", 0, kMaxFormatExponent, format.maxExponent);
    read(reader, "rounding", format.rounding);
    read(reader, "subnormals", format.subnormals);
    read(reader, "overflow", format.overflow);
    read(reader, "division", format.division);
    read(reader, "power", format.power);
    if (format.rounding != Rounding::stochastic)
        reader.forbid("seed", "needs rounding = \"stochastic\" beside it");
    if (reader.has("seed")) format.seed = static_cast<uint64_t>(reader.integer("seed", 0, INT64_MAX));
    // Whole numbers up to the format's digits are numbers of it.
    if (format.maxExponent < format.significandBits - 1)
        reader.failKey("max_exponent",
                       formatText("must be at least {} for {} significand bits, not {}",
                                  format.significandBits - 1, format.significandBits, format.maxExponent));
    if (!isSupported(format))
        reader.fail(reader.line(), formatText("the format in [{}] cannot be emulated: {}", key,
                                              arithmeticName(Arithmetic(format))));
    return format;
}

// The name of an arithmetic, or a table; `base` if the key is not there.
Arithmetic readArithmetic(const TableReader& reader, std::string_view key, const Arithmetic& base) {
    if (!reader.has(key)) return base;
    const TomlValue& value = reader.value(key);
    if (value.kind == TomlKind::table)
        return Arithmetic(readFormat(reader.file(), key, value, base.format.value_or(kFp32)));
    if (value.kind != TomlKind::string)
        reader.failKey(key, "must be the name of an arithmetic or a table of a format's fields");
    std::vector<std::string_view> names = {"truth", "fp64"};
    for (const NamedFormat& named : namedFormats()) names.push_back(named.name);
    const std::string given = reader.choice(key, names);
    if (given == "truth") return Arithmetic::truth;
    if (given == "fp64") return Arithmetic::fp64;
    if (given == "fp32") return Arithmetic::fp32;
    for (const NamedFormat& named : namedFormats())
        if (named.name == given) return Arithmetic(named.format);
    return base;
}

// A filter's rules that do not go together, at the key that asks for them or, where its base does, at another one.
void checkFilter(const TableReader& reader, const Profile& profile) {
    constexpr int kEnough = 53;  // double and truth
    const int bits = profile.fragment.format                       ? profile.fragment.format->significandBits
                     : profile.fragment.type() == NumberType::fp32 ? kFp32.significandBits
                                                                   : kEnough;
    const FilterFault fault = filterFault(profile.filterRule, profile.textureFractionBits, bits);
    if (fault.field.empty()) return;
    for (const std::string_view key : {fault.field, std::string_view("texture_fraction_bits"),
                                       std::string_view("filter_weights"), std::string_view("fragment")})
        if (reader.has(key))
            reader.failKey(key, formatText("does not go with {}: {}", fault.field, fault.reason));
}

}  // namespace

bool isProfileFile(std::string_view nameOrFile) { return nameOrFile.ends_with(".toml"); }

Profile readProfileFile(const std::filesystem::path& path) {
    const TomlValue document = readToml(path, "profile file");
    const std::string file = path.string();
    const TableReader reader(
        file, document, "the profile",
        {"base", "fragment", "vertex", "depth", "depth_rounding", "depth_order", "depth_direction",
         "subpixel_bits", "texture_fraction_bits", "texture_filter", "texture_format", "filter_position",
         "filter_weights", "filter_sum", "environment", "depth_bias_unit", "volume_stencil"});
    const std::string base = reader.has("base") ? reader.choice("base", profileNames()) : "f32";
    Profile profile = *findProfile(base);
    profile.name = path.filename().string();
    profile.meaning = formatText("composed in a file from {}", base);
    profile.fragment = readArithmetic(reader, "fragment", profile.fragment);
    read(reader, "vertex", profile.vertex);
    read(reader, "depth", profile.depth);
    read(reader, "depth_rounding", profile.depthRounding);
    read(reader, "depth_direction", profile.depthDirection);
    const bool hasDoubleDepths = profile.depth == DepthFormat::d64f && profile.vertex == RasterReal::fp64;
    if (!hasDoubleDepths) profile.depthOrder = DepthOrder::stored;
    read(reader, "depth_order", profile.depthOrder);
    if (profile.depthOrder == DepthOrder::exact && !hasDoubleDepths)
        reader.failKey("depth_order", "is exact for depth = \"d64f\" with vertex = \"fp64\" only");
    read(reader, "subpixel_bits", 4, 8, profile.subpixelBits);
    if (reader.has("texture_fraction_bits")) {
        constexpr std::string_view kExact[] = {"exact"};
        if (reader.value("texture_fraction_bits").kind == TomlKind::string) {
            reader.choice("texture_fraction_bits", kExact);
            profile.textureFractionBits = kExactFraction;
        } else {
            read(reader, "texture_fraction_bits", 0, kMaxFractionBits, profile.textureFractionBits);
        }
    }
    read(reader, "texture_filter", profile.textureFilter);
    read(reader, "texture_format", profile.filterRule.texels);
    read(reader, "filter_position", profile.filterRule.position);
    read(reader, "filter_weights", profile.filterRule.weights);
    read(reader, "filter_sum", profile.filterRule.sum);
    profile.environment = readArithmetic(reader, "environment", profile.environment);
    read(reader, "depth_bias_unit", profile.biasUnit);
    read(reader, "volume_stencil", profile.volumeStencil);
    checkFilter(reader, profile);
    return profile;
}

Profile loadProfile(const std::string& nameOrFile) {
    if (isProfileFile(nameOrFile)) return readProfileFile(nameOrFile);
    if (const Profile* named = findProfile(nameOrFile)) return *named;
    const std::vector<std::string_view> names = profileNames();
    throw InputError(formatText("profile '{}' is neither one of {} nor a file that ends in .toml{}",
                                printable(nameOrFile), joined(names), nearestHint(nameOrFile, names)));
}

}  // namespace etalon
