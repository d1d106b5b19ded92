#include "cli/commands/turntable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>

#include "core/number_text.h"
#include "image/text.h"
#include "plan/frame_plan.h"
#include "render/methods.h"
#include "scene/defaults.h"
#include "scene/posed_mesh.h"

namespace defocus::engine {

namespace {

// Camera for the images on the contact sheet; the elevation is in radians above the horizontal.
constexpr double viewElevation = glm::radians(14.0);
constexpr double viewTangent = 18.0 / 85;  // tan of half the horizontal field of view: an 85 mm lens on a 36 mm sensor
constexpr double viewFill = 0.9;           // fraction of the cell that the object may fill
constexpr double minAspect = 0.75;
constexpr double maxAspect = 1.6;
constexpr int cellArea = 320 * 240;  // width · height of a cell, px²

// Layout of the contact sheet, px.
constexpr int sheetMargin = 16;
constexpr int cellGap = 4;
constexpr int labelColumn = 210;
constexpr int titleSize = 22;        // font size, px
constexpr int textSize = 14;         // font size, px
constexpr float paperGrey = 0.018f;  // linear grey values
constexpr float inkGrey = 0.83f;
constexpr float quietGrey = 0.42f;

// Returns the axes of the camera, which looks slightly down at the object.
glm::dmat3 cameraAxes() {
    const glm::dvec3 z(0, std::sin(viewElevation), std::cos(viewElevation));
    const glm::dvec3 x(1, 0, 0);
    return {x, glm::cross(z, x), z};
}

Object turnedObject(const Object& object, const glm::dmat4& turn) {
    Object result = object;
    result.worldFromObject = turn * object.worldFromObject;
    for (glm::dmat4& joint : result.worldFromJoint) joint = turn * joint;
    return result;
}

// Calls `visit` for each view and each vertex, with the vertex's offset from `centre` in the axes of the camera.
template <typename Visit>
void forEachTurnedPoint(const Mesh& mesh, const std::vector<glm::dvec3>& points, const glm::dvec3& centre,
                        const Visit& visit) {
    const glm::dmat3 axes = cameraAxes();
    for (int i = 0; i < turntableViews; ++i) {
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 2 * std::numbers::pi * i / turntableViews, {0, 1, 0}));
        const glm::dmat3 cameraFromWorld = glm::transpose(axes) * turn;
        for (const Primitive& primitive : mesh.primitives)
            for (const std::uint32_t v : primitive.indices) {
                const glm::dvec3 offset = cameraFromWorld * (points[v] - centre);
                if (std::isfinite(offset.x + offset.y + offset.z)) visit(offset);
            }
    }
}

void paste(Image& sheet, const Image& picture, const TurntableCell& cell) {
    for (int y = 0; y < cell.height; ++y)
        for (int x = 0; x < cell.width; ++x) {
            const float* const from = picture.at(x, y);
            float* const to = sheet.at(cell.x + x, cell.y + y);
            for (int c = 0; c < 3; ++c) to[c] = from[c] + (1 - from[3]) * to[c];
        }
}

TurntableSheet emptySheet(std::size_t levels, const View& view) {
    const int top = sheetMargin + titleSize + textSize + 6 * cellGap;
    TurntableSheet sheet;
    for (std::size_t l = 0; l < levels; ++l) {
        std::vector<TurntableCell>& row = sheet.cells.emplace_back();
        for (int i = 0; i < turntableViews; ++i)
            row.push_back({sheetMargin + labelColumn + i * (view.width + cellGap),
                           top + static_cast<int>(l) * (view.height + cellGap), view.width, view.height});
    }
    const TurntableCell& last = sheet.cells.back().back();
    sheet.image = Image(last.x + last.width + sheetMargin, last.y + last.height + sheetMargin, 3);
    std::fill(sheet.image.pixels.begin(), sheet.image.pixels.end(), paperGrey);
    return sheet;
}

void writeLabels(TurntableSheet& sheet, const Pyramid& pyramid, const std::string& title) {
    Image& image = sheet.image;
    writeText(image, sheetMargin, sheetMargin + titleSize, title, titleSize, inkGrey);
    for (int i = 0; i < turntableViews; ++i) {
        const TurntableCell& cell = sheet.cells.front()[static_cast<std::size_t>(i)];
        writeText(image, cell.x, cell.y - 2 * cellGap, fmt::format("{}°", 360 * i / turntableViews), textSize,
                  quietGrey);
    }
    const double diagonal = glm::length(pyramid.bounds.size());
    for (std::size_t l = 0; l < sheet.cells.size(); ++l) {
        const PyramidLevel& level = pyramid.levels[l];
        int line = sheet.cells[l].front().y + titleSize;
        writeText(image, sheetMargin, line, fmt::format("Level {}", l), titleSize, inkGrey);
        const auto write = [&](const std::string& text, float grey) {
            line += textSize + 2 * cellGap;
            writeText(image, sheetMargin, line, text, textSize, grey);
        };
        write(fmt::format("{} triangle{}", grouped(level.triangleCount), level.triangleCount == 1 ? "" : "s"), inkGrey);
        if (l == 0) continue;
        write(fmt::format("error {:.3g}", level.error), inkGrey);
        if (diagonal > 0) write(fmt::format("{:.2g} % of diagonal", 100 * level.error / diagonal), quietGrey);
    }
}

}  // namespace

