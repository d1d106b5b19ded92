// Builds the settings table from the groups of rows in the files rows_*.cpp.

#include "frame/settings/rows.h"

#include <utility>

#include "core/error.h"
#include "scene/units.h"

namespace defocus::engine {

namespace {

// Lets a setting that is a length accept the suffixes mm, cm and m.
void acceptSuffixes(Setting& setting) {
    if (setting.unit != "m" && setting.unit != "mm") return;
    setting.set = [set = setting.set, unit = setting.unit](Request& request, const std::string& text) {
        const std::string number = lengthsIn(unit, text);
        try {
            set(request, number);
        } catch (const Error& error) {
            if (number == text) throw;
            fail("{} is {} {}: {}", text, number, unit, error.what());
        }
    };
}

std::vector<Setting>& table() {
    static std::vector<Setting> all = [] {
        Rows rows;
        const auto add = [&](SettingGroup group, Rows more) {
            for (Setting& setting : more) {
                setting.group = group;
                acceptSuffixes(setting);
                rows.push_back(std::move(setting));
            }
        };
        add(SettingGroup::scene, sceneRows());
        add(SettingGroup::camera, cameraRows());
        add(SettingGroup::samples, sampleRows());  // the preset comes first, because it sets values of later rows
        add(SettingGroup::lens, lensRows());
        add(SettingGroup::method, methodRows());
        add(SettingGroup::display, displayRows());
        add(SettingGroup::developer, developerRows());
        rows.reserve(rows.size() + 16);  // keeps pointers to rows valid when addSetting appends rows
        return rows;
    }();
    return all;
}

}  // namespace

std::span<const Setting> settings() {
    return table();
}

void addSetting(Setting setting) {
    table().push_back(std::move(setting));
}

}  // namespace defocus::engine
