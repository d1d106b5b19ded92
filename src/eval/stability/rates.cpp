// The method "multirate" near the blur at which an object starts to share its images: blur diameter and energy.

#include "plan/lens_cells/rates.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "eval/stability/board_scene.h"
#include "eval/stability/stability.h"

namespace defocus::engine {

namespace {

constexpr double sharedBlur = wholeShareBlur - 0.5;                         // px; all sample groups share
constexpr double partlySharedBlur = 0.5 * (wholeShareBlur + minShareBlur);  // px; half of the sample groups share
constexpr double diameterLimit = 0.5;                                       // px
constexpr double energyLimit = 5e-3;

// Returns a light behind the focus with a blur of `blur` px.
BoardScene blurredLightScene(double blur, std::uint32_t samples) {
    View view = boardView();
    setBlur(view, 6, blur);
    BoardScene boards(view, {squareAt(view, 6, 3, glm::vec3(8))});
    boards.settings.keepAll = false;
    boards.settings.sampleCount = samples;
    return boards;
}

double diameterError(double blur) {
    const BoardScene boards = blurredLightScene(blur, 1024);
    return blurredLight(rendered(boards, "multirate"), boards.view, {.depth = 6}).diameterError;
}

double energyOf(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
}

// Returns the relative energy error against the light's 3 × 3 px of radiance 8 in three channels; the background's
// alpha is subtracted.
double energyError(double blur) {
    const BoardScene boards = blurredLightScene(blur, 1024);
    const Image image = rendered(boards, "multirate");
    const auto pixels = static_cast<double>(image.pixels.size() / 4);
    return std::abs((energyOf(image) - pixels) / (3 * 9 * 8) - 1);
}

double waveError(std::uint32_t wave) {
    const BoardScene boards = blurredLightScene(partlySharedBlur, 200);
    const auto options = [](std::uint32_t k) { return RendererOptions{.wave = k, .shaderFolder = {}, .settings = {}}; };
    return largestError(rendered(boards, "multirate", options(64)), rendered(boards, "multirate", options(wave)));
}

double sharingPinholeError() {
    BoardScene boards = blurredLightScene(sharedBlur, 64);
    boards.view.lens.blurScale = 0;
    return largestError(rendered(boards, "multirate"), rendered(boards, "accumulation"));
}

}  // namespace

void addRateCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string reference, double limit,
                         std::function<double()> error) {
        cases.push_back({"rates", std::move(name), std::move(measured), std::move(reference), limit, std::move(error)});
    };
    for (const auto& [name, blur] :
         {std::pair{"a shared light", sharedBlur}, {"a light half shared", partlySharedBlur}}) {
        add(fmt::format("{}, blur {:g} px", name, blur), "disk diameter, px", "closed form", diameterLimit,
            [blur = blur] { return diameterError(blur); });
        add(fmt::format("{}, blur {:g} px", name, blur), "energy, relative", "closed form", energyLimit,
            [blur = blur] { return energyError(blur); });
    }
    for (const std::uint32_t wave : {1u, 3u, 5u})
        add(fmt::format("groups cut by waves of {}", wave), "largest difference", "waves of 64", 0,
            [wave] { return waveError(wave); });
    add("shared images, blur scale 0", "largest difference", "accumulation", 0, sharingPinholeError);
}

}  // namespace defocus::engine
