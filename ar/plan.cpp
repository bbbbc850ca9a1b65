#include "ar/plan.h"

#include <algorithm>

#include "ar/held_memory.h"
#include "ar/showing.h"
#include "ar/surface_builder.h"
#include "numeric/text.h"
#include "probes/dominant_lights.h"
#include "scene/outputs.h"

namespace etalon {
namespace {

constexpr std::string_view kVisibility = "visibility", kEnvironmentLight = "environment light";
constexpr uint64_t kBytesPerFloat = 4;

// Makes the passes, and makes those behind a pass again that has found something out. What runs refers to it.
class Planner : public std::enable_shared_from_this<Planner> {
  public:
    Planner(const Scene& scene, const RenderOptions& options, PlanFacts facts)
        : scene_(scene),
          outputs_(options.request.outputs.empty() ? scene.output.images : options.request.outputs),
          png_(options.request.png),
          everything_(options.everything),
          profile_(
              std::make_shared<const Profile>(options.profile ? *options.profile : scene.render.profile)),
          facts_(std::move(facts)),
          showing_(scene, *profile_, facts_),
          settings_{&scene,
                    cameraViewOf(scene.camera),
                    surfaceEnvironmentOf(scene.environment),
                    options.raster,
                    options.strict,
                    options.everything} {}

    void plan(PassList& list) {
        for (const std::string& output : outputs_)
            if (!findOutput(output))
                throw InputError(formatText("no output is called '{}'; there are {}", output,
                                            joinText(outputNames(), ", ")));
        addGeometry(list);
        addVisibility(list);
        addEnvironment(list);
        addRest(list);
        list.decide(everything_);
    }
    const std::shared_ptr<PlanResults>& results() const { return results_; }

  private:
    using Terms = std::vector<Result<ShadeTerm>>;
    using Occlusion = std::vector<Result<SurfaceOcclusion>>;

    bool asked(std::string_view output) const {
        return std::ranges::find(outputs_, output) != outputs_.end();
    }
    bool beautyAsked() const { return asked("beauty") || png_; }
    // What the environment gives, or of it is reflected.
    bool environmentAsked() const { return asked("irradiance") || asked("environment"); }
    bool environmentCasts() const {
        return showing_.environmentHasLights() && scene_.environment.shadow.method != ShadowMethod::none;
    }
    bool isShaded(std::string_view component) const { return asked(component) || beautyAsked(); }
    uint64_t pixels() const {
        return static_cast<uint64_t>(scene_.camera.width) * static_cast<uint64_t>(scene_.camera.height);
    }
    uint64_t samples() const { return pixels() * static_cast<uint64_t>(scene_.render.samples); }

    // The text of a pass that shows nothing for the reason given, if any. Showing's assumptions up to here are the
    // decision's.
    PassText textOf(std::string name, std::string why, std::string nothing, std::string unneeded = "",
                    PassNumbers numbers = PassNumbers::none, uint64_t memory_bytes = 0) {
        PassText text;
        text.name = std::move(name), text.why = std::move(why);
        text.nothing = std::move(nothing), text.unneeded = std::move(unneeded);
        if (showing_.takeAssumption()) text.dependsOn = kVisibility;
        text.numbers = numbers, text.memory_bytes = memory_bytes;
        return text;
    }
    template <class T, class Run, class... Needs>
    Result<T> add(PassList& list, PassText text, T neutral, Run run, const Needs&... needs) {
        // What runs refers to the planner's settings.
        return list.add(
            std::move(text), profile_, std::move(neutral),
            [self = shared_from_this(), run = std::move(run)](
                const PassContext& context, const auto&... values) -> T { return run(context, values...); },
            needs...);
    }

    void addGeometry(PassList& list) {
        const size_t count = showing_.objects().size();
        PassText text =
            textOf("geometry", formatText("{} objects to place", count),
                   count == 0 ? "the scene has no meshes and no planes" : "", "", PassNumbers::vertex);
        text.isRoot = true;
        results_->geometry = add(list, std::move(text), Geometry{}, [this](const PassContext& context) {
            return placeGeometry(settings_, context);
        });
        list.whenDone<Geometry>(geometry(),
                                [self = shared_from_this()](PassList& done, const Geometry& found) {
                                    self->facts_.geometry = &found;
                                    done.truncate(self->geometry().pass() + 1);
                                    self->addVisibility(done);
                                    self->addEnvironment(done);
                                    self->addRest(done);
                                    done.decide(self->everything_);
                                });
    }
    const Result<Geometry>& geometry() const { return *results_->geometry; }

