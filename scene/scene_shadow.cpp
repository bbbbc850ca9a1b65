// How the shadows of a light are made: the keys that begin with "shadow".
#include <span>

#include "numeric/transform.h"
#include "scene/scene_parts.h"

namespace etalon {
namespace {

// Forbids the keys of a table that the other one has too (isCommon), or that it does not have.
void forbidKeys(const TableReader& reader, SceneTable table, SceneTable other, bool isCommon,
                std::string_view reason) {
    for (const std::string_view key : schemaOf(table).keyNames())
        if ((schemaOf(other).find(key) != nullptr) == isCommon) reader.forbid(key, reason);
}
void forbidMapKeys(const TableReader& reader) {
    forbidKeys(reader, SceneTable::shadowMap, SceneTable::planarShadow, false, "needs shadow = \"map\"");
}
void forbidPlanarKeys(const TableReader& reader) {
    forbidKeys(reader, SceneTable::planarShadow, SceneTable::shadowMap, false, "needs shadow = \"planar\"");
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
    const SinCos half = sinCosOfDegrees(reader.number("shadow_light_deg") / 2);
    return half.sin / half.cos;
}

ShadowMapSettings readMap(const TableReader& table, LightKind kind) {
    const TableReader reader = table.in(SceneTable::shadowMap);
    forbidPlanarKeys(reader);
    ShadowMapSettings map = defaultShadowMap();
    if (reader.has("shadow_size")) map.size = reader.integer("shadow_size");
    map.depth = reader.member("shadow_depth", map.depth);
    map.faces = reader.member("shadow_faces", map.faces);
    if (reader.has("shadow_bias")) map.bias.constant = reader.number("shadow_bias");
    if (reader.has("shadow_slope_bias")) map.bias.slopeScale = reader.number("shadow_slope_bias");
    if (reader.has("shadow_receiver_plane")) map.receiverPlane = reader.boolean("shadow_receiver_plane");
    if (reader.has("shadow_normal_offset")) map.normalOffset_texels = reader.number("shadow_normal_offset");
    map.reference = reader.member("shadow_reference", map.reference);
    if (reader.has("shadow_snap")) map.snap = reader.boolean("shadow_snap");
    map.filter = reader.member("shadow_filter", map.filter);
    const bool isDisc = map.filter == ShadowFilter::disc, isSoft = map.filter == ShadowFilter::soft;
    if (map.filter == ShadowFilter::hard) reader.forbid("shadow_taps", "is not used by shadow_filter 'hard'");
    if (isDisc || isSoft) map.taps = kDiscTaps;
    if (reader.has("shadow_taps"))
        map.taps = static_cast<int>(
            reader.integer("shadow_taps", 1, isDisc || isSoft ? kMaxDiscTaps : kMaxWindowTaps));
    if (!isDisc && !isSoft)
        reader.forbid("shadow_radius_texels", "needs shadow_filter = \"disc\" or \"soft\"");
    if (isSoft) map.radius_texels = kSoftRadius_texels;
    if (reader.has("shadow_radius_texels")) map.radius_texels = reader.number("shadow_radius_texels");
    forbidOtherSize(reader, kind);
    if (!isSoft) {
        for (const char* key : {"shadow_light_size_m", "shadow_light_deg"})
            reader.forbid(key, "needs shadow_filter = \"soft\"");
    } else if (kind == LightKind::directional) {
        map.tangentOfHalfAngle = tangentOfHalfAngle(reader);
    } else {
        map.lightSize_m = reader.number("shadow_light_size_m");
    }
    return map;
}

PlanarLightSettings readPlanar(const TableReader& table, LightKind kind) {
    const TableReader reader = table.in(SceneTable::planarShadow);
    forbidMapKeys(reader);
    PlanarLightSettings planar;
    if (reader.has("shadow_size")) planar.resolution = reader.integer("shadow_size");
    if (reader.has("shadow_samples")) planar.samples = reader.integer("shadow_samples");
    if (reader.has("shadow_blur_m")) planar.blurSigma_m = reader.number("shadow_blur_m");
    forbidOtherSize(reader, kind);
    if (reader.has("shadow_light_deg")) planar.tangentOfHalfAngle = tangentOfHalfAngle(reader);
    if (reader.has("shadow_light_size_m")) planar.lightSize_m = reader.number("shadow_light_size_m");
    return planar;
}

}  // namespace

LightShadow readShadow(const TableReader& reader, LightKind kind) {
    LightShadow shadow;
    shadow.method = reader.member("shadow", shadow.method);
    if (shadow.method == ShadowMethod::map) {
        shadow.map = readMap(reader, kind);
    } else if (shadow.method == ShadowMethod::planar) {
        shadow.planar = readPlanar(reader, kind);
    } else {
        forbidMapKeys(reader);
        forbidPlanarKeys(reader);
        forbidKeys(reader, SceneTable::shadowMap, SceneTable::planarShadow, true,
                   "needs shadow = \"map\" or \"planar\"");
    }
    return shadow;
}

}  // namespace etalon
