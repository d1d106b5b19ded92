#pragma once
// Holds a loaded scene that several requests share, and changes copies of it for each request.

#include <memory>

#include "core/progress.h"
#include "frame/request.h"
#include "scene/scene.h"

namespace defocus::engine {

class SharedScene {
public:
    // Loads the scene that the request names (loadScene), opens its camera file, sets its unit, and replaces its points
    // and lines by triangles, one pixel wide in the request's view; see scene/strokes.h. Throws Error in the cases of
    // loadScene, and if the camera file can't be used.
    SharedScene(const Request& request, const Progress& progress);
    // Uses a scene whose unit and camera file are already set, and never changes it.
    SharedScene(std::shared_ptr<const Scene> scene, const Request& request);

    [[nodiscard]] std::shared_ptr<const Scene> loaded() const { return loaded_; }

    // Returns the scene with the unit, camera file, node blur and ground of the request: the loaded scene, the scene of
    // the previous call, or a changed copy. Throws Error for a node that the scene doesn't have, and if the camera file
    // can't be used.
    [[nodiscard]] std::shared_ptr<Scene> of(const Request& request);

private:
    std::shared_ptr<Scene> loaded_;  // may be shared with other owners
    std::shared_ptr<Scene> latest_;  // result of the previous call of of(); null before the first call
    Request request_;                // request of that call
};

// Loads the scene that a request names, or builds the built-in school of fish. Throws Error if the file can't be read,
// or if Request::strict is set and damageWarnings isn't empty.
Scene loadScene(const Request& request, const Progress& progress = {});

// Scales the blur of the nodes that the request lists. Throws Error for a node that the scene doesn't have.
void setNodeBlur(const Request& request, Scene& scene);

// Adds the ground that the request asks for, unless the scene has a ground. The ground lies beneath the scene's pose at
// the start of the animation, so that all frames of a shot share it. The scene's unit must already be set.
void setGround(const Request& request, Scene& scene);

}  // namespace defocus::engine
