#pragma once
// slice_rows.h for orthographic grids, whose rows are boxes: what a ball has in one is a disk's chord.

#include "assign/simd/slice_rows.h"

namespace clusterbench::assign {

void find_flat_rows(const RowPlanes& planes, const SeenBalls& seen, std::span<const BallsOfSlice> balls,
                    RowBatches& out);

}  // namespace clusterbench::assign
