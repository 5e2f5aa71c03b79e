#pragma once
// A plug-in in the test's own memory, whose parts tests make wrong.

#include <string>
#include <vector>

#include "plugin/clusterbench_plugin.h"

namespace clusterbench::plugin::testing {

// One method "cells" without pairs, with a parameter of each type: "on", "size" and "way".
struct PluginByHand {
  PluginByHand() {
    flag = {sizeof flag, CLUSTERBENCH_PARAMETER_FLAG, 0, 0, "on", "on or off", "", 1.0, 0.0, 0.0, 0.0, nullptr,
            nullptr};
    number = {sizeof number,
              CLUSTERBENCH_PARAMETER_NUMBER,
              CLUSTERBENCH_PARAMETER_CONSERVATIVE_FROM,
              0,
              "size",
              "a size",
              "m",
              2.0,
              0.5,
              8.0,
              1.0,
              nullptr,
              nullptr};
    text = {sizeof text,   CLUSTERBENCH_PARAMETER_TEXT, 0, 2, "way", "a way", nullptr, 0.0, 0.0, 0.0, 0.0, "fast",
            choices.data()};
    method.struct_size = sizeof method;
    method.grid_kinds = CLUSTERBENCH_FRUSTUM | CLUSTERBENCH_WORLD;
    method.light_types = CLUSTERBENCH_POINTS | CLUSTERBENCH_BOXES;
    method.flags = CLUSTERBENCH_ORTHOGRAPHIC;
    method.name = "cells";
    method.summary = "no cell";
    method.source = "a test";
    method.parameters = parameters.data();
    method.parameter_count = 3;
    method.create = [](const clusterbench_method*, const clusterbench_value*, std::uint32_t, void**,
                       clusterbench_error*) -> clusterbench_status { return CLUSTERBENCH_OK; };
    method.build = [](void*, const clusterbench_grid*, std::uint32_t, clusterbench_error*) -> clusterbench_status {
      return CLUSTERBENCH_OK;
    };
    method.assign = [](void*, const clusterbench_frame*, const clusterbench_lights*, clusterbench_lists* out,
                       clusterbench_error*) -> clusterbench_status {
      for (std::uint32_t cell = 0; cell <= out->cell_count; ++cell) out->begin[cell] = 0;
      return CLUSTERBENCH_OK;
    };
    method.destroy = [](void*) {};
    plugin = {sizeof plugin, CLUSTERBENCH_PLUGIN_MAJOR, 0, 1, "hand", "By hand", "1.5", methods.data()};
  }
  PluginByHand(const PluginByHand&) = delete;
  PluginByHand& operator=(const PluginByHand&) = delete;

  std::vector<const char*> choices{"fast", "slow"};
  clusterbench_parameter flag{}, number{}, text{};
  std::vector<const clusterbench_parameter*> parameters{&flag, &number, &text};
  clusterbench_method method{};
  std::vector<const clusterbench_method*> methods{&method};
  clusterbench_plugin plugin{};
};

}  // namespace clusterbench::plugin::testing
