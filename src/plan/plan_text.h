#pragma once
// Prints a FramePlan as a table. frame/report/plan_report.h has the JSON.

#include <string>

#include "plan/frame_plan.h"

namespace defocus::engine {

std::string planTable(const FramePlan& plan);

}  // namespace defocus::engine
