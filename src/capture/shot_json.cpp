#include "capture/shot_json.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "capture/json_reader.h"
#include "capture/setting_json.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "core/parse.h"
#include "frame/settings/presets.h"
#include "lens/lens_fields.h"
#include "render/methods.h"
#include "scene/built_in_environment.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double farthest = 1e12;  // largest distance or coordinate, m

const std::vector<std::string> easings = {"linear", "smooth"};

Easing easingOf(const JsonReader& reader) {
    const auto given = reader.find("interpolation");
    if (!given) return Easing::smooth;
    return given->choice(easings) == 0 ? Easing::linear : Easing::smooth;
}

Place placeOf(const JsonReader& reader) {
    if (const auto numbers = reader.threeNumbers()) {
        const glm::dvec3 point((*numbers)[0], (*numbers)[1], (*numbers)[2]);
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(point[axis]) > farthest) reader.failExpecting("numbers from -1e12 to 1e12");
        return point;
    }
    if (!reader.value().is_string()) reader.failExpecting("three numbers or the name of a node");
    return reader.text();
}

FrameRange rangeOf(const JsonReader& reader) {
    const char* what = "two frames, the first and the last";
    const std::vector<JsonReader> ends = reader.elements(2, what);
    if (ends.size() != 2) reader.failExpecting(what);
    const FrameRange range{static_cast<int>(ends[0].integer(0, maxFrame)),
                           static_cast<int>(ends[1].integer(0, maxFrame))};
    if (range.last < range.first) reader.failExpecting("a last frame that is not before the first");
    return range;
}

// Returns the frame range of a camera movement, at least two frames; nullopt if the shot doesn't give it.
std::optional<FrameRange> movementFrames(const JsonReader& reader) {
    const auto given = reader.find("frames");
    if (!given) return {};
    const FrameRange range = rangeOf(*given);
    if (range.first == range.last) given->failExpecting("a last frame after the first");
    return range;
}

// Returns the keyframes of a track with their frame numbers. Throws Error unless the frame numbers are strictly
// increasing.
std::vector<std::pair<double, JsonReader>> keysOf(const JsonReader& reader, const std::vector<std::string>& known) {
    std::vector<std::pair<double, JsonReader>> keys;
    for (const JsonReader& key : reader.elements(1, "one keyframe or more, each with a frame")) {
        key.requireObject(known);
        const double frame = key.at("frame").number(0, maxFrame);
        if (!keys.empty() && !(frame > keys.back().first))
            key.at("frame").failExpecting(
                fmt::format("a frame later than {}, the frame of the previous keyframe", keys.back().first));
        keys.emplace_back(frame, key);
    }
    return keys;
}

CameraKeys cameraKeysOf(const JsonReader& camera) {
    CameraKeys result;
    for (const auto& [frame, key] : keysOf(camera.at("keys"), {"frame", "position", "target", "roll"})) {
        result.positions.push_back({frame, placeOf(key.at("position"))});
        result.targets.push_back({frame, placeOf(key.at("target"))});
        const auto roll = key.find("roll");
        result.rolls.push_back({frame, roll ? roll->number(-36'000, 36'000) : 0});
    }
    result.easing = easingOf(camera);
    return result;
}

Turntable turntableOf(const JsonReader& reader) {
    reader.requireObject({"turns", "centre", "frames"});
    Turntable turntable;
    if (const auto turns = reader.find("turns")) turntable.turns = turns->number(-1000, 1000);
    if (const auto centre = reader.find("centre")) turntable.centre = placeOf(*centre);
    turntable.frames = movementFrames(reader);
    return turntable;
}

Dolly dollyOf(const JsonReader& reader) {
    reader.requireObject({"distance", "interpolation", "frames"});
    Dolly dolly;
    dolly.distance = reader.at("distance").number(-1e9, 1e9);
    dolly.easing = easingOf(reader);
    dolly.frames = movementFrames(reader);
    return dolly;
}

