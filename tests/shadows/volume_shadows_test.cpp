#include "shadows/volume_shadows.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "bitcheck/inputs.h"
#include "numeric/check.h"
#include "shadows/exact_side.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shadow_meshes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(dot(v, v)); }

View lookingAt(const glm::dvec3& eye, const glm::dvec3& target, int width = 160, int height = 120,
               double near_m = 0.1) {
    PinholeCamera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 0.9 * width;
    camera.cx = width / 2.0;
    camera.cy = height / 2.0;
    camera.position = eye;
    camera.backward = unit(eye - target);
    camera.right = unit(cross({0, 1, 0}, camera.backward));
    camera.up = cross(camera.backward, camera.right);
    camera.near_m = near_m;
    return cameraView(camera);
}

SurfaceLight pointLight(const glm::dvec3& position) {
    SurfaceLight light;
    light.kind = LightKind::point;
    light.position_m = position;
    light.intensity = glm::dvec3(1);
    return light;
}
SurfaceLight sun(const glm::dvec3& towards) {
    SurfaceLight light;
    light.toLight = unit(towards);
    light.irradiance = glm::dvec3(1);
    return light;
}

// A ground of 20 m x 20 m and casters over it.
SurfaceScene sceneWith(std::initializer_list<SurfaceMesh> casters) {
    SurfaceScene scene;
    addObject(scene, rectangle({0, 0, 0}, {0, 0, 10}, {10, 0, 0}), lambertian(0.5));
    for (const SurfaceMesh& mesh : casters) addObject(scene, mesh, lambertian(0.5));
    return scene;
}

struct Comparison {
    int samples = 0;  // that show a triangle
    int shadowed = 0;
    int falseShadow = 0, falseLight = 0;  // away from a border of the true shadow
    int atBorders = 0;                    // different, and the truth changes within the tolerance
    VolumeShadowStatistics statistics;
};

// The masks of all lights against the oracle, at pixel centres. `border_px`: how far beside the centre the
// truth may change.
Comparison compareWithOracle(const SurfaceScene& scene, const View& view,
                             const VolumeShadowOptions& options = {}, double border_px = 1.0 / 64,
                             const Profile& profile = profiles()[0]) {
    const RasterOptions raster{1, 64, false};
    const auto placed = placeMeshes(scene, profile.vertex, 1);
    const VolumeShadows shadows(scene, placed, view, profile, options, raster);
    const VisibleScene visible = findVisible(scene, placed, withInfiniteFar(view), profile, 1, raster);
    const VisibilityOracle oracle(worldTriangles(placed));
    Comparison result;
    result.statistics = shadows.statistics();
    for (size_t l = 0; l < scene.lights.size(); l++)
        for (int y = 0; y < view.height; y++)
            for (int x = 0; x < view.width; x++) {
                const uint32_t id = visible.target.id.at(x, y);
                if (id == kNoTriangle) continue;
                const auto& stored = visible.target.triangles[id];
                const TriangleName name = {visible.instanceOfDraw[stored.draw], stored.triangle};
                const uint32_t* index = &placed[name.instance].mesh->indices[3 * size_t{name.triangle}];
                const auto& positions = placed[name.instance].positions;
                const LightSource light = lightSourceOf(scene.lights[l]);
                const auto side = [&](const LightSource& from) {
                    const glm::dvec3 &p = positions[index[0]], &q = positions[index[1]],
                                     &r = positions[index[2]];
                    return from.atInfinity ? sideOfTriangleTowards(p, q, r, from.place)
                                           : sideOfTriangle(p, q, r, from.place);
                };
                // Seen edge-on, no surface receives light; seen from its other side, it is in its own shadow.
                if (side(light) == 0) continue;
                const bool isSeenLit = side(light) == side({view.eye, false});
                const glm::dvec3 a = positions[index[0]],
                                 normal = cross(positions[index[1]] - a, positions[index[2]] - a);
                // On the triangle's plane along the ray through a place beside the centre.
                const auto truth = [&](double dx, double dy) {
                    const glm::dvec3 ray = view.forward + (x + 0.5 + dx - view.centreX_px) * view.perX +
                                           (y + 0.5 + dy - view.centreY_px) * view.perY;
                    const glm::dvec3 p = view.eye + (dot(a - view.eye, normal) / dot(ray, normal)) * ray;
                    return isSeenLit && oracle.isVisible(p, light, name);
                };
                const bool expected = truth(0, 0);
                const bool lit = shadows.mask(l).empty() || shadows.mask(l).at(x, y) == 1;
                result.samples++;
                result.shadowed += expected ? 0 : 1;
                if (lit == expected) continue;
                bool isBorder = false;
                for (const auto& [dx, dy] :
                     {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)})
                    isBorder = isBorder || truth(dx * border_px, dy * border_px) != expected;
                (isBorder ? result.atBorders : lit ? result.falseLight : result.falseShadow)++;
            }
    return result;
}

