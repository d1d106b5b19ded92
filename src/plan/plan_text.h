#pragma once
// Formats a FramePlan as a text table. frame/report/plan_report.h formats it as JSON.

#include <string>

#include "plan/frame_plan.h"

namespace defocus::engine {

std::string planTable(const FramePlan& plan);

std::size_t movingCount(const FramePlan& plan);  // number of objects that move
std::size_t momentCount(const FramePlan& plan);  // number of shutter times; 0 if nothing moves

}  // namespace defocus::engine