ShotMovement movementOf(const JsonReader& reader) {
    reader.requireObject({"name", "keys", "interpolation", "turntable", "dolly"});
    const int movements = int{reader.has("keys")} + int{reader.has("turntable")} + int{reader.has("dolly")};
    if (movements > 1) reader.failWith("give only one of 'keys', 'turntable' and 'dolly'");
    if (reader.has("interpolation") && !reader.has("keys"))
        reader.at("interpolation")
            .failWith("this 'interpolation' applies only to 'keys'; for a dolly, put it into 'dolly'");
    if (reader.has("keys")) return cameraKeysOf(reader);
    if (reader.has("turntable")) return turntableOf(reader.at("turntable"));
    if (reader.has("dolly")) return dollyOf(reader.at("dolly"));
    return {};
}

const std::vector<std::string> focusTargets = {"node", "distance", "pixel", "auto"};

bool namesFocusTarget(const JsonReader& reader) {
    return std::ranges::any_of(focusTargets, [&](const std::string& name) { return reader.has(name.c_str()); });
}

FocusTarget focusTargetOf(const JsonReader& reader) {
    if (std::ranges::count_if(focusTargets, [&](const std::string& name) { return reader.has(name.c_str()); }) != 1)
        reader.failWith("give exactly one of 'node', 'distance', 'pixel' and 'auto'");
    if (const auto node = reader.find("node")) return FocusNode{node->text()};
    if (const auto pixel = reader.find("pixel")) {
        const char* what = "a column and a row in pixels";
        const std::vector<JsonReader> places = pixel->elements(2, what);
        if (places.size() != 2) pixel->failExpecting(what);
        return FocusPixel{{static_cast<int>(places[0].integer(0, maxImageSide - 1)),
                           static_cast<int>(places[1].integer(0, maxImageSide - 1))}};
    }
    if (const auto automatic = reader.find("auto")) {
        if (!automatic->boolean()) automatic->failExpecting("true");
        return FocusAuto{};
    }
    const LensField& field = *lensFieldNamed("focusDistance");
    return FocusDistance{reader.at("distance").number(field.min, field.max)};
}

FocusTrack focusOf(const JsonReader& reader) {
    reader.requireObject({"node", "distance", "pixel", "auto", "keys", "interpolation"});
    FocusTrack focus;
    if (!reader.has("keys")) {
        focus.keys = {{0, focusTargetOf(reader)}};
        if (const auto easing = reader.find("interpolation"))
            easing->failWith("'interpolation' applies only to 'keys'; leave it out or give 'keys'");
        return focus;
    }
    if (namesFocusTarget(reader))
        reader.failWith("give either 'keys' or one of 'node', 'distance', 'pixel' and 'auto'");
    for (const auto& [frame, key] : keysOf(reader.at("keys"), {"frame", "node", "distance", "pixel", "auto"}))
        focus.keys.push_back({frame, focusTargetOf(key)});
    focus.easing = easingOf(reader);
    return focus;
}

double lensNumberOf(const JsonReader& reader, const LensField& field) {
    if (std::holds_alternative<bool Lens::*>(field.member)) return reader.boolean() ? 1 : 0;
    const bool whole = std::holds_alternative<int Lens::*>(field.member);
    const double value = whole ? static_cast<double>(reader.integer(static_cast<std::int64_t>(field.min),
                                                                    static_cast<std::int64_t>(field.max)))
                               : reader.number(field.min, field.max);
    try {
        Lens scratch;
        setLensField(scratch, field, value);
    } catch (const Error& error) {
        reader.failWith(error.what());
    }
    return value;
}

// Reads keyframes. `numberOf` reads the value of one keyframe.
LensTrack trackOf(const JsonReader& reader, const auto& numberOf) {
    LensTrack track;
    reader.requireObject({"keys", "interpolation"});
    for (const auto& [frame, key] : keysOf(reader.at("keys"), {"frame", "value"}))
        track.keys.push_back({frame, numberOf(key.at("value"))});
    track.easing = easingOf(reader);
    return track;
}

