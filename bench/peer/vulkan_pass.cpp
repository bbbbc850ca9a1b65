#include "bench/peer/vulkan_pass.h"

#include <array>

namespace etalon::bench {
namespace {

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkShaderModule makeShader(VulkanDevice& device, std::span<const uint32_t> spirv) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    VkShaderModule shader;
    checkVulkan(vkCreateShaderModule(device.handle(), &info, nullptr, &shader), "vkCreateShaderModule");
    device.atEnd([&device, shader] { vkDestroyShaderModule(device.handle(), shader, nullptr); });
    return shader;
}

VkSampler makeSampler(VulkanDevice& device) {
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler;
    checkVulkan(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    device.atEnd([&device, sampler] { vkDestroySampler(device.handle(), sampler, nullptr); });
    return sampler;
}

// One set with the bindings that the description has.
VkDescriptorSetLayout makeSet(VulkanDevice& device, const PipelineDescription& d, VkDescriptorSet& set) {
    VkDescriptorBufferInfo buffer{};
    VkDescriptorImageInfo image{};
    std::vector<VkWriteDescriptorSet> writes;
    const auto addWrite = [&](uint32_t binding, VkDescriptorType type) {
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstBinding = binding;
        write.descriptorCount = 1;
        write.descriptorType = type;
        write.pBufferInfo = &buffer;
        write.pImageInfo = &image;
        writes.push_back(write);
    };
    if (d.uniforms) {
        buffer = {d.uniforms->buffer, 0, VK_WHOLE_SIZE};
        addWrite(0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    }
    if (d.sampled) {
        image = {makeSampler(device), d.sampled->view, VK_IMAGE_LAYOUT_GENERAL};
        addWrite(1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    }

    std::vector<VkDescriptorSetLayoutBinding> bindings;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const VkWriteDescriptorSet& write : writes) {
        bindings.push_back(
            {write.dstBinding, write.descriptorType, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr});
        sizes.push_back({write.descriptorType, 1});
    }
    VkDescriptorSetLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    layoutInfo.bindingCount = static_cast<uint32_t>(bindings.size());
    layoutInfo.pBindings = bindings.data();
    VkDescriptorSetLayout layout;
    checkVulkan(vkCreateDescriptorSetLayout(device.handle(), &layoutInfo, nullptr, &layout),
                "vkCreateDescriptorSetLayout");
    device.atEnd([&device, layout] { vkDestroyDescriptorSetLayout(device.handle(), layout, nullptr); });
    if (writes.empty()) return layout;

    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = static_cast<uint32_t>(sizes.size());
    poolInfo.pPoolSizes = sizes.data();
    VkDescriptorPool pool;
    checkVulkan(vkCreateDescriptorPool(device.handle(), &poolInfo, nullptr, &pool), "vkCreateDescriptorPool");
    device.atEnd([&device, pool] { vkDestroyDescriptorPool(device.handle(), pool, nullptr); });
    VkDescriptorSetAllocateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    setInfo.descriptorPool = pool;
    setInfo.descriptorSetCount = 1;
    setInfo.pSetLayouts = &layout;
    checkVulkan(vkAllocateDescriptorSets(device.handle(), &setInfo, &set), "vkAllocateDescriptorSets");
    for (VkWriteDescriptorSet& write : writes) write.dstSet = set;
    vkUpdateDescriptorSets(device.handle(), static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
    return layout;
}

}  // namespace

Pipeline makePipeline(VulkanDevice& device, const PipelineDescription& d) {
    Pipeline made;
    const VkDescriptorSetLayout setLayout = makeSet(device, d, made.set);
    const VkPushConstantRange push{kStages, 0, sizeof(PushConstants)};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.setLayoutCount = 1;
    layoutInfo.pSetLayouts = &setLayout;
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &push;
    checkVulkan(vkCreatePipelineLayout(device.handle(), &layoutInfo, nullptr, &made.layout),
                "vkCreatePipelineLayout");
    device.atEnd(
        [&device, layout = made.layout] { vkDestroyPipelineLayout(device.handle(), layout, nullptr); });

    // Shaders and their constants.
    std::vector<VkSpecializationMapEntry> entries;
    for (uint32_t i = 0; i < d.constants.size(); i++)
        entries.push_back({i, static_cast<uint32_t>(i * sizeof(int32_t)), sizeof(int32_t)});
    const VkSpecializationInfo constants{static_cast<uint32_t>(entries.size()), entries.data(),
                                         d.constants.size() * sizeof(int32_t), d.constants.data()};
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    stages[0] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = makeShader(device, d.vertexShader);
    stages[0].pName = "main";
    uint32_t stageCount = 1;
    if (!d.fragmentShader.empty()) {
        stages[1] = stages[0];
        stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[1].module = makeShader(device, d.fragmentShader);
        stages[1].pSpecializationInfo = &constants;
        stageCount = 2;
    }

    // Positions in buffer 0, normals in buffer 1.
    constexpr uint32_t kVector_bytes = 3 * sizeof(float);
    const uint32_t inputs = static_cast<uint32_t>(d.input);
    std::array<VkVertexInputBindingDescription, 2> buffers;
    std::array<VkVertexInputAttributeDescription, 2> attributes;
    for (uint32_t i = 0; i < 2; i++) {
        buffers[i] = {i, kVector_bytes, VK_VERTEX_INPUT_RATE_VERTEX};
        attributes[i] = {i, i, VK_FORMAT_R32G32B32_SFLOAT, 0};
    }
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = input.vertexAttributeDescriptionCount = inputs;
    input.pVertexBindingDescriptions = buffers.data();
    input.pVertexAttributeDescriptions = attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;

    // Fixed function.
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.frontFace = d.frontIsClockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo multisample{
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(d.samples);
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = depth.depthWriteEnable = d.depth;
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    const bool hasColour = d.colour != VK_FORMAT_UNDEFINED;
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = hasColour;
    blend.pAttachments = &attachment;
    constexpr std::array kDynamic = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = kDynamic.size();
    dynamic.pDynamicStates = kDynamic.data();
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = hasColour;
    rendering.pColorAttachmentFormats = &d.colour;
    if (d.depth) rendering.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = stageCount;
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = made.layout;
    checkVulkan(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &made.pipeline),
                "vkCreateGraphicsPipelines");
    device.atEnd(
        [&device, pipeline = made.pipeline] { vkDestroyPipeline(device.handle(), pipeline, nullptr); });
    return made;
}

void recordPass(VkCommandBuffer commands, const PassTargets& targets, const Pipeline& pipeline,
                const PushConstants& push, const std::function<void()>& draw) {
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = colour;
    depth.clearValue.depthStencil.depth = 1;
    if (targets.colour) colour.imageView = targets.colour->view;
    if (targets.depth) depth.imageView = targets.depth->view;
    if (targets.resolved) {
        colour.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        colour.resolveImageView = targets.resolved->view;
        colour.resolveImageLayout = VK_IMAGE_LAYOUT_GENERAL;
    }
    const DeviceImage& any = targets.colour ? *targets.colour : *targets.depth;
    const VkRect2D area{{0, 0}, {any.width, any.height}};
    VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = area;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = targets.colour != nullptr;
    rendering.pColorAttachments = &colour;
    if (targets.depth) rendering.pDepthAttachment = &depth;
    const VkViewport viewport{0, 0, static_cast<float>(any.width), static_cast<float>(any.height), 0, 1};

    vkCmdBeginRendering(commands, &rendering);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline);
    if (pipeline.set != VK_NULL_HANDLE)
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1,
                                &pipeline.set, 0, nullptr);
    vkCmdPushConstants(commands, pipeline.layout, kStages, 0, sizeof(push), &push);
    draw();
    vkCmdEndRendering(commands);
    fullBarrier(commands);
}

}  // namespace etalon::bench