    void addVisibility(PassList& list) {
        PassText text = textOf("visibility", "every output is of what is visible", "", "",
                               PassNumbers::vertexDepth, samples() * bytesPerVisibleSample(*profile_));
        text.isRoot = true;
        results_->visibility = add(
            list, std::move(text), VisibleView{},
            [this](const PassContext& context, const Geometry& of) {
                return findVisibleInView(settings_, context, of);
            },
            geometry());
        list.whenDone<VisibleView>(
            visibility(), [self = shared_from_this()](PassList& done, const VisibleView& found) {
                self->facts_.visibility = visibilityFacts(*found.scene, self->showing_.objects().size());
                done.truncate(self->visibility().pass() + 1);
                self->addEnvironment(done);
                self->addRest(done);
                done.decide(self->everything_);
            });
    }
    const Result<VisibleView>& visibility() const { return *results_->visibility; }

    void addEnvironment(PassList& list) {
        const bool isFile = scene_.environment.kind == EnvironmentKind::file;
        results_->environmentImage =
            add(list, textOf("environment image", "", isFile ? "" : "the environment is not an image"),
                EnvironmentImage{settings_.environment, {}}, [this, isFile](const PassContext&) {
                    EnvironmentImage image{settings_.environment, {}};
                    if (isFile)
                        image.radiance.latLong = loadEnvironment(scene_, settings_.strict, image.warnings);
                    return image;
                });
        const EnvironmentLightMethod method = scene_.environment.lighting;
        results_->illumination = add(
            list,
            textOf(
                std::string(kEnvironmentLight),
                formatText("surfaces are lit by the environment: {}", nameOf(method)),
                method == EnvironmentLightMethod::none ? "it lights no surfaces"
                : showing_.environmentIsBlack()        ? "the environment is black"
                                                       : "",
                "",
                method == EnvironmentLightMethod::dominant ? PassNumbers::doubles : PassNumbers::environment,
                isLightMap(method) ? kFacesPerCube * squared(scene_.environment.mapSize) * 3 * kBytesPerFloat
                                   : 0),
            EnvironmentIllumination{},
            [this](const PassContext& context, const EnvironmentImage& image) {
                return lightOfEnvironment(settings_, context, image);
            },
            image());
        if (!environmentCasts()) return;
        list.whenDone<EnvironmentIllumination>(
            illumination(),
            [self = shared_from_this()](PassList& done, const EnvironmentIllumination& found) {
                self->facts_.casters = castersOf(self->scene_.environment, found.lights);
                done.passes[self->illumination().pass()].reason +=
                    castersText(*self->facts_.casters, found.lights.size());
                done.truncate(self->illumination().pass() + 1);
                self->addRest(done);
                done.decide(self->everything_);
            });
    }
    const Result<EnvironmentImage>& image() const { return *results_->environmentImage; }
    const Result<EnvironmentIllumination>& illumination() const { return *results_->illumination; }
    // For passes that the environment's light is a part of.
    using Illumination = std::vector<Result<EnvironmentIllumination>>;
    Illumination illuminationIf(bool condition) const {
        return condition ? Illumination{illumination()} : Illumination{};
    }
    static const EnvironmentIllumination& only(const std::vector<const EnvironmentIllumination*>& of) {
        static const EnvironmentIllumination none;
        return of.empty() ? none : *of.front();
    }

    void addRest(PassList& list) {
        addLights(list);
        addShadows(list);
        addEnvironmentCube(list);
        addCubes(list);
        addOcclusion(list);
        addVertexLighting(list);
        addViewShadows(list);
        addTerms(list);
        addShading(list);
        addFrame(list);
    }

    void addLights(PassList& list) {
        std::vector<bool> shows = showing_.lightsThatShow();
        showing_.takeAssumption();
        const auto shown = std::ranges::count(shows, true);
        if (everything_) std::fill(shows.begin(), shows.end(), true);
        std::string why = formatText("{} of {} lights of the scene may show", shown, shows.size());
        if (showing_.environmentHasLights()) why += ", and those of the environment";
        lights_ = add(
            list,
            textOf("lights", why,
                   shows.empty() && !showing_.environmentHasLights() ? "no lights in the scene" : ""),
            SceneLights{},
            [this, shows](const PassContext&,
                          const std::vector<const EnvironmentIllumination*>& environment) {
                SceneLights lights;
                lights.addScene(scene_, shows);
                lights.addEnvironment(only(environment).lights);
                return lights;
            },
            illuminationIf(showing_.environmentHasLights()));
    }

