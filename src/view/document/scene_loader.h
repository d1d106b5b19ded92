#pragma once
// Opens scenes and builds their level-of-detail pyramids on background threads.

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
    std::unique_ptr<PreparedFrame> frame;  // null: the scene could not be opened
    std::string fault;                     // why the scene could not be opened
    bool draft = false;                    // true: the level-of-detail pyramids are coarse drafts; final ones follow
};

class SceneLoader {
public:
    SceneLoader() = default;
    // Cancels all jobs and waits for them. A cancelled job ends when it next reports progress.
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    // Starts opening a scene in a new job. Cancels all earlier jobs that have not yet delivered a draft, that is, a
    // scene with coarse pyramids.
    void open(const Request& options);
    // Returns the next result: a draft, the final scene, or a failure. Returns each result once; nullopt if there is no
    // new result.
    std::optional<LoadedScene> take();

    [[nodiscard]] bool busy() const { return !jobs_.empty() && !jobs_.back()->cancelled; }
    struct Opening {
        std::string name;
        std::string stage;  // what is loaded or built, such as "fish" or "pyramids"
        double share = 0;   // finished fraction of the loading stage, 0 … 1
    };
    // Returns the progress of the current job; nullopt if the loader is idle.
    [[nodiscard]] std::optional<Opening> opening() const;

private:
    struct Job {
        Request options;
        std::atomic<bool> cancelled = false;
        bool draftTaken = false;
        mutable std::mutex mutex;  // guards `opening`, `ready` and `ended`
        Opening opening;
        std::optional<LoadedScene> ready;  // next result for take()
        bool ended = false;
        std::jthread thread;
    };
    static void run(Job& job);

    // The last job is the current one. Earlier jobs are cancelled, or are still building the final pyramids that
    // replace a draft.
    std::vector<std::unique_ptr<Job>> jobs_;
};

}  // namespace defocus::engine
