// Rules 2 and 4: triangles that share an edge leave no gap and no pixel drawn twice, also where they are
// clipped.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "numeric/text.h"
#include "raster/rasterizer.h"
#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"

using namespace etalon;

namespace {

constexpr int kSnappedMeshes = 3000, kClippedMeshes = 3000;
constexpr double kTwoPi = 6.283185307179586;

using Point = std::array<int64_t, 2>;

// Counts front faces up and back faces down.
DrawState countingState() {
    DrawState state = alwaysState();
    state.depthWrite = false;
    state.stencil.enabled = true;
    state.stencil.front.onPass = StencilOperation::incrementWrap;
    state.stencil.back.onPass = StencilOperation::decrementWrap;
    return state;
}

RenderTarget countFaces(Random& random, const Viewport& viewport, const std::vector<ClipVertex>& vertices,
                        const std::vector<uint32_t>& indices, const RenderTargetFormat& format) {
    RenderTarget target(viewport.x + viewport.width, viewport.y + viewport.height, format);
    const Draw draw{vertices, indices, countingState()};
    rasterize(target, viewport, {&draw, 1}, {1, random.pick({8, 16, 64})});
    return target;
}

// How often a closed polygon winds around a point, counter-clockwise on the screen (y down) positive. Each
// edge owns its top end and, at its x, the points on it and right of it: what the top-left rule must add up
// to.
int windingNumber(const std::vector<Point>& loop, int64_t x, int64_t y) {
    int winding = 0;
    for (size_t i = 0; i < loop.size(); i++) {
        Point top = loop[i], bottom = loop[(i + 1) % loop.size()];
        const int direction = top[1] <= bottom[1] ? 1 : -1;
        if (direction < 0) std::swap(top, bottom);
        if (y < top[1] || y >= bottom[1]) continue;
        if ((y - top[1]) * (bottom[0] - top[0]) <= (x - top[0]) * (bottom[1] - top[1])) winding += direction;
    }
    return winding;
}

struct Mesh {
    std::vector<Point> points;      // in units of 1/256 pixel
    std::vector<uint32_t> indices;  // of triangles
    std::vector<size_t> boundary;   // the loop around the mesh, in the order that makes its triangles fronts
};

// A fan around point 0. Its rim may be any loop: folded fans count up and down.
Mesh randomFan(Random& random, int64_t extent) {
    Mesh mesh;
    const int rim = random.integer(3, 24);
    const bool regular = random.chance(0.6);
    const auto anywhere = [&] {
        return static_cast<int64_t>(random.uniform(-0.2, 1.2) * static_cast<double>(extent));
    };
    mesh.points.push_back({anywhere(), anywhere()});
    for (int i = 0; i < rim; i++) {
        const double angle = kTwoPi * (i + random.uniform(0, 0.9)) / rim;
        const double radius =
            std::ldexp(random.uniform(0.5, 1), -random.integer(0, 5)) * static_cast<double>(extent);
        if (regular)
            mesh.points.push_back({mesh.points[0][0] + static_cast<int64_t>(radius * std::cos(angle)),
                                   mesh.points[0][1] - static_cast<int64_t>(radius * std::sin(angle))});
        else
            mesh.points.push_back({anywhere(), anywhere()});
    }
    for (int i = 0; i < rim; i++) {
        const int next = (i + 1) % rim;
        mesh.indices.insert(mesh.indices.end(),
                            {0u, static_cast<uint32_t>(i + 1), static_cast<uint32_t>(next + 1)});
        mesh.boundary.push_back(static_cast<size_t>(i) + 1);
    }
    return mesh;
}

// A strip of two rails; with wild steps it folds over itself.
Mesh randomStrip(Random& random, int64_t extent) {
    Mesh mesh;
    const int pairs = random.integer(2, 14);
    const int64_t wild = random.chance(0.5) ? extent / 40 : extent / 3;
    const auto noise = [&] {
        return static_cast<int64_t>(random.uniform(-1, 1) * static_cast<double>(wild));
    };
    for (int i = 0; i < pairs; i++) {
        const int64_t x = extent * i / (pairs - 1);
        mesh.points.push_back({x + noise(), extent / 3 + noise()});
        mesh.points.push_back({x + noise(), 2 * extent / 3 + noise()});
    }
    for (uint32_t i = 0; i + 3 < mesh.points.size(); i += 2)
        mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + 2, i + 2, i + 1, i + 3});
    for (size_t i = 0; i < mesh.points.size(); i += 2) mesh.boundary.push_back(i + 1);
    for (size_t i = mesh.points.size(); i > 0; i -= 2) mesh.boundary.push_back(i - 2);
    return mesh;
}

}  // namespace

