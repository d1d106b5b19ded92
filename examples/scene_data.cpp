// scene_data [IMAGE]: renders a chequered floor that is built in memory, with a lens focused on the floor's middle.

#include <defocus/defocus.h>

#include <array>
#include <cstdint>
#include <iostream>

int main(int count, char** words) try {
    // A square of 10 m with a texture of 2 × 2 texels, which repeats every 2 m.
    const std::array<float, 3> corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const std::array<float, 2> uvs[] = {{0, 0}, {0, 5}, {5, 5}, {5, 0}};
    const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    const float checks[] = {0.8f, 0.1f, 0.1f, 0.8f};

    defocus::TextureData texture;
    texture.image = defocus::ImageView(2, 2, 1, checks);
    texture.magnification = defocus::TextureFilter::nearest;
    defocus::MaterialData tiles;
    tiles.baseColorTexture = 0;  // index into SceneData::textures
    tiles.metallic = 0;
    tiles.roughness = 0.5f;
    defocus::MeshData square;
    square.positions = corners;
    square.uvs = uvs;
    square.indices = triangles;
    square.material = 0;
    defocus::InstanceData floor;
    floor.name = "Floor";
    floor.mesh = 0;
    defocus::CameraData camera;
    camera.transform = defocus::lookAt({0, 1.5, 4}, {0, 0, 0});
    camera.focusDistance = 4.3;    // m
    camera.lens.focalLength = 50;  // mm
    camera.lens.fStop = 1.4;

    defocus::SceneData data;
    data.meshes = {&square, 1};
    data.materials = {&tiles, 1};
    data.textures = {&texture, 1};
    data.instances = {&floor, 1};
    data.cameras = {&camera, 1};
    const defocus::Scene scene = defocus::Scene::create(data);

    defocus::Request request;
    request.size = {480, 320};
    request.samples = 64;
    defocus::SceneRenderer renderer(scene, request);
    renderer.write(count > 1 ? words[1] : "floor.png", renderer.render());
} catch (const defocus::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