const View kView = lookingAt({3, 4, 6}, {0, 0.5, 0});

// Every sample is the oracle's, but for those whose centre is at most 1/64 of a pixel beside a border of the
// shadow (vertices are snapped to 1/256): few. Farther from a border are fewer, where a side grazes a surface
// and the subpixel moves their intersection by much. At least `shadowed` samples are in shadow.
constexpr double kBorderFraction = 5e-4, kGrazingFraction = 1e-4;

void checkAgainstOracle(const Comparison& c, int shadowed) {
    CHECK(c.falseShadow + c.falseLight <= kGrazingFraction * c.samples);
    CHECK(c.atBorders <= kBorderFraction * c.samples);
    CHECK(c.shadowed >= shadowed);
    CHECK(c.samples > c.shadowed);
}

}  // namespace

TEST_CASE("ShadowsOfClosedMeshesAreTheOracles") {
    SurfaceScene scene =
        sceneWith({torusKnotMesh(96, 16, {.tube_m = 0.2}), solidBox({1.5, 0.5, -1.5}, {0.4f, 0.5f, 0.3f})});
    scene.instances[1].toWorld[3][1] = 1.2;
    scene.lights = {pointLight({2, 5, 1}), sun({1, 2, 1})};
    const Comparison c = compareWithOracle(scene, kView);
    checkAgainstOracle(c, 2000);
    CHECK(c.statistics.openEdges == 4);  // the ground's
}

TEST_CASE("ShadowsOfOpenAndCrowdedMeshesAreTheOracles") {
    SurfaceMesh pages = rectangle({-1, 1, 0}, {0.5f, 0, 0}, {0, 0.6f, 0.2f});
    // Two more pages at the diagonal, one of them turned, and a loose triangle through the first.
    pages.positions.insert(pages.positions.end(), {{-0.9f, 1.2f, 1}, {-1.3f, 1.5f, -0.8f}, {0, 0.6f, -0.9f}});
    pages.normals.resize(pages.positions.size(), glm::vec3(0, 1, 0));
    pages.indices.insert(pages.indices.end(), {0, 2, 4, 0, 2, 5, 1, 6, 4});
    SurfaceScene scene = sceneWith({pages, rectangle({1, 1, 0}, {0.6f, 0.1f, 0}, {0, 0.3f, 0.7f})});
    scene.lights = {pointLight({0.5, 4, 0.5}), sun({-1, 2, 0.5}), pointLight({-3, 1.1, 2})};
    const Comparison c = compareWithOracle(scene, kView);
    checkAgainstOracle(c, 3000);
    CHECK(c.statistics.crowdedEdges == 1);
}

TEST_CASE("AnySoupOfTrianglesCastsItsShadow") {
    RandomNumbers random(7);
    SurfaceMesh soup;
    for (int i = 0; i < 90; i++) {
        glm::vec3 p;
        for (int k = 0; k < 3; k++) p[k] = static_cast<float>(random.uniform(-1, 1));
        soup.positions.push_back(p + glm::vec3(0, 1.2f, 0));
        soup.normals.emplace_back(0, 1, 0);
    }
    // Triangles share vertices at random.
    for (int i = 0; i < 180; i++) soup.indices.push_back(static_cast<uint32_t>(random.below(90)));
    SurfaceScene scene = sceneWith({soup});
    scene.lights = {pointLight({0.5, 4, 0.5}), pointLight({0.1, 1, 0}), sun({-1, 2, 0.5})};
    const Comparison c = compareWithOracle(scene, kView);
    checkAgainstOracle(c, 18000);
}

