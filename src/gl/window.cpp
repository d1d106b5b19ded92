#include "gl/window.h"

#include <epoxy/gl.h>
// include GLFW after epoxy
#include <GLFW/glfw3.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "core/error.h"
#include "gl/context.h"
#include "gl/shader_cache.h"
#include "image/tone_map.h"

namespace defocus::engine {

namespace {

static_assert(key::escape == GLFW_KEY_ESCAPE && key::enter == GLFW_KEY_ENTER && key::tab == GLFW_KEY_TAB);
static_assert(key::right == GLFW_KEY_RIGHT && key::up == GLFW_KEY_UP && key::home == GLFW_KEY_HOME);
static_assert(key::f1 == GLFW_KEY_F1 && key::f12 == GLFW_KEY_F12 && key::f11 == GLFW_KEY_F11 &&
              key::lastModifier == GLFW_KEY_RIGHT_SUPER && key::leftShift == GLFW_KEY_LEFT_SHIFT);
static_assert(key::rightShift == GLFW_KEY_RIGHT_SHIFT && key::leftControl == GLFW_KEY_LEFT_CONTROL &&
              key::rightControl == GLFW_KEY_RIGHT_CONTROL && GLFW_KEY_A == 'A' && GLFW_KEY_SLASH == '/');

std::string lastFault() {
    const char* words = nullptr;
    glfwGetError(&words);
    return words != nullptr ? words : "no reason given";
}

constexpr const char* withoutWindow =
    "start the program in a desktop session, or use 'defocus render', which needs no display";

Window* owner(GLFWwindow* window) {
    return static_cast<Window*>(glfwGetWindowUserPointer(window));
}

// Returns the screen with the largest overlap with a rectangle in screen coordinates; nullptr if none overlaps.
GLFWmonitor* screenOf(const glm::ivec2& position, const glm::ivec2& size) {
    int count = 0;
    GLFWmonitor* const* const screens = glfwGetMonitors(&count);
    GLFWmonitor* best = nullptr;
    int max = -1;
    for (int i = 0; i < count; ++i) {
        const GLFWvidmode* const mode = glfwGetVideoMode(screens[i]);
        glm::ivec2 begin(0);
        glfwGetMonitorPos(screens[i], &begin.x, &begin.y);
        if (mode == nullptr) continue;
        const glm::ivec2 end = glm::min(position + size, begin + glm::ivec2(mode->width, mode->height));
        const glm::ivec2 common = glm::max(end - glm::max(position, begin), glm::ivec2(0));
        if (common.x * common.y > max) {
            max = common.x * common.y;
            best = screens[i];
        }
    }
    return best;
}

void setModifiers(WindowEvent& event, int modifiers) {
    event.shift = (modifiers & GLFW_MOD_SHIFT) != 0;
    event.control = (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0;
    event.alt = (modifiers & GLFW_MOD_ALT) != 0;
}

int heldModifiers(GLFWwindow* window) {
    const auto held = [&](int left, int right, int bit) {
        return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS ? bit : 0;
    };
    return held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT) |
           held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL) |
           held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT);
}

}  // namespace

Window::Window(const WindowOptions& options) {
    protectShaderCache();
    if (glfwInit() != GLFW_TRUE) fail("cannot open a window: {}; {}", lastFault(), withoutWindow);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string reason = lastFault();
        glfwTerminate();
        fail("cannot open a window with OpenGL 4.5: {}; {}", reason, withoutWindow);
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    device_ = currentDevice();
    software_ = currentIsSoftware();
    installCallbacks();
    readSizes();
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::installCallbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        owner(window)->mouse_ = {x, y};
        WindowEvent& event = owner(window)->add(WindowEvent::Type::move);
        setModifiers(event, heldModifiers(window));
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
        if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
        WindowEvent& event = owner(window)->add(WindowEvent::Type::button);
        event.button = static_cast<MouseButton>(button);
        event.pressed = action == GLFW_PRESS;
        setModifiers(event, modifiers);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
        WindowEvent& event = owner(window)->add(WindowEvent::Type::scroll);
        event.scroll = {x, y};
        setModifiers(event, heldModifiers(window));
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int code, int, int action, int modifiers) {
        WindowEvent& event = owner(window)->add(WindowEvent::Type::key);
        event.key = code;
        event.pressed = action != GLFW_RELEASE;
        event.repeated = action == GLFW_REPEAT;
        setModifiers(event, modifiers);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned letter) {
        owner(window)->add(WindowEvent::Type::text).letter = letter;
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        WindowEvent& event = owner(window)->add(WindowEvent::Type::drop);
        event.paths.assign(paths, paths + count);
    });
}

