#pragma once
// Defaults that depend on other keys of a configuration: of scenes on the command line, and of presets.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "config/config_flags.h"
#include "config/schema/json_text.h"

namespace clusterbench::config {

// Defaults for settings that neither the file nor a flag has. Presets are ranked by their cost at visible surfaces: a
// ray per 16 x 16 pixels.
class UnsetDefaults {
 public:
  UnsetDefaults(const JsonText& text, std::span<const FlagValue> flags);
  void add_to(nlohmann::json& document) const;

 private:
  bool has_scenes_only_, names_surfaces_, names_accuracy_;
};

// The configuration of scenes on the command line.
nlohmann::json document_of_scenes(std::span<const std::filesystem::path> scenes);

}  // namespace clusterbench::config
