#pragma once
// Opens scenes and builds their pyramids on background threads.

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "frame/setup/prepared_frame.h"

namespace defocus::engine {

struct LoadedScene {
    Request options;
    std::unique_ptr<PreparedFrame> frame;  // null: opening failed
    std::string fault;                     // reason of the failure
    bool draft = false;                    // coarse meshes; the same scene with its pyramids follows
};

class SceneLoader {
public:
    SceneLoader() = default;
    // Cancels all jobs, at their next report of progress, and waits for them.
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    // Starts a job; cancels jobs that have delivered no draft yet.
    void open(const Request& options);
    // Returns the next result: a draft, the scene, or a failure. Each is returned once.
    std::optional<LoadedScene> take();

    [[nodiscard]] bool busy() const { return !jobs_.empty() && !jobs_.back()->cancelled; }
    struct Opening {
        std::string name;   // name of the scene
        std::string stage;  // "fish", "pyramids" …
        double share = 0;   // progress of the stage, 0 … 1
    };
    // Returns the progress while the loader is busy.
    [[nodiscard]] std::optional<Opening> opening() const;

private:
    struct Job {
        Request options;
        std::atomic<bool> cancelled = false;
        bool draftTaken = false;
        mutable std::mutex mutex;  // guards the members below
        Opening opening;
        std::optional<LoadedScene> ready;  // the next result
        bool ended = false;
        std::jthread thread;
    };
    static void run(Job& job);

    std::vector<std::unique_ptr<Job>> jobs_;  // only the last job is active; the others are cancelled
};

}  // namespace defocus::engine
