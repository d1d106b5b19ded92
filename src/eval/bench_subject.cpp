#include "eval/bench_subject.h"

#include <nlohmann/json.hpp>

#include "frame/report/json_values.h"

namespace defocus::engine {

namespace {

nlohmann::ordered_json lensJson(const Lens& lens) {
    return {{"focalLength", lens.focalLength},
            {"fStop", lens.fStop},
            {"focusDistance", jsonNumber(lens.focusDistance)},
            {"horizontalAperture", lens.horizontalAperture},
            {"bladeCount", lens.bladeCount},
            {"blurScale", lens.blurScale},
            {"dofEnabled", lens.dofEnabled}};
}

}  // namespace

nlohmann::ordered_json subjectJson(const std::string& bench, const BenchSubject& subject) {
    const Machine& machine = subject.machine;
    nlohmann::ordered_json json = {{"bench", bench},
                                   {"program", subject.program},
                                   {"commit", subject.commit},
                                   {"commands", subject.commands},
                                   {"machine",
                                    {{"processor", machine.processor},
                                     {"threads", machine.threads},
                                     {"memoryBytes", machine.memoryBytes},
                                     {"system", machine.system}}},
                                   {"device", subject.device},
                                   {"driver", subject.driver},
                                   {"gpuTimesCoverVertexWork", !subject.software}};
    if (!subject.scene.empty()) json["scene"] = subject.scene;
    if (!subject.camera.empty()) json["camera"] = subject.camera;
    if (subject.lens) json["lens"] = lensJson(*subject.lens);
    if (subject.width > 0) {
        json["width"] = subject.width;
        json["height"] = subject.height;
    }
    if (subject.runs > 0) json["runs"] = subject.runs;
    if (subject.pyramidMilliseconds > 0) json["pyramidMilliseconds"] = subject.pyramidMilliseconds;
    return json;
}

}  // namespace defocus::engine
