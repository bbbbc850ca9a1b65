#include "lighting/view.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/vectors.h"

namespace etalon {
namespace {

// The row that maps a world point p to dotOf(axis, p - eye).
glm::dvec4 alongAxis(const glm::dvec3& axis, const glm::dvec3& eye) {
    return glm::dvec4(axis.x, axis.y, axis.z, -dotOf(axis, eye));
}

glm::dvec4 combine(double a, const glm::dvec4& p, double b, const glm::dvec4& q) {
    return glm::dvec4(a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z, a * p.w + b * q.w);
}

// z / w is 0 at the near and 1 at the far plane: z = (w - near) far / (far - near).
glm::dvec4 depthRow(const glm::dvec4& wRow, double near_m, double far_m) {
    const double scale = std::isinf(far_m) ? 1.0 : far_m / (far_m - near_m);
    glm::dvec4 row = combine(scale, wRow, 0, wRow);
    row.w = row.w - scale * near_m;
    return row;
}

}  // namespace

View cameraView(const PinholeCamera& camera) {
    ETALON_CHECK(camera.width > 0 && camera.height > 0 && camera.fx > 0 && camera.fy > 0 &&
                     camera.near_m > 0 && camera.near_m < camera.far_m,
                 "{}x{}, fx {}, fy {}, near {}, far {}", camera.width, camera.height, camera.fx, camera.fy,
                 camera.near_m, camera.far_m);
    View view;
    view.width = camera.width;
    view.height = camera.height;
    view.eye = camera.position;
    const glm::dvec4 right = alongAxis(camera.right, camera.position);
    const glm::dvec4 up = alongAxis(camera.up, camera.position);
    const glm::dvec4 w = alongAxis(scaledBy(camera.backward, -1.0), camera.position);
    // Pixel x = cx + fx right / w, pixel y = cy - fy up / w, then to [-1, 1].
    view.worldToClip[0] =
        combine(2.0 * camera.fx / camera.width, right, 2.0 * camera.cx / camera.width - 1.0, w);
    view.worldToClip[1] =
        combine(2.0 * camera.fy / camera.height, up, 1.0 - 2.0 * camera.cy / camera.height, w);
    view.worldToClip[2] = depthRow(w, camera.near_m, camera.far_m);
    view.worldToClip[3] = w;
    view.centreX_px = camera.cx;
    view.centreY_px = camera.cy;
    view.forward = scaledBy(camera.backward, -1.0);
    view.perX = scaledBy(camera.right, 1.0 / camera.fx);
    view.perY = scaledBy(camera.up, -1.0 / camera.fy);
    view.near_m = camera.near_m, view.far_m = camera.far_m;
    return view;
}

View withInfiniteFar(const View& view) {
    ETALON_CHECK(view.near_m > 0, "near {}", view.near_m);
    View infinite = view;
    infinite.worldToClip[2] = depthRow(view.worldToClip[3], view.near_m, HUGE_VAL);
    infinite.far_m = HUGE_VAL;
    return infinite;
}

View inDirection(const View& view, DepthDirection direction) {
    if (direction == DepthDirection::forward) return view;
    ETALON_CHECK(view.near_m > 0, "near {}", view.near_m);
    // z = (far - w) near / (far - near), of rows that are exact where far is infinite.
    const double near_m = view.near_m, far_m = view.far_m,
                 scale = std::isinf(far_m) ? 0 : near_m / (far_m - near_m);
    View reversed = view;
    reversed.worldToClip[2] = combine(-scale, view.worldToClip[3], 0, view.worldToClip[3]);
    reversed.worldToClip[2].w += std::isinf(far_m) ? near_m : far_m * scale;
    return reversed;
}

View cubeFaceView(CubeFace face, int size, const glm::dvec3& eye, double near_m, double far_m) {
    ETALON_CHECK(size > 0 && near_m > 0 && near_m < far_m, "size {}, near {}, far {}", size, near_m, far_m);
    // The face table: the directions in which s and t grow, and the major axis.
    struct Axes {
        glm::dvec3 s, t, major;
    };
    static const std::array<Axes, kCubeFaces> kAxes = {{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
                                                        {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                                                        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                                        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                                        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                                        {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};
    const Axes& axes = kAxes[static_cast<size_t>(face)];
    View view;
    view.width = view.height = size;
    view.eye = eye;
    const glm::dvec4 w = alongAxis(axes.major, eye);
    view.worldToClip[0] = alongAxis(axes.s, eye);
    view.worldToClip[1] = alongAxis(scaledBy(axes.t, -1.0), eye);
    view.worldToClip[2] = depthRow(w, near_m, far_m);
    view.worldToClip[3] = w;
    view.centreX_px = view.centreY_px = size / 2.0;
    view.forward = axes.major;
    view.perX = scaledBy(axes.s, 2.0 / size);
    view.perY = scaledBy(axes.t, 2.0 / size);
    view.mirrored = true;
    view.near_m = near_m, view.far_m = far_m;
    return view;
}

}  // namespace etalon