    // What each light asks for, if something lies in its way.
    void addShadows(PassList& list) {
        shadows_.clear(), casting_.clear(), mapFiles_.clear(), notMade_.clear();
        for (size_t l = 0; l < scene_.lights.size(); l++) {
            const SceneLight& light = scene_.lights[l];
            const bool isDirectional = light.kind == LightKind::directional;
            if (light.shadow.method != ShadowMethod::none)
                addShadow(list, {LightId::Of::scene, l}, light, light.shadow,
                          isBlack(isDirectional ? light.irradiance : light.intensity), "");
        }
        const Environment& environment = scene_.environment;
        if (!environmentCasts()) return;
        if (facts_.casters) {
            for (const EnvironmentCaster& caster : *facts_.casters)
                addShadow(list, {LightId::Of::environment, caster.light}, caster.source, environment.shadow,
                          false,
                          formatText("region of {:.3g} sr, {:.3g} % of the energy; ", caster.solidAngle_sr,
                                     100 * caster.share));
            if (!facts_.casters->empty()) return;
        }
        // Those that are not known yet, or that there are none.
        const int most = environment.shadowShare > 0 ? kMaxShadowLights : environment.shadowLights;
        const int lights = environment.lighting == EnvironmentLightMethod::lights
                               ? environment.lightCount
                               : DominantLightSearch{}.maxLights;
        PassText text = textOf("shadows of environment lights", "its lights are known once it is read",
                               !facts_.casters               ? ""
                               : environment.shadowShare > 0 ? "no light has so large a share of its energy"
                                                             : "it has no lights",
                               "", PassNumbers::fragment,
                               static_cast<uint64_t>(std::min(most, lights)) *
                                   shadowMemory(environment.shadow, true, planarReceivers()));
        text.dependsOn = kEnvironmentLight;
        text.isLookedUp = true;
        shadows_.push_back(add(
            list, std::move(text), CastShadow{},
            [](const PassContext&, const SceneLights&) { return CastShadow{}; }, *lights_));
        if (environment.shadow.method != ShadowMethod::map) return;
        // Their maps may be an output, for which the lights are found.
        const std::string& nothing = list.passes.back().text.nothing;
        if (nothing.empty())
            mapFiles_.emplace_back(LightId{LightId::Of::environment, 0}, shadows_.back());
        else if (asked("shadow_map"))
            notMade_.push_back("no shadow map of the environment is made: " + nothing);
    }
    size_t planarReceivers() const {
        const auto known = showing_.planarReceivers();
        return known ? known->size() : showing_.objects().size();
    }
    void addShadow(PassList& list, LightId id, const SurfaceLight& source, const LightShadow& shadow,
                   bool isBlack, const std::string& about) {
        casting_.push_back(id);
        const bool isDirectional = source.kind == LightKind::directional;
        // Where the shadow itself is shown, also a black light has one.
        const bool isMapOutput = asked("shadow_map") && shadow.method == ShadowMethod::map;
        const bool isOutput = asked("shadow") || isMapOutput;
        const std::optional<ShadowFit> fit = showing_.fitOf(source, shadow);
        const std::string nothing = isBlack && !isOutput
                                        ? "the light is black, and no output shows its shadow"
                                        : showing_.whyNoShadow(source, shadow, fit, isOutput);
        std::string why = "objects may stand in the light's way";
        if (fit) why = "cast by " + showing_.namesOf(fit->casters);
        if (const auto planes = showing_.planarReceivers(); planes && shadow.method == ShadowMethod::planar)
            why = "may fall on " + showing_.namesOf(*planes);
        PassText text = textOf(formatText("{} of {}", passNameOf(shadow.method), nameOf(id)), about + why,
                               nothing.empty() ? "" : about + nothing, "", PassNumbers::fragment,
                               shadowMemory(shadow, isDirectional, planarReceivers()));
        if (isMapOutput && !nothing.empty())
            notMade_.push_back(formatText("{} is not made: {}", text.name, nothing));
        if (shadow.method == ShadowMethod::volume) text.numbers = PassNumbers::none;
        text.isLookedUp = true;
        const auto addOf = [&](auto run) {
            shadows_.push_back(
                add(list, std::move(text), CastShadow{}, std::move(run), geometry(), *lights_));
        };
        switch (shadow.method) {
            case ShadowMethod::none:
                break;
            case ShadowMethod::map:
                addOf([this, id, fit, isMapOutput, map = shadow.map](
                          const PassContext& context, const Geometry& of, const SceneLights& lights) {
                    return castByMap(settings_, context, of, lights, id, fit.value_or(ShadowFit{}), map,
                                     isMapOutput);
                });
                if (nothing.empty()) mapFiles_.emplace_back(id, shadows_.back());
                break;
            case ShadowMethod::volume:
                addOf([id, fit](const PassContext&, const Geometry&, const SceneLights& lights) {
                    return castByVolumes(lights, id, fit.value_or(ShadowFit{}).casters);
                });
                break;
            case ShadowMethod::planar:
                addOf([this, id, receivers = showing_.receivers(), planar = shadow.planar](
                          const PassContext& context, const Geometry& of, const SceneLights& lights) {
                    return castOnPlanes(settings_, context, of, lights, id, receivers, planar);
                });
                // Only their images say where they fall.
                list.whenDone<CastShadow>(shadows_.back(), [pass = shadows_.back().pass(), about](
                                                               PassList& done, const CastShadow& found) {
                    if (!done.passes[pass].runs) return;
                    std::string& reason = done.passes[pass].reason;
                    reason = about + "no shadow falls on a plane that is visible";
                    for (size_t i = 0; i < found.fallsOn.size(); i++)
                        reason = (i == 0 ? about + "fall on " : reason + ", ") + found.fallsOn[i];
                });
                break;
        }
    }

