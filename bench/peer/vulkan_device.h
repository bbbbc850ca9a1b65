// A Vulkan device without a window: what the peers' benchmarks need of it. Everything made through it lives
// as long as it does. Errors throw InputError: the driver is the user's choice.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etalon::bench {

// Throws InputError with the name of the call unless it succeeded.
void checkVulkan(VkResult result, const char* call);

struct DeviceBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    void* mapped = nullptr;
    VkDeviceSize bytes = 0;
};

// Always in the general layout.
struct DeviceImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    uint32_t width = 0, height = 0;
    VkImageAspectFlags aspect = 0;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

class VulkanDevice {
  public:
    // The first device of the loader, which VK_DRIVER_FILES or VK_ICD_FILENAMES restricts to one driver.
    VulkanDevice();
    ~VulkanDevice();
    VulkanDevice(const VulkanDevice&) = delete;
    VulkanDevice& operator=(const VulkanDevice&) = delete;

    const std::string& name() const { return name_; }
    VkDevice handle() const { return device_; }

    // A buffer for vertices, indices, uniforms and copies with these contents.
    DeviceBuffer makeBuffer(std::span<const std::byte> contents);
    // An image to draw to, sample from and copy.
    DeviceImage makeImage(VkFormat format, uint32_t width, uint32_t height, int samples = 1);
    // Fills an image with rows of texels in its format.
    void upload(const DeviceImage& image, std::span<const std::byte> texels);
    // The texels of an image of one sample and a format of 32-bit floats, `channels` each.
    std::vector<float> download(const DeviceImage& image, int channels);

    // Commands that can be run again and again.
    VkCommandBuffer record(const std::function<void(VkCommandBuffer)>& commands);
    // Runs them and waits for their end.
    void run(VkCommandBuffer commands);

    // Called in reverse order when the device ends.
    void atEnd(std::function<void()> release) { releases_.push_back(std::move(release)); }

  private:
    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties);

    std::string name_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    std::vector<std::function<void()>> releases_;
};

// Makes everything written so far visible to everything that follows.
void fullBarrier(VkCommandBuffer commands);

}  // namespace etalon::bench
