#include "shadows/shadow_map.h"

#include "lighting/render_view.h"
#include "numeric/check.h"

namespace etalon {
namespace {

// The row that maps a world point p to dot(axis, p - origin) times s.
glm::dvec4 alongAxis(const glm::dvec3& axis, const glm::dvec3& origin, double s) {
    return glm::dvec4(axis.x * s, axis.y * s, axis.z * s,
                      -s * (axis.x * origin.x + (axis.y * origin.y + axis.z * origin.z)));
}
glm::dvec4 sum(const glm::dvec4& a, const glm::dvec4& b, double s) {
    return glm::dvec4(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z, a.w + s * b.w);
}
glm::dvec3 scaled(const glm::dvec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }

void checkSettings(const ShadowMapSettings& s) {
    ETALON_CHECK(s.size >= 1 && s.size <= kMaxShadowMapSize, "size {}", s.size);
    const bool isDisc = s.filter == ShadowFilter::disc || s.filter == ShadowFilter::soft;
    ETALON_CHECK(s.taps >= 1 && s.taps <= (isDisc ? kMaxDiscTaps : kMaxWindowTaps), "{} taps", s.taps);
    ETALON_CHECK(s.radius_texels >= 0 && s.radius_texels <= kMaxShadowRadius_texels, "radius {}",
                 s.radius_texels);
    ETALON_CHECK(s.lightSize_m >= 0 && s.tangentOfHalfAngle >= 0, "light size {}, tangent {}", s.lightSize_m,
                 s.tangentOfHalfAngle);
}

CullMode cullOf(ShadowFaces faces) {
    switch (faces) {
        case ShadowFaces::both:
            return CullMode::none;
        case ShadowFaces::front:
            return CullMode::back;
        case ShadowFaces::back:
            return CullMode::front;
    }
    return CullMode::none;
}

}  // namespace

View shadowView(const ShadowProjection& projection, int layer) {
    const double perTexel = 2.0 / projection.width;
    if (projection.isCube) {
        const int size = projection.width - 2 * projection.border;
        View view = cubeFaceView(static_cast<CubeFace>(layer), size, projection.origin, projection.near_m,
                                 projection.far_m);
        // The same frame over a wider square.
        const double narrower = size / static_cast<double>(projection.width);
        for (size_t r = 0; r < 2; r++)
            view.worldToClip[r] = sum(glm::dvec4(0), view.worldToClip[r], narrower);
        view.width = view.height = projection.width;
        view.centreX_px = view.centreY_px = projection.width / 2.0;
        return view;
    }
    View view;
    view.width = view.height = projection.width;
    view.eye = projection.origin;
    view.forward = projection.forward;
    view.perX = scaled(projection.right, 1 / projection.scale);
    view.perY = scaled(projection.down, 1 / projection.scale);
    view.centreX_px = projection.centreU;
    view.centreY_px = projection.centreV;
    const glm::dvec4 one(0, 0, 0, 1), along = alongAxis(projection.forward, projection.origin, 1);
    const glm::dvec4 w = projection.isPerspective ? along : one;
    view.worldToClip[0] = sum(alongAxis(projection.right, projection.origin, projection.scale * perTexel), w,
                              projection.centreU * perTexel - 1);
    view.worldToClip[1] = sum(alongAxis(projection.down, projection.origin, -projection.scale * perTexel), w,
                              1 - projection.centreV * perTexel);
    const glm::dvec4 z = sum(glm::dvec4(0), along, projection.depthScale);
    view.worldToClip[2] =
        sum(z, one, projection.isPerspective ? -projection.depthOffset : projection.depthOffset);
    view.worldToClip[3] = w;
    return view;
}

ShadowMap renderShadowMap(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                          const ShadowFit& fit, const ShadowMapSettings& settings, const Profile& profile,
                          const RasterOptions& options) {
    checkSettings(settings);
    ShadowMap map;
    map.settings = settings;
    map.projection = fit.projection;
    map.depthRounding = profile.depthRounding;
    if (fit.casters.empty()) return map;

    RenderTargetFormat format;
    format.subpixelBits = profile.subpixelBits;
    format.depth = map.format();
    format.depthRounding = profile.depthRounding;
    format.real = profile.vertex;
    format.biasUnit = profile.biasUnit;
    RasterOptions cleared = options;
    cleared.clear = true;
    VisibleScene visible{RenderTarget(fit.projection.width, fit.projection.width, format), {}, {}, {}};
    visible.instanceOfDraw = fit.casters;
    visible.vertices.resize(fit.casters.size());
    map.layers.resize(fit.layerDrawn.size());
    for (size_t layer = 0; layer < map.layers.size(); layer++) {
        if (!fit.layerDrawn[layer]) continue;
        const View view = shadowView(fit.projection, static_cast<int>(layer));
        std::vector<Draw> draws;
        for (size_t i = 0; i < fit.casters.size(); i++) {
            const PlacedMesh& mesh = placed[fit.casters[i]];
            toClipSpace(mesh, view, profile.vertex, options.threads, visible.vertices[i]);
            Draw draw;
            draw.vertices = visible.vertices[i];
            draw.indices = mesh.mesh->indices;
            draw.state.cull = cullOf(settings.faces);
            draw.state.frontIsClockwise = view.mirrored != mesh.mirrored;
            draw.state.depthClamp = true;
            draw.state.idWrite = map.holdsDistance();
            if (!map.holdsDistance()) draw.state.bias = settings.bias;
            draws.push_back(draw);
        }
        map.triangles += rasterize(visible.target, {0, 0, view.width, view.height}, draws, cleared).triangles;
        if (!map.holdsDistance()) {
            if (map.layers.size() == 1)
                map.layers[layer].stored = std::move(visible.target.depth);
            else
                map.layers[layer].stored = visible.target.depth;
            continue;
        }
        ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, options);
        job.request[ShadeOutput::distance] = true;
        map.layers[layer].distance_m = std::move(shade(job)[ShadeOutput::distance]);
    }
    return map;
}

ShadowMap renderShadowMap(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                          const SurfaceLight& light, const std::vector<bool>& receivers,
                          const ShadowMapSettings& settings, const Profile& profile,
                          const RasterOptions& options) {
    checkSettings(settings);
    return renderShadowMap(scene, placed, fitShadowMap(placed, light, receivers, settings), settings, profile,
                           options);
}

}  // namespace etalon
