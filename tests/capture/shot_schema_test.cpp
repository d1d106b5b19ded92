// Tests that the published schema and the parser accept and reject the same variations of a complete shot. The class
// Schema implements the keywords that the schema uses (JSON Schema 2020-12) and fails for all other keywords.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "capture/setting_json.h"
#include "capture/shot_json.h"
#include "core/error.h"
#include "frame/settings/settings.h"
#include "lens/lens_fields.h"

namespace defocus::engine {
namespace {

using nlohmann::json;

class Schema {
public:
    explicit Schema(json root) : root_(std::move(root)) {}

    [[nodiscard]] bool accepts(const json& value) const { return accepts(root_, value); }
    [[nodiscard]] bool takes(const json& part, const json& value) const { return accepts(part, value); }
    [[nodiscard]] const json& root() const { return root_; }

private:
    [[nodiscard]] bool accepts(const json& schema, const json& value) const {
        for (const auto& [keyword, rule] : schema.items())
            if (!holds(schema, keyword, rule, value)) return false;
        return true;
    }

    [[nodiscard]] bool holds(const json& schema, const std::string& keyword, const json& rule,
                             const json& value) const {
        static const std::set<std::string> notes = {"$schema", "$id",     "title",   "description",
                                                    "$defs",   "default", "examples"};
        if (notes.contains(keyword)) return true;
        const auto taken = [&](const json& each) { return accepts(each, value); };
        if (keyword == "$ref") return taken(root_.at(json::json_pointer(rule.get<std::string>().substr(1))));
        if (keyword == "anyOf") return std::any_of(rule.begin(), rule.end(), taken);
        if (keyword == "allOf") return std::all_of(rule.begin(), rule.end(), taken);
        if (keyword == "oneOf") return std::count_if(rule.begin(), rule.end(), taken) == 1;
        if (keyword == "not") return !taken(rule);
        if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
        if (keyword == "type") return isOfType(rule.get<std::string>(), value);
        if (keyword == "minimum") return !value.is_number() || value.get<double>() >= rule.get<double>();
        if (keyword == "maximum") return !value.is_number() || value.get<double>() <= rule.get<double>();
        if (keyword == "minLength") return !value.is_string() || value.get<std::string>().size() >= rule;
        if (value.is_array() && keyword == "minItems") return value.size() >= rule;
        if (value.is_array() && keyword == "maxItems") return value.size() <= rule;
        if (value.is_array() && keyword == "items")
            return std::all_of(value.begin(), value.end(), [&](const json& each) { return accepts(rule, each); });
        if (keyword == "minItems" || keyword == "maxItems" || keyword == "items") return true;
        return holdsForObject(schema, keyword, rule, value);
    }

    [[nodiscard]] bool holdsForObject(const json& schema, const std::string& keyword, const json& rule,
                                      const json& value) const {
        static const std::set<std::string> known = {"properties", "additionalProperties", "required",
                                                    "dependentRequired", "dependentSchemas"};
        EXPECT_TRUE(known.contains(keyword)) << "the validator doesn't know " << keyword;
        if (!value.is_object()) return true;
        const auto has = [&](const json& name) { return value.contains(name.get<std::string>()); };
        if (keyword == "required") return std::all_of(rule.begin(), rule.end(), has);
        for (const auto& [name, each] : rule.items()) {
            if (!value.contains(name)) continue;
            if (keyword == "properties" && !accepts(each, value.at(name))) return false;
            if (keyword == "dependentRequired" && !std::all_of(each.begin(), each.end(), has)) return false;
            if (keyword == "dependentSchemas" && !accepts(each, value)) return false;
        }
        if (keyword == "additionalProperties")
            for (const auto& [name, each] : value.items())
                if (!schema.at("properties").contains(name)) return false;
        return true;
    }

