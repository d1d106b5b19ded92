#include "stability/lens_honesty.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/error.h"
#include "image/moments.h"
#include "stability/board_scene.h"

namespace defocus::engine {

namespace {

constexpr double square = 3;  // width of the light before the blur, px

struct Case {
    std::string varied;
    double fStop = 1.4;
    double focusDistance = 2;        // m
    double depth = 6;                // m
    double horizontalAperture = 36;  // mm
    std::uint32_t samples = 256;
    int width = 192;  // width of the image, px
    bool aboutSamples = false;
};

std::vector<Case> cases() {
    std::vector<Case> list;
    for (const double n : {0.95, 1.4, 2.8, 5.6}) list.push_back({.varied = fmt::format("f/{:g}", n), .fStop = n});
    for (const double s : {1.0, 3.0, 4.0})
        list.push_back({.varied = fmt::format("focus at {:g} m", s), .focusDistance = s});
    for (const double z : {1.2, 1.5, 3.0, 20.0})
        list.push_back({.varied = fmt::format("light at {:g} m", z), .depth = z});
    for (const double w : {24.0, 54.0})
        list.push_back({.varied = fmt::format("sensor of {:g} mm", w), .horizontalAperture = w});
    for (const int width : {96, 384}) list.push_back({.varied = fmt::format("{} px wide", width), .width = width});
    for (const std::uint32_t n : {16u, 64u, 1024u})
        list.push_back({.varied = fmt::format("{} samples", n), .samples = n, .aboutSamples = true});
    return list;
}

HonestyRow measured(const std::string& method, const Case& subject) {
    View view = boardView(subject.width, subject.width * 2 / 3);
    view.lens.focalLength = 100;
    view.lens.fStop = subject.fStop;
    view.lens.focusDistance = subject.focusDistance;
    view.lens.horizontalAperture = subject.horizontalAperture;
    Board wall{subject.depth + 1e-4, {0, 0}, {50, 50}, glm::vec3(0)};
    BoardScene boards(view, {squareAt(view, subject.depth, square, glm::vec3(8)), wall});
    boards.settings.sampleCount = subject.samples;
    const Moments moments = momentsOf(rendered(boards, method));
    boards.view.lens.dofEnabled = false;
    const Moments sharp = momentsOf(rendered(boards, method));
    return {method, subject.varied, blurDiameter(view, subject.depth), 2 * radiusBySecondMoment(moments, 0, square),
            moments.energy / sharp.energy};
}

}  // namespace

bool HonestyRow::followsLens() const {
    return std::abs(measured - expected) <= honestDiameter && std::abs(energy - 1) <= honestEnergy;
}

std::vector<std::string> honestyMethods() {
    std::vector<std::string> list;
    for (const Method& method : methods()) {
        list.push_back(method.name);
        for (const MethodSetting& setting : method.settings) {
            if (setting.ofTheScene) continue;
            const std::vector<std::string> max = {fmt::format("{:g}", setting.max)};
            const std::string also = setting.onlyWith.empty() ? "" : setting.onlyWith + ",";
            for (const std::string& choice : setting.choices.empty() ? max : setting.choices)
                if (choice != setting.defaultValue)
                    list.push_back(fmt::format("{}:{}{}={}", method.name, also, setting.name, choice));
        }
    }
    return list;
}

void measureHonesty(const std::vector<std::string>& methods, const std::function<void(const HonestyRow&)>& visit,
                    const Progress& progress) {
    const std::vector<Case> list = cases();
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const std::string& method = methods[m];
        const bool usesLensSamples = parseMethodUse(method).method->usesLensSamples;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const Case& subject = list[i];
            report(progress, "lenses", m * list.size() + i, list.size() * methods.size());
            if (subject.aboutSamples && !usesLensSamples) continue;
            try {
                visit(measured(method, subject));
            } catch (const Error& error) {
                visit({.method = method, .varied = subject.varied, .leftOut = error.what()});
                break;
            }
        }
    }
}

}  // namespace defocus::engine
