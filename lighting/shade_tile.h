// Shading of one tile over a number type T. Included by the sources that instantiate it, one per number type.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "lighting/arithmetic_passes.h"
#include "lighting/shading_kernels.h"
#include "numeric/number_lanes.h"
#include "raster/fragments.h"
#include "raster/setup.h"

namespace etalon {

template <class T>
class TileShaderOf final : public TileShader {
  public:
    explicit TileShaderOf(const ShadeJob& job);
    void run(const PixelRectangle& rectangle, ShadedImages& images, ShadeStatistics& statistics) override;

  private:
    using K = ShadingKernels<T>;
    using vec3 = typename K::vec3;
    static constexpr int N = NumberTraits<T>::lanes;
    static constexpr double kEightPi = 25.132741228718345;

    // Fragments that are shaded by the same texts and constants: their indices in fragments_.
    struct Bucket {
        const SurfaceMaterial* material;
        const CubeMap<float>* cube;
        std::vector<uint32_t> fragments;
    };
    using Group = std::span<const uint32_t>;  // 1 to N fragments of a bucket
    struct Weights {
        vec3 b;
        std::array<TriangleRecord, N> records;
        std::array<uint32_t, N> ids;
        std::array<const PlacedMesh*, N> meshes;
    };

    static vec3 constant(const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); }
    const Fragment& at(Group group, int lane) const;
    void sortIntoBuckets();
    Bucket& bucketOf(const SurfaceMaterial& material, const CubeMap<float>* cube);
    void shadeBackground(Group group);
    void shadeSurface(const Bucket& bucket, Group group);
    Weights weights(Group group) const;
    template <class Get>
    T attribute(const Weights& w, Get get);
    vec3 albedo(const SurfaceMaterial& material, const Weights& w);
    vec3 sampleEnvironment(vec3 direction);
    vec3 mirrorRadiance(const Bucket& bucket, vec3 n, vec3 toEye);
    void put(ShadeOutput output, Group group, vec3 value);
    void resolve(const PixelRectangle& rectangle, ShadedImages& images);
    void copyFirstSample(ShadeOutput output, int channels, const PixelRectangle& rectangle,
                         ShadedImages& images);
    double& value(ShadeOutput output, uint32_t fragment, int channel);

    const ShadeJob& job_;
    K kernels_;
    std::vector<vec3> toLight_, irradiance_;
    vec3 ambient_, eye_;
    SamplerSettings sampler_;
    TileFragments tile_;
    std::vector<Bucket> buckets_;
    std::vector<uint32_t> background_;
    std::array<std::vector<double>, kShadeOutputs> values_;
};

template <class T>
TileShaderOf<T>::TileShaderOf(const ShadeJob& job) : job_(job) {
    for (const SurfaceLight& light : job.scene->lights) {
        toLight_.push_back(constant(light.toLight));
        irradiance_.push_back(constant(light.irradiance));
    }
    ambient_ = constant(job.scene->ambient);
    eye_ = constant(job.view->eye);
    sampler_.filter = job.profile->textureFilter;
    sampler_.fractionBits = job.profile->textureFractionBits;
}

template <class T>
void TileShaderOf<T>::run(const PixelRectangle& rectangle, ShadedImages& images,
                          ShadeStatistics& statistics) {
    // List what is visible, sort it by what shades it, shade, write the images.
    tile_.collect(*job_.target, rectangle);
    sortIntoBuckets();
    for (size_t o = 0; o < kShadeOutputs; o++)
        if (job_.request.wanted[o]) values_[o].assign(3 * tile_.fragments.size(), 0.0);
    const auto inGroups = [](const std::vector<uint32_t>& list, auto&& body) {
        forEachLaneGroup<N>(list.size(), [&](size_t first, int active) {
            body(Group(&list[first], static_cast<size_t>(active)));
        });
    };
    inGroups(background_, [&](Group group) { shadeBackground(group); });
    for (const Bucket& bucket : buckets_)
        inGroups(bucket.fragments, [&](Group group) { shadeSurface(bucket, group); });
    statistics.backgroundFragments += background_.size();
    for (const Bucket& bucket : buckets_) statistics.surfaceFragments += bucket.fragments.size();
    resolve(rectangle, images);
    copyFirstSample(ShadeOutput::normals, 3, rectangle, images);
    copyFirstSample(ShadeOutput::distance, 1, rectangle, images);
}

