// What the cases draw: made in code from + - * / sqrt, our own elementary functions and integer random
// numbers, so that the inputs are the same bits on every machine.
#pragma once

#include <deque>
#include <vector>

#include "lighting/surface_scene.h"
#include "lighting/view.h"
#include "numeric/random.h"
#include "raster/draw.h"
#include "raster/rasterizer.h"

namespace etalon {

// Draws with the vertices and indices that they refer to.
class DrawList {
  public:
    // Three vertices per triangle.
    void add(std::vector<ClipVertex> vertices, const DrawState& state);
    void add(std::vector<ClipVertex> vertices, std::vector<uint32_t> indices, const DrawState& state);
    const std::vector<Draw>& draws() const { return draws_; }

  private:
    // Elements of a deque stay where they are.
    std::deque<std::vector<ClipVertex>> vertices_;
    std::deque<std::vector<uint32_t>> indices_;
    std::vector<Draw> draws_;
};

// Families of random triangles, three vertices each.
enum class Soup : uint8_t {
    inside,     // of some pixels to the whole viewport, w from 1/8 to 16
    slivers,    // less than a few subpixels wide
    onSamples,  // vertices on pixel centres, corners and multisample positions
    nearFar,    // z on both sides of the near and the far plane
    behind,     // w of both signs, and tiny
    guardBand,  // up to and beyond the guard band
    folded,     // slivers across the near plane: snapping turns pieces of the polygon around
};
std::vector<ClipVertex> triangleSoup(Random& random, Soup family, int count, const Viewport& viewport);

// Closed and open meshes, lengths in metres, with normals of about unit length.
// torusKnotMesh: a tube around the (2, 3) torus knot about +Y, 2 x along x around triangles, counter-clockwise from
// outside. Its middle at the angle 2t is radius_m + swing_m cos(3t) from the axis, rise_m sin(3t) above the origin.
// Ripples change the tube's radius by ripple_m sin(9 v + 30 t), v around the tube; normals are those of the smooth tube.
struct KnotShape {
    double radius_m = 1, swing_m = 0.4, rise_m = 0.4, tube_m = 0.18, ripple_m = 0;
};
SurfaceMesh torusKnotMesh(int along, int around, const KnotShape& shape = {});
SurfaceMesh sphereMesh(int columns, int rows);
SurfaceMesh groundMesh(float halfSize);

// A high dynamic range lat-long image: a sky, a ground and a small sun of radiance 4096.
Image<float> skyImage(int width, int height);

// A knot (Blinn-Phong), a mirror ball that sees the scene, a mirror ball that sees the sky, a checkered
// ground (Lambert), three lights.
SurfaceScene demoScene();

// The scene from above its front.
View demoView(int width, int height);

}  // namespace etalon
