#pragma once
// Results read back from disk.

#include <string>
#include <string_view>

#include "result/result.h"

namespace clusterbench::report {

// Throws Error for what cannot be read, is not JSON, is what an unfinished run left, is not a result, is one of another
// schema version, or is not as the schema says.
result::Result read_result(const std::string& path);

// Throws Error if the text of a file is that of a history (history.h), which is read otherwise.
void refuse_history(const std::string& path, std::string_view text);

}  // namespace clusterbench::report