TEST_CASE("LightInsideAMeshShadowsEverythingOutside") {
    for (const int turned : {0, 1}) {
        SurfaceScene scene = sceneWith({sphere(24, 12, {0, 1.5f, 0}, 0.5f)});
        if (turned == 1)
            for (size_t i = 0; i < scene.meshes[1].indices.size(); i += 3)
                std::swap(scene.meshes[1].indices[i], scene.meshes[1].indices[i + 1]);
        scene.lights = {pointLight({0.1, 1.6, 0})};
        const Comparison c = compareWithOracle(scene, kView);
        CHECK(c.shadowed == c.samples);
        CHECK(c.falseLight + c.atBorders == 0);
        // And seen from inside, with a small sphere in the way.
        SurfaceScene inside = sceneWith({sphere(24, 12, {0, 2, 0}, 1.5f), sphere(8, 5, {0, 2, -0.3f}, 0.2f)});
        inside.lights = {pointLight({0, 2.2, 0.4})};
        checkAgainstOracle(compareWithOracle(inside, lookingAt({0.2, 2, 1}, {0, 1.8, 0})), 2000);
    }
}

TEST_CASE("EyeInsideAVolumeIsRightWithZFailAndShiftedWithZPass") {
    SurfaceScene scene =
        sceneWith({solidBox({0, 3, 0}, {1, 0.1f, 1}), solidBox({0.3f, 0.5f, 0.2f}, {0.2f, 0.3f, 0.2f})});
    scene.lights = {pointLight({0, 5, 0})};
    VolumeShadowOptions pass;
    pass.counting = VolumeCounting::zPass;
    const View inside = lookingAt({0.5, 1.5, 1.2}, {0, 0, -1});
    checkAgainstOracle(compareWithOracle(scene, inside), 14000);
    const Comparison shifted = compareWithOracle(scene, inside, pass);
    CHECK(shifted.falseLight > 10000);
    CHECK(shifted.falseShadow > 4000);
    const View outside = lookingAt({3, 2, 6}, {0, 0, 0});
    checkAgainstOracle(compareWithOracle(scene, outside), 4500);
    checkAgainstOracle(compareWithOracle(scene, outside, pass), 4500);
}

TEST_CASE("CasterThroughTheNearPlaneCastsItsWholeShadow") {
    // A long bar through the eye's near plane, and one that contains the eye's surroundings behind it.
    SurfaceScene scene =
        sceneWith({solidBox({0, 1.2f, 3}, {0.1f, 0.1f, 4}), rectangle({0, 2, 2}, {0.5f, 0, 0}, {0, 0, 4})});
    scene.lights = {pointLight({1, 5, 1}), sun({0.3, 1, 0.2})};
    const View view = lookingAt({0.3, 1.5, 3}, {0, 0.5, 0}, 160, 120, 0.5);
    checkAgainstOracle(compareWithOracle(scene, view), 13000);
}

TEST_CASE("CasterBehindTheLightCastsNothing") {
    SurfaceScene scene = sceneWith({solidBox({0, 4, 0}, {1, 0.1f, 1})});
    scene.lights = {pointLight({0, 3, 0})};
    const Comparison c = compareWithOracle(scene, kView);
    checkAgainstOracle(c, 0);
}

TEST_CASE("LightInTheReceiversPlaneAndJustAboveIt") {
    SurfaceScene scene = sceneWith({solidBox({0, 0.5f, 0}, {0.5f, 0.5f, 0.5f})});
    scene.lights = {pointLight({2, 0, 1}), sun({1, 0, 0.5})};
    checkAgainstOracle(compareWithOracle(scene, kView), 100);
    scene.lights = {pointLight({2, 0.001, 1})};
    checkAgainstOracle(compareWithOracle(scene, kView), 2000);
    scene.lights = {sun({1, 0.0017453, 0.3})};
    checkAgainstOracle(compareWithOracle(scene, kView), 700);
}