    void addEnvironmentCube(PassList& list) {
        const bool isFile = scene_.environment.kind == EnvironmentKind::file;
        environmentCube_ = add(
            list,
            textOf("environment cube map", "a mirror reflects the environment",
                   isFile ? "" : "the environment is not an image",
                   "no mirror that runs reflects the environment", PassNumbers::fragment),
            std::optional<CubeMap<float>>{},
            [this](const PassContext& context, const EnvironmentImage& of) -> std::optional<CubeMap<float>> {
                if (of.radiance.latLong.empty()) return std::nullopt;
                requireSampling(scene_, context.profile, context.profile.fragment, of);
                return environmentCube(of.radiance, context.profile, settings_.raster.threads);
            },
            image());
    }
    using EnvironmentCube = std::vector<Result<std::optional<CubeMap<float>>>>;
    EnvironmentCube environmentCubeIf(bool condition) const {
        return condition || everything_ ? EnvironmentCube{*environmentCube_} : EnvironmentCube{};
    }

    // A cube map of the scene for each mirror that asks for one. Mirrors in it show what they showed in the cube maps of
    // one reflection less, those of the first reflection the environment.
    void addCubes(PassList& list) {
        cubeFiles_.clear();
        const int reflections = scene_.render.reflections;
        for (int reflection = 1; reflection <= reflections; reflection++) {
            const auto before = reflection == 1 ? std::vector<ObjectCube>{} : std::move(cubes_);
            cubes_.clear();
            for (uint32_t i = 0; i < showing_.objects().size(); i++)
                if (showing_.hasCube(i)) addCube(list, i, reflection, before);
        }
    }
    using ObjectCube = std::pair<uint32_t, Result<CubeRender>>;
    void addCube(PassList& list, uint32_t i, int reflection, const std::vector<ObjectCube>& before) {
        const bool isLast = reflection == scene_.render.reflections;
        const int size = scene_.meshes[showing_.objects()[i].index].cubeSize;
        const bool hasOcclusion =
            everything_ ? scene_.render.occlusionDirections > 0 : showing_.cubesHaveOcclusion();
        showing_.takeAssumption();
        const std::string nothing = isLast ? showing_.whyNoCube(i) : showing_.whyNoCubeForCubes(i);
        std::string name = "cube map of " + showing_.objects()[i].name;
        if (!isLast) name += formatText(", reflection {} of {}", reflection, scene_.render.reflections);
        std::vector<uint32_t> mirrors;
        std::vector<Result<CubeRender>> reflected;
        for (const auto& [object, cube] : before)
            if (object != i) mirrors.push_back(object), reflected.push_back(cube);
        const Result<CubeRender> cube = add(
            list,
            textOf(name,
                   isLast ? "a visible mirror reflects the scene" : "mirrors in cube maps reflect the scene",
                   nothing, isLast ? "" : "no cube map of the next reflection is made", PassNumbers::fragment,
                   kFacesPerCube * squared(size) * 4 * kBytesPerFloat),
            CubeRender{},
            [=, this](const PassContext& context, const Geometry& of, const auto& lights,
                      const auto& radiance, const auto& environment, const auto& sky, const auto& shadows,
                      const auto& seen) {
                static const std::optional<CubeMap<float>> none;
                requireSampling(scene_, context.profile, context.profile.fragment, "a cube map", 0, size,
                                size);
                ObjectCubes cubes;
                for (size_t k = 0; k < seen.size(); k++) cubes.emplace_back(mirrors[k], &seen[k]->radiance);
                return renderObjectCube(settings_, context, i, hasOcclusion, of, lights, radiance,
                                        only(environment), sky.empty() ? none : *sky.front(), shadows, cubes);
            },
            geometry(), *lights_, image(), illuminationIf(showing_.environmentLights()),
            environmentCubeIf(showing_.cubeSeesMirror(i)), shadows_, reflected);
        list.passes.back().text.isLookedUp = true;
        if (nothing.empty() || everything_) cubes_.emplace_back(i, cube);
        if (!isLast) return;
        if (nothing.empty())
            cubeFiles_.emplace_back(i, cube);
        else if (asked("cube_map"))
            notMade_.push_back(
                formatText("cube map of {} is not made: {}", showing_.objects()[i].name, nothing));
    }

