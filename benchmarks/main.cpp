#include <benchmark/benchmark.h>

#include "benchmarks.h"

int main(int argc, char** argv) {
  clusterbench::register_simd_kernels();
  clusterbench::register_truth();
  clusterbench::register_decisions();
  clusterbench::register_depth();
  clusterbench::register_peers();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
