#include "bitcheck/inputs.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "numeric/elementary.h"
#include "numeric/vectors.h"
#include "probes/latlong.h"

namespace etalon {
namespace {

// The double next to 2 pi.
constexpr double kTurn_rad = 0x1.921fb54442d18p+2;

// The vertex that rule 3 brings close to (x_px, y_px), with z = depth * w.
ClipVertex vertexAt(const Viewport& v, double x_px, double y_px, double w, double depth) {
    const double halfWidth = v.width / 2.0, halfHeight = v.height / 2.0;
    return {(x_px - (v.x + halfWidth)) / halfWidth * w, (y_px - (v.y + halfHeight)) / -halfHeight * w,
            depth * w, w};
}

// Random numbers are drawn one statement at a time: the order in which a compiler evaluates the arguments of
// a call, or both sides of an operator, is its choice.
ClipVertex vertexInside(Random& random, const Viewport& v) {
    const double x = v.x + random.uniform(-0.2, 1.2) * v.width;
    const double y = v.y + random.uniform(-0.2, 1.2) * v.height;
    const double scale = powerOfTwo(random.integer(-3, 3));
    const double w = scale * random.uniform(1, 2);
    return vertexAt(v, x, y, w, random.uniform(0, 1));
}

// Three vertices almost on one line.
std::array<ClipVertex, 3> sliver(Random& random, const Viewport& v, double width_px) {
    const double x0 = v.x + random.uniform(-0.1, 1.1) * v.width;
    const double y0 = v.y + random.uniform(-0.1, 1.1) * v.height;
    const double x1 = v.x + random.uniform(-0.1, 1.1) * v.width;
    const double y1 = v.y + random.uniform(-0.1, 1.1) * v.height;
    const double t = random.uniform(-0.2, 1.2);
    const double x2 = x0 + t * (x1 - x0) + random.uniform(-width_px, width_px);
    const double y2 = y0 + t * (y1 - y0) + random.uniform(-width_px, width_px);
    const double w = random.uniform(0.5, 4);
    return {vertexAt(v, x0, y0, 1, 0.25), vertexAt(v, x1, y1, w, 0.5), vertexAt(v, x2, y2, 2, 0.75)};
}

std::array<ClipVertex, 3> soupTriangle(Random& random, Soup family, const Viewport& v) {
    std::array<ClipVertex, 3> t = {vertexInside(random, v), vertexInside(random, v), vertexInside(random, v)};
    switch (family) {
        case Soup::inside:
            break;
        case Soup::slivers:
            return sliver(random, v, powerOfTwo(-random.integer(0, 9)));
        case Soup::onSamples:
            for (ClipVertex& p : t) {
                const double x = v.x + 0.0625 * random.integer(0, 16 * v.width);
                const double y = v.y + 0.0625 * random.integer(0, 16 * v.height);
                const double w = random.chance(0.5) ? 1 : 4;
                p = vertexAt(v, x, y, w, random.uniform(0, 1));
            }
            break;
        case Soup::nearFar:
            for (ClipVertex& p : t) p.z = random.uniform(-0.7, 1.7) * p.w;
            break;
        case Soup::behind:
            for (ClipVertex& p : t) {
                p.x = random.uniform(-2, 2);
                p.y = random.uniform(-2, 2);
                p.w = random.chance(0.1) ? powerOfTwo(random.integer(-90, -60)) : random.uniform(-1, 2);
                p.z = random.chance(0.5) ? p.w * random.uniform(0, 1) : random.uniform(-0.5, 1.5);
            }
            break;
        case Soup::guardBand:
            for (ClipVertex& p : t)
                if (random.chance(0.6)) {
                    const double size_px = powerOfTwo(random.integer(6, 24));
                    const double x = random.uniform(-size_px, size_px);
                    const double y = random.uniform(-size_px, size_px);
                    const double w = random.uniform(0.5, 2);
                    p = vertexAt(v, x, y, w, random.uniform(0, 1));
                }
            break;
        case Soup::folded:
            t = sliver(random, v, powerOfTwo(-random.integer(4, 9)));
            for (ClipVertex& p : t) p.z = random.uniform(-1, 1) * p.w;
            break;
    }
    return t;
}

glm::vec3 narrow(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
// In the order that the reference bits were made with.
glm::dvec3 unit(const glm::dvec3& v) {
    const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return {v.x / length, v.y / length, v.z / length};
}

glm::dvec3 knotCentre(const KnotShape& shape, double turn) {
    const double a = 2.0 * kTurn_rad * turn, b = 3.0 * kTurn_rad * turn;
    const double radius_m = shape.radius_m + shape.swing_m * cosOf(b);
    return {radius_m * cosOf(a), shape.rise_m * sinOf(b), radius_m * sinOf(a)};
}

// Two triangles for each cell of a grid of columns x rows vertices that is closed in both directions or none.
void addGrid(SurfaceMesh& mesh, int columns, int rows, bool isClosed) {
    const int cellColumns = isClosed ? columns : columns - 1, cellRows = isClosed ? rows : rows - 1;
    for (int j = 0; j < cellRows; j++)
        for (int i = 0; i < cellColumns; i++) {
            const auto index = [&](int di, int dj) {
                return static_cast<uint32_t>((j + dj) % rows * columns + (i + di) % columns);
            };
            for (const uint32_t corner :
                 {index(0, 0), index(1, 0), index(1, 1), index(0, 0), index(1, 1), index(0, 1)})
                mesh.indices.push_back(corner);
        }
}

SurfaceInstance placed(uint32_t index, const glm::dvec3& position, double scale) {
    SurfaceInstance instance;
    instance.mesh = instance.material = index;
    for (int i = 0; i < 3; i++) {
        instance.toWorld[i][i] = scale;
        instance.toWorld[3][i] = position[i];
    }
    return instance;
}

}  // namespace

void DrawList::add(std::vector<ClipVertex> vertices, const DrawState& state) {
    std::vector<uint32_t> indices(vertices.size());
    std::iota(indices.begin(), indices.end(), 0u);
    add(std::move(vertices), std::move(indices), state);
}

void DrawList::add(std::vector<ClipVertex> vertices, std::vector<uint32_t> indices, const DrawState& state) {
    vertices_.push_back(std::move(vertices));
    indices_.push_back(std::move(indices));
    draws_.push_back({vertices_.back(), indices_.back(), state});
}

std::vector<ClipVertex> triangleSoup(Random& random, Soup family, int count, const Viewport& viewport) {
    std::vector<ClipVertex> vertices;
    for (int i = 0; i < count; i++)
        for (const ClipVertex& p : soupTriangle(random, family, viewport)) vertices.push_back(p);
    return vertices;
}

SurfaceMesh torusKnotMesh(int along, int around, const KnotShape& shape) {
    constexpr double kStep = 1.0 / 4096;
    SurfaceMesh mesh;
    for (int j = 0; j < around; j++)
        for (int i = 0; i < along; i++) {
            const double turn = static_cast<double>(i) / along;
            const glm::dvec3 centre = knotCentre(shape, turn), next = knotCentre(shape, turn + kStep);
            const glm::dvec3 tangent = unit({next.x - centre.x, next.y - centre.y, next.z - centre.z});
            const glm::dvec3 side = unit(crossOf(tangent, {0.1, 1, 0.2})), up = crossOf(side, tangent);
            const double angle_rad = kTurn_rad * j / around, c = cosOf(angle_rad), s = sinOf(angle_rad);
            const double radius_m =
                shape.tube_m + shape.ripple_m * sinOf(9.0 * angle_rad + 30.0 * kTurn_rad * turn);
            glm::dvec3 normal, position;
            for (int k = 0; k < 3; k++) {
                normal[k] = c * side[k] + s * up[k];
                position[k] = centre[k] + radius_m * normal[k];
            }
            mesh.positions.push_back(narrow(position));
            mesh.normals.push_back(narrow(normal));
        }
    addGrid(mesh, along, around, true);
    return mesh;
}

SurfaceMesh sphereMesh(int columns, int rows) {
    SurfaceMesh mesh;
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            const double longitude_rad = kTurn_rad * i / (columns - 1),
                         latitude_rad = kTurn_rad * (0.5 * j / (rows - 1) - 0.25);
            const double c = cosOf(latitude_rad);
            const glm::dvec3 p(c * sinOf(longitude_rad), sinOf(latitude_rad), c * cosOf(longitude_rad));
            mesh.positions.push_back(narrow(p));
            mesh.normals.push_back(narrow(p));
        }
    addGrid(mesh, columns, rows, false);
    return mesh;
}

SurfaceMesh groundMesh(float halfSize) {
    SurfaceMesh mesh;
    for (const auto& [x, z] :
         {std::pair(-1.0f, 1.0f), std::pair(1.0f, 1.0f), std::pair(-1.0f, -1.0f), std::pair(1.0f, -1.0f)}) {
        mesh.positions.emplace_back(x * halfSize, 0.0f, z * halfSize);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.uv_m.emplace_back(x * halfSize, z * halfSize);
    }
    mesh.indices = {0, 1, 2, 2, 1, 3};
    return mesh;
}

Image<float> skyImage(int width, int height) {
    constexpr double kSunRadiance = 4096, kSunSharpness = 512;
    const glm::dvec3 toSun = unit({0.4, 0.6, 0.7});
    const LatLongGrid grid(width, height);
    Random random(1);
    Image<float> image(width, height, 3);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const glm::dvec3 d = grid.direction(x, y);
            const double towardsSun = d.x * toSun.x + d.y * toSun.y + d.z * toSun.z;
            const double sun = kSunRadiance * powOf(towardsSun > 0 ? towardsSun : 0.0, kSunSharpness);
            const double grain = random.uniform(0.9, 1.1);
            const double up = d.y > 0 ? d.y : 0, down = d.y < 0 ? -d.y : 0;
            const std::array<double, 3> radiance = {0.3 + 0.2 * up + 0.1 * down,
                                                    0.35 + 0.4 * up + 0.05 * down, 0.4 + 0.9 * up};
            for (int c = 0; c < 3; c++)
                image.at(x, y, c) = static_cast<float>(radiance[static_cast<size_t>(c)] * grain + sun);
        }
    return image;
}