TEST_CASE("ThinCastersShadowWhatLiesBehindThem") {
    SurfaceScene scene = sceneWith(
        {solidBox({0, 1, 0}, {1, 1e-4f, 1e-4f}), rectangle({0, 1.5f, 0.5f}, {1, 0, 0}, {0, 0, 1e-4f})});
    scene.lights = {pointLight({0, 4, 1}), sun({0, 1, 0.3})};
    // Their shadows are a fraction of a pixel wide from afar, and one pixel close up.
    checkAgainstOracle(compareWithOracle(scene, kView), 0);
    checkAgainstOracle(
        compareWithOracle(scene, lookingAt({0, 0.02, -0.28}, {0, 0, -0.3001}, 160, 120, 0.001)), 100);
}

TEST_CASE("DepthRangeOfAMillionFailsFarAwayOnly") {
    SurfaceScene scene = sceneWith({solidBox({0, 0.02f, 0}, {0.01f, 0.02f, 0.01f}),
                                    solidBox({-0.05f, 0.2f, 0.05f}, {0.05f, 0.05f, 0.05f}),
                                    solidBox({200, 300, -5000}, {100, 300, 100})});
    scene.meshes[0] = rectangle({0, 0, 0}, {0, 0, 10000}, {10000, 0, 0});
    scene.lights = {sun({1, 1, 0.4}), pointLight({-1000, 2000, -3000})};
    // At a distance w depths of D32F are w^2 / near 2^-24 apart: a centimetre at 40 m, 150 m at 5000 m. What
    // is wrong is far away.
    const Comparison c = compareWithOracle(scene, lookingAt({0.1, 0.3, 0.4}, {0, 0.25, 0}, 160, 120, 0.01));
    CHECK(c.falseShadow == 0);
    CHECK(c.falseLight <= 50);
    CHECK(c.atBorders <= kBorderFraction * c.samples);
    CHECK(c.shadowed > 2000);
}

// A cube 4 km away, and its shadow on a wall behind it (golden/scenes/shadow_range.toml). Floats near 1 are 2^-24 apart,
// some 150 m there. Doubles are not, and floats that are 0 on the far plane are as fine there as elsewhere.
TEST_CASE("FarShadowsAreTheOraclesWhereDepthsTellThemApart") {
    SurfaceScene scene = sceneWith({solidBox({-900, 350, -4000}, {350, 350, 350}),
                                    rectangle({0, 1000, -4800}, {2000, 0, 0}, {0, 1000, 0})});
    scene.meshes[0] = rectangle({0, 0, -4000}, {0, 0, 4500}, {4500, 0, 0});
    scene.lights = {sun({-0.7, 0.3, 0.8})};
    const View view = lookingAt({0, 0.2, 0.5}, {0, 0.12, 0}, 200, 150, 0.01);
    const auto compare = [&](const char* name, DepthDirection direction, VolumeCounting counting) {
        Profile profile = *findProfile(name);
        profile.depthDirection = direction;
        VolumeShadowOptions options;
        options.counting = counting;
        const Comparison c = compareWithOracle(scene, view, options, 1.0 / 64, profile);
        CHECK(c.samples > 25000);
        CHECK(c.shadowed > 800);
        return c.falseShadow + c.falseLight + c.atBorders;
    };
    using enum DepthDirection;
    for (const VolumeCounting counting : {VolumeCounting::zFail, VolumeCounting::zPass}) {
        const int inFloat = compare("f32", forward, counting);
        CHECK(inFloat > 100);
        CHECK(inFloat < 400);
        for (const auto& [profile, direction] :
             {std::pair("f32", reversed), std::pair("f64", forward), std::pair("f64", reversed),
              std::pair("truth", forward), std::pair("truth", reversed)}) {
            CAPTURE(profile);
            CHECK(compare(profile, direction, counting) == 0);
        }
    }
}

TEST_CASE("PointLightFarAwayIsASun") {
    SurfaceScene scene = sceneWith({torusKnotMesh(96, 16, {.tube_m = 0.2})});
    scene.instances[1].toWorld[3][1] = 1.2;
    const glm::dvec3 towards = unit({1, 2, 1});
    scene.lights = {pointLight(1e8 * towards)};
    checkAgainstOracle(compareWithOracle(scene, kView), 600);
}

