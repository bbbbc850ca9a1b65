#include "shadows/shadow_map.h"

#include <doctest/doctest.h>

#include "tests/shadows/shadow_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

// A square of 1 m above the middle of a square of 4 m at y = 0.
SurfaceScene squareOverGround(float height) {
    SurfaceScene scene;
    addObject(scene, tile({0, 0, 0}, 4), lambertian(0.5));
    addObject(scene, tile({0, height, 0}, 1), lambertian(0.5));
    return scene;
}

}  // namespace

// A square straight under a light shadows its projection: a square of 1 m (directional), or of 1 m x 3 / 2.
TEST_CASE("ASquareShadowsItsProjection") {
    const SurfaceScene scene = squareOverGround(1);
    struct Case {
        SurfaceLight light;
        double half_m;
    };
    const Case cases[] = {{sun({0, 1, 0}), 0.5},
                          {bulb({0, 3, 0}), 0.75},
                          {torch({0, 3, 0}, {0, -1, 0}, 0.7), 0.75},
                          {torch({0, 3, 0}, {0, -1, 0}, 0.1), 0.75}};
    for (const Case& c : cases)
        for (const ShadowDepth depth :
             {ShadowDepth::d16, ShadowDepth::d24, ShadowDepth::d32f, ShadowDepth::linear})
            for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::disc})
                for (const char* profile : {"f32", "f64", "truth", "d3d11"}) {
                    MapRequest request;
                    request.profile = profile;
                    request.settings.size = 64;
                    request.settings.depth = depth;
                    request.settings.filter = filter;
                    const LitPoints points = gridOn(0, -2, 2, 40);
                    const std::vector<double> visibility = visibilityOf(scene, c.light, points, request);
                    // Texels are below 1/16 m on the ground (cube: 2 * 3 / 64); the filters reach 4 of them.
                    const double near_m = filter == ShadowFilter::hard ? 0.1 : 0.45;
                    int inside = 0, outside = 0, wrong = 0;
                    for (size_t i = 0; i < points.size(); i++) {
                        const double distance =
                            std::max(std::fabs(points.position_m[0][i]), std::fabs(points.position_m[2][i])) -
                            c.half_m;
                        if (std::fabs(distance) < near_m) continue;
                        (distance < 0 ? inside : outside)++;
                        wrong += visibility[i] != (distance < 0 ? 0.0 : 1.0) ? 1 : 0;
                    }
                    CAPTURE(profile);
                    CAPTURE(static_cast<int>(depth));
                    CAPTURE(static_cast<int>(filter));
                    CAPTURE(static_cast<int>(c.light.kind));
                    CHECK(inside > 0);
                    CHECK(outside > 0);
                    CHECK(wrong == 0);
                }
}
