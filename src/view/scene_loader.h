#pragma once
// Opens scenes on threads of its own, pyramids included, while a window goes on.

#include <array>
#include <atomic>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "frame/prepared_frame.h"

namespace defocus {

// What can be shown of a scene before its pyramids are there.
struct ScenePreview {
    View view;
    std::vector<std::array<glm::dvec3, 8>> boxes;  // of the objects, world space
};

struct LoadedScene {
    Request options;
    std::unique_ptr<PreparedFrame> frame;  // null: it failed
    std::string fault;                     // why
    bool draft = false;                    // with coarse stand-ins for its pyramids: they follow, with the same scene
};

class SceneLoader {
public:
    SceneLoader() = default;
    // Stops what runs, at its next report of progress, and waits for it.
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    // Starts on a scene; one that is still being opened is given up, unless its draft is being shown.
    void open(const Request& options);
    // The scene once it is there, or its draft, or why it isn't; each is handed over once.
    std::optional<LoadedScene> take();

    [[nodiscard]] bool busy() const { return !jobs_.empty() && !jobs_.back()->cancelled; }
    [[nodiscard]] std::string name() const;   // of what is being opened
    [[nodiscard]] std::string stage() const;  // "fish", "pyramids" …
    [[nodiscard]] double share() const;       // done of the stage, 0 … 1
    [[nodiscard]] std::shared_ptr<const ScenePreview> preview() const;

private:
    struct Job {
        Request options;
        std::atomic<bool> cancelled = false;
        std::atomic<bool> done = false;
        bool draftTaken = false;
        bool taken = false;
        mutable std::mutex mutex;  // of what follows
        std::string stage = "opening";
        double share = 0;
        std::shared_ptr<const ScenePreview> preview;
        std::optional<LoadedScene> draft;
        LoadedScene result;
        std::jthread thread;
    };
    static void run(Job& job);

    std::vector<std::unique_ptr<Job>> jobs_;  // the last one counts, the others are being given up
};

}  // namespace defocus
