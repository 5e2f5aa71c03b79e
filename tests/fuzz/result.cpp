// A result read back, and what everything that reads one asks it first.

#include "fuzz/input.h"
#include "report/cases/failures.h"
#include "report/documents/result_file.h"
#include "report/results/result_record.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered([&] {
    const result::Result result = report::read_result(fuzz::written(data, size, ".json").string());
    static_cast<void>(report::gate_failures(result));
    static_cast<void>(report::fronts(result.scenes, result.cases, result));
  });
}
