// Of a build without NLopt: `worst-case` is refused before a search begins.

#include "core/error.h"
#include "core/libraries.h"
#include "search/optimizer.h"

namespace clusterbench::search {
namespace {

[[noreturn]] void refuse_search() {
  throw Error("", "worst-case", missing_library(Library::nlopt));
}

}  // namespace

int maximise_globally(std::vector<double> /*start*/, int /*evaluations*/, std::uint64_t /*seed*/,
                      const Objective& /*objective*/, const std::atomic<bool>& /*stop*/) {
  refuse_search();
}

int maximise_locally(std::vector<double> /*start*/, double /*step*/, int /*evaluations*/,
                     const Objective& /*objective*/, const std::atomic<bool>& /*stop*/) {
  refuse_search();
}

}  // namespace clusterbench::search
