#pragma once
// What a plug-in says of itself, copied out of its memory and checked. Nothing of its methods runs here.

#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "plugin/clusterbench_plugin.h"

namespace clusterbench::plugin {

// A method of a plug-in: the descriptor, without the functions that make instances, and the table in the plug-in.
struct MethodFacts {
  assign::AssignerDescriptor descriptor;     // its name has the plug-in's id in front: "acme.tiles"
  clusterbench_method table{};               // members that the plug-in does not have are 0
  const clusterbench_method* own = nullptr;  // the plug-in's own, which its functions get
  std::uint32_t unknown_needs = 0;
};

struct PluginFacts {
  std::string id, name, version;
  std::uint32_t minor = 0;  // of the interface that it was made for
  std::vector<MethodFacts> methods;
  std::vector<std::string> changes_on_loading;  // of what the process has once: "the locale, to C.UTF-8"
};

// `file`: for messages. `id`: in place of its own in the names of methods; "" for its own. Throws Error for a plug-in
// of another major version, and with the place of any member that is not as clusterbench_plugin.h says.
PluginFacts read_plugin(const std::string& file, const clusterbench_plugin* given, const std::string& id = "");

// May a plug-in, or a method, be named so: lower-case letters, digits and '-', beginning with a letter, at most 64?
bool is_name(std::string_view text);

}  // namespace clusterbench::plugin