LensTrack lensTrackOf(const JsonReader& reader, const LensField& field) {
    const auto numberOf = [&](const JsonReader& value) { return lensNumberOf(value, field); };
    return reader.value().is_object() ? trackOf(reader, numberOf) : LensTrack{.keys = {{0, numberOf(reader)}}};
}

std::map<std::string, LensTrack, std::less<>> lensOf(const JsonReader& reader) {
    std::vector<std::string> names;
    for (const LensField& field : lensFields()) names.emplace_back(field.name);
    reader.requireObject(names);
    std::map<std::string, LensTrack, std::less<>> lens;
    for (const auto& [name, member] : reader.members()) lens[name] = lensTrackOf(member, *lensFieldNamed(name));
    return lens;
}

// Returns all methods' settings that may have keyframes, by setting name.
std::map<std::string, const MethodSetting*, std::less<>> keyedSettings() {
    std::map<std::string, const MethodSetting*, std::less<>> keyed;
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings)
            if (setting.keyed) keyed.emplace(setting.name, &setting);
    return keyed;
}

// Reads the keyframes of a method's setting. Throws Error for values below 1e-6. These settings use 0 for "computed
// from the lens", so values interpolated from 0 would be meaningless.
LensTrack methodTrackOf(const JsonReader& reader, const MethodSetting& setting) {
    constexpr double min = 1e-6;
    return trackOf(reader, [&](const JsonReader& value) { return value.number(min, setting.max); });
}

std::map<std::string, LensTrack, std::less<>> methodKeysOf(const JsonReader& reader) {
    const auto known = keyedSettings();
    std::vector<std::string> names;
    for (const auto& [name, setting] : known) names.push_back(name);
    reader.requireObject(names);
    std::map<std::string, LensTrack, std::less<>> tracks;
    for (const auto& [name, member] : reader.members()) tracks[name] = methodTrackOf(member, *known.at(name));
    return tracks;
}

// Returns the member of the document at a JSON pointer; nullopt if it is missing.
std::optional<JsonReader> findPlace(const JsonReader& reader, std::string_view place) {
    std::optional<JsonReader> found = reader;
    while (found && !place.empty()) {
        const std::size_t end = std::min(place.find('/', 1), place.size());
        found = found->find(std::string(place.substr(1, end - 1)).c_str());
        place.remove_prefix(end);
    }
    return found;
}

// Returns the allowed keys of the shot's JSON object at the JSON pointer `place` ("" for the document): the keys of
// settings at this location, and the keys `own`.
std::vector<std::string> keysAt(std::string_view place, std::vector<std::string> own) {
    for (const Setting& setting : settings()) {
        const std::string_view path = setting.shotPlace;
        if (!path.starts_with(place) || path.size() <= place.size() || path[place.size()] != '/') continue;
        const std::string_view rest = path.substr(place.size() + 1);
        const std::string key(rest.substr(0, rest.find('/')));
        if (std::ranges::find(own, key) == own.end()) own.push_back(key);
    }
    return own;
}

// Resolves a path in a shot relative to the shot's folder. Values of settings that are not paths are returned
// unchanged.
std::string relativeToShot(const Setting& setting, const std::string& text, const Shot& shot) {
    if (setting.name == "environment" && isBuiltInEnvironment(text)) return text;
    return setting.kind == SettingKind::path ? (shot.file.parent_path() / text).string() : text;
}