    // Of what the ambient light and the environment's diffuse light reach, where the scene asks for it.
    void addOcclusion(PassList& list) {
        occlusion_.clear(), occlusionOfFragments_.clear();
        const Render& render = scene_.render;
        if (render.occlusionDirections == 0) return;
        const bool ofAllSurfaces = asked("occlusion") || asked("irradiance");
        const std::string why =
            formatText("surfaces see their surroundings from {} directions", render.occlusionDirections);
        const auto addOf = [&](const char* name, bool ofVertices, const std::string& nothing) {
            // One depth map at a time, and a point and its sums for each fragment.
            constexpr uint64_t kBytesPerPoint = 256;
            const Result<SurfaceOcclusion> found = add(
                list,
                textOf(name, why, nothing, "", PassNumbers::doubles,
                       squared(render.occlusionMapSize) * kBytesPerSample + samples() * kBytesPerPoint),
                SurfaceOcclusion{},
                [this, ofVertices](const PassContext& context, const Geometry& of,
                                   const VisibleView& visible) {
                    return occlusionInView(settings_, context, ofVertices, of, visible);
                },
                geometry(), visibility());
            list.passes.back().text.isLookedUp = true;
            return found;
        };
        const std::string nothing =
            showing_.whyNoOcclusion(render.perVertex, ofAllSurfaces && !render.perVertex);
        hasOcclusion_ = nothing.empty() || everything_;
        occlusion_.push_back(addOf("ambient occlusion", render.perVertex, nothing));
        if (!render.perVertex)
            occlusionOfFragments_ = occlusion_;
        else if (ofAllSurfaces || environmentAsked())
            occlusionOfFragments_.push_back(addOf("ambient occlusion of fragments", false,
                                                  showing_.whyNoOcclusion(false, ofAllSurfaces)));
    }
    // Gouraud shading, where the scene asks for it.
    void addVertexLighting(PassList& list) {
        vertices_.clear();
        if (!scene_.render.perVertex) return;
        const bool hasSurroundings =
            showing_.environmentIsDiffuse() || !isBlack(scene_.ambient) || everything_;
        vertices_.push_back(add(
            list, textOf("vertex lighting", "the scene is lit per vertex", "", "", PassNumbers::vertex),
            std::vector<VertexRadiance>{},
            [this](const PassContext& context, const Geometry& of, const VisibleView& visible,
                   const SceneLights& lights, const std::vector<const EnvironmentIllumination*>& environment,
                   const std::vector<const SurfaceOcclusion*>& occlusion) {
                static const SurfaceOcclusion open;
                return lightVertices(settings_, context, of, visible, lights, only(environment),
                                     occlusion.empty() ? open : *occlusion.front());
            },
            geometry(), visibility(), *lights_, illuminationIf(showing_.environmentLights()),
            hasSurroundings ? occlusion_ : Occlusion{}));
    }

    // What stands between the lights and what the camera sees.
    void addViewShadows(PassList& list) {
        viewShadows_.clear();
        if (shadows_.empty()) return;
        std::string nothing = "no light that shows casts shadows on what is visible";
        for (const Result<CastShadow>& shadow : shadows_) {
            const PassText& text = list.passes[shadow.pass()].text;
            if (text.nothing.empty()) nothing.clear();
        }
        viewShadows_.push_back(add(
            list,
            textOf("shadows in view", "", nothing,
                   scene_.render.perVertex ? "the scene is lit per vertex, and no output shows shadows" : "",
                   PassNumbers::vertexDepth, volumeMemory(scene_, *profile_, samples())),
            ViewShadows{},
            [this](const PassContext& context, const Geometry& of, const SceneLights& lights,
                   const std::vector<const CastShadow*>& shadows) {
                return shadowsOfView(settings_, context, of, lights, shadows, settings_.view,
                                     scene_.render.samples, kNoInstance);
            },
            geometry(), *lights_, shadows_));
        list.passes.back().text.isLookedUp = true;
    }
    using InView = std::vector<Result<ViewShadows>>;
    InView viewShadowsIf(bool condition) const { return condition ? viewShadows_ : InView{}; }

    // Of a pass that is black where all of these are: whether all that may show assume that something is visible.
    template <class T>
    static std::string dependenceOf(const PassList& list, const std::vector<Result<T>>& parts) {
        const auto isCertain = [&](const Result<T>& part) {
            const PassText& text = list.passes[part.pass()].text;
            return text.nothing.empty() && text.dependsOn.empty();
        };
        return std::ranges::any_of(parts, isCertain) ? "" : std::string(kVisibility);
    }

