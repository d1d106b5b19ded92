#pragma once
// The keys of the window: one table for their commands and for the list of keys in the window.

#include <span>

#include "view/state/view_state.h"

namespace defocus::engine {

struct KeyContext {
    const PreparedFrame* frame = nullptr;  // null: no scene yet
    ViewState& state;
    ViewActions& actions;
    bool shift = false;
};

struct KeyCommand {
    const char* keys = nullptr;     // name in the list; null: the row above includes this key
    const char* meaning = nullptr;  // explanation in the list
    int key = 0;                    // WindowEvent::key, see withControl; 0: not a key command
    void (*run)(KeyContext) = nullptr;
};

// Returns the code of a key that is pressed with Ctrl.
constexpr int withControl(int key) {
    return key + 1000;
}

std::span<const KeyCommand> keyCommands();

// Runs the command of a key, if it has one.
void runKeyCommand(int key, const KeyContext& context);

// Returns the names of the file's cameras, in its order. Keys 1 … 9 choose them.
std::vector<std::string> cameraNames(const Scene& scene);

}  // namespace defocus::engine
