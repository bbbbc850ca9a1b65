#include "files/mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/Logger.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <mutex>
#include <new>
#include <string_view>

#include "files/ply_check.h"
#include "numeric/check.h"
#include "numeric/text.h"
#include "numeric/transform.h"

namespace etalon {

namespace {

// Peak memory that loading takes for each byte of the file, by format: ratios measured with grids of 10
// million triangles, rounded up (docs/scene_format.md has the figures).
struct MeshFormat {
    std::string_view extension;
    double memoryPerByte;
};
constexpr MeshFormat kFormats[] = {{".obj", 6}, {".ply", 5}, {".gltf", 5}, {".glb", 5}};

// Collects what the library only logs: out-of-range indices of glTF files, whose faces it drops.
class WarningCollector : public Assimp::Logger {
  public:
    explicit WarningCollector(std::string& warnings) : warnings_(warnings) {}
    bool attachStream(Assimp::LogStream*, unsigned int) override { return false; }
    bool detachStream(Assimp::LogStream*, unsigned int) override { return false; }

  private:
    void OnDebug(const char*) override {}
    void OnVerboseDebug(const char*) override {}
    void OnInfo(const char*) override {}
    void OnWarn(const char* message) override { warnings_ += message; }
    void OnError(const char* message) override { warnings_ += message; }

    std::string& warnings_;
};

// Installs a collector as the library's log for one scope. The library owns and deletes it.
class LogScope {
  public:
    explicit LogScope(std::string& warnings) { Assimp::DefaultLogger::set(new WarningCollector(warnings)); }
    ~LogScope() { Assimp::DefaultLogger::set(nullptr); }
    LogScope(const LogScope&) = delete;
    LogScope& operator=(const LogScope&) = delete;
};

class MeshReader {
  public:
    MeshReader(const std::filesystem::path& path, const std::string& referencedAt)
        : path_(path), prefix_(referencedAt.empty() ? "" : referencedAt + ": ") {}

    LoadedMesh read() {
        checkFile();
        {
            static std::mutex mutex;
            const std::lock_guard lock(mutex);
            readScene();
        }
        if (loaded_.mesh.indices.empty()) fail("has no triangles");
        if (notFinite_ > 0)
            fail(formatText("{} of {} vertices are not finite", notFinite_, loaded_.mesh.positions.size()));
        MeshReport& report = loaded_.report;
        report.computedNormals =
            static_cast<size_t>(std::count(missingNormal_.begin(), missingNormal_.end(), uint8_t{1}));
        if (report.computedNormals > 0)
            report.undefinedNormals = fillSmoothNormals(loaded_.mesh, missingNormal_);
        report.zeroAreaTriangles = countZeroAreaTriangles(loaded_.mesh);
        return std::move(loaded_);
    }

    [[noreturn]] void fail(const std::string& reason) const {
        throw InputError(formatText("{}{}: {}", prefix_, path_.string(), reason));
    }

  private:
    // Everything that can be told before the library reads the file.
    void checkFile() const {
        std::error_code error;
        const std::filesystem::file_status status = std::filesystem::status(path_, error);
        if (!std::filesystem::exists(status)) fail("no such mesh file");
        if (!std::filesystem::is_regular_file(status)) fail("not a regular file");
        const std::string extension = lowerExtension();
        const auto* format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                          [&](const MeshFormat& f) { return f.extension == extension; });
        if (format == std::end(kFormats)) fail("a mesh file ends in .obj, .ply, .gltf or .glb");
        const uintmax_t bytes = std::filesystem::file_size(path_, error);
        if (error) fail("cannot be read");
        if (bytes == 0) fail("is empty");
        const double needed = static_cast<double>(bytes) * format->memoryPerByte;
        const double available = availableMemory();
        if (available > 0 && needed > available)
            fail(formatText("would need about {:.1f} GiB of memory to load; {:.1f} GiB are available",
                            needed / kGiB, available / kGiB));
        if (extension == ".ply") {
            std::ifstream stream(path_, std::ios::binary);
            if (!stream) fail("cannot be read");
            const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
            const std::string defect = plyDefect(text);
            if (!defect.empty()) fail(defect);
        }
    }

    std::string lowerExtension() const {
        std::string extension = path_.extension().string();
        for (char& c : extension)
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        return extension;
    }

    // Bytes that the system says can still be had; 0 where it does not say.
    static double availableMemory() {
        std::ifstream stream("/proc/meminfo");
        std::string key;
        double kibibytes = 0;
        while (stream >> key) {
            if (key == "MemAvailable:") return stream >> kibibytes ? kibibytes * 1024 : 0;
            stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
        }
        return 0;
    }

