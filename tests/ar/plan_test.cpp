#include "ar/plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "ar/surface_builder.h"
#include "scene/outputs.h"

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
    scene.camera.intrinsics = {60, 60, 32, 24};
    scene.camera.near = 0.1;
    scene.camera.far = 10;
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
    gloss.specular = glm::dvec3(0.2);
    scene.materials.push_back(gloss);
    scene.materials.push_back(mirrorMaterial());
    scene.meshes.push_back(meshOf("glossy", 1));
    scene.meshes.push_back(meshOf("ball", 2));
    scene.meshes.back().reflection = Reflection::scene;
    scene.meshes.push_back(meshOf("plate", 2));
    scene.lights.emplace_back();
    scene.lights[0].irradiance = glm::dvec3(1);
    scene.ambient = glm::dvec3(0.1);
    scene.environment.kind = EnvironmentKind::file;
    return scene;
}

std::set<std::string> running(const Plan& plan) {
    std::set<std::string> names;
    for (const Pass& pass : plan.passes)
        if (pass.runs) names.insert(pass.name());
    return names;
}

RenderOptions asking(std::vector<std::string> outputs, bool png = false) {
    RenderOptions options;
    options.request = {std::move(outputs), png};
    return options;
}

// Of a plan that knows what is visible.
PlanFacts seeing(std::vector<bool> objects, bool background = true) {
    PlanFacts facts;
    facts.visibility = VisibilityFacts{std::move(objects), background};
    return facts;
}
PlanFacts seeingAll(const Scene& scene) {
    return seeing(std::vector<bool>(sceneObjects(scene).size(), true));
}

bool needs(const Plan& plan, std::string_view pass, std::string_view need) {
    return std::ranges::count(namesOfNeeds(plan, *plan.find(pass)), need) == 1;
}

const Pass& passOf(const Plan& plan, std::string_view name) {
    REQUIRE_MESSAGE(plan.find(name), name);
    return *plan.find(name);
}

// Of "a does not run", "neither a nor b runs", "none of a, b and c runs": a, b, c. None of another reason.
std::vector<std::string> namedPasses(std::string reason) {
    std::vector<std::string> names;
    const auto cut = [&](const std::string& what, const std::string& by) {
        for (size_t at = 0; (at = reason.find(what, at)) != std::string::npos;)
            reason.replace(at, what.size(), by);
    };
    if (reason.ends_with(" does not run"))
        cut(" does not run", ",");
    else if (reason.ends_with(" runs"))
        reason.erase(0, 8), cut(" runs", ","), cut(" nor ", ","), cut(" and ", ","), cut(", ", ",");
    else
        return names;
    for (size_t begin = 0, end = 0; (end = reason.find(',', begin)) != std::string::npos; begin = end + 1)
        names.push_back(reason.substr(begin, end - begin));
    return names;
}

}  // namespace

TEST_CASE("OnlyTheNeededPassesRun") {
    // A scene without light is black.
    CHECK(running(makePlan(bareScene(), {})) == std::set<std::string>{"geometry", "visibility", "frame"});
    const std::set<std::string> all{"geometry",
                                    "visibility",
                                    "lights",
                                    "ambient",
                                    "diffuse",
                                    "specular",
                                    "mirror",
                                    "background",
                                    "beauty",
                                    "shading",
                                    "frame",
                                    "cube map of ball",
                                    "environment image",
                                    "environment cube map"};
    CHECK(running(makePlan(fullScene(), {})) == all);
}

TEST_CASE("AnEffectThatNoOutputNeedsAddsNoPass") {
    const RenderOptions options = asking({"depth", "ids", "normals"});
    CHECK(running(makePlan(fullScene(), options)) == running(makePlan(bareScene(), options)));
    const Plan plan = makePlan(fullScene(), options);
    CHECK_FALSE(passOf(plan, "environment image").runs);
    CHECK_FALSE(passOf(plan, "environment cube map").runs);
    CHECK_FALSE(passOf(makePlan(fullScene(), asking({"window_depth"})), "shading").runs);
}

