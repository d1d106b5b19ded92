#include "gl/context.h"

// include epoxy before EGL's headers
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "core/error.h"
#include "gl/shader_cache.h"

namespace defocus::engine {

namespace {

const char* eglErrorName(EGLint code) {
    switch (code) {
        case EGL_SUCCESS:
            return "EGL_SUCCESS";
        case EGL_NOT_INITIALIZED:
            return "EGL_NOT_INITIALIZED";
        case EGL_BAD_ACCESS:
            return "EGL_BAD_ACCESS";
        case EGL_BAD_ALLOC:
            return "EGL_BAD_ALLOC";
        case EGL_BAD_ATTRIBUTE:
            return "EGL_BAD_ATTRIBUTE";
        case EGL_BAD_CONFIG:
            return "EGL_BAD_CONFIG";
        case EGL_BAD_CONTEXT:
            return "EGL_BAD_CONTEXT";
        case EGL_BAD_DISPLAY:
            return "EGL_BAD_DISPLAY";
        case EGL_BAD_MATCH:
            return "EGL_BAD_MATCH";
        case EGL_BAD_PARAMETER:
            return "EGL_BAD_PARAMETER";
        case EGL_BAD_SURFACE:
            return "EGL_BAD_SURFACE";
        default:
            return "an unknown EGL error";
    }
}

bool listed(const char* extensions, std::string_view name) {
    const std::string_view all = extensions != nullptr ? extensions : "";
    for (std::size_t at = all.find(name); at != std::string_view::npos; at = all.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
    }
    return false;
}

// EGL display to try. The display is created only when it is tried, because creation may load a driver.
struct Candidate {
    std::string name;
    EGLenum platform = EGL_NONE;  // type of the display; EGL_NONE: default display
    void* native = nullptr;
    std::string missing = {};  // reason why this display is unavailable; empty if available
};

// Returns the EGL devices, GPUs before software rasterizers. If there are no devices, returns one candidate with the
// reason in `missing`.
std::vector<Candidate> devices(const char* extensions) {
    const auto none = [](std::string why) {
        return std::vector<Candidate>{{"EGL devices", EGL_PLATFORM_DEVICE_EXT, nullptr, std::move(why)}};
    };
    for (const char* needed : {"EGL_EXT_platform_base", "EGL_EXT_platform_device"})
        if (!listed(extensions, needed)) return none(fmt::format("the driver does not support {}", needed));
    if (!listed(extensions, "EGL_EXT_device_enumeration") && !listed(extensions, "EGL_EXT_device_base"))
        return none("the driver does not support EGL_EXT_device_enumeration");
    std::array<EGLDeviceEXT, 32> found{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(found.size()), found.data(), &count) != EGL_TRUE)
        return none(fmt::format("eglQueryDevicesEXT: {}", eglErrorName(eglGetError())));
    if (count == 0) return none("none found");
    std::vector<Candidate> result, software;
    for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = found[static_cast<std::size_t>(i)];
        const bool isSoftware = listed(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
        Candidate candidate{fmt::format("EGL device {}{}", i, isSoftware ? " (software)" : ""), EGL_PLATFORM_DEVICE_EXT,
                            device};
        (isSoftware ? software : result).push_back(std::move(candidate));
    }
    result.insert(result.end(), software.begin(), software.end());
    return result;
}

std::vector<Candidate> candidates() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<Candidate> result = devices(extensions);
    constexpr const char* surfaceless = "EGL_MESA_platform_surfaceless";
    result.push_back(
        {"surfaceless platform", EGL_PLATFORM_SURFACELESS_MESA, nullptr,
         listed(extensions, surfaceless) ? "" : fmt::format("the driver does not support {}", surfaceless)});
    result.push_back({"default display", EGL_NONE, nullptr});
    return result;
}

class HeadlessContext final : public GlContext {
public:
    HeadlessContext() = default;
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;
    ~HeadlessContext() override { close(); }

    // Creates a context on one display. Returns an empty string on success; otherwise cleans up and returns the reason
    // for the failure.
    std::string open(const Candidate& candidate) {
        const std::string reason = tryOpen(candidate);
        if (!reason.empty()) close();
        return reason;
    }

    // Creates a context that shares objects with the thread's current EGL context. Throws Error if this fails.
    void share() {
        display_ = eglGetCurrentDisplay();
        const EGLContext current = eglGetCurrentContext();
        EGLint id = 0;
        eglQueryContext(display_, current, EGL_CONFIG_ID, &id);
        const EGLint attributes[] = {EGL_CONFIG_ID, id, EGL_NONE};
        EGLConfig config = EGL_NO_CONFIG_KHR;
        EGLint configs = 0;
        if (id != 0) eglChooseConfig(display_, attributes, &config, 1, &configs);
        createContext(configs > 0 ? config : EGL_NO_CONFIG_KHR, current);
        if (context_ == EGL_NO_CONTEXT)
            fail("cannot create an OpenGL context for another thread: {}; give --threads 1",
                 eglErrorName(eglGetError()));
        readDriver();
    }

    void makeCurrent() override {
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE ||
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            fail("cannot make the OpenGL context current on this thread: {}", eglErrorName(eglGetError()));
    }

