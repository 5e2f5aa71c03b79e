#include "plugin/interface_in_c.h"

#include "plugin/clusterbench_plugin.h"

size_t sizes_in_c(size_t* sizes, size_t most) {
  const size_t all[] = {sizeof(clusterbench_error), sizeof(clusterbench_parameter), sizeof(clusterbench_value),
                        sizeof(clusterbench_grid),  sizeof(clusterbench_frame),     sizeof(clusterbench_lights),
                        sizeof(clusterbench_lists), sizeof(clusterbench_method),    sizeof(clusterbench_host),
                        sizeof(clusterbench_log),   sizeof(clusterbench_plugin)};
  size_t i;
  for (i = 0; i < sizeof all / sizeof all[0] && i < most; ++i) sizes[i] = all[i];
  return sizeof all / sizeof all[0];
}

int check_in_c(const char* const* names, char* text, unsigned capacity) {
  clusterbench_parameter a = {0}, b = {0};
  const clusterbench_parameter* parameters[2];
  clusterbench_method method = {0};
  clusterbench_value values[8];
  clusterbench_error error;
  uint32_t count = 0;
  a.name = "a";
  b.name = "b";
  parameters[0] = &a;
  parameters[1] = &b;
  method.parameter_count = 2;
  method.parameters = parameters;
  error.struct_size = sizeof error;
  error.capacity = capacity;
  error.text = text;
  for (; names[count] != NULL && count < 8; ++count) values[count].name = names[count];
  return clusterbench_check_values(&method, values, count, &error);
}
