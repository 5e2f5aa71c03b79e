#pragma once
// The findings of `clusterbench worst-case -o FILE`, for `size`.

#include <cstdint>
#include <string>
#include <vector>

#include "report/sizing/sized_structure.h"
#include "result/documents/size.h"
#include "result/result.h"

namespace clusterbench::report {

// For the case with its scene, camera, viewport and structure (grid, method, storage), by contents, not by name. Throws
// Error for a file that is not of `worst-case`, of a case that the result does not have, of another version of its
// scene, or of other settings: viewport, field of view, range rule, end of the grid.
FoundFrame read_found(const std::string& path, const result::Result& result);

// The result with larger findings of searches in place of its own values: entries, longest list, lights in view, and
// the bytes of all buffers of the searched cases. Budgets then apply to both.
result::Result with_finds(result::Result result, const std::vector<FoundFrame>& found);

// For the document of `size`.
result::SizeSearch size_search(const FoundFrame& found);

}  // namespace clusterbench::report
