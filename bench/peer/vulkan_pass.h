// Drawing on a Vulkan device: a pipeline with what its shaders read, and a pass into images.
#pragma once

#include "bench/peer/vulkan_device.h"

namespace etalon::bench {

// Which buffers a pipeline reads vertices from.
enum class VertexInput { none, positions, positionsAndNormals };

struct PipelineDescription {
    std::span<const uint32_t> vertexShader, fragmentShader;  // SPIR-V; no fragment shader: depth alone
    std::vector<int32_t> constants;                          // of the fragment shader, by constant_id
    VertexInput input = VertexInput::none;
    VkFormat colour = VK_FORMAT_UNDEFINED;  // undefined: none
    bool depth = false;                     // tested and written, nearer passes
    bool frontIsClockwise = false;          // as seen on the screen
    int samples = 1;
    const DeviceBuffer* uniforms = nullptr;  // binding 0 of the fragment shader
    const DeviceImage* sampled = nullptr;    // binding 1, linear, clamped
};

struct Pipeline {
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;  // none if the shaders read neither buffer nor image
};

// Push constants of every pipeline: the columns of world -> clip, and the eye.
struct PushConstants {
    float worldToClip[16];
    float eye[4];
};

Pipeline makePipeline(VulkanDevice& device, const PipelineDescription& description);

// Where a pass draws; null: nothing. Images are cleared first, depth to 1. The resolved image receives the
// mean of the samples of the colour image.
struct PassTargets {
    const DeviceImage* colour = nullptr;
    const DeviceImage* depth = nullptr;
    const DeviceImage* resolved = nullptr;
};

// Begins a pass, binds the pipeline, runs `draw` and ends the pass.
void recordPass(VkCommandBuffer commands, const PassTargets& targets, const Pipeline& pipeline,
                const PushConstants& push, const std::function<void()>& draw);

}  // namespace etalon::bench
