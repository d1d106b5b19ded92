#include "view/export/still_export.h"

#include <limits>

#include "core/file.h"
#include "core/stopwatch.h"
#include "frame/report/render_report.h"

namespace defocus::engine {

StillExport::StillExport(const PreparedFrame& frame, const StillRequest& request)
    : frame_(&frame), request_(request), begin_(Clock::now()) {
    Request options = request.options;
    checkImageExtension(request.output);
    checkWritable(request.output);
    checkStop(options);
    // Small batches (waves) of lens samples keep the window responsive.
    options.wave = options.wave.value_or(request.software ? 2 : 8);
    driver_.emplace(frame.world, driverOptions(options, request.shaderFolder));
    driver_->start({request.view, renderSettings(options), stopSettings(options)});
}

bool StillExport::step() {
    if (driver_->advance()) return true;
    finish();
    return false;
}

double StillExport::secondsLeft() const {
    const double done = share();
    return done > 0 ? 1e-3 * millisecondsSince(begin_) * (1 - done) / done : std::numeric_limits<double>::infinity();
}

void StillExport::finish() {
    const RenderReport report{request_.options,  driver_->method().text(), *frame_, driver_->plan(), driver_->stats(),
                              request_.software, millisecondsSince(begin_)};
    writeImage(request_.output, driver_->image(), renderMetadata(report), request_.write);
}

}  // namespace defocus::engine
