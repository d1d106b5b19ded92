#include "render/lens_space/record_shading.h"

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr std::size_t groupBytes = 4 * sizeof(std::uint32_t);     // element size in shaders/lens_space/groups.glsl
constexpr std::size_t dispatchBytes = 3 * sizeof(std::uint32_t);  // size of OpenGL's DispatchIndirectCommand

}  // namespace

RecordShading::RecordShading(GpuScene& scene, std::filesystem::path shaderFolder)
    : scene_(&scene), shaderFolder_(std::move(shaderFolder)) {
    placesProgram_ = Program({{"lens_space/list_places.comp"}, {}, shaderFolder_});
}

const Program& RecordShading::program(const char* shader, const ShaderDefines& defines, const ShaderDefines& more) {
    ShaderDefines all = defines;
    all.insert(all.end(), more.begin(), more.end());
    const auto [entry, isNew] = programs_.try_emplace(shader + keyOf(all));
    if (isNew) entry->second = Program({{shader}, all, shaderFolder_});
    return entry->second;
}

void RecordShading::prepare(const FramePlan& plan, const LensFront& front, const ShaderDefines& defines) {
    imageSize_ = {plan.view.width, plan.view.height};
    lensRadius_ = static_cast<float>(0.5 * plan.apertureDiameter);
    if (!listProgram_ || listDefines_ != defines) {
        listDefines_ = defines;
        listProgram_ = Program({{"lens_space/lists.comp"}, defines, shaderFolder_});
        ShaderDefines counting = defines;
        counting.emplace_back("countsOnly", "true");
        countProgram_ = Program({{"lens_space/lists.comp"}, counting, shaderFolder_});
    }
    groupPrograms_ = {&program("lens_space/shade_sky.comp", defines, {})};
    vertexPrograms_.clear();
    std::vector<int> materials;
    for (const ShadedGroup& group : front.groups()) {
        if (front.lightsVertices()) {
            groupPrograms_.push_back(&program("lens_space/interpolate_light.comp", defines, {}));
            vertexPrograms_.push_back(&program("lens_space/shade_vertices.comp", front.defines(), group.defines));
        } else {
            groupPrograms_.push_back(&program("lens_space/shade_surface.comp", defines, group.defines));
        }
        materials.push_back(group.material);
    }
    materials_ = MaterialBlocks(*scene_, std::move(materials));
    groups_ = Buffer(groupPrograms_.size() * groupBytes);
    dispatches_ = Buffer(groupPrograms_.size() * dispatchBytes);
}

void RecordShading::shadeVertices(const LensFront& front) {
    if (!front.lightsVertices()) return;
    front.bindVertices();
    for (std::size_t i = 0; i < vertexPrograms_.size(); ++i) {
        vertexPrograms_[i]->use();
        glUniform1ui(0, front.vertexCount());
        glUniform1ui(1, static_cast<GLuint>(i) + 1);
        bindMaterial(i);
        dispatchOver(front.vertexCount());
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void RecordShading::shade(const LensFront& front, std::uint64_t count, std::uint32_t firstRay) {
    if (list_.bytes() < count * sizeof(std::uint32_t)) {
        list_ = Buffer();  // free the old buffer first: memory might not suffice for old and new buffers
        list_ = Buffer(count * sizeof(std::uint32_t));
    }

    // Count and list the records (ray hits) of each group of surfaces.
    const GLuint zero = 0;
    glClearNamedBufferData(groups_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    front.bindTriangles();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, groups_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, list_.name());
    const auto overRecords = [&](const Program& program) {
        program.use();
        glUniform1ui(0, static_cast<GLuint>(count));
        dispatchOver(count);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    };
    // Save the ray buffer's binding, to restore it below: the dispatches temporarily use the same binding point.
    GLint rays = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 6, &rays);
    overRecords(countProgram_);
    placesProgram_.use();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, dispatches_.name());
    glUniform1ui(0, static_cast<GLuint>(groupPrograms_.size()));
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, static_cast<GLuint>(rays));
    overRecords(listProgram_);

    // Shade the records (ray hits) of each group of surfaces.
    if (front.lightsVertices())
        front.bindVertexLight();
    else
        front.bindAttributes();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, dispatches_.name());
    for (std::size_t i = 0; i < groupPrograms_.size(); ++i) {
        groupPrograms_[i]->use();
        glUniform2i(0, imageSize_.x, imageSize_.y);
        glUniform1ui(1, firstRay);
        glUniform1ui(2, static_cast<GLuint>(i));
        glUniform1f(3, lensRadius_);
        if (i > 0 && !front.lightsVertices()) bindMaterial(i - 1);
        glDispatchComputeIndirect(static_cast<GLintptr>(i * dispatchBytes));
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

std::size_t RecordShading::bytes() const {
    return materials_.bytes() + groups_.bytes() + dispatches_.bytes() + list_.bytes();
}

}  // namespace defocus::engine
