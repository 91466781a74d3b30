/* SPDX-License-Identifier: MIT
 *
 * Compute shaders on Vulkan devices that are processors (Mesa's lavapipe; SwiftShader, which
 * Chromium brings), from SPIR-V that glslangValidator or glslc make of the text. Built without
 * Vulkan's headers none is there. */
#define _GNU_SOURCE /* setenv */
#include "engine.h"

#ifdef ENGINE_VULKAN

#include <vulkan/vulkan.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_constants = 128 }; /* bytes that every device has for push constants */

typedef struct device {
    VkPhysicalDevice physical;
    VkDevice handle;
    VkQueue queue;
    VkCommandPool pool;
    uint32_t memory_type;
    char name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE];
    int there;
} device;

static struct {
    int tried;
    device devices[ENGINE_DEVICES];
    const device *used;
} vulkan;

static const char *const device_words[ENGINE_DEVICES] = {"llvmpipe", "SwiftShader"};

/* Host-visible memory that needs no flushing. */
static int choose_memory(device *one) {
    const VkMemoryPropertyFlags wanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(one->physical, &memory);
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        if ((memory.memoryTypes[i].propertyFlags & wanted) == wanted) {
            one->memory_type = i;
            return 1;
        }
    }
    return 0;
}

static int open_device(device *one) {
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                                .queueCount = 1,
                                                .pQueuePriorities = &priority};
    const VkDeviceCreateInfo device_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                            .queueCreateInfoCount = 1,
                                            .pQueueCreateInfos = &queue_info};
    const VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    if (!choose_memory(one) ||
        vkCreateDevice(one->physical, &device_info, NULL, &one->handle) != VK_SUCCESS) {
        return 0;
    }
    vkGetDeviceQueue(one->handle, 0, 0, &one->queue);
    return vkCreateCommandPool(one->handle, &pool_info, NULL, &one->pool) == VK_SUCCESS;
}

static void open_devices(void) {
    const VkApplicationInfo application = {
        VK_STRUCTURE_TYPE_APPLICATION_INFO, NULL, "check_glsl", 0, NULL, 0, VK_API_VERSION_1_1};
    const VkInstanceCreateInfo instance_info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                                .pApplicationInfo = &application};
    VkInstance instance;
    VkPhysicalDevice all[8];
    uint32_t count = 8;
    /* Chromium does not announce its driver to others. */
    setenv("VK_ADD_DRIVER_FILES", "/usr/lib/chromium/vk_swiftshader_icd.json", 0);
    if (vkCreateInstance(&instance_info, NULL, &instance) != VK_SUCCESS ||
        vkEnumeratePhysicalDevices(instance, &count, all) < 0) {
        return;
    }
    for (uint32_t i = 0; i < count; ++i) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(all[i], &properties);
        for (int k = 0; k < ENGINE_DEVICES; ++k) {
            device *const one = &vulkan.devices[k];
            if (one->there || strstr(properties.deviceName, device_words[k]) == NULL) continue;
            one->physical = all[i];
            memcpy(one->name, properties.deviceName, sizeof one->name);
            one->there = open_device(one);
        }
    }
}

int engine_vulkan_use(engine_device which) {
    if (!vulkan.tried) open_devices();
    vulkan.tried = 1;
    vulkan.used = &vulkan.devices[which];
    return vulkan.used->there ? ENGINE_OK : ENGINE_MISSING;
}

int engine_vulkan_open(void) {
    return engine_vulkan_use(ENGINE_LAVAPIPE);
}

const char *engine_vulkan_name(void) {
    return vulkan.used != NULL ? vulkan.used->name : "";
}

/* ---- From text to SPIR-V -------------------------------------------------------------------- */

static const char *const commands[ENGINE_COMPILERS] = {
    "glslangValidator -V --target-env vulkan1.1 -S comp -o %s/shader.spv %s/shader.comp "
    ">%s/shader.log 2>&1",
    "glslc -O --target-env=vulkan1.1 -fshader-stage=comp -o %s/shader.spv %s/shader.comp "
    ">%s/shader.log 2>&1"};

static int to_spirv(const char *text, engine_compiler compiler, void **words, size_t *size) {
    char command[2048];
    const char *folder = engine_folder();
    if (folder == NULL) return ENGINE_FAILED;
    snprintf(command, sizeof command, "%s/shader.comp", folder);
    FILE *file = fopen(command, "wb");
    if (file == NULL) return ENGINE_FAILED;
    fputs(text, file);
    if (fclose(file) != 0) return ENGINE_FAILED;
    snprintf(command, sizeof command, commands[compiler], folder, folder, folder);
    const int status = system(command);
    *words = status == 0 ? engine_read_file("shader.spv", size) : NULL;
    if (*words != NULL) return ENGINE_OK;
    if (status == 127 << 8) return ENGINE_MISSING; /* what a shell says of an unknown program */
    char *log = engine_read_file("shader.log", NULL);
    engine_print_numbered(text);
    printf("does not compile (%.10s): %s\n", commands[compiler], log != NULL ? log : "");
    free(log);
    return ENGINE_FAILED;
}

