#include "render/lens_space/divided_triangles.h"

#include <algorithm>
#include <cmath>

#include "render/lens_space/lens_front.h"

namespace defocus::engine {

std::uint32_t partsOfEdges(const ObjectPlan& object, std::uint64_t triangles, double tolerance, double maxTriangles) {
    if (object.refinement == Refinement::none || triangles == 0) return 1;
    // With n parts per edge, the deviation of the circle of confusion from a linear function falls as 1/n at a kink and
    // as 1/n² on a curve.
    const double needed =
        std::max(object.cocDeviation.kinks / tolerance, std::sqrt(object.cocDeviation.curved / tolerance));
    const double most = std::min(double{maxEdgeParts}, std::sqrt(maxTriangles / static_cast<double>(triangles)));
    return static_cast<std::uint32_t>(std::max(1.0, std::min(std::ceil(needed), std::floor(most))));
}

DividedTriangles::DividedTriangles(std::filesystem::path shaderFolder, bool lightsVertices)
    : shaderFolder_(std::move(shaderFolder)) {
    ShaderDefines defines;
    if (lightsVertices) defines.emplace_back("lightsVertices", "true");
    trianglesProgram_ = Program({{"lens_space/divide_triangles.comp"}, defines, shaderFolder_});
    attributesProgram_ = Program({{"lens_space/divide_attributes.comp"}, {}, shaderFolder_});
}

void DividedTriangles::start(const ShaderDefines& defines) {
    runs_.clear();
    if (clipsProgram_ && defines == defines_) return;
    defines_ = defines;
    clipsProgram_ = Program({{"lens_space/divide_clips.comp"}, defines, shaderFolder_});
}

void DividedTriangles::makeTriangles(const Buffer& bases) const {
    dispatch(trianglesProgram_, bases, true);
}

void DividedTriangles::makeClips(const Buffer& bases, const Buffer& clips, const Buffer& ownBlurs) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, clips.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, ownBlurs.name());
    dispatch(clipsProgram_, bases, false);
}

void DividedTriangles::makeAttributes(const Buffer& bases, const Buffer& attributes) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, attributes.name());
    dispatch(attributesProgram_, bases, false);
}

void DividedTriangles::dispatch(const Program& program, const Buffer& bases, bool triangles) const {
    if (runs_.empty()) return;
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    program.use();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, bases.name());
    for (const DividedRun& run : runs_) {
        glUniform1ui(0, run.firstBase);
        glUniform1ui(1, run.baseCount);
        glUniform1ui(2, run.parts);
        glUniform1ui(3, run.firstVertex);
        if (triangles) glUniform1ui(4, run.firstTriangle);
        dispatchOver(triangles ? run.triangleCount() : run.vertexCount());
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace defocus::engine