// The lanes behind a short group repeat its last fragment.
template <class T>
const Fragment& TileShaderOf<T>::at(Group group, int lane) const {
    return tile_.fragments[group[std::min(static_cast<size_t>(lane), group.size() - 1)]];
}

template <class T>
typename TileShaderOf<T>::Bucket& TileShaderOf<T>::bucketOf(const SurfaceMaterial& material,
                                                            const CubeMap<float>* cube) {
    for (Bucket& bucket : buckets_)
        if (bucket.material == &material && bucket.cube == cube) return bucket;
    return buckets_.emplace_back(Bucket{&material, cube, {}});
}

template <class T>
void TileShaderOf<T>::sortIntoBuckets() {
    buckets_.clear();
    background_.clear();
    for (uint32_t f = 0; f < tile_.fragments.size(); f++) {
        const uint32_t id = tile_.fragments[f].id;
        if (id == kNoTriangle) {
            background_.push_back(f);
            continue;
        }
        const uint32_t instance = job_.instanceOfDraw[job_.target->triangles[id].draw];
        const CubeMap<float>* cube =
            job_.sceneCubes[instance] ? job_.sceneCubes[instance] : job_.environmentCube;
        bucketOf(job_.scene->materials[job_.scene->instances[instance].material], cube)
            .fragments.push_back(f);
    }
}

// The environment in the direction of the pixel's centre.
template <class T>
void TileShaderOf<T>::shadeBackground(Group group) {
    put(ShadeOutput::distance, group, constant(glm::dvec3(std::numeric_limits<double>::infinity())));
    if (!job_.request.needs(ShadeOutput::background)) return;
    const SurfaceEnvironment& environment = job_.scene->environment;
    if (environment.latLong.empty()) {
        put(ShadeOutput::background, group, constant(environment.constant));
        put(ShadeOutput::beauty, group, constant(environment.constant));
        return;
    }
    const View& view = *job_.view;
    const T x = generateNumber<T>([&](int i) { return at(group, i).x + 0.5; });
    const T y = generateNumber<T>([&](int i) { return at(group, i).y + 0.5; });
    const vec3 ray = kernels_.viewRay(x, y, T(view.centreX_px), T(view.centreY_px), constant(view.forward),
                                      constant(view.perX), constant(view.perY));
    const vec3 direction = kernels_.rotateY(ray, T(environment.cosRotation), T(-environment.sinRotation));
    const vec3 radiance = sampleEnvironment(direction);
    put(ShadeOutput::background, group, radiance);
    put(ShadeOutput::beauty, group, radiance);
}

// Perspective-correct weights of the group's fragments (rule 5).
template <class T>
typename TileShaderOf<T>::Weights TileShaderOf<T>::weights(Group group) const {
    Weights w;
    std::array<std::array<double, N>, 3> e, q;
    for (int i = 0; i < N; i++) {
        const Fragment& fragment = at(group, i);
        const TriangleRecord record = job_.target->triangle(fragment.id);
        const auto lane = static_cast<size_t>(i);
        w.records[lane] = record;
        w.ids[lane] = fragment.id;
        w.meshes[lane] = &(*job_.placed)[job_.instanceOfDraw[record.draw]];
        const WeightScale scale = weightScale(record);
        const auto edges = edgeFunctions(record);
        for (size_t k = 0; k < 3; k++) {
            e[k][lane] =
                static_cast<double>(edges[k].at(fragment.x_subpx, fragment.y_subpx)) * scale.areaScale;
            q[k][lane] = scale.q[k];
        }
    }
    const auto toNumbers = [](const std::array<std::array<double, N>, 3>& a) {
        return vec3(generateNumber<T>([&](int i) { return a[0][static_cast<size_t>(i)]; }),
                    generateNumber<T>([&](int i) { return a[1][static_cast<size_t>(i)]; }),
                    generateNumber<T>([&](int i) { return a[2][static_cast<size_t>(i)]; }));
    };
    K kernels;
    w.b = kernels.perspectiveWeights(toNumbers(e), toNumbers(q));
    return w;
}

