/* Plug-ins that are wrong before any method runs, by what they are compiled with. */

#include <pthread.h>
#include <stdlib.h>

#include "clusterbench_plugin.h"

#if defined(ENTRY_VERSION_2)
const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host) {
  static const clusterbench_plugin plugin = {sizeof(clusterbench_plugin), 2, 0, 1, "later", "Later", "1", NULL};
  (void)host;
  return &plugin;
}
#elif defined(ENTRY_CRASHES)
const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host) {
  (void)host;
  abort();
}
#elif defined(ENTRY_ENDS_THREAD)
const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host) {
  (void)host;
  pthread_exit(NULL);
}
#elif defined(ENTRY_NULL)
const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host) {
  (void)host;
  return NULL;
}
#elif defined(ENTRY_HANGS)
const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host) {
  volatile int stop = 0;
  (void)host;
  while (!stop) {
  }
  return NULL;
}
#else
int nothing_of_that_name(void);
int nothing_of_that_name(void) {
  return 1;
}
#endif
