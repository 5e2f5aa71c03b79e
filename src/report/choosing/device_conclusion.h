#pragma once
// What a conclusion says of the methods that run on a device.

#include <optional>
#include <string>

#include "report/choosing/weighed_cases.h"

namespace clusterbench::report {

// Sentences after the conclusion on methods of the processor; "" if no method of the view runs on a device. A device's
// times rank only its own methods, and those of a software device none.
std::string device_text(const SceneView& view, const std::optional<result::Device>& device);

}  // namespace clusterbench::report
