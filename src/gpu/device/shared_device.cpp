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

// Never closed: at the end of the process a driver's own statics are gone before these would be, and drivers crash.
Shared& shared() {
  static Shared& only = *new Shared;
  return only;
}

std::recursive_mutex& sharing() {
  static std::recursive_mutex only;
  return only;
}

}  // namespace

void use_device(const std::string& wanted) {
  const std::lock_guard lock(sharing());
  Shared& now = shared();
  if (now.wanted == wanted) return;
  now = Shared{wanted, nullptr, ""};
}

Device& device() {
  const std::lock_guard lock(sharing());
  Shared& now = shared();
  if (!now.device) now.device = std::make_unique<Device>(now.wanted);
  return *now.device;
}

std::string device_obstacle() {
  const std::lock_guard lock(sharing());
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
