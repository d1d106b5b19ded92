#include "scene/camera_files/usda_values.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "core/error.h"

namespace defocus::engine {

namespace {

// Returns the interpolated numbers; empty if the attribute has no value. Quaternions (w, x, y, z) are interpolated
// spherically.
std::vector<double> numbersAt(const UsdAttribute& attribute, double timeCode, bool quaternion) {
    const auto& samples = attribute.samples;
    if (samples.empty()) return attribute.value.numbers;
    const auto after = std::ranges::upper_bound(samples, timeCode, {}, &std::pair<double, UsdValue>::first);
    if (after == samples.begin()) return samples.front().second.numbers;
    const auto before = after - 1;
    const std::vector<double>& a = before->second.numbers;
    if (after == samples.end() || after->second.numbers.size() != a.size()) return a;
    const std::vector<double>& b = after->second.numbers;
    const double share = (timeCode - before->first) / (after->first - before->first);
    if (quaternion && a.size() == 4) {
        const glm::dquat mixed =
            glm::slerp(glm::dquat(a[0], a[1], a[2], a[3]), glm::dquat(b[0], b[1], b[2], b[3]), share);
        return {mixed.w, mixed.x, mixed.y, mixed.z};
    }
    std::vector<double> mixed(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) mixed[i] = a[i] + share * (b[i] - a[i]);
    return mixed;
}

// Returns the matrix of Euler angles in degrees. `order` names the axes; the rotation about the first axis is applied
// first.
glm::dmat4 eulerMatrix(std::string_view order, const std::vector<double>& degrees) {
    glm::dmat4 result(1.0);
    for (const char axis : order) {
        const auto number = static_cast<glm::length_t>(axis - 'X');
        glm::dvec3 direction(0);
        direction[number] = 1;
        result =
            glm::rotate(glm::dmat4(1.0), glm::radians(degrees[static_cast<std::size_t>(number)]), direction) * result;
    }
    return result;
}

bool isAxisOrder(std::string_view text) {
    std::string sorted(text);
    std::ranges::sort(sorted);
    return sorted == "XYZ";
}

// Returns the matrix of a transform operation such as "xformOp:rotateXYZ:suffix".
glm::dmat4 operation(const UsdPrim& prim, const std::string& name, double timeCode, const std::string& where) {
    const std::size_t begin = name.find(':') + 1;
    const std::string type = name.substr(begin, std::min(name.find(':', begin), name.size()) - begin);
    const auto numbers = [&](std::size_t count) {
        auto found = usdNumbers(prim, name, count, timeCode, where);
        if (!found) fail("{}: {} is listed in xformOpOrder but has no value", where, name);
        return *found;
    };
    const auto vector = [&] {
        const std::vector<double> found = numbers(3);
        return glm::dvec3(found[0], found[1], found[2]);
    };
    if (type == "translate") return glm::translate(glm::dmat4(1.0), vector());
    if (type == "scale") return glm::scale(glm::dmat4(1.0), vector());
    if (type == "transform") return glm::make_mat4(numbers(16).data());  // rows of USD are columns of GLM
    if (type == "orient") {
        const std::vector<double> q = numbers(4);
        const glm::dquat rotation(q[0], q[1], q[2], q[3]);
        if (!(glm::length(rotation) > 0)) fail("{}: {} is zero", where, name);
        return glm::mat4_cast(glm::normalize(rotation));
    }
    const std::string axes = type.starts_with("rotate") ? type.substr(6) : "";
    if (isAxisOrder(axes)) return eulerMatrix(axes, numbers(3));
    if (axes == "X" || axes == "Y" || axes == "Z") {
        std::vector<double> degrees(3);
        degrees[static_cast<std::size_t>(axes[0] - 'X')] = numbers(1)[0];
        return eulerMatrix(axes, degrees);
    }
    fail("{}: the transform {} is not supported", where, name);
}

}  // namespace

std::optional<std::vector<double>> usdNumbers(const UsdPrim& prim, std::string_view name, std::size_t count,
                                              double timeCode, const std::string& where) {
    const auto found = prim.attributes.find(name);
    if (found == prim.attributes.end()) return {};
    std::vector<double> numbers = numbersAt(found->second, timeCode, name.find("orient") != std::string_view::npos);
    if (numbers.empty() && found->second.value.texts.empty()) return {};
    if (numbers.size() != count || !std::ranges::all_of(numbers, [](double value) { return std::isfinite(value); }))
        fail("{}: {} must be {}", where, name, count == 1 ? "a number" : fmt::format("{} finite numbers", count));
    return numbers;
}

double usdNumber(const UsdPrim& prim, std::string_view name, double timeCode, double otherwise,
                 const std::string& where) {
    const auto found = usdNumbers(prim, name, 1, timeCode, where);
    return found ? found->front() : otherwise;
}

std::string usdText(const UsdPrim& prim, std::string_view name) {
    const auto found = prim.attributes.find(name);
    return found == prim.attributes.end() || found->second.value.texts.empty() ? "" : found->second.value.texts.front();
}

UsdTransform usdTransform(const UsdPrim& prim, double timeCode, const std::string& where) {
    UsdTransform result;
    const auto order = prim.attributes.find("xformOpOrder");
    if (order == prim.attributes.end()) return result;
    constexpr std::string_view inverse = "!invert!";
    for (const std::string& name : order->second.value.texts) {
        if (name == "!resetXformStack!") {
            result = {glm::dmat4(1.0), true};
        } else if (name.starts_with(inverse)) {
            const glm::dmat4 matrix = operation(prim, name.substr(inverse.size()), timeCode, where);
            if (glm::determinant(matrix) == 0) fail("{}: {} cannot be inverted", where, name);
            result.parentFromPrim *= glm::inverse(matrix);
        } else {
            result.parentFromPrim *= operation(prim, name, timeCode, where);
        }
    }
    return result;
}

}  // namespace defocus::engine