SurfaceScene demoScene() {
    SurfaceScene scene;
    scene.meshes = {torusKnotMesh(96, 12), sphereMesh(25, 13), sphereMesh(17, 9), groundMesh(4)};
    SurfaceMaterial lacquer, mirror, ground;
    lacquer.kind = MaterialKind::blinnPhong;
    lacquer.diffuse = {0.6, 0.15, 0.1};
    lacquer.specular = {0.3, 0.3, 0.35};
    lacquer.exponent = 37.5;
    mirror.kind = MaterialKind::mirror;
    mirror.reflectance = {0.9, 0.85, 0.8};
    ground.diffuse = {0.7, 0.7, 0.65};
    ground.checker = true;
    ground.diffuse2 = {0.1, 0.2, 0.3};
    ground.checkerSize_m = 0.37;
    scene.materials = {lacquer, mirror, mirror, ground};
    scene.instances = {placed(0, {0, 1.1, 0}, 1), placed(1, {1.7, 0.6, 0.9}, 0.6),
                       placed(2, {-1.8, 0.5, 1.1}, 0.5), placed(3, {0, 0, 0}, 1)};
    scene.instances[0].twoSided = false;
    scene.instances[1].reflection = Reflection::scene;
    scene.instances[1].cubeSize = 32;
    scene.instances[1].cubeCentre_m = {1.7, 0.6, 0.9};
    scene.lights = {{unit({0.4, 0.6, 0.7}), {2.5, 2.4, 2.0}},
                    {unit({-0.8, 0.5, 0.1}), {0.3, 0.4, 0.9}},
                    {unit({0.1, 0.2, -0.9}), {0.5, 0.1, 0.1}}};
    scene.ambient = {0.05, 0.06, 0.08};
    scene.environment.latLong = skyImage(64, 32);
    scene.environment.cosRotation = 0.8;
    scene.environment.sinRotation = 0.6;
    return scene;
}

View demoView(int width, int height) {
    PinholeCamera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 1.1 * height;
    camera.cx = 0.5 * width;
    camera.cy = 0.53 * height;
    camera.position = {0.6, 2.2, 4.6};
    camera.backward = unit({0.15, 0.35, 1});
    camera.right = unit(crossOf({0, 1, 0}, camera.backward));
    camera.up = crossOf(camera.backward, camera.right);
    return cameraView(camera);
}

}  // namespace etalon
