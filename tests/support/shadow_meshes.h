// Meshes that cast shadows in tests; the knot is torusKnotMesh() of bitcheck/inputs.h.
#pragma once

#include <cmath>
#include <vector>

#include "shadows/visibility_oracle.h"
#include "tests/support/box_scene.h"

namespace etalon::test {

// A closed sphere with `columns` meridians and `rows` bands, seen counter-clockwise from outside.
inline SurfaceMesh sphere(int columns, int rows, glm::vec3 centre, float radius) {
    SurfaceMesh mesh;
    const auto add = [&](double x, double y, double z) {
        const glm::vec3 n(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        mesh.positions.push_back(centre + radius * n);
        mesh.normals.push_back(n);
    };
    const double pi = 3.14159265358979323846;
    add(0, 1, 0);
    for (int j = 1; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            const double polar = pi * j / rows, azimuth = 2 * pi * i / columns;
            add(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
        }
    add(0, -1, 0);
    const auto last = static_cast<uint32_t>(mesh.positions.size() - 1);
    const auto index = [&](int i, int j) {
        if (j == 0) return 0u;
        if (j == rows) return last;
        return static_cast<uint32_t>(1 + (j - 1) * columns + i % columns);
    };
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            if (j > 0)
                for (const uint32_t corner : {index(i, j), index(i, j + 1), index(i + 1, j)})
                    mesh.indices.push_back(corner);
            if (j + 1 < rows)
                for (const uint32_t corner : {index(i + 1, j), index(i, j + 1), index(i + 1, j + 1)})
                    mesh.indices.push_back(corner);
        }
    return mesh;
}

// A closed box seen counter-clockwise from outside.
inline SurfaceMesh solidBox(glm::vec3 centre, glm::vec3 halfSize) {
    SurfaceMesh mesh;
    for (int axis = 0; axis < 3; axis++)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 u(0), v(0), n(0);
            n[axis] = sign * halfSize[axis];
            u[(axis + 1) % 3] = sign * halfSize[(axis + 1) % 3];
            v[(axis + 2) % 3] = halfSize[(axis + 2) % 3];
            const SurfaceMesh face = rectangle(centre + n, u, v);
            const auto first = static_cast<uint32_t>(mesh.positions.size());
            mesh.positions.insert(mesh.positions.end(), face.positions.begin(), face.positions.end());
            mesh.normals.insert(mesh.normals.end(), face.normals.begin(), face.normals.end());
            for (const uint32_t i : face.indices) mesh.indices.push_back(first + i);
        }
    return mesh;
}

// The triangles of a mesh where it is, as instance 0.
inline std::vector<WorldTriangle> trianglesOf(const SurfaceMesh& mesh) {
    PlacedMesh placed;
    placed.mesh = &mesh;
    for (const glm::vec3& p : mesh.positions) placed.positions.emplace_back(p);
    return worldTriangles(std::span(&placed, 1));
}

}  // namespace etalon::test