    void readScene() {
        std::string warnings;
        const LogScope log(warnings);
        Assimp::Importer importer;
        const aiScene* scene = importer.ReadFile(path_.string(), aiProcess_Triangulate);
        if (scene == nullptr) {
            std::string reason = importer.GetErrorString();
            if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
            std::replace(reason.begin(), reason.end(), '\n', ' ');
            fail(formatText("cannot be read as {}: {}", lowerExtension().substr(1), reason));
        }
        if (warnings.find("out-of-range indices") != std::string::npos) fail("an index is out of range");
        // Depth first, children in the order of the file.
        std::vector<std::pair<const aiNode*, glm::dmat4>> stack;
        if (scene->mRootNode != nullptr) stack.emplace_back(scene->mRootNode, glm::dmat4(1.0));
        while (!stack.empty()) {
            const auto [node, parentToFile] = stack.back();
            stack.pop_back();
            const glm::dmat4 toFile = multiplied(parentToFile, matrixOf(node->mTransformation));
            for (unsigned i = 0; i < node->mNumMeshes; i++)
                addMesh(*scene->mMeshes[node->mMeshes[i]], toFile);
            for (unsigned i = node->mNumChildren; i > 0; i--)
                stack.emplace_back(node->mChildren[i - 1], toFile);
        }
    }

    // The library's matrices are row-major floats.
    static glm::dmat4 matrixOf(const aiMatrix4x4& m) {
        return {glm::dvec4(m.a1, m.b1, m.c1, m.d1), glm::dvec4(m.a2, m.b2, m.c2, m.d2),
                glm::dvec4(m.a3, m.b3, m.c3, m.d3), glm::dvec4(m.a4, m.b4, m.c4, m.d4)};
    }

    void addMesh(const aiMesh& from, const glm::dmat4& toFile) {
        Mesh& to = loaded_.mesh;
        const size_t first = to.positions.size();
        if (first + from.mNumVertices > UINT32_MAX) fail("has more than 2^32 vertices");
        to.positions.reserve(first + from.mNumVertices);
        to.normals.reserve(first + from.mNumVertices);
        for (unsigned i = 0; i < from.mNumVertices; i++) addVertex(from, i, toFile);
        const bool mirrored = determinant3(toFile) < 0;
        to.indices.reserve(to.indices.size() + 3 * size_t{from.mNumFaces});
        for (unsigned i = 0; i < from.mNumFaces; i++) {
            const aiFace& face = from.mFaces[i];
            if (face.mNumIndices != 3) {
                loaded_.report.skippedPrimitives++;
                continue;
            }
            for (const unsigned corner : {0u, mirrored ? 2u : 1u, mirrored ? 1u : 2u}) {
                const unsigned index = face.mIndices[corner];
                if (index >= from.mNumVertices)
                    fail(formatText("index {} of face {} is out of range: there are {} vertices",
                                    static_cast<int32_t>(index), i, from.mNumVertices));
                to.indices.push_back(static_cast<uint32_t>(first + index));
            }
        }
    }

    void addVertex(const aiMesh& from, unsigned i, const glm::dmat4& toFile) {
        const aiVector3D& p = from.mVertices[i];
        // Adding +0 turns -0 into +0, so that equal positions have equal bits.
        const glm::vec3 position = glm::vec3(transformPoint(toFile, {p.x, p.y, p.z})) + glm::vec3(0.0f);
        const bool finite =
            std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
        if (!finite) notFinite_++;
        loaded_.mesh.positions.push_back(position);

        glm::dvec3 normal{0.0};
        if (from.mNormals != nullptr) {
            const aiVector3D& n = from.mNormals[i];
            normal = unitOf(transformNormal(toFile, {n.x, n.y, n.z}));
        }
        // Zero and NaN fail; so does a normal that was infinite (infinity / infinity).
        const bool usable = dotOf(normal, normal) > 0.5;
        loaded_.mesh.normals.push_back(usable ? glm::vec3(normal) : glm::vec3(0.0f));
        missingNormal_.push_back(usable ? 0 : 1);
    }

    static constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;

    const std::filesystem::path& path_;
    std::string prefix_;
    LoadedMesh loaded_;
    std::vector<uint8_t> missingNormal_;
    size_t notFinite_ = 0;
};

}  // namespace

LoadedMesh loadMesh(const std::filesystem::path& path, const std::string& referencedAt) {
    MeshReader reader(path, referencedAt);
    try {
        return reader.read();
    } catch (const std::bad_alloc&) {
        reader.fail("there is not enough memory to load it");
    }
}

std::vector<std::string> meshWarnings(const std::filesystem::path& path, const MeshReport& report) {
    std::vector<std::string> warnings;
    const auto add = [&](size_t count, const char* what) {
        if (count > 0) warnings.push_back(formatText("{}: {} {}", path.string(), count, what));
    };
    add(report.zeroAreaTriangles, "triangles of zero area draw nothing");
    add(report.skippedPrimitives, "points and lines are left out");
    add(report.undefinedNormals, "vertices have no defined normal and get +Y");
    return warnings;
}

}  // namespace etalon