TEST_CASE("SharedEdgeCoversEachPixelOnce") {
    constexpr int64_t kUnit = 256;
    Random random(11);
    size_t covered = 0, folded = 0;
    for (int run = 0; run < kSnappedMeshes; run++) {
        const Viewport viewport{random.integer(0, 7), random.integer(0, 7), 32, 32};
        const Mesh mesh =
            random.chance(0.5) ? randomFan(random, 32 * kUnit) : randomStrip(random, 32 * kUnit);
        // w differs, the snapped positions do not.
        std::vector<ClipVertex> vertices;
        for (const Point& p : mesh.points)
            vertices.push_back(vertexAtPixel(viewport, viewport.x + static_cast<double>(p[0]) / kUnit,
                                             viewport.y + static_cast<double>(p[1]) / kUnit,
                                             std::ldexp(1.0, random.integer(-3, 3)), 0.5));
        std::vector<Point> loop;
        for (size_t i : mesh.boundary) loop.push_back(mesh.points[i]);
        RenderTargetFormat format;
        format.samples = random.pick({1, 1, 4});
        const RenderTarget target = countFaces(random, viewport, vertices, mesh.indices, format);
        size_t wrong = 0;
        for (int s = 0; s < format.samples; s++)
            for (int y = 0; y < viewport.height; y++)
                for (int x = 0; x < viewport.width; x++) {
                    const auto offset = samplePositions(format.samples)[static_cast<size_t>(s)];
                    const int winding = windingNumber(loop, x * kUnit + offset[0] * kUnit / 16,
                                                      y * kUnit + offset[1] * kUnit / 16);
                    const int stored = target.stencil.at(viewport.x + x, viewport.y + y, s);
                    wrong += stored != (winding & 0xff);
                    covered += winding == 1;
                    folded += winding != 0 && winding != 1;
                }
        CHECK_MESSAGE(wrong == 0, "mesh ", run);
    }
    // Both kinds must occur.
    CHECK(covered > 100000);
    CHECK(folded > 10000);
}

namespace {

// A flat star-shaped fan in clip space: a plane through space seen in perspective, so each pixel sees it
// once. Vertices lie on all sides of the near plane and of w = 0, and far outside of the guard band.
struct Fan {
    std::vector<ClipVertex> vertices;  // the first one is the centre
    std::vector<uint32_t> indices;
};

Fan randomPerspectiveFan(Random& random) {
    constexpr double kNear = 0.1, kFar = 1000;
    // The plane, in camera space with z away from the camera: origin + u a + v b.
    const double origin[3] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.05, 4)};
    double a[3], b[3];
    for (int i = 0; i < 3; i++) a[i] = random.uniform(-1, 1), b[i] = random.uniform(-1, 1);
    const bool facing =
        random.chance(0.3);  // almost parallel to the screen: leaves the guard band with w > 0
    if (facing) a[2] *= 0x1p-20, b[2] *= 0x1p-20;
    // Edges to rims as far as 2^46 lose seven bits after the point when they are cut from the wrong end.
    const int farthest = random.chance(0.3) ? 46 : facing || random.chance(0.3) ? 20 : 6;
    const double size = std::ldexp(1.0, random.integer(-2, farthest));
    const double focal = random.uniform(0.5, 3);
    const int rim = random.integer(5, 16);  // no two neighbours are half a turn apart
    Fan fan;
    const auto add = [&](double u, double v) {
        double p[3];
        for (int i = 0; i < 3; i++) p[i] = origin[i] + u * a[i] + v * b[i];
        fan.vertices.push_back({focal * p[0], focal * p[1], kFar * (p[2] - kNear) / (kFar - kNear), p[2]});
    };
    add(0, 0);
    for (int i = 0; i < rim; i++) {
        const double angle = kTwoPi * (i + random.uniform(0, 0.9)) / rim,
                     radius = size * random.uniform(0.3, 1);
        add(radius * std::cos(angle), radius * std::sin(angle));
    }
    for (int i = 0; i < rim; i++) {
        const auto first = static_cast<uint32_t>(i + 1), next = static_cast<uint32_t>((i + 1) % rim + 1);
        fan.indices.insert(fan.indices.end(), {0u, first, next});
    }
    return fan;
}

