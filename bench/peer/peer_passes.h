// The passes of bench/passes.h on a Vulkan device, recorded once and run again and again. Pictures stay on
// the device; reading them back is not part of a run.
#pragma once

#include <memory>

#include "bench/passes.h"
#include "bench/peer/vulkan_pass.h"

namespace etalon::bench {

// Commands with the images that they draw to; those that a pass does not have are without a handle.
struct PeerPass {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    DeviceImage colour, depth;
};

class PeerPasses {
  public:
    explicit PeerPasses(VulkanDevice& device) : device_(device) {}

    // Depth alone; D32F. samples: 1 or 4.
    PeerPass depth(const Workload& w, int samples);
    // Depth and radiance with all lights of the scene; RGBA in 32-bit floats, alpha the distance from the
    // eye. samples: 1, or 4, resolved to one.
    PeerPass shaded(const Workload& w, int samples);
    // The six faces of cubeRequest(), an image pair each; `colour` and `depth` are those of the last face.
    PeerPass cube(const Workload& w);
    // Two passes over blurInput(); one channel.
    PeerPass blur();
    // latLongInput() to the six faces, one below the other; RGBA.
    PeerPass cubeFromLatLong();

  private:
    struct MeshBuffers {
        DeviceBuffer positions, normals, indices;
        uint32_t indexCount;
    };
    MeshBuffers upload(const SurfaceMesh& mesh);
    DeviceBuffer shadingUniforms(const SurfaceScene& scene);
    DeviceImage colourImage(int width, int height, int samples);
    DeviceImage depthImage(int width, int height, int samples);
    DeviceImage sampledImage(const Image<float>& image, VkFormat format, int channels);
    Pipeline shadedPipeline(const SurfaceScene& scene, bool frontIsClockwise, int samples);
    static void draw(VkCommandBuffer commands, const MeshBuffers& mesh, bool withNormals);

    VulkanDevice& device_;
};

}  // namespace etalon::bench
