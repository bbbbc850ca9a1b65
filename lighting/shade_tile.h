// Shading of one tile over a number type T. Included by the sources that instantiate it, one per number type.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "lighting/shading_passes.h"
#include "lighting/shading_kernels.h"
#include "lighting/surface_lighting.h"
#include "lighting/tile_triangles.h"
#include "numeric/number_lanes.h"
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
    static constexpr int N = NumberTraits<T>::lanes;

    using Stored = TexelStorage<T>;
    using Triangles = TileTriangles<T>;
    using Weights = typename Triangles::Weights;

    // Fragments that are shaded by the same texts and constants: their numbers, ascending.
    struct Bucket {
        const SurfaceMaterial* material;
        const CubeMap<float>* cube;
        std::vector<uint32_t> fragments;
    };
    // 1 to N fragments of a bucket.
    struct Group {
        std::span<const uint32_t> fragments;
        typename Triangles::Group lanes;
        // Whether the fragments are neighbours in memory.
        bool isRun() const { return fragments.back() - fragments.front() == fragments.size() - 1; }
    };
    using Lighting = SurfaceLighting<T>;

    // What reaches the fragments of a group of each light.
    struct Shadows {
        const TileShaderOf& shader;
        const Group& group;
        bool casts(size_t light) const { return shader.casts_[light]; }
        T visibility(size_t light) const {
            const double* of = &shader.visibility_[light * shader.tile_.size()];
            return generateNumber<T>([&](int i) {
                return of[group.fragments[std::min(static_cast<size_t>(i), group.fragments.size() - 1)]];
            });
        }
    };

    static vec3 constant(const glm::dvec3& v) { return Lighting::constant(v); }
    void collect(const PixelRectangle& rectangle);
    void setUpTriangles();
    void setFaceNormal(size_t number, uint32_t id, const PlacedMesh& placed);
    size_t bucketOf(const SurfaceMaterial& material, const CubeMap<float>* cube);
    void sortIntoBuckets();
    Group groupOf(std::span<const uint32_t> fragments) const;
    void findPoints();
    void findVisibility();
    typename Lighting::Surroundings surroundingsOf(const Weights& w, const Group& group) const;
    void shadeBackground(const Group& group);
    void shadeSurface(const Bucket& bucket, const Group& group);
    vec3 albedo(const SurfaceMaterial& material, const Weights& w, const Group& group);
    vec3 sampleEnvironment(vec3 direction);
    vec3 mirrorRadiance(const Bucket& bucket, vec3 n, vec3 toEye);
    void put(ShadeOutput output, const Group& group, vec3 value);
    void resolve(ShadeOutput output, const PixelRectangle& rectangle, Image<float>& image);
    void copyFirstSample(ShadeOutput output, const PixelRectangle& rectangle, Image<float>& image);
    // The values of a channel, one per fragment.
    Stored* values(ShadeOutput output, int channel) {
        return &values_[static_cast<size_t>(output)][static_cast<size_t>(channel) * tile_.size()];
    }

    const ShadeJob& job_;
    K kernels_;
    Lighting lighting_;
    SamplerSettings sampler_;
    vec3 ambient_, eye_;
    std::vector<bool> casts_;    // for each light whether its visibility is asked for; empty: for none
    bool hasOcclusion_ = false;  // else all is open
    const std::vector<Occlusion>* occlusion_ = nullptr;  // of the tile's fragments, where these have it
    LitPoints points_;
    std::vector<double> visibility_;  // for each light, of every fragment
    TileFragments tile_;
    Triangles triangles_;
    std::vector<Bucket> buckets_;  // the first is the background
    std::vector<size_t> bucketOfTriangle_;
    std::vector<glm::dvec3> faceNormals_;  // of the triangles, for lights that may be blocked
    std::array<std::vector<Stored>, kShadeOutputs> values_;
};

