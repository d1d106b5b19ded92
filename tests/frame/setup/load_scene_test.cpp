#include <gtest/gtest.h>

#include "core/error.h"
#include "frame/setup/prepared_frame.h"
#include "frame/setup/shared_scene.h"
#include "scene/gltf/builder.h"

namespace defocus::engine {
namespace {

TEST(LoadScene, refusesMissingTexturesWithStrict) {
    GltfBuilder builder;
    builder.mesh({{{"attributes", {{"POSITION", builder.positions(unitTriangle)}}}, {"material", 0}}});
    builder.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "gone.png"}}};
    const ScratchFolder folder;
    GltfBuilder::save(folder / "built.glb", builder.glb());
    Request request;
    request.scene = folder / "built.glb";
    EXPECT_EQ(damageWarnings(loadScene(request)).size(), 1u);
    request.strict = true;
    const std::string message = messageOf<Error>([&] { static_cast<void>(loadScene(request)); });
    EXPECT_NE(message.find("built.glb: 1 texture left out"), std::string::npos) << message;
    EXPECT_NE(message.find("'gone.png' does not exist"), std::string::npos) << message;
}

}  // namespace
}  // namespace defocus::engine
