#include "frame/report/plan_report.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "frame/report/json_values.h"
#include "lens/lens_fields.h"
#include "lod/pyramid/level_selection.h"
#include "plan/lens_cells/automatic_cells.h"
#include "plan/lens_cells/lens_cells.h"
#include "plan/plan_text.h"

namespace defocus {

namespace {

using engine::FramePlan;
using engine::LensField;
using engine::ObjectPlan;
using Json = nlohmann::ordered_json;

struct EndText {
    const char* name;
    const char* reason;
};

EndText textOf(engine::PyramidEnd end) {
    using engine::PyramidEnd;
    switch (end) {
        case PyramidEnd::minTriangles:
            return {"minTriangles", "the last level has the minimum number of triangles"};
        case PyramidEnd::smallSaving:
            return {"smallSaving", "a further level would save less than a quarter of the triangles"};
        case PyramidEnd::topology:
            return {"topology", "holes (handles) and borders of the mesh need the remaining triangles"};
        case PyramidEnd::largestParts:
            return {"largestParts", "only the largest connected parts could be simplified further"};
        case PyramidEnd::noSurface:
            return {"noSurface", "all triangles have zero area"};
        case PyramidEnd::maxLevels:
            return {"maxLevels", "the maximum number of levels is reached"};
    }
    engine::fail("unknown reason why a pyramid has no further level");
}

PlannedObject reportedObject(const ObjectPlan& object, const engine::LensCells& cells) {
    PlannedObject reported;
    reported.name = object.name;
    reported.nearestDepth = object.nearestDepth;
    reported.farthestDepth = object.farthestDepth;
    reported.nearestCoc = object.coc.nearest;
    reported.farthestCoc = object.coc.farthest;
    reported.smallestCoc = object.coc.smallest;
    reported.largestCoc = object.coc.largest;
    reported.projectedEdge = object.projectedEdge;
    reported.lambda = object.lambda;
    reported.pixelRate = engine::pixelRate(cells, object.coc.smallest);
    reported.blended = object.blended;
    reported.transmits = object.transmits;
    reported.moves = !object.motion.empty();
    for (const engine::LevelDraw& draw : {object.coarse, object.fine})
        if (draw.sampleCount > 0)
            reported.draws.push_back({draw.level, draw.triangleCount, draw.firstSample, draw.sampleCount});
    if (engine::boundarySample(object)) reported.boundaryShare = object.boundaryShare;
    return reported;
}

Vector3 columnOf(const glm::dmat4& matrix, int column) {
    const glm::dvec4& v = matrix[column];
    return {v.x, v.y, v.z};
}

LensSettings completeLens(const engine::Lens& lens) {
    LensSettings settings;
    for (const LensField& field : engine::lensFields())
        if (const double value = engine::lensFieldValue(lens, field);
            std::isfinite(value) && !std::holds_alternative<std::monostate>(field.given))
            engine::giveLensValue(settings, field, value);
    return settings;
}

Json jsonOf(const PlannedObject& object) {
    Json draws = Json::array();
    for (const PlannedDraw& draw : object.draws)
        draws.push_back({{"level", draw.level},
                         {"triangles", draw.triangles},
                         {"firstSample", draw.firstSample},
                         {"sampleCount", draw.sampleCount}});
    Json json = {{"name", object.name},
                 {"depth", {engine::jsonNumber(object.nearestDepth), engine::jsonNumber(object.farthestDepth)}},
                 {"coc",
                  {{"nearest", engine::jsonNumber(object.nearestCoc)},
                   {"farthest", engine::jsonNumber(object.farthestCoc)},
                   {"smallest", engine::jsonNumber(object.smallestCoc)},
                   {"largest", engine::jsonNumber(object.largestCoc)}}},
                 {"projectedEdge", engine::jsonNumber(object.projectedEdge)},
                 {"lambda", object.lambda},
                 {"pixelRate", object.pixelRate},
                 {"blended", object.blended},
                 {"transmits", object.transmits},
                 {"moves", object.moves},
                 {"draws", std::move(draws)}};
    if (object.boundaryShare) json["boundaryShare"] = *object.boundaryShare;
    return json;
}

Json lensNumber(const Plan& plan, const LensField& field) {
    if (std::holds_alternative<std::monostate>(field.given)) return engine::jsonNumber(plan.focusDistance);
    const std::optional<double> value = engine::givenLensValue(plan.lens, field);
    return value ? Json(*value) : Json();
}

Json lensJson(const Plan& plan) {
    Json json;
    for (const LensField& field : engine::lensFields()) json[field.name] = lensNumber(plan, field);
    json["apertureImage"] = plan.hasApertureImage;
    json["apertureDiameter"] = plan.apertureDiameter;
    json["used"] = plan.usesLens;
    return json;
}

Json shadowsJson(const Plan& plan) {
    Json maps = Json::array();
    for (const PlannedShadowMap& map : plan.shadowMaps)
        maps.push_back({{"light", map.light}, {"face", map.face}, {"lightSize", map.lightSize}});
    return {{"maps", std::move(maps)}, {"size", plan.shadowMapSize}, {"pointsPerSample", plan.shadowPoints}};
}

Json lodJson(const Plan& plan) {
    return {{"mode", engine::lodModeName(plan.lod)},
            {"metric", engine::lodMetricName(plan.lodMetric)},
            {"coc", plan.lodCoc == LodCoc::centre ? "centre" : "smallest"},
            {"vertices", engine::levelVerticesName(plan.levelVertices)},
            {"blurThreshold", plan.blurThreshold},
            {"sizeThreshold", plan.sizeThreshold},
            {"lightThreshold", plan.lightThreshold}};
}

}  // namespace

Plan engine::reportedPlan(const FramePlan& plan) {
    const LensCells cells = lensCells(plan);
    const auto& objects = plan.objects;
    Plan reported;
    reported.size = {plan.view.width, plan.view.height};
    reported.transparent = plan.needsAlpha;
    reported.cameraRight = columnOf(plan.view.worldFromCamera, 0);
    reported.cameraUp = columnOf(plan.view.worldFromCamera, 1);
    reported.cameraBack = columnOf(plan.view.worldFromCamera, 2);
    reported.cameraPosition = columnOf(plan.view.worldFromCamera, 3);
    reported.lens = completeLens(plan.view.lens);
    reported.hasApertureImage = plan.view.lens.apertureImage != nullptr;
    reported.focusDistance = plan.view.lens.focusDistance;
    reported.apertureDiameter = plan.apertureDiameter;
    reported.usesLens = plan.usesLens;
    reported.samples = static_cast<std::uint32_t>(plan.samples.size());
    reported.positions = plan.settings.positions;
    reported.sequence = plan.settings.sequence;
    reported.seed = plan.settings.seed;
    reported.cocTolerance = plan.settings.cocTolerance;
    reported.moments = engine::momentCount(plan);
    reported.movingObjects = engine::movingCount(plan);
    reported.lod = plan.settings.lod;
    reported.lodMetric = plan.settings.metric;
    reported.lodCoc = plan.settings.lodCoc;
    reported.levelVertices = plan.settings.levelVertices;
    reported.blurThreshold = plan.thresholds.blur;
    reported.sizeThreshold = plan.thresholds.size;
    reported.lightThreshold = plan.thresholds.light;
    for (const ShadowMap& map : plan.shadows.maps) reported.shadowMaps.push_back({map.light, map.face, map.lightSize});
    reported.shadowMapSize = plan.shadows.size;
    reported.shadowPoints = plan.shadows.points;
    reported.lensCellBlur = cells.blur;
    reported.lensCellReason = cells.reason;
    reported.accumulationReason = reasonForAccumulation(plan);
    for (const ObjectPlan& object : objects) reported.objects.push_back(reportedObject(object, cells));
    for (const LeftOut& part : plan.leftOut) reported.leftOut.push_back({part.what, part.reason});
    reported.trianglesDrawn = plan.trianglesDrawn;
    reported.trianglesFacingAway = plan.trianglesFacingAway;
    reported.trianglesOutside = plan.trianglesOutside;
    reported.trianglesAtFullDetail = plan.trianglesAtFullDetail;
    return reported;
}

Pyramid engine::reportedPyramid(const engine::Pyramid& pyramid, const std::string& name, std::size_t mesh) {
    defocus::Pyramid reported{
        name, mesh, glm::length(pyramid.bounds.size()), pyramid.repairedFaces, textOf(pyramid.end).name, {}};
    for (const engine::PyramidLevel& level : pyramid.levels)
        reported.levels.push_back({level.triangleCount, level.vertexCount, level.meanEdge, level.error});
    return reported;
}

Json engine::jsonOf(const defocus::Pyramid& pyramid) {
    Json json = {{"name", pyramid.name},         {"index", pyramid.mesh},
                 {"diagonal", pyramid.diagonal}, {"repairedFaces", pyramid.repairs},
                 {"end", pyramid.end},           {"levels", Json::array()}};
    for (const defocus::PyramidLevel& level : pyramid.levels)
        json["levels"].push_back({{"triangles", level.triangles},
                                  {"vertices", level.vertices},
                                  {"meanEdge", level.meanEdge},
                                  {"error", level.error}});
    return json;
}

std::string_view engine::endReason(PyramidEnd end) {
    return textOf(end).reason;
}

std::string toJson(const Plan& plan) {
    Json objects = Json::array();
    for (const PlannedObject& object : plan.objects) objects.push_back(jsonOf(object));
    Json leftOut = Json::array();
    for (const LeftOutPart& part : plan.leftOut) leftOut.push_back({{"what", part.what}, {"reason", part.reason}});
    return engine::documentText({{"image", {{"width", plan.size.width}, {"height", plan.size.height}}},
                                 {"transparent", plan.transparent},
                                 {"camera",
                                  {{"position", plan.cameraPosition},
                                   {"right", plan.cameraRight},
                                   {"up", plan.cameraUp},
                                   {"back", plan.cameraBack}}},
                                 {"lens", lensJson(plan)},
                                 {"samples", plan.samples},
                                 {"positions", plan.positions},
                                 {"sequence", engine::sequenceName(plan.sequence)},
                                 {"seed", plan.seed},
                                 {"cocTolerance", plan.cocTolerance},
                                 {"shutter", {{"moments", plan.moments}, {"movingObjects", plan.movingObjects}}},
                                 {"lod", lodJson(plan)},
                                 {"shadows", shadowsJson(plan)},
                                 {"lensCells", {{"blur", plan.lensCellBlur}, {"reason", plan.lensCellReason}}},
                                 {"accumulationReason", plan.accumulationReason},
                                 {"objects", std::move(objects)},
                                 {"leftOut", std::move(leftOut)},
                                 {"triangles",
                                  {{"drawn", plan.trianglesDrawn},
                                   {"facingAway", plan.trianglesFacingAway},
                                   {"outside", plan.trianglesOutside},
                                   {"fullDetail", plan.trianglesAtFullDetail}}}});
}

std::string toJson(const std::vector<Pyramid>& pyramids) {
    Json meshes = Json::array();
    for (const Pyramid& pyramid : pyramids) meshes.push_back(engine::jsonOf(pyramid));
    return engine::documentText({{"meshes", std::move(meshes)}});
}

}  // namespace defocus
