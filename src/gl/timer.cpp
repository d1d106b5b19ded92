#include "gl/timer.h"

namespace defocus {

void GpuTimer::begin() {
    GLuint name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    pending_.emplace_back(name);
    glBeginQuery(GL_TIME_ELAPSED, name);
}

void GpuTimer::end() {
    glEndQuery(GL_TIME_ELAPSED);
}

double GpuTimer::milliseconds() {
    for (const auto& query : pending_) {
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &nanoseconds);
        total_ += static_cast<double>(nanoseconds) * 1e-6;
    }
    pending_.clear();
    return total_;
}

void GpuTimer::reset() {
    pending_.clear();
    total_ = 0;
}

}  // namespace defocus
