#pragma once
// Instructions counted by valgrind's callgrind, for a program that already runs under it. The same program and input
// give the same count on every machine on which valgrind offers the same instruction sets.

#include <filesystem>
#include <string>

#include "run/counters/instruction_counter.h"

namespace clusterbench::run {

class CallgrindCounter final : public InstructionCounter {
 public:
  // `dumps`: the path passed to callgrind as --callgrind-out-file, together with --instr-atstart=no. Throws Error if
  // this program does not run under callgrind.
  explicit CallgrindCounter(std::filesystem::path dumps);

  const char* source() const override { return "callgrind"; }
  bool counts_all_threads() const override { return true; }
  void start() override;
  Counted stop() override;

  // Why this build cannot be counted by callgrind; "" if it can.
  static std::string obstacle();

 private:
  std::filesystem::path dumps_;
  int dump_count_ = 0;
};

}  // namespace clusterbench::run
