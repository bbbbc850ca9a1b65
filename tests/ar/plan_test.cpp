#include "ar/plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

using namespace etalon;

namespace {

Material lambertMaterial() {
    Material material;
    material.name = "matt";
    material.diffuse = glm::dvec3(0.5);
    return material;
}

Material mirrorMaterial() {
    Material material;
    material.name = "chrome";
    material.kind = MaterialKind::mirror;
    material.reflectance = glm::dvec3(0.9);
    return material;
}

MeshObject meshOf(const std::string& name, size_t material) {
    MeshObject mesh;
    mesh.name = name;
    mesh.file = name + ".obj";
    mesh.material = material;
    mesh.objectToWorld = {glm::dmat4(1)};
    return mesh;
}

// A matt mesh in nothing: the least that can be drawn.
Scene bareScene() {
    Scene scene;
    scene.camera.width = 64;
    scene.camera.height = 48;
    scene.materials = {lambertMaterial()};
    scene.meshes = {meshOf("thing", 0)};
    scene.output.images = {"beauty"};
    return scene;
}

// Every effect there is, each with an object that shows it.
Scene fullScene() {
    Scene scene = bareScene();
    Material gloss = lambertMaterial();
    gloss.kind = MaterialKind::blinnPhong;
    scene.materials.push_back(gloss);
    scene.materials.push_back(mirrorMaterial());
    scene.meshes.push_back(meshOf("glossy", 1));
    scene.meshes.push_back(meshOf("ball", 2));
    scene.meshes.back().reflection = Reflection::scene;
    scene.meshes.push_back(meshOf("plate", 2));
    scene.lights.emplace_back();
    scene.ambient = glm::dvec3(0.1);
    scene.environment.kind = EnvironmentKind::file;
    return scene;
}

std::set<std::string> running(const Plan& plan) {
    std::set<std::string> names;
    for (const PlanPass& pass : plan.passes)
        if (pass.runs) names.insert(pass.name);
    return names;
}

}  // namespace

TEST_CASE("OnlyTheNeededPassesRun") {
    CHECK(running(makePlan(bareScene(), {})) == std::set<std::string>{"geometry", "visibility", "beauty"});
    const std::set<std::string> all{"geometry",
                                    "visibility",
                                    "ambient",
                                    "diffuse",
                                    "specular",
                                    "mirror",
                                    "background",
                                    "beauty",
                                    "cube map of ball",
                                    "environment image",
                                    "environment cube map"};
    CHECK(running(makePlan(fullScene(), {})) == all);
}

TEST_CASE("AnEffectThatNoOutputNeedsAddsNoPass") {
    PlanRequest request;
    request.outputs = {"depth", "ids", "normals"};
    CHECK(running(makePlan(fullScene(), request)) == running(makePlan(bareScene(), request)));
    const Plan plan = makePlan(fullScene(), request);
    CHECK_FALSE(plan.readEnvironment);
    CHECK_FALSE(plan.environmentCube);
}

TEST_CASE("EachEffectsPassesVanishWhenNothingNeedsThem") {
    struct Case {
        const char* what;
        void (*remove)(Scene&);
        std::set<std::string> gone;
    };
    const Case cases[] = {
        {"lights", [](Scene& s) { s.lights.clear(); }, {"diffuse", "specular"}},
        {"ambient", [](Scene& s) { s.ambient = glm::dvec3(0); }, {"ambient"}},
        {"gloss", [](Scene& s) { s.meshes.erase(s.meshes.begin() + 1); }, {"specular"}},
        {"ball", [](Scene& s) { s.meshes.erase(s.meshes.begin() + 2); }, {"cube map of ball"}},
        {"mirrors",
         [](Scene& s) { s.meshes.resize(2); },
         {"cube map of ball", "mirror", "environment cube map"}},
        {"plate", [](Scene& s) { s.meshes.resize(3); }, {"environment cube map"}},
        {"environment",
         [](Scene& s) { s.environment.kind = EnvironmentKind::none; },
         {"environment image", "environment cube map", "background"}},
        {"beauty",
         [](Scene& s) { s.output.images = {"diffuse"}; },
         {"ambient", "specular", "mirror", "background", "beauty", "cube map of ball", "environment image",
          "environment cube map"}},
    };
    const std::set<std::string> all = running(makePlan(fullScene(), {}));
    for (const Case& c : cases) {
        Scene scene = fullScene();
        c.remove(scene);
        std::set<std::string> expected = all;
        for (const std::string& name : c.gone) expected.erase(name);
        CHECK_MESSAGE(running(makePlan(scene, {})) == expected, c.what);
    }
}

