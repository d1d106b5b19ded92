// Tests KHR_materials_transmission and _volume, rendered by method "accumulation": energy, absorption and refraction
// against closed forms.

#include "render/glass_wall.h"

namespace defocus::engine {
namespace {

void light(SmallWorld& small) {
    small.world.environment.zenith = glm::vec3(1);
}

TEST_F(Transmission, whatWhiteGlassDoesNotReflectItLetsThrough) {
    for (const float roughness : {0.0f, 0.3f, 1.0f})
        for (const float thickness : {0.0f, 0.2f})
            for (const float share : {0.3f, 1.0f}) {
                Material material = glass(roughness);
                material.thicknessFactor = thickness;
                material.transmissionFactor = share;
                const auto small = litWall(material);
                light(*small);
                EXPECT_LT(farthestFrom(wallImage(*small), glm::dvec3(1)), 1e-5) << roughness << ' ' << thickness;
            }
}

// A slab absorbs light by the Beer-Lambert law, c^(d/D), with the attenuation colour c. The thickness d scales with the
// object, but the attenuation distance D does not.
TEST_F(Transmission, aSlabAbsorbsByItsThickness) {
    const glm::dvec3 color(0.5, 0.25, 1);
    for (const double thickness : {0.1, 0.4})
        for (const double scale : {1.0, 3.0})
            for (const double metresPerUnit : {1.0, 0.01}) {
                Material material = clear();
                material.thicknessFactor = static_cast<float>(thickness);
                material.attenuationColor = color;
                material.attenuationDistance = static_cast<float>(0.5 / metresPerUnit);
                const auto small = litWall(material);
                light(*small);
                small->scene.metresPerUnit = metresPerUnit;
                glm::dmat4& placed = small->world.pose.objects[0].worldFromObject;
                placed = glm::scale(placed, glm::dvec3(scale));
                const glm::dvec3 expected = glm::pow(color, glm::dvec3(thickness * scale / 0.5));
                EXPECT_LT(farthestFrom(wallImage(*small), expected), 1e-5) << thickness << ' ' << scale;
            }
}

// A surface with volume shows the background at the point where the refracted ray leaves the volume.
TEST_F(Transmission, aVolumeShowsWhereItsRefractedRayLeaves) {
    Material material = clear();
    material.ior = 1.5f;
    material.thicknessFactor = 0.5f;
    const auto small = litWall(material);
    const glm::dmat4 placed = glm::rotate(small->world.pose.objects[0].worldFromObject, 0.5, glm::dvec3(0, 1, 0));
    small->world.pose.objects[0].worldFromObject = placed;
    addWall(*small, 4, unlitMaterial(glm::vec4(1)), 2);
    const Image image = wallImage(*small);
    const glm::dmat4 cameraFromWorld = glm::inverse(small->view.worldFromCamera);
    const glm::dvec3 normal(placed[2]);
    int compared = 0;
    for (const WallPoint& point : wallPoints(*small)) {
        // The view ray meets the tilted pane at the point `entry`.
        const glm::dvec3 eye(small->view.worldFromCamera[3]);
        const double along = glm::dot(glm::dvec3(placed[3]) - eye, normal) / glm::dot(-point.toEye, normal);
        const glm::dvec3 entry = eye - point.toEye * along;
        const glm::dvec3 on = glm::dvec3(glm::inverse(placed) * glm::dvec4(entry, 1));
        if (std::max(std::abs(on.x), std::abs(on.y)) > 0.95) continue;
        const glm::dvec3 exit = entry + 0.5 * glm::refract(-point.toEye, normal, 1 / 1.5);
        const glm::dvec3 seen(cameraFromWorld * glm::dvec4(exit, 1));
        const double right = 4 * seen.x / -seen.z;  // horizontal position on the wall behind the pane, m
        const double edge = 4 * 0.36 * (1 - 2.0 / image.width);
        if (std::abs(right) > edge || std::abs(seen.y / seen.z) > 0.36 * 0.75 * 0.9) continue;
        ASSERT_NEAR(image.at(point.x, point.y)[0], (right / 2 + 1) / 2, 2e-4) << point.x << ' ' << point.y;
        ++compared;
    }
    EXPECT_GT(compared, 200);
}

// Panes behind each other, with an alpha-blended surface in between, are all visible, in any order in the file.
TEST_F(Transmission, panesAndBlendedSurfacesBehindEachOtherAreAllSeen) {
    for (const bool nearestFirst : {false, true}) {
        const auto small = litWall(clear({1, 0.5f, 1}));
        light(*small);
        Material blended = unlitMaterial({0, 0, 0, 0.5f});
        blended.alphaMode = AlphaMode::blend;
        if (nearestFirst) addWall(*small, 1.5, clear({0.25f, 1, 1}), 2);
        addWall(*small, 1.75, blended, 2);
        if (!nearestFirst) addWall(*small, 1.5, clear({0.25f, 1, 1}), 2);
        for (Mesh& mesh : small->scene.meshes) mesh.vertices.colors.clear();
        finish(*small);
        EXPECT_LT(farthestFrom(wallImage(*small), {0.125, 0.25, 0.5}), 1e-5) << nearestFirst;
    }
}

// Each of the eight nearest panes shows the panes behind it. Farther panes show only the opaque background. Of the
// farther panes, only the one that is drawn last is visible.
TEST_F(Transmission, behindManyPanesTheBackgroundIsStillSeen) {
    const auto small = litWall(clear(glm::vec3(0.9f)));
    light(*small);
    for (int i = 1; i < 12; ++i) addWall(*small, 2 - 0.1 * i, clear(glm::vec3(0.9f)), 1);
    for (Mesh& mesh : small->scene.meshes) mesh.vertices.colors.clear();
    finish(*small);
    EXPECT_LT(farthestFrom(wallImage(*small), glm::dvec3(std::pow(0.9, 9))), 1e-5)
        << "the eight nearest panes and one of the others";
}

TEST_F(Transmission, theBackgroundsCoverageIsKept) {
    for (const float tint : {1.0f, 0.5f}) {
        const auto small = litWall(clear(glm::vec3(tint)));
        light(*small);
        small->world.environment.visible = false;
        const Image image = wallImage(*small);
        EXPECT_NEAR(image.at(16, 12)[3], 1 - tint, 1e-5);
        EXPECT_NEAR(image.at(16, 12)[0], 0, 1e-5);
    }
}

struct Spread {
    double mean = 0;
    double deviation = 0;
};

Spread redOf(const Image& image) {
    double sum = 0, squares = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            sum += image.at(x, y)[0];
            squares += static_cast<double>(image.at(x, y)[0]) * image.at(x, y)[0];
        }
    const double count = image.width * image.height;
    return {sum / count, std::sqrt(squares / count - sum * sum / count / count)};
}

// A rough pane blurs the wall behind it and keeps the wall's mean radiance. Red varies across the wall, and a rougher
// pane reduces this variation.
TEST_F(Transmission, roughnessSpreadsWhatLiesBehindAndKeepsItsLight) {
    double before = 1;
    Spread smooth;
    for (const float roughness : {0.0f, 0.2f, 0.4f, 0.8f}) {
        Material material = clear();
        material.roughnessFactor = roughness;
        const auto small = litWall(material);
        addWall(*small, 4, unlitMaterial(glm::vec4(1)), 2);
        small->view.width = 64;
        small->view.height = 64;
        const Spread red = redOf(drawnBy("accumulation", *small, 64));
        if (roughness == 0) smooth = red;
        EXPECT_LT(red.deviation, before) << roughness;
        EXPECT_NEAR(red.mean, smooth.mean, 0.02 * smooth.mean) << roughness;
        before = red.deviation;
    }
    EXPECT_LT(before, 0.75 * smooth.deviation);
}

}  // namespace
}  // namespace defocus::engine
