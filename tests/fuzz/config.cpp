// A configuration, as `run` and `validate` read it.

#include "run/config.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered(
      [&] { static_cast<void>(run::parse_config(std::string(data, data + size), "configuration.json")); });
}