/* ---- Running -------------------------------------------------------------------------------- */

/* The members of the block as std430 lays them out: how many bytes, 0 where they are too many. */
static uint32_t lay_out(const engine_compute *run, unsigned char bytes[most_constants]) {
    static const uint32_t components[] = {1, 2, 1, 2, 3, 4}, alignments[] = {4, 8, 4, 8, 16, 16};
    uint32_t end = 0;
    memset(bytes, 0, most_constants);
    for (int i = 0; i < run->uniform_count; ++i) {
        const engine_uniform *one = &run->uniforms[i];
        const uint32_t alignment = alignments[one->type];
        const int whole = one->type == ENGINE_INT || one->type == ENGINE_IVEC2;
        end = (end + alignment - 1) / alignment * alignment;
        for (uint32_t k = 0; k < components[one->type]; ++k, end += 4) {
            const int32_t integer = (int32_t)one->number[k];
            if (end + 4 > most_constants) return 0;
            memcpy(bytes + end, whole ? (const void *)&integer : &one->number[k], 4);
        }
    }
    return end;
}

typedef struct buffer {
    VkBuffer handle;
    VkDeviceMemory memory;
    void *mapped;
} buffer;

static int make_buffer(buffer *made, const float *numbers, size_t count) {
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = count * sizeof *numbers,
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
    VkMemoryRequirements needs;
    if (vkCreateBuffer(vulkan.used->handle, &info, NULL, &made->handle) != VK_SUCCESS) return 0;
    vkGetBufferMemoryRequirements(vulkan.used->handle, made->handle, &needs);
    const VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                             .allocationSize = needs.size,
                                             .memoryTypeIndex = vulkan.used->memory_type};
    if (vkAllocateMemory(vulkan.used->handle, &allocation, NULL, &made->memory) != VK_SUCCESS ||
        vkBindBufferMemory(vulkan.used->handle, made->handle, made->memory, 0) != VK_SUCCESS ||
        vkMapMemory(vulkan.used->handle, made->memory, 0, VK_WHOLE_SIZE, 0, &made->mapped) !=
            VK_SUCCESS) {
        return 0;
    }
    memcpy(made->mapped, numbers, count * sizeof *numbers);
    return 1;
}

/* All that is made for one run. */
typedef struct work {
    buffer buffers[2];
    VkShaderModule shader;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorPool descriptors;
    VkDescriptorSet set;
    VkCommandBuffer commands;
} work;

static int make_pipeline(work *made, const uint32_t *words, size_t size, uint32_t constants) {
    const VkShaderModuleCreateInfo shader_info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = words};
    const VkDescriptorSetLayoutBinding bindings[2] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL}};
    const VkDescriptorSetLayoutCreateInfo set_info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 2,
        .pBindings = bindings};
    const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, constants};
    if (vkCreateShaderModule(vulkan.used->handle, &shader_info, NULL, &made->shader) !=
            VK_SUCCESS ||
        vkCreateDescriptorSetLayout(vulkan.used->handle, &set_info, NULL, &made->set_layout) !=
            VK_SUCCESS) {
        return 0;
    }
    const VkPipelineLayoutCreateInfo layout_info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 1,
        .pSetLayouts = &made->set_layout,
        .pushConstantRangeCount = constants != 0,
        .pPushConstantRanges = &range};
    if (vkCreatePipelineLayout(vulkan.used->handle, &layout_info, NULL, &made->layout) !=
        VK_SUCCESS) {
        return 0;
    }
    const VkComputePipelineCreateInfo pipeline_info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = made->shader,
                  .pName = "main"},
        .layout = made->layout};
    return vkCreateComputePipelines(vulkan.used->handle, VK_NULL_HANDLE, 1, &pipeline_info, NULL,
                                    &made->pipeline) == VK_SUCCESS;
}

static int make_set(work *made) {
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
    const VkDescriptorPoolCreateInfo pool_info = {.sType =
                                                      VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                                  .maxSets = 1,
                                                  .poolSizeCount = 1,
                                                  .pPoolSizes = &size};
    if (vkCreateDescriptorPool(vulkan.used->handle, &pool_info, NULL, &made->descriptors) !=
        VK_SUCCESS) {
        return 0;
    }
    const VkDescriptorSetAllocateInfo set_info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = made->descriptors,
        .descriptorSetCount = 1,
        .pSetLayouts = &made->set_layout};
    if (vkAllocateDescriptorSets(vulkan.used->handle, &set_info, &made->set) != VK_SUCCESS)
        return 0;
    for (uint32_t i = 0; i < 2; ++i) {
        const VkDescriptorBufferInfo info = {made->buffers[i].handle, 0, VK_WHOLE_SIZE};
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = made->set,
                                            .dstBinding = i,
                                            .descriptorCount = 1,
                                            .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                            .pBufferInfo = &info};
        vkUpdateDescriptorSets(vulkan.used->handle, 1, &write, 0, NULL);
    }
    return 1;
}

