/* A method that takes parameters which it does not have; with ENDS_THREAD it also ends the thread that calls it. */

#include <pthread.h>

#include "clusterbench_plugin.h"

static clusterbench_status create(const clusterbench_method* method, const clusterbench_value* values,
                                  uint32_t value_count, void** made, clusterbench_error* error) {
  (void)method;
  (void)values;
  (void)value_count;
  (void)made;
  (void)error;
  return CLUSTERBENCH_OK;
}

static clusterbench_status build(void* made, const clusterbench_grid* grid, uint32_t light_types,
                                 clusterbench_error* error) {
  (void)made;
  (void)grid;
  (void)light_types;
  (void)error;
  return CLUSTERBENCH_OK;
}

static clusterbench_status assign(void* made, const clusterbench_frame* frame, const clusterbench_lights* lights,
                                  clusterbench_lists* out, clusterbench_error* error) {
  uint32_t cell;
  (void)made;
  (void)frame;
  (void)lights;
  (void)error;
#ifdef ENDS_THREAD
  pthread_exit(NULL);
#endif
  for (cell = 0; cell <= out->cell_count; ++cell) out->begin[cell] = 0;
  return CLUSTERBENCH_OK;
}

static void destroy(void* made) {
  (void)made;
}

const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host) {
  static const clusterbench_method method = {sizeof(clusterbench_method),
                                             CLUSTERBENCH_FRUSTUM,
                                             CLUSTERBENCH_POINTS | CLUSTERBENCH_SPOTS | CLUSTERBENCH_BOXES,
                                             0,
                                             0,
                                             0,
                                             "takes-all",
                                             "no cell",
                                             "a test",
                                             NULL,
                                             create,
                                             build,
                                             assign,
                                             destroy};
  static const clusterbench_method* const methods[] = {&method};
  static const clusterbench_plugin plugin = {sizeof(clusterbench_plugin),
                                             CLUSTERBENCH_PLUGIN_MAJOR,
                                             CLUSTERBENCH_PLUGIN_MINOR,
                                             1,
                                             "takes-all",
                                             "Takes all",
                                             "1",
                                             methods};
  (void)host;
  return &plugin;
}
