// A configuration, as `run` and `validate` read it.

#include "config/config.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered(
      [&] { static_cast<void>(config::parse_config(std::string(data, data + size), "configuration.json")); });
}
