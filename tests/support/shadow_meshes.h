// Meshes that cast shadows in tests.
#pragma once

#include <cmath>
#include <vector>

#include "shadows/visibility_oracle.h"
#include "tests/support/box_scene.h"

namespace etalon::test {

// Two triangles for each cell of a grid of columns x rows vertices that is closed in both directions.
inline void addClosedGrid(SurfaceMesh& mesh, int columns, int rows) {
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            const auto index = [&](int di, int dj) {
                return static_cast<uint32_t>((j + dj) % rows * columns + (i + di) % columns);
            };
            for (const uint32_t corner :
                 {index(0, 0), index(0, 1), index(1, 1), index(0, 0), index(1, 1), index(1, 0)})
                mesh.indices.push_back(corner);
        }
}

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

// A closed (2, 3) torus knot of radius 1 around the origin, of 2 x along x around triangles.
inline SurfaceMesh torusKnot(int along, int around) {
    SurfaceMesh mesh;
    const double turn = 2 * 3.14159265358979323846;
    const auto centre = [&](double t) {
        const double r = 1 + 0.4 * std::cos(3 * turn * t);
        return glm::dvec3(r * std::cos(2 * turn * t), 0.4 * std::sin(3 * turn * t),
                          r * std::sin(2 * turn * t));
    };
    for (int j = 0; j < along; j++) {
        const glm::dvec3 here = centre(static_cast<double>(j) / along),
                         next = centre((j + 0.01) / along) - here;
        const double length = std::sqrt(next.x * next.x + next.y * next.y + next.z * next.z);
        const glm::dvec3 t = next / length;
        // Two directions across.
        glm::dvec3 u(t.z, 0, -t.x);
        u = u / std::sqrt(u.x * u.x + u.z * u.z);
        const glm::dvec3 v(t.y * u.z - t.z * u.y, t.z * u.x - t.x * u.z, t.x * u.y - t.y * u.x);
        for (int i = 0; i < around; i++) {
            const double a = turn * i / around;
            const glm::dvec3 n = std::cos(a) * u + std::sin(a) * v;
            mesh.normals.emplace_back(n);
            mesh.positions.emplace_back(here + 0.2 * n);
        }
    }
    addClosedGrid(mesh, around, along);
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
