#pragma once
// Makes random options, lenses and cameras for tests that write views to files and read them back.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <string>

#include "frame/request.h"
#include "frame/settings/settings.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    bool coin() { return integer(0, 1) == 1; }
    int integer(int min, int max) { return std::uniform_int_distribution<int>(min, max)(engine_); }
    double number(double min, double max) { return std::uniform_real_distribution<double>(min, max)(engine_); }
    std::string name() {
        static const char* const names[] = {"plain",           "two words", "it's \"quoted\"",
                                            "$HOME `ls` \\ *", "-dash",     "a=b;c"};
        return names[integer(0, 5)];
    }

private:
    std::mt19937 engine_;
};

inline Request randomOptions(Dice& dice) {
    Request options;
    if (dice.coin()) {
        options.scene = dice.name() + ".glb";
    } else {
        options.fishCount = dice.integer(1, 30);
        options.trianglesPerFish = dice.integer(200, 5000);
    }
    if (dice.coin()) options.clip = dice.name();
    if (dice.coin()) options.time = dice.number(-2, 9);
    options.loop = dice.coin();
    if (dice.coin()) options.shutter = dice.number(0, 0.1);
    options.shutterPosition = static_cast<ShutterPosition>(dice.integer(0, 2));
    options.motionSegments = static_cast<std::uint32_t>(dice.integer(1, 64));
    if (dice.coin()) options.motionSegments = ExactMotion{};
    if (dice.coin()) options.environment = dice.name() + ".hdr";
    if (dice.coin()) options.background = TransparentBackground{};
    if (dice.coin()) options.background = Color{static_cast<float>(dice.number(0, 2)), 0.1f, 3};
    if (dice.coin()) options.camera = NamedCamera{dice.name()};
    if (dice.coin()) options.lens.apertureImage = dice.name() + ".png";
    if (dice.coin()) options.nodeBlur = {{dice.name(), dice.number(0, 3)}, {"another", 0}};
    if (dice.coin()) options.hide = {dice.name(), "7"};
    if (dice.coin()) options.cocTolerance = dice.number(0.01, 3);
    options.samples = static_cast<std::uint32_t>(dice.integer(1, 4096));
    options.sequence = allSequences[static_cast<std::size_t>(dice.integer(0, 3))];
    if (dice.coin()) options.seed = static_cast<std::uint32_t>(dice.integer(0, 1'000'000));
    options.lod = static_cast<LodMode>(dice.integer(0, 3));
    options.lodMetric = static_cast<LodMetric>(dice.integer(0, 2));
    options.levelVertices = static_cast<LevelVertices>(dice.integer(0, 1));
    if (dice.coin()) options.lodCoc = LodCoc::centre;
    if (dice.coin()) options.blurThreshold = dice.number(0, 2);
    if (dice.coin()) options.sizeThreshold = dice.number(0, 9);
    options.keepAll = dice.coin();
    options.noCache = dice.coin();
    if (!options.noCache && dice.coin()) options.cacheFolder = dice.name();
    if (dice.coin()) setByName(options, "method", "circular:far-components=3");
    if (dice.coin()) options.layerFormat = LayerFormat::rgba32f;
    if (dice.coin()) options.wave = static_cast<std::uint32_t>(dice.integer(1, 64));
    return options;
}

// Sets about half of the lens fields to random valid values.
inline void changeFields(Lens& lens, Dice& dice) {
    for (const LensField& field : lensFields()) {
        if (dice.coin()) continue;
        const double min = std::max(field.min, -50.0);
        const double max = std::min(field.max, 60.0);
        double value = dice.number(min, max);
        if (!std::holds_alternative<double Lens::*>(field.member)) value = std::round(value);
        if (field.name == std::string_view("bladeCount")) value = dice.integer(3, 9);
        if (field.name == std::string_view("exposureTime") && dice.coin()) value = 0;
        setLensField(lens, field, value);
    }
}

// Returns a camera at a random position that looks towards the origin, upright or rolled.
inline glm::dmat4 randomCamera(Dice& dice) {
    const glm::dvec3 eye(dice.number(-9, 9), dice.number(-9, 9), dice.number(-9, 9));
    const glm::dmat4 upright = glm::inverse(glm::lookAt(eye, glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(0, 1, 0)));
    const double roll = dice.coin() ? dice.number(-3, 3) : 0;
    return glm::rotate(upright, roll, glm::dvec3(0, 0, 1));
}

}  // namespace defocus::engine