// Interpolates the attribute that get(mesh, vertex index) returns. Values below 2^-60 in magnitude are 0.
template <class T>
template <class Get>
T TileShaderOf<T>::attribute(const Weights& w, Get get) {
    constexpr double kSmallestAttribute = 0x1p-60;
    std::array<std::array<double, N>, 3> a;
    for (size_t i = 0; i < N; i++) {
        const TriangleRecord& record = w.records[i];
        const PlacedMesh& placed = *w.meshes[i];
        const uint32_t* index = &placed.mesh->indices[3 * size_t{record.triangle}];
        const std::array<double, 3> source = {get(placed, index[0]), get(placed, index[1]),
                                              get(placed, index[2])};
        for (size_t k = 0; k < 3; k++) {
            double value = source[record.corner[k]];
            if (record.clipped) {
                const auto& beta = job_.target->barycentric(w.ids[i], k);
                value = beta[0] * source[0] + (beta[1] * source[1] + beta[2] * source[2]);
            }
            a[k][i] = std::fabs(value) < kSmallestAttribute ? 0.0 : value;
        }
    }
    return kernels_.interpolateAttribute(
        w.b, vec3(generateNumber<T>([&](int i) { return a[0][static_cast<size_t>(i)]; }),
                  generateNumber<T>([&](int i) { return a[1][static_cast<size_t>(i)]; }),
                  generateNumber<T>([&](int i) { return a[2][static_cast<size_t>(i)]; })));
}

