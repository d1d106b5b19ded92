// Adds a setting to the table of settings when Python loads the module.

#include "new_setting.h"

namespace defocus::engine {
namespace {

struct Added {
    Added() { addSetting(newSetting()); }
};

const Added added;

}  // namespace
}  // namespace defocus::engine
