#include "scene/schema.h"

#include <algorithm>
#include <array>

#include "numeric/check.h"
#include "numeric/text.h"
#include "scene/outputs.h"
#include "scene/scene_parts.h"

namespace etalon {
namespace {

using Names = std::vector<std::string_view>;

constexpr const char* kRequired = "required";
constexpr NumberRange kDirectionRange = kCoordinateRange;

SchemaKey number(Names names, NumberRange range, std::string absent, std::string meaning) {
    return {std::move(names), KeyType::number, range, {}, "", std::move(absent), std::move(meaning), ""};
}
SchemaKey integer(Names names, int lo, int hi, std::string absent, std::string meaning) {
    return {std::move(names),
            KeyType::integer,
            {double(lo), double(hi)},
            {},
            "",
            std::move(absent),
            std::move(meaning),
            ""};
}
SchemaKey vector(Names names, NumberRange range, std::string absent, std::string meaning) {
    return {std::move(names), KeyType::triple, range, {}, "", std::move(absent), std::move(meaning), ""};
}
SchemaKey direction(Names names, std::string absent, std::string meaning) {
    SchemaKey key = vector(std::move(names), kDirectionRange, std::move(absent), std::move(meaning));
    key.rangeText = "direction";
    return key;
}
SchemaKey of(KeyType type, Names names, std::string range, std::string absent, std::string meaning) {
    return {std::move(names), type, {0, 0}, {}, std::move(range), std::move(absent), std::move(meaning), ""};
}
SchemaKey choiceOf(Names names, Names choices, std::string absent, std::string meaning) {
    return {std::move(names),  KeyType::choice,    {0, 0}, std::move(choices), "",
            std::move(absent), std::move(meaning), ""};
}
// Of an enumeration with names.
template <Named E>
SchemaKey choice(Names names, std::string absent, std::string meaning) {
    return choiceOf(std::move(names), {kNames<E>.begin(), kNames<E>.end()}, std::move(absent),
                    std::move(meaning));
}
template <Named E>
std::string code(E value) {
    return formatText("`{}`", nameOf(value));
}
// "1e9" and not "1e+09".
std::string text(double value) {
    std::string digits = formatText("{:g}", value);
    const size_t exponent = digits.find('e');
    if (exponent == std::string::npos) return digits;
    const bool isSmall = digits[exponent + 1] == '-';
    const size_t first = digits.find_first_not_of('0', exponent + 2);
    return formatText("{}e{}{}", digits.substr(0, exponent), isSmall ? "-" : "", digits.substr(first));
}

SchemaKey withRange(SchemaKey key, std::string range) {
    key.rangeText = std::move(range);
    return key;
}
SchemaKey ofKinds(SchemaKey key, std::string kinds) {
    key.kinds = std::move(kinds);
    return key;
}

std::vector<SchemaKey> transformKeys() {
    return {
        withRange(of(KeyType::factors, {"scale"}, "", "1", "negative factors mirror"),
                  "magnitude in " + rangeText({kMinScale, kMaxSceneNumber})),
        direction({"rotate_axis"}, "none", "turn about an axis, counter-clockwise; with `rotate_deg`"),
        number({"rotate_deg"}, kDegreesRange, "required with `rotate_axis`", "the angle of that turn"),
        vector({"rotate_xyz_deg"}, kDegreesRange, "none",
               "turns about X, then Y, then Z (fixed axes: Rz Ry Rx)"),
        vector({"translate"}, kCoordinateRange, "0 0 0", ""),
        of(KeyType::matrix, {"transform"}, "", "none", "instead of the keys above"),
    };
}

std::vector<SchemaKey> meshKeys() {
    const MeshObject mesh;
    std::vector<SchemaKey> keys = {
        of(KeyType::text, {"name"}, "not used by another object", "`mesh0`, `mesh1`, ...", ""),
        of(KeyType::text, {"file"}, "existing `.obj`, `.ply`, `.gltf`, `.glb`", kRequired, "see below"),
        of(KeyType::text, {"material"}, "a material's name", kRequired, ""),
    };
    for (SchemaKey& key : transformKeys()) keys.push_back(std::move(key));
    keys.push_back(of(KeyType::tables, {"instances"}, "at least one", "one, the identity",
                      "copies; each table holds transform keys, `scale` to `transform`"));
    keys.push_back(choiceOf({"sides"}, {"both", "front"}, mesh.twoSided ? "`both`" : "`front`",
                            "`front`: triangles seen from behind are not drawn"));
    keys.push_back(choice<Reflection>({"reflection"}, code(mesh.reflection),
                                      "what a mirror shows; with a material that has `reflectance` only"));
    keys.push_back(integer({"cube_size"}, 1, kMaxCubeSize, text(mesh.cubeSize),
                           "edge in texels of the cube map; with `reflection = \"scene\"` only"));
    return keys;
}

SchemaKey shadowKey(const char* meaning) {
    return choice<ShadowMethod>({"shadow"}, code(LightShadow{}.method), meaning);
}

std::vector<SchemaKey> mapKeys() {
    const ShadowMapSettings map = defaultShadowMap();
    return {
        integer(
            {"shadow_size"}, 1, kMaxShadowMapSize, text(map.size),
            "texels along an edge (of each face, for point lights and spot lights wider than 60 degrees)"),
        choice<ShadowDepth>({"shadow_depth"}, code(map.depth),
                            "what a texel holds: a depth, or the distance from the light (float)"),
        choice<ShadowFaces>({"shadow_faces"}, code(map.faces), "the faces that are drawn into the map"),
        number({"shadow_bias"}, kShadowBiasRange, text(map.bias.constant),
               "constant bias, in units of the format (`linear`: of 2^-20 of the distance)"),
        number({"shadow_slope_bias"}, kShadowBiasRange, text(map.bias.slopeScale),
               "bias per change of depth from texel to texel"),
        of(KeyType::boolean, {"shadow_receiver_plane"}, "", map.receiverPlane ? "`true`" : "`false`",
           "compare each texel with the depth of the point's plane there"),
        number({"shadow_normal_offset"}, {0, kMaxShadowRadius_texels}, text(map.normalOffset_texels),
               "texels that a point is moved along its normal, times the sine of the angle of incidence"),
        choice<ShadowReference>(
            {"shadow_reference"}, code(map.reference),
            "a point's depth is compared as a number limited to [0, 1], or as the integer that the "
            "format would store"),
        of(KeyType::boolean, {"shadow_snap"}, "", map.snap ? "`true`" : "`false`",
           "texels keep their places when the light moves (one layer; not for cubes)"),
        choice<ShadowFilter>(
            {"shadow_filter"}, code(map.filter),
            "one texel; a window with bilinear weights; points of a disc; a disc as wide as the "
            "light's half-shadow"),
        withRange(integer({"shadow_taps"}, 1, kMaxDiscTaps, formatText("{}; {}", map.taps, kDiscTaps),
                          "`pcf`: along an edge of the window; `disc`, `soft`: points. Not for `hard`"),
                  formatText("1 to {} (`pcf`), 1 to {}", kMaxWindowTaps, kMaxDiscTaps)),
        number({"shadow_radius_texels"}, {0, kMaxShadowRadius_texels},
               formatText("{}; {}", map.radius_texels, kSoftRadius_texels),
               "of the disc; the largest for `soft`. For `disc` and `soft` only"),
        number({"shadow_light_size_m"}, kNonNegativeRange, "required for `soft`, point and spot",
               "diameter of the light"),
        number({"shadow_light_deg"}, {0, kMaxLight_deg}, "required for `soft`, directional",
               "angle that the light subtends (the sun: 0.53)"),
    };
}

std::vector<SchemaKey> planarKeys() {
    const PlanarLightSettings planar;
    return {
        integer({"shadow_size"}, kMinPlanarResolution, kMaxPlanarResolution, text(planar.resolution),
                "most texels along an edge of a plane's shadow"),
        integer({"shadow_samples"}, 1, kMaxSceneLightSamples, text(planar.samples),
                "jittered points of the light (`seed`); 1: its centre"),
        number({"shadow_blur_m"}, kNonNegativeRange, text(planar.blurSigma_m),
               "standard deviation of the blur of the shadow, on the plane"),
        number({"shadow_light_size_m"}, kNonNegativeRange, text(planar.lightSize_m),
               "diameter of a point or spot light"),
        number({"shadow_light_deg"}, {0, kMaxLight_deg}, "0", "angle that a directional light subtends"),
    };
}

TableSchema makeTable(SceneTable table) {
    const Environment environment;
    const Render render;
    switch (table) {
        case SceneTable::scene:
            return {"the scene",
                    {of(KeyType::table, {"camera"}, "", kRequired, "the view"),
                     of(KeyType::table, {"environment"}, "", "black", "radiance from far away"),
                     vector({"ambient"}, kNonNegativeRange, "0 0 0",
                            "radiance from everywhere, seen by diffuse surfaces only"),
                     of(KeyType::material, {"material"}, "", "none", "the surfaces, by name"),
                     of(KeyType::tables, {"mesh"}, "", "none", "objects from mesh files"),
                     of(KeyType::tables, {"plane"}, "", "none", "rectangles"),
                     of(KeyType::tables, {"light"}, "", "none", "light sources, any number"),
                     of(KeyType::table, {"output"}, "", "beauty", "what is written"),
                     of(KeyType::table, {"render"}, "", "", "how it is computed")}};
        case SceneTable::camera:
            return {
                "[camera]",
                {integer({"width", "height"}, 1, kMaxImageSize, kRequired, "pixels"),
                 number({"fov_y_deg"}, {0, 180, true, true}, "required, or the next row",
                        "vertical field of view; square pixels, principal point in the middle"),
                 number({"fx", "fy"}, {1 / kMaxSceneNumber, kMaxSceneNumber}, "required, or `fov_y_deg`",
                        "focal lengths, pixels"),
                 number({"cx", "cy"}, kCoordinateRange, "with `fx`, `fy`",
                        "principal point, pixels; pixel centres at +0.5, row 0 on top"),
                 number({"near"}, {1 / kMaxSceneNumber, kMaxSceneNumber}, kRequired,
                        "clip distance along the view"),
                 withRange(number({"far"}, kPositiveRange, kRequired, "clip distance along the view"),
                           formatText("near < far <= {}", text(kMaxSceneNumber))),
                 withRange(vector({"position", "look_at"}, kCoordinateRange, "required, or `camera_to_world`",
                                  "the pose; the camera looks along its -Z"),
                           formatText("any, at least {} apart", text(kMinDirectionLength))),
                 direction({"up"}, "0 1 0",
                           "what is up in the image; not parallel to the view (sine at least 1e-6)"),
                 of(KeyType::matrix, {"camera_to_world"}, "rotation and translation", "",
                    "the pose instead of the three keys above")}};
        case SceneTable::environment:
            return {
                "[environment]",
                {of(KeyType::text, {"file"}, "existing file", "", "lat-long HDR image (OpenEXR, Radiance)"),
                 number({"intensity"}, kPositiveRange, text(environment.intensity),
                        "factor on the image's radiance; with `file` only"),
                 number({"rotation_deg"}, kDegreesRange, text(environment.rotation_deg),
                        "turn about +Y, counter-clockwise from above; with `file` only"),
                 vector({"constant"}, kNonNegativeRange, "", "the same radiance from all directions"),
                 choice<EnvironmentLightMethod>({"lighting"}, code(environment.lighting),
                                                "how it lights surfaces, besides being seen and mirrored"),
                 withRange(integer({"lights"}, 1, kMaxEnvironmentLights, text(environment.lightCount),
                                   "of `lights`: directional lights from a median cut"),
                           formatText("a power of two, 1 to {}", kMaxEnvironmentLights)),
                 integer({"map_size"}, 1, kMaxLightMapSize, text(environment.mapSize),
                         "of `map`, `blurred` and `blurred_normalised`: texels along a face of the cube map"),
                 shadowKey("of the lights of `lights` and `dominant`: see [shadows](#shadows)")}};
        case SceneTable::material:
            return {
                "[material.NAME]",
                {ofKinds(choice<MaterialKind>({"kind"}, kRequired, ""), "all"),
                 ofKinds(vector({"diffuse"}, kUnitRange, kRequired, "diffuse reflectance"),
                         "lambert, blinn_phong"),
                 ofKinds(vector({"specular"}, kUnitRange, kRequired, "specular reflectance"), "blinn_phong"),
                 ofKinds(number({"exponent"}, {1, kMaxExponent}, kRequired, "Blinn-Phong exponent"),
                         "blinn_phong"),
                 ofKinds(vector({"reflectance"}, kUnitRange, "required; 0 0 0", "mirror reflectance"),
                         "mirror; blinn_phong"),
                 ofKinds(vector({"checker"}, kUnitRange, "none", "second diffuse colour of a checkerboard"),
                         "lambert, blinn_phong"),
                 ofKinds(number({"checker_size_m"}, {kMinScale, kMaxSceneNumber}, "required with `checker`",
                                "edge of a square"),
                         "lambert, blinn_phong")}};
        case SceneTable::mesh:
            return {"[[mesh]]", meshKeys()};
        case SceneTable::transform:
            return {"an instance of [[mesh]]", transformKeys()};
        case SceneTable::plane:
            return {
                "[[plane]]",
                {of(KeyType::text, {"name"}, "not used by another object", "`plane0`, `plane1`, ...", ""),
                 vector({"point"}, kCoordinateRange, kRequired, "centre of the rectangle"),
                 direction({"normal"}, kRequired, "the side that is seen"),
                 {{"size_m"}, KeyType::pair, kPositiveRange, {}, "", kRequired, "extent along u and v", ""},
                 withRange(
                     vector({"u_axis"}, kDirectionRange, "+X; +Z where the unit normal's x is beyond +-0.9",
                            "made perpendicular to the normal; v = normal x u"),
                     "direction, not parallel to `normal` (sine at least 1e-6)"),
                 of(KeyType::text, {"material"}, "a material's name", kRequired, "")}};
        case SceneTable::light:
            return {
                "[[light]]",
                {choice<LightKind>({"kind"}, kRequired,
                                   "from infinitely far, from a place, in a cone from a place"),
                 direction({"direction"}, "required for directional, spot", "the way the light travels"),
                 vector({"irradiance"}, kNonNegativeRange, "required for directional",
                        "W/m^2 on a surface perpendicular to the light"),
                 vector({"position"}, kCoordinateRange, "required for point, spot", ""),
                 vector({"intensity"}, kNonNegativeRange, "required for point, spot",
                        "W/sr; irradiance is intensity / distance^2"),
                 number({"outer_deg"}, {kMinConeStep_deg, kMaxCone_deg}, "required for spot",
                        "from the direction to where the light ends"),
                 withRange(
                     number({"inner_deg"}, {0, kMaxCone_deg}, text(kDefaultInnerCone_deg),
                            "from the direction to where it begins to fall: 3 t^2 - 2 t^3, t linear in the "
                            "cosine"),
                     formatText("[0, `outer_deg` - {}]", kMinConeStep_deg)),
                 shadowKey("see [shadows](#shadows)")}};
        case SceneTable::shadowMap:
            return {"shadow = \"map\"", mapKeys()};
        case SceneTable::planarShadow:
            return {"shadow = \"planar\"", planarKeys()};
        case SceneTable::environmentShadow:
            return {
                "[environment] shadow",
                {integer({"shadow_lights"}, 1, kMaxShadowLights, text(environment.shadowLights),
                         "so many lights cast: those that stand for the smallest solid angles"),
                 number({"shadow_share"}, {0, 1, true}, "not used",
                        formatText(
                            "the lights cast that have at least this part of the energy of all, {} at most",
                            kMaxShadowLights))}};
        case SceneTable::output:
            return {"[output]",
                    {of(KeyType::list, {"images"},
                        formatText("`{}`; each once, at least one", joinText(outputNames(), "`, `")),
                        "`[\"beauty\"]`", "what is computed and written: [outputs](outputs.md)"),
                     choice<ToneMap>({"tone_map"}, code(Output{}.toneMap), "for PNG"),
                     number({"exposure"}, {-kMaxExposure, kMaxExposure}, text(Output{}.exposure),
                            "stops, before tone mapping; for PNG")}};
        case SceneTable::render:
            return {"[render]",
                    {withRange(integer({"samples"}, 1, 16, text(render.samples), "per pixel"), "1, 4, 16"),
                     of(KeyType::text, {"profile"},
                        formatText("`{}`; or a file that ends in `.toml`, relative to the scene file",
                                   joinText(profileNames(), "`, `")),
                        formatText("`{}`", render.profile.name), "the arithmetic: [profiles](profiles.md)"),
                     choice<Origin>(
                         {"origin"}, code(render.origin),
                         "what positions are relative to in the profile's arithmetic: `world` rounds large "
                         "coordinates, `eye` makes them relative to the camera in double first"),
                     choiceOf({"lighting"}, {"per_pixel", "per_vertex"},
                              render.perVertex ? "`per_vertex`" : "`per_pixel`",
                              "where lights are evaluated: Phong or Gouraud shading"),
                     integer({"occlusion"}, 0, kMaxOcclusionDirections, text(render.occlusionDirections),
                             "directions from which it is found what surfaces see of their surroundings; 0: "
                             "everything"),
                     integer({"occlusion_size"}, 1, kMaxOcclusionMapSize, text(render.occlusionMapSize),
                             "texels along an edge of the depth map of each of these directions, which holds "
                             "the whole "
                             "scene"),
                     integer({"reflections"}, 1, kMaxReflections, text(render.reflections),
                             "of mirrors with `reflection = \"scene\"` in each other; behind the last one "
                             "they show the "
                             "environment"),
                     of(KeyType::integer, {"seed"}, "0 to 2^63 - 1", formatText("{}", render.seed),
                        "for random choices")}};
    }
    return {};
}

constexpr size_t kTables = static_cast<size_t>(SceneTable::render) + 1;

std::string typeText(const SchemaKey& key) {
    switch (key.type) {
        case KeyType::number:
            return "n";
        case KeyType::integer:
            return "i";
        case KeyType::text:
        case KeyType::choice:
            return "s";
        case KeyType::boolean:
            return "b";
        case KeyType::triple:
            return "v";
        case KeyType::pair:
            return "array of 2 n";
        case KeyType::factors:
            return "n or v";
        case KeyType::matrix:
            return "M";
        case KeyType::list:
            return "array of s";
        case KeyType::table:
            return "table";
        case KeyType::tables:
            return key.names[0] == "instances" ? "array of tables" : formatText("`[[{}]]`", key.names[0]);
        case KeyType::material:
            return formatText("tables `[{}.NAME]`", key.names[0]);
    }
    return "";
}

std::string rangeOf(const SchemaKey& key) {
    if (!key.rangeText.empty()) return key.rangeText;
    const NumberRange& r = key.range;
    switch (key.type) {
        case KeyType::choice:
            return formatText("`{}`", joinText(key.choices, "`, `"));
        case KeyType::boolean:
            return "`true`, `false`";
        case KeyType::integer:
            return formatText("{} to {}", static_cast<int64_t>(r.lo), static_cast<int64_t>(r.hi));
        case KeyType::number:
        case KeyType::triple:
        case KeyType::pair:
            if (r.hi == kMaxSceneNumber && r.lo == -r.hi) return "any";
            return formatText("{}{}", rangeText(r), key.type == KeyType::number ? "" : " each");
        default:
            return "";
    }
}

std::string cell(const std::string& value) { return value.empty() ? " " : formatText(" {} ", value); }

}  // namespace

std::string rangeText(const NumberRange& r) {
    return formatText("{}{}, {}{}", r.loOpen ? '(' : '[', text(r.lo), text(r.hi), r.hiOpen ? ')' : ']');
}

const SchemaKey* TableSchema::find(std::string_view key) const {
    for (const SchemaKey& of : keys)
        if (std::ranges::find(of.names, key) != of.names.end()) return &of;
    return nullptr;
}

std::vector<std::string_view> TableSchema::keyNames() const {
    std::vector<std::string_view> names;
    for (const SchemaKey& key : keys) names.insert(names.end(), key.names.begin(), key.names.end());
    return names;
}

const TableSchema& schemaOf(SceneTable table) {
    static const std::array<TableSchema, kTables> tables = [] {
        std::array<TableSchema, kTables> made;
        for (size_t i = 0; i < kTables; i++) made[i] = makeTable(static_cast<SceneTable>(i));
        return made;
    }();
    return tables[static_cast<size_t>(table)];
}

std::string schemaText() {
    std::string all;
    for (size_t i = 0; i < kTables; i++) {
        if (static_cast<SceneTable>(i) == SceneTable::transform) continue;
        const TableSchema& table = schemaOf(static_cast<SceneTable>(i));
        const bool hasKinds = static_cast<SceneTable>(i) == SceneTable::material;
        all += formatText(
            "<!-- schema: {} -->\n| key | type | range | default | meaning |{}\n|---|---|---|---|---|{}\n",
            table.name, hasKinds ? " kinds |" : "", hasKinds ? "---|" : "");
        for (const SchemaKey& key : table.keys)
            all += formatText("| `{}` |{}|{}|{}|{}|{}\n", joinText(key.names, "`, `"), cell(typeText(key)),
                              cell(rangeOf(key)), cell(key.absent), cell(key.meaning),
                              hasKinds ? cell(key.kinds) + "|" : "");
        all += "<!-- end -->\n";
    }
    return all;
}

}  // namespace etalon
