#include "config/presets/assigner_names.h"

#include "assign/contract/assigner.h"
#include "core/error.h"
#include "core/text.h"
#include "core/wildcards.h"

namespace clusterbench::config {

bool is_glob(const std::string& name) {
  return name.find_first_of("*?[") != std::string::npos;
}

std::vector<std::string> matching_assigners(const std::string& pattern, const std::string& file,
                                            const std::string& where) {
  std::vector<std::string> defaults, others;
  for (const assign::AssignerDescriptor* descriptor : assign::assigner_descriptors())
    if (matches_wildcards(pattern, descriptor->name))
      (descriptor->is_default() ? defaults : others).push_back(descriptor->name);
  if (defaults.empty() && others.empty())
    throw Error(file, where, "'" + pattern + "' matches none of " + joined(assign::assigner_names()));
  return defaults.empty() ? others : defaults;
}

}  // namespace clusterbench::config
