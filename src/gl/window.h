#pragma once
// Window (GLFW) with an OpenGL 4.5 core context, current on the creating thread. Input events are queued in order, so
// that slow frames lose none.

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "image/image.h"

struct GLFWwindow;

namespace defocus::engine {

// Key codes, equal to GLFW's. Keys of letters, digits and punctuation have the ASCII code (upper case) of a US
// keyboard; the other keys have these constants.
namespace key {
inline constexpr int escape = 256;
inline constexpr int enter = 257;
inline constexpr int tab = 258;
inline constexpr int right = 262;
inline constexpr int left = 263;
inline constexpr int down = 264;
inline constexpr int up = 265;
inline constexpr int home = 268;
inline constexpr int f1 = 290;
inline constexpr int f11 = 300;
inline constexpr int f12 = 301;
inline constexpr int leftShift = 340;
inline constexpr int leftControl = 341;
inline constexpr int rightShift = 344;
inline constexpr int rightControl = 345;
inline constexpr int lastModifier = 347;
}  // namespace key

enum class MouseButton { left, right, middle };

struct WindowEvent {
    enum class Type { button, move, scroll, key, text, drop };
    Type type = Type::move;
    glm::dvec2 position{0.0};  // mouse position in window units from the top left
    MouseButton button = MouseButton::left;
    bool pressed = false;    // true: pressed, false: released; for button and key events
    bool repeated = false;   // for key events: the key is held down
    glm::dvec2 scroll{0.0};  // wheel steps; x > 0: left, y > 0: away from the user
    int key = 0;             // code of the key, for key events
    char32_t letter = 0;     // Unicode character, for text events
    bool shift = false, control = false, alt = false;
    std::vector<std::filesystem::path> paths;  // dropped files and folders, for drop events
};

struct WindowOptions {
    int width = 1280;  // window width in px on a standard screen; larger on high-density screens
    int height = 800;
    std::string title = "defocus";
};

class Window {
public:
    // Opens the window; at most one per process. Throws Error without a display or without OpenGL 4.5.
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Returns the events since the last call; waits up to `seconds` for the first event.
    std::vector<WindowEvent> poll(double seconds);
    [[nodiscard]] bool closing() const;
    void close();
    [[nodiscard]] bool hovered() const;
    [[nodiscard]] bool focused() const;

    [[nodiscard]] bool fullscreen() const;
    // If `on`, covers the window's current screen; otherwise restores the previous position and size.
    void setFullscreen(bool on);

    // size() and framebufferSize() are read during the same poll(), so that they match.
    [[nodiscard]] glm::ivec2 size() const { return size_; }                        // size in window units
    [[nodiscard]] glm::ivec2 framebufferSize() const { return framebufferSize_; }  // size in px; 0 x 0 while minimised
    [[nodiscard]] double contentScale() const;  // scale for text and controls; 1 on a standard screen

    // Binds the window's framebuffer and clears it to the display-encoded `color`.
    void beginFrame(const glm::vec3& color);
    void endFrame();
    // Returns the current framebuffer as linear RGB.
    [[nodiscard]] Image pixels() const;

    void setTitle(const std::string& title);
    void setClipboard(const std::string& text);
    [[nodiscard]] GLFWwindow* native() const { return window_; }
    [[nodiscard]] const std::string& device() const { return device_; }
    [[nodiscard]] bool software() const { return software_; }  // true if OpenGL renders on the CPU

private:
    void installCallbacks();
    // Updates size_ and framebufferSize_ together: during a resize, GLFW may report one old and one new size.
    void readSizes();
    WindowEvent& add(WindowEvent::Type type);

    GLFWwindow* window_ = nullptr;
    std::vector<WindowEvent> events_;
    glm::dvec2 mouse_{0.0};
    glm::ivec2 size_{0}, framebufferSize_{0};
    glm::ivec2 windowedPosition_{0}, windowedSize_{0};  // position and size to restore after full screen
    std::string device_;
    bool software_ = false;
};

}  // namespace defocus::engine
