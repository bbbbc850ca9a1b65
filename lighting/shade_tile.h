// Shading of one tile over a number type T. Included by the sources that instantiate it, one per number type.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "lighting/environment_irradiance.h"
#include "lighting/shading_kernels.h"
#include "lighting/shading_passes.h"
#include "lighting/surface_lighting.h"
#include "lighting/tile_triangles.h"
#include "numeric/number.h"
#include "raster/fragments.h"

namespace etalon {

template <class T>
class TileShaderOf final : public TileShader {
  public:
    explicit TileShaderOf(const ShadeJob& job);
    void run(size_t number, const PixelRectangle& rectangle, ShadedImages& images,
             ShadeStatistics& statistics) override;
    LitPoints points(const PixelRectangle& rectangle) override;

  private:
    using K = ShadingKernels<T>;
    using vec3 = typename K::vec3;
    static constexpr int N = Number<T>::lanes;

    using Stored = typename Number<T>::Stored;
    using Triangles = TileTriangles<T>;
    using Weights = typename Triangles::Weights;

    using Lighting = SurfaceLighting<T>;

    // What of a material the wanted outputs show, and what that needs.
    struct Parts : Lighting::SurfaceParts {
        bool distance, seen, needNormal, needEye, needPlace;
    };
    // Fragments that are shaded by the same texts and constants: their numbers, ascending. An instance that
    // reflects the scene has buckets of its own, so that their order is that of the scene, whatever cube maps
    // the job has (fragmentPoints).
    struct Bucket {
        const SurfaceMaterial* material;
        const CubeMap<float>* cube;
        uint32_t mirror;  // the instance that reflects the scene, or kNoTriangle
        Parts parts;
        typename K::Reflectances reflectances;
        std::vector<uint32_t> fragments;
        size_t number = 0;  // Group::number of the first one
    };
    // 1 to N fragments of a bucket.
    struct Group {
        std::span<const uint32_t> fragments;
        size_t number;  // of the first one among those of all buckets but the background, in their order
        typename Triangles::Group lanes;
        // Whether the fragments are neighbours in memory.
        bool isRun() const { return fragments.back() - fragments.front() == fragments.size() - 1; }
    };
    using Surroundings = typename Lighting::Surroundings;
    using Visibility = typename Lighting::VisibilityBuffer;

    // What the fragments of a group are shaded with: weights, and what the wanted outputs read.
    struct Surface {
        Weights w;
        vec3 normal, position;
    };
    // Fragments whose visibility is found at once, in whole groups.
    static constexpr size_t kChunk = 512;
    static_assert(kChunk % N == 0);

    static vec3 constant(const glm::dvec3& v) { return Lighting::constant(v); }
    void collect(const PixelRectangle& rectangle, bool withPoints);
    void setUpTriangles(bool withPoints);
    void setFaceNormal(size_t number, uint32_t id, const PlacedMesh& placed);
    size_t bucketOf(const SurfaceMaterial& material, const CubeMap<float>* cube, uint32_t mirror);
    void sortIntoBuckets();
    Group groupOf(const Bucket& bucket, size_t first, int count) const;
    Parts partsOf(const SurfaceMaterial& material) const;
    static void setItems(const Group& group);
    Surface surfaceOf(const Group& group, bool needNormal, bool needPosition) const;
    void shadeShadowed(const Bucket& bucket);
    void resizePoints(size_t count);
    Surroundings surroundingsOf(const Weights& w, const Group& group) const;
    void setPoints(const Group& group, const Surface& surface, size_t first);
    void shadeBackground(const Group& group);
    void shadeSurface(const Bucket& bucket, const Group& group);
    void shadeSurface(const Bucket& bucket, const Group& group, const Surface& surface,
                      const Visibility& visibility);
    vec3 albedo(const Bucket& bucket, const Weights& w, const Group& group);
    vec3 mirrored(const Bucket& bucket, const vec3& n, const vec3& toEye);
    static std::vector<bool> castsOf(const ShadeJob& job);
    static typename K::EnvironmentView environmentOf(const ShadeJob& job);
    bool wantsSeen() const;
    void putSeen(const Bucket& bucket, const Group& group, const Surface& surface,
                 const Visibility& visibility);
    Surroundings fragmentSurroundings(const Group& group) const;
    void put(ShadeOutput output, const Group& group, const vec3& value);
    void putNumber(Stored* to, const Group& group, const T& value);
    void resolve(ShadeOutput output, const PixelRectangle& rectangle, Image<float>& image);
    void copyFirstSample(ShadeOutput output, const PixelRectangle& rectangle, Image<float>& image);
    // The values of a channel, one per fragment.
    Stored* values(ShadeOutput output, int channel) {
        return &values_[static_cast<size_t>(output)][static_cast<size_t>(channel) * tile_.size()];
    }