    static bool isOfType(const std::string& type, const json& value) {
        if (type == "integer") return value.is_number() && value.get<double>() == std::floor(value.get<double>());
        if (type == "number") return value.is_number();
        if (type == "string") return value.is_string();
        if (type == "boolean") return value.is_boolean();
        if (type == "array") return value.is_array();
        EXPECT_EQ(type, "object");
        return value.is_object();
    }

    json root_;
};

Schema publishedSchema() {
    std::ifstream file(std::string(DEFOCUS_SOURCE_DIR) + "/docs/shot.schema.json");
    return Schema(json::parse(file));
}

// Returns a shot with every member that can be combined with the others.
json fullShot() {
    return json::parse(R"({
        "$schema": "shot.schema.json", "fish": {"count": 3, "triangles": 900}, "environment": "sky.hdr",
        "environmentRotation": 30, "units": "cm",
        "background": [0.1, 0.2, 0.3], "frameRate": 25, "range": [0, 48],
        "animation": {"clip": 1, "start": 0.5, "speed": 2, "loop": true},
        "camera": {"name": "Main", "interpolation": "linear",
                   "keys": [{"frame": 0, "position": [1, 2, 3], "target": "Fish 1"},
                            {"frame": 12.5, "position": [1, 2, 4], "target": [0, 0, 0], "roll": -30}]},
        "focus": {"keys": [{"frame": 0, "node": "Fish 1"}, {"frame": 24, "distance": 3}], "interpolation": "smooth"},
        "lens": {"fStop": {"keys": [{"frame": 0, "value": 1.4}, {"frame": 9, "value": 4}], "interpolation": "linear"},
                 "bladeCount": 7, "focusBreathing": true},
        "size": [320, 240], "samples": 16, "seed": 3, "sequence": "r2", "animateSeed": true,
        "methodKeys": {"far-blur-depth": {"keys": [{"frame": 0, "value": 3}]}},
        "shutter": {"angle": 180, "position": "start", "segments": 4, "exact": true}, "lod": "continuous", "lodMetric": "error",
        "blurThreshold": 0.2, "sizeThreshold": 0.5, "lightThreshold": 0.1, "method": "accumulation", "layerFormat": "rgba32f",
        "output": ["a/####.exr", "b/####.png"], "exposure": 1, "toneMap": "agx", "video": "film.mp4"})");
}

std::string parserFault(const json& shot) {
    try {
        parseShot(shot.dump(), "x.json");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// Returns whether the fault is of a kind that no schema can express: wrongly ordered numbers or an unknown method name.
bool beyondSchemas(const std::string& fault) {
    for (const char* part : {"a frame later than", "a last frame", "/method:"})
        if (fault.find(part) != std::string::npos) return true;
    return false;
}

// Expects that the schema and the parser agree on the shot. Returns whether the schema accepts the shot.
bool expectAgreement(const Schema& schema, const json& shot, const std::string& what) {
    const bool accepted = schema.accepts(shot);
    const std::string fault = parserFault(shot);
    EXPECT_TRUE(accepted == fault.empty() || beyondSchemas(fault)) << what << ": the parser says: " << fault;
    return accepted;
}

std::vector<json::json_pointer> placesIn(const json& shot) {
    std::vector<json::json_pointer> places;
    const json flat = shot.flatten();
    for (const auto& [pointer, value] : flat.items())
        for (json::json_pointer place(pointer); !place.empty(); place = place.parent_pointer())
            if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
    return places;
}

std::vector<json> shots() {
    std::vector<json> result = {json::object(), fullShot()};
    json other = fullShot();
    other["camera"] = json::parse(R"({"turntable": {"turns": 2, "centre": "Fish 2", "frames": [0, 9]}})");
    other["focus"] = json::parse(R"({"node": "Fish 1"})");
    other["background"] = "none";
    other["animation"]["clip"] = "Walk";
    other["shutter"] = json::parse(R"({"seconds": 0.02})");
    result.push_back(other);
    other.erase("fish");
    other["scene"] = "fox.glb";
    other["camera"] = json::parse(R"({"dolly": {"distance": -2, "interpolation": "linear", "frames": [3, 9]}})");
    other["focus"] = json::parse(R"({"distance": 4})");
    other["output"] = "####.jpg";
    other.erase("exposure");
    other["lens"]["exposureTime"] =
        json::parse(R"({"keys": [{"frame": 0, "value": 0.01}, {"frame": 9, "value": 0.1}]})");
    other["lens"]["iso"] = 400;
    result.push_back(other);
    other["focus"] = json::parse(R"({"pixel": [160, 16383]})");
    result.push_back(other);
    other["focus"] = json::parse(R"({"auto": true})");
    result.push_back(other);
    other["focus"] = json::parse(R"({"keys": [{"frame": 0, "pixel": [0, 9]}, {"frame": 3, "auto": true}]})");
    result.push_back(other);
    return result;
}

TEST(ShotSchema, takesWhatTheParserTakes) {
    const Schema schema = publishedSchema();
    for (const json& shot : shots()) {
        EXPECT_EQ(parserFault(shot), "");
        EXPECT_TRUE(schema.accepts(shot)) << shot.dump();
    }
}

TEST(ShotSchema, agreesWithTheParserAboutEachChange) {
    const Schema schema = publishedSchema();
    const std::vector<json> values = json::parse(
        R"([null, true, 0, 1, 2, -1, 0.5, 1e13, 17000, "", "a", "none", "linear", [], [1], [1, 2], [0, 0, 0], [1, 2, 3, 4],
            [[1, 2]], ["a", "b", "c"], {}, {"keys": []}, {"node": "A", "distance": 1}, {"auto": true, "node": "A"}, {"pixel": [3, 4]}, {"keys": [{"frame": 1, "value": 1}]}])");
    std::size_t refused = 0;
    for (const json& shot : shots())
        for (const json::json_pointer& place : placesIn(shot)) {
            for (const json& value : values) {
                json changed = shot;
                changed[place] = value;
                if (!expectAgreement(schema, changed, place.to_string() + " = " + value.dump())) ++refused;
            }
            json without = shot;
            json& parent = without.at(place.parent_pointer());
            if (parent.is_object())
                parent.erase(place.back());
            else
                parent.erase(std::stoul(place.back()));
            expectAgreement(schema, without, "without " + place.to_string());
            if (!shot.at(place).is_object()) continue;
            json more = shot;
            more[place]["unknown"] = 1;
            expectAgreement(schema, more, "unknown key in " + place.to_string());
        }
    EXPECT_GT(refused, 1000u);
}

TEST(ShotSchema, forbidsWhatDoesNotGoTogether) {
    const Schema schema = publishedSchema();
    for (const char* text :
         {R"({"scene": "a.glb", "fish": {}})", R"({"focus": {"node": "A"}, "lens": {"focusDistance": 2}})",
          R"({"camera": {"turntable": {}, "dolly": {"distance": 1}}})", R"({"camera": {"interpolation": "linear"}})",
          R"({"focus": {"node": "A", "keys": [{"frame": 0, "distance": 1}]}})",
          R"({"focus": {"node": "A", "interpolation": "linear"}})", R"({"focus": {"auto": true, "pixel": [1, 2]}})",
          R"({"focus": {"auto": false}})", R"({"focus": {"pixel": [1, 16384]}})", R"({"unknown": 1})"}) {
        EXPECT_FALSE(schema.accepts(json::parse(text))) << text;
        EXPECT_NE(parserFault(json::parse(text)), "") << text;
    }
}

// Returns a value that the setting accepts.
json valueFor(const Setting& setting) {
    if (const std::optional<std::string> value = setting.text(Request{})) return json(settingJson(setting, *value));
    switch (setting.kind) {
        case SettingKind::number:
        case SettingKind::integer:
            return std::clamp(setting.kind == SettingKind::integer ? 3.0 : 1.0, setting.min, setting.max);
        case SettingKind::boolean:
            return true;
        case SettingKind::choice:
            return setting.choices.front();
        default:
            return "a";
    }
}

// The schema and the parser accept each setting that a shot may contain.
TEST(ShotSchema, holdsEachSettingThatAShotMayGive) {
    const Schema schema = publishedSchema();
    for (const Setting& setting : settings()) {
        if (setting.shotPlace.empty()) continue;
        json shot = json::object();
        if (setting.shotPlace.starts_with("/shutter/")) shot["shutter"]["seconds"] = 0.02;
        shot[json::json_pointer(setting.shotPlace)] = valueFor(setting);
        EXPECT_TRUE(schema.accepts(shot)) << shot;
        EXPECT_EQ(parserFault(shot), "") << shot;
    }
}

// The schema and the parser agree on each lens field at both ends of its range and beyond them.
TEST(ShotSchema, holdsEachLensFieldWithItsRange) {
    const Schema schema = publishedSchema();
    EXPECT_EQ(schema.root().at(json::json_pointer("/properties/lens/properties")).size(), lensFields().size());
    for (const LensField& field : lensFields()) {
        const bool boolean = std::holds_alternative<bool Lens::*>(field.member);
        std::vector<json> values = {true, "a"};
        for (const double value : {field.min, field.max, field.min - 1, field.max * 2 + 1, 0.5, 2.0})
            values.emplace_back(value);
        for (const json& value : values) {
            const json shot = {{"lens", {{field.name, value}}}};
            const json keyed = {{"lens", {{field.name, {{"keys", {{{"frame", 0}, {"value", value}}}}}}}}};
            expectAgreement(schema, shot, shot.dump());
            expectAgreement(schema, keyed, keyed.dump());
        }
        const json min = boolean ? json(false) : json(field.min);
        EXPECT_TRUE(schema.accepts({{"lens", {{field.name, min}}}})) << field.name;
    }
}

// ---- descriptions in editors ----------------------------------------------------------------------------------------

// Calls `visit` with the path and the schema of each property.
void eachProperty(const json& schema, const std::string& place,
                  const std::function<void(const std::string&, const json&)>& visit) {
    if (schema.is_array())
        for (std::size_t i = 0; i < schema.size(); ++i) eachProperty(schema[i], place + "/" + std::to_string(i), visit);
    if (!schema.is_object()) return;
    for (const auto& [keyword, rule] : schema.items()) {
        const std::string below = place + "/" + keyword;
        if (keyword == "properties" || keyword == "$defs") {
            for (const auto& [name, property] : rule.items()) {
                visit(below + "/" + name, property);
                eachProperty(property, below + "/" + name, visit);
            }
        } else if (keyword != "default" && keyword != "examples" && keyword != "not") {
            eachProperty(rule, below, visit);
        }
    }
}

TEST(ShotSchema, hasAName) {
    EXPECT_EQ(publishedSchema().root().at("$id"), "urn:defocus:shot.schema.json");
}

TEST(ShotSchema, eachPropertySaysWhatItIsAndWhatItMayBe) {
    const Schema schema = publishedSchema();
    std::size_t properties = 0;
    eachProperty(schema.root(), "", [&](const std::string& place, const json& property) {
        // The property has a description, or refers to a definition with a description.
        json told = property;
        if (const auto reference = property.find("$ref"); reference != property.end()) {
            told = schema.root().at(json::json_pointer(reference->get<std::string>().substr(1)));
            told.update(property);
        }
        EXPECT_FALSE(told.value("description", "").empty()) << place;
        std::vector<json> values = told.value("examples", std::vector<json>());
        if (told.contains("default")) values.push_back(told.at("default"));
        EXPECT_FALSE(values.empty()) << place;
        for (const json& value : values) EXPECT_TRUE(schema.takes(property, value)) << place << ": " << value;
        ++properties;
    });
    EXPECT_GT(properties, 100u);
}

}  // namespace
}  // namespace defocus::engine