TEST_CASE("HiddenObjectsNeedNoPasses") {
    const Scene scene = fullScene();
    VisibilityFacts facts;
    facts.backgroundVisible = false;
    facts.objectVisible = {true, false, false, false};
    const Plan plan = makePlan(scene, {}, &facts);
    CHECK(running(plan) == std::set<std::string>{"geometry", "visibility", "ambient", "diffuse", "beauty"});
    CHECK(plan.find("mirror")->reason == "no mirror is visible");
    CHECK(plan.find("background")->reason == "objects cover every pixel");
    // A visible mirror without a cube map does not call for that of a hidden one.
    facts.objectVisible = {false, false, false, true};
    CHECK(makePlan(scene, {}, &facts).find("mirror")->runs);
    for (const bool cube : makePlan(scene, {}, &facts).objectCube) CHECK_FALSE(cube);
    // A mirror that only a cube map sees still needs the environment.
    facts.objectVisible = {true, false, true, false};
    CHECK(makePlan(scene, {}, &facts).environmentCube);
    // So does the background that only a cube map sees.
    Scene noPlate = fullScene();
    noPlate.meshes.resize(3);
    facts.objectVisible = {false, false, true};
    CHECK_FALSE(makePlan(noPlate, {}, &facts).environmentCube);
    CHECK(makePlan(noPlate, {}, &facts).readEnvironment);
}

TEST_CASE("APngNeedsTheBeautyWhateverTheOutputsAre") {
    PlanRequest request;
    request.outputs = {"depth"};
    request.png = true;
    const Plan plan = makePlan(bareScene(), request);
    CHECK(plan.find("beauty")->runs);
    CHECK(plan.find("tone mapping")->runs);
}

TEST_CASE("ShadowsRunForLightsThatNeedThem") {
    Scene scene = fullScene();
    scene.lights.resize(4);
    for (SceneLight& light : scene.lights) light.irradiance = glm::dvec3(1);
    scene.lights[0].shadow.method = ShadowMethod::map;
    scene.lights[2].shadow.method = ShadowMethod::volume;
    scene.lights[3].shadow.method = ShadowMethod::planar;
    const auto runningShadows = [](const Plan& plan) {
        std::vector<bool> found;
        for (const PlanShadow& shadow : plan.shadows) found.push_back(shadow.runs);
        return found;
    };
    // Without geometry anything may cast.
    const Plan first = makePlan(scene, {});
    CHECK(runningShadows(first) == std::vector<bool>{true, true, true});
    CHECK(first.shadows[1].index == 2);
    CHECK(first.find("shadow map of light1") == nullptr);
    for (const char* need : {"shadow map of light0", "shadow volumes of light2", "planar shadows of light3"})
        CHECK(std::ranges::count(first.find("diffuse")->needs, need) == 1);
    // With it, what casts, or what shadows fall on, is named.
    VisibilityFacts facts;
    facts.objectVisible.assign(planObjects(scene).size(), true);
    facts.shadowObjects = {{0, 2}, {2}, {3}};
    const Plan plan = makePlan(scene, {}, &facts);
    CHECK(runningShadows(plan) == std::vector<bool>{true, true, true});
    CHECK(plan.find("shadow map of light0")->reason == "cast by thing, ball");
    CHECK(plan.find("shadow volumes of light2")->reason == "cast by ball");
    CHECK(plan.find("planar shadows of light3")->reason == "fall on plate");
    CHECK(plan.memory_bytes == first.memory_bytes);
    facts.shadowObjects = {{}, {}, {}};
    const Plan nothing = makePlan(scene, {}, &facts);
    CHECK(runningShadows(nothing) == std::vector<bool>{false, false, false});
    for (const char* name : {"shadow map of light0", "shadow volumes of light2"})
        CHECK(nothing.find(name)->reason == "nothing stands between the light and what is visible");
    CHECK(nothing.find("planar shadows of light3")->reason == "no shadow falls on a plane that is visible");
    CHECK(nothing.memory_bytes == makePlan(fullScene(), {}).memory_bytes);
    for (size_t light : {0, 2, 3}) {
        Scene one = fullScene();
        one.lights = {scene.lights[light]};
        CHECK(makePlan(one, {}).memory_bytes > nothing.memory_bytes);
    }
    // Mirrors and the background have no shadows.
    PlanRequest request;
    request.outputs = {"normals"};
    CHECK(makePlan(scene, request).find("shadow map of light0")->reason ==
          "neither diffuse nor specular runs");
    scene.lights[0].irradiance = glm::dvec3(0);
    CHECK(makePlan(scene, {}).find("shadow map of light0")->reason == "the light is black");
}

