#pragma once
// The window's scene: loading, edits, and the world that is drawn.

#include "view/document/edit_history.h"
#include "view/document/scene_loader.h"
#include "view/state/view_state.h"

namespace defocus::engine {

struct Document {
    std::filesystem::path shaderFolder;  // empty: the embedded shaders
    bool remembersFiles = true;          // opened scenes are added to the recent files

    SceneLoader loader;
    std::unique_ptr<PreparedFrame> frame;  // null: no scene yet
    bool draft = false;                    // the scene's pyramids are still being built
    EditHistory history;
    Request shown;                           // the request that `frame` shows; see updateWorld
    bool poseIsStale = false;                // the pose is due even if the request is unchanged
    std::vector<double> ownBlurs;            // Node::cocScale of the scene's nodes when it was opened
    std::vector<glm::dmat4> shutterCameras;  // see View; only while the view follows the file's camera
    std::uint64_t poseVersion = 0;           // increases when anything in the world moves
    std::uint64_t worldVersion = 0;          // increases when GPU copies of the world must be rebuilt
};

// Starts to open a scene. It keeps samples, levels, method and surroundings of the current one.
void openScene(Document& document, const ViewState& state, const std::filesystem::path& scene);

// Takes over the loader's result. Returns whether another scene was opened: everything that refers to `frame` is then
// invalid. Needs a current GL context.
bool takeLoadedScene(Document& document, ViewState& state);

// Returns the view of the picture.
View currentView(const Document& document, const ViewState& state);

// Notes the state as an edit; `held`: a mouse button or key is held down.
void noteEdit(Document& document, const ViewState& state, bool held);

// Does the document's part of the actions: opening, undo, saved views, cameras. `exporting`: the scene must not change.
// Throws Error.
void actOnDocument(Document& document, ViewState& state, const ViewActions& actions, bool exporting);

// Applies all differences between the state's request and Document::shown: camera, aperture image, blur of nodes, time
// and hidden nodes, ground, surroundings, lights. Changes that can't be applied are reverted with a message.
// `held`: a mouse button is held down; surroundings wait until it is released. A ground waits for the pyramids.
void updateWorld(Document& document, ViewState& state, bool held);

// Switches to a camera of the file, or "auto", and to its lens. Throws Error.
void switchCamera(Document& document, ViewState& state, const std::string& name);

}  // namespace defocus::engine
