#pragma once
// slice_rows.h for orthographic grids, whose rows are boxes: what a ball has in one is a disk's chord.

#include "assign/rows/slice_rows.h"

namespace clusterbench::assign {

void find_orthographic_rows(const RowPlanes& planes, const VisibleBalls& visible, std::span<const BallsOfSlice> balls,
                            RowBatches& out);

}  // namespace clusterbench::assign
