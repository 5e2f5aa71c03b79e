// What an interrupted run left beside its result, and the run that goes on from it.

#include "report/documents/journal.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered([&] {
    static_cast<void>(fuzz::written(data, size, ".json.partial"));
    const nlohmann::ordered_json header{{"name", "a run"}};
    report::Journal journal(fuzz::input_file(".json"), header, true, 0);
    static_cast<void>(journal.earlier_ids());
  });
}