TEST_CASE("LightsOfAnEnvironmentThatCastAreNamed") {
    Scene scene = fullScene();
    scene.environment.lighting = EnvironmentLightMethod::lights;
    scene.environment.shadow.method = ShadowMethod::map;
    scene.environment.shadowLights = 3;
    const uint64_t without_bytes = makePlan(fullScene(), {}).memory_bytes;
    const uint64_t map_bytes = uint64_t{1024} * 1024 * (9 + 16);
    // Before the lights are known there is room for as many as are asked for.
    const Plan first = makePlan(scene, {});
    CHECK(first.find("shadows of environment lights")->runs);
    CHECK(first.shadows.empty());
    CHECK(first.memory_bytes == without_bytes + 3 * map_bytes);

    scene.environment.lightCount = 2;
    CHECK(makePlan(scene, {}).memory_bytes == without_bytes + 2 * map_bytes);

    VisibilityFacts facts;
    facts.objectVisible.assign(planObjects(scene).size(), true);
    facts.environmentCasters = {{7, 0.0125, 0.25}, {2, 0.5, 0.125}};
    facts.shadowObjects = {{0}, {}};
    const Plan plan = makePlan(scene, {}, &facts);
    REQUIRE(plan.shadows.size() == 2);
    CHECK(plan.shadows[0].index == scene.lights.size() + 7);
    CHECK(plan.shadows[0].shadow == &scene.environment.shadow);
    CHECK(plan.find("shadow map of environment light 7")->reason ==
          "region of 0.0125 sr, 25 % of the energy; cast by thing");
    CHECK(plan.find("shadow map of environment light 2")->reason ==
          "region of 0.5 sr, 12.5 % of the energy; nothing stands between the light and what is visible");
    CHECK(plan.memory_bytes == without_bytes + map_bytes);
    facts.environmentCasters.emplace();
    facts.shadowObjects.emplace();
    CHECK(makePlan(scene, {}, &facts).find("shadows of environment lights")->reason == "it has no lights");
    // What lights nothing casts no shadows.
    PlanRequest request;
    request.outputs = {"background"};
    CHECK_FALSE(makePlan(scene, request).find("shadows of environment lights")->runs);
}

TEST_CASE("OcclusionRunsForLightFromEverywhere") {
    Scene scene = fullScene();
    CHECK(makePlan(scene, {}).find("ambient occlusion") == nullptr);
    scene.render.occlusionDirections = 64;
    const Plan plan = makePlan(scene, {});
    CHECK(plan.occlusion);
    CHECK(std::ranges::count(plan.find("ambient")->needs, "ambient occlusion") == 1);
    CHECK(std::ranges::count(plan.find("diffuse")->needs, "ambient occlusion") == 0);
    CHECK(plan.memory_bytes > makePlan(fullScene(), {}).memory_bytes);
    // The environment's light is, its lights are not.
    scene.ambient = glm::dvec3(0);
    CHECK_FALSE(makePlan(scene, {}).occlusion);
    for (const auto& [method, runs] : {std::pair(EnvironmentLightMethod::lights, false),
                                       std::pair(EnvironmentLightMethod::dominant, false),
                                       std::pair(EnvironmentLightMethod::harmonics, true),
                                       std::pair(EnvironmentLightMethod::exact, true)}) {
        scene.environment.lighting = method;
        const Plan lit = makePlan(scene, {});
        CHECK(lit.occlusion == runs);
        CHECK((std::ranges::count(lit.find("diffuse")->needs, "ambient occlusion") == 1) == runs);
    }
    PlanRequest request;
    request.outputs = {"specular", "depth"};
    CHECK(makePlan(scene, request).find("ambient occlusion")->reason ==
          "nothing that runs is lit from everywhere");
}

TEST_CASE("EveryPassHasAReasonAndNeedsPassesOfThePlan") {
    Scene occluded = fullScene();
    occluded.render.occlusionDirections = 64;
    occluded.render.perVertex = true;
    for (const Scene& scene : {bareScene(), fullScene(), occluded}) {
        const Plan plan = makePlan(scene, {});
        for (const PlanPass& pass : plan.passes) {
            CHECK_FALSE(pass.reason.empty());
            for (const std::string& need : pass.needs) {
                REQUIRE_MESSAGE(plan.find(need) != nullptr, need);
                if (pass.runs) CHECK_MESSAGE(plan.find(need)->runs, pass.name << " needs " << need);
            }
        }
        const auto json = nlohmann::json::parse(planJson(plan));
        CHECK(json["passes"].size() == plan.passes.size());
        CHECK(planText(plan).find("run   visibility") != std::string::npos);
        CHECK(planDot(plan).find("\"visibility\" -> ") != std::string::npos);
    }
}

TEST_CASE("PlanTextHasOneLineAPass") {
    Scene scene = fullScene();
    for (MeshObject& mesh : scene.meshes) mesh.name = "a\nb";
    const Plan plan = makePlan(scene, {});
    const std::string text = planText(plan);
    CHECK(text.find("cube map of a?b") != std::string::npos);
    CHECK(std::ranges::count(text, '\n') == static_cast<std::ptrdiff_t>(plan.passes.size()) + 1);
}

TEST_CASE("MemoryGrowsWithPixelsAndSamples") {
    Scene scene = bareScene();
    const uint64_t small = makePlan(scene, {}).memory_bytes;
    scene.camera.width *= 2;
    CHECK(makePlan(scene, {}).memory_bytes == 2 * small);
    scene.render.samples = 16;
    CHECK(makePlan(scene, {}).memory_bytes > 4 * small);
}
