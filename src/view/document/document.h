#pragma once
// Loads the window's scene, applies the user's changes to it, and holds the world that is drawn.

#include "view/document/edit_history.h"
#include "view/document/scene_loader.h"
#include "view/state/view_state.h"

namespace defocus::engine {

struct Document {
    std::filesystem::path shaderFolder;  // replacement shaders; empty: the embedded shaders
    bool remembersFiles = true;          // true: each opened scene is added to the recent files

    SceneLoader loader;
    std::unique_ptr<PreparedFrame> frame;  // the scene, ready to draw; null: no scene is open
    bool draft = false;                    // true: `frame` has draft level-of-detail pyramids, not the final ones
    EditHistory history;
    Request shown;                           // request for which `frame` was last updated; see updateWorld
    bool poseIsStale = false;                // true: the objects must be posed again even if the request is unchanged
    std::vector<double> ownBlurs;            // Node::cocScale of each scene node, as loaded
    std::vector<glm::dmat4> shutterCameras;  // View::shutterCameras; empty unless the view follows the file's camera
    std::uint64_t poseVersion = 0;           // incremented when anything in the world moves
    std::uint64_t worldVersion = 0;          // incremented when GPU copies of the world must be rebuilt
};

// Starts to open a scene. Keeps samples, levels, method and environment of the current request.
void openScene(Document& document, const ViewState& state, const std::filesystem::path& scene);

// Takes over the result of the scene loader, if there is one. Returns whether a new scene was opened, which invalidates
// all references into Document::frame. Needs a current GL context.
bool takeLoadedScene(Document& document, ViewState& state);

// Returns the view that the window shows.
View currentView(const Document& document, const ViewState& state);

// Records the state for undo and redo. `held`: whether a mouse button or key is held down.
void noteEdit(Document& document, const ViewState& state, bool held);

// Executes the actions that concern the document: opening, undo, saved views, cameras. `exporting`: whether a still
// image is being exported; if so, the scene must not change. Throws Error if an action fails.
void actOnDocument(Document& document, ViewState& state, const ViewActions& actions, bool exporting);

// Applies all differences between the state's request and Document::shown: camera, aperture image, blur of nodes, time
// and hidden nodes, ground plane, environment, lights. A change that can't be applied is reverted, with a message.
// `held`: whether a mouse button is held down; the environment is applied after the button's release. The ground plane
// is applied once the pyramids are built.
void updateWorld(Document& document, ViewState& state, bool held);

// Switches to the file's camera `name`, or "auto", and to the lens of that camera. Throws Error for an unknown camera.
void switchCamera(Document& document, ViewState& state, const std::string& name);

}  // namespace defocus::engine