WindowEvent& Window::add(WindowEvent::Type type) {
    WindowEvent& event = events_.emplace_back();
    event.type = type;
    event.position = mouse_;  // latest mouse position; GLFW passes none with key and button events
    return event;
}

std::vector<WindowEvent> Window::poll(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    readSizes();
    return std::exchange(events_, {});
}

bool Window::closing() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

bool Window::hovered() const {
    return glfwGetWindowAttrib(window_, GLFW_HOVERED) == GLFW_TRUE;
}

bool Window::focused() const {
    return glfwGetWindowAttrib(window_, GLFW_FOCUSED) == GLFW_TRUE;
}

bool Window::fullscreen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::setFullscreen(bool on) {
    if (on == fullscreen()) return;
    if (!on) {
        glfwSetWindowMonitor(window_, nullptr, windowedPosition_.x, windowedPosition_.y, windowedSize_.x,
                             windowedSize_.y, GLFW_DONT_CARE);
        return;
    }
    glfwGetWindowPos(window_, &windowedPosition_.x, &windowedPosition_.y);
    windowedSize_ = size();
    GLFWmonitor* const screen = screenOf(windowedPosition_, windowedSize_);
    const GLFWvidmode* const mode = screen != nullptr ? glfwGetVideoMode(screen) : nullptr;
    if (mode == nullptr) fail("cannot switch to full screen: no monitor found");
    glfwSetWindowMonitor(window_, screen, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::readSizes() {
    constexpr int maxTries = 8;
    const auto windowSize = [&] {
        glm::ivec2 result(0);
        glfwGetWindowSize(window_, &result.x, &result.y);
        return result;
    };
    glm::ivec2 before;
    int tries = 0;
    do {
        before = windowSize();
        glfwGetFramebufferSize(window_, &framebufferSize_.x, &framebufferSize_.y);
        size_ = windowSize();
    } while (size_ != before && ++tries < maxTries);
}

double Window::contentScale() const {
    float x = 1;
    float y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    // Divide by the pixels per window unit: on some systems, window units already follow the screen's scale.
    const double pixels = static_cast<double>(framebufferSize().x) / std::max(1, size().x);
    return std::clamp(pixels > 0 ? static_cast<double>(x) / pixels : 1.0, 0.5, 4.0);
}

void Window::beginFrame(const glm::vec3& color) {
    const glm::ivec2 area = framebufferSize();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, area.x, area.y);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glFrontFace(GL_CCW);
    glDepthMask(GL_TRUE);
    glClearColor(color.r, color.g, color.b, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

void Window::endFrame() {
    glfwSwapBuffers(window_);
}

Image Window::pixels() const {
    const glm::ivec2 area = framebufferSize();
    Image image(area.x, area.y, 3);
    std::vector<unsigned char> bytes(image.pixels.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, area.x, area.y, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
    const std::size_t row = static_cast<std::size_t>(area.x) * 3;
    for (int y = 0; y < area.y; ++y)
        for (std::size_t i = 0; i < row; ++i)
            image.at(0, area.y - 1 - y)[i] =
                srgbDecode(static_cast<float>(bytes[static_cast<std::size_t>(y) * row + i]) / 255.0f);
    return image;
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

}  // namespace defocus::engine
