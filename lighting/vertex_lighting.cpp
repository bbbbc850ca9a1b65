#include "lighting/vertex_lighting.h"

#include "lighting/surface_lighting.h"
#include "numeric/door.h"
#include "numeric/number.h"

namespace etalon {
namespace {

template <class S>
void lightIn(const Profile& profile, const LightSources& sources, const SurfaceMaterial& material,
             const PlacedMesh& placed, const glm::dvec3& eye, size_t begin, size_t count,
             const VertexOcclusion* occlusion, VertexRadiance& radiance) {
    using T = Native<S>;
    using Lighting = SurfaceLighting<T>;
    using vec3 = typename Lighting::vec3;
    Lighting lighting(sources, samplerOf(profile));
    typename Lighting::K kernels;
    const auto reflectances = Lighting::reflectancesOf(material);
    typename Lighting::SurfaceParts parts{};
    parts.diffuse = true;
    parts.specular = material.kind == MaterialKind::blinnPhong;
    parts.isOccluded = occlusion != nullptr;
    forEachLaneGroup<Number<T>::lanes>(count, [&](size_t first, int active) {
        const auto vertex = [&](int lane) {
            return begin + first + static_cast<size_t>(lane < active ? lane : active - 1);
        };
        const auto load = [&](const auto& values) {
            const auto component = [&](int c) {
                return Number<T>::generate([&](int i) { return values[vertex(i)][c]; });
            };
            return vec3(component(0), component(1), component(2));
        };
        const auto store = [&](const vec3& value, std::vector<glm::dvec3>& to) {
            for (int i = 0; i < active; i++)
                to[vertex(i)] = {numberLane(value.x, i), numberLane(value.y, i), numberLane(value.z, i)};
        };
        const vec3 normal = load(placed.normals), position = load(placed.positions);
        const vec3 toEye = kernels.directionToEye(Lighting::constant(eye), position);
        const auto coordinate = [&](int c) {
            return Number<T>::generate(
                [&](int i) { return placed.mesh->uv_m.empty() ? 0.0 : placed.mesh->uv_m[vertex(i)][c]; });
        };
        const vec3 albedo = kernels.albedoAt(reflectances, coordinate(0), coordinate(1));
        for (size_t side = 0; side < radiance.sides.size(); side++) {
            auto& to = radiance.sides[side];
            typename Lighting::Surroundings surroundings{T(1.0), normal};
            if (occlusion) {
                const std::vector<Occlusion>& of = (*occlusion)[side];
                const auto bent = [&](int c) {
                    return Number<T>::generate([&](int i) { return of[vertex(i)].bentNormal[c]; });
                };
                surroundings.open = Number<T>::generate([&](int i) { return of[vertex(i)].open; });
                surroundings.bentNormal = vec3(bent(0), bent(1), bent(2));
                for (int i = 0; i < active; i++) to.open[vertex(i)] = numberLane(surroundings.open, i);
            }
            const typename Lighting::K::SurfacePoint point{
                position, kernels.seenNormal(normal, T(side == 0 ? 1.0 : -1.0)), toEye};
            const auto reflected = lighting.reflectedLight(parts, point, reflectances, albedo, surroundings,
                                                           lighting.lights(), {});
            store(reflected.diffuse, to.diffuse);
            store(reflected.specular, to.specular);
        }
    });
}

void lightVertices(const Profile& profile, const LightSources& sources, const SurfaceMaterial& material,
                   const PlacedMesh& placed, const glm::dvec3& eye, size_t begin, size_t count,
                   const VertexOcclusion* occlusion, VertexRadiance& radiance) {
    if (profile.vertex == RasterReal::fp32)
        lightIn<float>(profile, sources, material, placed, eye, begin, count, occlusion, radiance);
    else
        lightIn<double>(profile, sources, material, placed, eye, begin, count, occlusion, radiance);
}

}  // namespace

template <>
constexpr VertexLightingPasses kPassesOver<VertexLightingPasses, void> = {lightVertices};
template const VertexLightingPasses& ETALON_LEVEL::passesOf<VertexLightingPasses>();

}  // namespace etalon
