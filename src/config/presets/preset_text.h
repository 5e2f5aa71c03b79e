#pragma once
// The files of configs/presets, embedded by the build (cmake/ClusterbenchEmbed.cmake).

#include <span>
#include <string_view>

namespace clusterbench::config {

struct PresetText {
  std::string_view name, text;  // of configs/presets/NAME.json
};

// In the order of the list in CMakeLists.txt, in which presets are shown.
std::span<const PresetText> preset_texts();

}  // namespace clusterbench::config
