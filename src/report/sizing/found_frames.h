#pragma once
// What `clusterbench worst-case -o FILE` found, for `size`.

#include <cstdint>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"
#include "result/documents/size.h"
#include "result/result.h"

namespace clusterbench::report {

// Of the case with its scene, camera, viewport and structure (grid, method, storage), whatever that is called here.
// Throws Error for a file that is none of `worst-case`, of a case that the result does not have, of another version of
// its scene, or of other settings: viewport, field of view, range rule, end of the grid.
FoundFrame read_found(const std::string& path, const result::Result& result);

// The result with what searches found in place of what its frames have, where that is more: entries, longest list,
// lights in view, and the bytes of all buffers, of the cases that were searched. Budgets then hold both.
result::Result with_finds(result::Result result, const std::vector<FoundFrame>& found);

// For the document of `size`.
result::SizeSearch size_search(const FoundFrame& found);

}  // namespace clusterbench::report
