#pragma once
// Declares the groups of rows of the settings table, in the order of --help.

#include <vector>

#include "frame/settings/row.h"

// Callable that returns a member of a Request, as the functions of row.h expect.
#define MEMBER(path)             \
    [](auto& request) -> auto& { \
        return request.path;     \
    }

namespace defocus::engine {

using Rows = std::vector<Setting>;

Rows sceneRows();
Rows cameraRows();
Rows lensRows();
Rows sampleRows();
Rows methodRows();
Rows displayRows();
Rows developerRows();  // settings for measuring and debugging

}  // namespace defocus::engine
