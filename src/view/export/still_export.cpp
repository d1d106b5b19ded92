#include "view/export/still_export.h"

#include <limits>
#include <utility>

#include "core/file.h"
#include "core/stopwatch.h"

namespace defocus::engine {

StillExport::StillExport(const PreparedFrame& frame, const View& view, const Request& request,
                         std::filesystem::path output, std::filesystem::path shaderFolder)
    : output_(std::move(output)), driver_(frame, request, std::move(shaderFolder)), begin_(Clock::now()) {
    checkImageExtension(output_);
    checkWritable(output_);
    checkStop(request);
    FrameMoment moment = momentOf(frame, request);
    moment.view = view;
    moment.settings = renderSettings(request);
    driver_.pose(request, moment);
    driver_.start({.shortDraws = true});
}

bool StillExport::step() {
    if (driver_.advance()) return true;
    driver_.write(output_, driver_.image());
    return false;
}

double StillExport::secondsLeft() const {
    const double done = share();
    return done > 0 ? 1e-3 * millisecondsSince(begin_) * (1 - done) / done : std::numeric_limits<double>::infinity();
}

}  // namespace defocus::engine