template <class T>
void TileShaderOf<T>::shadeSurface(const Bucket& bucket, Group group) {
    const SurfaceMaterial& material = *bucket.material;
    const ShadeRequest& request = job_.request;
    const bool hasDiffuse = material.kind != MaterialKind::mirror;
    const bool lit = !toLight_.empty();
    const bool ambient = hasDiffuse && request.needs(ShadeOutput::ambient);
    const bool diffuse = hasDiffuse && lit && request.needs(ShadeOutput::diffuse);
    const bool specular =
        material.kind == MaterialKind::blinnPhong && lit && request.needs(ShadeOutput::specular);
    const bool mirror = material.kind == MaterialKind::mirror && request.needs(ShadeOutput::mirror);
    const bool distance = request[ShadeOutput::distance], normals = request[ShadeOutput::normals];
    const bool needNormal = diffuse || specular || mirror || normals,
               needEye = specular || mirror || distance;
    if (!(ambient || needNormal || needEye)) return;

    // Interpolate what the wanted outputs read.
    const Weights w = weights(group);
    vec3 n = constant(glm::dvec3(0)), toEye = n;
    if (needNormal) {
        const auto facing = [](const TriangleRecord& record) { return record.front ? 1.0 : -1.0; };
        const T sign = generateNumber<T>([&](int i) { return facing(w.records[static_cast<size_t>(i)]); });
        n = vec3(attribute(w, [](const PlacedMesh& m, uint32_t v) { return m.normals[v].x; }),
                 attribute(w, [](const PlacedMesh& m, uint32_t v) { return m.normals[v].y; }),
                 attribute(w, [](const PlacedMesh& m, uint32_t v) { return m.normals[v].z; }));
        n = kernels_.scale3(kernels_.unit3(n), sign);
        put(ShadeOutput::normals, group, n);
    }
    if (needEye) {
        const vec3 position(attribute(w, [](const PlacedMesh& m, uint32_t v) { return m.positions[v].x; }),
                            attribute(w, [](const PlacedMesh& m, uint32_t v) { return m.positions[v].y; }),
                            attribute(w, [](const PlacedMesh& m, uint32_t v) { return m.positions[v].z; }));
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
    const vec3 surface = ambient || diffuse ? albedo(material, w) : sum;
    if (ambient) add(ShadeOutput::ambient, kernels_.mul3(surface, ambient_));
    if (diffuse) {
        vec3 reflected = constant(glm::dvec3(0));
        for (size_t l = 0; l < toLight_.size(); l++)
            reflected = kernels_.add3(reflected, kernels_.lambert(n, toLight_[l], irradiance_[l], surface));
        add(ShadeOutput::diffuse, reflected);
    }
    if (specular) {
        const vec3 colour = constant(material.specular);
        const T exponent(material.exponent), scale((material.exponent + 8.0) / kEightPi);
        vec3 reflected = constant(glm::dvec3(0));
        for (size_t l = 0; l < toLight_.size(); l++)
            reflected = kernels_.add3(reflected, kernels_.blinnPhong(n, toEye, toLight_[l], irradiance_[l],
                                                                     colour, exponent, scale));
        add(ShadeOutput::specular, reflected);
    }
    if (mirror) add(ShadeOutput::mirror, mirrorRadiance(bucket, n, toEye));
    put(ShadeOutput::beauty, group, sum);
}

template <class T>
typename TileShaderOf<T>::vec3 TileShaderOf<T>::albedo(const SurfaceMaterial& material, const Weights& w) {
    const vec3 even = constant(material.diffuse);
    if (!material.checker) return even;
    const auto uv = [](const PlacedMesh& m, uint32_t v) {
        return m.mesh->uv_m.empty() ? glm::vec2(0) : m.mesh->uv_m[v];
    };
    const T u = attribute(w, [&](const PlacedMesh& m, uint32_t i) { return uv(m, i).x; });
    const T v = attribute(w, [&](const PlacedMesh& m, uint32_t i) { return uv(m, i).y; });
    const auto isOdd = kernels_.isOddSquare(u, v, T(1.0 / material.checkerSize_m));
    const vec3 odd = constant(material.diffuse2);
    return vec3(K::select(isOdd, odd.x, even.x), K::select(isOdd, odd.y, even.y),
                K::select(isOdd, odd.z, even.z));
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

template <class T>
double& TileShaderOf<T>::value(ShadeOutput output, uint32_t fragment, int channel) {
    return values_[static_cast<size_t>(output)][3 * size_t{fragment} + static_cast<size_t>(channel)];
}

// Keeps the group's values if the output is wanted.
template <class T>
void TileShaderOf<T>::put(ShadeOutput output, Group group, vec3 v) {
    if (!job_.request[output]) return;
    for (size_t i = 0; i < group.size(); i++) {
        value(output, group[i], 0) = numberLane(v.x, static_cast<int>(i));
        value(output, group[i], 1) = numberLane(v.y, static_cast<int>(i));
        value(output, group[i], 2) = numberLane(v.z, static_cast<int>(i));
    }
}

// Means over the samples of each pixel, a row of the rectangle at a time.
template <class T>
void TileShaderOf<T>::resolve(const PixelRectangle& rectangle, ShadedImages& images) {
    const auto samples = static_cast<size_t>(job_.target->format.samples);
    const T reciprocal(1.0 / static_cast<double>(samples));
    const auto width = static_cast<size_t>(rectangle.width());
    for (size_t o = 0; o <= static_cast<size_t>(ShadeOutput::beauty); o++) {
        if (!job_.request.wanted[o]) continue;
        const auto output = static_cast<ShadeOutput>(o);
        for (int row = 0; row < rectangle.height(); row++) {
            forEachLaneGroup<N>(width, [&](size_t first, int active) {
                const size_t firstPixel = static_cast<size_t>(row) * width + first;
                for (int c = 0; c < 3; c++) {
                    const auto sample = [&](size_t s) {
                        return generateNumber<T>([&](int i) {
                            const size_t pixel = firstPixel + static_cast<size_t>(std::min(i, active - 1));
                            return value(output, tile_.fragmentOf[pixel * samples + s], c);
                        });
                    };
                    T sum = sample(0);
                    for (size_t s = 1; s < samples; s++) sum = kernels_.resolveAdd(sum, sample(s));
                    if (samples > 1) sum = kernels_.resolveMean(sum, reciprocal);
                    float* to =
                        &images[output].at(rectangle.x0 + static_cast<int>(first), rectangle.y0 + row, c);
                    for (int i = 0; i < active; i++) to[i] = static_cast<float>(numberLane(sum, i));
                }
            });
        }
    }
}

template <class T>
void TileShaderOf<T>::copyFirstSample(ShadeOutput output, int channels, const PixelRectangle& rectangle,
                                      ShadedImages& images) {
    if (!job_.request[output]) return;
    const auto samples = static_cast<size_t>(job_.target->format.samples);
    size_t pixel = 0;
    for (int y = rectangle.y0; y < rectangle.y1; y++)
        for (int x = rectangle.x0; x < rectangle.x1; x++, pixel++)
            for (int c = 0; c < channels; c++)
                images[output].at(x, y, c) =
                    static_cast<float>(value(output, tile_.fragmentOf[pixel * samples], c));
}

template <class T>
typename TileShaderOf<T>::vec3 TileShaderOf<T>::sampleEnvironment(vec3 direction) {
    const TextureView texture(job_.scene->environment.latLong);
    return kernels_.sampleLatLong(texture, direction,
                                  samplingOf<K>(sampler_, texture.width(), texture.height()));
}

// The passes over T, for the source that instantiates them.
template <class T>
ArithmeticPasses passesOver() {
    return {[](const ShadeJob& job) -> std::unique_ptr<TileShader> {
                return std::make_unique<TileShaderOf<T>>(job);
            },
            [](const Image<float>& latLong, int size, const CubeFromLatLong& options, int threads) {
                return cubeFromLatLong<T>(latLong, size, options, threads);
            }};
}

}  // namespace etalon