TurntableView turntableView(const Mesh& mesh, const Object& object) {
    // The object rotates about the vertical axis through the centre of its bounding box.
    const std::vector<glm::dvec3> points = posedPositions(mesh, object);
    Bounds box = posedBounds(mesh, object);
    if (box.empty()) box = {glm::dvec3(-1), glm::dvec3(1)};
    const glm::dvec3 centre = box.centre();
    const double smallest = 1e-6 * std::max(1.0, glm::length(centre));
    double aside = smallest;
    double up = smallest;
    double front = 0;
    forEachTurnedPoint(mesh, points, centre, [&](const glm::dvec3& offset) {
        aside = std::max(aside, std::abs(offset.x));
        up = std::max(up, std::abs(offset.y));
        front = std::max(front, offset.z);
    });

    // Choose a cell aspect that fits the object, and a camera distance at which the complete object is visible.
    const double aspect = std::clamp(aside / up, minAspect, maxAspect);
    TurntableView result;
    View& view = result.view;
    view.width = static_cast<int>(std::lround(std::sqrt(cellArea * aspect)));
    view.height = static_cast<int>(std::lround(view.width / aspect));
    const double tx = viewTangent;
    const double ty = tx * view.height / view.width;
    double distance = front + aside + up;
    forEachTurnedPoint(mesh, points, centre, [&](const glm::dvec3& offset) {
        distance = std::max({distance, offset.z + std::abs(offset.x) / (viewFill * tx),
                             offset.z + std::abs(offset.y) / (viewFill * ty)});
    });

    const glm::dmat3 axes = cameraAxes();
    view.worldFromCamera = glm::dmat4(axes);
    view.worldFromCamera[3] = glm::dvec4(centre + distance * axes[2], 1);
    view.nearPlane = 0.5 * (distance - front);
    view.lens.dofEnabled = false;
    view.lens.focalLength = 0.5 * view.lens.horizontalAperture / viewTangent;
    view.lens.focusDistance = distance;
    for (int i = 0; i < turntableViews; ++i) {
        const double angle = 2 * std::numbers::pi * i / turntableViews;
        result.worldTurn.push_back(glm::rotate(glm::translate(glm::dmat4(1), centre), angle, {0, 1, 0}) *
                                   glm::translate(glm::dmat4(1), -centre));
    }
    return result;
}

RenderSettings settingsForLevel(const World& world, const View& view, std::uint32_t level) {
    RenderSettings settings{
        .sampleCount = antialiasingSamples, .lod = LodMode::nearest, .metric = LodMetric::error, .thresholds = {0, 0}};
    const FramePlan finest = planFrame(world, view, settings);
    for (const ObjectPlan& object : finest.objects) {
        const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
        const double finestEdge = pyramid.levels.front().meanEdge;
        if (finestEdge > 0) settings.thresholds.size = pyramid.levels[level].error * object.projectedEdge / finestEdge;
    }
    return settings;
}

TurntableSheet turntableSheet(World& world, const Object& object, const std::string& title,
                              const std::filesystem::path& shaderFolder, const Progress& progress) {
    const auto mesh = static_cast<std::size_t>(object.mesh);
    const Pyramid& pyramid = world.pyramids[mesh];
    const TurntableView look = turntableView(world.scene->meshes[mesh], object);

    // Use the default lights, even if the scene has lights.
    world.pose = {};
    world.pose.objects = {object};
    world.pose.bounds = posedBounds(world.scene->meshes[mesh], object);
    PlacedCamera camera;
    camera.worldFromCamera = look.view.worldFromCamera;
    world.lights = lightsOrDefault(*world.scene, world.pose, camera);

    const RendererOptions options{.shaderFolder = shaderFolder};
    const std::unique_ptr<Renderer> renderer = methodNamed("accumulation").make(world, options);
    TurntableSheet sheet = emptySheet(pyramid.levels.size(), look.view);
    for (std::size_t i = 0; i < look.worldTurn.size(); ++i) {
        world.pose.objects.front() = turnedObject(object, look.worldTurn[i]);
        for (std::uint32_t l = 0; l < pyramid.levels.size(); ++l) {
            const FramePlan plan = planFrame(world, look.view, settingsForLevel(world, look.view, l));
            paste(sheet.image, imageOf(*renderer, plan), sheet.cells[l][i]);
            report(progress, "views", i * pyramid.levels.size() + l + 1, look.worldTurn.size() * pyramid.levels.size());
        }
    }
    writeLabels(sheet, pyramid, title);
    return sheet;
}

}  // namespace defocus::engine
