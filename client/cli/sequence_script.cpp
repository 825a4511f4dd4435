#include "client/cli/sequence_script.h"

#include "client/cli/client_error.h"
#include "protocol/base/text/name_table.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/object_reader.h"

#include <algorithm>
#include <cmath>

namespace relume::cli {
namespace {

using nlohmann::json;
using wire::ObjectReader;

constexpr text::NameTable<Ease, 4> kEaseNames({{
    {Ease::linear, "linear"},
    {Ease::slow_fast_slow, "slow-fast-slow"},
    {Ease::slow_fast, "slow-fast"},
    {Ease::fast_slow, "fast-slow"},
}});

constexpr wire::Range kDegrees{-1e6, 1e6};
constexpr wire::Range kSeconds{0, 86400};

Span span_from(ObjectReader& reader, const char* key, wire::Range range) {
    const json* value = reader.find(key);
    if (value == nullptr) {
        return {};
    }
    const auto ends = wire::numbers_from_json(*value, reader.path_to(key), 2, range);
    return {.from = ends[0], .to = ends[1]};
}

std::uint32_t images_from(ObjectReader& reader) {
    return static_cast<std::uint32_t>(wire::integer_from_json(
        reader.require("images"), reader.path_to("images"), 1, kMaxStepImages));
}

Ease ease_from(ObjectReader& reader) {
    const json* value = reader.find("ease");
    if (value == nullptr) {
        return Ease::linear;
    }
    const auto ease = kEaseNames.value(wire::string_from_json(*value, reader.path_to("ease")));
    if (!ease) {
        throw wire::WireError(wire::ErrorCode::out_of_range, reader.path_to("ease"),
                              wire::quote(*value), kEaseNames.alternatives());
    }
    return *ease;
}

Imath::V3d direction_from(ObjectReader& reader, const char* key) {
    const json& value = reader.require(key);
    const Imath::V3d direction =
        wire::vector_from_json(value, reader.path_to(key), wire::Range{-1e6, 1e6});
    if (direction.length() < 1e-9) {
        throw wire::WireError(wire::ErrorCode::out_of_range, reader.path_to(key),
                              "a vector of no length", "a direction");
    }
    return direction.normalized();
}

Step rotate_from(ObjectReader reader) {
    Rotate rotate{.yaw_degrees = span_from(reader, "yaw_degrees", kDegrees),
                  .pitch_degrees = span_from(reader, "pitch_degrees", kDegrees),
                  .roll_degrees = span_from(reader, "roll_degrees", kDegrees),
                  .images = images_from(reader),
                  .ease = ease_from(reader)};
    reader.refuse_other_keys();
    return rotate;
}

Step move_light_from(ObjectReader reader) {
    MoveLight move{.id = wire::name_from_json(reader.require("id"), reader.path_to("id")),
                   .from = direction_from(reader, "from"),
                   .to = direction_from(reader, "to"),
                   .images = images_from(reader),
                   .ease = ease_from(reader)};
    reader.refuse_other_keys();
    return move;
}

Step blend_from(ObjectReader reader) {
    static_cast<void>(reader.require("amount"));
    BlendOver blend{
        .name = wire::name_from_json(reader.require("name"), reader.path_to("name")),
        .amount = span_from(reader, "amount", {0, 1}),
        .images = images_from(reader),
        .ease = ease_from(reader)};
    reader.refuse_other_keys();
    return blend;
}

Step camera_from(ObjectReader reader) {
    MoveCamera move{
        .path = camera_path_from_json(reader.require("keys"), reader.path_to("keys")),
        .images = images_from(reader),
        .ease = ease_from(reader)};
    reader.refuse_other_keys();
    return move;
}

Step material_from(ObjectReader reader) {
    ChangeMaterial step{.change = material_change_from(reader),
                        .images = images_from(reader),
                        .ease = ease_from(reader)};
    reader.refuse_other_keys();
    return step;
}

Step finish_from(ObjectReader reader) {
    ChangeFinish step{.change = finish_change_from(reader),
                      .images = images_from(reader),
                      .ease = ease_from(reader)};
    reader.refuse_other_keys();
    return step;
}

Step rest_from(ObjectReader reader) {
    Rest rest;
    const json& until = reader.require("until");
    if (until != "exact") {
        if (!until.is_number()) {
            throw wire::WireError(wire::ErrorCode::wrong_type, reader.path_to("until"),
                                  wire::quote(until), "\"exact\" or a number of seconds");
        }
        rest.seconds = wire::number_from_json(until, reader.path_to("until"), kSeconds);
    }
    if (const json* timeout = reader.find("timeout_seconds")) {
        rest.timeout_seconds =
            wire::number_from_json(*timeout, reader.path_to("timeout_seconds"), kSeconds);
    }
    reader.refuse_other_keys();
    return rest;
}

const json& patch_from(ObjectReader& reader, const char* key) {
    const json& patch = reader.require(key);
    if (!patch.is_object()) {
        throw wire::WireError(wire::ErrorCode::wrong_type, reader.path_to(key),
                              wire::quote(patch), "an object");
    }
    return patch;
}

Step step_from(const json& value, const std::string& path) {
    ObjectReader reader(value, path);
    std::vector<Step> found;
    const auto take = [&](const char* key, Step (*step_from_reader)(ObjectReader)) {
        if (const json* inner = reader.find(key)) {
            found.push_back(step_from_reader(ObjectReader(*inner, reader.path_to(key))));
        }
    };
    take("rotate", rotate_from);
    take("move_light", move_light_from);
    take("blend", blend_from);
    take("camera", camera_from);
    take("material", material_from);
    take("finish", finish_from);
    take("rest", rest_from);
    if (reader.find("patch") != nullptr) {
        found.emplace_back(ApplyPatch{.patch = patch_from(reader, "patch")});
    }
    reader.refuse_other_keys();
    if (found.size() != 1) {
        throw wire::WireError(wire::ErrorCode::missing_field, path,
                              std::to_string(found.size()) + " kinds of step",
                              "exactly one of rotate, move_light, blend, camera, material, "
                              "finish, rest, patch");
    }
    return std::move(found.front());
}

SequenceScript script_from_json(const json& value) {
    SequenceScript script;
    ObjectReader reader(value, "");
    if (const json* scene = reader.find("scene")) {
        script.scene = wire::name_from_json(*scene, "/scene");
    }
    if (reader.find("start") != nullptr) {
        script.start = patch_from(reader, "start");
    }
    const json& steps = reader.require("steps");
    reader.refuse_other_keys();
    if (!steps.is_array() || steps.empty() || steps.size() > kMaxSteps) {
        throw wire::WireError(wire::ErrorCode::wrong_type, "/steps", wire::quote(steps),
                              "an array of 1 … " + std::to_string(kMaxSteps) + " steps");
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
        script.steps.push_back(step_from(steps[i], "/steps/" + std::to_string(i)));
    }
    return script;
}

// Great-circle interpolation; opposite directions turn about any axis across.
Imath::V3d direction_between(const Imath::V3d& from, const Imath::V3d& to, double way) {
    const double angle = std::atan2((from % to).length(), from ^ to);
    if (angle < 1e-9) {
        return to;
    }
    Imath::V3d across = to - from * (from ^ to);
    if (across.length() < 1e-9) {
        across = std::abs(from.x) < 0.9 ? Imath::V3d(1, 0, 0) : Imath::V3d(0, 1, 0);
        across -= from * (from ^ across);
    }
    return from * std::cos(angle * way) + across.normalized() * std::sin(angle * way);
}

// The last image stands at the end of the way; a single image does so at once.
double way_at(std::uint32_t index, std::uint32_t images, Ease ease) {
    return images <= 1 ? 1.0 : eased(ease, static_cast<double>(index) / (images - 1));
}

}  // namespace

double eased(Ease ease, double t) {
    switch (ease) {
        case Ease::linear:
            return t;
        case Ease::slow_fast_slow:
            return t * t * t * (t * (6 * t - 15) + 10);
        case Ease::slow_fast:
            return t * t;
        case Ease::fast_slow:
            return t * (2 - t);
    }
    return t;
}

SequenceScript sequence_script_from_text(std::string_view text) {
    try {
        return script_from_json(wire::parse_json(text, kMaxScriptBytes));
    } catch (const wire::WireError& error) {
        throw ClientError(std::string("sequence script: ") + error.what());
    }
}

std::uint32_t edit_count(const Step& step) {
    struct Count {
        std::uint32_t operator()(const Rotate& rotate) const { return rotate.images; }
        std::uint32_t operator()(const MoveLight& move) const { return move.images; }
        std::uint32_t operator()(const BlendOver& blend) const { return blend.images; }
        std::uint32_t operator()(const MoveCamera& move) const { return move.images; }
        std::uint32_t operator()(const ChangeMaterial& step) const { return step.images; }
        std::uint32_t operator()(const ChangeFinish& step) const { return step.images; }
        std::uint32_t operator()(const ApplyPatch&) const { return 1; }
        std::uint32_t operator()(const Rest&) const { return 0; }
    };
    return std::visit(Count{}, step);
}

json patch_of(const Step& step, std::uint32_t index) {
    if (const auto* rotate = std::get_if<Rotate>(&step)) {
        const double way = way_at(index, rotate->images, rotate->ease);
        return {{"rotation",
                 {{"yaw_degrees", rotate->yaw_degrees.at(way)},
                  {"pitch_degrees", rotate->pitch_degrees.at(way)},
                  {"roll_degrees", rotate->roll_degrees.at(way)}}}};
    }
    if (const auto* move = std::get_if<MoveLight>(&step)) {
        const Imath::V3d d =
            direction_between(move->from, move->to, way_at(index, move->images, move->ease));
        return {{"lights", {{move->id, {{"direction", {d.x, d.y, d.z}}}}}}};
    }
    if (const auto* blend = std::get_if<BlendOver>(&step)) {
        const double way = way_at(index, blend->images, blend->ease);
        return {{"blend", {{"name", blend->name}, {"amount", blend->amount.at(way)}}}};
    }
    if (const auto* camera = std::get_if<MoveCamera>(&step)) {
        return camera->path.patch_at(way_at(index, camera->images, camera->ease));
    }
    if (const auto* material = std::get_if<ChangeMaterial>(&step)) {
        return material->change.patch_at(way_at(index, material->images, material->ease));
    }
    if (const auto* finish = std::get_if<ChangeFinish>(&step)) {
        return finish->change.patch_at(way_at(index, finish->images, finish->ease));
    }
    if (const auto* apply = std::get_if<ApplyPatch>(&step)) {
        return apply->patch;
    }
    return json::object();
}

}  // namespace relume::cli
