#pragma once
// Benchmarks that are registered by what is there when they start.

namespace clusterbench {

void register_simd_kernels();
void register_truth();
void register_decisions();
void register_depth();
void register_peers();  // with CLUSTERBENCH_SCENE_LIBRARY

}  // namespace clusterbench