// Whether the fan is seen at a point of the screen: its weights in some triangle, from the homogeneous
// coordinates (x, y, w), are not negative, and the depth there is between the planes. In plain double, so
// only good away from the borders.
bool seesFan(const Fan& fan, double x_ndc, double y_ndc) {
    for (size_t t = 0; t < fan.indices.size(); t += 3) {
        const ClipVertex &a = fan.vertices[fan.indices[t]], &b = fan.vertices[fan.indices[t + 1]],
                         &c = fan.vertices[fan.indices[t + 2]];
        // Cross products of two vertices, dotted with the point (x, y, 1) and with the third vertex.
        const auto weight = [](const ClipVertex& p, const ClipVertex& q, double x, double y, double w) {
            return (p.y * q.w - p.w * q.y) * x + (p.w * q.x - p.x * q.w) * y + (p.x * q.y - p.y * q.x) * w;
        };
        const double determinant = weight(b, c, a.x, a.y, a.w);
        if (determinant == 0) continue;
        const double l[3] = {weight(b, c, x_ndc, y_ndc, 1) / determinant,
                             weight(c, a, x_ndc, y_ndc, 1) / determinant,
                             weight(a, b, x_ndc, y_ndc, 1) / determinant};
        const double slack = -1e-9 * (std::abs(l[0]) + std::abs(l[1]) + std::abs(l[2]));
        if (l[0] < slack || l[1] < slack || l[2] < slack) continue;
        const double z = l[0] * a.z + l[1] * b.z + l[2] * c.z, w = l[0] * a.w + l[1] * b.w + l[2] * c.w;
        if (z >= 0 && z <= w) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("SharedEdgeCoversEachPixelOnceAfterClipping") {
    constexpr int kWidth = 32, kHeight = 24;
    constexpr int kPerPixel = 2;  // points of the lattice per pixel
    Random random(13);
    size_t interior = 0, behind = 0, guard = 0;
    for (int run = 0; run < kClippedMeshes; run++) {
        const Fan fan = randomPerspectiveFan(random);
        const Viewport viewport{0, 0, kWidth, kHeight};
        const RenderTarget target = countFaces(random, viewport, fan.vertices, fan.indices, {});
        for (const ClipVertex& v : fan.vertices) {
            behind += v.z < 0;
            guard += v.w > 0 && std::abs(v.x) > 131072.0 / kWidth * v.w;
        }
        // A pixel is interior when the fan is seen at its centre and at 24 points up to a pixel around it.
        std::vector<char> seen(size_t(kPerPixel * (kWidth + 2)) * size_t(kPerPixel * (kHeight + 2)));
        const auto at = [&](int i, int j) -> char& {
            return seen[static_cast<size_t>((j + 2) * kPerPixel * (kWidth + 2) + i + 2)];
        };
        for (int j = -2; j < kPerPixel * kHeight + 2; j++)
            for (int i = -2; i < kPerPixel * kWidth + 2; i++)
                at(i, j) = seesFan(fan, (i + 1.0) / kWidth - 1, 1 - (j + 1.0) / kHeight);
        size_t wrong = 0, twice = 0;
        for (int y = 0; y < kHeight; y++)
            for (int x = 0; x < kWidth; x++) {
                const int count = static_cast<int8_t>(target.stencil.at(x, y));
                twice += count < -1 || count > 1;
                bool inside = true;
                for (int j = -2; j <= 2; j++)
                    for (int i = -2; i <= 2; i++) inside = inside && at(kPerPixel * x + i, kPerPixel * y + j);
                interior += inside;
                wrong += inside && std::abs(count) != 1;
            }
        CHECK_MESSAGE(wrong == 0, "mesh ", run);
        CHECK_MESSAGE(twice == 0, "mesh ", run);
    }
    CHECK(interior > 200000);
    CHECK(behind > 3000);
    CHECK(guard > 1000);
}
