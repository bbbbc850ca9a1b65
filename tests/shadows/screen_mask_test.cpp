#include "shadows/screen_mask.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "lighting/render_view.h"
#include "raster/blur.h"
#include "shadows/shadow_bias.h"
#include "shadows/shadow_maps.h"
#include "tests/shadows/shadow_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr int kWidth = 160, kHeight = 120;

// A ground with a square in the air, seen from the front and above: in the image the square hides most of its
// shadow.
struct Picture {
    SurfaceScene scene;
    std::vector<PlacedMesh> placed;
    View view;
    const Profile& profile = *findProfile("f32");
    RasterOptions options{1, 64, false};
    std::optional<VisibleScene> visible;

    Picture() {
        addObject(scene, tile({0, 0, 0}, 6), lambertian(1));
        addObject(scene, rectangle({0, 0.8f, 0}, {0.5f, 0, 0}, {0, 0.3f, -0.3f}), lambertian(1));
        scene.lights.push_back(sun({0.7, 0.8, 2}));
        placed = placeMeshes(scene, profile.vertex, 1);
        PinholeCamera camera;
        camera.width = kWidth, camera.height = kHeight;
        camera.fx = camera.fy = 150;
        camera.cx = kWidth / 2.0, camera.cy = kHeight / 2.0;
        camera.position = {0, 2, 3};
        camera.backward = unit({0, 1.5, 3});
        camera.up = unit({0, 3, -1.5});
        view = cameraView(camera);
        visible.emplace(findVisible(scene, placed, view, profile, 1, options));
    }
    ShadowMaps maps(ShadowFilter filter, int taps) {
        ShadowMapSettings settings;
        settings.size = 256;
        settings.filter = filter;
        settings.taps = taps;
        settings.receiverPlane = true;
        settings.bias = leastBias(settings);
        ShadowMaps maps(1);
        maps.set(0, renderShadowMap(scene, placed, scene.lights[0], {}, settings, profile, options), profile,
                 1);
        return maps;
    }
    ShadeJob job(const LightVisibility& visibility) {
        ShadeJob job = shadeJobOf(*visible, scene, placed, view, profile, options);
        job.visibility = &visibility;
        job.request[ShadeOutput::diffuse] = true;
        return job;
    }
    uint32_t instanceAt(int x, int y) const {
        const uint32_t id = visible->target.id.at(x, y);
        return id == kNoTriangle ? kNoInstance : visible->instanceOfDraw[visible->target.triangles[id].draw];
    }
};

}  // namespace

// Without a blur the mask is the shadow map's answer: the picture is the same to the bit.
TEST_CASE("AMaskWithoutBlurIsTheShadowMap") {
    Picture picture;
    const ShadowMaps maps = picture.maps(ShadowFilter::hard, 1);
    const Image<float> direct = shade(picture.job(maps))[ShadeOutput::diffuse];
    ScreenMasks masks(1);
    masks.set(0, screenMask(picture.job(maps), 0));
    const Image<float> composed = shade(picture.job(masks))[ShadeOutput::diffuse];
    CHECK(std::equal(direct.values().begin(), direct.values().end(), composed.values().begin()));
    CHECK(*std::min_element(direct.values().begin(), direct.values().end()) == 0);
}

// The difference: the blurred mask bleeds over the outline of the square, onto what lies in front of and
// behind it. Percentage-closer filtering leaves the lit square lit and the ground beside its outline as it
// is.
TEST_CASE("ABlurredMaskBleedsOverOutlinesAndFilteringDoesNot") {
    Picture picture;
    const ShadowMaps hard = picture.maps(ShadowFilter::hard, 1),
                     filtered = picture.maps(ShadowFilter::pcf, 8);
    const Image<float> sharp = screenMask(picture.job(hard), 0);
    const Image<float> mask = blurGaussian(sharp, 6, 2.0, 1);
    const Image<float> pcf = screenMask(picture.job(filtered), 0);
    // On the square, which nothing shadows.
    int wrong = 0, bled = 0, bledFiltered = 0, soft = 0, softFiltered = 0;
    for (int y = 0; y < kHeight; y++)
        for (int x = 0; x < kWidth; x++) {
            const bool isSquare = picture.instanceAt(x, y) == 1;
            wrong += isSquare && sharp.at(x, y) != 1 ? 1 : 0;
            if (isSquare) {
                bled += mask.at(x, y) < 0.99f ? 1 : 0;
                bledFiltered += pcf.at(x, y) < 0.99f ? 1 : 0;
            } else {
                soft += mask.at(x, y) > 0.01f && mask.at(x, y) < 0.99f ? 1 : 0;
                softFiltered += pcf.at(x, y) > 0.01f && pcf.at(x, y) < 0.99f ? 1 : 0;
            }
        }
    MESSAGE("pixels of the square dimmed: ", bled, " by the blurred mask, ", bledFiltered, " by filtering");
    CHECK(wrong == 0);
    CHECK(bled > 50);
    CHECK(bledFiltered == 0);
    CHECK(soft > 100);
    CHECK(softFiltered > 30);
}
