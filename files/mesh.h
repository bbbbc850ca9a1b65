// Triangle meshes, and reading their files: OBJ, PLY, glTF 2.0 (.gltf, .glb), through assimp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace etalon {

// An indexed triangle list in object space, metres. normals[i] belongs to positions[i] and has unit length
// (to within 1e-7). indices: three per triangle, counter-clockwise seen from the front, each below
// positions.size(). All numbers are finite; -0 does not occur in positions.
struct Mesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<uint32_t> indices;

    size_t triangleCount() const { return indices.size() / 3; }
};

// What is odd about a mesh that was read but does not stop it from being drawn.
struct MeshReport {
    size_t zeroAreaTriangles = 0;  // draw nothing
    size_t skippedPrimitives = 0;  // points and lines of the file, left out
    size_t computedNormals = 0;    // vertices without a usable normal in the file
    size_t undefinedNormals = 0;   // of these: on zero-area triangles only, or on none; set to +Y
};

struct LoadedMesh {
    Mesh mesh;
    MeshReport report;
};

// Reads all meshes of a file into one, in the order of the file's nodes, with the node transforms applied
// (glTF). Polygons become triangles; vertices are not merged. Normals of the file are kept and made unit; a
// vertex whose normal is missing, zero or not finite gets a smooth one (fillSmoothNormals). A node transform
// that mirrors turns the winding round, so that fronts stay fronts.
// referencedAt: "file:line" of the scene that names the mesh, put in front of messages; may be empty.
// InputError: missing, unreadable or truncated file, unknown extension, no triangles, vertices that are not
// finite (counted), an index out of range, more memory needed than the machine has left.
// One file is read at a time (the library's log is global); concurrent calls wait.
LoadedMesh loadMesh(const std::filesystem::path& path, const std::string& referencedAt = "");

// One line for each count that is worth telling (computed normals are not).
std::vector<std::string> meshWarnings(const std::filesystem::path& path, const MeshReport& report);

// Fills the normals of the vertices for which missing[i] != 0 (missing.size() == positions.size()); the
// others stay. A normal is the sum of the cross products (twice the area times the normal) of all triangles
// that touch a vertex at exactly the same position, added in double in the order of the triangles, made a
// unit vector. A position that only zero-area triangles touch, or none, gets +Y. Returns how many of the
// filled normals are such +Y. Positions must be finite, indices valid.
size_t fillSmoothNormals(Mesh& mesh, const std::vector<uint8_t>& missing);

// Triangles whose area is exactly zero: two corners at one place, or three on a line. Computed in double.
size_t countZeroAreaTriangles(const Mesh& mesh);

}  // namespace etalon
