#include "config/config_shaders.h"

#include <algorithm>
#include <filesystem>

#include "config/config_scenes.h"
#include "core/file_text.h"
#include "gpu/user_shaders/shader_method.h"

namespace clusterbench::config {

namespace fs = std::filesystem;

std::vector<std::string> add_shaders(const JsonText& text) {
  std::vector<std::string> names;
  if (!text.value.is_object() || !text.value.contains("shaders") || !text.value["shaders"].is_array()) return names;
  const nlohmann::json& list = text.value["shaders"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_string() || list[i].get_ref<const std::string&>().empty()) continue;
    const std::string where = text.where(child_pointer("/shaders", i));
    names.push_back(gpu::add_shader_method(path_in(text, list[i].get<std::string>(), where)).name);
  }
  return names;
}

nlohmann::json with_shaders(nlohmann::json assigners, const std::vector<std::string>& shaders) {
  for (const std::string& name : shaders)
    if (std::none_of(assigners.begin(), assigners.end(), [&](const nlohmann::json& entry) {
          return entry == name || (entry.is_object() && entry["name"] == name);
        }))
      assigners.push_back(name);
  return assigners;
}

std::string shader_path_for(const std::string& configuration, const std::string& given) {
  if (configuration.empty() || is_stream_name(configuration)) return given;
  std::error_code failed;
  const fs::path whole = fs::absolute(given), folder = fs::absolute(configuration).parent_path();
  const fs::path path = fs::proximate(whole, folder, failed);
  return (failed ? whole : path).generic_string();
}

}  // namespace clusterbench::config