    [[nodiscard]] const std::string& device() const override { return device_; }
    [[nodiscard]] const std::string& driver() const override { return driver_; }
    [[nodiscard]] bool software() const override { return software_; }
    [[nodiscard]] const std::vector<std::string>& log() const override { return log_; }
    std::vector<std::string>& log() { return log_; }

private:
    std::string tryOpen(const Candidate& candidate) {
        const auto failed = [](const char* call) { return fmt::format("{}: {}", call, eglErrorName(eglGetError())); };
        // Use eglGetPlatformDisplayEXT: libepoxy cannot resolve eglGetPlatformDisplay before a display exists.
        display_ = candidate.platform == EGL_NONE
                       ? eglGetDisplay(EGL_DEFAULT_DISPLAY)
                       : eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
        if (display_ == EGL_NO_DISPLAY) return failed("eglGetPlatformDisplayEXT");
        EGLint major = 0;
        EGLint minor = 0;
        if (eglInitialize(display_, &major, &minor) != EGL_TRUE) {
            display_ = EGL_NO_DISPLAY;
            return failed("eglInitialize");
        }
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return failed("eglBindAPI(EGL_OPENGL_API)");
        const EGLint configAttributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE,
                                           EGL_NONE};
        EGLConfig config = EGL_NO_CONFIG_KHR;
        EGLint configs = 0;
        const bool chosen =
            eglChooseConfig(display_, configAttributes, &config, 1, &configs) == EGL_TRUE && configs > 0;
        if (!chosen && !listed(eglQueryString(display_, EGL_EXTENSIONS), "EGL_KHR_no_config_context"))
            return failed("eglChooseConfig");
        createContext(chosen ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT);
        if (context_ == EGL_NO_CONTEXT) return failed("eglCreateContext (OpenGL 4.5 core)");
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            return failed("eglMakeCurrent without a surface");
        readDriver();
        return {};
    }

    void createContext(EGLConfig config, EGLContext shared) {
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display_, config, shared, attributes);
    }

    // Reads the device and driver names from the current context. share() calls this function while the context to
    // share with is current; both contexts have the same driver.
    void readDriver() {
        device_ = currentDevice();
        driver_ = currentDriver();
        software_ = currentIsSoftware();
    }

    void close() {
        if (display_ == EGL_NO_DISPLAY) return;
        if (context_ != EGL_NO_CONTEXT) {
            if (eglGetCurrentContext() == context_)
                eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display_, context_);
        }
        // Do not terminate the display: all contexts of the process share the EGL display, so others may still use it.
        context_ = EGL_NO_CONTEXT;
        display_ = EGL_NO_DISPLAY;
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    std::string device_;
    std::string driver_;
    bool software_ = false;
    std::vector<std::string> log_;
};

}  // namespace

CurrentContextKeeper::CurrentContextKeeper()
    : api_(eglQueryAPI()),
      display_(eglGetCurrentDisplay()),
      context_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)) {}

CurrentContextKeeper::~CurrentContextKeeper() {
    if (eglGetCurrentContext() != context_) {
        if (context_ != EGL_NO_CONTEXT)
            eglMakeCurrent(display_, draw_, read_, context_);
        else
            eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglBindAPI(api_);
}

std::string currentDevice() {
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

std::string currentDriver() {
    return reinterpret_cast<const char*>(glGetString(GL_VERSION));
}

bool currentIsSoftware() {
    const std::string device = currentDevice();
    return device.find("llvmpipe") != std::string::npos || device.find("softpipe") != std::string::npos ||
           device.find("SWR") != std::string::npos;
}

bool drawsInThreads(const std::string& device, const std::string& driver) {
    if (device.find("llvmpipe") == std::string::npos) return true;
    if (device.find("zink") != std::string::npos) return false;  // zink over lavapipe is untested, so assume no
    constexpr std::string_view mesa = "Mesa ";
    const std::size_t at = driver.find(mesa);
    int version = 0;
    if (at != std::string::npos)
        std::from_chars(driver.data() + at + mesa.size(), driver.data() + driver.size(), version);
    return version >= 25;
}

std::unique_ptr<GlContext> createHeadlessContext() {
    protectShaderCache();
    auto context = std::make_unique<HeadlessContext>();
    std::string reasons;
    for (const Candidate& candidate : candidates()) {
        const std::string reason = candidate.missing.empty() ? context->open(candidate) : candidate.missing;
        if (reason.empty()) {
            context->log().push_back(
                fmt::format("{}: {}, OpenGL {}", candidate.name, context->device(), context->driver()));
            return context;
        }
        context->log().push_back(fmt::format("{}: {}", candidate.name, reason));
        reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", candidate.name, reason);
    }
    fail("cannot create an OpenGL 4.5 context: {}; install a driver (Debian: libegl1 libgl1-mesa-dri)", reasons);
}

std::unique_ptr<GlContext> createSharedContext() {
    if (eglGetCurrentContext() == EGL_NO_CONTEXT) return nullptr;
    auto context = std::make_unique<HeadlessContext>();
    context->share();
    return context;
}

}  // namespace defocus::engine
