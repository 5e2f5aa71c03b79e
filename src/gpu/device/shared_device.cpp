// The device of this process.

#include "core/error.h"
#include "gpu/device/device.h"

namespace clusterbench::gpu {
namespace {

struct Shared {
  std::string wanted;
  std::unique_ptr<Device> device;
  std::string obstacle;
};

Shared& shared() {
  static Shared only;
  return only;
}

}  // namespace

void use_device(const std::string& wanted) {
  Shared& now = shared();
  if (now.wanted == wanted) return;
  now = Shared{wanted, nullptr, ""};
}

void close_device() {
  shared().device.reset();
}

Device& device() {
  Shared& now = shared();
  if (!now.device) now.device = std::make_unique<Device>(now.wanted);
  return *now.device;
}

std::string device_obstacle() {
  Shared& now = shared();
  if (now.device || !now.obstacle.empty()) return now.obstacle;
  try {
    device();
  } catch (const Error& error) {
    now.obstacle = error.message();
  }
  return now.obstacle;
}

}  // namespace clusterbench::gpu
