// A history of results, and what everything that reads one makes of it.

#include "report/history/history.h"

#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered([&] {
    const auto history = report::read_history(fuzz::written(data, size, ".jsonl").string());
    static_cast<void>(report::light_changes_in(history));
    static_cast<void>(report::history_text(report::series_of(history, {}), history.size(), true));
  });
}
