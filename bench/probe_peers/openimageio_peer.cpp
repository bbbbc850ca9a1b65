#include <ImathVec.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "bench/probe_peers/probe_peers.h"
#include "probes/texel_grid.h"

namespace etalon::bench {
namespace {

// A tiled file without smaller levels, removed with the object.
class EnvironmentFile {
  public:
    explicit EnvironmentFile(const Image<float>& image)
        : path_(
              (std::filesystem::temp_directory_path() / ("etalon_bench_" + std::to_string(getpid()) + ".exr"))
                  .string()) {
        std::vector<float> texels;
        for (int y = 0; y < image.height(); y++)
            for (int x = 0; x < image.width(); x++)
                for (int c = 0; c < 3; c++) texels.push_back(image.at(x, y, c));
        OIIO::ImageSpec spec(image.width(), image.height(), 3, OIIO::TypeFloat);
        spec.tile_width = spec.tile_height = 64;
        spec.attribute("textureformat", "LatLong Environment");
        spec.attribute("compression", "none");
        const auto file = OIIO::ImageOutput::create(path_);
        if (!file || !file->open(path_, spec) || !file->write_image(OIIO::TypeFloat, texels.data()) ||
            !file->close())
            throw std::runtime_error("OpenImageIO did not write " + path_);
    }
    EnvironmentFile(const EnvironmentFile&) = delete;
    EnvironmentFile& operator=(const EnvironmentFile&) = delete;
    ~EnvironmentFile() { std::filesystem::remove(path_); }

    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace

CubeMaker openImageIoCubes(const Probe& latLong) {
    constexpr float kCache_MB = 4096;
    const auto file = std::make_shared<EnvironmentFile>(latLong.radiance[0]);
    const std::shared_ptr<OIIO::TextureSystem> textures(
        OIIO::TextureSystem::create(false), [](OIIO::TextureSystem* t) { OIIO::TextureSystem::destroy(t); });
    textures->attribute("max_memory_MB", kCache_MB);
    return [file, textures](Probe& result) {
        OIIO::TextureOpt options;
        options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
        options.interpmode = OIIO::TextureOpt::InterpBilinear;
        auto* handle = textures->get_texture_handle(OIIO::ustring(file->path()));
        auto* thread = textures->get_perthread_info();
        const Imath::V3f zero(0, 0, 0);
        const int size = result.shape.width;
        for (int layer = 0; layer < result.shape.layers(); layer++) {
            Image<float>& face = result.radiance[static_cast<size_t>(layer)];
            for (int y = 0; y < size; y++)
                for (int x = 0; x < size; x++) {
                    const float s = (2.0f * static_cast<float>(x) + 1) / static_cast<float>(size) - 1;
                    const float t = (2.0f * static_cast<float>(y) + 1) / static_cast<float>(size) - 1;
                    const Imath::V3f directions[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                                     {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
                    float rgb[3];
                    if (!textures->environment(handle, thread, options, directions[layer], zero, zero, 3,
                                               rgb))
                        throw std::runtime_error("OpenImageIO: " + textures->geterror());
                    for (int c = 0; c < 3; c++) face.at(x, y, c) = rgb[c];
                }
        }
    };
}

}  // namespace etalon::bench
