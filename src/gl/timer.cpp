#include "gl/timer.h"

namespace defocus::engine {

namespace {

GlHandle<destroyQuery> timestamp() {
    GLuint name = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &name);
    glQueryCounter(name, GL_TIMESTAMP);
    return GlHandle<destroyQuery>(name);
}

GLuint64 nanoseconds(const GlHandle<destroyQuery>& query) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &value);
    return value;
}

}  // namespace

void waitForGpu() {
    glFinish();
}

void GpuTimer::begin() {
    pending_.push_back(timestamp());
}

void GpuTimer::end() {
    pending_.push_back(timestamp());
}

double GpuTimer::milliseconds() {
    for (std::size_t i = 0; i + 1 < pending_.size(); i += 2) {
        const GLuint64 begin = nanoseconds(pending_[i]);
        const GLuint64 end = nanoseconds(pending_[i + 1]);
        if (end > begin) total_ += static_cast<double>(end - begin) * 1e-6;
    }
    pending_.clear();
    return total_;
}

void GpuTimer::reset() {
    pending_.clear();
    total_ = 0;
}

}  // namespace defocus::engine
