#include "shadows/screen_mask.h"

#include <algorithm>

#include "lighting/render_view.h"
#include "numeric/check.h"

namespace etalon {
namespace {

// Writes down what a visibility says. Pixels belong to one tile each, so that threads do not meet.
class MaskRecorder final : public LightVisibility {
  public:
    MaskRecorder(const LightVisibility& visibility, size_t light, Image<float>& mask)
        : visibility_(visibility), light_(light), mask_(mask) {}

    bool casts(size_t light) const override { return light == light_ && visibility_.casts(light); }
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override {
        visibility_.find(light, points, visibility);
        for (size_t i = 0; i < points.size(); i++)
            if (points.instance[i] != kNoInstance)
                mask_.at(static_cast<int>(points.x_px[i]), static_cast<int>(points.y_px[i])) =
                    static_cast<float>(visibility[i]);
    }

  private:
    const LightVisibility& visibility_;
    size_t light_;
    Image<float>& mask_;
};

}  // namespace

Image<float> screenMask(const ShadeJob& job, size_t light) {
    ETALON_CHECK(job.visibility && job.target && job.target->format.samples == 1,
                 "a mask has one sample per pixel");
    Image<float> mask(job.target->width(), job.target->height());
    std::fill(mask.values().begin(), mask.values().end(), 1.f);
    const MaskRecorder recorder(*job.visibility, light, mask);
    ShadeJob recorded = job;
    recorded.visibility = &recorder;
    recorded.vertexRadiance = nullptr;
    recorded.request = {};
    recorded.request[ShadeOutput::diffuse] = true;
    shade(recorded);
    return mask;
}

void ScreenMasks::find(size_t light, const LitPoints& points, std::span<double> visibility) const {
    const Image<float>& mask = masks_[light];
    for (size_t i = 0; i < points.size(); i++) {
        const auto x = static_cast<int>(points.x_px[i]), y = static_cast<int>(points.y_px[i]);
        ETALON_CHECK(x < mask.width() && y < mask.height(), "pixel {}, {} of {} x {}", x, y, mask.width(),
                     mask.height());
        visibility[i] = mask.at(x, y);
    }
}

}  // namespace etalon