// Reads the values of all settings that the settings table lists for shots.
void readSettings(const JsonReader& reader, Shot& shot) {
    if (const auto fish = reader.find("fish")) {
        if (reader.has("scene"))
            fish->failWith(
                "the setting is for the built-in school of fish, but the shot has a scene; remove one of "
                "them");
        fish->requireObject(keysAt("/fish", {}));
    }
    if (const auto animation = reader.find("animation")) {
        animation->requireObject(keysAt("/animation", {"speed"}));
        if (const auto speed = animation->find("speed")) shot.animationSpeed = speed->number(-1e3, 1e3);
    }
    if (const auto shutter = reader.find("shutter")) {
        shutter->requireObject(keysAt("/shutter", {"angle", "exact"}));
        if (shutter->has("angle") == shutter->has("seconds")) shutter->failWith("give either 'angle' or 'seconds'");
        if (const auto angle = shutter->find("angle")) shot.shutterAngle = angle->number(0, 3600);
    }
    for (const Setting& setting : settings()) {
        if (setting.shotPlace.empty() || setting.keyed) continue;
        const std::optional<JsonReader> value = findPlace(reader, setting.shotPlace);
        if (!value) continue;
        setting.set(shot.request, relativeToShot(setting, settingText(setting, *value), shot));
        shot.given.insert(setting.name);
        if (setting.name != "preset") continue;
        for (const PresetValue& each : presetNamed(*setting.text(shot.request)).values) shot.given.insert(each.setting);
    }
    if (const auto exact = findPlace(reader, "/shutter/exact"); exact && exact->boolean()) {
        settingNamed("motionSegments")->set(shot.request, "exact");
        shot.given.insert("motionSegments");
    }
}

void readOutput(const JsonReader& reader, Shot& shot) {
    if (const auto output = reader.find("output")) {
        shot.outputs.clear();
        if (!output->value().is_array()) shot.outputs.push_back(output->text());
        if (output->value().is_array())
            for (const JsonReader& each : output->elements(1, "one pattern or more"))
                shot.outputs.push_back(each.text());
    }
    if (const auto video = reader.find("video")) shot.video = video->text();
}

// Collects the names of nodes, cameras and clips in the shot, each with the location of its first occurrence.
void collectNames(const JsonReader& reader, Shot& shot) {
    if (!reader.value().is_structured()) return;
    for (const auto& [key, member] : reader.members()) {
        collectNames(member, shot);
        static const std::set<std::string, std::less<>> naming = {"node",     "name",   "clip",
                                                                  "position", "target", "centre"};
        if (!reader.value().is_object() || !naming.contains(key)) continue;
        const json& value = member.value();
        if (value.is_string()) shot.placesOfNames.emplace(value.get<std::string>(), member.pointer());
        if (value.is_number_integer()) shot.placesOfNames.emplace(value.dump(), member.pointer());
    }
}

// Throws Error if a string contains a NUL character, because the system would cut a path short there.
void refuseNul(const JsonReader& reader) {
    const json& value = reader.value();
    if (value.is_string() && value.get_ref<const std::string&>().find('\0') != std::string::npos)
        reader.failWith("contains a NUL character; remove it");
    if (!value.is_structured()) return;
    for (const auto& [key, member] : reader.members()) refuseNul(member);
}

Shot shotOf(const json& document, const fs::path& file) {
    const JsonReader reader(document, file.string());
    refuseNul(reader);
    reader.requireObject(keysAt("", {"$schema", "frameRate", "range", "camera", "focus", "lens", "methodKeys",
                                     "animateSeed", "output", "video"}));
    Shot shot;
    shot.file = file;
    if (const auto schema = reader.find("$schema")) static_cast<void>(schema->text());
    readSettings(reader, shot);
    if (const auto rate = reader.find("frameRate")) shot.frameRate = rate->number(1e-3, 1e6);
    if (const auto range = reader.find("range")) shot.range = rangeOf(*range);
    if (const auto camera = reader.find("camera")) shot.movement = movementOf(*camera);
    if (const auto animate = reader.find("animateSeed")) shot.animateSeed = animate->boolean();
    if (const auto focus = reader.find("focus")) shot.focus = focusOf(*focus);
    if (const auto lens = reader.find("lens")) shot.lens = lensOf(*lens);
    if (const auto keys = reader.find("methodKeys")) shot.methodKeys = methodKeysOf(*keys);
    if (shot.focus && shot.lens.contains("focusDistance"))
        reader.at("lens")
            .at("focusDistance")
            .failWith("cannot be combined with the shot's 'focus'; give only one of them");
    if (reader.has("exposure") && shot.lens.contains("exposureTime"))
        reader.at("exposure").failWith("cannot be combined with the lens's 'exposureTime'; give only one of them");
    readOutput(reader, shot);
    collectNames(reader, shot);
    return shot;
}