TEST_CASE("EachEffectsPassesVanishWhenNothingNeedsThem") {
    struct Case {
        const char* what;
        void (*remove)(Scene&);
        std::set<std::string> gone;
    };
    const Case cases[] = {
        {"lights", [](Scene& s) { s.lights.clear(); }, {"lights", "diffuse", "specular"}},
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

// Each with its reason.
TEST_CASE("WhatIsBlackDoesNotRun") {
    struct Case {
        void (*darken)(Scene&);
        const char *pass, *reason;
    };
    const Case cases[] = {
        {[](Scene& s) { s.lights[0].irradiance = glm::dvec3(0); }, "diffuse",
         "every light is black, and the environment lights no surfaces"},
        {[](Scene& s) { s.lights[0].irradiance = glm::dvec3(0); }, "specular",
         "every light is black, and the environment is not cut into lights"},
        {[](Scene& s) {
             for (Material& m : s.materials) m.diffuse = glm::dvec3(0);
         },
         "ambient", "the diffuse reflectance of each diffuse surface is 0"},
        {[](Scene& s) {
             for (Material& m : s.materials) m.diffuse = glm::dvec3(0);
         },
         "diffuse", "the diffuse reflectance of each diffuse surface is 0"},
        {[](Scene& s) { s.materials[1].specular = glm::dvec3(0); }, "specular",
         "the specular reflectance of each blinn_phong surface is 0"},
        {[](Scene& s) { s.materials[2].reflectance = glm::dvec3(0); }, "mirror",
         "the reflectance of each mirror is 0"},
        {[](Scene& s) { s.materials[2].reflectance = glm::dvec3(0); }, "cube map of ball",
         "its mirror is black"},
        {[](Scene& s) { s.environment.kind = EnvironmentKind::constant; }, "background",
         "the environment is black"},
        {[](Scene& s) {
             s.environment.kind = EnvironmentKind::constant;
             s.environment.lighting = EnvironmentLightMethod::exact;
         },
         "environment light", "the environment is black"},
        {[](Scene& s) {
             s.environment.kind = EnvironmentKind::none;
             s.meshes[2].reflection = Reflection::environment;
         },
         "mirror", "the environment that mirrors show is black"},
        {[](Scene& s) {
             s.environment.kind = EnvironmentKind::none;
             s.lights.clear();
             s.ambient = glm::dvec3(0);
         },
         "mirror", "nothing in the scene shines"},
        {[](Scene& s) {
             s.environment.kind = EnvironmentKind::none;
             s.lights.clear();
             s.ambient = glm::dvec3(0);
         },
         "beauty", "every part of it is black"},
        {[](Scene& s) {
             s.environment.kind = EnvironmentKind::none;
             s.lights.clear();
             s.ambient = glm::dvec3(0);
         },
         "shading", "all that it would show is black"},
    };
    for (const Case& c : cases) {
        Scene scene = fullScene();
        scene.environment.lighting = EnvironmentLightMethod::exact;
        CHECK_MESSAGE(passOf(makePlan(scene, {}), c.pass).runs, c.pass);
        scene.environment.lighting = EnvironmentLightMethod::none;
        c.darken(scene);
        const Plan plan = makePlan(scene, {});
        const Pass& pass = passOf(plan, c.pass);
        CHECK_FALSE_MESSAGE(pass.runs, c.pass);
        CHECK(pass.reason == c.reason);
    }
    // One square of a checkerboard is enough.
    Scene scene = fullScene();
    scene.materials[0].diffuse = scene.materials[1].diffuse = glm::dvec3(0);
    scene.materials[0].checker = Checker{glm::dvec3(0.5), 1};
    CHECK(passOf(makePlan(scene, {}), "diffuse").runs);
}

TEST_CASE("HiddenObjectsNeedNoPasses") {
    const Scene scene = fullScene();
    const Plan plan = makePlan(scene, {}, seeing({true, false, false, false}, false));
    CHECK(running(plan) == std::set<std::string>{"geometry", "visibility", "lights", "ambient", "diffuse",
                                                 "beauty", "shading", "frame"});
    CHECK(passOf(plan, "mirror").reason == "no mirror is visible");
    CHECK(passOf(plan, "background").reason == "objects cover every pixel");
    CHECK(passOf(plan, "cube map of ball").reason == "its mirror is not visible");
    // A visible mirror without a cube map does not call for that of a hidden one.
    const Plan plate = makePlan(scene, {}, seeing({false, false, false, true}, false));
    CHECK(passOf(plate, "mirror").runs);
    CHECK_FALSE(passOf(plate, "cube map of ball").runs);
    // A mirror that only a cube map sees still needs the environment.
    CHECK(
        passOf(makePlan(scene, {}, seeing({true, false, true, false}, false)), "environment cube map").runs);
    // So does the background that only a cube map sees.
    Scene noPlate = fullScene();
    noPlate.meshes.resize(3);
    const Plan ball = makePlan(noPlate, {}, seeing({false, false, true}, false));
    CHECK_FALSE(passOf(ball, "environment cube map").runs);
    CHECK(passOf(ball, "environment image").runs);
}

// Mirrors in a cube map show the environment, also those that have cube maps themselves.
TEST_CASE("MirrorsThatShowEachOtherNeedTheEnvironmentsCubeMap") {
    Scene scene = fullScene();
    scene.meshes.back().reflection = Reflection::scene;
    const Plan plan = makePlan(scene, {}, seeingAll(scene));
    CHECK(passOf(plan, "environment cube map").runs);
    CHECK(needs(plan, "cube map of ball", "environment cube map"));
    CHECK(needs(plan, "cube map of plate", "environment cube map"));
    CHECK_FALSE(needs(plan, "mirror", "environment cube map"));
}

TEST_CASE("AReflectionMoreIsACubeMapMoreOfEachMirror") {
    Scene scene = fullScene();
    scene.meshes.back().reflection = Reflection::scene;
    scene.render.reflections = 3;
    const Plan plan = makePlan(scene, {}, seeingAll(scene));
    CHECK(needs(plan, "mirror", "cube map of ball"));
    CHECK(needs(plan, "cube map of ball", "cube map of plate, reflection 2 of 3"));
    CHECK(needs(plan, "cube map of plate, reflection 2 of 3", "cube map of ball, reflection 1 of 3"));
    CHECK_FALSE(needs(plan, "cube map of ball", "cube map of ball, reflection 2 of 3"));
    // One that is alone has none.
    scene.meshes.back().reflection = Reflection::environment;
    CHECK(passOf(makePlan(scene, {}, seeingAll(scene)), "cube map of ball, reflection 2 of 3").reason ==
          "no other mirror reflects the scene");
}

TEST_CASE("APngNeedsTheBeautyWhateverTheOutputsAre") {
    const Plan plan = makePlan(fullScene(), asking({"depth"}, true));
    for (const char* name : {"beauty", "shading", "tone mapping"}) CHECK(passOf(plan, name).runs);
    CHECK(passOf(plan, "beauty").reason == "the PNG shows it");
    CHECK_FALSE(passOf(makePlan(fullScene(), asking({"depth"})), "tone mapping").runs);
}

// Whether it is an output or the PNG shows it: its parts, and of them those that are not black.
TEST_CASE("TheBeautyNeedsEachOfItsParts") {
    using Names = std::vector<std::string>;
    for (const RenderOptions& options : {asking({"beauty"}), asking({"depth"}, true)}) {
        Scene scene = fullScene();
        const Plan plan = makePlan(scene, options);
        CHECK(namesOfNeeds(plan, passOf(plan, "beauty")) ==
              Names{"ambient", "diffuse", "specular", "mirror", "background"});
        scene.ambient = glm::dvec3(0);
        scene.meshes.resize(2);
        const Plan less = makePlan(scene, options);
        CHECK(namesOfNeeds(less, passOf(less, "beauty")) == Names{"diffuse", "specular", "background"});
    }
}

TEST_CASE("BeforeVisibilityThePlanSaysWhatDependsOnIt") {
    const Scene scene = fullScene();
    const Plan first = makePlan(scene, {});
    for (const char* name : {"ambient", "diffuse", "mirror", "background", "beauty", "shading",
                             "cube map of ball", "environment image", "environment cube map"})
        CHECK_MESSAGE(passOf(first, name).dependsOn == "visibility", name);
    for (const char* name : {"geometry", "visibility", "frame", "normals"})
        CHECK_MESSAGE(passOf(first, name).dependsOn.empty(), name);
    CHECK(planText(first).find("part of the beauty (depends on visibility)") != std::string::npos);
    for (const Pass& pass : makePlan(scene, {}, seeingAll(scene)).passes)
        CHECK_MESSAGE(pass.dependsOn.empty(), pass.name());
    // Depth is an output whatever is visible; what the beauty needs beside it is not sure.
    const Plan depth = makePlan(scene, asking({"depth", "normals"}));
    for (const char* name : {"depth", "normals", "shading"}) CHECK(passOf(depth, name).dependsOn.empty());
}

// More knowledge only ends passes, or puts those of the environment's lights in.
TEST_CASE("KnowledgeStartsNoPass") {
    const Scene scene = fullScene();
    const std::set<std::string> first = running(makePlan(scene, {}));
    for (int mask = 0; mask < 32; mask++) {
        std::vector<bool> objects;
        for (int i = 0; i < 4; i++) objects.push_back((mask >> i & 1) != 0);
        for (const std::string& name : running(makePlan(scene, {}, seeing(objects, mask >= 16))))
            CHECK_MESSAGE(first.count(name) == 1, name);
    }
}

TEST_CASE("ShadowsRunForLightsThatNeedThem") {
    Scene scene = fullScene();
    scene.lights.resize(4);
    for (SceneLight& light : scene.lights) light.irradiance = glm::dvec3(1);
    scene.lights[0].shadow.method = ShadowMethod::map;
    scene.lights[2].shadow.method = ShadowMethod::volume;
    scene.lights[3].shadow.method = ShadowMethod::planar;
    const char* const kShadows[] = {"shadow map of light0", "shadow volumes of light2",
                                    "planar shadows of light3"};
    // Without geometry anything may cast.
    const Plan first = makePlan(scene, {});
    CHECK(first.find("shadow map of light1") == nullptr);
    for (const char* shadow : kShadows) {
        CHECK(passOf(first, shadow).runs);
        CHECK(passOf(first, shadow).reason == "objects may stand in the light's way");
        CHECK(needs(first, "shadows in view", shadow));
        CHECK(needs(first, "cube map of ball", shadow));
    }
    CHECK(needs(first, "diffuse", "shadows in view"));
    CHECK(needs(first, "specular", "shadows in view"));
    for (const size_t light : {0u, 2u, 3u}) {
        Scene one = fullScene();
        one.lights = {scene.lights[light]};
        CHECK(makePlan(one, {}).memory_bytes() > makePlan(fullScene(), {}).memory_bytes());
    }
    // Mirrors and the background have no shadows.
    CHECK(passOf(makePlan(scene, asking({"normals"})), "shadow map of light0").reason ==
          "none of diffuse, specular, mirror, shadow, cube_map and shadow_map runs");
    scene.lights[0].irradiance = glm::dvec3(0);
    CHECK(passOf(makePlan(scene, {}), "shadow map of light0").reason ==
          "the light is black, and no output shows its shadow");
    // Vertices are lit without shadows; cube maps are not.
    scene.render.perVertex = true;
    CHECK(passOf(makePlan(scene, {}), "shadows in view").reason ==
          "the scene is lit per vertex, and no output shows shadows");
    CHECK(passOf(makePlan(scene, {}), "shadow volumes of light2").runs);
    scene.meshes[2].reflection = Reflection::environment;
    CHECK(passOf(makePlan(scene, {}), "shadow volumes of light2").reason == "shadows in view does not run");
}

TEST_CASE("LightsOfAnEnvironmentThatCastAreNamed") {
    Scene scene = fullScene();
    scene.environment.lighting = EnvironmentLightMethod::lights;
    scene.environment.shadow.method = ShadowMethod::map;
    scene.environment.shadowLights = 3;
    const uint64_t without_bytes = makePlan(fullScene(), {}).memory_bytes();
    const uint64_t map_bytes = shadowMemory(scene.environment.shadow, true, 0);
    // Before the lights are known there is room for as many as are asked for.
    const Plan first = makePlan(scene, {}, seeingAll(scene));
    CHECK(passOf(first, "shadows of environment lights").runs);
    CHECK(passOf(first, "shadows of environment lights").dependsOn == "environment light");
    CHECK(first.memory_bytes() == without_bytes + 3 * map_bytes);
    scene.environment.lightCount = 2;
    CHECK(makePlan(scene, {}).memory_bytes() == without_bytes + 2 * map_bytes);

    PlanFacts facts = seeingAll(scene);
    facts.casters = {{7, 0.0125, 0.25, {}}, {2, 0.5, 0.125, {}}};
    const Plan plan = makePlan(scene, {}, facts);
    CHECK(passOf(plan, "shadow map of environment light 7").reason ==
          "region of 0.0125 sr, 25 % of the energy; objects may stand in the light's way");
    CHECK(passOf(plan, "shadow map of environment light 2").reason ==
          "region of 0.5 sr, 12.5 % of the energy; objects may stand in the light's way");
    CHECK(plan.find("shadows of environment lights") == nullptr);
    CHECK(needs(plan, "lights", "environment light"));
    CHECK(plan.memory_bytes() == without_bytes + 2 * map_bytes);
    facts.casters->clear();
    CHECK(passOf(makePlan(scene, {}, facts), "shadows of environment lights").reason == "it has no lights");
    // What lights nothing casts no shadows.
    CHECK_FALSE(passOf(makePlan(scene, asking({"background"})), "shadows of environment lights").runs);
}

TEST_CASE("OcclusionRunsForLightFromEverywhere") {
    Scene scene = fullScene();
    CHECK(makePlan(scene, {}).find("ambient occlusion") == nullptr);
    scene.render.occlusionDirections = 64;
    const Plan plan = makePlan(scene, {});
    CHECK(needs(plan, "ambient", "ambient occlusion"));
    CHECK_FALSE(needs(plan, "diffuse", "ambient occlusion"));
    CHECK(plan.memory_bytes() > makePlan(fullScene(), {}).memory_bytes());
    // The environment's light is, its lights are not.
    scene.ambient = glm::dvec3(0);
    CHECK_FALSE(passOf(makePlan(scene, {}), "ambient occlusion").runs);
    for (const auto& [method, runs] : {std::pair(EnvironmentLightMethod::lights, false),
                                       std::pair(EnvironmentLightMethod::dominant, false),
                                       std::pair(EnvironmentLightMethod::harmonics, true),
                                       std::pair(EnvironmentLightMethod::exact, true)}) {
        scene.environment.lighting = method;
        const Plan lit = makePlan(scene, {});
        CHECK(passOf(lit, "ambient occlusion").runs == runs);
        CHECK(needs(lit, "diffuse", "ambient occlusion") == runs);
    }
    CHECK(passOf(makePlan(scene, asking({"specular", "depth"})), "ambient occlusion").reason ==
          "none of ambient, diffuse, occlusion, irradiance and environment runs");
}

TEST_CASE("EverythingRunsAllPassesAndSaysWhyTheyWouldNot") {
    RenderOptions options = asking({"window_depth"});
    options.everything = true;
    const Plan plan = makePlan(fullScene(), options);
    for (const Pass& pass : plan.passes) CHECK_MESSAGE(pass.runs, pass.name());
    CHECK(passOf(plan, "window_depth").reason == "output asked for");
    CHECK(passOf(plan, "diffuse").reason ==
          "everything runs; else not: neither an output nor a PNG shows it");
}

TEST_CASE("EveryPassHasAReasonAndReadsPassesThatRun") {
    Scene occluded = fullScene();
    occluded.render.occlusionDirections = 64;
    occluded.render.perVertex = true;
    for (const Scene& scene : {bareScene(), fullScene(), occluded}) {
        const Plan plan = makePlan(scene, {});
        for (size_t i = 0; i < plan.passes.size(); i++) {
            const Pass& pass = plan.passes[i];
            CHECK_FALSE(pass.reason.empty());
            CHECK(plan.find(pass.name()) == &pass);
            for (const size_t need : pass.needs) CHECK(need < i);
            // What is left out of what a running pass could read shows nothing.
            for (const size_t need : pass.needs)
                if (pass.runs && !plan.passes[need].runs) CHECK_FALSE(plan.passes[need].text.nothing.empty());
        }
        const auto json = nlohmann::json::parse(planJson(plan));
        REQUIRE(json["passes"].size() == plan.passes.size());
        for (const auto& pass : json["passes"])
            for (const char* key : {"name", "runs", "reason", "depends_on", "needs", "arithmetic",
                                    "memory_bytes", "result_bytes", "seconds"})
                CHECK_MESSAGE(pass.contains(key), key);
        CHECK(json["passes"][0]["arithmetic"] == "fp32");
        CHECK(json["passes"][0]["seconds"].is_null());
        CHECK(planText(plan).find("run   visibility") != std::string::npos);
        CHECK(planDot(plan).find("\"visibility\" -> ") != std::string::npos);
    }
}

// A pass that no output of a plan needs: what its reason names, and nothing else, makes it run.
TEST_CASE("ReasonsNameAllThatWouldHaveMadeAPassRun") {
    std::vector<Scene> scenes;
    for (const bool perVertex : {false, true})
        for (const EnvironmentLightMethod method :
             {EnvironmentLightMethod::none, EnvironmentLightMethod::harmonics,
              EnvironmentLightMethod::lights}) {
            Scene scene = fullScene();
            scene.render.perVertex = perVertex;
            scene.render.occlusionDirections = 64;
            scene.environment.lighting = method;
            scene.environment.shadow.method = ShadowMethod::map;
            scene.lights.resize(4);
            for (size_t i = 0; i < 4; i++) {
                scene.lights[i].irradiance = glm::dvec3(i == 3 ? 0 : 1);
                scene.lights[i].shadow.method = std::array{ShadowMethod::map, ShadowMethod::volume,
                                                           ShadowMethod::planar, ShadowMethod::map}[i];
            }
            scenes.push_back(scene);
        }
    size_t found = 0, shadows = 0;
    for (const Scene& scene : scenes) {
        const Plan least = makePlan(scene, asking({"ids"}));
        for (const std::string_view output : outputNames()) {
            const Plan plan = makePlan(scene, asking({"ids", std::string(output)}));
            for (const Pass& pass : least.passes) {
                if (pass.runs) continue;
                CAPTURE(pass.name() + ": " + pass.reason + " - " + std::string(output));
                const bool runsNow = passOf(plan, pass.name()).runs;
                const std::vector<std::string> names = namedPasses(pass.reason);
                if (!names.empty()) {
                    found += runsNow ? 1 : 0;
                    CHECK(runsNow == std::ranges::any_of(names, [&](const std::string& name) {
                              return passOf(plan, name).runs;
                          }));
                } else if (runsNow && !pass.text.nothing.empty()) {
                    CHECK(pass.reason.find("no output shows its shadow") != std::string::npos);
                    shadows++;
                }
            }
        }
    }
    CHECK(found > 200);
    CHECK(shadows > 0);
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
    scene.ambient = glm::dvec3(1);
    const uint64_t small = makePlan(scene, {}).memory_bytes();
    scene.camera.width *= 2;
    CHECK(makePlan(scene, {}).memory_bytes() == 2 * small);
    scene.render.samples = 16;
    CHECK(makePlan(scene, {}).memory_bytes() > 3 * small);
}