    // A term of shading. nothing: why it is black, if it is.
    template <class AddTo, class... Needs>
    void addTerm(PassList& list, ShadeOutput output, std::string_view name, const std::string& nothing,
                 AddTo addTo, const Needs&... needs) {
        const bool isOutput = asked(name), isComponent = static_cast<int>(output) < kRadianceComponents;
        const bool isWanted = isOutput || everything_;
        const Result<ShadeTerm> term = add(
            list,
            textOf(std::string(name),
                   isOutput      ? "output asked for"
                   : isComponent ? "part of the beauty"
                                 : "the PNG shows it",
                   nothing,
                   isComponent || output == ShadeOutput::beauty ? "neither an output nor a PNG shows it"
                                                                : "not an output",
                   PassNumbers::fragment),
            ShadeTerm{},
            [output, isWanted, isComponent, addTo](const PassContext&, const auto&... values) {
                return ShadeTerm{[=, ... of = lent(values)](ShadeJob& job) {
                    if (isWanted || !isComponent) job.request[output] = true;
                    if (isComponent) job.request.evaluated[static_cast<size_t>(output)] = true;
                    addTo(job, of...);
                }};
            },
            needs...);
        const bool isShadedNow =
            isOutput || (isComponent && beautyAsked()) || (output == ShadeOutput::beauty && png_);
        if (isComponent) components_.push_back(term);
        if (isShadedNow || everything_) terms_.push_back(term);
        hasTerms_ = hasTerms_ || (isShadedNow && nothing.empty());
        hasComponents_ = hasComponents_ || (isComponent && nothing.empty());
    }
    void addTerms(PassList& list) {
        terms_.clear(), components_.clear();
        hasTerms_ = hasComponents_ = false;
        using Vertices = std::vector<const std::vector<VertexRadiance>*>;
        using Occlusions = std::vector<const SurfaceOcclusion*>;
        using Shadows = std::vector<const ViewShadows*>;
        const auto addOcclusionTo = [](ShadeJob& job, const Occlusions& occlusion) {
            if (!occlusion.empty() && !occlusion.front()->fragments.empty())
                job.occlusion = &occlusion.front()->fragments;
        };
        const auto addVerticesTo = [](ShadeJob& job, const Vertices& vertices) {
            if (!vertices.empty()) job.vertexRadiance = vertices.front();
        };
        const auto addShadowsTo = [](ShadeJob& job, const Shadows& shadows) {
            if (!shadows.empty()) job.visibility = shadows.front()->visibility.get();
        };
        const bool perVertex = scene_.render.perVertex;
        const Occlusion ofFragments = perVertex ? Occlusion{} : occlusion_;
        const InView lightShadows = viewShadowsIf(!perVertex);

        // Where lights are evaluated at vertices, these also know what is open.
        addTerm(
            list, ShadeOutput::ambient, "ambient", showing_.whyBlack(ShadeOutput::ambient),
            [=](ShadeJob& job, const Occlusions& occlusion, const Vertices& vertices) {
                addOcclusionTo(job, occlusion);
                addVerticesTo(job, vertices);
            },
            ofFragments, !occlusion_.empty() && hasOcclusion_ ? vertices_ : decltype(vertices_){});
        addTerm(
            list, ShadeOutput::diffuse, "diffuse", showing_.whyBlack(ShadeOutput::diffuse),
            [=](ShadeJob& job, const SceneLights& lights,
                const std::vector<const EnvironmentIllumination*>& environment, const Shadows& shadows,
                const Occlusions& occlusion, const Vertices& vertices) {
                job.sources = sourcesOf(lights, only(environment));
                addShadowsTo(job, shadows);
                addOcclusionTo(job, occlusion);
                addVerticesTo(job, vertices);
            },
            *lights_, illuminationIf(showing_.environmentLights()), lightShadows,
            showing_.environmentIsDiffuse() || everything_ ? ofFragments : Occlusion{}, vertices_);
        addTerm(
            list, ShadeOutput::specular, "specular", showing_.whyBlack(ShadeOutput::specular),
            [=](ShadeJob& job, const SceneLights& lights, const Shadows& shadows, const Vertices& vertices) {
                job.sources.lights = &lights.lights();
                job.sources.shows = &lights.shows();
                addShadowsTo(job, shadows);
                addVerticesTo(job, vertices);
            },
            *lights_, lightShadows, vertices_);

        std::vector<uint32_t> cubeOf;
        std::vector<Result<CubeRender>> cubes;
        for (const auto& [object, cube] : cubes_) cubeOf.push_back(object), cubes.push_back(cube);
        const std::string noMirror = showing_.whyBlack(ShadeOutput::mirror);
        const bool seesEnvironment = showing_.isEnvironmentMirrorVisible();
        addTerm(
            list, ShadeOutput::mirror, "mirror", noMirror,
            [cubeOf](ShadeJob& job, const std::vector<const std::optional<CubeMap<float>>*>& sky,
                     const std::vector<const CubeRender*>& of) {
                if (!sky.empty() && *sky.front()) job.environmentCube = &**sky.front();
                for (size_t i = 0; i < of.size(); i++) job.sceneCubes[cubeOf[i]] = &of[i]->radiance;
            },
            environmentCubeIf(seesEnvironment), cubes);
        addTerm(
            list, ShadeOutput::background, "background", showing_.whyBlack(ShadeOutput::background),
            [this, profile = profile_](ShadeJob& job, const EnvironmentImage& of) {
                requireSampling(scene_, *profile, profile->fragment, of);
                job.environment = &of.radiance;
            },
            image());

        const auto nothingMore = [](ShadeJob&, const auto&...) {};
        addTerm(
            list, ShadeOutput::beauty, "beauty", hasComponents_ ? "" : "every part of it is black",
            [](ShadeJob&, const std::vector<const ShadeTerm*>&) {}, components_);
        if (hasComponents_) list.passes.back().text.dependsOn = dependenceOf(list, components_);
        addTerm(list, ShadeOutput::normals, "normals", "", nothingMore);
        addTerm(list, ShadeOutput::distance, "distance", "", nothingMore);
        addTerm(list, ShadeOutput::depth, "depth", "", nothingMore);

        // What is found at fragments, wherever these are lit.
        std::string noShadow = "no light that shows casts shadows on what is visible";
        for (const Result<CastShadow>& shadow : shadows_)
            if (list.passes[shadow.pass()].text.nothing.empty()) noShadow.clear();
        addTerm(
            list, ShadeOutput::shadows, "shadow", noShadow,
            [=, casting = casting_](ShadeJob& job, const SceneLights& lights, const Shadows& shadows) {
                job.sources.lights = &lights.lights();
                job.sources.shows = &lights.shows();
                for (const LightId& light : casting) job.shadowLights.push_back(lights.numberOf(light));
                addShadowsTo(job, shadows);
            },
            *lights_, viewShadows_);
        addTerm(
            list, ShadeOutput::open, "occlusion", showing_.whyNothingVisible(),
            [=](ShadeJob& job, const Occlusions& occlusion) {
                job.request[ShadeOutput::bentNormals] = job.request[ShadeOutput::open];
                addOcclusionTo(job, occlusion);
            },
            occlusionOfFragments_);
        const auto addEnvironmentTo = [=](ShadeJob& job, const SceneLights& lights,
                                          const std::vector<const EnvironmentIllumination*>& environment,
                                          const Shadows& shadows, const Occlusions& occlusion) {
            job.sources = sourcesOf(lights, only(environment));
            job.environmentLights = lights.ofEnvironment();
            addShadowsTo(job, shadows);
            addOcclusionTo(job, occlusion);
        };
        const Occlusion aroundFragments =
            showing_.environmentIsDiffuse() || everything_ ? occlusionOfFragments_ : Occlusion{};
        for (const ShadeOutput output : {ShadeOutput::irradiance, ShadeOutput::environment}) {
            const bool isReflected = output == ShadeOutput::environment;
            addTerm(list, output, isReflected ? "environment" : "irradiance",
                    isReflected ? showing_.whyNoEnvironment() : showing_.whyNoIrradiance(), addEnvironmentTo,
                    *lights_, illuminationIf(showing_.environmentLights()), viewShadowsIf(environmentCasts()),
                    aroundFragments);
        }
    }

