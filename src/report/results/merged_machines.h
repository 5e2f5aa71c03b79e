#pragma once
// The machines whose times a merged result has. Times of two machines are kept, and never compared.

#include <string>
#include <vector>

#include "report/results/sweep.h"
#include "result/result.h"

namespace clusterbench::report {

// Whether a case has anything that depends on its machine: times, a device's times, readings or instructions.
bool is_measured(const result::Case& result_case);

// Of the measured cases of all parts, in the order of their first case: two are the same if kind of machine, host and
// instruction set are. A part can be a merged result itself.
class MachinesOfParts {
 public:
  explicit MachinesOfParts(const std::vector<NamedPart>& parts);

  // Writes the machine's name into a measured case of a part; none if all are of one machine.
  void name_in(result::Case& result_case, const result::Result& part) const;
  // Writes them, if there are several, and the first of them as `machine`, with its host if it is the only one.
  void add_to(result::Result& merged) const;

 private:
  std::vector<result::MeasuredMachine> machines_;
};

}  // namespace clusterbench::report
