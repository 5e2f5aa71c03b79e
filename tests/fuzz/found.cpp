// What `worst-case -o FILE` found, as `size` reads it beside a result.

#include "fuzz/input.h"
#include "report/sizing/found_frames.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered(
      [&] { static_cast<void>(report::read_found(fuzz::written(data, size, ".json").string(), result::Result())); });
}
