// Any JSON document, as everything but scenes reads one, in both kinds of value; what is read can be copied and
// written.

#include "core/json_document.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  const std::string text(data, data + size);
  fuzz::answered([&] {
    const auto sorted = read_json<nlohmann::json>(text, "a.json", JsonComments::allowed);
    static_cast<void>(nlohmann::json(sorted).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  });
  return fuzz::answered([&] { static_cast<void>(read_json<nlohmann::ordered_json>(text, "a.json")); });
}
