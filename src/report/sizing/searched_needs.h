#pragma once
// The needs of buffers in the frames that searches found (`worst-case`).

#include "report/sizing/sized_structure.h"

namespace clusterbench::report {

// Sets `found`, `found_by` and `found_views` of the structure's buffers from its searches. More lights than those of
// the level can also widen elements and raise theoretical maxima.
void add_searches(SizedStructure& structure);

}  // namespace clusterbench::report
