#pragma once
// The files of configs/presets, embedded by the build (cmake/ClusterbenchEmbed.cmake).

#include <span>
#include <string_view>

namespace clusterbench::config {

struct PresetText {
  std::string_view name, text;  // of configs/presets/NAME.json
};

// In the order in which presets are shown, which is that of the list in CMakeLists.txt.
std::span<const PresetText> preset_texts();

}  // namespace clusterbench::config
