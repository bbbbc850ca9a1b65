#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "files/mesh.h"
#include "files/ply_check.h"
#include "numeric/check.h"
#include "numeric/text.h"
#include "numeric/transform.h"
#include "tests/support/scratch_folder.h"

namespace etalon {
namespace {

using test::ScratchFolder;

// Unit normals and the rounding to float: three components, each off by half a unit in the last place.
constexpr double kUnitTolerance = 1e-7;

using Triangle = std::array<uint16_t, 3>;
const std::vector<glm::vec3> kCubeVertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Triangle> kCubeTriangles{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                           {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

std::string cubeObj() {
    std::string text;
    for (const glm::vec3& v : kCubeVertices) text += formatText("v {} {} {}\n", v.x, v.y, v.z);
    for (const Triangle& t : kCubeTriangles) text += formatText("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return text;
}

std::string plyHeader(const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string cubePlyAscii() {
    std::string text = plyHeader("ascii");
    for (const glm::vec3& v : kCubeVertices) text += formatText("{} {} {}\n", v.x, v.y, v.z);
    for (const Triangle& t : kCubeTriangles) text += formatText("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
}

template <class T>
void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

std::string cubePlyBinary() {
    std::string bytes = plyHeader("binary_little_endian");
    for (const glm::vec3& v : kCubeVertices)
        for (int i = 0; i < 3; i++) append(bytes, v[i]);
    for (const Triangle& t : kCubeTriangles) {
        append(bytes, uint8_t{3});
        for (const uint16_t index : t) append(bytes, int32_t{index});
    }
    return bytes;
}

// The binary data of the glTF cube: indices (36 uint16), then positions. They go into a file beside it.
std::string cubeGltfData(uint16_t lastIndex = kCubeTriangles.back()[2]) {
    std::string bytes;
    for (const Triangle& t : kCubeTriangles)
        for (const uint16_t index : t) append(bytes, index);
    std::memcpy(bytes.data() + bytes.size() - sizeof(lastIndex), &lastIndex, sizeof(lastIndex));
    for (const glm::vec3& v : kCubeVertices)
        for (int i = 0; i < 3; i++) append(bytes, v[i]);
    return bytes;
}

// nodes: the glTF nodes, of which number 0 is the root.
std::string cubeGltf(const std::string& nodes = R"([{"mesh":0}])", int indexCount = 36) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":1},"indices":0}]}],
"buffers":[{"byteLength":168,"uri":"cube.bin"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":96}],
"accessors":[{"bufferView":0,"componentType":5123,"count":)" +
           std::to_string(indexCount) + R"(,"type":"SCALAR"},
{"bufferView":1,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}]})";
}

struct MeshFolder {
    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }
    LoadedMesh load(const std::string& name, const std::string& bytes) const {
        return loadMesh(write(name, bytes));
    }
    std::string errorOf(const std::string& name, const std::string& bytes) const {
        try {
            loadMesh(write(name, bytes), "scene.toml:12");
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    }
    ScratchFolder folder;
};

// The corners of all triangles in order, without the file's way of sharing vertices.
std::vector<glm::vec3> corners(const Mesh& mesh, const std::vector<glm::vec3>& values) {
    std::vector<glm::vec3> result;
    for (const uint32_t index : mesh.indices) result.push_back(values[index]);
    return result;
}

std::vector<glm::vec3> cubeCorners() {
    std::vector<glm::vec3> result;
    for (const Triangle& t : kCubeTriangles)
        for (const uint16_t index : t) result.push_back(kCubeVertices[index]);
    return result;
}

bool faceOutward(const Mesh& mesh) {
    for (size_t t = 0; t < mesh.triangleCount(); t++) {
        const glm::dvec3 a(mesh.positions[mesh.indices[3 * t]]), b(mesh.positions[mesh.indices[3 * t + 1]]),
            c(mesh.positions[mesh.indices[3 * t + 2]]);
        const glm::dvec3 area = crossOf(b - a, c - a);
        for (size_t k = 0; k < 3; k++)
            if (!(dotOf(area, glm::dvec3(mesh.normals[mesh.indices[3 * t + k]])) > 0)) return false;
    }
    return true;
}

TEST_CASE("EachFormatLoadsTheSameCube") {
    const MeshFolder folder;
    folder.write("cube.bin", cubeGltfData());
    const std::vector<std::pair<std::string, std::string>> files{{"cube.obj", cubeObj()},
                                                                 {"ascii.ply", cubePlyAscii()},
                                                                 {"binary.PLY", cubePlyBinary()},
                                                                 {"cube.gltf", cubeGltf()}};
    const LoadedMesh first = folder.load(files[0].first, files[0].second);
    for (const auto& file : files) {
        const auto& [name, bytes] = file;
        CAPTURE(file.first);
        const LoadedMesh loaded = folder.load(name, bytes);
        CHECK(corners(loaded.mesh, loaded.mesh.positions) == cubeCorners());
        // Smooth normals are sums over equal positions, whether or not the file shares its vertices.
        CHECK(corners(loaded.mesh, loaded.mesh.normals) == corners(first.mesh, first.mesh.normals));
        CHECK(loaded.report.computedNormals == loaded.mesh.positions.size());
        CHECK(loaded.report.undefinedNormals == 0);
        CHECK(loaded.report.zeroAreaTriangles == 0);
        CHECK(faceOutward(loaded.mesh));
    }
}

TEST_CASE("SmoothNormalsAreWeightedByArea") {
    // A corner where a triangle of area 2 facing +Z meets one of area 1/2 facing +X: sums 4 and 1.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.indices = {0, 1, 2, 3, 4, 5};
    CHECK(fillSmoothNormals(mesh, std::vector<uint8_t>(6, 1)) == 0);
    const glm::vec3 expected(unitOf({1, 0, 4}));
    CHECK(mesh.normals[0] == expected);
    CHECK(mesh.normals[3] == expected);
    CHECK(mesh.normals[1] == glm::vec3(0, 0, 1));
    CHECK(mesh.normals[5] == glm::vec3(1, 0, 0));
}

TEST_CASE("NormalsOfTheFileAreKeptAndMadeUnit") {
    const MeshFolder folder;
    const LoadedMesh loaded = folder.load("n.obj",
                                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 0 3 4\nvn 0 0 0\n"
                                          "f 1//1 2//2 3//3\n");
    REQUIRE(loaded.mesh.normals.size() == 3);
    CHECK(loaded.mesh.normals[0] == glm::vec3(0, 0, 1));
    CHECK(loaded.mesh.normals[1] == glm::vec3(0.0f, 0.6f, 0.8f));
    // The zero normal is replaced by the triangle's.
    CHECK(loaded.mesh.normals[2] == glm::vec3(0, 0, 1));
    CHECK(loaded.report.computedNormals == 1);
}

TEST_CASE("PolygonsBecomeTrianglesAndOtherPrimitivesAreCounted") {
    const MeshFolder folder;
    const LoadedMesh loaded =
        folder.load("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\np 3\n");
    CHECK(loaded.mesh.triangleCount() == 2);
    CHECK(loaded.report.skippedPrimitives == 2);
    CHECK(meshWarnings("m.obj", loaded.report).size() == 1);
    CHECK(faceOutward(loaded.mesh));
}

TEST_CASE("ZeroAreaTrianglesAreCountedNotDropped") {
    const MeshFolder folder;
    const LoadedMesh loaded = folder.load(
        "z.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 4\nf 1 2 3\nf 1 1 2\nf 5 5 5\n");
    CHECK(loaded.mesh.triangleCount() == 4);
    CHECK(loaded.report.zeroAreaTriangles == 3);
    // Of the nine corners of the three degenerate triangles, one at (2, 0, 0) and three at (5, 5, 5) touch no
    // area.
    CHECK(loaded.report.undefinedNormals == 4);
    CHECK(loaded.mesh.normals.back() == glm::vec3(0, 1, 0));
    CHECK(meshWarnings("z.obj", loaded.report).size() == 2);
}

TEST_CASE("NodeTransformsOfGltfAreApplied") {
    const MeshFolder folder;
    folder.write("cube.bin", cubeGltfData());
    // Parent: moved by (10, 0, 0); children: one mirrored in x and doubled, one moved by (0, 5, 0).
    const LoadedMesh loaded = folder.load(
        "t.gltf",
        cubeGltf(
            R"([{"children":[1,2],"translation":[10,0,0]},{"mesh":0,"scale":[-2,2,2]},{"mesh":0,"translation":[0,5,0]}])"));
    REQUIRE(loaded.mesh.triangleCount() == 24);
    for (size_t i = 0; i < 8; i++) {
        const glm::vec3 v = kCubeVertices[i];
        CHECK(loaded.mesh.positions[i] == glm::vec3(10 - 2 * v.x, 2 * v.y, 2 * v.z));
        CHECK(loaded.mesh.positions[8 + i] == glm::vec3(10 + v.x, 5 + v.y, v.z));
    }
    CHECK(faceOutward(loaded.mesh));
    // The mirrored copy is wound the other way in the file's order of vertices.
    CHECK(loaded.mesh.indices[1] == kCubeTriangles[0][2]);
    CHECK(loaded.mesh.indices[37] == 8u + kCubeTriangles[0][1]);
}

TEST_CASE("BadMeshFilesAreInputErrors") {
    const MeshFolder folder;
    folder.write("cube.bin", cubeGltfData(9));
    const std::string obj = cubeObj(), ascii = cubePlyAscii(), binary = cubePlyBinary(), gltf = cubeGltf();
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    struct Bad {
        std::string name, bytes, words;
    };
    const std::vector<Bad> table{
        {"empty.obj", "", "is empty"},
        {"junk.obj", "hello world, this is no mesh\n", "has no triangles"},
        {"points.obj", obj.substr(0, obj.find('f')), "has no triangles"},
        {"range.obj", obj + "f 1 2 99\n", "index out of range"},
        {"zero.obj", obj + "f 0 1 2\n", "index"},
        {"nan.obj", replaced(obj, "v 1 0 0", "v nan 0 0"), "4 of 36 vertices are not finite"},
        {"huge.obj", replaced(obj, "v 1 0 0", "v 1e99 0 0"), "not finite"},
        {"mesh.stl", obj, ".obj, .ply, .gltf or .glb"},
        {"mesh", obj, ".obj, .ply, .gltf or .glb"},
        {"magic.ply", "plx\n" + ascii, "does not begin with 'ply'"},
        {"header.ply", binary.substr(0, binary.find("end_header")), "header is cut off"},
        {"half.ply", binary.substr(0, binary.size() - 20), "is cut off: 12 'face' elements"},
        {"vertices.ply", binary.substr(0, plyHeader("binary_little_endian").size() + 20),
         "8 'vertex' elements"},
        {"half_ascii.ply", ascii.substr(0, ascii.size() - 16), "is cut off"},
        {"corners.ply", replaced(ascii, "3 0 2 1", "0"), "face 0 has 0 corners"},
        {"lie.ply", replaced(binary, "vertex 8", "vertex 4000000000"), "is cut off"},
        {"range.ply", replaced(ascii, "3 0 2 1", "3 0 2 8"), "out of range: there are 8 vertices"},
        {"negative.ply", replaced(ascii, "3 0 2 1", "3 0 2 -1"), "index -1 of face 0 is out of range"},
        {"inf.ply", replaced(ascii, "\n1 0 0\n", "\ninf 0 0\n"), "1 of 8 vertices are not finite"},
        {"range.gltf", gltf, "index is out of range"},
        {"half.gltf", gltf.substr(0, gltf.size() / 2), "cannot be read as gltf"},
        {"count.gltf", cubeGltf(R"([{"mesh":0}])", 3000000), "cannot be read as gltf"},
        {"no_buffer.gltf", replaced(gltf, "cube.bin", "gone.bin"), "cannot be read as gltf"},
        {"no_mesh.gltf", cubeGltf(R"([{"name":"empty"}])"), "has no triangles"},
        {"half.glb", "glTF\2\0\0\0", "cannot be read as glb"},
    };
    for (const Bad& bad : table) {
        const std::string message = folder.errorOf(bad.name, bad.bytes);
        CAPTURE(bad.name);
        CAPTURE(message);
        CHECK(message.starts_with("scene.toml:12: " + (folder.folder / bad.name).string() + ": "));
        CHECK(message.find(bad.words) != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
    }
    CHECK_THROWS_AS(loadMesh(folder.folder / "gone.obj"), InputError);
    CHECK_THROWS_AS(loadMesh(folder.folder.path()), InputError);
}

TEST_CASE("EveryCutOfAPlyFileIsNoticed") {
    for (const std::string& whole : {cubePlyAscii(), cubePlyBinary()}) {
        CHECK(plyDefect(whole).empty());
        // The last newline of an ascii file may be missing; one digit of its last number may not be told.
        const size_t enough = whole.find("ascii") == std::string::npos ? whole.size() : whole.size() - 1;
        for (size_t size = 0; size < enough; size++) {
            CAPTURE(size);
            CHECK(!plyDefect(std::string_view(whole).substr(0, size)).empty());
        }
    }
}

TEST_CASE("AMeshThatNeedsMoreMemoryThanThereIsSaysSo") {
    const MeshFolder folder;
    const std::filesystem::path path = folder.write("big.obj", "v 0 0 0\n");
    // A sparse file of 4 TiB; skipped where the file system does not allow one.
    std::error_code error;
    std::filesystem::resize_file(path, uintmax_t{1} << 42, error);
    if (error) return;
    CHECK_THROWS_WITH_AS(loadMesh(path), doctest::Contains("GiB of memory"), InputError);
}

TEST_CASE("ShippedMeshesAreWholeAndFaceOutward") {
    struct Shipped {
        std::string name;
        size_t triangles, zeroArea, computedNormals;
    };
    for (const Shipped& shipped : {Shipped{"torus_knot.obj", 3000, 0, 0}, Shipped{"sphere.ply", 2208, 0, 0},
                                   Shipped{"cube.gltf", 12, 0, 0}, Shipped{"needles.obj", 192, 8, 576}}) {
        CAPTURE(shipped.name);
        const LoadedMesh loaded = loadMesh("scenes/meshes/" + shipped.name);
        CHECK(loaded.mesh.triangleCount() == shipped.triangles);
        CHECK(loaded.report.zeroAreaTriangles == shipped.zeroArea);
        CHECK(loaded.report.computedNormals == shipped.computedNormals);
        CHECK(loaded.report.skippedPrimitives == 0);
        for (const glm::vec3& normal : loaded.mesh.normals)
            CHECK(std::abs(lengthOf(glm::dvec3(normal)) - 1) < kUnitTolerance);
        if (shipped.zeroArea == 0) CHECK(faceOutward(loaded.mesh));
    }
}

}  // namespace
}  // namespace etalon
