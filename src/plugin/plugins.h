#pragma once
// Plug-ins that this process has loaded. They stay until it ends, and their methods are in the registry of methods.

#include <filesystem>
#include <string>
#include <vector>

#include "plugin/read_plugin.h"

namespace clusterbench::plugin {

struct LoadedPlugin {
  std::filesystem::path file;  // absolute
  std::string sha256;          // of the file
  PluginFacts facts;
  std::string given_id;  // by which a user named it; "": its own

  // As configurations in any folder name it: "/build/acme.so", "old=/build/acme.so".
  std::string text() const;
};

// A plug-in as users name it: FILE, or ID=FILE to have its methods named ID.METHOD, so that two builds of it run side
// by side. A file whose own name begins so is named with its folder ("./a=b.so").
struct PluginName {
  std::string id;  // "": its own
  std::string file;

  std::string text() const { return id.empty() ? file : id + "=" + file; }
};
PluginName plugin_name(const std::string& text);

// Loads a plug-in's file, unless it is loaded already, and registers its methods. Not while methods run. Throws Error,
// which names the file and says what is wrong: it is missing, no shared library, no plug-in, of another version;
// another file has its id; it has changed since it was loaded, or was loaded with another id. `id`: "" for its own.
const LoadedPlugin& load_plugin(const std::filesystem::path& file, const std::string& id = "");

// The loaded plug-in with this id; null if there is none.
const LoadedPlugin* find_plugin(const std::string& id);
// That of a file NAME.so, whatever its id is. Null if none is loaded.
const LoadedPlugin* find_plugin_of_file(const std::string& name);

// Loads a plug-in's file and reads what it says, without registering anything.
PluginFacts describe_plugin(const std::filesystem::path& file);

// The variable whose folders (separated by ':') hold plug-ins.
inline constexpr const char* k_path_variable = "CLUSTERBENCH_PLUGIN_PATH";
// The first ID.so in these folders; "" if there is none.
std::filesystem::path file_on_path(const std::string& id);
// "is not set", or "has /a, /b (does not exist)": for messages.
std::string path_text();
// All *.so in them, the first of each name, in the order of folders and names.
std::vector<std::filesystem::path> files_on_path();

}  // namespace clusterbench::plugin
