#include "config/presets/preset_file.h"

#include <algorithm>
#include <filesystem>

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
  return preset;
}

}  // namespace clusterbench::config