// Throws Error with the message "FILE: line 3, column 7: MESSAGE". `place`: byte offset in `text`.
[[noreturn]] void failAt(std::string_view text, std::size_t place, const fs::path& file, std::string_view message) {
    const std::string_view before = text.substr(0, place);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t lineBreak = before.rfind('\n');
    fail("{}: line {}, column {}: {}", file.string(), line,
         lineBreak == std::string_view::npos ? before.size() + 1 : before.size() - lineBreak, message);
}

// Returns the offset of the first number that overflows a double; json::parse doesn't report this offset.
std::size_t placeOfOverflow(std::string_view text) {
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString && c == '\\') ++i;
        if (c == '"') inString = !inString;
        if (inString || (c != '-' && (c < '0' || c > '9'))) continue;
        const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE", i), text.size());
        if (std::isinf(std::strtod(std::string(text.substr(i, end - i)).c_str(), nullptr))) return i;
        i = end - 1;
    }
    return 0;
}

json parsed(std::string_view text, const fs::path& file) {
    if (jsonNesting(text) > deepestJson) fail("{}: JSON nested deeper than {} levels", file.string(), deepestJson);
    try {
        return json::parse(text);
    } catch (const json::parse_error& error) {
        const std::size_t end = std::min(error.byte, text.size());
        failAt(text, end > 0 ? end - 1 : 0, file, "not valid JSON: unexpected character or end of file");
    } catch (const json::out_of_range&) {
        failAt(text, placeOfOverflow(text), file, "the number is too large");
    }
}

void replaceValue(json& document, const ShotOverride& given) {
    if (jsonNesting(given.value) > deepestJson || std::ranges::count(given.pointer, '/') > deepestJson)
        fail("--set {}: nested deeper than {} levels", given.pointer.substr(0, 40), deepestJson);
    json value = json::parse(given.value, nullptr, false);
    if (value.is_discarded()) value = given.value;
    try {
        document[json::json_pointer(given.pointer)] = value;
    } catch (const json::exception&) {
        fail("--set {}: not found in the shot; give /PLACE=VALUE, such as /lens/fStop=1.4", given.pointer);
    }
}

}  // namespace

ShotOverride parseShotOverride(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (text.empty() || text.front() != '/' || equals == std::string_view::npos)
        fail("'{}' is not /PLACE=VALUE, such as /lens/fStop=1.4", text);
    return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

Shot parseShot(std::string_view text, const fs::path& file, const std::vector<ShotOverride>& overrides) {
    json document = parsed(text, file);
    for (const ShotOverride& given : overrides) replaceValue(document, given);
    return shotOf(document, file);
}

Shot loadShot(const fs::path& path, const std::vector<ShotOverride>& overrides) {
    return parseShot(readText(path), path, overrides);
}

void failForName(const Shot& shot, const MissingName& missing) {
    const auto place = shot.placesOfNames.find(missing.name());
    if (place == shot.placesOfNames.end()) throw missing;
    fail("{}: {}: {}", shot.file.string(), place->second, missing.what());
}

FrameRange parseFrameRange(std::string_view text) {
    const auto frame = [&](std::string_view part) {
        const std::optional<int> value = parsedNumber<int>(part);
        if (!value || *value < 0 || *value > maxFrame)
            fail("'{}' is not FIRST:LAST, with frame numbers from 0 to {}, such as 0:240", text, maxFrame);
        return *value;
    };
    const std::size_t colon = text.find(':');
    const int first = frame(text.substr(0, colon));
    const int last = colon == std::string_view::npos ? first : frame(text.substr(colon + 1));
    if (last < first) fail("'{}': the last frame is before the first", text);
    return {first, last};
}

}  // namespace defocus::engine