template <class T>
TileShaderOf<T>::TileShaderOf(const ShadeJob& job)
    : job_(job), lighting_(*job.scene, samplerOf(*job.profile)), sampler_(samplerOf(*job.profile)) {
    ambient_ = constant(job.scene->ambient);
    eye_ = constant(job.view->eye);
    buckets_.push_back(Bucket{nullptr, nullptr, {}});
    hasOcclusion_ = job.occlusion || (job.vertexRadiance &&
                                      std::ranges::any_of(*job.vertexRadiance, [](const VertexRadiance& of) {
                                          return !of.sides[0].open.empty();
                                      }));
    const ShadeRequest& request = job.request;
    if (!job.visibility || job.vertexRadiance ||
        !(request.needs(ShadeOutput::diffuse) || request.needs(ShadeOutput::specular)))
        return;
    for (size_t l = 0; l < job.scene->lights.size(); l++) casts_.push_back(job.visibility->casts(l));
    if (std::find(casts_.begin(), casts_.end(), true) == casts_.end()) casts_.clear();
}

// Lists what is visible and sorts it by what shades it.
template <class T>
void TileShaderOf<T>::collect(const PixelRectangle& rectangle) {
    tile_.collect(*job_.target, rectangle);
    setUpTriangles();
    sortIntoBuckets();
}

template <class T>
LitPoints TileShaderOf<T>::points(const PixelRectangle& rectangle) {
    collect(rectangle);
    findPoints();
    return points_;
}

template <class T>
void TileShaderOf<T>::run(size_t number, const PixelRectangle& rectangle, ShadedImages& images,
                          ShadeStatistics& statistics) {
    // List what is visible, shade, write the images.
    collect(rectangle);
    findVisibility();
    occlusion_ = job_.occlusion ? &(*job_.occlusion)[number] : nullptr;
    for (size_t o = 0; o < kShadeOutputs; o++)
        if (job_.request.wanted[o]) values_[o].assign(3 * tile_.size(), Stored(0));
    for (size_t b = 0; b < buckets_.size(); b++) {
        const std::vector<uint32_t>& list = buckets_[b].fragments;
        forEachLaneGroup<N>(list.size(), [&](size_t first, int active) {
            const Group group = groupOf(std::span(&list[first], static_cast<size_t>(active)));
            b == 0 ? shadeBackground(group) : shadeSurface(buckets_[b], group);
        });
        (b == 0 ? statistics.backgroundFragments : statistics.surfaceFragments) += list.size();
    }
    for (size_t o = 0; o < kShadeOutputs; o++) {
        if (!job_.request.wanted[o]) continue;
        if (o <= static_cast<size_t>(ShadeOutput::beauty) && job_.target->format.samples > 1)
            resolve(static_cast<ShadeOutput>(o), rectangle, images.images[o]);
        else
            copyFirstSample(static_cast<ShadeOutput>(o), rectangle, images.images[o]);
    }
}

template <class T>
size_t TileShaderOf<T>::bucketOf(const SurfaceMaterial& material, const CubeMap<float>* cube) {
    size_t b = 1;
    while (b < buckets_.size() && !(buckets_[b].material == &material && buckets_[b].cube == cube)) b++;
    if (b == buckets_.size()) buckets_.push_back(Bucket{&material, cube, {}});
    return b;
}

