#pragma once
// One function per format, each in the file of its name.

#include <string>

#include "report/exports/exports.h"

namespace clusterbench::report {

std::string google_benchmark(const ExportResult& result);
std::string github_smaller_is_better(const ExportResult& result);
std::string github_bigger_is_better(const ExportResult& result);
std::string bencher(const ExportResult& result);
std::string lnt(const ExportResult& result);
std::string csv(const ExportResult& result);
std::string markdown(const ExportResult& result);

}  // namespace clusterbench::report
