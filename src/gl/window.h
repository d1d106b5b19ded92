#pragma once
// A window with an OpenGL 4.5 core context (GLFW), current on the thread that made it. What people do arrives as plain
// data, in order, so that nothing is lost however slow a frame is.

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "image/image.h"

struct GLFWwindow;

namespace defocus::engine {

// Letters, digits and marks are their ASCII codes on a US keyboard, capitals for letters; the others:
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
    glm::dvec2 position{0.0};  // of the mouse, in window units from the top left
    MouseButton button = MouseButton::left;
    bool pressed = false;    // button, key
    bool repeated = false;   // key: held down
    glm::dvec2 scroll{0.0};  // > 0: away from the person, to the left
    int key = 0;             // see above
    char32_t letter = 0;     // text: as the keyboard's layout has it
    bool shift = false, control = false, alt = false;
    std::vector<std::filesystem::path> paths;  // drop
};

struct WindowOptions {
    int width = 1280;  // units of the interface: on a dense screen the window has more px
    int height = 800;
    std::string title = "defocus";
};

class Window {
public:
    // Throws Error where there is no display or no OpenGL 4.5 on it. One window a process.
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // What has happened since the last call; waits up to `seconds` for something to happen.
    std::vector<WindowEvent> poll(double seconds);
    [[nodiscard]] bool closing() const;
    void close();
    [[nodiscard]] bool keyHeld(int keyCode) const;
    [[nodiscard]] bool hovered() const;  // the mouse is over it
    [[nodiscard]] bool focused() const;  // keys go to it

    [[nodiscard]] bool fullscreen() const;
    // Covers the screen that it is on, or goes back to where it was.
    void setFullscreen(bool on);

    // Of the latest poll(), both of one moment.
    [[nodiscard]] glm::ivec2 size() const { return size_; }                        // window units
    [[nodiscard]] glm::ivec2 framebufferSize() const { return framebufferSize_; }  // px; 0 x 0 while minimised
    [[nodiscard]] double contentScale() const;  // window units to one of the interface, 1 on a plain screen

    // Clears the window's framebuffer to display values and makes it the render target.
    void beginFrame(const glm::vec3& color);
    void endFrame();
    // The framebuffer as it is now, RGB, linear.
    [[nodiscard]] Image pixels() const;

    void setTitle(const std::string& title);
    void setClipboard(const std::string& text);
    [[nodiscard]] GLFWwindow* native() const { return window_; }
    [[nodiscard]] const std::string& device() const { return device_; }
    [[nodiscard]] bool software() const { return software_; }  // draws on the CPU

private:
    void installCallbacks();
    // A window that is just being given another size can have the old one in one answer and the new one in the next.
    void readSizes();
    WindowEvent& add(WindowEvent::Type type);

    GLFWwindow* window_ = nullptr;
    std::vector<WindowEvent> events_;
    glm::dvec2 mouse_{0.0};
    glm::ivec2 size_{0}, framebufferSize_{0};
    glm::ivec2 windowedPosition_{0}, windowedSize_{0};  // to which it goes back from the whole screen
    std::string device_;
    bool software_ = false;
};

}  // namespace defocus::engine
