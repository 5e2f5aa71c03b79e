#include "config/config_unset.h"

#include <algorithm>
#include <cstdint>

#include "core/text.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

// For runs whose limits the user did not choose (scenes on the command line, presets): they should end within two
// minutes on two cores.
constexpr std::uint64_t k_usual_most_pairs = 4'000'000;
constexpr int k_usual_frames = 30;
constexpr double k_usual_lights = 1200.0;

// "samples": {} requests no set.
bool names_surfaces(const Json& document) {
  return document.contains("samples") && document["samples"].is_object() &&
         (document["samples"].empty() || document["samples"].contains("opaque"));
}
bool removes_samples(std::span<const FlagValue> flags) {
  return std::ranges::any_of(flags,
                             [](const FlagValue& flag) { return flag.name == "--set" && flag.value == "samples={}"; });
}

void add_surfaces(Json& document) {
  Json& samples = document["samples"];
  if (samples.is_null() || (samples.is_object() && !samples.contains("opaque"))) samples["opaque"] = {{"divisor", 16}};
}

}  // namespace

UnsetDefaults::UnsetDefaults(const JsonText& text, std::span<const FlagValue> flags)
    : has_scenes_only_(text.file.empty()),
      names_surfaces_(names_surfaces(text.value) || names_key(flags, "samples[./]opaque") || removes_samples(flags)),
      names_accuracy_(text.value.contains("accuracy") || names_key(flags, "accuracy")) {}

void UnsetDefaults::add_to(Json& document) const {
  const bool has_presets = document.contains("presets");
  if (!names_accuracy_ && (has_scenes_only_ || has_presets)) document["accuracy"]["most_pairs"] = k_usual_most_pairs;
  if (has_presets && !names_surfaces_) add_surfaces(document);
}

Json document_of_scenes(std::span<const std::filesystem::path> scenes) {
  Json list = Json::array();
  for (const std::filesystem::path& path : scenes)
    list.push_back(
        {{"path", path.generic_string()}, {"frames", {{"most", k_usual_frames}, {"lights", k_usual_lights}}}});
  return {{"name", scenes.size() == 1 ? printable(scenes.front().stem().string()) : "scenes"},
          {"scenes", list},
          {"timing", {{"rounds", 15}, {"min_time_ms", 2}, {"frames", 4}}}};
}

}  // namespace clusterbench::config
