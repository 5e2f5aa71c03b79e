#pragma once
// Instructions as valgrind's callgrind counts them, for a program that already runs under it. The same program and
// input give the same count on every machine that valgrind shows the same instruction sets.

#include <filesystem>
#include <string>

#include "run/counters/instruction_counter.h"

namespace clusterbench::run {

class CallgrindCounter final : public InstructionCounter {
 public:
  // `dumps`: the path that callgrind was given as --callgrind-out-file, beside --instr-atstart=no. Throws Error where
  // this program does not run under callgrind.
  explicit CallgrindCounter(std::filesystem::path dumps);

  const char* source() const override { return "callgrind"; }
  bool counts_all_threads() const override { return true; }
  void start() override;
  Counted stop() override;

  // Why this build cannot be counted so; "" if it can.
  static std::string obstacle();

 private:
  std::filesystem::path dumps_;
  int dump_count_ = 0;
};

}  // namespace clusterbench::run