static int submit(work *made, const engine_compute *run, const unsigned char *constants,
                  uint32_t constant_bytes) {
    const VkCommandBufferAllocateInfo info = {.sType =
                                                  VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                              .commandPool = vulkan.used->pool,
                                              .commandBufferCount = 1};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    const VkMemoryBarrier barrier = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, NULL,
                                     VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
    if (vkAllocateCommandBuffers(vulkan.used->handle, &info, &made->commands) != VK_SUCCESS)
        return 0;
    vkBeginCommandBuffer(made->commands, &begin);
    vkCmdBindPipeline(made->commands, VK_PIPELINE_BIND_POINT_COMPUTE, made->pipeline);
    vkCmdBindDescriptorSets(made->commands, VK_PIPELINE_BIND_POINT_COMPUTE, made->layout, 0, 1,
                            &made->set, 0, NULL);
    if (constant_bytes != 0) {
        vkCmdPushConstants(made->commands, made->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           constant_bytes, constants);
    }
    vkCmdDispatch(made->commands, ((uint32_t)run->width + 7) / 8, ((uint32_t)run->height + 7) / 8,
                  1);
    vkCmdPipelineBarrier(made->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, NULL, 0, NULL);
    if (vkEndCommandBuffer(made->commands) != VK_SUCCESS) return 0;
    const VkSubmitInfo submission = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                     .commandBufferCount = 1,
                                     .pCommandBuffers = &made->commands};
    return vkQueueSubmit(vulkan.used->queue, 1, &submission, VK_NULL_HANDLE) == VK_SUCCESS &&
           vkQueueWaitIdle(vulkan.used->queue) == VK_SUCCESS;
}

static void release(work *made) {
    if (made->commands != NULL) {
        vkFreeCommandBuffers(vulkan.used->handle, vulkan.used->pool, 1, &made->commands);
    }
    vkDestroyDescriptorPool(vulkan.used->handle, made->descriptors, NULL);
    vkDestroyPipeline(vulkan.used->handle, made->pipeline, NULL);
    vkDestroyPipelineLayout(vulkan.used->handle, made->layout, NULL);
    vkDestroyDescriptorSetLayout(vulkan.used->handle, made->set_layout, NULL);
    vkDestroyShaderModule(vulkan.used->handle, made->shader, NULL);
    for (int i = 0; i < 2; ++i) {
        vkDestroyBuffer(vulkan.used->handle, made->buffers[i].handle, NULL);
        vkFreeMemory(vulkan.used->handle, made->buffers[i].memory, NULL);
    }
}

int engine_vulkan_compute(const engine_compute *run, engine_compiler compiler) {
    unsigned char constants[most_constants];
    work made;
    void *spirv = NULL;
    size_t size = 0;
    if (vulkan.used == NULL) engine_vulkan_open();
    if (!vulkan.used->there) return ENGINE_MISSING;
    const uint32_t constant_bytes = lay_out(run, constants);
    if (constant_bytes == 0 && run->uniform_count != 0) {
        printf("the push constants are more than %d bytes\n", most_constants);
        return ENGINE_FAILED;
    }
    const int status = to_spirv(run->shader, compiler, &spirv, &size);
    if (status != ENGINE_OK) return status;
    memset(&made, 0, sizeof made);
    for (size_t i = 0; i < run->out_count; ++i) run->out[i] = NAN;
    const int well = make_buffer(&made.buffers[0], run->in, run->in_count) &&
                     make_buffer(&made.buffers[1], run->out, run->out_count) &&
                     make_pipeline(&made, spirv, size, constant_bytes) && make_set(&made) &&
                     submit(&made, run, constants, constant_bytes);
    if (well) memcpy(run->out, made.buffers[1].mapped, run->out_count * sizeof *run->out);
    if (!well) printf("Vulkan refused to run the shader\n");
    release(&made);
    free(spirv);
    return well ? ENGINE_OK : ENGINE_FAILED;
}

#else

int engine_vulkan_use(engine_device which) {
    (void)which;
    return ENGINE_MISSING;
}

int engine_vulkan_open(void) {
    return ENGINE_MISSING;
}

const char *engine_vulkan_name(void) {
    return "";
}

int engine_vulkan_compute(const engine_compute *run, engine_compiler compiler) {
    (void)run;
    (void)compiler;
    return ENGINE_MISSING;
}

#endif
