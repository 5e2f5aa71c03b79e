// Other shaders for the tests of the layer gpu. Where CLUSTERBENCH_SWAPPED_SHADERS names a folder with
// NAME_VARIANT.spv, that is the module in place of the embedded one. The linker puts this function before shader_code()
// (--wrap); nothing of the product knows.

#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "gpu/vulkan/shader_code.h"

namespace {

using Code = std::span<const std::uint32_t>;

std::vector<std::uint32_t> words_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  std::vector<std::uint32_t> words(static_cast<std::size_t>(file.tellg()) / sizeof(std::uint32_t));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof(std::uint32_t)));
  return words;
}

}  // namespace

extern "C" {
// The types are those of shader_code(): the same call.
Code __real__ZN12clusterbench3gpu11shader_codeESt17basic_string_viewIcSt11char_traitsIcEEb(std::string_view, bool);
Code __wrap__ZN12clusterbench3gpu11shader_codeESt17basic_string_viewIcSt11char_traitsIcEEb(std::string_view, bool);
}

Code __wrap__ZN12clusterbench3gpu11shader_codeESt17basic_string_viewIcSt11char_traitsIcEEb(std::string_view shader,
                                                                                           bool rounds_to_nearest) {
  static std::map<std::string, std::vector<std::uint32_t>> swapped;
  if (const char* folder = std::getenv("CLUSTERBENCH_SWAPPED_SHADERS"); folder != nullptr) {
    const std::string name = std::string(shader) + (rounds_to_nearest ? "_to_nearest" : "_plain");
    std::vector<std::uint32_t>& words =
        swapped.try_emplace(name, words_of_file(folder + ("/" + name) + ".spv")).first->second;
    if (!words.empty()) return words;
  }
  return __real__ZN12clusterbench3gpu11shader_codeESt17basic_string_viewIcSt11char_traitsIcEEb(shader,
                                                                                               rounds_to_nearest);
}
