#pragma once
// The findings of `stress`, as a document and as a table.

#include <ostream>

#include "result/documents/stress.h"
#include "stress/stress_run.h"

namespace clusterbench::report {

result::Stress stress_document(const stress::StressResult& result, const stress::StressRequest& request);

// A matrix hard case x method, then every loss, fault and failed check in its own line, then the search.
void print_stress(std::ostream& out, const stress::StressResult& result);

// The reasons of a failed stress run, a line each: a conservative or exact method that lost a light, a check of the
// tool, a fault.
std::vector<std::string> stress_failures(const stress::StressResult& result);

}  // namespace clusterbench::report
