#include "bench/peer/vulkan_device.h"

#include <cstring>

#include "numeric/check.h"
#include "numeric/text.h"

namespace etalon::bench {
namespace {

// Queue family 0 of both software drivers draws and copies.
constexpr uint32_t kQueueFamily = 0;

bool isDepth(VkFormat format) { return format == VK_FORMAT_D32_SFLOAT; }

VkBufferImageCopy wholeImage(const DeviceImage& image) {
    VkBufferImageCopy copy{};
    copy.imageSubresource = {image.aspect, 0, 0, 1};
    copy.imageExtent = {image.width, image.height, 1};
    return copy;
}

}  // namespace

void checkVulkan(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw InputError(formatText("Vulkan: {} returned {}", call, static_cast<int>(result)));
}

VulkanDevice::VulkanDevice() {
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instanceInfo.pApplicationInfo = &application;
    checkVulkan(vkCreateInstance(&instanceInfo, nullptr, &instance_), "vkCreateInstance");
    atEnd([this] { vkDestroyInstance(instance_, nullptr); });

    uint32_t count = 1;
    const VkResult found = vkEnumeratePhysicalDevices(instance_, &count, &physical_);
    if (found < 0 || count == 0) throw InputError("Vulkan: no device");
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_, &properties);
    name_ = properties.deviceName;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);

    VkPhysicalDeviceVulkan13Features features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    features.dynamicRendering = VK_TRUE;
    const float priority = 1;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = kQueueFamily;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    deviceInfo.pNext = &features;
    deviceInfo.queueCreateInfoCount = 1;
    deviceInfo.pQueueCreateInfos = &queueInfo;
    checkVulkan(vkCreateDevice(physical_, &deviceInfo, nullptr, &device_), "vkCreateDevice");
    atEnd([this] { vkDestroyDevice(device_, nullptr); });
    vkGetDeviceQueue(device_, kQueueFamily, 0, &queue_);

    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.queueFamilyIndex = kQueueFamily;
    checkVulkan(vkCreateCommandPool(device_, &poolInfo, nullptr, &pool_), "vkCreateCommandPool");
    atEnd([this] { vkDestroyCommandPool(device_, pool_, nullptr); });
    VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    checkVulkan(vkCreateFence(device_, &fenceInfo, nullptr, &fence_), "vkCreateFence");
    atEnd([this] { vkDestroyFence(device_, fence_, nullptr); });
}

VulkanDevice::~VulkanDevice() {
    for (auto release = releases_.rbegin(); release != releases_.rend(); ++release) (*release)();
}

VkDeviceMemory VulkanDevice::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) {
    for (uint32_t type = 0; type < memory_.memoryTypeCount; type++) {
        if (!(needs.memoryTypeBits >> type & 1)) continue;
        if ((memory_.memoryTypes[type].propertyFlags & properties) != properties) continue;
        VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        info.allocationSize = needs.size;
        info.memoryTypeIndex = type;
        VkDeviceMemory memory;
        checkVulkan(vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
        atEnd([this, memory] { vkFreeMemory(device_, memory, nullptr); });
        return memory;
    }
    throw InputError("Vulkan: no suitable kind of memory");
}

DeviceBuffer VulkanDevice::makeBuffer(std::span<const std::byte> contents) {
    DeviceBuffer made;
    made.bytes = contents.size();
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = made.bytes;
    info.usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                 VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    checkVulkan(vkCreateBuffer(device_, &info, nullptr, &made.buffer), "vkCreateBuffer");
    atEnd([this, buffer = made.buffer] { vkDestroyBuffer(device_, buffer, nullptr); });
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device_, made.buffer, &needs);
    const VkDeviceMemory memory =
        allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    checkVulkan(vkBindBufferMemory(device_, made.buffer, memory, 0), "vkBindBufferMemory");
    checkVulkan(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
    std::memcpy(made.mapped, contents.data(), contents.size());
    return made;
}

DeviceImage VulkanDevice::makeImage(VkFormat format, uint32_t width, uint32_t height, int samples) {
    DeviceImage made;
    made.format = format;
    made.width = width;
    made.height = height;
    made.samples = static_cast<VkSampleCountFlagBits>(samples);
    made.aspect = isDepth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {width, height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = made.samples;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage =
        isDepth(format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (samples == 1)
        info.usage |=
            VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    checkVulkan(vkCreateImage(device_, &info, nullptr, &made.image), "vkCreateImage");
    atEnd([this, image = made.image] { vkDestroyImage(device_, image, nullptr); });
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device_, made.image, &needs);
    const VkDeviceMemory memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    checkVulkan(vkBindImageMemory(device_, made.image, memory, 0), "vkBindImageMemory");

    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = made.image;
    viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = format;
    viewInfo.subresourceRange = {made.aspect, 0, 1, 0, 1};
    checkVulkan(vkCreateImageView(device_, &viewInfo, nullptr, &made.view), "vkCreateImageView");
    atEnd([this, view = made.view] { vkDestroyImageView(device_, view, nullptr); });

    run(record([&](VkCommandBuffer commands) {
        VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
        barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = made.image;
        barrier.subresourceRange = viewInfo.subresourceRange;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                             0, 0, nullptr, 0, nullptr, 1, &barrier);
    }));
    return made;
}

void VulkanDevice::upload(const DeviceImage& image, std::span<const std::byte> texels) {
    const DeviceBuffer staging = makeBuffer(texels);
    run(record([&](VkCommandBuffer commands) {
        const VkBufferImageCopy copy = wholeImage(image);
        vkCmdCopyBufferToImage(commands, staging.buffer, image.image, VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
        fullBarrier(commands);
    }));
}

std::vector<float> VulkanDevice::download(const DeviceImage& image, int channels) {
    std::vector<float> values(size_t{image.width} * image.height * static_cast<size_t>(channels));
    const DeviceBuffer staging = makeBuffer(std::as_bytes(std::span(values)));
    run(record([&](VkCommandBuffer commands) {
        fullBarrier(commands);
        const VkBufferImageCopy copy = wholeImage(image);
        vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_GENERAL, staging.buffer, 1, &copy);
        fullBarrier(commands);
    }));
    std::memcpy(values.data(), staging.mapped, values.size() * sizeof(float));
    return values;
}

VkCommandBuffer VulkanDevice::record(const std::function<void(VkCommandBuffer)>& commands) {
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool_;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer buffer;
    checkVulkan(vkAllocateCommandBuffers(device_, &info, &buffer), "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    checkVulkan(vkBeginCommandBuffer(buffer, &begin), "vkBeginCommandBuffer");
    commands(buffer);
    checkVulkan(vkEndCommandBuffer(buffer), "vkEndCommandBuffer");
    return buffer;
}

void VulkanDevice::run(VkCommandBuffer commands) {
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    checkVulkan(vkQueueSubmit(queue_, 1, &submit, fence_), "vkQueueSubmit");
    checkVulkan(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    checkVulkan(vkResetFences(device_, 1, &fence_), "vkResetFences");
}

void fullBarrier(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    const VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT;
    vkCmdPipelineBarrier(commands, stages, stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace etalon::bench
