#include "cli/options/plugin_option.h"

#include "core/error.h"
#include "plugin/plugins.h"

namespace clusterbench::cli {

void add_plugin_option(Command& command, std::vector<std::string>& plugins) {
  command.add_option(k_plugin_flag, plugins, "[ID=]FILE, repeatable: also the methods of a plug-in (docs/plugins.md)")
      .once_a_name()
      .utf8();
}

void load_plugins(const std::vector<std::string>& plugins) {
  for (const std::string& text : plugins) {
    const plugin::PluginName name = plugin::plugin_name(text);
    try {
      plugin::load_plugin(name.file, name.id);
    } catch (const Error& error) {
      throw Error("", k_plugin_flag, error.what());
    }
  }
}

}  // namespace clusterbench::cli
