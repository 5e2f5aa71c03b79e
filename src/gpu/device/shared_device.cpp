// The device of this process.

#include <optional>

#include "core/error.h"
#include "gpu/device/device.h"

namespace clusterbench::gpu {
namespace {

struct Shared {
  std::mutex busy;  // while one of the functions below uses the others
  std::string wanted;
  std::optional<DeviceFacts> before;  // of the first device that these words named
  std::unique_ptr<Device> device;
  std::string obstacle;
  bool has_robust_buffers = false;
};

// Never destroyed: at the end of the process the threads of some drivers have ended before its statics are destroyed.
Shared& shared() {
  static Shared& only = *new Shared;
  return only;
}

// One that cannot be opened again, after a failure, ends the cases that run on it as the failure did.
Device& opened(Shared& now) {
  if (now.device) return *now.device;
  try {
    now.device = std::make_unique<Device>(now.wanted, now.before ? &*now.before : nullptr, now.has_robust_buffers);
    now.before = now.device->facts();
  } catch (const DeviceError&) {
    throw;
  } catch (const Error& error) {
    throw DeviceError(error.message());
  }
  return *now.device;
}

}  // namespace

void use_device(const std::string& wanted) {
  Shared& now = shared();
  const std::lock_guard turn(now.busy);
  if (now.wanted == wanted) return;
  now.wanted = wanted;
  now.before.reset();
  now.device.reset();
  now.obstacle.clear();
}

void use_robust_buffers() {
  Shared& now = shared();
  const std::lock_guard turn(now.busy);
  now.has_robust_buffers = true;
}

void close_device() {
  const std::lock_guard turn(shared().busy);
  shared().device.reset();
}

Device& device() {
  Shared& now = shared();
  const std::lock_guard turn(now.busy);
  return opened(now);
}

std::string device_obstacle() {
  Shared& now = shared();
  const std::lock_guard turn(now.busy);
  if (now.device || !now.obstacle.empty()) return now.obstacle;
  try {
    opened(now);
  } catch (const Error& error) {
    now.obstacle = error.message();
  }
  return now.obstacle;
}

}  // namespace clusterbench::gpu
