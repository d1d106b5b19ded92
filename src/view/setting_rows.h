#pragma once
// Rows of the panel for the settings of a request (frame/settings.h).

#include <string>

#include "frame/settings.h"

namespace defocus {

// A row for the setting of this name. True when the request was changed; a value that the setting doesn't take leaves
// the request as it is. `first` is what an open value begins with when it is switched on.
bool settingRow(Request& request, const std::string& name, const std::string& first = "");

}  // namespace defocus
