#include "render/lens_space/see_through.h"

#include "core/error.h"
#include "gl/context.h"

namespace defocus::engine {

namespace {

// Number of entries of a tile's list that one iteration of shaders/lens_space/behind.comp tests. Several entries per
// iteration allow longer lists, because Mesa's software driver ends the loops of a thread after a total of 65,535
// iterations.
constexpr std::uint32_t entriesAtOnce = 8;
constexpr std::uint32_t softwareIterations = 65'000;

}  // namespace

SeeThrough::SeeThrough(std::filesystem::path shaderFolder, std::uint32_t tileSize)
    : shaderFolder_(std::move(shaderFolder)), tileSize_(tileSize), goOn_(sizeof(std::uint32_t)) {}

void SeeThrough::prepare(const FramePlan& plan, const LensFront& front, const ShaderDefines& defines) {
    imageSize_ = {plan.view.width, plan.view.height};
    const auto program = [&](const char* shader, ShaderDefines all) {
        const auto [entry, isNew] = programs_.try_emplace(shader + keyOf(all));
        if (isNew) entry->second = Program({{shader}, all, shaderFolder_});
        return &entry->second;
    };
    tests_.clear();
    for (std::size_t i = 0; i < front.groups().size(); ++i) {
        const ShadedGroup& group = front.groups()[i];
        if (!group.seeThrough()) continue;
        ShaderDefines all = defines;
        all.insert(all.end(), group.defines.begin(), group.defines.end());
        all.emplace_back(group.alphaMode == AlphaMode::mask ? "alphaTested" : "alphaBlended", "true");
        tests_.push_back({i, program("lens_space/let_through.comp", std::move(all))});
    }
    if (tests_.empty()) return;
    ShaderDefines all = defines;
    all.emplace_back("tileSize", std::to_string(tileSize_));
    behind_ = program("lens_space/behind.comp", std::move(all));
}

std::uint32_t SeeThrough::raysThatGoOn(const LensFront& front, const RecordShading& shading, std::uint64_t count,
                                       std::uint32_t firstRay, bool first) {
    std::uint32_t goOn = 0;
    goOn_.update(0, sizeof goOn, &goOn);
    front.bindTests();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, goOn_.name());
    for (const Test& test : tests_) {
        test.program->use();
        shading.bindMaterial(test.group);
        glUniform2i(0, imageSize_.x, imageSize_.y);
        glUniform1ui(1, firstRay);
        glUniform1ui(2, static_cast<GLuint>(test.group) + 1);
        glUniform1ui(3, static_cast<GLuint>(count));
        glUniform1i(4, first ? 1 : 0);
        dispatchOver(count);
    }
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    goOn_.read(0, sizeof goOn, &goOn);
    return goOn;
}

std::uint64_t SeeThrough::resolve(LensFront& front, const RecordShading& shading, std::uint64_t count,
                                  std::uint32_t firstRay) {
    std::uint64_t searches = 0;
    if (tests_.empty() || count == 0) return searches;
    if (currentIsSoftware() && front.statistics().largestTile > std::uint64_t{softwareIterations} * entriesAtOnce)
        fail(
            "a block of pixels has {} triangles, but with cut-out or blended surfaces this driver supports at most {} "
            "per block; choose a larger image (its blocks have fewer triangles) or method accumulation",
            front.statistics().largestTile, std::uint64_t{softwareIterations} * entriesAtOnce);
    while (const std::uint32_t goOn = raysThatGoOn(front, shading, count, firstRay, searches == 0)) {
        searches += goOn;
        for (const TileBand& band : front.bands()) {
            front.fill(band);
            behind_->use();
            front.bindTriangles();
            glUniform2i(0, imageSize_.x, imageSize_.y);
            glUniform1ui(1, firstRay);
            glUniform1ui(2, static_cast<GLuint>(count));
            glUniform2ui(3, band.first, band.end);
            dispatchOver(count);
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        }
    }
    return searches;
}

}  // namespace defocus::engine