TEST_CASE("CoplanarCasterAndReceiverAreLit") {
    SurfaceScene scene = sceneWith({rectangle({0.1f, 0, 0.2f}, {0.5f, 0, 0.3f}, {-0.3f, 0, 0.7f})});
    scene.lights = {pointLight({1, 3, 1}), sun({1, 2, 0})};
    checkAgainstOracle(compareWithOracle(scene, kView), 0);
}

TEST_CASE("UnoccludedPlaneIsLitToTheLastPixel") {
    SurfaceScene scene = sceneWith({});
    for (const SurfaceLight& light :
         {pointLight({2, 0.01, 1}), pointLight({0, 50, 0}), sun({1, 0.00175, 0.3}), sun({0, 1, 0})}) {
        scene.lights = {light};
        const auto placed = placeMeshes(scene, RasterReal::fp32, 1);
        for (const View& view : {kView, lookingAt({0, 0.05, 3}, {0.3, 0, 0})})
            for (const Profile& profile : profiles()) {
                const VolumeShadows shadows(scene, placed, view, profile, {}, {1, 64, false});
                REQUIRE(shadows.casts(0));
                const auto lit = shadows.mask(0).values();
                CHECK(std::find(lit.begin(), lit.end(), 0) == lit.end());
            }
    }
}

TEST_CASE("MirroredAndInsideOutMeshesCastAsOthersDo") {
    SurfaceScene scene =
        sceneWith({torusKnotMesh(96, 16, {.tube_m = 0.2}), solidBox({1.5, 0.5, -1.5}, {0.4f, 0.5f, 0.3f})});
    scene.instances[1].toWorld[3][1] = 1.2;
    scene.instances[1].toWorld[0][0] = -1;
    std::vector<uint32_t>& indices = scene.meshes[2].indices;
    for (size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
    scene.lights = {pointLight({2, 5, 1}), sun({1, 2, 1})};
    checkAgainstOracle(compareWithOracle(scene, kView), 2000);
}

TEST_CASE("CubeFacesShowTheOraclesShadows") {
    SurfaceScene scene =
        sceneWith({torusKnotMesh(48, 8, {.tube_m = 0.2}), rectangle({0.5f, 3, 0}, {1, 0, 0.2f}, {0, 0, -1})});
    scene.instances[1].toWorld[3][1] = 1.2;
    scene.lights = {pointLight({0.5, 5, 0.3}), sun({1, 2, 1})};
    int shadowed = 0;
    for (int face = 0; face < kCubeFaces; face++) {
        const Comparison c =
            compareWithOracle(scene, cubeFaceView(static_cast<CubeFace>(face), 64, {1.7, 1, 0.4}, 0.05, 100));
        CHECK(c.falseShadow + c.falseLight == 0);
        CHECK(c.atBorders <= 2);
        shadowed += c.shadowed;
    }
    CHECK(shadowed > 4000);
}

// With the stencil of 8 bits that hardware has, 256 sheets cast no shadow, nor do 512.
TEST_CASE("AsManySheetsAsThereAreCastAShadow") {
    Profile wrapping = profiles()[0];
    wrapping.volumeStencil = VolumeStencil::bits8;
    for (const int layers : {127, 128, 255, 256, 257, 512}) {
        SurfaceScene scene = sceneWith({});
        SurfaceMesh stack;
        for (int i = 0; i < layers; i++) {
            const SurfaceMesh layer =
                rectangle({0, 1 + 0.001f * static_cast<float>(i), 0}, {0, 0, 1}, {1, 0, 0});
            for (const uint32_t k : layer.indices)
                stack.indices.push_back(k + static_cast<uint32_t>(stack.positions.size()));
            stack.positions.insert(stack.positions.end(), layer.positions.begin(), layer.positions.end());
            stack.normals.insert(stack.normals.end(), layer.normals.begin(), layer.normals.end());
        }
        addObject(scene, stack, lambertian(0.5));
        scene.lights = {sun({0, 1, 0})};
        const View view = lookingAt({0, 0.9, 3}, {0, 0, 0});
        const Comparison c = compareWithOracle(scene, view);
        CHECK(c.falseShadow == 0);
        CHECK(c.falseLight == 0);
        CHECK(c.shadowed > 1000);
        const Comparison wrapped = compareWithOracle(scene, view, {}, 1.0 / 64, wrapping);
        CHECK(wrapped.falseShadow == 0);
        CHECK((wrapped.falseLight > 1000) == (layers % 256 == 0));
    }
}

TEST_CASE("ScenesWithoutCastersAndLightsWithoutANumber") {
    SurfaceScene empty;
    empty.lights = {sun({0, 1, 0})};
    const VolumeShadows none(empty, {}, kView, profiles()[0], {}, {});
    CHECK_FALSE(none.casts(0));
    CHECK(none.mask(0).empty());
    SurfaceScene scene = sceneWith({});
    const auto placed = placeMeshes(scene, RasterReal::fp32, 1);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
        scene.lights = {pointLight({0, bad, 0})};
        CHECK_THROWS_AS(VolumeShadows(scene, placed, kView, profiles()[0], {}, {}), PreconditionError);
    }
    // A light at a vertex is in the plane of the triangles there, which cast nothing.
    scene.lights = {pointLight(placed[0].positions[0])};
    CHECK_FALSE(VolumeShadows(scene, placed, kView, profiles()[0], {}, {}).casts(0));
}

