// The method that CONTRIBUTING.md writes out, as a plug-in: the same file, and this one beside it.

#include "plugin/exported_method.h"

namespace clusterbench::assign {
extern const AssignerDescriptor cell_spheres_descriptor;
}

extern "C" CLUSTERBENCH_EXPORT const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host*) {
  using clusterbench::plugin::ExportedMethod;
  static const ExportedMethod method(clusterbench::assign::cell_spheres_descriptor);
  static const clusterbench_method* const methods[] = {method.table()};
  static const clusterbench_plugin plugin{sizeof plugin,
                                          CLUSTERBENCH_PLUGIN_MAJOR,
                                          CLUSTERBENCH_PLUGIN_MINOR,
                                          1,
                                          "contributing",
                                          "The example of CONTRIBUTING.md",
                                          "1.0",
                                          methods};
  return &plugin;
}
