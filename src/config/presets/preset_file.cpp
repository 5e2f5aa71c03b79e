#include "config/presets/preset_file.h"

#include <algorithm>
#include <filesystem>

#include "assign/contract/assigner.h"
#include "config/presets/preset_tiles.h"
#include "config/schema/json_text.h"
#include "core/error.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

[[noreturn]] void refuse_member(const JsonText& text, const std::string& pointer, const std::string& message) {
  throw Error(text.file, text.where(pointer), message);
}

void check_word(const JsonText& text, const std::string& key, const std::vector<std::string>& allowed) {
  const auto& word = text.value[key].get_ref<const std::string&>();
  if (std::ranges::find(allowed, word) == allowed.end())
    refuse_member(text, "/" + key,
                  "found '" + word + "'" + did_you_mean(word, allowed) + ", allowed: " + joined(allowed));
}

void check_words(const JsonText& text) {
  for (const result::Field& field : result::type_of<Preset>().fields)
    if (const auto& choices = field.about.choices; !choices.empty())
      check_word(text, field.name, {choices.begin(), choices.end()});
  if (text.value.contains("tiles_by")) check_word(text, "tiles_by", tiles_by_names());
}

// A name that no method has is refused as in a configuration, by the schema: a program may know no methods on devices.
void check_device_method(const Preset& preset, const JsonText& text) {
  const result::Json& entry = preset.on_device->assigner;
  const std::string pointer = "/on_device/assigner";
  if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string())
    refuse_member(text, pointer, "found " + entry.dump() + ", allowed: an entry of assigners, {\"name\": ...}");
  const std::string name = entry["name"].get<std::string>();
  const assign::AssignerDescriptor* method = assign::find_assigner(name);
  if (method != nullptr && !method->on_device)
    refuse_member(text, pointer + "/name", "found '" + name + "', allowed: a method that runs on a device (gpu-*)");
}

// Without a method on a device a reader wants to know why.
void check_on_device(const Preset& preset, const JsonText& text) {
  if (!preset.assigns_on_gpu()) {
    for (const char* key : {"on_device", "not_on_device"})
      if (text.value.contains(key))
        refuse_member(text, std::string("/") + key, "is allowed only beside \"assigns_on\": \"gpu\"");
    return;
  }
  if (preset.on_device.has_value() == preset.not_on_device.has_value())
    refuse_member(text, "/assigns_on",
                  std::string("is gpu, and ") + (preset.on_device ? "both" : "neither") +
                      " of on_device and not_on_device is there; allowed: one of them");
  if (preset.on_device) check_device_method(preset, text);
}

}  // namespace

Preset read_preset(const std::string& text, const std::string& file) {
  const JsonText json = parse_json_text(text, file);
  Preset preset;
  try {
    preset = result::from_json<Preset>(result::Json(json.value));
  } catch (const Error& error) {
    const std::string& pointer = error.where();
    refuse_member(json, pointer, (json.has(pointer) ? "" : pointer + " ") + error.message());
  }
  check_words(json);
  if (const std::string stem = std::filesystem::path(file).stem().string(); preset.name != stem)
    refuse_member(json, "/name", "found '" + preset.name + "', allowed: the name of the file, '" + stem + "'");
  if (preset.mistakes.has_value() != preset.as_shipped.has_value())
    refuse_member(json, "", "has one of mistakes and as_shipped; allowed: both, or neither");
  check_on_device(preset, json);
  return preset;
}

}  // namespace clusterbench::config