    // How many channels an output has.
    uint64_t channelsOf(std::string_view output) const {
        uint64_t channels = 0;
        for (const OutputPart& part : findOutput(output)->parts)
            channels += part.image == ShadeOutput::shadows ? casting_.size() : part.channels.size();
        return findOutput(output)->file.empty() ? channels : 0;
    }
    void addShading(PassList& list) {
        uint64_t floats = 0;
        for (const Result<ShadeTerm>& term : terms_) floats += channelsOf(list.passes[term.pass()].name());
        results_->shading = add(
            list,
            textOf("shading", "", hasTerms_ || terms_.empty() ? "" : "all that it would show is black",
                   "neither an output nor a PNG shows it", PassNumbers::fragment,
                   pixels() * floats * kBytesPerFloat),
            Shading{},
            [this](const PassContext& context, const Geometry& of, const VisibleView& visible,
                   const std::vector<const ShadeTerm*>& terms) {
                return shadeView(settings_, context, of, visible, terms);
            },
            geometry(), visibility(), terms_);
        if (hasTerms_) list.passes.back().text.dependsOn = dependenceOf(list, terms_);
    }

    void addFrame(PassList& list) {
        std::vector<Result<OutputChannels>> made;
        const auto addOutput = [&](std::string_view name, OutputChannels (*make)(const VisibleView&)) {
            const Result<OutputChannels> output = add(
                list,
                textOf(std::string(name), "output asked for", "", "not an output", PassNumbers::none,
                       pixels() * channelsOf(name) * kBytesPerFloat),
                OutputChannels{name, {}},
                [make](const PassContext&, const VisibleView& visible) { return make(visible); },
                visibility());
            if (asked(name) || everything_) made.push_back(output);
        };
        addOutput("alpha", alphaChannels);
        addOutput("window_depth", windowDepthChannels);
        addOutput("ids", idChannels);
        addOutput("coverage", coverageChannels);

        uint64_t floats = 0;
        bool isAnyShaded = false;
        for (const std::string& output : outputs_) {
            floats += channelsOf(output);
            for (const OutputPart& part : findOutput(output)->parts) isAnyShaded = isAnyShaded || part.image;
        }
        using ShadingIf = std::vector<Result<Shading>>;
        PassText text = textOf("frame", "the outputs as channels", "", "", PassNumbers::none,
                               pixels() * floats * kBytesPerFloat);
        text.isRoot = true;
        results_->frame = add(
            list, std::move(text), Frame{},
            [this, casting = casting_](const PassContext& context,
                                       const std::vector<const OutputChannels*>& channels,
                                       const std::vector<const Shading*>& shading) {
                static const Shading none;
                return frameOf(settings_, context, outputs_, casting, channels,
                               shading.empty() ? none : *shading.front());
            },
            made, isAnyShaded || everything_ ? ShadingIf{*results_->shading} : ShadingIf{});

        addFiles(list);

        PassText png = textOf("tone mapping", "a PNG is written", "", "no PNG is written", PassNumbers::none,
                              pixels() * 3);
        png.isRoot = png_;
        results_->toned = add(
            list, std::move(png), Image<uint8_t>{},
            [this](const PassContext&, const Shading& shading) { return toneMapped(settings_, shading); },
            *results_->shading);
    }

