// A point of view: where world space lands on the screen, and which direction a pixel looks in.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "raster/cube_face.h"
#include "raster/draw.h"

namespace etalon {

// Rows of the matrix world -> clip space (0 <= z <= w), and the ray through pixel position (x, y):
// forward + ((x - centreX_px) perX + (y - centreY_px) perY), of length one along the optical axis.
struct View {
    int width = 0, height = 0;
    std::array<glm::dvec4, 4> worldToClip{};
    glm::dvec3 eye{0};
    double centreX_px = 0, centreY_px = 0;
    glm::dvec3 forward{0, 0, -1}, perX{0}, perY{0};
    bool mirrored = false;         // counter-clockwise faces appear clockwise (cube faces)
    double near_m = 0, far_m = 0;  // the planes' distances; 0: not a perspective view
};

// A pinhole camera. fx, fy, cx, cy in pixels (pixel centres at +0.5, row 0 on top); axes: the camera's right,
// up and backward direction in world space, orthonormal; 0 < near < far in metres, far may be infinite.
struct PinholeCamera {
    int width = 0, height = 0;
    double fx = 0, fy = 0, cx = 0, cy = 0;
    glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, backward{0, 0, 1}, position{0};
    double near_m = 0.1, far_m = 100;
};

View cameraView(const PinholeCamera& camera);

// The same perspective view with its far plane at infinity: z / w = 1 - near / distance, points at infinity
// have z = w to the bit, and no finite point has z > w.
View withInfiniteFar(const View& view);

// The same perspective view with depths of that direction. Reversed: z / w = near (far / distance - 1) / (far - near), with
// an infinite far plane near / distance.
View inDirection(const View& view, DepthDirection direction);

// One face of a cube map of size x size texels seen from `eye`, by the GL/Vulkan face table.
View cubeFaceView(CubeFace face, int size, const glm::dvec3& eye, double near_m, double far_m);

}  // namespace etalon
