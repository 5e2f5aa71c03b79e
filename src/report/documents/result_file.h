#pragma once
// Reads results from disk.

#include <string>
#include <string_view>

#include "result/result.h"

namespace clusterbench::report {

// Throws Error for a file that cannot be read, is not JSON, is the rest of an unfinished run, is not a result, has
// another schema version, or violates the schema.
result::Result read_result(const std::string& path);

// Throws Error if the text of a file is a history (history.h), which has its own reader.
void refuse_history(const std::string& path, std::string_view text);

}  // namespace clusterbench::report
