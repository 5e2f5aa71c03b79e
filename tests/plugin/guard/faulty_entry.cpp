// A plug-in that crashes as it is loaded.

#include <csignal>

#include "clusterbench_plugin.h"

extern "C" CLUSTERBENCH_EXPORT const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host*) {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
  return nullptr;
}