// Each visible triangle's bucket, and what its fragments share.
template <class T>
void TileShaderOf<T>::setUpTriangles() {
    const size_t count = tile_.triangles.size();
    triangles_.reset(count);
    bucketOfTriangle_.assign(count, 0);
    if (!casts_.empty()) faceNormals_.assign(count, glm::dvec3(0));
    for (size_t i = 0; i < count; i++) {
        const uint32_t id = tile_.triangles[i];
        if (id == kNoTriangle) continue;
        const uint32_t instance = job_.instanceOfDraw[job_.target->triangles[id].draw];
        const CubeMap<float>* cube =
            job_.sceneCubes[instance] ? job_.sceneCubes[instance] : job_.environmentCube;
        bucketOfTriangle_[i] =
            bucketOf(job_.scene->materials[job_.scene->instances[instance].material], cube);
        triangles_.set(i, *job_.target, id, (*job_.placed)[instance]);
        if (!casts_.empty()) setFaceNormal(i, id, (*job_.placed)[instance]);
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
    const vec3 a = constant(placed.positions[index[0]]);
    const vec3 ab = kernels_.sub3(constant(placed.positions[index[1]]), a);
    const vec3 ac = kernels_.sub3(constant(placed.positions[index[2]]), a);
    const vec3 normal = kernels_.unit3(kernels_.cross3(ab, ac));
    const double side = (job_.target->triangle(id).front != placed.mirrored) ? 1.0 : -1.0;
    for (int c = 0; c < 3; c++) faceNormals_[number][c] = side * numberLane(normal[c], 0);
}

template <class T>
void TileShaderOf<T>::sortIntoBuckets() {
    for (Bucket& bucket : buckets_) bucket.fragments.clear();
    for (uint32_t f = 0; f < tile_.size(); f++)
        buckets_[bucketOfTriangle_[tile_.triangle[f]]].fragments.push_back(f);
}

// The lanes behind a short group repeat its last fragment.
template <class T>
typename TileShaderOf<T>::Group TileShaderOf<T>::groupOf(std::span<const uint32_t> fragments) const {
    Group group;
    group.fragments = fragments;
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

// The points of the background stand there, too, as zeros.
template <class T>
void TileShaderOf<T>::findPoints() {
    const size_t count = tile_.size();
    for (auto* vectors : {&points_.position_m, &points_.normal, &points_.faceNormal})
        for (std::vector<double>& component : *vectors) component.assign(count, 0);
    points_.instance.assign(count, kNoTriangle);
    points_.x_px.resize(count), points_.y_px.resize(count);
    const int n = job_.target->format.subpixelBits;
    for (size_t b = 1; b < buckets_.size(); b++) {
        const std::vector<uint32_t>& list = buckets_[b].fragments;
        forEachLaneGroup<N>(list.size(), [&](size_t first, int active) {
            const Group group = groupOf(std::span(&list[first], static_cast<size_t>(active)));
            const Weights w = triangles_.weights(group.lanes);
            const vec3 normal = kernels_.scale3(kernels_.unit3(triangles_.normal(w)), w.facing);
            const vec3 position = triangles_.position(w, group.lanes);
            for (size_t i = 0; i < group.fragments.size(); i++) {
                const uint32_t f = group.fragments[i];
                for (int c = 0; c < 3; c++) {
                    points_.position_m[static_cast<size_t>(c)][f] =
                        numberLane(position[c], static_cast<int>(i));
                    points_.normal[static_cast<size_t>(c)][f] = numberLane(normal[c], static_cast<int>(i));
                }
            }
        });
    }
    for (size_t f = 0; f < count; f++) {
        points_.x_px[f] = static_cast<uint32_t>(tile_.x_subpx[f] >> n);
        points_.y_px[f] = static_cast<uint32_t>(tile_.y_subpx[f] >> n);
        const size_t triangle = tile_.triangle[f];
        if (bucketOfTriangle_[triangle] == 0) continue;
        const uint32_t id = tile_.triangles[triangle];
        points_.instance[f] = job_.instanceOfDraw[job_.target->triangles[id].draw];
        if (faceNormals_.empty()) continue;
        const glm::dvec3 face = faceNormals_[triangle];
        for (int c = 0; c < 3; c++) points_.faceNormal[static_cast<size_t>(c)][f] = face[c];
    }
}

// What reaches the tile's fragments of the lights that may be blocked.
template <class T>
void TileShaderOf<T>::findVisibility() {
    if (casts_.empty()) return;
    findPoints();
    const size_t count = tile_.size();
    visibility_.assign(casts_.size() * count, 1);
    for (size_t l = 0; l < casts_.size(); l++)
        if (casts_[l]) job_.visibility->find(l, points_, std::span(visibility_).subspan(l * count, count));
}

// The environment in the direction of the pixel's centre.
template <class T>
void TileShaderOf<T>::shadeBackground(const Group& group) {
    put(ShadeOutput::distance, group, constant(glm::dvec3(std::numeric_limits<double>::infinity())));
    if (!job_.request.needs(ShadeOutput::background)) return;
    const SurfaceEnvironment& environment = job_.scene->environment;
    if (environment.latLong.empty()) {
        put(ShadeOutput::background, group, constant(environment.constant));
        put(ShadeOutput::beauty, group, constant(environment.constant));
        return;
    }
    const View& view = *job_.view;
    const int n = job_.target->format.subpixelBits;
    const auto centre = [&](const std::array<int32_t, N>& position_subpx) {
        return generateNumber<T>([&](int i) { return (position_subpx[static_cast<size_t>(i)] >> n) + 0.5; });
    };
    const T x = centre(group.lanes.x_subpx), y = centre(group.lanes.y_subpx);
    const vec3 ray = kernels_.viewRay(x, y, T(view.centreX_px), T(view.centreY_px), constant(view.forward),
                                      constant(view.perX), constant(view.perY));
    const vec3 direction = kernels_.rotateY(ray, T(environment.cosRotation), T(-environment.sinRotation));
    const vec3 radiance = sampleEnvironment(direction);
    put(ShadeOutput::background, group, radiance);
    put(ShadeOutput::beauty, group, radiance);
}

// At the fragments or, where these are lit by their vertices, interpolated; then the bent normal is not used.
template <class T>
typename TileShaderOf<T>::Lighting::Surroundings TileShaderOf<T>::surroundingsOf(const Weights& w,
                                                                                 const Group& group) const {
    if (job_.vertexRadiance) return {triangles_.open(w, group.lanes), constant(glm::dvec3(0))};
    const auto load = [&](const auto& valueOf) {
        return generateNumber<T>([&](int i) {
            const size_t last = group.fragments.size() - 1;
            return valueOf((*occlusion_)[group.fragments[std::min(static_cast<size_t>(i), last)]]);
        });
    };
    const auto bent = [&](int c) { return load([c](const Occlusion& of) { return of.bentNormal[c]; }); };
    return {load([](const Occlusion& of) { return of.open; }), {bent(0), bent(1), bent(2)}};
}

template <class T>
void TileShaderOf<T>::shadeSurface(const Bucket& bucket, const Group& group) {
    const SurfaceMaterial& material = *bucket.material;
    const ShadeRequest& request = job_.request;
    const bool hasDiffuse = hasDiffusePart(material);
    const bool ambient = hasDiffuse && request.needs(ShadeOutput::ambient);
    const bool diffuse = hasDiffuse && lighting_.hasDiffuse() && request.needs(ShadeOutput::diffuse);
    const bool specular = material.kind == MaterialKind::blinnPhong && lighting_.hasSpecular() &&
                          request.needs(ShadeOutput::specular);
    const bool mirror = hasMirrorPart(material) && request.needs(ShadeOutput::mirror);
    const bool distance = request[ShadeOutput::distance], normals = request[ShadeOutput::normals];
    const bool needNormal = diffuse || specular || mirror || normals,
               needEye = specular || mirror || distance, needPlace = diffuse && lighting_.hasPlaces();
    if (!(ambient || needNormal || needEye)) return;

    // Interpolate what the wanted outputs read.
    const Weights w = triangles_.weights(group.lanes);
    vec3 n = constant(glm::dvec3(0)), toEye = n, position = n;
    if (needEye || needPlace) position = triangles_.position(w, group.lanes);
    if (needNormal) {
        n = kernels_.scale3(kernels_.unit3(triangles_.normal(w)), w.facing);
        put(ShadeOutput::normals, group, n);
    }
    if (needEye) {
        toEye = kernels_.sub3(eye_, position);
        if (distance) put(ShadeOutput::distance, group, vec3(kernels_.length3(toEye), T(0.0), T(0.0)));
        toEye = kernels_.unit3(toEye);
    }

    // Radiance, each component in its own sum over the lights.
    vec3 sum = constant(glm::dvec3(0));
    const auto add = [&](ShadeOutput output, vec3 radiance) {
        put(output, group, radiance);
        sum = kernels_.add3(sum, radiance);
    };
    const vec3 surface = ambient || diffuse ? albedo(material, w, group) : sum;
    const bool isOccluded = hasOcclusion_ && (ambient || diffuse);
    const auto surroundings = isOccluded ? surroundingsOf(w, group) : typename Lighting::Surroundings{};
    if (ambient) {
        const vec3 arriving = isOccluded ? kernels_.scale3(ambient_, surroundings.open) : ambient_;
        add(ShadeOutput::ambient, kernels_.mul3(surface, arriving));
    }
    if (job_.vertexRadiance) {
        if (diffuse) add(ShadeOutput::diffuse, triangles_.diffuseRadiance(w, group.lanes));
        if (specular) add(ShadeOutput::specular, triangles_.specularRadiance(w, group.lanes));
    } else {
        const typename Lighting::Point point{position, n, toEye};
        const auto reflected = [&](const auto& shadows) {
            return lighting_.reflected(material, point, surface, diffuse, specular, shadows,
                                       isOccluded ? &surroundings : nullptr);
        };
        const auto lights =
            casts_.empty() ? reflected(typename Lighting::Unshadowed{}) : reflected(Shadows{*this, group});
        if (diffuse) add(ShadeOutput::diffuse, lights.diffuse);
        if (specular) add(ShadeOutput::specular, lights.specular);
    }
    if (mirror) add(ShadeOutput::mirror, mirrorRadiance(bucket, n, toEye));
    put(ShadeOutput::beauty, group, sum);
}

template <class T>
typename TileShaderOf<T>::vec3 TileShaderOf<T>::albedo(const SurfaceMaterial& material, const Weights& w,
                                                       const Group& group) {
    if (!material.checker) return constant(material.diffuse);
    const auto [u, v] = triangles_.surfaceCoordinates(w, group.lanes);
    return lighting_.surfaceColour(material, u, v);
}

template <class T>
typename TileShaderOf<T>::vec3 TileShaderOf<T>::mirrorRadiance(const Bucket& bucket, vec3 n, vec3 toEye) {
    const SurfaceEnvironment& environment = job_.scene->environment;
    if (bucket.cube == nullptr)
        return kernels_.mul3(constant(bucket.material->reflectance), constant(environment.constant));
    vec3 direction = kernels_.mirrorDirection(n, toEye);
    // The environment's cube map is stored without its rotation, scene cube maps in world space.
    if (bucket.cube == job_.environmentCube)
        direction = kernels_.rotateY(direction, T(environment.cosRotation), T(-environment.sinRotation));
    const TextureView texture(*bucket.cube);
    const auto sampling = samplingOf<K>(sampler_, texture.width(), texture.height());
    return kernels_.mul3(constant(bucket.material->reflectance),
                         kernels_.sampleCubeRgb(texture, direction, sampling));
}

// Keeps the group's values if the output is wanted.
template <class T>
void TileShaderOf<T>::put(ShadeOutput output, const Group& group, vec3 v) {
    if (!job_.request[output]) return;
    const auto active = static_cast<int>(group.fragments.size());
    for (int c = 0; c < 3; c++) {
        Stored* to = values(output, c);
        if (group.isRun()) {
            TexelFetch<T>::store(v[c], to + group.fragments.front(), active);
            continue;
        }
        std::array<Stored, N> lanes;
        TexelFetch<T>::store(v[c], lanes.data(), N);
        for (size_t i = 0; i < group.fragments.size(); i++) to[group.fragments[i]] = lanes[i];
    }
}

// Means over the samples of each pixel, a row of the rectangle at a time.
template <class T>
void TileShaderOf<T>::resolve(ShadeOutput output, const PixelRectangle& rectangle, Image<float>& image) {
    const auto samples = static_cast<size_t>(job_.target->format.samples);
    const T reciprocal(1.0 / static_cast<double>(samples));
    const auto width = static_cast<size_t>(rectangle.width());
    for (int row = 0; row < rectangle.height(); row++) {
        forEachLaneGroup<N>(width, [&](size_t first, int active) {
            const size_t firstPixel = static_cast<size_t>(row) * width + first;
            for (int c = 0; c < 3; c++) {
                const Stored* from = values(output, c);
                const auto sample = [&](size_t s) {
                    return generateNumber<T>([&](int i) {
                        const size_t pixel = firstPixel + static_cast<size_t>(std::min(i, active - 1));
                        return static_cast<double>(from[tile_.fragmentOf(pixel, s, samples)]);
                    });
                };
                T sum = sample(0);
                for (size_t s = 1; s < samples; s++) sum = kernels_.resolveAdd(sum, sample(s));
                sum = kernels_.resolveMean(sum, reciprocal);
                TexelFetch<T>::store(
                    sum, &image.at(rectangle.x0 + static_cast<int>(first), rectangle.y0 + row, c), active);
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

template <class T>
typename TileShaderOf<T>::vec3 TileShaderOf<T>::sampleEnvironment(vec3 direction) {
    const TextureView texture(job_.scene->environment.latLong);
    return kernels_.sampleLatLong(texture, direction,
                                  samplingOf<K>(sampler_, texture.width(), texture.height()));
}

}  // namespace etalon