    const ShadeJob& job_;
    K kernels_;
    std::vector<bool> casts_;  // for each light whether its visibility is asked for; empty: for none
    Lighting lighting_;
    SamplerSettings sampler_;
    typename K::EnvironmentView environment_;
    // Where an image shows what the environment gives.
    std::optional<EnvironmentIrradiance<T>> received_;
    vec3 ambient_, eye_, forward_;
    bool hasOcclusion_ = false;                          // else all is open
    const std::vector<Occlusion>* occlusion_ = nullptr;  // of the tile's fragments, where these have it
    // A chunk: its groups, and the visibility of its points for each light.
    std::vector<std::pair<Group, Surface>> chunk_;
    LitPoints points_;
    std::vector<double> visibility_;
    TileFragments tile_;
    Triangles triangles_;
    std::vector<Bucket> buckets_;  // the first is the background
    std::vector<size_t> bucketOfTriangle_;
    // Of the triangles, where points are asked for.
    std::vector<glm::dvec3> faceNormals_;
    std::vector<uint32_t> instances_;
    std::array<std::vector<Stored>, kShadeOutputs> values_;
};

template <class T>
TileShaderOf<T>::TileShaderOf(const ShadeJob& job)
    : job_(job),
      casts_(castsOf(job)),
      lighting_(job.sources, samplerOf(*job.profile), casts_),
      sampler_(samplerOf(*job.profile)),
      environment_(environmentOf(job)) {
    ambient_ = constant(job.scene->ambient);
    eye_ = constant(job.view->eye);
    forward_ = constant(job.view->forward);
    buckets_.push_back(Bucket{nullptr, nullptr, kNoTriangle, {}, {}, {}, 0});
    hasOcclusion_ =
        job.vertexRadiance
            ? std::ranges::any_of(*job.vertexRadiance,
                                  [](const VertexRadiance& of) { return !of.sides[0].open.empty(); })
            : job.occlusion != nullptr;
    if (job.request[ShadeOutput::irradiance] || job.request[ShadeOutput::environment])
        received_.emplace(*job.sources.environment, *job.sources.lights, job.environmentLights, sampler_,
                          casts_);
}

// Whose visibility something asks for.
template <class T>
std::vector<bool> TileShaderOf<T>::castsOf(const ShadeJob& job) {
    if (!job.visibility) return {};
    const ShadeRequest& request = job.request;
    const LightSources& sources = job.sources;
    const bool isLit =
        !job.vertexRadiance && (request.needs(ShadeOutput::diffuse) || request.needs(ShadeOutput::specular));
    std::vector<bool> casts(sources.lights->size(), false);
    for (size_t l = 0; l < casts.size(); l++) casts[l] = isLit && (!sources.shows || (*sources.shows)[l]);
    if (request[ShadeOutput::shadows])
        for (const size_t l : job.shadowLights) casts[l] = true;
    if (request[ShadeOutput::irradiance] || request[ShadeOutput::environment])
        for (const size_t l : job.environmentLights) casts[l] = true;
    for (size_t l = 0; l < casts.size(); l++) casts[l] = casts[l] && job.visibility->casts(l);
    if (std::find(casts.begin(), casts.end(), true) == casts.end()) casts.clear();
    return casts;
}

template <class T>
typename ShadingKernels<T>::EnvironmentView TileShaderOf<T>::environmentOf(const ShadeJob& job) {
    const SurfaceEnvironment& environment = *job.environment;
    return {environment.latLong.empty() ? 1 : 0, constant(environment.constant), T(environment.cosRotation),
            T(-environment.sinRotation)};
}

// Lists what is visible and sorts it by what shades it.
template <class T>
void TileShaderOf<T>::collect(const PixelRectangle& rectangle, bool withPoints) {
    tile_.collect(*job_.target, rectangle);
    setItemsOf<T, N>([](int) { return 0u; });
    setUpTriangles(withPoints);
    sortIntoBuckets();
}

template <class T>
LitPoints TileShaderOf<T>::points(const PixelRectangle& rectangle) {
    collect(rectangle, true);
    resizePoints(tile_.size() - buckets_[0].fragments.size());
    for (size_t b = 1; b < buckets_.size(); b++)
        forEachLaneGroup<N>(buckets_[b].fragments.size(), [&](size_t first, int active) {
            const Group group = groupOf(buckets_[b], first, active);
            setItems(group);
            setPoints(group, surfaceOf(group, true, true), group.number);
        });
    return points_;
}

template <class T>
void TileShaderOf<T>::run(size_t number, const PixelRectangle& rectangle, ShadedImages& images,
                          ShadeStatistics& statistics) {
    // List what is visible, shade, write the images.
    collect(rectangle, !casts_.empty());
    occlusion_ = job_.occlusion ? &(*job_.occlusion)[number] : nullptr;
    for (size_t o = 0; o < kShadeOutputs; o++)
        if (job_.request.wanted[o])
            values_[o].assign(std::max(3, channelsOf(job_, static_cast<ShadeOutput>(o))) * tile_.size(),
                              Stored(0));
    for (size_t b = 0; b < buckets_.size(); b++) {
        const std::vector<uint32_t>& list = buckets_[b].fragments;
        if (b > 0 && !casts_.empty())
            shadeShadowed(buckets_[b]);
        else
            forEachLaneGroup<N>(list.size(), [&](size_t first, int active) {
                const Group group = groupOf(buckets_[b], first, active);
                setItems(group);
                b == 0 ? shadeBackground(group) : shadeSurface(buckets_[b], group);
            });
        (b == 0 ? statistics.backgroundFragments : statistics.surfaceFragments) += list.size();
    }
    for (size_t o = 0; o < kShadeOutputs; o++) {
        if (images.images[o].empty()) continue;
        if (isResolved(static_cast<ShadeOutput>(o)) && job_.target->format.samples > 1)
            resolve(static_cast<ShadeOutput>(o), rectangle, images.images[o]);
        else
            copyFirstSample(static_cast<ShadeOutput>(o), rectangle, images.images[o]);
    }
}

template <class T>
size_t TileShaderOf<T>::bucketOf(const SurfaceMaterial& material, const CubeMap<float>* cube,
                                 uint32_t mirror) {
    const auto isOf = [&](const Bucket& b) {
        return b.material == &material && b.cube == cube && b.mirror == mirror;
    };
    size_t b = 1;
    while (b < buckets_.size() && !isOf(buckets_[b])) b++;
    if (b == buckets_.size())
        buckets_.push_back(
            Bucket{&material, cube, mirror, partsOf(material), Lighting::reflectancesOf(material), {}, 0});
    return b;
}

// Each visible triangle's bucket, and what its fragments share.
template <class T>
void TileShaderOf<T>::setUpTriangles(bool withPoints) {
    const size_t count = tile_.triangles.size();
    // Those of other tiles go, so that the order of the buckets is the tile's own (fragmentPoints).
    buckets_.erase(buckets_.begin() + 1, buckets_.end());
    triangles_.reset(count);
    bucketOfTriangle_.assign(count, 0);
    if (withPoints) faceNormals_.assign(count, glm::dvec3(0)), instances_.assign(count, kNoTriangle);
    for (size_t i = 0; i < count; i++) {
        const uint32_t id = tile_.triangles[i];
        if (id == kNoTriangle) continue;
        const uint32_t instance = job_.instanceOfDraw[job_.target->triangles[id].draw];
        const CubeMap<float>* cube =
            job_.sceneCubes[instance] ? job_.sceneCubes[instance] : job_.environmentCube;
        const SurfaceInstance& object = job_.scene->instances[instance];
        bucketOfTriangle_[i] = bucketOf(job_.scene->materials[object.material], cube,
                                        object.reflection == Reflection::scene ? instance : kNoTriangle);
        triangles_.set(i, *job_.target, id, (*job_.placed)[instance]);
        if (withPoints) {
            setFaceNormal(i, id, (*job_.placed)[instance]);
            instances_[i] = instance;
        }
        if (job_.vertexRadiance)
            triangles_.setRadiance(i, *job_.target, id, (*job_.placed)[instance],
                                   (*job_.vertexRadiance)[instance]);
    }
}

// In the fragment arithmetic from the vertices in world space, turned to the side that is seen; 0 for
// triangles without an area.
template <class T>
void TileShaderOf<T>::setFaceNormal(size_t number, uint32_t id, const PlacedMesh& placed) {
    const uint32_t* index = &placed.mesh->indices[3 * size_t{job_.target->triangle(id).triangle}];
    const auto corner = [&](size_t k) { return constant(placed.positions[index[k]]); };
    const vec3 normal = kernels_.faceNormal(corner(0), corner(1), corner(2));
    const double side = (job_.target->triangle(id).front != placed.mirrored) ? 1.0 : -1.0;
    for (int c = 0; c < 3; c++) faceNormals_[number][c] = side * numberLane(normal[c], 0);
}

template <class T>
void TileShaderOf<T>::sortIntoBuckets() {
    for (Bucket& bucket : buckets_) bucket.fragments.clear();
    for (uint32_t f = 0; f < tile_.size(); f++)
        buckets_[bucketOfTriangle_[tile_.triangle[f]]].fragments.push_back(f);
    size_t number = 0;
    for (size_t b = 1; b < buckets_.size(); b++) {
        buckets_[b].number = number;
        number += buckets_[b].fragments.size();
    }
}

// Fragments of a bucket from its `first` on. The lanes behind a short group repeat its last fragment.
template <class T>
typename TileShaderOf<T>::Group TileShaderOf<T>::groupOf(const Bucket& bucket, size_t first,
                                                         int count) const {
    Group group;
    const std::span<const uint32_t> fragments(&bucket.fragments[first], static_cast<size_t>(count));
    group.fragments = fragments;
    group.number = bucket.number + first;
    auto& lanes = group.lanes;
    for (size_t i = 0; i < static_cast<size_t>(N); i++) {
        const uint32_t f = fragments[std::min(i, fragments.size() - 1)];
        lanes.triangle[i] = tile_.triangle[f];
        lanes.x_subpx[i] = tile_.x_subpx[f];
        lanes.y_subpx[i] = tile_.y_subpx[f];
    }
    lanes.isOneTriangle = std::all_of(lanes.triangle.begin(), lanes.triangle.end(),
                                      [&](uint32_t t) { return t == lanes.triangle[0]; });
    return group;
}

// What the group's lanes draw with (numeric/emulated_format.h): the places of their samples.
template <class T>
void TileShaderOf<T>::setItems(const Group& group) {
    setItemsOf<T, N>([&](int i) {
        const auto lane = static_cast<size_t>(i);
        return itemOfPlace(group.lanes.x_subpx[lane], group.lanes.y_subpx[lane]);
    });
}

// What the corners of the group's triangles give its fragments.
template <class T>
typename TileShaderOf<T>::Surface TileShaderOf<T>::surfaceOf(const Group& group, bool needNormal,
                                                             bool needPosition) const {
    const vec3 none = constant(glm::dvec3(0));
    Surface surface{triangles_.weights(group.lanes), none, none};
    K kernels;
    if (needNormal) surface.normal = kernels.seenNormal(triangles_.normal(surface.w), surface.w.facing);
    if (needPosition) surface.position = triangles_.position(surface.w, group.lanes);
    return surface;
}

// A bucket under lights that may be blocked: interpolates some groups, asks what reaches them of the lights,
// shades them.
template <class T>
void TileShaderOf<T>::shadeShadowed(const Bucket& bucket) {
    // Behind the last point there are numbers, too, for its group's other lanes.
    visibility_.assign(casts_.size() * kChunk, 1);
    for (size_t begin = 0; begin < bucket.fragments.size(); begin += kChunk) {
        const size_t count = std::min(kChunk, bucket.fragments.size() - begin);
        resizePoints(count);
        chunk_.clear();
        forEachLaneGroup<N>(count, [&](size_t first, int active) {
            const Group group = groupOf(bucket, begin + first, active);
            setItems(group);
            chunk_.emplace_back(group, surfaceOf(group, true, true));
            setPoints(group, chunk_.back().second, first);
        });
        // Look-ups take the points in groups of their own.
        setItemsOf<T, N>([](int) { return 0u; });
        for (size_t l = 0; l < casts_.size(); l++)
            if (casts_[l])
                job_.visibility->find(l, points_, std::span(visibility_).subspan(l * kChunk, count));
        for (size_t g = 0; g < chunk_.size(); g++) {
            setItems(chunk_[g].first);
            shadeSurface(bucket, chunk_[g].first, chunk_[g].second, {&visibility_[g * N], kChunk});
        }
    }
}

template <class T>
void TileShaderOf<T>::resizePoints(size_t count) {
    for (auto* vectors : {&points_.position_m, &points_.normal, &points_.faceNormal})
        for (std::vector<double>& component : *vectors) component.resize(count);
    points_.instance.resize(count);
    points_.x_px.resize(count), points_.y_px.resize(count);
}

// What the group's fragments see of their surroundings; where they are lit by their vertices, interpolated:
// then the bent normal is not used.
template <class T>
typename TileShaderOf<T>::Surroundings TileShaderOf<T>::surroundingsOf(const Weights& w,
                                                                       const Group& group) const {
    if (job_.vertexRadiance) return {triangles_.open(w, group.lanes), constant(glm::dvec3(0))};
    return fragmentSurroundings(group);
}
// What occlusion_ has of them.
template <class T>
typename TileShaderOf<T>::Surroundings TileShaderOf<T>::fragmentSurroundings(const Group& group) const {
    const auto load = [&](const auto& valueOf) {
        return Number<T>::generate([&](int i) {
            const size_t last = group.fragments.size() - 1;
            return valueOf((*occlusion_)[group.number + std::min(static_cast<size_t>(i), last)]);
        });
    };
    const auto bent = [&](int c) { return load([c](const Occlusion& of) { return of.bentNormal[c]; }); };
    return {load([](const Occlusion& of) { return of.open; }), {bent(0), bent(1), bent(2)}};
}

// The group's fragments as points, from `first` on.
template <class T>
void TileShaderOf<T>::setPoints(const Group& group, const Surface& surface, size_t first) {
    const auto active = static_cast<int>(group.fragments.size());
    for (int c = 0; c < 3; c++) {
        const auto component = static_cast<size_t>(c);
        Number<T>::store(surface.position[c], &points_.position_m[component][first], active);
        Number<T>::store(surface.normal[c], &points_.normal[component][first], active);
    }
    const int n = job_.target->format.subpixelBits;
    for (size_t i = 0; i < group.fragments.size(); i++) {
        const size_t triangle = group.lanes.triangle[i], point = first + i;
        points_.x_px[point] = static_cast<uint32_t>(group.lanes.x_subpx[i] >> n);
        points_.y_px[point] = static_cast<uint32_t>(group.lanes.y_subpx[i] >> n);
        points_.instance[point] = instances_[triangle];
        const glm::dvec3& face = faceNormals_[triangle];
        for (int c = 0; c < 3; c++) points_.faceNormal[static_cast<size_t>(c)][point] = face[c];
    }
}

// The environment in the direction of the pixel's centre.
template <class T>
void TileShaderOf<T>::shadeBackground(const Group& group) {
    const vec3 infinity = constant(glm::dvec3(std::numeric_limits<double>::infinity()));
    put(ShadeOutput::distance, group, infinity);
    put(ShadeOutput::depth, group, infinity);
    put(ShadeOutput::open, group, constant(glm::dvec3(1)));
    if (job_.request[ShadeOutput::shadows])
        for (size_t c = 0; c < job_.shadowLights.size(); c++)
            putNumber(values(ShadeOutput::shadows, static_cast<int>(c)), group, T(1.0));
    if (!job_.request.needs(ShadeOutput::background)) return;
    const View& view = *job_.view;
    const int n = job_.target->format.subpixelBits;
    const auto centre = [&](const std::array<int32_t, N>& position_subpx) {
        return Number<T>::generate(
            [&](int i) { return (position_subpx[static_cast<size_t>(i)] >> n) + 0.5; });
    };
    const typename K::PixelRays rays{T(view.centreX_px), T(view.centreY_px), constant(view.forward),
                                     constant(view.perX), constant(view.perY)};
    TextureView latLong;
    typename K::Sampling sampling{};
    if (!job_.environment->latLong.empty()) {
        latLong = TextureView(job_.environment->latLong);
        sampling = samplingOf<K>(sampler_, latLong.width(), latLong.height());
    }
    const vec3 radiance = kernels_.backgroundRadiance(
        environment_, latLong, sampling, rays, centre(group.lanes.x_subpx), centre(group.lanes.y_subpx));
    put(ShadeOutput::background, group, radiance);
    put(ShadeOutput::beauty, group, radiance);
}

template <class T>
void TileShaderOf<T>::shadeSurface(const Bucket& bucket, const Group& group) {
    const Parts& parts = bucket.parts;
    if (!(parts.ambient || parts.needNormal || parts.needEye)) return;
    shadeSurface(bucket, group, surfaceOf(group, parts.needNormal, parts.needEye || parts.needPlace), {});
}

template <class T>
typename TileShaderOf<T>::Parts TileShaderOf<T>::partsOf(const SurfaceMaterial& material) const {
    const ShadeRequest& request = job_.request;
    const bool every = job_.everyPart;
    const bool hasDiffuse = every ? hasDiffusePart(material) : reflectsDiffusely(material);
    Parts parts{};
    parts.ambient = hasDiffuse && request.needs(ShadeOutput::ambient);
    parts.diffuse = hasDiffuse && lighting_.hasDiffuse() && request.needs(ShadeOutput::diffuse);
    parts.specular = (every ? hasSpecularPart(material) : reflectsSpecularly(material)) &&
                     lighting_.hasSpecular() && request.needs(ShadeOutput::specular);
    parts.mirror =
        (every ? hasMirrorPart(material) : mirrors(material)) && request.needs(ShadeOutput::mirror);
    parts.isOccluded = hasOcclusion_ && (parts.ambient || parts.diffuse);
    parts.isPerVertex = job_.vertexRadiance != nullptr;
    parts.distance = request[ShadeOutput::distance] || request[ShadeOutput::depth];
    parts.seen = wantsSeen();
    parts.needNormal =
        parts.diffuse || parts.specular || parts.mirror || parts.seen || request[ShadeOutput::normals];
    parts.needEye = parts.specular || parts.mirror || parts.distance;
    parts.needPlace = parts.diffuse && lighting_.hasPlaces();
    return parts;
}

template <class T>
void TileShaderOf<T>::shadeSurface(const Bucket& bucket, const Group& group, const Surface& interpolated,
                                   const Visibility& visibility) {
    const Parts& parts = bucket.parts;
    const vec3 none = constant(glm::dvec3(0));
    const Weights& w = interpolated.w;
    typename K::SurfacePoint point{interpolated.position, interpolated.normal, none};
    if (parts.needNormal) put(ShadeOutput::normals, group, point.normal);
    if (parts.distance) {
        const auto put1 = [&](ShadeOutput output, const T& value) {
            put(output, group, vec3(value, T(0.0), T(0.0)));
        };
        put1(ShadeOutput::distance, kernels_.distanceToEye(eye_, point.position));
        if (job_.request[ShadeOutput::depth])
            put1(ShadeOutput::depth, kernels_.viewDepth(point.position, eye_, forward_));
    }
    if (parts.seen) putSeen(bucket, group, interpolated, visibility);
    if (parts.needEye) point.toEye = kernels_.directionToEye(eye_, point.position);

    const vec3 surface = parts.ambient || parts.diffuse ? albedo(bucket, w, group) : none;
    const Surroundings surroundings =
        parts.isOccluded ? surroundingsOf(w, group) : Surroundings{T(1.0), none};
    typename K::Reflected ofVertices{none, none};
    if (parts.isPerVertex && parts.diffuse) ofVertices.diffuse = triangles_.diffuseRadiance(w, group.lanes);
    if (parts.isPerVertex && parts.specular)
        ofVertices.specular = triangles_.specularRadiance(w, group.lanes);
    const vec3 shown = parts.mirror ? mirrored(bucket, point.normal, point.toEye) : none;
    const auto radiance =
        lighting_.surfaceRadiance(parts, point, bucket.reflectances, surface, surroundings, ambient_,
                                  lighting_.lights(), visibility, ofVertices, shown);
    if (parts.ambient) put(ShadeOutput::ambient, group, radiance.ambient);
    if (parts.diffuse) put(ShadeOutput::diffuse, group, radiance.diffuse);
    if (parts.specular) put(ShadeOutput::specular, group, radiance.specular);
    if (parts.mirror) put(ShadeOutput::mirror, group, radiance.mirror);
    put(ShadeOutput::beauty, group, radiance.beauty);
}

template <class T>
typename TileShaderOf<T>::vec3 TileShaderOf<T>::albedo(const Bucket& bucket, const Weights& w,
                                                       const Group& group) {
    std::array<T, 2> uv{T(0.0), T(0.0)};
    if (bucket.reflectances.hasChecker != 0) uv = triangles_.surfaceCoordinates(w, group.lanes);
    return kernels_.albedoAt(bucket.reflectances, uv[0], uv[1]);
}

// What the bucket's mirrors show. The environment's cube map is stored without its rotation.
template <class T>
typename TileShaderOf<T>::vec3 TileShaderOf<T>::mirrored(const Bucket& bucket, const vec3& n,
                                                         const vec3& toEye) {
    if (bucket.cube == nullptr) return kernels_.mirroredRadiance(environment_, 0, {}, {}, n, toEye);
    const TextureView texture(*bucket.cube);
    const auto sampling = samplingOf<K>(sampler_, texture.width(), texture.height());
    const int shows = bucket.cube == job_.environmentCube ? 1 : 2;
    return kernels_.mirroredRadiance(environment_, shows, texture, sampling, n, toEye);
}

template <class T>
bool TileShaderOf<T>::wantsSeen() const {
    const ShadeRequest& request = job_.request;
    return request[ShadeOutput::open] || request[ShadeOutput::bentNormals] ||
           request[ShadeOutput::irradiance] || request[ShadeOutput::environment] ||
           request[ShadeOutput::shadows];
}

// What reaches a group's fragments, for the images that show it: of lights, of their surroundings, of the
// environment.
template <class T>
void TileShaderOf<T>::putSeen(const Bucket& bucket, const Group& group, const Surface& surface,
                              const Visibility& visibility) {
    const SurfaceMaterial& material = *bucket.material;
    // Shadows are made for surfaces that reflect lights.
    const bool hasShadows = !casts_.empty() && (reflectsDiffusely(material) || reflectsSpecularly(material));
    const auto reaching = [&](size_t light) {
        return hasShadows && casts_[light] ? kernels_.visibilityOf(visibility, static_cast<int>(light))
                                           : T(1.0);
    };
    if (job_.request[ShadeOutput::shadows])
        for (size_t c = 0; c < job_.shadowLights.size(); c++)
            putNumber(values(ShadeOutput::shadows, static_cast<int>(c)), group,
                      reaching(job_.shadowLights[c]));
    Surroundings around{T(1.0), surface.normal};
    if (occlusion_) around = fragmentSurroundings(group);
    put(ShadeOutput::open, group, vec3(around.open, T(0.0), T(0.0)));
    put(ShadeOutput::bentNormals, group, around.bentNormal);
    if (!received_) return;
    const vec3 irradiance =
        received_->receivedIrradiance(surface.normal, around.open, around.bentNormal, received_->lights(),
                                      {visibility.first, visibility.stride}, hasShadows);
    put(ShadeOutput::irradiance, group, irradiance);
    if (hasDiffusePart(material))
        put(ShadeOutput::environment, group,
            kernels_.lambertOfIrradiance(irradiance, albedo(bucket, surface.w, group)));
}

// Keeps the group's values if the output is wanted.
template <class T>
void TileShaderOf<T>::put(ShadeOutput output, const Group& group, const vec3& v) {
    if (!job_.request[output]) return;
    for (int c = 0; c < 3; c++) putNumber(values(output, c), group, v[c]);
}
// Keeps the group's values of a channel.
template <class T>
void TileShaderOf<T>::putNumber(Stored* to, const Group& group, const T& value) {
    if (group.isRun()) {
        Number<T>::store(value, to + group.fragments.front(), static_cast<int>(group.fragments.size()));
        return;
    }
    std::array<Stored, N> lanes;
    Number<T>::store(value, lanes.data(), N);
    for (size_t i = 0; i < group.fragments.size(); i++) to[group.fragments[i]] = lanes[i];
}

// Means over the samples of each pixel, a row of the rectangle at a time.
template <class T>
void TileShaderOf<T>::resolve(ShadeOutput output, const PixelRectangle& rectangle, Image<float>& image) {
    const auto samples = static_cast<size_t>(job_.target->format.samples);
    const T reciprocal(1.0 / static_cast<double>(samples));
    std::vector<T> ofPixels(samples);
    const auto width = static_cast<size_t>(rectangle.width());
    for (int row = 0; row < rectangle.height(); row++) {
        forEachLaneGroup<N>(width, [&](size_t first, int active) {
            const size_t firstPixel = static_cast<size_t>(row) * width + first;
            setItemsOf<T, N>([&](int i) {
                return itemOfPlace(rectangle.x0 + static_cast<int>(first) + i, rectangle.y0 + row);
            });
            for (int c = 0; c < image.channels(); c++) {
                const Stored* from = values(output, c);
                const auto sample = [&](size_t s) {
                    return Number<T>::generate([&](int i) {
                        const size_t pixel = firstPixel + static_cast<size_t>(std::min(i, active - 1));
                        return static_cast<double>(from[tile_.fragmentOf(pixel, s, samples)]);
                    });
                };
                for (size_t s = 0; s < samples; s++) ofPixels[s] = sample(s);
                const T mean =
                    kernels_.resolvedSamples({ofPixels.data()}, static_cast<int>(samples), reciprocal);
                Number<T>::store(
                    mean, &image.at(rectangle.x0 + static_cast<int>(first), rectangle.y0 + row, c), active);
            }
        });
    }
}

template <class T>
void TileShaderOf<T>::copyFirstSample(ShadeOutput output, const PixelRectangle& rectangle,
                                      Image<float>& image) {
    const auto samples = static_cast<size_t>(job_.target->format.samples);
    const auto width = static_cast<size_t>(rectangle.width());
    for (int c = 0; c < image.channels(); c++) {
        const Stored* from = values(output, c);
        for (int row = 0; row < rectangle.height(); row++) {
            float* to = &image.at(rectangle.x0, rectangle.y0 + row, c);
            const size_t firstPixel = static_cast<size_t>(row) * width;
            for (size_t i = 0; i < width; i++)
                to[i] = static_cast<float>(from[tile_.fragmentOf(firstPixel + i, 0, samples)]);
        }
    }
}

}  // namespace etalon
