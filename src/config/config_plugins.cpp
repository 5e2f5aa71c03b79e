#include "config/config_plugins.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "assign/contract/assigner.h"
#include "config/config.h"
#include "config/config_scenes.h"
#include "core/error.h"
#include "core/file_text.h"

namespace clusterbench::config {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// With the place that names the file in front of what is wrong with it.
void load_from(const fs::path& file, const std::string& id, const std::string& named_by, const std::string& where) {
  try {
    plugin::load_plugin(file, id);
  } catch (const Error& error) {
    throw Error(named_by, where, error.what(), error.code());
  }
}

// What is no list of texts is refused where the configuration is read.
void load_listed(const JsonText& text) {
  if (!text.value.is_object() || !text.value.contains("plugins") || !text.value["plugins"].is_array()) return;
  const Json& list = text.value["plugins"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_string()) continue;
    const std::string where = text.where(child_pointer("/plugins", i));
    const plugin::PluginName name = plugin::plugin_name(list[i].get<std::string>());
    if (name.file.empty()) throw Error(text.file, where, "names no file of a plug-in; takes FILE or ID=FILE");
    load_from(path_in(text, name.file, where), name.id, text.file, where);
  }
}

// A method as a user names it, and where: a file, or "", and the place.
struct NamedMethod {
  std::string name, file, where;
};

std::vector<NamedMethod> named_methods(const JsonText& text, std::span<const FlagValue> flags) {
  std::vector<NamedMethod> names;
  const Json& document = text.value;
  const Json list = document.is_object() ? document.value("assigners", Json::array()) : Json::array();
  for (std::size_t i = 0; i < list.size() && list.is_array(); ++i) {
    const Json name = list[i].is_object() ? list[i].value("name", Json()) : list[i];
    if (name.is_string())
      names.push_back({name.get<std::string>(), text.file, text.where(child_pointer("/assigners", i))});
  }
  for (const FlagValue& flag : flags) {
    std::istringstream parts(flag.name == "--assigner" ? flag.value : "");
    for (std::string part; std::getline(parts, part, ',');) names.push_back({part, "", flag.shown()});
  }
  return names;
}

// "acme.tiles" of a plug-in that is not there. The program's own names can have a dot, too.
void refuse_absent(const NamedMethod& method, const std::string& id) {
  const auto begins_so = [&](const std::string& own) { return own.starts_with(id + "."); };
  if (!plugin::is_name(id) || std::ranges::any_of(assign::assigner_names(), begins_so)) return;
  throw Error(method.file, method.where,
              "'" + method.name + "' is a method of the plug-in '" + id +
                  "', which is not there: name its file by --plugin FILE or the key \"plugins\", or have it as " + id +
                  ".so in a folder of the variable " + plugin::k_path_variable + ", which " + plugin::path_text());
}

// A file can be named otherwise than its plug-in.
void refuse_file_name(const NamedMethod& method, const std::string& name) {
  const plugin::LoadedPlugin* loaded = plugin::find_plugin_of_file(name);
  if (loaded == nullptr || loaded->facts.id == name) return;
  throw Error(method.file, method.where,
              "'" + method.name + "': " + name + ".so has the id '" + loaded->facts.id + "'; name its method " +
                  loaded->facts.id + method.name.substr(name.size()) + ", or have the file as --plugin " + name +
                  "=FILE");
}

void load_named(JsonText& text, std::span<const FlagValue> flags) {
  const bool has_shaders = (text.value.is_object() && text.value.contains("shaders")) ||
                           std::ranges::any_of(flags, [](const FlagValue& flag) { return flag.name == "--shader"; });
  for (const NamedMethod& method : named_methods(text, flags)) {
    const std::string& name = method.name;
    const std::string id = name.substr(0, name.find('.'));
    const bool is_known = assign::find_assigner(name) != nullptr || plugin::find_plugin(id) != nullptr;
    if (id == name || id.empty() || is_known) continue;
    refuse_file_name(method, id);
    const fs::path file = plugin::file_on_path(id);
    if (file.empty() && !has_shaders) refuse_absent(method, id);  // theirs are read later
    if (file.empty()) continue;
    load_from(file, "", "", plugin::k_path_variable);
    refuse_file_name(method, id);
    text.value["plugins"].push_back(fs::absolute(file).generic_string());
  }
}

}  // namespace

void load_plugins(std::span<const FlagValue> flags) {
  for (const FlagValue& flag : flags) {
    if (flag.name != "--plugin") continue;
    const plugin::PluginName name = plugin::plugin_name(flag.value);
    load_from(name.file, name.id, "", flag.shown());
  }
}

void load_plugins(JsonText& text, std::span<const FlagValue> flags) {
  load_listed(text);
  load_plugins(flags);
  load_named(text, flags);
}

std::vector<const plugin::LoadedPlugin*> plugins_of(const Config& config) {
  std::vector<const plugin::LoadedPlugin*> all;
  for (const MethodRequest& method : config.assigners) {
    const assign::AssignerDescriptor* descriptor = assign::find_assigner(method.name);
    const plugin::LoadedPlugin* loaded = descriptor == nullptr ? nullptr : plugin::find_plugin(descriptor->plugin);
    if (loaded != nullptr && std::ranges::find(all, loaded) == all.end()) all.push_back(loaded);
  }
  return all;
}

void name_plugins(const Config& config, nlohmann::ordered_json& written) {
  written.erase("plugins");
  for (const plugin::LoadedPlugin* loaded : plugins_of(config)) written["plugins"].push_back(loaded->text());
}

std::string plugin_path_for(const std::string& configuration, const std::string& given) {
  if (configuration.empty() || is_stream_name(configuration)) return given;
  plugin::PluginName name = plugin::plugin_name(given);
  std::error_code failed;
  const fs::path folder = fs::absolute(configuration).parent_path();
  const fs::path path = fs::proximate(fs::absolute(name.file), folder, failed);
  name.file = (failed ? fs::absolute(name.file) : path).generic_string();
  return name.text();
}

}  // namespace clusterbench::config
