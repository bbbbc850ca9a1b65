// How the shadows of a light are made: the keys that begin with "shadow".
#include <algorithm>
#include <span>

#include "numeric/transform.h"
#include "scene/scene_parts.h"

namespace etalon {
namespace {

// Keys of one method alone, and of more than one.
constexpr std::string_view kMapKeys[] = {
    "shadow_depth",          "shadow_faces",     "shadow_bias", "shadow_slope_bias",
    "shadow_receiver_plane", "shadow_filter",    "shadow_taps", "shadow_radius_texels",
    "shadow_normal_offset",  "shadow_reference", "shadow_snap"};
constexpr std::string_view kPlanarKeys[] = {"shadow_samples", "shadow_blur_m"};
constexpr std::string_view kCommonKeys[] = {"shadow_size", "shadow_light_size_m", "shadow_light_deg"};

void forbid(const TableReader& reader, std::span<const std::string_view> keys, std::string_view reason) {
    for (const std::string_view key : keys) reader.forbid(key, reason);
}

// The size of a light belongs to its kind.
void forbidOtherSize(const TableReader& reader, LightKind kind) {
    if (kind == LightKind::directional)
        reader.forbid("shadow_light_size_m", "is not used by directional lights");
    else
        reader.forbid("shadow_light_deg", "is used by directional lights alone");
}

// Of half the angle that a light subtends.
double tangentOfHalfAngle(const TableReader& reader) {
    const SinCos half = sinCosOfDegrees(reader.number("shadow_light_deg", {0, kMaxLight_deg}) / 2);
    return half.sin / half.cos;
}

ShadowMapSettings readMap(const TableReader& reader, LightKind kind) {
    constexpr std::string_view kDepths[] = {"d16", "d24", "d32f", "linear"};
    constexpr std::string_view kFaces[] = {"both", "front", "back"};
    constexpr std::string_view kFilters[] = {"hard", "pcf", "disc", "soft"};
    constexpr std::string_view kReferences[] = {"clamped", "quantised"};
    const auto indexOf = [&](std::string_view key, std::span<const std::string_view> names, auto fallback) {
        if (!reader.has(key)) return fallback;
        const std::string name = reader.choice(key, names);
        return static_cast<decltype(fallback)>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    forbid(reader, kPlanarKeys, "needs shadow = \"planar\"");
    ShadowMapSettings map = defaultShadowMap();
    if (reader.has("shadow_size"))
        map.size = static_cast<int>(reader.integer("shadow_size", 1, kMaxShadowMapSize));
    map.depth = indexOf("shadow_depth", kDepths, map.depth);
    map.faces = indexOf("shadow_faces", kFaces, map.faces);
    if (reader.has("shadow_bias")) map.bias.constant = reader.number("shadow_bias", kShadowBiasRange);
    if (reader.has("shadow_slope_bias"))
        map.bias.slopeScale = reader.number("shadow_slope_bias", kShadowBiasRange);
    if (reader.has("shadow_receiver_plane")) map.receiverPlane = reader.boolean("shadow_receiver_plane");
    if (reader.has("shadow_normal_offset"))
        map.normalOffset_texels = reader.number("shadow_normal_offset", {0, kMaxShadowRadius_texels});
    map.reference = indexOf("shadow_reference", kReferences, map.reference);
    if (reader.has("shadow_snap")) map.snap = reader.boolean("shadow_snap");
    map.filter = indexOf("shadow_filter", kFilters, map.filter);
    const bool isDisc = map.filter == ShadowFilter::disc, isSoft = map.filter == ShadowFilter::soft;
    if (map.filter == ShadowFilter::hard) reader.forbid("shadow_taps", "is not used by shadow_filter 'hard'");
    if (isDisc || isSoft) map.taps = kDiscTaps;
    if (reader.has("shadow_taps"))
        map.taps = static_cast<int>(
            reader.integer("shadow_taps", 1, isDisc || isSoft ? kMaxDiscTaps : kMaxWindowTaps));
    if (!isDisc && !isSoft)
        reader.forbid("shadow_radius_texels", "needs shadow_filter = \"disc\" or \"soft\"");
    if (isSoft) map.radius_texels = kSoftRadius_texels;
    if (reader.has("shadow_radius_texels"))
        map.radius_texels = reader.number("shadow_radius_texels", {0, kMaxShadowRadius_texels});
    forbidOtherSize(reader, kind);
    if (!isSoft) {
        for (const char* key : {"shadow_light_size_m", "shadow_light_deg"})
            reader.forbid(key, "needs shadow_filter = \"soft\"");
    } else if (kind == LightKind::directional) {
        map.tangentOfHalfAngle = tangentOfHalfAngle(reader);
    } else {
        map.lightSize_m = reader.number("shadow_light_size_m", kNonNegativeRange);
    }
    return map;
}

PlanarLightSettings readPlanar(const TableReader& reader, LightKind kind) {
    forbid(reader, kMapKeys, "needs shadow = \"map\"");
    PlanarLightSettings planar;
    if (reader.has("shadow_size"))
        planar.resolution =
            static_cast<int>(reader.integer("shadow_size", kMinPlanarResolution, kMaxPlanarResolution));
    if (reader.has("shadow_samples"))
        planar.samples = static_cast<int>(reader.integer("shadow_samples", 1, kMaxSceneLightSamples));
    if (reader.has("shadow_blur_m")) planar.blurSigma_m = reader.number("shadow_blur_m", kNonNegativeRange);
    forbidOtherSize(reader, kind);
    if (reader.has("shadow_light_deg")) planar.tangentOfHalfAngle = tangentOfHalfAngle(reader);
    if (reader.has("shadow_light_size_m"))
        planar.lightSize_m = reader.number("shadow_light_size_m", kNonNegativeRange);
    return planar;
}

}  // namespace

LightShadow readShadow(const TableReader& reader, LightKind kind) {
    constexpr std::string_view kMethods[] = {"none", "map", "volume", "planar"};
    LightShadow shadow;
    if (reader.has("shadow")) {
        const std::string name = reader.choice("shadow", kMethods);
        shadow.method = static_cast<ShadowMethod>(std::ranges::find(kMethods, name) - std::begin(kMethods));
    }
    if (shadow.method == ShadowMethod::map) {
        shadow.map = readMap(reader, kind);
    } else if (shadow.method == ShadowMethod::planar) {
        shadow.planar = readPlanar(reader, kind);
    } else {
        forbid(reader, kMapKeys, "needs shadow = \"map\"");
        forbid(reader, kPlanarKeys, "needs shadow = \"planar\"");
        forbid(reader, kCommonKeys, "needs shadow = \"map\" or \"planar\"");
    }
    return shadow;
}

}  // namespace etalon