    // Outputs that are files of their own.
    void addFiles(PassList& list) {
        const auto textOfFiles = [&](const char* output, uint64_t bytes) {
            PassText text = textOf(output, "output asked for", "", "not an output", PassNumbers::none, bytes);
            text.isRoot = asked(output);
            return text;
        };
        std::vector<uint32_t> instances;
        std::vector<LightId> lights;
        std::vector<Result<CubeRender>> cubes;
        std::vector<Result<CastShadow>> maps;
        uint64_t cube_bytes = 0, map_bytes = 0;
        for (const auto& [instance, cube] : cubeFiles_) {
            cubes.push_back(cube);
            if (!asked("cube_map")) continue;
            instances.push_back(instance);
            cube_bytes += list.passes[cube.pass()].memory_bytes();
        }
        // The texels of a file are a part of what the map's pass holds.
        for (const auto& [light, map] : mapFiles_) {
            lights.push_back(light), maps.push_back(map);
            map_bytes += asked("shadow_map") ? list.passes[map.pass()].memory_bytes() : 0;
        }
        results_->cubeFiles = add(
            list, textOfFiles("cube_map", cube_bytes), std::vector<OutputFile>{},
            [this, instances](const PassContext& context, const Geometry& of,
                              const std::vector<const CubeRender*>& rendered) {
                return cubeMapFiles(settings_, context, of, instances, rendered);
            },
            geometry(), cubes);
        results_->mapFiles = add(
            list, textOfFiles("shadow_map", map_bytes), std::vector<OutputFile>{},
            [this, lights](const PassContext& context, const std::vector<const CastShadow*>& shadows) {
                return shadowMapFiles(settings_, context, lights, shadows);
            },
            maps);
        results_->notMade = notMade_;
    }

    const Scene& scene_;
    const std::vector<std::string> outputs_;
    const bool png_, everything_;
    std::shared_ptr<const Profile> profile_;
    PlanFacts facts_;
    Showing showing_;
    const SceneSettings settings_;

    // What passes are added with, as far as they are: of the plan as it is now.
    std::shared_ptr<PlanResults> results_ = std::make_shared<PlanResults>();
    std::optional<Result<SceneLights>> lights_;
    std::vector<Result<CastShadow>> shadows_;
    std::vector<LightId> casting_;  // the lights that are known to have shadows
    std::optional<Result<std::optional<CubeMap<float>>>> environmentCube_;
    std::vector<ObjectCube> cubes_, cubeFiles_;
    std::vector<std::pair<LightId, Result<CastShadow>>> mapFiles_;
    std::vector<std::string> notMade_;            // files that are asked for
    Occlusion occlusion_, occlusionOfFragments_;  // where surfaces are lit; of fragments in any case
    bool hasOcclusion_ = false;
    std::vector<Result<std::vector<VertexRadiance>>> vertices_;
    std::vector<Result<ViewShadows>> viewShadows_;
    Terms terms_, components_;  // that shading shows; of the beauty
    bool hasTerms_ = false, hasComponents_ = false;
};

}  // namespace

Plan makePlan(const Scene& scene, const RenderOptions& options, PlanFacts facts) {
    const auto planner = std::make_shared<Planner>(scene, options, std::move(facts));
    Plan plan;
    planner->plan(plan);
    plan.results = planner->results();
    return plan;
}

}  // namespace etalon