TEST_CASE("SamplesOfAPixelCountForTheirInstance") {
    SurfaceScene scene = sceneWith({torusKnotMesh(48, 8, {.tube_m = 0.2})});
    scene.lights = {pointLight({2, 5, 1})};
    const auto placed = placeMeshes(scene, RasterReal::fp32, 1);
    VolumeShadowOptions options;
    options.samples = 4;
    const VolumeShadows shadows(scene, placed, kView, profiles()[0], options, {1, 64, false});
    const VisibleScene visible =
        findVisible(scene, placed, withInfiniteFar(kView), profiles()[0], 4, {1, 64, false});
    int between = 0, different = 0;
    for (int y = 0; y < kView.height; y++)
        for (int x = 0; x < kView.width; x++) {
            double lit[2] = {0, 0}, count[2] = {0, 0};
            for (int s = 0; s < 4; s++) {
                const uint32_t id = visible.target.id.at(x, y, s);
                if (id == kNoTriangle) continue;
                const uint32_t instance = visible.instanceOfDraw[visible.target.triangles[id].draw];
                count[instance]++;
                lit[instance] += shadows.mask(0).at(x, y, s);
            }
            LitPoints points;
            for (uint32_t instance = 0; instance < 2; instance++) {
                points.instance.push_back(instance);
                points.x_px.push_back(static_cast<uint32_t>(x));
                points.y_px.push_back(static_cast<uint32_t>(y));
            }
            double visibility[2];
            shadows.find(0, points, visibility);
            for (int i = 0; i < 2; i++) {
                if (count[i] == 0) continue;
                REQUIRE(visibility[i] == lit[i] / count[i]);
                between += visibility[i] > 0 && visibility[i] < 1 ? 1 : 0;
            }
            different += count[0] > 0 && count[1] > 0 && visibility[0] != visibility[1] ? 1 : 0;
        }
    CHECK(between >= 10);
    CHECK(different >= 5);
}

TEST_CASE("ThreadsAndTilesChangeNoBitOfVolumeShadows") {
    SurfaceScene scene = sceneWith({torusKnotMesh(192, 16, {.tube_m = 0.2})});
    scene.instances[1].toWorld[3][1] = 1.2;
    scene.lights = {pointLight({2, 5, 1}), sun({1, 2, 1})};
    const auto placed = placeMeshes(scene, RasterReal::fp32, 1);
    const VolumeShadows one(scene, placed, kView, profiles()[0], {}, {1, 64, false}),
        many(scene, placed, kView, profiles()[0], {}, {4, 16, false});
    for (size_t l = 0; l < 2; l++) CHECK(one.mask(l) == many.mask(l));
}
