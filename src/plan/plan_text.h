#pragma once
// Formats a FramePlan as a text table. frame/report/plan_report.h formats it as JSON.

#include <string>

#include "plan/frame_plan.h"

namespace defocus::engine {

std::string planTable(const FramePlan& plan);

}  // namespace defocus::engine
