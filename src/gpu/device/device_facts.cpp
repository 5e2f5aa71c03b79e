#include "gpu/device/device_facts.h"

namespace clusterbench::gpu {

std::string type_name(DeviceType type) {
  switch (type) {
    case DeviceType::discrete:
      return "discrete GPU";
    case DeviceType::integrated:
      return "integrated GPU";
    case DeviceType::virtual_gpu:
      return "virtual GPU";
    case DeviceType::software:
      return "software";
    case DeviceType::other:
      break;
  }
  return "other";
}

}  // namespace clusterbench::gpu
