#include "view/export/still_export.h"

#include <limits>

#include "core/file.h"
#include "core/stopwatch.h"
#include "frame/render_report.h"

namespace defocus {

StillExport::StillExport(const PreparedFrame& frame, const StillRequest& request)
    : frame_(&frame), request_(request), use_(chosenMethod(request.options)), begin_(std::chrono::steady_clock::now()) {
    checkImageExtension(request.output);
    checkWritable(request.output);
    checkStop(request.options);
    RendererOptions options;
    options.layerFormat = request.options.layerFormat;
    options.wave = request.options.wave > 0 ? request.options.wave : (request.software ? 2 : 8);
    options.shaderFolder = request.shaderFolder;
    options.settings = use_.settings;
    renderer_ = use_.method->make(frame.world, options);
    run_.emplace(frame.world, *renderer_);
    run_->start(request.view, request.options.settings, request.options.stop);
}

bool StillExport::step() {
    if (run_->advance()) return true;
    finish();
    return false;
}

double StillExport::share() const {
    return static_cast<double>(run_->samples()) / run_->sampleTotal();
}

double StillExport::secondsLeft() const {
    const double done = share();
    return done > 0 ? 1e-3 * millisecondsSince(begin_) * (1 - done) / done : std::numeric_limits<double>::infinity();
}

void StillExport::finish() {
    const Image image = renderer_->image();
    const double milliseconds = millisecondsSince(begin_);
    const RenderReport report{request_.options, use_.text(),       *frame_,     run_->plan(),
                              run_->stats(),    request_.software, milliseconds};
    writeImage(request_.output, image, renderMetadata(report), request_.write);
}

}  // namespace defocus
