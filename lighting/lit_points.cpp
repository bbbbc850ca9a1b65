#include "lighting/lit_points.h"

#include <algorithm>

namespace etalon {
namespace {

class PointRecorder final : public LightVisibility {
  public:
    explicit PointRecorder(const std::function<bool(const LitPoints&, size_t)>& keep) : keep_(keep) {}

    bool casts(size_t light) const override { return light == 0; }
    void find(size_t, const LitPoints& points, std::span<double> visibility) const override {
        std::fill(visibility.begin(), visibility.end(), 1.0);
        for (size_t i = 0; i < points.size(); i++) {
            if (keep_ && !keep_(points, i)) continue;
            for (size_t k = 0; k < 3; k++) {
                recorded.position_m[k].push_back(points.position_m[k][i]);
                recorded.normal[k].push_back(points.normal[k][i]);
                recorded.faceNormal[k].push_back(points.faceNormal[k][i]);
            }
            recorded.instance.push_back(points.instance[i]);
            recorded.x_px.push_back(points.x_px[i]), recorded.y_px.push_back(points.y_px[i]);
        }
    }

    mutable LitPoints recorded;

  private:
    const std::function<bool(const LitPoints&, size_t)>& keep_;
};

}  // namespace

LitPoints litPointsOf(const ShadeJob& job, const std::function<bool(const LitPoints&, size_t)>& keep) {
    const PointRecorder recorder(keep);
    ShadeJob recorded = job;
    recorded.threads = 1;
    recorded.visibility = &recorder;
    recorded.vertexRadiance = nullptr;
    recorded.request = {};
    recorded.request[ShadeOutput::diffuse] = true;
    shade(recorded);
    return std::move(recorder.recorded);
}

}  // namespace etalon
