#pragma once
// Defines the window's keys in one table, which both the commands and the displayed list of keys use.

#include <span>

#include "view/state/view_state.h"

namespace defocus::engine {

struct KeyContext {
    const PreparedFrame* frame = nullptr;  // null: no scene is open
    ViewState& state;
    ViewActions& actions;
    bool shift = false;
};

struct KeyCommand {
    const char* keys = nullptr;     // key names in the displayed list; null: the preceding row includes this key
    const char* meaning = nullptr;  // meaning of the keys in the displayed list
    int key = 0;                    // key code: WindowEvent::key or withControl(); 0: the row has no command
    void (*run)(KeyContext) = nullptr;
};

// Returns the code of a key pressed together with Ctrl.
constexpr int withControl(int key) {
    return key + 1000;
}

std::span<const KeyCommand> keyCommands();

// Runs the command of a key; does nothing if the key has none.
void runKeyCommand(int key, const KeyContext& context);

// Returns the names of the file's cameras in file order. Keys 1 … 9 select them.
std::vector<std::string> cameraNames(const Scene& scene);

}  // namespace defocus::engine
