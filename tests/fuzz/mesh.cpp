// A mesh file (PLY when it begins as one, else OBJ): refused with one line, or what is loaded is what
// files/mesh.h promises, twice the same.
#include <bit>
#include <cmath>

#include "files/mesh.h"
#include "tests/fuzz/fuzz.h"

using namespace etalon;

namespace {

// As in tests/files/mesh_test.cpp: files/mesh.h promises unit length to within 1e-7, and its square has twice that
// error.
constexpr double kSquareTolerance = 2.1e-7;

bool isPosition(float c) { return std::isfinite(c) && std::bit_cast<uint32_t>(c) != 0x80000000u; }

void checkMesh(const Mesh& mesh) {
    FUZZ_CHECK(!mesh.indices.empty() && mesh.indices.size() % 3 == 0);
    FUZZ_CHECK(mesh.normals.size() == mesh.positions.size());
    for (const uint32_t index : mesh.indices) FUZZ_CHECK(index < mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        FUZZ_CHECK(isPosition(p.x) && isPosition(p.y) && isPosition(p.z));
    for (const glm::vec3& n : mesh.normals) {
        const double square = double{n.x} * n.x + double{n.y} * n.y + double{n.z} * n.z;
        FUZZ_CHECK(std::fabs(square - 1) <= kSquareTolerance);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const test::ScratchFolder folder;
    const std::string_view bytes = fuzz::textOf(data, size);
    const std::filesystem::path file = folder / (bytes.starts_with("ply") ? "a.ply" : "a.obj");
    fuzz::writeFile(file, bytes);
    LoadedMesh first;
    if (!fuzz::isAccepted(file, [&] { first = loadMesh(file); })) return 0;
    checkMesh(first.mesh);
    const LoadedMesh second = loadMesh(file);
    FUZZ_CHECK(first.mesh.positions == second.mesh.positions && first.mesh.normals == second.mesh.normals &&
               first.mesh.indices == second.mesh.indices);
    return 0;
}
